"""Units of a search on their way: submitted, waited for, submitted again where something has happened to them."""

from __future__ import annotations

import queue
import time
from concurrent.futures import CancelledError
from typing import Any, Callable, Dict, Iterable, List, NamedTuple, Optional, Set

import numpy as np
from distributed import Client, Future, KilledWorker
from distributed.comm import CommClosedError

from . import worker


class ClusterError(RuntimeError):
    """A cluster that cannot do the work: it has another version of corank, it is gone, or it fails again and again."""


class Plan(NamedTuple):
    """How units are given out.

    unit_seconds: after this time at most, a worker returns what is left of a unit.
    threads: the number of threads of a unit.
    hang_seconds: a unit without an answer after this time is also submitted elsewhere, then again after twice this time, and
    so on; None: 60 s, or 30 times unit_seconds.
    failures: how often a unit may be lost with its worker.
    """

    unit_seconds: float = 1.0
    threads: int = 1
    hang_seconds: Optional[float] = None
    failures: int = 20

    @property
    def patience(self) -> float:
        """hang_seconds, or its default."""
        return self.hang_seconds if self.hang_seconds is not None else max(60.0, 30 * self.unit_seconds)


class _Given:
    def __init__(self, unit: bytes, seconds: float, patience: float) -> None:
        self.unit = unit
        self.seconds = seconds
        self.patience = patience
        self.deadline = time.monotonic() + patience
        self.futures: Set[Future] = set()
        self.failures = 0


# What a worker's death, a lost connection or too little memory looks like: the unit is not to blame, until it is too often.
_LOST = (KilledWorker, CancelledError, CommClosedError, OSError, MemoryError, TimeoutError)


class Units:
    """The units of one search that are under way, or of other work that is done in parts. Of one thread."""

    def __init__(
        self, client: Client, prepared: bytes, plan: Plan, work: Callable[..., np.ndarray] = worker.run_unit
    ) -> None:
        self._client = client
        self._prepared = prepared
        self._plan = plan
        self._work = work
        self._given: Dict[str, _Given] = {}  # by the keys of its futures
        self._units: Set[_Given] = set()
        self._came: "queue.Queue[Future]" = queue.Queue()
        self.resubmitted = 0

    def __len__(self) -> int:
        return len(self._units)

    def submit(self, units: Iterable[bytes], seconds: float) -> None:
        """Gives them out; each takes at most this many seconds, except for sheets that are cut to the end."""
        given = [_Given(unit, seconds, self._plan.patience) for unit in units]
        self._units.update(given)
        if given:
            self._send(given)

    def answers(self, seconds: float) -> List[np.ndarray]:
        """What has come; where nothing has, waits so long."""
        futures = []
        try:
            futures.append(self._came.get(timeout=seconds))
            while True:
                futures.append(self._came.get_nowait())
        except queue.Empty:
            pass
        answers = []
        for future in futures:
            given = self._given.pop(future.key, None)
            if given is None or given not in self._units:
                continue
            given.futures.discard(future)
            answer = self._answer(future, given)
            if answer is not None:
                self._forget(given)
                answers.append(answer)
        return answers

    def look_after(self) -> None:
        """Submits again what should have come by now."""
        now = time.monotonic()
        late = [given for given in self._units if now > given.deadline]
        if not late:
            return
        try:
            busy = self._client.processing()
        except OSError as error:
            raise ClusterError(f"the connection to the scheduler is lost: {error}") from None
        for given in late:
            keys = {future.key for future in given.futures}
            others = [address for address, theirs in busy.items() if not keys.intersection(theirs)]
            given.patience *= 2
            given.deadline = now + given.patience
            self._send([given], others)
            self.resubmitted += 1

    def cancel(self) -> None:
        """Nobody waits for them any more."""
        for given in list(self._units):
            self._forget(given)

    # --- inner ---

    def _send(self, all_given: List[_Given], workers: Optional[List[str]] = None) -> None:
        """Together: each message of dask's costs as much as what it does for one unit."""
        more = {"workers": workers, "allow_other_workers": True} if workers else {}
        n = len(all_given)
        try:
            futures = self._client.map(
                self._work,
                [self._prepared] * n,
                [given.unit for given in all_given],
                [given.seconds for given in all_given],
                [self._plan.threads] * n,
                pure=False,
                retries=self._plan.failures,
                **more,
            )
        except Exception as error:
            raise ClusterError(f"the scheduler does not answer any more: {error}") from error
        for given, future in zip(all_given, futures):
            self._given[future.key] = given
            given.futures.add(future)
            future.add_done_callback(self._came.put)

    def _answer(self, future: Future, given: _Given) -> Optional[np.ndarray]:
        try:
            return future.result(timeout=self._plan.patience)
        except _LOST as error:
            self._lost(given, error)
        except Exception as error:
            raise ClusterError(f"a worker cannot run a unit: {error}") from error
        return None

    def _lost(self, given: _Given, error: BaseException) -> None:
        if self._client.status in ("closed", "closing"):
            raise ClusterError("the connection to the scheduler is lost")
        given.failures += 1
        if given.failures > self._plan.failures:
            raise ClusterError(f"a unit was lost {given.failures} times, the last time by {type(error).__name__}: {error}")
        if not given.futures:
            self._send([given])
            self.resubmitted += 1

    def _forget(self, given: _Given) -> None:
        self._units.discard(given)
        for future in given.futures:
            self._given.pop(future.key, None)
        if given.futures:
            try:
                self._client.cancel(list(given.futures), force=True)
            except Exception:  # a scheduler that is gone works for nobody
                pass
        given.futures.clear()


def check_versions(client: Client) -> None:
    """Raises ClusterError where a worker has another corank than this process, or none."""
    own = worker.engine_version()
    said: Dict[str, Any] = client.run(worker.engine_version, on_error="return")
    wrong = [
        f"{address}: {'corank ' + theirs if isinstance(theirs, str) else f'no corank ({theirs})'}"
        for address, theirs in sorted(said.items())
        if theirs != own
    ]
    if wrong:
        raise ClusterError(f"all workers need corank {own}, as this process has; these do not have it: {'; '.join(wrong)}")
