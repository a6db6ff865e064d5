"""The way to a scheduler of Dask and its workers, or to workers of this machine."""

from __future__ import annotations

import logging
import time
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any

from furbake.cluster.versions import ClusterError, compare, versions
from furbake.cores import shared_cores

PATIENCE = 30
"""Seconds in which a scheduler answers and its first worker comes."""

INSTALL = "pip install 'furbake[cluster]' (in a clone, './baker[cluster]')"


def dask() -> Any:
    """The module of Dask, an optional extra. Raises ClusterError where it is missing."""
    try:
        return import_module("distributed")
    except ImportError:
        raise ClusterError(f"distributed: not installed, expected {INSTALL}") from None


@contextmanager
def connected(scheduler: str, workers: int) -> Iterator[Any]:
    """A client of the scheduler at this address, or of as many workers of this machine where it is `local`.

    All workers have the versions of this process. Raises ClusterError, with one sentence.
    """
    distributed = dask()
    if scheduler == "local":
        with (
            distributed.LocalCluster(
                n_workers=workers, threads_per_worker=1, memory_limit=0, dashboard_address=None,
                silence_logs=logging.CRITICAL, env=shared_cores(workers),
            ) as cluster,
            distributed.Client(cluster) as client,
        ):  # fmt: skip
            yield client
        return
    if "://" not in scheduler:
        raise ClusterError(f"scheduler: got {scheduler!r}, expected local or an address such as tcp://10.0.0.1:8786")
    for name in ("distributed", *logging.root.manager.loggerDict):
        if name.startswith("distributed"):
            logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        with warnings.catch_warnings(action="ignore"):  # on versions, which are compared below
            client = distributed.Client(scheduler, timeout=PATIENCE)
    except (OSError, ValueError) as error:
        raise ClusterError(
            f"scheduler: nobody answers at {scheduler} ({type(error).__name__}), expected a Dask scheduler there"
        ) from None
    with client:
        ours = versions()
        for where, theirs in _asked(client, versions).items():
            compare(where, theirs, ours)
        yield client


def check_shared(client: Any, folder: Path) -> None:
    """Raise ClusterError where a worker does not see a file that this machine puts where `folder` is or will be."""
    there = next(place for place in (folder.absolute(), *folder.absolute().parents) if place.is_dir())
    with NamedTemporaryFile(dir=there, prefix=".furbake-") as probe:
        for where, seen in _asked(client, Path(probe.name).exists).items():
            if not seen:
                expected = "expected a folder that all machines share, or --send"
                raise ClusterError(f"{where}: does not see what is in {there}, {expected}")


def _asked(client: Any, question: Callable[[], Any]) -> Mapping[str, Any]:
    """Answer of each worker but of those that are lost meanwhile. Raises ClusterError where one has none, or all."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        found: dict[str, Any] = {}
        for where, answer in client.run(question, on_error="return").items():
            if isinstance(answer, OSError):  # its connection
                continue
            if isinstance(answer, Exception):
                text = f"{type(answer).__name__}: {' '.join(str(answer).split())}"
                raise ClusterError(f"{where}: no furbake that answers ({text}), expected the same as here")
            found[where] = answer
        if found:
            return found
        time.sleep(0.2)
    raise ClusterError(f"{client.scheduler.address}: no worker within {PATIENCE} s, expected one or more")
