"""The client's side of a search on a cluster: it gives units out, puts their answers together, and keeps checkpoints."""

from __future__ import annotations

import os
import sys
import time
from typing import TYPE_CHECKING, Any, Callable, List, Optional, Sequence, Tuple

from distributed import Client

from .. import _corank
from ..errors import ResultFileError
from ..options import make_options
from ..progress import ProgressOption, Shown
from ..result import PathLike, Result
from .units import ClusterError, Plan, Units, check_versions

if TYPE_CHECKING:
    from ..mechanism import Mechanism

_Show = Callable[[str, float, str], None]

_MOST_SHARE = 0.02  # of all seconds, for checkpoints
_GRACE = 0.5  # seconds, once a limit has ended the run


class Checkpoints:
    """The state of a run in a file, now and then: `corank solve --resume` goes on from it, too.

    path: None for none. into_result: where a limit has ended the run, its state goes into the result, too. arguments, files:
    of corank solve's command line, and what it reads (option, path, text). former: what read() has returned.
    """

    def __init__(
        self, path: Optional[PathLike], every: float, arguments: Sequence[str], files: Sequence[Tuple[str, str, str]]
    ) -> None:
        self.path = None if path is None else os.fspath(path)
        self.into_result = False
        self.every = every
        self.arguments = list(arguments)
        self.files = list(files)
        self.states: List[bytes] = []  # of the run's searches
        self._ended = False
        self._next = time.monotonic() + every

    @classmethod
    def read(cls, path: PathLike, every: float = 60.0) -> "Checkpoints":
        """Raises ResultFileError where there is none, or one of another version."""
        arguments, files, states = _corank.read_checkpoint(os.fspath(path))
        known = cls(path, every, arguments, files)
        known.states = states
        return known

    def next_state(self, search: int) -> Optional[bytes]:
        """From where this search goes on."""
        return self.states[search] or None if search < len(self.states) else None

    def keep(self, run: _corank.SpreadRun, now: bool = False) -> None:
        """Writes the file where it is time to, or at once. Where it cannot be written, the last one stays."""
        begun = time.monotonic()
        if self.path is None or self._ended or (begun < self._next and not now):
            return
        try:
            _corank.write_checkpoint(self.path, self.arguments, self.files, self.states, run.finished, run.state())
        except OSError as error:
            print(
                f"corank.cluster: no checkpoint could be written, the last good one stays: {error}",
                file=sys.stderr,
                flush=True,
            )
        took = time.monotonic() - begun
        self._next = time.monotonic() + max(self.every, took * (1 / _MOST_SHARE - 1))

    def end(self, run: _corank.SpreadRun, had_begun: bool) -> None:
        """A limit has ended the run: what follows is made for the result. Before its search had begun, which may have been
        prepared in part only, there is nothing to go on from but what was kept before."""
        if not self._ended and had_begun:
            self.keep(run, now=True)
        if not self._ended and had_begun and self.into_result:
            run.keep_state(self.arguments, self.files, self.states)
        self._ended = True

    def finish(self, run: _corank.SpreadRun) -> None:
        """The search is done; its last state is kept beside the next one's."""
        if self._ended:
            return
        if run.finished + 1 < run.searches:
            self.states += [b""] * (run.finished + 1 - len(self.states))
            self.states[run.finished] = run.state()
        else:
            self.keep(run, now=True)


class _Workers:
    """How many threads they have, asked for now and then."""

    def __init__(self, client: Client) -> None:
        self._client = client
        self._until = 0.0
        self.threads = 0

    def look(self) -> int:
        now = time.monotonic()
        if now >= self._until:
            try:
                self.threads = sum(self._client.nthreads().values())
            except OSError as error:
                raise ClusterError(f"the connection to the scheduler is lost: {error}") from None
            self._until = now + 2
        return self.threads


def _search(
    run: _corank.SpreadRun, client: Client, plan: Plan, checkpoints: Optional[Checkpoints], show: Optional[_Show]
) -> None:
    units = Units(client, run.prepared, plan)
    workers = _Workers(client)
    answered = 0
    had_begun = not run.ended
    try:
        while not run.done and not run.ended:
            threads = workers.look()
            if threads > 0 or len(units) > 0:
                most, fewest, seconds = run.next_units(max(1, threads), plan.unit_seconds, time.monotonic())
                if most > len(units):
                    given = run.take_units(most - len(units), fewest)
                    units.submit(given, max(1e-3, min(seconds, run.seconds_left)))
            for answer in units.answers(min(0.5, max(0.0, run.seconds_left))):
                answered += run.add(answer)
            units.look_after()
            if checkpoints is not None:
                checkpoints.keep(run)
            if show is not None:
                show(
                    "search",
                    run.share_done,
                    f"{answered} units done, {len(units)} under way" if threads else "no workers yet",
                )
        grace = time.monotonic() + _GRACE  # what was under way comes to its end, too
        while run.ended and len(units) > 0 and time.monotonic() < grace:
            for answer in units.answers(0.05):
                run.add(answer)
        if run.ended and checkpoints is not None:
            checkpoints.end(run, had_begun)
    finally:
        units.cancel()


def solve_run(
    run: _corank.SpreadRun,
    client: Client,
    plan: Plan,
    checkpoints: Optional[Checkpoints] = None,
    progress: ProgressOption = None,
) -> Result:
    """Does all searches of a run. Where it ends early, by an exception, the last checkpoint says from where to go on."""
    if client.asynchronous:
        raise ValueError("client: expected one that is not asynchronous")
    if not 1 <= plan.threads <= _corank.most_unit_threads:
        raise ValueError(f"threads: expected 1 to {_corank.most_unit_threads} for each unit")
    check_versions(client)
    with Shown(progress) as show:
        while run.finished < run.searches:
            try:
                run.begin(checkpoints.next_state(run.finished) if checkpoints is not None else None)
            except RuntimeError as error:  # of a state
                raise ResultFileError(f"nothing to go on from: {error}") from None
            try:
                _search(run, client, plan, checkpoints, show)
            except BaseException:
                if checkpoints is not None:
                    checkpoints.keep(run, now=True)
                raise
            if checkpoints is not None:
                checkpoints.finish(run)
            run.finish()
    return Result(run.result())


def solve(
    mechanism: "Mechanism",
    client: Client,
    set: Optional[str] = None,
    *,
    kernel: Optional[str] = None,
    corank: int = 1,
    outputs: Sequence[str] = (),
    tolerance: Optional[float] = None,
    digits: int = 0,
    plan: Plan = Plan(),
    checkpoints: Optional[Checkpoints] = None,
    progress: ProgressOption = None,
    **options: Any,
) -> Result:
    """Mechanism.solve by the workers of a dask cluster: the same boxes. max_found and max_solutions are no limits here.

    Raises:
        ClusterError: where the cluster cannot do the work.
    """
    question = _corank.Question(mechanism._core, set, kernel, corank, list(outputs), tolerance)
    run = _corank.SpreadRun(question, make_options(**options), digits)
    return solve_run(run, client, plan, checkpoints, progress)


__all__ = ["Checkpoints", "ClusterError", "Plan", "solve", "solve_run"]
