"""Memory: what a bake is likely to need, what processes hold, what there is."""

from __future__ import annotations

import os
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

import psutil

from furbake.cores import cores
from furbake.options import BakeOptions
from furbake.pelt.hairs.volume import fine_shape
from furbake.surface.shapes import is_builtin

SHARE = 0.8
"""Share of the free memory that a batch takes where no bound is given."""

BASE = 200e6
"""Bytes of a bake without voxels, lights and mesh: libraries for the most part. Measured: 197 MB for 4 x 16^2."""

PER_VOXEL, PER_THREAD = 200.0, 35.0
"""Bytes for each oversampled voxel, and for each that a thread works on. Measured with two threads: 262 and 265 in all
for 16 x 64^2 and 24 x 128^2."""

PER_SAMPLE = 12.0
"""Bytes for each light of each texel of each state beyond the 96 lights of those measurements."""

PER_BYTE = 25.0
"""Bytes for each of a model file."""

CGROUP = Path("/sys/fs/cgroup/memory.max")


def guess(model: str, options: BakeOptions) -> int:
    """Bytes that a bake may need, before anything like it has been measured."""
    layers, size = options.layers, options.size
    slabs, width = fine_shape(layers, size, options.own_height)
    states = len(options.states) + options.dirt
    more = max(1.5 * options.lights * states - 96, 0) * layers * size**2
    of_file = 0 if is_builtin(model) else _size(model)
    voxels = slabs * width**2
    return int(BASE + voxels * (PER_VOXEL + PER_THREAD * cores()) + PER_SAMPLE * more + PER_BYTE * of_file)


def _size(model: str) -> int:
    try:
        return Path(model).stat().st_size
    except OSError:
        return 0


def free() -> int:
    """Bytes that a batch may take by itself: most of those that are free on the machine, or in its container."""
    found = psutil.virtual_memory().available
    with suppress(OSError, ValueError):
        found = min(found, int(CGROUP.read_text("ascii")))
    return int(SHARE * found)


def held(processes: Iterable[int]) -> list[int]:
    """Bytes that each of these processes holds now, 0 of one that has ended."""
    found = []
    for number in processes:
        try:
            found.append(int(psutil.Process(number).memory_info().rss))
        except psutil.Error:
            found.append(0)
    return found


def own() -> int:
    """Bytes that this process holds."""
    return held([os.getpid()])[0]


def peak_memory() -> int:
    """Most bytes that this process has held so far; what it holds now where the system does not count them."""
    with suppress(OSError, StopIteration):
        lines = Path("/proc/self/status").read_text("ascii").splitlines()
        return 1024 * next(int(line.split()[1]) for line in lines if line.startswith("VmHWM:"))
    found = psutil.Process().memory_info()
    return int(getattr(found, "peak_wset", found.rss))
