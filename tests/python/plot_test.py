"""Plots, compared by what is in them."""

import numpy
import pytest

import corank

pytest.importorskip("matplotlib")
from matplotlib import pyplot  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402


@pytest.fixture
def ax():
    figure, ax = pyplot.subplots()
    yield ax
    pyplot.close(figure)


def corners(collection):
    """Of each polygon its lower and upper ends: n × 2 × 2."""
    vertices = numpy.array([path.vertices for path in collection.get_paths()])
    return numpy.stack([vertices.min(axis=1), vertices.max(axis=1)], axis=-1)


def test_every_box_is_drawn_where_it_is(forward, ax):
    assert forward.plot("J3x", "J3y", ax=ax) is ax
    (layer,) = ax.collections
    assert isinstance(layer, PolyCollection)
    drawn = corners(layer)
    expected = numpy.stack([forward["J3x"], forward["J3y"]], axis=1)
    assert drawn.shape == expected.shape and (drawn == expected).all()
    assert ax.get_xlabel() == "J3x" and ax.get_aspect() == 1.0


def test_layers_have_the_colours_and_names_of_a_report(dextar, forward, ax):
    inverse = dextar.solve("inverse", sigma=0.05)
    corank.plot([inverse, forward], "J3x", "J3y", ax=ax)
    labels = [layer.get_label() for layer in ax.collections]
    assert labels == ["inverse locus", "forward locus"] or labels == ["forward locus", "inverse locus"]
    red = ax.collections[labels.index("forward locus")].get_facecolor()[0]
    assert red[0] > 0.6 > red[2]
    assert [t.get_text() for t in ax.get_legend().get_texts()] == labels


def test_an_angle_across_the_end_of_its_range_is_drawn_in_pieces(dextar, ax):
    r = dextar.solve("inverse", sigma=0.1)
    r.plot("theta2", "theta5", ax=ax)
    drawn = numpy.concatenate([corners(layer) for layer in ax.collections])
    assert len(drawn) >= len(r) and (abs(drawn.mean(axis=2)) < 3.3).all()
    assert "[rad]" in ax.get_xlabel()


def test_verdicts_can_be_told_apart(dextar, ax):
    r = dextar.solve("inverse", sigma=0.1, kernel="right")
    r.plot("J3x", "J3y", ax=ax, color="verdict")
    assert {layer.get_label() for layer in ax.collections} >= {"regular", "undecided"}
    assert sum(len(layer.get_paths()) for layer in ax.collections) == len(r)


def test_three_axes_have_the_faces_of_boxes(forward):
    ax = forward.plot("J3x", "J3y", "c_theta2")
    (layer,) = ax.collections
    assert len(layer._vec[0]) == len(forward) * 6 * 4 or len(layer._segslices) == 6 * len(forward)
    pyplot.close(ax.figure)


def test_barriers_have_strokes(models, ax):
    r = corank.load(models / "planar" / "arm_2r_limits.cuik").solve("boundary")
    names = r._core.outputs
    r.plot(*names, ax=ax)
    assert any(isinstance(layer, LineCollection) for layer in ax.collections)


def test_a_coordinate_that_is_none_is_refused(forward, ax):
    with pytest.raises(ValueError, match="nowhere"):
        forward.plot("J3x", "nowhere", ax=ax)
    with pytest.raises(ValueError, match="two or three"):
        forward.plot("J3x", ax=ax)


def test_a_portrait_for_a_paper_is_written(forward, tmp_path):
    for end in ("svg", "pdf", "png"):
        forward.portrait(tmp_path / f"portrait.{end}", "J3x", "J3y", title="forward")
    assert "forward" in (tmp_path / "portrait.svg").read_text()
    assert (tmp_path / "portrait.png").read_bytes().startswith(b"\x89PNG")
