"""Maps over two parameters, against a closed form, on this process and on worker processes."""

import numpy as np
import pytest

import corank

CUBIC = """[CONSTANTS]
a := 0
b := 0
[SYSTEM VARS]
x : [-4, 4]
[SYSTEM EQS]
x^3 + a*x + b = 0;"""
OVER = {"a": (-2, 1), "b": (-1, 1)}


@pytest.fixture(scope="module")
def cubic():
    return corank.parse(CUBIC)


@pytest.fixture(scope="module")
def cusp(cubic):
    return cubic.map(OVER, resolution=32)


def test_a_cubic_has_three_roots_within_its_cusp(cusp):
    assert cusp.complete and cusp.boundary_known and cusp.names == ("a", "b") and set(cusp.shares) == {1, 3}
    numbers = cusp.grid()
    assert numbers.shape == (32, 32) and 0.8 < cusp.proven_share < 1
    at = -2 + 3 * (np.arange(32) + 0.5) / 32, -1 + 2 * (np.arange(32) + 0.5) / 32
    a, b = np.meshgrid(*at)
    roots = np.where(4 * a**3 + 27 * b**2 < 0, 3, 1)
    assert (numbers == roots).all() and abs(numbers.count() / 1024 - cusp.proven_share) < 1e-9
    assert cusp.at(-1.5, 0.1) == 3 and cusp.at(0.9, 0.5) == 1 and cusp.at(0, 0) is None


def test_its_cells_are_a_data_frame_and_its_curve_an_array(cusp):
    frame = cusp.to_pandas()
    assert list(frame.columns) == ["a_lo", "a_hi", "b_lo", "b_hi", "kind", "count", "at_centre"]
    assert set(frame.kind) == {"proven", "undecided"} and frame[frame.kind == "proven"]["count"].notna().all()
    area = ((frame.a_hi - frame.a_lo) * (frame.b_hi - frame.b_lo)).sum()
    assert abs(area - 6) < 1e-9
    curve = cusp.boundary()
    assert curve.shape[1] == 5 and (curve[:, 4] == 1).sum() > 20 and (curve[:, 0] <= curve[:, 1]).all()


def test_it_is_drawn_with_a_legend(cusp):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    ax = cusp.plot()
    words = [text.get_text() for text in ax.get_legend().get_texts()]
    assert words[:2] == ["3", "1"] and "solutions meet" in words and ax.get_xlabel() == "a"


def test_cusps_and_nodes_of_an_arm_are_found(models):
    arm = corank.load(models / "serial" / "orthogonal_3r_section.cuik", d3="0.91", d4="0.5", r2="1.15")
    found = arm.map({"rho2": (0, 4), "z": (-2, 2)}, resolution=8, boundary=False, cusps=True)
    assert found.cusps_known and found.nodes_known and found.aspects == "2 aspects, 1 assembly mode, 2 working modes"
    assert found.cusps().shape == (4, 5) and found.nodes().shape == (2, 5) and (found.nodes()[:, 4] == 1).all()
    with pytest.raises(ValueError):
        arm.map({"rho2": (0, 4), "z": (-2, 2)}, count="aspects", cusps=True)


def test_bodies_keep_apart_in_cells(dextar):
    apart = dextar.map(
        {"J3x": (0.25, 1), "J3y": (0.3, 1.75)}, require="distance(J5 J4, J2 J3) >= 5 mm", resolution=32, certificate=True
    )
    assert apart.at(0.59, 1.2) is True and apart.at(0.59, 0.55) is False
    assert apart.verify().verified
    with pytest.raises(corank.ModelError, match="one of a distance"):
        dextar.with_requirements("distance(J5 J4, J2 J3) >= 5 mm").solve("requirements")


def test_requirements_are_met_violated_or_open(dextar):
    over = {"J3x": (0.25, 1), "J3y": (0.3, 1.75)}
    required = dextar.map(over, require="amplification(outputs) <= 2", resolution=32, certificate=True)
    assert required.at(0.59, 0.55) is True and required.at(0.59, 1.2) is False and required.at(0.59, 0.62) is None
    assert required.at(0.26, 1.74) is False  # the robot does not reach it
    assert required.require == ["amplification(outputs) <= 2"] and set(required.standings) == {
        "satisfied",
        "violated",
        "open",
    }
    frame = required.to_pandas()
    assert list(frame.columns)[-1] == "standing" and set(frame.standing.dropna()) == {"satisfied", "violated", "open"}
    assert required.verify().verified
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    words = [text.get_text() for text in required.plot().get_legend().get_texts()]
    assert words[:4] == ["satisfied by all", "violated by one", "no solution", "open"]
    robot = dextar.with_requirements("amplification(outputs) <= 2")
    assert robot.requirements == ["amplification(outputs) <= 2"] and not dextar.requirements
    assert robot.with_constants(l="0.91").requirements == robot.requirements
    ball = robot.clearance({"J3x": 0.59, "J3y": 0.55}, ["J3x", "J3y"], set="requirements")
    assert 0.066 < ball.lower < 0.0671
    path = robot.path({"J3x": 0.59, "J3y": 0.55}, {"J3x": 0.59, "J3y": 0.52}, start_mode=1, end_mode=1, avoid="requirements")
    assert path.data["standing"] == "satisfied"
    with pytest.raises(corank.ModelError, match="expected outputs or inputs"):
        dextar.map(over, require=["amplification(x) <= 1"])


def test_what_holds_for_every_robot_is_less_than_for_the_one_drawn(dextar, models):
    over = {"J3x": (0.25, 1), "J3y": (0.3, 0.8)}
    drawn = dextar.map(over, require="amplification(outputs) <= 2", resolution=32)
    every = corank.load(models / "dextar.cuik", l="0.9±0.002").map(
        over, require="amplification(outputs) <= 2", resolution=32
    )
    assert every.tolerances == {"l": (pytest.approx(0.898), pytest.approx(0.902))} and not drawn.tolerances
    assert every.at(0.59, 0.55) is True and drawn.at(0.59, 0.55) is True
    assert 0 < every.standings["satisfied"] < drawn.standings["satisfied"]
    assert "every robot" in str(every)


def test_what_has_no_number_is_refused(cubic, dextar):
    with pytest.raises(corank.ModelError, match="no number of solutions"):
        dextar.map({"l2": (1, 2), "l3": (1, 2)})
    with pytest.raises(corank.ModelError, match="two parameters"):
        cubic.map({"a": (0, 1)})
    with pytest.raises(ValueError, match="count"):
        cubic.map(OVER, count="roots")


def test_workers_make_the_same_map_and_family(cubic, cusp, three_slider):
    pytest.importorskip("distributed")
    from corank import cluster

    with cluster.local_client(workers=2) as client:
        spread = cubic.map(OVER, resolution=32, client=client, progress=False)
        required = cubic.map(OVER, require="x <= 1", resolution=16, client=client, progress=False)
        assert required.standings == cubic.map(OVER, require="x <= 1", resolution=16).standings
        values = corank.linspace("4/5", 1, 3)
        family = three_slider.sweep("L2", values, sets=["forward", "inverse"], client=client, progress=False)

        def interrupt(stage, share, text):
            raise KeyboardInterrupt

        with pytest.raises(corank.Interrupted) as ended:
            cubic.map(OVER, resolution=32, client=client, progress=interrupt)
    one, other = dict(cusp.data), dict(spread.data)
    assert one.pop("seconds") >= 0 and other.pop("seconds") >= 0 and one == other
    assert family.complete and [len(m.results["forward"].points) for m in family] == [8, 8, 6]
    here = three_slider.sweep("L2", values, sets=["forward", "inverse"])
    for a, b in zip(here, family):
        assert a.value == b.value and all(np.array_equal(a.results[s].boxes, b.results[s].boxes) for s in a.results)
    early = ended.value.result
    assert not early.complete and "pending" in set(early.to_pandas().kind)


def test_its_certificate_is_saved_and_verified(cubic, cusp, tmp_path):
    kept = cubic.map(OVER, resolution=16, certificate=True)
    report = kept.verify()
    assert report.verified and report.complete and report.report["cells"]["complete"] > 50
    kept.save(tmp_path / "cusp.h5")
    assert (tmp_path / "cusp.h5").stat().st_size > 10_000
    with pytest.raises(ValueError, match="certificate=True"):
        cusp.verify()
    with pytest.raises(ValueError, match="certificate"):
        cubic.map(OVER, count="components", certificate=True)
