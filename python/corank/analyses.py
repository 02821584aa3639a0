"""Proven answers about a mechanism as a whole: its shape, its pieces, its workspace's area, and by which factor its tolerances
may grow."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

from . import _corank
from .errors import deliver, in_python
from .options import ask
from .point import Interval
from .progress import ProgressOption, Shown
from .result import Certified

if TYPE_CHECKING:
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


class Analysis:
    """The answer of an analysis. str() is the table that the command prints.

    Attributes:
        data: the JSON object that the command's --json prints, as Python's own values.
        complete: False if a limit or Ctrl-C ended the analysis; what it says is proven nevertheless.
        stopped: what ended it early, such as "the time limit, in the stage search"; None if nothing did.
    """

    def __init__(self, text: str, table: str) -> None:
        self.data: Dict[str, Any] = json.loads(text)
        self._table = table
        self.complete: bool = self.data["complete"]
        self.stopped: Optional[str] = self.data["stopped"]

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
