"""The process of which local workers are copies: it has imported what they need, once.

Nothing here imports dask: the command line starts this process first, and both import it at the same time.
"""

from __future__ import annotations

import multiprocessing
import multiprocessing.forkserver
import os
from typing import Any, List, Sequence, Tuple

# Workers keep memory between units, which glibc by default gives back and fetches anew.
MEMORY = {"MALLOC_TRIM_THRESHOLD_": 1 << 30, "MALLOC_MMAP_MAX_": 0, "MALLOC_ARENA_MAX": 1}

# Dask's own defaults, before NumPy is loaded: a process with threads cannot be copied.
_ONE_THREAD = {f"{library}_NUM_THREADS": 1 for library in ("OMP", "MKL", "OPENBLAS")}

_PRELOADED = ["distributed", "corank.cluster.forked"]


def preload() -> None:
    """Says what is imported by the process if it has not begun yet."""
    multiprocessing.get_context("forkserver").set_forkserver_preload(_PRELOADED)


def begin() -> None:
    """Starts it. It ends with the process that it belongs to."""
    preload()
    for name, value in {**MEMORY, **_ONE_THREAD}.items():  # as dask sets them, too
        os.environ.setdefault(name, str(value))
    multiprocessing.forkserver.ensure_running()


def are_wanted(arguments: Sequence[str]) -> bool:
    """Of the command line: does it look as if it were to have workers of its own?"""
    return len(arguments) > 1 and not any(a in ("-h", "--help") or a.startswith("--scheduler") for a in arguments)


def compared(packages: Sequence[Tuple[str, Any]]) -> List[Tuple[str, Any]]:
    """Of the packages that dask imports in each process to compare their versions. Frames are not sent, and pandas takes 0.25 s."""
    return [package for package in packages if package[0] != "pandas"]
