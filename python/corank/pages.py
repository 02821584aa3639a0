"""Reports: one page about a mechanism's sets, with the results and pictures beside it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, List, Optional, Sequence, Tuple

from . import _corank, notebook
from .errors import Interrupted
from .progress import ProgressOption, Shown
from .result import PathLike, Result

if TYPE_CHECKING:
    from .mechanism import Mechanism

#: Of each search for a page: limits of boxes and seconds; digits of isolated points.
_BOXES, _SECONDS, _DIGITS = _corank.page_limits

#: The sets that a report has by default.
USUAL_SETS: Tuple[str, ...] = tuple(s[0] for s in _corank.sets if s[3])
_WITH_KERNEL = {s[0] for s in _corank.sets if s[4]}


class Report(notebook.Page):
    """A report and its results.

    Attributes:
        results: the results of its sets, in their order.
        path: where its index.html was written; None if it was not written.
        complete: is every result complete?
    """

    def __init__(self, text: str, results: Sequence[Result], path: Optional[str]) -> None:
        super().__init__(text, path)
        self.results = list(results)
        self.complete = all(r.complete and r.stopped is None for r in self.results)


def report(
    self: "Mechanism",
    path: Optional[PathLike] = None,
    *,
    sets: Optional[Sequence[str]] = None,
    sigma: Optional[float] = None,
    cspace_sigma: Optional[float] = None,
    corank: int = 1,
    proof: bool = False,
    threads: int = 0,
    max_boxes: int = 0,
    max_found: int = _BOXES,
    time_limit: float = _SECONDS,
    results: Optional[Sequence[Result]] = None,
    progress: ProgressOption = None,
) -> Report:
    """Solves several sets and returns one HTML page about them, which a notebook shows.

    Args:
        path: a folder for index.html, the results and the figures; None: only return the page.
        sets: the names of the sets; None: corank.USUAL_SETS.
        sigma, cspace_sigma: the largest edge of a box, in sets of singularities and in C-space. None: results keep
            the boxes of surfaces uncut, and the page shows them cut.
        corank: for the sets with a kernel: only configurations at which the kernel has at least this dimension.
        max_boxes, max_found, time_limit: limits that end each search; 0: no limit. The page says which sets are incomplete.
            Aspects (of C-spaces with one or two dimensions) are left out if they take longer than the time limit.
        results: make the page about these results of one model, instead of solving.

    Raises:
        Interrupted: on Ctrl-C, with a list of the results of the sets that were done and of the one in progress.
    """
    found: List[Result] = list(results or [])
    for name in () if results else sets or USUAL_SETS:
        try:
            found.append(
                self.solve(
                    name,
                    sigma=cspace_sigma if name == "cspace" else sigma,
                    corank=corank if name in _WITH_KERNEL else 1,
                    digits=_DIGITS,
                    proof=proof,
                    threads=threads,
                    max_boxes=max_boxes,
                    max_found=max_found,
                    time_limit=time_limit,
                    progress=progress,
                )
            )
        except Interrupted as early:
            raise Interrupted([*found, early.result]) from None
    cores = [r._core for r in found]
    command = _command("report", self, sets, sigma, cspace_sigma)
    aspects = None
    if not results:
        with Shown(progress) as show:
            aspects, raised = _corank.page_aspects(cores, threads, time_limit, show)
        if raised is not None:
            raise Interrupted(found)
    if path is None:
        return Report(_corank.report_page(cores, command, [], [], aspects), found, None)
    folder = os.fspath(path)
    figures = _corank.write_figures(folder, cores)
    files = [f"{r.set}.h5" for r in found]
    for r, file in zip(found, files):
        r.save(os.path.join(folder, file))
    page = Report(_corank.report_page(cores, command, figures, files, aspects), found, os.path.join(folder, "index.html"))
    page.save(os.path.join(folder, "index.html"))
    return page


def _command(function: str, mechanism: "Mechanism", sets: Any, *sigmas: Optional[float]) -> str:
    """What stands on the page as the command that made it."""
    given = {"sets": None if sets is None else list(sets), "sigma": sigmas[0], "cspace_sigma": sigmas[1]}
    return f"{mechanism.name}.{function}({', '.join(f'{k}={v!r}' for k, v in given.items() if v is not None)})"
