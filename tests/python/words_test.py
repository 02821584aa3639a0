"""Errors and tables name the arguments of Python, not the options of the command line."""

import re

import pytest

import corank
from corank.errors import in_python

from conftest import SOURCE

LIBRARY = ("core", "certify", "check", "symbolic", "solve", "result", "kinematics", "study", "analyze")
TEXT = re.compile(r'"((?:[^"\\]|\\.)*)"')


def texts_with_options():
    for folder in LIBRARY:
        for path in sorted((SOURCE / folder).rglob("*.cc")):
            code = "\n".join(line.split("// ")[0] for line in path.read_text(encoding="utf-8").splitlines())
            code = re.sub(r'"\s*\n\s*"', "", code)  # literals that follow each other are one
            yield from (t for t in TEXT.findall(code) if re.search(r"(?<![\w-])--[a-z]|(?<!\w)-D\b", t))


# What is put behind at run time.
BEHIND = {"--orientation-of ": "x", "--at ": "x=0.5", "--map ": "x=[0,1],…", "--outputs": ": no", "-D ": "x: no"}


def test_no_text_of_the_library_names_an_option_that_python_has_not():
    texts = list(texts_with_options())
    assert len(texts) > 15
    for text in texts:
        whole = text.replace("{}", "x").replace("{0:g}", "1e-06").replace("{0}", "2")
        whole += next((more for end, more in BEHIND.items() if whole.endswith(end)), "")
        left = re.sub(r"corank solve --[a-z-]+", "", in_python(whole))
        assert not re.search(r"(?<![\w-])--[a-z]|(?<!\w)-D\b", left), text


def test_errors_name_the_arguments(dextar, three_slider, models):
    with pytest.raises(corank.ModelError, match=re.escape('within=("x", "y")')):
        dextar.clearance({"J3x": 0.5, "J3y": 1}, within=[])
    with pytest.raises(corank.ModelError, match=re.escape('at={"J3y": 0.5}')):
        dextar.clearance({"J3x": 0.5}, within=["J3x", "J3y"])
    with pytest.raises(corank.ModelError, match=re.escape('region=("x", "y")')):
        dextar.clearance_map({"J3x": (0, 1)})
    with pytest.raises(corank.ModelError, match="^l2:"):
        dextar.with_constants(l2="1/nothing").solve("forward")
    with pytest.raises(ValueError, match="start_mode"):
        dextar.path({"J3x": 0.5, "J3y": 1}, {"J3x": 0.7, "J3y": 1}, end_mode=1)
    with pytest.raises(corank.ModelError) as caught:
        three_slider.map(over={"L1": (1, 2), "L2": (1, 2)}, count="aspects", fixed={"y_A": 0})
    assert "no fixed" in str(caught.value) and "--" not in str(caught.value)


def test_tables_name_the_arguments():
    m = corank.Mechanism("rounded")
    x, y = m.length("x", -2, 2), m.length("y", -2, 2)
    m.constrain("x^2 + y^2 = 1", "2*x^2 + 2*y^2 = 2.0000001", "x = y")
    table = str(m.solve(tolerance=0))
    assert "use tolerance=1e-06, or write exact numbers" in table and "--" not in table


def test_other_texts_stay_as_they_are():
    for text in ("a--b", "x - --y", "my--in file.cuik: expected 'z'", "corank solve --json"):
        assert in_python(text) == text
