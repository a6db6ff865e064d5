"""Throughput of the fit beside numpy's least squares, on the same samples in the same run.

    baker/.venv/bin/python tests/bench/fit.py [LAYERS SIZE LIGHTS]

The rivals run in turn, A B B A; what counts is the ratio of their medians. One unit is a texel under a light.
"""

from __future__ import annotations

import resource
import statistics
import sys
import time
from collections.abc import Callable

import numpy as np

from furbake.pelt.light.transport import hemisphere
from furbake.pelt.texels.basis import PTM
from furbake.pelt.texels.fit import fit


def seconds(work: Callable[[], object]) -> float:
    """Wall-clock seconds of one call."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def main(layers: int = 24, size: int = 128, count: int = 64) -> None:
    """Print a table of both and their ratio."""
    lights = hemisphere(count)
    samples = np.random.default_rng(0).random((count, layers, size, size), dtype=np.float32)
    phi = PTM(lights).astype(np.float32)
    rivals = {
        "furbake": lambda: fit(samples, PTM, lights),
        "numpy.linalg.lstsq": lambda: np.linalg.lstsq(phi, samples.reshape(count, -1), rcond=None),
    }
    times: dict[str, list[float]] = {name: [] for name in rivals}
    for name in [*rivals, *reversed(rivals)] * 2:
        times[name].append(seconds(rivals[name]))
    medians = {name: statistics.median(values) for name, values in times.items()}
    units = samples.size / 1e6
    for name, median in medians.items():
        print(f"{name:<20} {median:7.3f} s  {units / median:8.0f} Mpixel·lights per second")
    print(f"furbake is {medians['numpy.linalg.lstsq'] / medians['furbake']:.2f} times as fast")
    print(f"peak memory of this run {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20:.2f} GiB")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
