"""Paths between two configurations that are proven to meet no singularity."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Sequence, Union

from . import _corank
from .errors import ModelError, deliver
from .expression import ExpressionLike, as_expression
from .notebook import Page
from .options import ask
from .progress import ProgressOption, Shown
from .result import Certified

if TYPE_CHECKING:
    import pandas

    from .mechanism import Mechanism
    from .result import Result

#: What the portraits of a page show, as far as it is found soon.
_PORTRAYED = ("cspace", "forward", "inverse")
_MOST_BOXES = 100_000
_TITLES: Dict[str, str] = {s[0]: s[1] for s in _corank.sets}


class Path(Certified):
    """A path, or the proof that there is none, or neither. In a condition it is True if there is a path. str() is the table
    that the command prints.

    Attributes:
        status: "path", "separated" (it is proven that the ends lie in different pieces) or "unknown".
        waypoints: the path's values by coordinate, from the start to the end.
        radius, length_radius: a configuration is proven not to be one of the avoided singularities if its sines and cosines
            of angles differ by at most `radius`, and its lengths by at most `length_radius`, from those of a point of the
            path. None without a path; length_radius is also None without lengths.
        radii: the radius, in sines and cosines, of the piece after each waypoint.
        length: the length of the polyline through the waypoints, with angles in radians and lengths in units of their
            typical size.
        reason: what separates the ends, or why nothing is known.
        stopped: what ended the search early, such as "the time limit, in the stage search"; None if nothing did.
        data: the JSON object that the command's --json prints.
    """

    def __init__(
        self,
        text: str,
        table: str,
        file: Optional["_corank.PathFile"] = None,
        picture: Optional["_corank.PathPicture"] = None,
        mechanism: Optional["Mechanism"] = None,
    ) -> None:
        self.data: Dict[str, Any] = json.loads(text)
        self._table = table
        self._file = file
        self._picture = picture
        self._mechanism = mechanism
        self._page: Optional[Page] = None
        self.status: str = self.data["status"]
        self.waypoints: List[Dict[str, float]] = self.data["waypoints"]
        self.radius: Optional[float] = self.data["radius"]
        self.length_radius: Optional[float] = self.data["length_radius"]
        self.radii: List[float] = self.data.get("radii") or []
        self.length: Optional[float] = self.data["length"]
        self.reason: Optional[str] = self.data["reason"]
        self.stopped: Optional[str] = self.data["stopped"]
        self._missing = f"there is no path: {self.reason or self.status}"

    def __bool__(self) -> bool:
        return self.status == "path"

    def __str__(self) -> str:
        return self._table

    def __repr__(self) -> str:
        return f"<path: {' '.join(self._table.split())[:200]}>"

    def verify(self, *, progress: ProgressOption = None) -> bool:  # type: ignore[override]
        """Checks the tube with code that shares nothing with the code that found it. Raises ValueError if there is no
        path."""
        with Shown(progress) as show:
            text, _, raised = self._need().verify(1, show)
        return bool(deliver(json.loads(text), raised)["verified"])

    def animate(
        self,
        path: Optional[Union[str, "os.PathLike[str]"]] = None,
        *,
        results: Optional[Sequence["Result"]] = None,
        threads: int = 1,
        time_limit: float = 4,
        progress: ProgressOption = None,
    ) -> Page:
        """Returns an HTML page on which the mechanism moves along the path, with the loci in the input and output portraits.
        If there is no path, the page shows the mechanism at both ends and says why. A notebook shows the page.

        Args:
            path: a file to write the page to; None: only return it.
            results: the sets of the mechanism to draw; None: solve for C-space, forward and inverse singularities.
            time_limit: seconds for each of these sets; the page says which sets took longer and are not drawn. 0: no limit.
        """
        if self._picture is None or self._mechanism is None:
            raise ValueError("this path does not know its mechanism")
        drawn, missing = list(results or []), []
        for name in () if results is not None else _PORTRAYED:
            coarser = 3.0 if name == "cspace" else 1.0  # a background
            try:
                found = self._mechanism.solve(
                    name,
                    max_found=_MOST_BOXES,
                    threads=threads,
                    time_limit=time_limit,
                    coarser=coarser,
                    surfaces_whole=False,
                    progress=progress,
                )
            except ModelError:
                missing.append(_TITLES[name])
                continue
            if found.complete:
                drawn.append(found)
            else:
                missing.append(_TITLES[name])
        text = _corank.path_page(self._picture, [r._core for r in drawn], missing, "")
        page = Page(text, None if path is None else os.fspath(path))
        if path is not None:
            page.save(path)
        return page

    def _repr_html_(self) -> str:
        if self._page is None:
            self._page = self.animate(progress=False)
        return self._page._repr_html_()

    def to_pandas(self) -> "pandas.DataFrame":
        """Returns a data frame with a row for each waypoint and a column for each coordinate."""
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
    """Finds a path between two configurations that meets no singularity, and proves it, or proves that there is none.

    Args:
        start, end: values of coordinates, as many as the mobility; corank solves for the others. Further values choose among
            the solutions.
        start_mode, end_mode: the number of the solution, if there are several; without it, a ValueError lists them.
        avoid: "forward", "inverse" or "both" singularities; or "requirements", the configurations at which one of the
            mechanism's requirements reaches its limit (with_requirements()). The path also keeps to ranges, limits and inequalities.
        radius: look for a path with this radius of sines and cosines; if none is found, take one with a smaller radius.
        max_boxes: the largest number of boxes in a cover of C-space; 0: corank's default.
        time_limit: in seconds; 0: no limit.
    """
    ends = [[(name, as_expression(v)) for name, v in values.items()] for values in (start, end)]
    with Shown(progress) as show:
        text, table, file, picture, raised = _corank.path(
            ask(self._core), ends[0], start_mode, ends[1], end_mode, avoid, radius, threads, max_boxes, time_limit, show
        )
    return deliver(Path(text, table, file, picture, self), raised)
