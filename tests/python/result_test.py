"""Results: arrays without copies, points with exact numbers, files, checks, data frames."""

import gc
import importlib.util
import pickle
import weakref

import numpy
import pytest

import corank


def test_boxes_are_views_of_one_memory(forward):
    a, b = forward.boxes, forward.boxes
    assert a.shape == (len(forward), len(forward.variables), 2) and a.dtype == numpy.float64
    assert a.__array_interface__["data"][0] == b.__array_interface__["data"][0]
    assert not a.flags.owndata and numpy.shares_memory(a, forward["J3x"])
    assert numpy.shares_memory(forward.verdict_codes, forward.verdict_codes)
    assert numpy.shares_memory(forward.free, forward.free)
    assert (a[:, :, 0] <= a[:, :, 1]).all()
    with pytest.raises(ValueError):
        a[0, 0, 0] = 0


def test_an_array_keeps_the_memory_of_its_result_alive(dextar):
    r = dextar.solve("forward", sigma=0.1)
    alive = weakref.ref(r)
    boxes, copy = r.boxes, r.boxes.copy()
    del r
    gc.collect()
    assert alive() is None
    junk = [numpy.full(boxes.size, -1.0) for _ in range(20)]
    assert (boxes == copy).all() and len(junk) == 20


def test_boxes_are_no_wider_than_sigma(forward):
    sides = [i for i, name in enumerate(forward.variables) if forward.kinds[name] in ("length", "cosine", "sine")]
    widths = forward.boxes[:, sides, 1] - forward.boxes[:, sides, 0]
    assert widths.max() <= 0.05 and forward.sigma == (0.05, 0.05)


def test_sheets_of_a_surface_stay_whole_until_they_are_cut(dextar, tmp_path):
    whole, curve = dextar.solve("cspace"), dextar.solve("forward")
    assert max(whole.sigma) == numpy.inf and max(curve.sigma) < 0.1
    cut = whole.cut(0.2)
    assert cut.complete and cut.sigma == (0.2, 0.2) and len(cut) > 2 * len(whole)
    assert (cut["J3x"][:, 1] - cut["J3x"][:, 0]).max() <= 0.2
    assert cut.verify().verified
    by_default = dextar.solve("cspace", surfaces_whole=False)
    assert max(by_default.sigma) < 0.2
    whole.portrait(tmp_path / "whole.svg", "J3x", "J3y")
    whole.cut().portrait(tmp_path / "cut.svg", "J3x", "J3y")
    assert (tmp_path / "whole.svg").read_text() == (tmp_path / "cut.svg").read_text()


def test_samples_of_the_curve_lie_in_boxes(forward):
    """J2, J3, J4 aligned: theta3 = theta4 + pi, or theta3 = theta4, with the loop closed."""
    l, d = 0.9, 1.18
    samples = 0
    for t2 in numpy.linspace(-3, 3, 61):
        a = numpy.array([d + l * numpy.cos(t2), l * numpy.sin(t2)])
        # J4 is on the circle about the origin, and 2 l away from J2.
        distance = numpy.hypot(*a)
        cosine = (l * l + distance**2 - 4 * l * l) / (2 * l * distance)
        if abs(cosine) >= 1:
            continue
        for sign in (-1, 1):
            t5 = numpy.arctan2(a[1], a[0]) + sign * numpy.arccos(cosine)
            j3 = (a + l * numpy.array([numpy.cos(t5), numpy.sin(t5)])) / 2
            inside = numpy.ones(len(forward), dtype=bool)
            for name, x in (("J3x", j3[0]), ("J3y", j3[1]), ("c_theta2", numpy.cos(t2)), ("s_theta5", numpy.sin(t5))):
                sides = forward[name]
                inside &= (sides[:, 0] <= x + 1e-12) & (x - 1e-12 <= sides[:, 1])
            assert inside.any()
            samples += 1
    assert samples > 20


def test_an_angle_has_its_enclosures_in_radians(forward):
    angle, cosine = forward["theta2"], forward["c_theta2"]
    assert angle.shape == cosine.shape
    middle = numpy.cos(angle.mean(axis=1))
    assert ((cosine[:, 0] - 1e-9 <= middle) & (middle <= cosine[:, 1] + 1e-9)).all()
    assert forward.angles["theta2"].cosine == "c_theta2"
    with pytest.raises(KeyError, match="theta9"):
        forward["theta9"]


def test_verdicts_counts_and_types_agree(forward):
    words = forward.verdicts
    assert {w: int((words == w).sum()) for w in forward.counts} == forward.counts
    assert sum(forward.counts.values()) == len(forward)
    assert forward.types["RO"].all() and not forward.excluded_types["RO"].any()
    assert (forward.kernel_at_most == 1).all()
    one = forward.free[words == "regular"].sum(axis=1)
    assert (one == 1).all(), "curves have one free variable"


def test_points_have_exact_values(points):
    sympy = pytest.importorskip("sympy")
    found = {(p["y_A"], p["y_B"], p["x_C"]) for p in points.points}
    r = sympy.Rational
    ends = {(a, b, 0) for a in (-1, 1) for b in (r(-4, 5), r(4, 5))}
    assert found == ends | {(a, 0, b) for a in (r(-3, 5), r(3, 5)) for b in (r(-4, 5), r(4, 5))}
    for p in points.points:
        assert p.verdict == "isolated"
        assert p.types == (("RPM", "II", "IO") if p["x_C"] == 0 else ("RO", "II"))
        assert p.enclosures["y_A"].lo <= float(p["y_A"]) <= p.enclosures["y_A"].hi


def test_exact_points_of_a_curve_are_there(dextar):
    sympy = pytest.importorskip("sympy")
    r = dextar.solve("inverse", sigma=0.1)
    stretched = {(p["J3x"], p["J3y"]) for p in r.exact_points}
    root = sympy.Rational(11, 100) * sympy.sqrt(239)
    assert stretched == {(sympy.Rational(59, 100), root), (sympy.Rational(59, 100), -root)}
    r = dextar.solve("inverse", sigma=0.1, kernel="right")
    undecided = r.verdicts == "undecided"
    assert undecided.any() and set(r.reasons[~undecided]) == {"none"} and "none" not in r.reasons[undecided]


def test_roots_of_higher_degree_are_algebraic_numbers():
    sympy = pytest.importorskip("sympy")
    m = corank.parse("[SYSTEM VARS]\nx : [-2, 2]\ny : [-3, 3]\n[SYSTEM EQS]\nx^3 - x = 1;\ny = x^2;\n")
    (p,) = m.solve(digits=20).points
    x, y = p["x"], p["y"]
    assert p.decimals["x"].startswith("1.32471795724474602")
    if p.exact:
        t = sympy.Symbol("t")
        assert sympy.minimal_polynomial(x, t) == t**3 - t - 1
        assert abs(sympy.N(y - x**2, 30)) < 1e-25


def test_angles_of_points_are_exact_in_their_turn():
    sympy = pytest.importorskip("sympy")
    m = corank.parse("[SYSTEM VARS]\nt ~ [0, 2*pi]\n[SYSTEM EQS]\n2*cos(t) = 1;\n")
    assert {p["t"] for p in m.solve().points} == {sympy.pi / 3, 5 * sympy.pi / 3}


def test_a_file_holds_the_same_result(forward, tmp_path):
    path = tmp_path / "forward.h5"
    forward.save(path)
    again = corank.open(path)
    assert (again.boxes == forward.boxes).all() and (again.verdicts == forward.verdicts).all()
    assert again.summary["boxes"] == forward.summary["boxes"] and again.sigma == forward.sigma
    assert again.mechanism.text.split("[SYSTEM VARS]")[1] == forward.mechanism.text.split("[SYSTEM VARS]")[1]
    forward.save(tmp_path / "forward.sol")
    assert (tmp_path / "forward.sol").read_text().count("<S>") == forward.counts["regular"]


def test_a_file_that_is_none_is_refused(tmp_path):
    path = tmp_path / "noise.h5"
    path.write_bytes(b"no result")
    with pytest.raises(corank.ResultFileError, match="noise.h5"):
        corank.open(path)
    with pytest.raises(OSError):
        corank.open(tmp_path / "missing.h5")


def test_a_result_is_verified_and_a_proof_shows_that_nothing_is_missing(three_slider, tmp_path):
    plain = three_slider.solve("inverse")
    checked = plain.verify()
    assert checked and checked.verified and not checked.complete
    proven = three_slider.solve("inverse", proof=True)
    assert proven.has_proof and proven.verify().complete
    path = tmp_path / "inverse.h5"
    proven.save(path)
    assert corank.open(path).verify().complete


def test_a_tampered_result_is_not_verified(three_slider, tmp_path):
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "inverse.h5"
    three_slider.solve("inverse").save(path)
    with h5py.File(path, "r+") as file:
        lower, upper = file["boxes/lower"], file["boxes/upper"]
        lower[0, 0], upper[0, 0] = lower[0, 0] + 0.3, upper[0, 0] + 0.3
    assert not corank.open(path).verify()


def test_a_built_mechanisms_result_holds_its_text():
    m = corank.Mechanism("circle")
    x, y = m.length("x", -2, 2), m.length("y", -2, 2)
    m.constrain(x**2 + y**2 == 1, y == x)
    r = m.solve(proof=True)
    assert r.verify().complete
    assert r.mechanism.constraints == m.constraints


def test_pickles_are_the_same_result(forward, points):
    for r in (forward, points):
        again = pickle.loads(pickle.dumps(r))
        assert (again.boxes == r.boxes).all() and again.counts == r.counts and again.set == r.set
        assert len(again.points) == len(r.points)


def test_a_data_frame_has_a_row_for_each_box(forward):
    pytest.importorskip("pandas")
    frame = forward.to_pandas(angles=True)
    assert len(frame) == len(forward)
    assert (frame["J3x_lo"].to_numpy() == forward["J3x"][:, 0]).all()
    assert (frame["theta2_hi"].to_numpy() == forward["theta2"][:, 1]).all()
    assert frame["verdict"].value_counts()["regular"] == forward.counts["regular"]
    assert (frame["J3x_mid"].to_numpy() == forward["J3x"].mean(axis=1)).all()
    assert list(frame.columns[:4]) == ["verdict", "J3x_mid", "J3x_lo", "J3x_hi"]


def test_a_data_frame_has_kernel_vectors_where_they_are_asked_for(dextar):
    pytest.importorskip("pandas")
    forward = dextar.solve("forward", sigma=0.05, kernel="right")
    kernel = forward.kernel_unknowns
    assert kernel and not {c for c in forward.to_pandas().columns if c.split("_")[0] in kernel}
    frame = forward.to_pandas(kernel=True)
    assert (frame[f"{kernel[0]}_hi"].to_numpy() == forward[kernel[0]][:, 1]).all()


def test_boxes_say_whether_they_hold_a_part_of_a_sheet(models, forward):
    m = corank.load(models / "planar" / "3prr.cuik")
    whole = m.solve("forward", kernel="right")
    some = whole.parts_of_sheets
    assert not forward.parts_of_sheets.any() and some.any() and some.sum() == whole.summary["parts_of_sheets"]
    assert set(whole.verdicts[some]) <= {"regular", "boundary"}
    assert (whole.free[some].sum(axis=1) == whole.dimension).all(), "their free variables are known"
    assert "with a part of a sheet" in whole._repr_html_() and "part of a sheet" not in forward._repr_html_()
    union = m.solve("forward")
    assert (union.parts_of_sheets == numpy.concatenate([p.parts_of_sheets for p in union.parts])).all()
    if importlib.util.find_spec("pandas"):
        assert whole.to_pandas()["part_of_sheet"].sum() == some.sum()


def test_a_boundary_has_parts_and_passages(models):
    m = corank.load(models / "planar" / "arm_2r_limits.cuik")
    r = m.solve("boundary")
    assert r.parts and len(r) == sum(len(p) for p in r.parts)
    assert set(r.passages) <= {"barrier", "traversable", "unproven"} and "barrier" in r.passages
    area = m.area()
    assert area is not None and 0 < area.lo <= area.hi


def test_a_union_has_parts_with_conditions(models):
    legs = corank.load(models / "planar" / "3prr.cuik").solve("inverse", sigma=0.5)
    assert len(legs.parts) == 3 and len(legs) == sum(len(p) for p in legs.parts)
    assert [p["condition"] for p in legs.summary["parts"]] == [p.part for p in legs.parts]
    assert legs.parts[2].part == "cos(psi1) = 0"
    dextar = corank.load(models / "dextar.cuik")
    assert [p.part for p in dextar.solve("forward").parts] == ["theta4 = theta3", "theta4 = theta3 + pi"]
    assert not dextar.solve("forward", kernel="right").parts


def test_limits_leave_a_valid_result_that_says_so(dextar):
    r = dextar.solve("cspace", sigma=0.2, max_boxes=100, threads=1)
    assert not r.complete and "box limit" in r.stopped and r.counts["pending"] > 0
    assert r.verify().report["failures"] == [] and "incomplete" in repr(r)


def test_a_notebook_shows_the_verdicts(forward, points):
    html = forward._repr_html_()
    assert "regular" in html and str(len(forward)) in html and "complete" in html
    assert "-4/5" in points._repr_html_()
    frame = forward.show(height=321)._repr_html_()
    assert frame.startswith("<iframe srcdoc=") and 'height="321"' in frame and "&lt;script" in frame


def test_an_empty_set_says_whether_the_robot_can_be_assembled():
    text = (
        "[SYSTEM VARS]\ntheta ~ [-pi, pi]\nphi ~ [-pi, pi]\npsi ~ [-pi, pi]\n[SYSTEM EQS]\n"
        "2*cos(theta) + 4.5*cos(phi) - 3*cos(psi) - {0} = 0;\n2*sin(theta) + 4.5*sin(phi) - 3*sin(psi) = 0;\n"
        "[INPUTS] theta\n[OUTPUTS] psi\n"
    )
    free = corank.parse(text.format(5)).solve("forward")
    assert len(free) == 0 and free.assembled is True and not free.nearly_solved
    assert set(free.sample) == {"theta", "phi", "psi"}
    apart = corank.parse(text.format(15)).solve("forward")
    assert apart.assembled is False and apart.sample is None
