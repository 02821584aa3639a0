"""Schedulers: one of one's own, with worker processes on this machine, or one that runs already."""

from __future__ import annotations

import contextlib
import gc
from typing import Iterator, Optional

import dask.config
from distributed import Client, LocalCluster, versions
from distributed.security import Security
from distributed.utils import get_mp_context

from . import forks
from .units import ClusterError


# Without one, dask's pages about schedulers and workers listen on every network.
_ANY_PORT = "127.0.0.1:0"
_SETTINGS = {
    "distributed.scheduler.allowed-failures": 1000,  # Plan.failures says when a unit is to blame for a worker's death
    # A nanny starts its worker anew, however long that takes on a busy machine; dask by default ends both after 15 s without.
    "distributed.deploy.lost-worker-timeout": "1 day",
    "distributed.comm.compression": None,  # takes longer than sending to another process of the machine
    **{f"distributed.nanny.pre-spawn-environ.{name}": value for name, value in forks.MEMORY.items()},
    # What looks at processes that do nothing takes a tenth of a core: dask's profiler 100 times a second, health checks 50 times.
    "distributed.worker.profile.enabled": False,
    "distributed.diagnostics.computations.ignore-modules": [
        "."
    ],  # the source code of who gives work out is read for each unit
    "distributed.admin.tick.interval": "500ms",
    "distributed.admin.system-monitor.interval": "2s",
    "distributed.worker.memory.monitor-interval": "1s",
    # Workers are copies of one process that has imported what they need, once.
    "distributed.worker.multiprocessing-method": "forkserver",
}


@contextlib.contextmanager
def _settings() -> Iterator[None]:
    with dask.config.set(_SETTINGS):
        former = versions.optional_packages
        versions.optional_packages = forks.compared(former)
        get_mp_context()  # sets dask's own list of what is imported, which the next one replaces
        forks.preload()
        try:
            yield
        finally:
            versions.optional_packages = former


def security(ca: Optional[str] = None, cert: Optional[str] = None, key: Optional[str] = None) -> Optional[Security]:
    """Returns dask's TLS settings from PEM files; None if no file is given, so that dask's configuration counts."""
    if ca is None and cert is None and key is None:
        return None
    if ca is None or cert is None:
        raise ClusterError("TLS needs the files of the authority and of the certificate: ca and cert (and key)")
    files = {
        f"tls_{role}_{kind}": name
        for role in ("client", "scheduler", "worker")
        for kind, name in (("cert", cert), ("key", key))
        if name is not None
    }
    return Security(tls_ca_file=ca, require_encryption=True, **files)


@contextlib.contextmanager
def local_client(
    workers: int = 2, *, host: str = "127.0.0.1", dashboard: Optional[int] = None, tls: Optional[Security] = None
) -> Iterator[Client]:
    """Returns a client with worker processes on this machine, each with one thread, which end with it.

    Args:
        workers: the number of worker processes.
        host: where the scheduler listens; default: loopback.
        dashboard: the port of dask's dashboard, which needs bokeh; None: no dashboard.
    """
    if dashboard is not None:
        try:
            import bokeh  # noqa: F401
        except ImportError:
            raise ClusterError("dask's dashboard needs the package bokeh, which is not there") from None
    pages = {"dashboard": dashboard is not None, "dashboard_address": f"{host}:{dashboard}" if dashboard else _ANY_PORT}
    with _settings():
        with LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            host=host,
            security=tls,
            scheduler_kwargs=pages,
            worker_dashboard_address=_ANY_PORT,
        ) as cluster, Client(cluster, direct_to_workers=True) as client:
            yield client


@contextlib.contextmanager
def remote_client(address: str, tls: Optional[Security] = None) -> Iterator[Client]:
    """Returns a client of the scheduler at an address such as tcp://10.0.0.1:8786, or tls://…"""
    refusal: Optional[str] = None
    try:
        client = Client(address, security=tls, timeout="20s")
    except (OSError, ValueError) as error:
        refusal = str(error)
    except TypeError as error:  # dask's, without the files of a certificate
        refusal = f"TLS needs a certificate's files, see security(): {error}"
    if refusal is not None:
        # Dask closes the client that failed when it is collected. Where that happens while another client begins, its
        # thread waits for a lock that it holds itself.
        gc.collect()
        raise ClusterError(f"no scheduler at {address}: {refusal}")
    with client:
        yield client
