"""Proven answers about a mechanism as a whole: its shape, its pieces, its distance from singularities, its workspace's
area."""

from __future__ import annotations

import csv
import io
import json
import os
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

from . import _corank
from ._corank import Expression
from .errors import deliver, in_python
from .expression import ExpressionLike, as_expression
from .optional import require
from .point import Interval
from .progress import ProgressOption, Shown

if TYPE_CHECKING:
    import pandas

    from .mechanism import Mechanism
    from .result import Result, Verification


class Bounds(NamedTuple):
    """A number in proven bounds; at_most None: no upper bound is known."""

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
    """What was found. `data` has all of it, as the command line's --json prints it; str() is its table.

    Attributes:
        data: the JSON object, as Python's own values.
        complete: False where a limit or Ctrl-C ended it; what is said is proven all the same.
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
        dimension: of the C-space. smooth: proven to be a manifold without boundary in the search domain.
        components: how many connected pieces. euler_characteristic: None where it is not known.
        genus: of each piece of a surface, ascending. reason: what is not known, and why.
    """

    def __init__(self, text: str, table: str) -> None:
        super().__init__(text, table)
        self.dimension: int = self.data["dimension"]
        self.smooth: bool = self.data["smooth"]
        self.components = _bounds(self.data["components"])
        self.euler_characteristic: Optional[int] = self.data["euler_characteristic"]
        self.genus: List[int] = self.data["genus"]
        self.reason: str = self.data["reason"]


class Cusp(NamedTuple):
    """A cusp of a singularity locus' image: next to it three configurations have the same inputs (of the forward locus) or
    the same outputs (of the inverse one), and a path about it joins two of them, the outer ones, without a singularity.

    Attributes:
        locus: "forward" or "inverse". values: the configuration over the cusp, intervals by coordinate.
        around: the index of the aspect in which the outer two lie, in Aspects.representatives. between: of the third; None:
            not known.
    """

    locus: str
    values: Dict[str, Interval]
    around: Optional[int]
    between: Optional[int]


def _values(item: Dict[str, Any]) -> Dict[str, Interval]:
    return {name: Interval(v["lo"], v["hi"]) for name, v in item.items()}


class Aspects(Analysis):
    """The pieces into which singularities divide a C-space.

    Attributes:
        aspects, assembly_modes, working_modes: how many pieces without forward and inverse, without forward, without inverse
            singularities. representatives: of each aspect a configuration, intervals by coordinate, and the signs of the
            factors of the determinants. reason: what is not known, and why.
        areas: with areas=True, of each representative the area that its aspect covers in the plane of the outputs, in bounds;
            else None.
        cusps: with cusps=True, those of both loci, as far as they were looked for; None where none were. cusps_of:
            "forward", "inverse": the loci whose cusps were looked for. cusps_not_known: what is not known of them, and why;
            where it is empty, these are proven to be all in the search domain.
        euler_characteristic: of C-space, where it is a closed surface and cusps were asked for: the number of cusps of each
            locus has its parity; else None.
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

    def _need(self) -> "_corank.PiecesFile":
        if self._file is None:
            raise ValueError(f"there is no certificate: {self.reason or 'aspects() needs certificate=True'}")
        return self._file

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the numbers with what proves them (.h5), which verify() and `corank verify` check. ValueError where
        certificate=True was not given."""
        self._need().write(os.fspath(path))

    def verify(self, threads: int = 0, *, progress: ProgressOption = None) -> "Verification":
        """Checks the numbers anew by code that shares nothing with what made them. verified: every lower bound is confirmed;
        complete: every upper bound, too. ValueError where certificate=True was not given."""
        from .result import Verification

        with Shown(progress) as show:
            text, table, raised = _corank.verify_pieces(self._need(), threads, show)
        report = json.loads(text)
        return deliver(Verification(report["verified"], report["complete"], report, table), raised)


class Clearance(Analysis):
    """The largest ball about a configuration that holds no singularity.

    Attributes:
        lower, upper: the radius is between these, in the model's unit and radians alike; upper None: no singularity was
            proven.
        nearest: a proven singularity no farther than `upper`, intervals by coordinate; None where there is none.
        empty: proven that there is no singularity at all.
        free, nearest_result: with claims=True, results whose verify() proves both bounds again; None where that failed.
    """

    def __init__(self, text: str, table: str, free: Optional["Result"] = None, nearest: Optional["Result"] = None) -> None:
        super().__init__(text, table)
        self.lower, self.upper = _interval(self.data["radius"])
        near = self.data["nearest"]
        self.nearest = None if near is None else _values(near)
        self.empty: bool = self.data["empty"]
        self.free, self.nearest_result = free, nearest


class BestCenter(Clearance):
    """The centre of the largest free ball in a region.

    Attributes:
        center: its values by coordinate; None where none was found. The ball about it with the radius `lower` is free; no
            centre in the region has more than `upper`. unassembled: proven that no configuration has its centre there.
    """

    def __init__(self, text: str, table: str) -> None:
        super().__init__(text, table)
        self.center: Optional[Dict[str, float]] = self.data["centre"]
        self.unassembled: bool = self.data["unassembled"]


class ClearanceMap(Analysis):
    """The clearance over a grid of centres, each cell with bounds that hold all over it.

    Attributes:
        names: the two coordinates. rows: a dict for each cell: its middle by coordinate; "robot": is a configuration proven
            there; "lo", "hi": the clearance of the middle, "cell_lo", "cell_hi" of all of the cell; None: not known.
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


def _ball(
    at: Mapping[str, ExpressionLike],
    within: Sequence[str],
    ranges: Optional[Mapping[str, RangeLike]],
    orientation_range: Optional[ExpressionLike],
    orientation: Optional[str],
    orientation_of: str,
) -> Any:
    return _corank.Ball(
        [(name, as_expression(v)) for name, v in at.items()],
        list(within),
        _ranges(ranges or {}),
        None if orientation_range is None else as_expression(orientation_range),
        orientation,
        orientation_of,
    )


def _search(self: "Mechanism", set: Optional[str], threads: int, time_limit: float, max_boxes: int) -> Any:
    from .mechanism import _options

    chosen = set if set is not None or self._core.plain else "forward"
    return chosen, _options(threads=threads, time_limit=time_limit, max_boxes=max_boxes)


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
    """The largest ball about a configuration without a singularity, in proven bounds.

    Args:
        at: values of coordinates: the ball's centre, and what keeps its value. Angles in radians; corank.degrees(15).
        within: the coordinates in which the ball lies; lengths and radians count alike.
        set: "forward" where none is given.
        ranges: coordinates that stay within other ranges than the model's: a mode, an angle that may move.
        orientation_range, orientation, orientation_of: the angles among the outputs, and a spatial robot's orientation such
            as "Rz(0.2)*Ry(pi/18)", stay within so much of their values.
        precision: how close the bounds are to be, relative to the radius.
        claims: make the results that prove the bounds again.
    """
    about = _ball(at, within, ranges, orientation_range, orientation, orientation_of)
    chosen, options = _search(self, set, threads, time_limit, max_boxes)
    with Shown(progress) as show:
        text, table, free, nearest, raised = _corank.clearance(self._core, chosen, about, precision, claims, options, show)
    from .result import Result

    proven = [None if core is None else Result(core) for core in (free, nearest)]
    return deliver(Clearance(text, table, *proven), raised)


def best_center(
    self: "Mechanism",
    region: Mapping[str, RangeLike],
    *,
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
) -> BestCenter:
    """The centre of the largest ball without a singularity in a region of lengths, {"x": (0, 1), "y": (0, 1)}; the ball
    lies in these coordinates where `within` names no others. The other arguments are those of clearance()."""
    about = _ball(at or {}, list(within or ()), ranges, orientation_range, orientation, orientation_of)
    chosen, options = _search(self, set, threads, time_limit, max_boxes)
    with Shown(progress) as show:
        text, table, raised = _corank.best_center(self._core, chosen, about, _ranges(region), precision, options, show)
    return deliver(BestCenter(text, table), raised)


def clearance_map(
    self: "Mechanism",
    region: Union[Sequence[str], Mapping[str, RangeLike]],
    *,
    grid: int = 24,
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
) -> ClearanceMap:
    """The clearance over a grid of centres in two lengths: ("x", "y"), within their declared ranges, or {"x": (0, 1), …}.
    `grid`: cells along each side. The other arguments are those of clearance()."""
    about = _ball(at or {}, list(within or ()), ranges, orientation_range, orientation, orientation_of)
    chosen, options = _search(self, set, threads, time_limit, max_boxes)
    sides = _ranges(region) if isinstance(region, Mapping) else _corank.declared_ranges(self._core, chosen, list(region))
    with Shown(progress) as show:
        text, table, raised = _corank.clearance_map(self._core, chosen, about, sides, grid, precision, options, show)
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
    """Bounds of the area of the workspace in the plane of two lengths, from its boundary; None where that does not give
    them.

    Args:
        outputs: in place of the model's.
        anyway: divide the plane itself where the boundary does not give bounds; takes long.
    """
    with Shown(progress) as show:
        bounds = _corank.area(self._core, list(outputs), threads, time_limit, anyway, show)
    return None if bounds is None else Interval(*bounds)
