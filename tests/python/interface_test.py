"""The package shows what it says that it shows: stubs, docstrings, types."""

import ast
import doctest
import inspect
import os
import pathlib
import subprocess
import sys

import pytest

import corank
from corank import _corank

STUBS = pathlib.Path(corank.__file__).parent / "_corank.pyi"


def names_in(body):
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name
        elif isinstance(node, ast.AnnAssign):
            yield node.target.id


def test_the_stubs_name_what_the_module_has():
    tree = ast.parse(STUBS.read_text())
    stubs = {n for n in names_in(tree.body) if not n.startswith("_") or n == "__version__"}
    assert stubs == {n for n in dir(_corank) if not n.startswith("_")} | {"__version__"}
    for node in tree.body:
        if not isinstance(node, ast.ClassDef):
            continue
        type_ = getattr(_corank, node.name)
        has = {n for n in vars(type_) if not n.startswith("_")}
        assert {n for n in names_in(node.body) if not n.startswith("_")} == has, node.name


def imports_of(body, names):
    """The modules of the package that are imported at some time, by names without the package's; annotations need none."""
    for node in body:
        if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
            yield from imports_of(node.orelse, names)
            continue
        if isinstance(node, ast.ImportFrom) and node.level:
            module = node.module or ""
            yield from (n for n in [module, *(f"{module}.{a.name}".strip(".") for a in node.names)] if n in names)
        yield from imports_of(ast.iter_child_nodes(node), names)


def test_no_module_imports_itself_by_way_of_others():
    folder = STUBS.parent
    names = {".".join(p.relative_to(folder).with_suffix("").parts) for p in folder.glob("*.py")} - {"__init__"}
    uses = {n: set(imports_of(ast.parse((folder / f"{n}.py").read_text()).body, names)) for n in names}
    assert uses["mechanism"] >= {"analyses", "result"}
    while uses:
        free = {n for n, used in uses.items() if not used & uses.keys()}
        assert free, f"a circle among {sorted(uses)}"
        uses = {n: used for n, used in uses.items() if n not in free}


def public():
    for name in corank.__all__:
        item = getattr(corank, name)
        if inspect.isclass(item) or inspect.isfunction(item):
            yield name, item


@pytest.mark.parametrize("name, item", list(public()))
def test_every_public_name_is_documented_and_typed(name, item):
    assert inspect.getdoc(item), name
    members = vars(item).items() if inspect.isclass(item) and item.__module__ != "corank._corank" else []
    for member, value in members:
        if member.startswith("_") or not (inspect.isfunction(value) or isinstance(value, property)):
            continue
        function = value.fget if isinstance(value, property) else value
        assert inspect.getdoc(function), f"{name}.{member}"
        assert "return" in function.__annotations__, f"{name}.{member}"
    if inspect.isfunction(item):
        assert "return" in item.__annotations__, name


def test_the_examples_of_docstrings_print_what_stands_there(models, monkeypatch):
    monkeypatch.chdir(models.parent)
    tried = 0
    for module in [corank] + [m for m in vars(corank).values() if inspect.ismodule(m) and m.__name__.startswith("corank.")]:
        result = doctest.testmod(module, extraglobs={"Mechanism": corank.Mechanism})
        assert result.failed == 0, module.__name__
        tried += result.attempted
    assert tried >= 6


def test_the_sets_and_verdicts_are_those_of_corank():
    assert list(corank.SETS)[:3] == ["cspace", "forward", "inverse"] and "boundary" in corank.SETS
    assert corank.USUAL_SETS == ("cspace", "forward", "inverse", "cspace-singular")
    assert corank.VERDICTS[0] == "regular" and corank.VERDICTS[-1] == "pending"
    assert corank.__version__.count(".") == 2


def test_a_checker_of_types_finds_the_users_fault_and_no_other(tmp_path):
    pytest.importorskip("mypy")
    package = pathlib.Path(__file__).resolve().parents[2] / "python" / "corank"
    user = tmp_path / "user.py"
    user.write_text(
        "import corank\nr: corank.Result = corank.load('m.cuik').solve('forward', sigma=0.1)\n"
        "n: int = r.counts['regular']\nwrong: int = r\n"
    )
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "mypy",
            "--ignore-missing-imports",
            "--follow-imports=skip",
            "--cache-dir",
            str(tmp_path),
            str(package),
            str(user),
        ],
        capture_output=True,
        text=True,
        check=False,
        cwd=package.parent,
    )
    faults = [line for line in done.stdout.splitlines() if "error" in line]
    assert "user.py:4: error: Incompatible types" in faults[0] and len(faults) == 2, done.stdout


@pytest.mark.parametrize(
    "package, use", [("sympy", "expression"), ("distributed", "cluster"), ("numpy", "boxes"), ("numpy", "cluster")]
)
def test_what_is_not_installed_is_named_with_its_package(package, use):
    program = {
        "expression": "r = corank.load('models/dextar.cuik').solve('inverse', sigma=0.1); r.exact_points",
        "cluster": "import corank.cluster",
        "boxes": "corank.load('models/three_slider.cuik').solve('inverse').boxes",
    }[use]
    done = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.modules['{package}'] = None; import corank; {program}"],
        cwd=os.environ["CORANK_SOURCE_DIR"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode != 0
    wanted = "'numpy<2'" if package == "numpy" else package
    assert (
        f"ModuleNotFoundError: this needs the Python package {package}: apt-get install python3-{package}, or pip install {wanted}\n"
        in done.stderr
    )
