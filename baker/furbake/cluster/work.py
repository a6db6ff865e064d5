"""Work of a worker: bakes, and lights of a bake, each in a process of its own with the environment of the command."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from threading import get_ident

from furbake.apart import Apart, CrashError
from furbake.batch.crew import bake_within
from furbake.batch.job import Baked, Job
from furbake.cluster.client import dask
from furbake.cluster.parcel import Parcel, unpacked, written
from furbake.cluster.versions import ClusterError, compare, versions
from furbake.cores import shared_cores
from furbake.device import VARIABLE
from furbake.options import BakeOptions
from furbake.pelt.light.beam import Fields
from furbake.tile.tile import lit


@dataclass(frozen=True)
class Order:
    """A bake for a worker.

    versions : of the machine that orders; folder : its current one; parcel : files, None: they are shared
    bound : bytes that the bake may take, None: any
    """

    job: Job
    versions: Mapping[str, str]
    folder: str
    parcel: Parcel | None
    bound: int | None


def bake_there(order: Order) -> tuple[Baked, dict[str, bytes]]:
    """Bake; the files of the folder too where they are sent. Raises what `bake` does, CrashError and ClusterError."""
    where, environment = _worker()
    compare(where, versions(), order.versions)
    job = replace(order.job, environment={**environment, **order.job.environment})
    if order.parcel is not None:
        with unpacked(job, order.parcel) as there:
            return bake_within(there, order.bound), written(there)
    if not Path(order.folder).is_dir():
        raise ClusterError(f"{where}: has no {order.folder}, expected a folder that all machines share, or --send")
    return bake_within(replace(job, folder=order.folder), order.bound), {}


_held: dict[int, Apart] = {}
"""Processes that keep the voxels of a fur, by the thread of the worker that uses each."""


def lit_there(
    options: BakeOptions, height: float, state: int, some: range, ours: Mapping[str, str], device: str
) -> list[Fields]:
    """Fields of some lights, as of `lit`, on the bake's device. Raises CrashError, ClusterError, DeviceError."""
    where, environment = _worker()
    compare(where, versions(), ours)
    process = _held.get(get_ident())
    if process is None:
        process = _held[get_ident()] = Apart({**environment, VARIABLE: device})
    try:
        found: list[Fields] = process.call(lit, options, height, state, some.start, some.stop)
    except CrashError:
        del _held[get_ident()]
        process.end()
        raise
    return found


def let_go() -> None:
    """End the processes that keep voxels."""
    while _held:
        _held.popitem()[1].end()


def _worker() -> tuple[str, dict[str, str]]:
    """Address of this worker, and the environment of the processes of its units."""
    worker = dask().get_worker()
    return str(worker.address), shared_cores(worker.state.nthreads)
