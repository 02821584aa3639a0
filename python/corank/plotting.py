"""Boxes in matplotlib's axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Sequence

from . import _corank

if TYPE_CHECKING:
    import numpy as np

    from .result import Result
else:
    from .optional import numpy as np

# The corners of a rectangle and of a box's six faces: for each axis 0 its lower end, 1 its upper.
_SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
_FACES = [
    [(end, a, b) if k == 0 else (a, end, b) if k == 1 else (a, b, end) for a, b in _SQUARE]
    for end in range(2)
    for k in range(3)
]


def plot(
    results: Sequence["Result"],
    *axes: str,
    ax: Any = None,
    color: str = "set",
    legend: bool = True,
    outline: float = 0.8,
    **style: Any,
) -> Any:
    """Draws all boxes of one or several results.

    Args:
        results: the results. They are drawn in the order of a report, C-space below its singularities.
        axes: the names of two coordinates, or of three for 3-D axes. Angles are in radians.
        ax: axes of matplotlib; None: new axes.
        color: what the colours distinguish: "set", "verdict" or "plain".
        legend: draw a legend if there are several colours.
        outline: the width, in points, of the line about a box, which makes small boxes visible.
        style: further options of matplotlib's collections, such as alpha or rasterized.

    Returns:
        The axes. Each layer is one collection, whose label is that of the legend.
    """
    if len(axes) not in (2, 3):
        raise ValueError("the names of two or three coordinates are expected")
    names, layers, hatches = _corank.geometry([r._core for r in results], list(axes), color)
    if ax is None:
        from matplotlib import pyplot

        ax = pyplot.figure().add_subplot(projection="3d" if len(axes) == 3 else None)
    for label, rgb, opacity, sides, _ in layers:
        options = {"facecolors": rgb, "edgecolors": rgb, "linewidths": outline, "alpha": opacity, "label": label, **style}
        ax.add_collection(_solids(sides, options) if len(axes) == 3 else _rectangles(sides, options))
    if hatches:
        ax.add_collection(_strokes(hatches, layers))
    _finish(ax, names, layers, legend)
    return ax


def _rectangles(sides: np.ndarray, options: Any) -> Any:
    from matplotlib.collections import PolyCollection

    square = np.array(_SQUARE)
    corners = np.stack([sides[:, k][:, square[:, k]] for k in range(2)], axis=-1)
    return PolyCollection(corners, closed=True, **options)


def _solids(sides: np.ndarray, options: Any) -> Any:
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    faces = np.array(_FACES)
    corners = np.stack([sides[:, k][:, faces[:, :, k]] for k in range(3)], axis=-1)
    return Poly3DCollection(corners.reshape(-1, 4, 3), **options)


def _strokes(hatches: Any, layers: Any) -> Any:
    """To the side of a barrier where the output cannot go; one where many would stand side by side."""
    from matplotlib.collections import LineCollection

    boxes = np.concatenate([sides for _, _, _, sides, _ in layers])
    extent = boxes[:, :, 1].max(axis=0) - boxes[:, :, 0].min(axis=0)
    extent[extent == 0] = 1.0
    start, direction = (np.array([h[k] for h in hatches]) for k in range(2))
    cells = np.floor(start / (0.03 * extent)).astype(np.int64)
    kept = np.unique(cells, axis=0, return_index=True)[1]
    start, direction = start[kept], direction[kept]
    length = np.linalg.norm(direction / extent, axis=1, keepdims=True)
    length[length == 0] = 1.0
    lines = np.stack([start, start + 0.025 * direction / length], axis=1)
    return LineCollection(lines, colors="0.3", linewidths=0.8, label="_strokes")


def _finish(ax: Any, names: Any, layers: Any, legend: bool) -> None:
    labels = [f"{function} {name}" if function else name + (" [rad]" if angle else "") for name, function, angle in names]
    ax.set_xlabel(labels[0])
    ax.set_ylabel(labels[1])
    if len(labels) == 3:
        ax.set_zlabel(labels[2])
        for k, axis in enumerate("xyz"):
            ends = [sides[:, k] for _, _, _, sides, _ in layers if len(sides)]
            if ends:
                getattr(ax, f"set_{axis}lim")(min(e.min() for e in ends), max(e.max() for e in ends))
    else:
        ax.autoscale_view()
        if len({angle for _, _, angle in names}) == 1:
            ax.set_aspect("equal", adjustable="datalim")
    if legend and len(layers) > 1 and len(labels) == 2:
        ax.legend()
