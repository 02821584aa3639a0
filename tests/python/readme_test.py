"""What README and doc/python.md print is what comes."""

import contextlib
import io
import os
import pathlib
import re

import pytest

SOURCE = pathlib.Path(os.environ["CORANK_SOURCE_DIR"])

for package in ("matplotlib", "pandas", "sympy"):
    pytest.importorskip(package)


def run(program, folder, monkeypatch, names=None):
    """What the program prints, with the models beside it."""
    monkeypatch.chdir(folder)
    if not (folder / "models").exists():
        (folder / "models").symlink_to(SOURCE / "models")
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(program, "documentation", "exec"), {} if names is None else names)
    return printed.getvalue()


def test_the_lines_of_the_readme_print_what_stands_there(tmp_path, monkeypatch):
    text = (SOURCE / "README.md").read_text().split("<!-- readme_python")[1]
    program = re.search(r"```python\n(.*?)```", text, re.S).group(1)
    expected = re.search(r"```\n\n```\n(.*?)```", text, re.S).group(1)
    assert run(program, tmp_path, monkeypatch) == expected
    portrait = (tmp_path / "portrait.png").read_bytes()
    assert portrait.startswith(b"\x89PNG") and len(portrait) > 10_000


def test_the_programs_of_the_guide_print_what_stands_there(tmp_path, monkeypatch):
    """They share their names, one after the other; a block after a program is what it prints."""
    text = (SOURCE / "doc" / "python.md").read_text()
    names = {}
    blocks = re.findall(r"```python\n(.*?)```(?:\n\n```\n(.*?)```)?", text, re.S)
    assert len(blocks) > 5
    for program, expected in blocks:
        printed = run(program, tmp_path, monkeypatch, names)
        assert printed == expected, program
