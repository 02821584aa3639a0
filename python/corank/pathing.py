"""Ways between two configurations that are proven to meet no singularity."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Union

from . import _corank
from .errors import deliver
from .expression import ExpressionLike, as_expression
from .progress import ProgressOption, Shown

if TYPE_CHECKING:
    import pandas

    from .mechanism import Mechanism


class Path:
    """A way, or the proof that there is none, or neither.

    Attributes:
        status: "path", "separated" (proven: the ends lie in different pieces) or "unknown". True in a condition: a path.
        waypoints: of a path, values by coordinate, the first and the last at the ends.
        radius: every configuration within so much of the way, in lengths and in sines and cosines of angles, is proven to be
            none of the singularities avoided; None without a path. radii: of the piece after each waypoint.
        length: of the waypoints' polyline, lengths and radians alike. reason: what separates the ends, or why nothing is known.
        data: the JSON object, as the command line's --json prints it; str() is its table.
    """

    def __init__(self, text: str, table: str, file: Optional["_corank.PathFile"] = None) -> None:
        self.data: Dict[str, Any] = json.loads(text)
        self._table = table
        self._file = file
        self.status: str = self.data["status"]
        self.waypoints: List[Dict[str, float]] = self.data["waypoints"]
        self.radius: Optional[float] = self.data["radius"]
        self.radii: List[float] = self.data.get("radii") or []
        self.length: Optional[float] = self.data["length"]
        self.reason: Optional[str] = self.data["reason"]

    def __bool__(self) -> bool:
        return self.status == "path"

    def __str__(self) -> str:
        return self._table

    def __repr__(self) -> str:
        return f"<path: {' '.join(self._table.split())[:200]}>"

    def _need(self) -> "_corank.PathFile":
        if self._file is None:
            raise ValueError(f"there is no path: {self.reason or self.status}")
        return self._file

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the path with its tube (.h5), which verify() and `corank verify` check. ValueError without a path."""
        self._need().write(os.fspath(path))

    def verify(self, *, progress: ProgressOption = None) -> bool:
        """Checks the tube anew by code that shares nothing with what made it. ValueError without a path."""
        with Shown(progress) as show:
            text, _, raised = _corank.verify_path(self._need(), show)
        return bool(deliver(json.loads(text), raised)["verified"])

    def to_pandas(self) -> "pandas.DataFrame":
        """A row for each waypoint, a column for each coordinate."""
        import pandas

        return pandas.DataFrame(self.waypoints)


def path(
    self: "Mechanism",
    start: Mapping[str, ExpressionLike],
    end: Mapping[str, ExpressionLike],
    *,
    start_mode: int = 0,
    end_mode: int = 0,
    avoid: str = "forward",
    radius: float = 0,
    threads: int = 1,
    max_boxes: int = 0,
    time_limit: float = 0,
    progress: ProgressOption = None,
) -> Path:
    """A way between two configurations without a singularity, proven from end to end, or the proof that there is none.

    Args:
        start, end: values of coordinates, as many as the mobility; the rest is solved for. Further ones choose between the
            solutions, and so does start_mode or end_mode, the number of a solution in the list that the ValueError has
            where there are several.
        avoid: "forward", "inverse" or "both". Ranges, limits and inequalities are kept, too.
        radius: the clearance that the way is to have where possible.
        max_boxes: of one cover of C-space; 0: corank's own. time_limit: seconds, 0: none.
    """
    ends = [[(name, as_expression(v)) for name, v in values.items()] for values in (start, end)]
    with Shown(progress) as show:
        text, table, file, raised = _corank.path(
            self._core, ends[0], start_mode, ends[1], end_mode, avoid, radius, threads, max_boxes, time_limit, show
        )
    return deliver(Path(text, table, file), raised)
