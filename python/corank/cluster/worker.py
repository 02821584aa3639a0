"""What workers run. Clients send these functions by their names: a worker executes its own copy of corank, and nothing else."""

import numpy as np

from .. import _corank


def run_unit(prepared: bytes, unit: bytes, seconds: float, threads: int) -> np.ndarray:
    """The answer to a unit of a search; what the budget of seconds leaves of it is part of the answer.

    The bytes are an array, since dask sends arrays without copying them."""
    return np.frombuffer(_corank.run_unit(prepared, unit, 0, seconds, threads), dtype=np.uint8)


def engine_version() -> str:
    """Searches of one version can be put together."""
    return _corank.engine_version
