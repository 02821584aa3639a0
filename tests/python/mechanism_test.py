"""Mechanisms: built, read, parsed, changed, pickled; what is wrong with them is said with its place."""

import multiprocessing
import pickle
from fractions import Fraction

import pytest

import corank


def built(name="three-slider", L2="4/5"):
    m = corank.Mechanism(name)
    L1, L2 = m.constant("L1", 1), m.constant("L2", L2)
    y_A, y_B, x_C = m.length("y_A", -L1, L1), m.length("y_B", -L2, L2), m.length("x_C", -L1, L1)
    m.constrain(y_A**2 + x_C**2 == L1**2, y_B**2 + x_C**2 == L2**2)
    m.inputs, m.outputs = [y_A], [y_B]
    return m


def same_boxes(a, b):
    return a.variables == b.variables and a.boxes.shape == b.boxes.shape and (a.boxes == b.boxes).all()


def test_one_that_is_built_is_the_one_that_is_read(three_slider, points):
    m = built()
    assert m.inputs == three_slider.inputs and m.outputs == three_slider.outputs
    assert [c[:2] for c in m.coordinates] == [c[:2] for c in three_slider.coordinates]
    assert same_boxes(m.solve("forward"), points)


def test_a_float_is_the_decimal_that_it_is_written_as():
    assert str(corank.as_expression(0.8)) == "0.8"
    assert same_boxes(built(L2=0.8).solve("forward"), built(L2=Fraction(4, 5)).solve("forward"))
    with pytest.raises(ValueError):
        corank.as_expression(float("nan"))


def test_numpys_numbers_are_numbers():
    numpy = pytest.importorskip("numpy")
    x = corank.Expression("x")
    assert str(numpy.float64(0.5) * x) == "0.5*x"
    assert str(x * numpy.int64(3)) == "x*3"
    assert isinstance(numpy.float64(0.5) + x, corank.Expression)


def test_operators_make_expressions_and_relations():
    x, y = corank.Expression("x"), corank.Expression("y")
    assert str(2 * x**2 - y / 3 + Fraction(1, 2)) == "2*x^2 - y/3 + 1/2"
    assert str(1 / x) == "1/x" and str(-x) == "-x" and str(2**x) == "2^x"
    assert str(corank.sin(x) + corank.sqrt(2) * corank.cos(x - corank.pi / 3)) == "sin(x) + sqrt(2)*cos(x - pi/3)"
    assert str(x <= y) == "x <= y" and str(x >= 1) == "x >= 1" and str(x == y) == "x = y"
    assert (x + y).same_as(corank.Expression("x + y")) and not (x + y).same_as(y + x)
    assert hash(x) == hash(corank.Expression("x"))
    with pytest.raises(TypeError, match="neither true nor false"):
        bool(x == y)


def test_constraints_of_sympy_are_those_of_texts(dextar):
    sympy = pytest.importorskip("sympy")
    q = J3x, J3y, t2, t3, t4, t5 = sympy.symbols("J3x J3y theta2 theta3 theta4 theta5")
    l, d = sympy.symbols("l d")
    sin, cos = sympy.sin, sympy.cos
    m = corank.Mechanism("dextar")
    m.constant("l", sympy.Rational(9, 10))
    m.constant("d", "1.18")
    for x in q[:2]:
        m.length(x.name, -2 * l, 2 * l)
    for x in q[2:]:
        m.angle(x.name, -sympy.pi, sympy.pi)
    m.constrain(
        d + l * cos(t2) + l * cos(t3) + l * cos(t4) - l * cos(t5),
        sympy.Eq(l * sin(t2) + l * sin(t3) + l * sin(t4), l * sin(t5)),
        sympy.Eq(J3x, d + l * cos(t2) + l * cos(t3)),
        sympy.Eq(J3y, l * sin(t2) + l * sin(t3)),
    )
    m.inputs, m.outputs = [t2, t5], [J3x, J3y]

    text = corank.Mechanism("dextar")
    text.constant("l", "9/10")
    text.constant("d", "1.18")
    for name in ("J3x", "J3y"):
        text.length(name, "-2*l", "2*l")
    for name in ("theta2", "theta3", "theta4", "theta5"):
        text.angle(name)
    text.constrain(
        "d + l*cos(theta2) + l*cos(theta3) + l*cos(theta4) - l*cos(theta5) = 0",
        "l*sin(theta2) + l*sin(theta3) + l*sin(theta4) = l*sin(theta5)",
        "J3x = d + l*cos(theta2) + l*cos(theta3)",
        "J3y = l*sin(theta2) + l*sin(theta3)",
    )
    text.inputs, text.outputs = ["theta2", "theta5"], ["J3x", "J3y"]

    assert polynomials(m.derive("forward", "cuik")) == polynomials(text.derive("forward", "cuik"))
    ours, theirs = m.solve("forward", sigma=0.05), text.solve("forward", sigma=0.05)
    assert ours.variables == theirs.variables and ours.complete and theirs.complete
    assert set(ours.counts) == set(theirs.counts) == {"regular"}


def polynomials(text):
    """The equations of a system, each up to its sign, whatever the order of terms."""
    import sympy

    found = set()
    for line in text.split("[SYSTEM EQS]")[1].splitlines():
        line = line.split("%")[0].strip().rstrip(";")
        if "=" not in line or "<" in line or ">" in line:
            continue
        left, right = (sympy.sympify(side.replace("^", "**"), rational=True) for side in line.split("="))
        p = sympy.expand(left - right)
        found.add(frozenset({p, -p}))
    assert len(found) > 10
    return found


def test_sympys_functions_and_roots_are_exact():
    sympy = pytest.importorskip("sympy")
    x = sympy.Symbol("x")
    assert str(corank.as_expression(sympy.sqrt(2) / 2)) in ("1/2*sqrt(2)", "sqrt(2)*(1/2)", "sqrt(2)*1/2", "1/2*sqrt(2)")
    assert str(corank.as_expression(sympy.cos(x) ** 2)) == "cos(x)^2"
    assert str(corank.as_relation(sympy.Ge(x, 1))) == "x >= 1"
    with pytest.raises(TypeError, match="<= or >="):
        corank.as_relation(sympy.Lt(x, 1))
    with pytest.raises(TypeError, match="truth value"):
        corank.as_relation(sympy.cos(x) == 1)
    with pytest.raises(corank.ModelError, match="gamma"):
        corank.as_expression(sympy.gamma(x))


def test_a_fault_in_a_file_is_said_with_file_line_and_column(tmp_path):
    path = tmp_path / "faulty.cuik"
    path.write_text("[SYSTEM VARS]\nx : [-1, 1]\n[SYSTEM EQS]\nx^2 + ) = 1;\n")
    with pytest.raises(corank.ModelError) as caught:
        corank.load(path)
    assert caught.value.file == str(path) and caught.value.line == 4 and caught.value.column == 7
    again = pickle.loads(pickle.dumps(caught.value))
    assert (again.file, again.line, again.column, str(again)) == (str(path), 4, 7, str(caught.value))
    assert isinstance(caught.value, ValueError)


def test_an_unknown_name_in_a_built_mechanism_is_refused_when_it_is_asked():
    m = corank.Mechanism()
    m.length("x", -1, 1)
    m.constrain("x^2 + z^2 = 1")
    with pytest.raises(corank.ModelError, match="z"):
        m.solve()


def test_a_taken_name_is_refused():
    m = corank.Mechanism()
    m.length("x", -1, 1)
    with pytest.raises(corank.ModelError, match="x"):
        m.angle("x")
    with pytest.raises(ValueError, match="already"):
        three = built()
        three.inputs = ["x_C"]


def test_a_file_that_is_missing_is_a_model_error():
    with pytest.raises(corank.ModelError, match="nowhere.cuik"):
        corank.load("nowhere.cuik")


def test_constants_get_other_values(three_slider):
    same = three_slider.with_constants(L2="1")
    assert len(same.solve("forward").points) == 6
    assert len(three_slider.solve("forward").points) == 8, "the first one is as it was"
    assert same.constant_values["L2"] == 1.0
    assert len(built().with_constants(L2=1).solve("forward").points) == 6
    with pytest.raises(corank.ModelError, match="L9"):
        three_slider.with_constants(L9=1)


def test_a_text_with_links_is_a_robot():
    text = """[LINKS]
base   : point O (0, 0, 0)  point C (2, 0, 0)
crank  : point E (1, 0, 0)
rocker : point F (0, 3/2, 0)
[JOINTS]
revolute drive : base O + (0, 0, 1)  crank (0, 0, 0) + (0, 0, 1)   actuated
revolute swing : base C + (1, 0, 0)  rocker (0, 0, 0) + (1, 0, 0)
sph_sph  rod   : crank E  rocker F   length 2
[OUTPUTS]
swing : joint swing
"""
    m = corank.parse(text, "rssr")
    assert m.robot == "spatial, 3 links, mobility 1"
    r = m.solve("forward")
    assert [p.verdict for p in r.points] == ["isolated"] * 4
    assert "pi" in {str(p["swing"]) for p in r.points} and r.summary["points"][0]["joints"]
    again = pickle.loads(pickle.dumps(m))
    assert again.robot == m.robot and same_boxes(again.solve("forward"), r)
    with pytest.raises(corank.ModelError, match="links and joints"):
        m.length("x", 0, 1)


def test_urdf_takes_a_companion(models):
    robots = models.parent / "tests" / "data" / "urdf"
    files = sorted(robots.glob("*.loops")) if robots.exists() else []
    if not files:
        files = sorted((models.parent / "tests").rglob("*.loops"))
    assert files
    m = corank.load(files[0].with_suffix(".urdf"), loops=files[0])
    assert m.robot and pickle.loads(pickle.dumps(m)).robot == m.robot


def test_pickles_are_the_same_mechanism(dextar):
    for m in (dextar, built(), built().with_constants(L2="3/5"), dextar.with_constants(l2="4/5")):
        again = pickle.loads(pickle.dumps(m))
        assert again.text == m.text and again.name == m.name and again.inputs == m.inputs
        assert again.constant_values == m.constant_values


def test_derive_says_what_the_command_line_says(dextar):
    text = dextar.derive("forward")
    assert "xi1" in text and "L_y" in text
    assert "\\begin" in dextar.derive("inverse", "latex")
    system = corank.parse(dextar.derive("forward", "cuik"), "system")
    assert system.inputs == [] and len(system.coordinates) == 14
    with pytest.raises(ValueError, match="format"):
        dextar.derive("forward", "html")


def test_a_set_that_is_none_is_refused_with_those_that_are(dextar):
    with pytest.raises(ValueError, match="forward"):
        dextar.solve("sideways")
    with pytest.raises(ValueError, match="its set is"):
        dextar.solve()
    with pytest.raises(corank.OptionError) as caught:
        dextar.solve("forward", sigma=-1)
    assert caught.value.option == "sigma"
    assert pickle.loads(pickle.dumps(caught.value)).option == "sigma"


def test_a_plain_system_is_solved_without_a_set():
    m = corank.parse("[SYSTEM VARS]\nx : [-2, 2]\n[SYSTEM EQS]\nx^2 = 2;\n")
    assert [str(p["x"]) for p in m.solve().points] == ["-sqrt(2)", "sqrt(2)"]
    with pytest.raises(ValueError, match="plain system"):
        m.solve("forward")


def test_a_notebook_shows_its_equations_in_latex(dextar):
    html = dextar._repr_html_()
    assert "\\begin{gathered}" in html and "\\theta_{2}" in html and "input" in html
    assert "\\theta_{2}" in corank.Expression("cos(theta2)/2")._repr_latex_()


def boxes_of(mechanism):
    return len(mechanism.solve("forward", sigma=0.1, threads=1))


@pytest.mark.parametrize("start", ["fork", "spawn"])
def test_mechanisms_go_to_other_processes_which_solve_them(dextar, start):
    expected = boxes_of(dextar)  # the parent has its threads already
    with multiprocessing.get_context(start).Pool(1) as pool:
        assert pool.map_async(boxes_of, [dextar, dextar]).get(60) == [expected] * 2
