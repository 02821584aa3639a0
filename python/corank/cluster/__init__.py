"""Searches on many machines: workers of dask.distributed run the units of a search. The result is that of corank solve.

    python3 -m corank.cluster solve models/dextar.cuik --set cspace --sigma 0.01 --workers 2 -o cspace.h5

>>> from corank.cluster import local_client
>>> with local_client(workers=2) as client:  # doctest: +SKIP
...     r = corank.load("models/dextar.cuik").solve("cspace", sigma=0.1, client=client)

It needs the package distributed. doc/cluster.md says how to start workers on other machines, and what happens if one dies.
"""

import importlib
from typing import TYPE_CHECKING, Any, List

from ..optional import expect

if TYPE_CHECKING:
    from .engine import Checkpoints, solve, solve_run
    from .local import local_client, remote_client, security
    from .tasks import map_tiles, solve_members
    from .units import ClusterError, Plan, check_versions

expect("distributed")
expect("numpy")

__all__ = [
    "Checkpoints",
    "ClusterError",
    "Plan",
    "check_versions",
    "local_client",
    "map_tiles",
    "remote_client",
    "security",
    "solve",
    "solve_members",
    "solve_run",
]

# Imported where they are asked for: importing dask takes its time, in which the command line has something else to do.
_MODULES = {
    "engine": ("Checkpoints", "solve", "solve_run"),
    "local": ("local_client", "remote_client", "security"),
    "tasks": ("map_tiles", "solve_members"),
    "units": ("ClusterError", "Plan", "check_versions"),
}
_HOME = {name: module for module, names in _MODULES.items() for name in names}


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f".{_HOME[name]}", __name__), name)


def __dir__() -> List[str]:
    return sorted({*globals(), *__all__})
