"""What workers run. Clients send these functions by their names: a worker executes its own copy of corank, and nothing else."""

import functools
import pickle
from typing import Any

import numpy as np

from .. import _corank
from ..expression import _ranges, as_expression
from ..options import ask


def run_unit(prepared: bytes, unit: bytes, seconds: float, threads: int) -> np.ndarray:
    """The answer to a unit of a search; what the budget of seconds leaves of it is part of the answer.

    The bytes are an array, since dask sends arrays without copying them."""
    return _corank.run_unit(prepared, unit, 0, seconds, threads)


@functools.lru_cache(maxsize=1)
def _parameter_map(question: bytes) -> Any:
    mechanism, set, over, fixed, *options = pickle.loads(question)
    values = [(name, as_expression(value)) for name, value in fixed.items()]
    return _corank.ParameterMap(ask(mechanism._core, set), _ranges(over), values, *options)


def run_tile(question: bytes, unit: bytes, seconds: float, threads: int) -> np.ndarray:
    """A part of a map over two parameters, to its end, with one thread."""
    return np.frombuffer(_parameter_map(question).tile(int(unit)).encode(), dtype=np.uint8)


def run_member(question: bytes, unit: bytes, seconds: float, threads: int) -> np.ndarray:
    """A search of a family's, to its end: its number and its result."""
    mechanism, set, options = pickle.loads(question)[int(unit)]
    result = mechanism.solve(set, progress=False, **options)
    return np.frombuffer(pickle.dumps((int(unit), result)), dtype=np.uint8)


def engine_version() -> str:
    """Searches of one version can be put together."""
    return _corank.engine_version
