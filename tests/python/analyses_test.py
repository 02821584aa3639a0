"""Reports, sweeps, topology, aspects, clearance, with the known answers of tests/analyze."""

import json
import math

import pytest

import corank


def test_the_c_space_of_the_three_slider_is_two_closed_curves(three_slider):
    t = three_slider.topology()
    assert t.components == (2, 2) and t.components.exact and t.euler_characteristic == 0 and t.smooth and t.dimension == 1
    assert "2 closed curves" in str(t) and t.complete


def test_an_analysis_says_which_limit_ended_it(three_slider, dextar):
    assert three_slider.topology().stopped is None
    for ended in (
        dextar.topology(time_limit=1e-9),
        dextar.aspects(time_limit=1e-9),
        dextar.map({"theta2": (1, 2), "theta5": (1, 2)}, time_limit=1e-9),
        dextar.postures({"theta2": 1, "theta5": 1}, time_limit=1e-9),
    ):
        assert ended.stopped.startswith("the time limit, in the stage ") and not ended.complete
        assert f"stopped by {ended.stopped}" in str(ended)


def test_its_singularities_divide_it_into_eight_aspects(three_slider):
    a = three_slider.aspects()
    assert a.aspects == (8, 8) and a.working_modes == (4, 4) and len(a.representatives) == 8
    values, signs = a.representatives[0]
    assert values["y_A"].lo <= values["y_A"].hi and set(signs) <= {-1, 1}


def test_its_aspects_are_checked_by_other_code(three_slider, tmp_path):
    a = three_slider.aspects(certificate=True)
    said = a.verify()
    assert said and said.complete and said.report["aspects"]["at_most"] == 8 and "verified" in str(said)
    a.save(tmp_path / "aspects.h5")
    assert (tmp_path / "aspects.h5").stat().st_size > 1000
    with pytest.raises(ValueError, match="certificate=True"):
        three_slider.aspects().verify()


def test_its_aspects_end_where_requirements_do(three_slider):
    a = three_slider.with_requirements("x_C >= 1/10").aspects(certificate=True)
    assert a.aspects == (4, 4) and a.assembly_modes == (4, 4) and a.working_modes == (2, 2)
    assert a.require == ["x_C >= 1/10"] and all(values["x_C"].lo >= 0.1 for values, _ in a.representatives)
    assert a.verify().complete and three_slider.aspects().require == []


def test_an_arm_changes_its_posture_about_its_cusps(models):
    arm = corank.load(models / "serial" / "orthogonal_3r_section.cuik")
    assert arm.aspects().cusps is None
    a = arm.aspects(cusps=True)
    assert a.cusps_not_known == [] and len(a.cusps) == 4
    assert sorted(c.around for c in a.cusps) == [0, 0, 1, 1]
    for c in a.cusps:
        assert c.locus == "inverse" and c.between == 1 - c.around
        t2, t3 = (c.values[name].mid for name in ("theta2", "theta3"))
        determinant = math.sin(t3) + math.cos(t2) * (2 * math.sin(t3) - math.cos(t3))
        assert abs(determinant) < 1e-6


def test_the_areas_of_an_arms_aspects_are_in_bounds(models):
    """With t2 of one sign the arm reaches each point once: an area is the integral of l1 l2 |sin(t2)|."""
    a = corank.load(models / "planar" / "arm_2r_limits.cuik").aspects(areas=True)
    assert len(a.areas) == a.aspects.at_least == 2
    bends = {values["t2"].lo > 0: area for area, (values, _) in zip(a.areas, a.representatives)}
    for left, limit in ((True, 3 * math.pi / 4), (False, math.pi / 4)):
        exact = 0.8 * (1 - math.cos(limit)) * (math.pi / 2 + math.pi / 6)
        assert 0 < bends[left].lo <= exact <= bends[left].hi < bends[left].lo + 2


def test_the_clearance_of_dextar_is_bounded_from_both_sides(dextar):
    c = dextar.clearance({"J3x": 0.5, "J3y": 1}, ["J3x", "J3y"], claims=True)
    assert 0.15 < c.lower <= c.upper < 0.16 and c.upper - c.lower <= 0.011 * c.upper
    x, y = c.nearest["J3x"].mid, c.nearest["J3y"].mid
    assert abs(((x - 0.5) ** 2 + (y - 1) ** 2) ** 0.5 - c.upper) < 1e-6
    assert c.free.verify().complete and len(c.free) == 0 and c.nearest_result.verify()


def test_all_robots_within_tolerances_have_the_same_shape(models):
    m = corank.load(models / "planar" / "four_bar_crank_rocker.cuik", d="5±0.01")
    assert m.topology().robots["every"] and m.topology().components == (2, 2)
    assert m.aspects().robots["every"]
    wide = corank.load(models / "planar" / "four_bar_crank_rocker.cuik", d="5±1").topology()
    assert not wide.robots["every"] and wide.robots["other"]["components"] == 1
    assert "another robot" in str(wide)
    f = corank.load(models / "planar" / "four_bar_crank_rocker.cuik", d="5.05±0.1").aspects_factor(precision=0.3)
    assert 0 < f.lower <= 4.5 <= f.upper and f.keep["aspects"] == 4 and f.other["working_modes"] == 2


def test_tolerances_may_grow_until_a_robot_falls_short(models):
    m = corank.load(models / "dextar.cuik", l="0.9±0.001", d="1.18±0.001")
    f = m.tolerance_factor(0.15, {"J3x": 0.5, "J3y": 1}, ["J3x", "J3y"], precision=0.1)
    assert f.lower < 11.37 < f.upper <= 1.1 * f.lower and f.reason is None
    assert f.tolerances["l"].hi == pytest.approx(0.9 + 0.001 * f.lower)
    assert f.robot["d"].mid == pytest.approx(1.18 + 0.001 * f.upper) and "J3x" in f.nearest
    assert "factor of the tolerances" in str(f)


def test_tolerances_may_grow_until_a_robot_cannot_follow_a_path(models):
    drawn = corank.load(models / "dextar.cuik")
    path = drawn.path({"J3x": 0.5, "J3y": 1}, {"J3x": 0.7, "J3y": -1}, start_mode=1, end_mode=2)
    f = corank.load(models / "dextar.cuik", l="0.9±0.001", d="1.18±0.001").path_factor(path, precision=0.1)
    assert 0 < f.lower <= f.upper <= 1.1 * f.lower and f.reason is None
    assert f.tolerances["d"].hi == pytest.approx(1.18 + 0.001 * f.lower)
    assert "singularity" in f.what and "J3x" in f.place and f.data["keep"] == {"path": "forward"}


def test_an_arm_of_six_joints_has_all_its_postures_and_changes_them_without_a_singularity(tmp_path):
    file = tmp_path / "gofa.cuik"
    rows = ["0 90deg 0.265 q1", "0.444 0 0 q2", "0.11 -90deg 0 q3", "0 90deg 0.47 q4", "0.08 -90deg 0 q5", "0 0 0.101 q6"]
    file.write_text("[CONSTANTS]\nunit m\n[DH]\nstandard\na alpha d theta\n" + "\n".join(rows) + "\n")
    m = corank.load(file)
    at = {"tool_x": "0.4", "tool_y": "0.2", "tool_z": "0.5"}
    p = m.postures(at, "Rz(0.3)*Ry(pi/9*2)")
    assert p.at_least == p.at_most == len(p.postures) and p.at_most % 2 == 0 and p.complete and not p.families
    assert set(p.postures[0]) == {"q1", "q2", "q3", "q4", "q5", "q6"} and "proven to be all" in str(p)
    turned = m.postures(at, (math.cos(0.15), 0, 0, math.sin(0.15)))
    assert turned.at_most is not None
    c = m.cuspidal()
    assert c and c.of == "inverse" and c.from_["q1"].mid != c.to["q1"].mid and c.path and c.path.verify()
    c.path.animate(tmp_path / "gofa.html", results=[])
    assert "This robot is cuspidal" in (tmp_path / "gofa.html").read_text()


def test_the_best_centre_has_more_clearance_than_another(dextar):
    best = dextar.best_center({"J3x": (0.4, 0.8), "J3y": (0.8, 1.2)}, precision=0.1)
    assert set(best.center) == {"J3x", "J3y"} and best.lower > 0
    there = dextar.clearance(best.center, ["J3x", "J3y"])
    assert there.upper >= best.lower * 0.999


def test_a_map_has_bounds_for_each_cell(dextar):
    map = dextar.clearance_map({"J3x": (0.3, 0.9), "J3y": (0.6, 1.2)}, grid=3)
    assert len(map.rows) == 9 and map.names == ["J3x", "J3y"] and map.complete
    for row in map.rows:
        assert row["cell_lo"] <= row["lo"] and (row["hi"] is None or row["lo"] <= row["hi"])
    pytest.importorskip("pandas")
    assert len(map.to_pandas()) == 9


def test_a_report_is_a_page_with_its_files(three_slider, tmp_path):
    page = three_slider.report(tmp_path / "report")
    assert page.complete and [r.set for r in page.results] == list(corank.USUAL_SETS)
    assert (tmp_path / "report" / "index.html").read_text() == page.html
    assert (tmp_path / "report" / "figures" / "output-portrait.svg").exists()
    for name in corank.USUAL_SETS:
        assert corank.open(tmp_path / "report" / f"{name}.h5").set == name
    assert "8 aspects, 8 assembly modes, 4 working modes" in page.html and 'class="by-aspect"' in page.html
    again = corank.Mechanism.report(three_slider, results=page.results)
    assert again.path is None and "three_slider" in again.html


def test_a_sweep_solves_every_member(three_slider, tmp_path):
    s = three_slider.sweep("L2", corank.linspace(0.8, 1, 3), sets=["forward", "inverse"])
    assert s.complete and len(s) == 3 and [m.value for m in s] == ["4/5", "9/10", "1"]
    assert [len(m.results["forward"].points) for m in s] == [8, 8, 6]
    pandas = pytest.importorskip("pandas")
    frame = s.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and list(frame["points"]) == [8, 4, 8, 4, 6, 6]
    assert list(frame["L2_value"])[::2] == [0.8, 0.9, 1.0]
    page = s.report(tmp_path / "family")
    assert (tmp_path / "family" / "index.html").read_text() == page.html
    assert (tmp_path / "family" / "member-1-forward.h5").exists()


def test_values_that_make_no_mechanism_are_known_before_the_first_search(three_slider):
    with pytest.raises(corank.ModelError):
        three_slider.sweep("L9", [1, 2])
    with pytest.raises(ValueError):
        corank.linspace(0, 1, 1)


def test_a_plain_system_has_no_aspects():
    m = corank.parse("[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\n")
    with pytest.raises(ValueError, match="plain system"):
        m.aspects()
    assert m.topology().components == (1, 1)


@pytest.fixture(scope="module")
def way(dextar):
    return dextar.path({"J3x": 0.3, "J3y": 1}, {"J3x": 0.9, "J3y": 1.1}, start_mode=1, end_mode=1)


@pytest.fixture(scope="module")
def apart(dextar):
    return dextar.path({"J3x": 0.3, "J3y": 1}, {"J3x": 0.3, "J3y": 1}, start_mode=1, end_mode=2, avoid="both")


def test_a_path_of_dextar_is_proven_saved_and_verified(way, tmp_path):
    assert way and way.status == "path" and way.radius > 0 and way.verify()
    assert way.waypoints[0]["J3x"] == pytest.approx(0.3) and way.waypoints[-1]["J3y"] == pytest.approx(1.1)
    assert list(way.to_pandas().columns) == list(way.waypoints[0]) and len(way.radii) == len(way.waypoints) - 1
    way.save(tmp_path / "way.h5")
    assert (tmp_path / "way.h5").stat().st_size > 0


def path_data(page):
    """What the page's script reads of the path."""
    text = page.html.split('id="path">', 1)[1].split("</script>", 1)[0]
    return json.loads(text)


def test_a_path_is_a_page_on_which_the_mechanism_moves(dextar, way, tmp_path):
    forward = dextar.solve("forward", sigma=0.1)
    page = way.animate(tmp_path / "way.html", results=[forward])
    assert (tmp_path / "way.html").read_text() == page.html and "boxes-forward" in page.html
    data = path_data(page)
    assert data["status"] == "path" and len(data["nodes"]) == len(way.waypoints)
    assert [piece["radius"] for piece in data["pieces"]] == way.radii
    for x, values in ((data["ends"][0], way.waypoints[0]), (data["ends"][1], way.waypoints[-1])):
        assert x[:2] == pytest.approx([values["J3x"], values["J3y"]], abs=1e-12)
    assert "srcdoc=" in way._repr_html_() and "forward singularities" in page.html


def test_a_page_shows_both_ends_where_no_path_joins_them_and_takes_no_strangers(apart, three_slider):
    page = apart.animate(results=[])
    assert (
        path_data(page)["nodes"] == []
        and "It is proven that there is no such path" in page.html
        and 'class="unlike"' in page.html
    )
    with pytest.raises(ValueError, match="another model"):
        apart.animate(results=[three_slider.solve("forward")])


def test_ends_of_unlike_signs_are_separated(apart):
    assert not apart and apart.status == "separated" and apart.reason
    with pytest.raises(ValueError, match="there is no path"):
        apart.save("nowhere.h5")


def test_ends_that_are_not_one_configuration_are_listed(dextar):
    with pytest.raises(ValueError, match="4 configurations"):
        dextar.path({"J3x": 0.3, "J3y": 1}, {"J3x": 0.9, "J3y": 1.1})
    with pytest.raises(ValueError, match="avoid"):
        dextar.path({"J3x": 0.3, "J3y": 1}, {"J3x": 0.9, "J3y": 1.1}, avoid="none")
