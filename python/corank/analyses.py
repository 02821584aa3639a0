"""Proven answers about a mechanism as a whole: its shape, its pieces, its distance from singularities, its workspace's
area."""

from __future__ import annotations

import csv
import io
import json
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

from . import _corank
from ._corank import Expression
from .errors import deliver, in_python
from .expression import ExpressionLike, as_expression
from .optional import require
from .options import ask, make_options
from .point import Interval
from .progress import ProgressOption, Shown
from .result import Certified, Result

if TYPE_CHECKING:
    import pandas

    from .mechanism import Mechanism
    from .pathing import Path


class Bounds(NamedTuple):
    """Proven bounds of a number; at_most is None where no upper bound is known."""

    at_least: int
    at_most: Optional[int]

    @property
    def exact(self) -> bool:
        """Is the number known?"""
        return self.at_least == self.at_most


def _bounds(item: Dict[str, Any]) -> Bounds:
    return Bounds(item["at_least"], item["at_most"])


def _interval(item: Optional[Dict[str, Any]]) -> Tuple[Optional[float], Optional[float]]:
    return (None, None) if item is None else (item["lo"], item["hi"])


class Analysis:
    """The answer of an analysis. str() is the table that the command prints.

    Attributes:
        data: the JSON object that the command's --json prints, as Python's own values.
        complete: False if a limit or Ctrl-C ended the analysis; what it says is proven nevertheless.
    """

    def __init__(self, text: str, table: str) -> None:
        self.data: Dict[str, Any] = json.loads(text)
        self._table = table
        self.complete: bool = self.data["complete"]

    def __str__(self) -> str:
        return in_python(self._table)

    def __repr__(self) -> str:
        return f"<{type(self).__name__.lower()}: {' '.join(self._table.split())[:200]}>"


class Topology(Analysis):
    """The shape of a C-space.

    Attributes:
        dimension: the dimension of the C-space.
        smooth: is it proven to be a manifold without boundary in the search domain?
        components: the number of connected pieces.
        euler_characteristic: the Euler characteristic; None if it is not known.
        genus: the genus of each piece of a surface, ascending.
        reason: what is not known, and why.
        robots: as of Aspects.
    """

    def __init__(self, text: str, table: str) -> None:
        super().__init__(text, table)
        self.dimension: int = self.data["dimension"]
        self.smooth: bool = self.data["smooth"]
        self.components = _bounds(self.data["components"])
        self.euler_characteristic: Optional[int] = self.data["euler_characteristic"]
        self.genus: List[int] = self.data["genus"]
        self.reason: str = self.data["reason"]
        self.robots: Optional[Dict[str, Any]] = self.data.get("robots")


class Cusp(NamedTuple):
    """A cusp of the image of a singularity locus. Next to it, three configurations have the same inputs (forward locus) or
    the same outputs (inverse locus). A path about the cusp joins the outer two of them without a singularity.

    Attributes:
        locus: "forward" or "inverse".
        values: the configuration over the cusp, intervals by coordinate.
        around: the index, in Aspects.representatives, of the aspect that holds the outer two; None if it is not known.
        between: the index of the aspect that holds the third; None if it is not known.
    """

    locus: str
    values: Dict[str, Interval]
    around: Optional[int]
    between: Optional[int]


def _values(item: Dict[str, Any]) -> Dict[str, Interval]:
    return {name: Interval(v["lo"], v["hi"]) for name, v in item.items()}


class Aspects(Analysis, Certified):
    """The pieces into which singularities divide a C-space.

    Attributes:
        aspects: the number of pieces without forward and inverse singularities.
        assembly_modes: the number of pieces without forward singularities.
        working_modes: the number of pieces without inverse singularities.
        representatives: for each aspect, a configuration (intervals by coordinate) and the signs of the factors of the
            determinants.
        require: the requirements that are met in these pieces (with_requirements()).
        reason: what is not known, and why.
        robots: where constants have tolerances: "tolerances", "every" (is it proven that every robot has these numbers?),
            "reason" and "other", a robot with other numbers, or None. All else is of the robot as drawn. Else None.
        areas: with areas=True, bounds of the area that each aspect covers in the plane of the outputs; else None.
        cusps: with cusps=True, the cusps that were found; None if none were searched for.
        cusps_of: the loci whose cusps were searched for: "forward", "inverse".
        cusps_not_known: what is not known about cusps, and why; if it is empty, `cusps` are proven to be all cusps in the
            search domain.
        euler_characteristic: the Euler characteristic of C-space if it is a closed surface and cusps=True, else None. The
            number of cusps of each locus has the same parity.
    """

    def __init__(self, text: str, table: str, file: Optional["_corank.PiecesFile"] = None) -> None:
        super().__init__(text, table)
        self._file = file
        self.aspects = _bounds(self.data["aspects"])
        self.assembly_modes = _bounds(self.data["bounds"]["assembly_modes"])
        self.working_modes = _bounds(self.data["bounds"]["working_modes"])
        pieces = self.data["representatives"]
        self.representatives: List[Tuple[Dict[str, Interval], List[int]]] = [
            (_values(r["values"]), r["signs"]) for r in pieces
        ]
        self.require: List[str] = self.data["require"]
        self.areas: Optional[List[Interval]] = None
        if pieces and "area" in pieces[0]:
            self.areas = [Interval(r["area"]["lo"], r["area"]["hi"]) for r in pieces]
        self.cusps: Optional[List[Cusp]] = None
        if self.data["cusps"] is not None:
            self.cusps = [Cusp(c["locus"], _values(c["values"]), c["around"], c["between"]) for c in self.data["cusps"]]
        self.cusps_of: List[str] = self.data.get("cusps_of", [])
        self.euler_characteristic: Optional[int] = self.data.get("euler_characteristic")
        self.cusps_not_known: List[str] = self.data.get("cusps_not_known", [])
        self.reason: str = self.data["reason"]
        self.robots: Optional[Dict[str, Any]] = self.data.get("robots")
        self._missing = f"there is no certificate: {self.reason or 'aspects() needs certificate=True'}"


class Clearance(Analysis):
    """The largest ball about a configuration that holds no singularity.

    Attributes:
        lower, upper: bounds of the radius, in the model's unit; one radian counts like one unit. upper is None if no
            singularity was proven to exist.
        nearest: a proven singularity at a distance of at most `upper`, intervals by coordinate; None if there is none.
        empty: is it proven that there is no singularity?
        free, nearest_result: with claims=True, results whose verify() proves the two bounds again; None if that failed.
    """

    def __init__(self, text: str, table: str, free: Optional[Result] = None, nearest: Optional[Result] = None) -> None:
        super().__init__(text, table)
        self.lower, self.upper = _interval(self.data["radius"])
        near = self.data["nearest"]
        self.nearest = None if near is None else _values(near)
        self.empty: bool = self.data["empty"]
        self.free, self.nearest_result = free, nearest


class Factor(Analysis):
    """By which factor all tolerances may grow, while every robot within them keeps something.

    Attributes:
        lower: every robot within `lower` times the tolerances keeps it, proven.
        upper: some robot within `upper` times the tolerances does not, proven; 0: the robot as drawn does not; None: no such
            robot is proven to exist.
        tolerances: (lower, upper) of each constant at the factor `lower`.
        robot: the constants of the robot that proves `upper`, intervals by name.
        reason: why the bounds are not closer, or why there is no upper one; None if they are as close as asked for.
    """

    def __init__(self, text: str, table: str) -> None:
        super().__init__(text, table)
        self.lower: float = self.data["factor"]["lo"]
        self.upper: Optional[float] = self.data["factor"]["hi"]
        self.tolerances = _values(self.data["tolerances"])
        self.robot = _values(self.data["robot"])
        self.reason: Optional[str] = self.data["reason"]


class ToleranceFactor(Factor):
    """A Factor of tolerances within which every robot keeps a clearance.

    Attributes:
        nearest: the singularity of `robot` nearer than the clearance, intervals by coordinate; None if there is none.
    """

    def __init__(self, text: str, table: str) -> None:
        super().__init__(text, table)
        self.nearest = None if self.data["nearest"] is None else _values(self.data["nearest"])


class AspectsFactor(Factor):
    """A Factor of tolerances within which every robot keeps its numbers of aspects, assembly modes and working modes.

    Attributes:
        keep: the numbers, by "aspects", "assembly_modes", "working_modes".
        other: the numbers of `robot`; None if no such robot is known.
    """

    def __init__(self, text: str, table: str) -> None:
        super().__init__(text, table)
        self.keep: Dict[str, int] = self.data["keep"]
        self.other: Optional[Dict[str, int]] = self.data["other"]


class PathFactor(Factor):
    """A Factor of tolerances within which every robot has a path of its own through the sections of a path.

    Attributes:
        place: a configuration on the path of `robot` at which it fails, intervals by coordinate; None without an upper bound.
        what: how it fails there, a sentence; None without an upper bound.
    """

    def __init__(self, text: str, table: str) -> None:
        super().__init__(text, table)
        self.place = None if self.data["place"] is None else _values(self.data["place"])
        self.what: Optional[str] = self.data["what"]


class BestCenter(Clearance):
    """The centre of the largest free ball in a region.

    Attributes:
        center: the centre's values by coordinate; None if none was found. The ball about it with the radius `lower` holds no
            singularity. No centre in the region has a larger radius than `upper`.
        unassembled: is it proven that the robot has no configuration with a centre in the region?
    """

    def __init__(self, text: str, table: str) -> None:
        super().__init__(text, table)
        self.center: Optional[Dict[str, float]] = self.data["centre"]
        self.unassembled: bool = self.data["unassembled"]


class ClearanceMap(Analysis):
    """The clearance over a grid of centres. The bounds of a cell hold for every centre in it.

    Attributes:
        names: the two coordinates.
        rows: a dict for each cell: its middle by coordinate; "robot": is a configuration proven there; "lo", "hi": bounds of
            the clearance at the middle; "cell_lo", "cell_hi": bounds for the whole cell; None: not known.
    """

    def __init__(self, text: str, table: str) -> None:
        super().__init__(text, table)
        self.names: List[str] = list(self.data["region"])
        self.rows = [{k: _number(v) for k, v in row.items()} for row in csv.DictReader(io.StringIO(table))]

    def to_pandas(self) -> "pandas.DataFrame":
        """The rows as a data frame."""
        pandas = require("pandas")

        return pandas.DataFrame(self.rows)


def _number(text: str) -> Union[None, float, str]:
    try:
        return float(text) if text else None
    except ValueError:
        return text


RangeLike = Union[Tuple[ExpressionLike, ExpressionLike], Sequence[ExpressionLike]]


def _ranges(ranges: Mapping[str, RangeLike]) -> List[Tuple[str, Expression, Expression]]:
    return [(name, as_expression(lower), as_expression(upper)) for name, (lower, upper) in ranges.items()]


class _About(NamedTuple):
    """What the questions about clearances have in common."""

    question: _corank.Question
    ball: _corank.Ball
    precision: float
    options: _corank.Options
    progress: ProgressOption


def _about(
    mechanism: "Mechanism",
    at: Optional[Mapping[str, ExpressionLike]] = None,
    within: Optional[Sequence[str]] = None,
    set: Optional[str] = None,
    ranges: Optional[Mapping[str, RangeLike]] = None,
    orientation_range: Optional[ExpressionLike] = None,
    orientation: Optional[str] = None,
    orientation_of: str = "",
    precision: float = 0.01,
    threads: int = 0,
    time_limit: float = 0,
    max_boxes: int = 0,
    progress: ProgressOption = None,
) -> _About:
    ball = _corank.Ball(
        [(name, as_expression(v)) for name, v in (at or {}).items()],
        list(within or ()),
        _ranges(ranges or {}),
        None if orientation_range is None else as_expression(orientation_range),
        orientation,
        orientation_of,
    )
    options = make_options(threads=threads, time_limit=time_limit, max_boxes=max_boxes)
    return _About(ask(mechanism._core, set, "forward"), ball, precision, options, progress)


def clearance(
    self: "Mechanism",
    at: Mapping[str, ExpressionLike],
    within: Sequence[str],
    *,
    set: Optional[str] = None,
    ranges: Optional[Mapping[str, RangeLike]] = None,
    orientation_range: Optional[ExpressionLike] = None,
    orientation: Optional[str] = None,
    orientation_of: str = "",
    precision: float = 0.01,
    claims: bool = False,
    threads: int = 0,
    time_limit: float = 0,
    max_boxes: int = 0,
    progress: ProgressOption = None,
) -> Clearance:
    """Finds the largest ball about a configuration that holds no singularity, and proves bounds of its radius.

    Args:
        at: the centre of the ball, and other coordinates that keep a value. Angles are in radians: corank.degrees(15).
        within: the coordinates in which the ball lies; one radian counts like one unit of length.
        set: the set that the ball avoids; None: "forward". "requirements": the configurations at which one of the
            mechanism's requirements reaches its limit (with_requirements()).
        ranges: ranges of coordinates instead of the model's: for a mode, or an angle that may move.
        orientation_range: how far the outputs' angles that `at` gives, and `orientation`, may vary.
        orientation: the orientation of a spatial robot, such as "Rz(0.2)*Ry(pi/18)".
        orientation_of: the link or the rotation matrix that `orientation` is for, if there are several.
        precision: end when the bounds of the radius are this close, relative to it.
        claims: also make the results that prove the bounds again.
    """
    about = _about(
        self,
        at,
        within,
        set,
        ranges,
        orientation_range,
        orientation,
        orientation_of,
        precision,
        threads,
        time_limit,
        max_boxes,
        progress,
    )
    with Shown(progress) as show:
        text, table, free, nearest, raised = _corank.clearance(
            about.question, about.ball, precision, claims, about.options, show
        )
    proven = [None if core is None else Result(core) for core in (free, nearest)]
    return deliver(Clearance(text, table, *proven), raised)


def tolerance_factor(
    self: "Mechanism", clearance: float, at: Mapping[str, ExpressionLike], within: Sequence[str], **others: Any
) -> ToleranceFactor:
    """Finds by which factor all tolerances may grow, while every robot within them keeps this clearance. The tolerance
    [a, b] of a constant with the nominal value v becomes [v + s (a - v), v + s (b - v)] for the factor s. The other arguments
    are those of clearance(), except claims."""
    about = _about(self, at, within, **others)
    with Shown(about.progress) as show:
        text, table, raised = _corank.tolerance_factor(
            about.question, about.ball, clearance, about.precision, about.options, show
        )
    return deliver(ToleranceFactor(text, table), raised)


def aspects_factor(
    self: "Mechanism", *, precision: float = 0.01, threads: int = 0, time_limit: float = 0, progress: ProgressOption = None
) -> AspectsFactor:
    """Finds by which factor all tolerances may grow, as in tolerance_factor(), while every robot within them keeps its numbers
    of aspects, assembly modes and working modes.

    Args:
        precision: of each bound, relative.
        time_limit: in seconds; 0: no limit.
    """
    with Shown(progress) as show:
        text, table, raised = _corank.aspects_factor(ask(self._core), precision, threads, time_limit, show)
    return deliver(AspectsFactor(text, table), raised)


def path_factor(
    self: "Mechanism", path: "Path", *, precision: float = 0.01, time_limit: float = 0, progress: ProgressOption = None
) -> PathFactor:
    """Finds by which factor all tolerances may grow, as in tolerance_factor(), while every robot within them has a path of
    its own through the sections of a path of this mechanism, as free of singularities.

    Args:
        precision: of the factor, relative.
        time_limit: in seconds; 0: no limit.
    """
    with Shown(progress) as show:
        text, table, raised = _corank.path_factor(ask(self._core), path._need(), precision, time_limit, show)
    return deliver(PathFactor(text, table), raised)


def best_center(self: "Mechanism", region: Mapping[str, RangeLike], **others: Any) -> BestCenter:
    """Finds the centre of the largest ball that holds no singularity, in a region of lengths such as {"x": (0, 1),
    "y": (0, 1)}. Unless `within` names others, the ball lies in the region's coordinates. The other arguments are those of
    clearance(), except claims."""
    about = _about(self, **others)
    with Shown(about.progress) as show:
        text, table, raised = _corank.best_center(
            about.question, about.ball, _ranges(region), about.precision, about.options, show
        )
    return deliver(BestCenter(text, table), raised)


def clearance_map(
    self: "Mechanism", region: Union[Sequence[str], Mapping[str, RangeLike]], *, grid: int = 24, **others: Any
) -> ClearanceMap:
    """Computes the clearance over a grid of centres in two lengths: ("x", "y") within their declared ranges, or
    {"x": (0, 1), …}. `grid` is the number of cells along each side. The other arguments are those of clearance(), except
    claims."""
    about = _about(self, **others)
    sides = _ranges(region) if isinstance(region, Mapping) else _corank.declared_ranges(about.question, list(region))
    with Shown(about.progress) as show:
        text, table, raised = _corank.clearance_map(
            about.question, about.ball, sides, grid, about.precision, about.options, show
        )
    return deliver(ClearanceMap(text, table), raised)


def area(
    self: "Mechanism",
    outputs: Sequence[str] = (),
    *,
    anyway: bool = False,
    threads: int = 0,
    time_limit: float = 0,
    progress: ProgressOption = None,
) -> Optional[Interval]:
    """Bounds the area of the workspace in the plane of two lengths, by its boundary; None if the boundary does not give
    bounds.

    Args:
        outputs: the two lengths, instead of the model's outputs.
        anyway: if the boundary does not give bounds, divide the plane itself; this takes long.
    """
    with Shown(progress) as show:
        question = _corank.Question(self._core, "boundary", outputs=list(outputs))
        bounds = _corank.area(question, threads, time_limit, anyway, show)
    return None if bounds is None else Interval(*bounds)
