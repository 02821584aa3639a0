"""The notebooks run, and say and draw what doc/notebooks/ shows."""

import io
import os
import pathlib
import sys

import numpy
import pytest

for package in ("nbclient", "nbconvert", "ipykernel", "matplotlib", "pandas", "sympy"):
    pytest.importorskip(package)

SOURCE = pathlib.Path(os.environ["CORANK_SOURCE_DIR"])
NOTEBOOKS = sorted((SOURCE / "python" / "notebooks").glob("*.ipynb"))
sys.path.insert(0, str(SOURCE / "python" / "notebooks"))
os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"
os.environ.pop("MPLBACKEND", None)  # a kernel has its own

import render  # noqa: E402


def pixels(data, cells=48):
    """A picture as the mean colours of so many cells on each side: what it shows, whatever the smoothing of its lines."""
    from matplotlib import image

    picture = image.imread(io.BytesIO(data))[..., :3]
    rows, columns = (numpy.linspace(0, n, cells + 1).astype(int)[:-1] for n in picture.shape[:2])
    sums = numpy.add.reduceat(numpy.add.reduceat(picture, rows, axis=0), columns, axis=1)
    areas = numpy.outer(numpy.diff([*rows, picture.shape[0]]), numpy.diff([*columns, picture.shape[1]]))
    return sums / areas[..., None]


def test_a_picture_with_another_curve_is_another_picture():
    files = sorted((SOURCE / "doc" / "notebooks").rglob("*.png"))
    assert len(files) > 5
    first, second = (pixels(f.read_bytes()) for f in files[:2])
    assert abs(first - second).mean() > 0.01 and abs(first - first).mean() == 0


@pytest.mark.parametrize("path", NOTEBOOKS, ids=[p.stem for p in NOTEBOOKS])
def test_a_notebook_runs_and_shows_what_is_in_the_documentation(path):
    text, pictures = render.markdown(render.run(path, SOURCE), path.stem)
    known = SOURCE / "doc" / "notebooks"
    expected = (known / f"{path.stem}.md").read_text()

    def headings_and_code(t):
        return [line for line in t.splitlines() if not line.startswith("    ")]

    assert headings_and_code(text) == headings_and_code(expected)
    assert pictures and set(pictures) == {str(f.relative_to(known)) for f in (known / f"{path.stem}_files").iterdir()}
    for name, data in pictures.items():
        difference = abs(pixels(data) - pixels((known / name).read_bytes())).mean()
        assert difference < 0.005, f"{name} differs by {difference}; scripts/render_notebooks.sh makes it anew"


def test_the_notebooks_are_kept_without_outputs():
    import nbformat

    assert len(NOTEBOOKS) == 4
    for path in NOTEBOOKS:
        for cell in nbformat.read(path, as_version=4).cells:
            assert not cell.get("outputs") and cell.get("execution_count") is None, path.name
