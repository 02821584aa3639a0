"""Searches on many machines: dask.distributed's workers run the units of a search, and the result is corank solve's.

    python3 -m corank.cluster solve models/dextar.cuik --set cspace --sigma 0.01 --workers 2 -o cspace.h5

>>> from corank.cluster import local_client
>>> with local_client(workers=2) as client:  # doctest: +SKIP
...     r = corank.load("models/dextar.cuik").solve("cspace", sigma=0.1, client=client)

It needs the package distributed. doc/cluster.md says how workers on other machines are started, and what happens when one dies.
"""

from ..optional import require

require("distributed")

from .engine import Checkpoints, solve, solve_run  # noqa: E402
from .local import local_client, remote_client, security  # noqa: E402
from .units import ClusterError, Plan, check_versions  # noqa: E402

__all__ = [
    "Checkpoints",
    "ClusterError",
    "Plan",
    "check_versions",
    "local_client",
    "remote_client",
    "security",
    "solve",
    "solve_run",
]
