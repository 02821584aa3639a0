"""Work that consists of independent parts: maps over two parameters, families of mechanisms."""

from __future__ import annotations

import pickle
from typing import Any, Callable, Dict, List, Sequence, Tuple

import numpy as np
from distributed import Client

from ..progress import ProgressOption, Shown
from ..result import Result
from . import worker
from .units import Plan, Units, check_versions

_PATIENT = Plan(hang_seconds=3600.0)  # a part is done to its end, however long it takes


def _run(
    work: Callable[..., np.ndarray],
    stage: str,
    question: Any,
    parts: int,
    client: Client,
    plan: Plan,
    progress: ProgressOption,
) -> Tuple[List[bytes], bool]:
    """The answers that have come, in no order; False: Ctrl-C has ended it."""
    check_versions(client)
    units = Units(client, pickle.dumps(question), plan, work)
    answers: List[bytes] = []
    try:
        with Shown(progress) as show:
            units.submit((str(k).encode() for k in range(parts)), 0)
            while len(units) > 0:
                answers += [answer.tobytes() for answer in units.answers(0.5)]
                units.look_after()
                if show is not None:
                    show(stage, len(answers) / parts, f"{len(answers)} of {parts} parts")
    except KeyboardInterrupt:
        return answers, False
    finally:
        units.cancel()
    return answers, True


def map_tiles(
    question: Tuple[Any, ...], tiles: int, client: Client, *, plan: Plan = _PATIENT, progress: ProgressOption = None
) -> Tuple[List[str], bool]:
    """The tiles of corank.Mechanism.map's question, as texts, and whether all are there: not after Ctrl-C."""
    answers, whole = _run(worker.run_tile, "map", question, tiles, client, plan, progress)
    return [answer.decode() for answer in answers], whole


def solve_members(
    searches: Sequence[Tuple[Any, str, Dict[str, Any]]],
    client: Client,
    *,
    plan: Plan = _PATIENT,
    progress: ProgressOption = None,
) -> Tuple[Dict[int, Result], bool]:
    """Of (mechanism, set, options of its solve()) the results by number, and whether all are there: not after Ctrl-C."""
    answers, whole = _run(worker.run_member, "family", list(searches), len(searches), client, plan, progress)
    return dict(pickle.loads(answer) for answer in answers), whole


__all__ = ["map_tiles", "solve_members"]
