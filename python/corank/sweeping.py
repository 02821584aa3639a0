"""Families of mechanisms that differ in one constant."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Dict, Iterable, List, NamedTuple, Optional, Sequence

from . import _corank, notebook, pages
from .errors import Interrupted
from .expression import ExpressionLike, text_of
from .progress import ProgressOption
from .result import PathLike, Result

if TYPE_CHECKING:
    import pandas

    from .mechanism import Mechanism


class Member(NamedTuple):
    """One mechanism of a family: the constant's value in the model language, the mechanism, its results by set."""

    value: str
    mechanism: "Mechanism"
    results: Dict[str, Result]


class Sweep(Sequence[Member]):
    """The members of a family, in the order of the constant's values.

    Attributes:
        constant: the name of the constant.
        asked: the number of members that were requested.
    """

    def __init__(self, constant: str, members: List[Member], asked: int, command: str) -> None:
        self.constant = constant
        self.asked = asked
        self._members = members
        self._command = command

    def __getitem__(self, k: Any) -> Any:
        return self._members[k]

    def __len__(self) -> int:
        return len(self._members)

    @property
    def complete(self) -> bool:
        """Does the family have all members, with complete results?"""
        done = all(r.complete and r.stopped is None for m in self for r in m.results.values())
        return done and len(self) == self.asked

    def to_pandas(self) -> "pandas.DataFrame":
        """Returns a data frame with a row for each member and set: the value as text and as a number, and the numbers of
        boxes, of points and of boxes with each verdict."""
        import pandas

        rows = []
        for m in self:
            value = m.mechanism.constant_values[self.constant]
            for name, r in m.results.items():
                counts = {word: r.counts.get(word, 0) for word in _corank.verdicts}
                rows.append(
                    {
                        self.constant: m.value,
                        f"{self.constant}_value": value,
                        "set": name,
                        "boxes": len(r),
                        "points": len(r.points),
                        "complete": r.complete,
                        **counts,
                    }
                )
        return pandas.DataFrame(rows)

    def page(self, figures: Sequence[str] = (), files: Optional[List[List[str]]] = None) -> "notebook.Page":
        """Returns one HTML page about the family, with a slider. A notebook shows it."""
        if not self._members:
            raise ValueError("the family has no member")
        first = self._members[0]
        axes = first.mechanism._core.portrait_axes()
        if len(axes) < 2:
            raise ValueError(f"{first.mechanism.name}: a portrait needs two coordinates that vary")
        members = [
            (m.value, [r._core for r in m.results.values()], files[k] if files else []) for k, m in enumerate(self._members)
        ]
        report = f"{first.mechanism.name}.with_constants({self.constant}={first.value!r}).report()"
        return notebook.Page(
            _corank.family_page(members, self.constant, axes, self.asked, self._command, report, list(figures))
        )

    def report(self, path: PathLike) -> "notebook.Page":
        """Writes the page, the results and small multiples for a paper into a folder."""
        folder = os.fspath(path)
        figures = _corank.write_family_figures(
            folder,
            [[r._core for r in m.results.values()] for m in self._members],
            self._members[0].mechanism._core.portrait_axes(),
            [f"{self.constant} = {m.value}" for m in self._members],
        )
        files = [[_corank.member_file(k, self.asked, name) for name in m.results] for k, m in enumerate(self._members)]
        for names, m in zip(files, self._members):
            for file, r in zip(names, m.results.values()):
                r.save(os.path.join(folder, file))
        page = self.page(figures, files)
        page.path = os.path.join(folder, "index.html")
        page.save(page.path)
        return page

    def __repr__(self) -> str:
        values = ", ".join(m.value for m in self)
        return f"<sweep of {self.constant}: {len(self)} of {self.asked} members ({values})>"

    def _repr_html_(self) -> str:
        sets = list(self._members[0].results) if self._members else []
        rows = [[m.value, *(len(m.results[s]) for s in sets if s in m.results)] for m in self._members]
        return notebook._table(rows, [self.constant, *(f"boxes, {s}" for s in sets)])


def sweep(
    self: "Mechanism",
    constant: str,
    values: Iterable[ExpressionLike],
    *,
    sets: Sequence[str] = ("cspace", "forward", "inverse"),
    sigma: Optional[float] = None,
    cspace_sigma: Optional[float] = None,
    proof: bool = False,
    threads: int = 0,
    max_boxes: int = 0,
    max_found: int = 0,
    time_limit: float = 0,
    progress: ProgressOption = None,
    client: Any = None,
) -> Sweep:
    """Solves sets of a family of mechanisms that differ in one constant.

    Args:
        constant: the name of the constant.
        values: its exact values: texts, fractions, or corank.linspace(0.9, 1.6, 8).
        sets, sigma, cspace_sigma: as for report(); the default of sigma is twice that of solve().
        max_boxes, max_found, time_limit: limits that end each search; 0: no limit.
        client: a client of dask.distributed. Each of its workers does one search at a time, with `threads` threads; 0: one.

    Raises:
        ModelError: if a value does not make a mechanism; this is checked before the first search.
        Interrupted: on Ctrl-C, with the members that were done and the one in progress.
    """
    texts = [text_of(value) for value in values]
    plans = [self.with_constants({constant: text}) for text in texts]
    names = [c.name for c in plans[0].coordinates] if plans else []
    for text, plan in zip(texts, plans):
        if [c.name for c in plan.coordinates] != names:
            raise ValueError(
                f"at {constant} = {text} the mechanism has other coordinates than at {texts[0]}; "
                "expected the same coordinates"
            )
    members: List[Member] = []
    command = f"{pages._command('sweep', self, sets, sigma, cspace_sigma)} over {constant}"
    options: Dict[str, Any] = {
        "proof": proof,
        "threads": threads,
        "max_boxes": max_boxes,
        "max_found": max_found,
        "time_limit": time_limit,
    }
    options["coarser"] = _corank.family_coarser
    options["surfaces_whole"] = False
    sigmas = {name: cspace_sigma if name == "cspace" else sigma for name in sets}
    if client is not None:
        return _by_workers(constant, texts, plans, sigmas, {**options, "threads": threads or 1}, command, client, progress)
    for text, plan in zip(texts, plans):
        member = Member(text, plan, {})
        members.append(member)
        for name in sets:
            try:
                member.results[name] = plan.solve(name, sigma=sigmas[name], progress=progress, **options)
            except Interrupted as early:
                member.results[name] = early.result
                raise Interrupted(Sweep(constant, members, len(texts), command)) from None
    return Sweep(constant, members, len(texts), command)


def _by_workers(
    constant: str,
    texts: List[str],
    plans: List["Mechanism"],
    sigmas: Dict[str, Optional[float]],
    options: Dict[str, Any],
    command: str,
    client: Any,
    progress: ProgressOption,
) -> Sweep:
    """All searches at once, each by one worker to its end."""
    from . import cluster  # needs a package that is not always there

    searches = [(plan, name, {"sigma": s, **options}) for plan in plans for name, s in sigmas.items()]
    results, whole = cluster.solve_members(searches, client, progress=progress)
    members = []
    for k, (text, plan) in enumerate(zip(texts, plans)):
        own = {name: results.get(k * len(sigmas) + j) for j, name in enumerate(sigmas)}
        done = {name: result for name, result in own.items() if result is not None}
        if len(done) == len(sigmas):
            members.append(Member(text, plan, done))
    family = Sweep(constant, members, len(texts), command)
    if not whole:
        raise Interrupted(family)
    return family
