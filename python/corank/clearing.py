"""How far configurations are from singularities: the largest balls that hold none."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

from . import _corank
from .analyses import Analysis, Factor, _values
from .errors import deliver
from .expression import ExpressionLike, RangeLike, _ranges, as_expression
from .optional import require
from .options import ask, make_options
from .progress import ProgressOption, Shown
from .result import Result

if TYPE_CHECKING:
    import pandas

    from .mechanism import Mechanism


def _interval(item: Optional[Dict[str, Any]]) -> Tuple[Optional[float], Optional[float]]:
    return (None, None) if item is None else (item["lo"], item["hi"])


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


class ToleranceFactor(Factor):
    """A Factor of tolerances within which every robot keeps a clearance.

    Attributes:
        nearest: the singularity of `robot` nearer than the clearance, intervals by coordinate; None if there is none.
    """

    def __init__(self, text: str, table: str) -> None:
        super().__init__(text, table)
        self.nearest = None if self.data["nearest"] is None else _values(self.data["nearest"])


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
        set: the set that the ball avoids, any but "boundary"; None: "forward". "requirements": the configurations at which
            one of the mechanism's requirements reaches its limit (with_requirements()).
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
