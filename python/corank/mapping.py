"""Numbers over a plane of two parameters, constants or coordinates of a model."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

from . import _corank
from .analyses import Analysis
from .errors import Interrupted, deliver
from .expression import ExpressionLike, RangeLike, _ranges, as_expression
from .optional import require
from .options import ask
from .progress import ProgressOption, Shown
from .result import Certified

if TYPE_CHECKING:
    import numpy
    import pandas
    from matplotlib.axes import Axes

    from .mechanism import Mechanism


class ParameterMap(Analysis, Certified):
    """A number over a plane of two parameters, cell by cell.

    Attributes:
        names: the names of the two parameters.
        region: (lower, upper) of each parameter.
        count: what was counted.
        resolution: the number of the narrowest cells along each side.
        shares: for each number, the share of the plane's area where it is proven; for answers at centres, the share of the
            cells.
        proven_share: the share of the plane's area where the number is known for every value.
        complete: was the whole plane examined?
        require: what every solution is to meet; empty if nothing is required.
        tolerances: (lower, upper) of each constant that has a tolerance: what is proven holds for every robot within them.
        standings: with requirements, the shares of the area where they are "satisfied", "violated" and "open".
        aspects: with map(cusps=True), the number of aspects as text, if it was found.
        cusps_known, nodes_known: are there no others than cusps() and nodes() in the plane?
        boundary_known: do the boxes of boundary() hold all values in undecided cells at which two solutions meet?
    """

    _missing = "there is no certificate: map() needs certificate=True"

    def __init__(self, text: str, table: str, file: Optional["_corank.MapFile"] = None) -> None:
        super().__init__(text, table)
        self._file = file
        x, y = self.data["over"]
        self.names: Tuple[str, str] = (x, y)
        self.region: Tuple[Tuple[float, float], ...] = tuple((lo, hi) for lo, hi in self.data["over"].values())
        self.count: str = self.data["count"]
        self.resolution: int = self.data["resolution"]
        self.shares = {int(n): share for n, share in self.data["shares"].items()}
        self.proven_share: float = self.data["proven_share"]
        self.require: List[str] = self.data.get("require", [])
        self.tolerances: Dict[str, Tuple[float, float]] = {n: (lo, hi) for n, (lo, hi) in self.data["tolerances"].items()}
        self.standings: Dict[str, float] = self.data.get("standings", {})
        self.boundary_known: bool = self.data["boundary_known"]
        self.aspects: Optional[str] = self.data["aspects"]
        self.cusps_known: bool = self.data["cusps_known"]
        self.nodes_known: bool = self.data["nodes_known"]

    def to_pandas(self) -> "pandas.DataFrame":
        """Returns a data frame with a row for each cell: its lower and upper ends, its kind and the numbers `count` and
        `at_centre`, or NA. Kinds: "proven": `count` holds for every value in the cell; "undecided"; "centre": `at_centre` is
        proven for the centre only; "pending": not examined. With requirements there is the column `standing`, too:
        "satisfied", "violated", "open" or NA."""
        pandas = require("pandas")

        x, y = self.names
        columns = [f"{x}_lo", f"{x}_hi", f"{y}_lo", f"{y}_hi", "kind", "count", "at_centre"]
        if self.require:
            columns.append("standing")
        cells = [cell + [None] * (len(columns) - len(cell)) for cell in self.data["cells"]]
        frame = pandas.DataFrame(cells, columns=columns)
        return frame.astype({"count": "Int64", "at_centre": "Int64"})

    def boundary(self) -> "numpy.ndarray":
        """Returns the boxes where two solutions may meet: an array of shape (n, 5), with the lower and upper ends in both
        parameters, and 1 if the box is proven to hold a piece of the curve on which they meet, else 0."""
        return self._boxes("boundary")

    def cusps(self) -> "numpy.ndarray":
        """Returns the cusps of that curve, which map(cusps=True) finds, in the same way: 1 if the box is proven to hold one."""
        return self._boxes("cusps")

    def nodes(self) -> "numpy.ndarray":
        """Returns the nodes of that curve, likewise."""
        return self._boxes("nodes")

    def _boxes(self, name: str) -> "numpy.ndarray":
        numpy = require("numpy")
        return numpy.array(self.data[name] or [], dtype=float).reshape(-1, 5)

    def grid(self) -> "numpy.ma.MaskedArray":
        """Returns the numbers as an array of shape (resolution, resolution), the second parameter along the first axis, both
        ascending. It is masked where nothing is proven for the whole cell (for answers at centres: for the centre)."""
        numpy = require("numpy")
        numbers = numpy.ma.masked_all((self.resolution, self.resolution), dtype=int)
        (x0, x1), (y0, y1) = self.region
        for xl, xu, yl, yu, kind, count, at_centre in (cell[:7] for cell in self.data["cells"]):
            number = at_centre if kind == "centre" else count
            if number is None:
                continue
            columns = [round((x - x0) / (x1 - x0) * self.resolution) for x in (xl, xu)]
            rows = [round((y - y0) / (y1 - y0) * self.resolution) for y in (yl, yu)]
            numbers[rows[0] : rows[1], columns[0] : columns[1]] = number
        return numbers

    def at(self, x: float, y: float) -> Union[int, bool, None]:
        """Returns the number that is proven for the cell with these values; None if no number is.

        With requirements: True if every solution there meets them; False if one does not, or if there is no solution; None
        if neither is proven for the cell."""
        for xl, xu, yl, yu, _, count, _, *standing in self.data["cells"]:
            if not (xl <= x <= xu and yl <= y <= yu) or count is None:
                continue
            if not self.require:
                return count
            if standing != ["open"]:
                return standing == ["satisfied"]
        return None

    def _classes(self) -> List[Any]:
        """Returns the cells with 0 (no solution), 1 (violated) or 2 (satisfied) for the count, None if that is open."""
        number = {"satisfied": 2, "violated": 1}
        return [[*c[:5], 0 if c[5] == 0 else number.get(c[-1]), None] for c in self.data["cells"]]

    def plot(self, ax: Optional["Axes"] = None) -> "Axes":
        """Draws regions in a colour for each number, numbers that are known only at centres as dots, and the curve on which
        solutions meet in a dark colour. With requirements: regions where they are satisfied, violated and open."""
        plt = require("matplotlib.pyplot")
        from matplotlib.collections import PatchCollection
        from matplotlib.patches import Patch, Rectangle

        axes: Any = ax if ax is not None else plt.subplots()[1]
        cells = self._classes() if self.require else self.data["cells"]
        words = ["no solution", "violated by one", "satisfied by all"] if self.require else None
        numbers = sorted({c[5] if c[5] is not None else c[6] for c in cells} - {None})
        shades = plt.get_cmap("YlGnBu")
        colors = {n: shades(0.12 + 0.63 * k / max(1, len(numbers) - 1)) for k, n in enumerate(numbers)}

        def add(boxes: List[Any], color: Any, shrink: float = 1.0) -> None:
            rectangles = []
            for xl, xu, yl, yu in (box[:4] for box in boxes):
                w, h = (xu - xl) * shrink, (yu - yl) * shrink
                rectangles.append(Rectangle(((xl + xu - w) / 2, (yl + yu - h) / 2), w, h))
            axes.add_collection(PatchCollection(rectangles, facecolor=color, edgecolor=color, linewidth=0.1))

        legend = []
        for n in reversed(numbers):
            add([c for c in cells if c[5] == n], colors[n])
            legend.append(Patch(facecolor=colors[n], label=words[n] if words else str(n)))
        open_cells = [c for c in cells if c[5] is None]
        if open_cells:
            add(open_cells, "0.85")
            label = "open" if words else "not known for whole cells; dots: at the centre"
            legend.append(Patch(facecolor="0.85", label=label))
        for n in numbers:
            add([c for c in open_cells if c[6] == n], colors[n], 0.5)
        proven = [b for b in self.data["boundary"] if b[4]]
        add([b for b in self.data["boundary"] if not b[4]], "0.55")
        add(proven, "0.13")
        if proven:
            legend.append(Patch(facecolor="0.13", label="solutions meet"))
        for kind, color in (("cusps", "tab:red"), ("nodes", "tab:green")):
            points = [b for b in self.data[kind] or [] if b[4]]
            if points:
                x, y = [(b[0] + b[1]) / 2 for b in points], [(b[2] + b[3]) / 2 for b in points]
                legend.append(axes.plot(x, y, "o", color=color, markersize=4, label=kind)[0])
        axes.set_xlim(*self.region[0])
        axes.set_ylim(*self.region[1])
        axes.set_xlabel(self.names[0])
        axes.set_ylabel(self.names[1])
        axes.legend(handles=legend, loc="upper left", bbox_to_anchor=(1.01, 1), borderaxespad=0, fontsize="small")
        return axes


def map(
    self: "Mechanism",
    over: Mapping[str, RangeLike],
    *,
    set: Optional[str] = None,
    fixed: Optional[Mapping[str, ExpressionLike]] = None,
    require: Union[str, Sequence[str], None] = None,
    orientation: Optional[str] = None,
    orientation_of: str = "",
    count: str = "solutions",
    resolution: int = 64,
    boundary: bool = True,
    cusps: bool = False,
    certificate: bool = False,
    threads: int = 0,
    time_limit: float = 0,
    progress: ProgressOption = None,
    client: Any = None,
) -> ParameterMap:
    """Counts solutions over a plane of two parameters, and proves the number cell by cell.

    Args:
        over: two constants or coordinates with their ranges: {"l2": ("1/2", "3/2"), "theta2": (-corank.pi, corank.pi)}.
        set: the set whose solutions are counted; they have to be isolated once the parameters have values. None: the
            configurations, or a plain system's solutions.
        fixed: coordinates that keep one value.
        require: what every solution is to meet, beside the mechanism's own requirements, as text or texts:
            "amplification(outputs) <= 2" (doc/as_built.md). at() then tells whether it does.
        orientation: of the hand of an arm of six revolute joints, such as "Rz(0.2)*Ry(pi/18)", whose postures are counted:
            two components of its position run, `fixed` says where the third one is.
        orientation_of: the link that `orientation` is for, if there are several.
        count: "solutions"; or "components", "aspects", "assembly-modes" or "working-modes" of all configurations, which are
            proven only at the centres of cells.
        resolution: the number of the narrowest cells along each side: a power of two from 8 to 1024.
        boundary: find the curve on which two solutions meet.
        cusps: find the cusps and nodes of that curve, and the number of aspects; over both outputs or both inputs of a
            mechanism of two degrees of freedom, all lengths.
        certificate: keep the proofs of the cells' numbers, for save() and verify(); only for "solutions" without `client`.
        threads: the number of threads; 0: one for each core. The map does not depend on it.
        time_limit: in seconds; 0: no limit.
        client: a client of dask.distributed whose workers do the map's parts (corank.cluster), each with one thread.

    Raises:
        ModelError: if the model does not give such a number.
        Interrupted: on Ctrl-C, with what is known by then; the rest is pending.
    """
    if certificate and (count != "solutions" or client is not None):
        raise ValueError('certificate: expected count="solutions" and no client')
    if cusps and (count != "solutions" or orientation is not None or client is not None):
        raise ValueError('cusps: expected count="solutions", no orientation and no client')
    if orientation is not None and (count != "solutions" or set is not None or require is not None):
        raise ValueError('orientation: expected count="solutions", no set and nothing required')
    if require is not None:
        if count != "solutions":
            raise ValueError('require: expected count="solutions"')
        self = self.with_requirements(*([require] if isinstance(require, str) else require))
    options = (count, resolution, boundary, orientation, orientation_of)
    values = [(name, as_expression(value)) for name, value in (fixed or {}).items()]
    core = _corank.ParameterMap(ask(self._core, set), _ranges(over), values, *options)
    if client is None:
        with Shown(progress) as show:
            data, text, file, raised = core.run(threads, certificate, cusps, time_limit, show)
        return deliver(ParameterMap(data, text, file), raised)

    from . import cluster  # needs a package that is not always there

    question = (self, set, dict(over), dict(fixed or {}), *options)
    tiles, whole = cluster.map_tiles(question, core.tiles, client, progress=progress)
    result = ParameterMap(*core.assemble(tiles))
    if not whole:
        raise Interrupted(result)
    return result
