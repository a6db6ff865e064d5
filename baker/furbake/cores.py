"""Threads that a bake may use."""

from __future__ import annotations

import os

VARIABLE = "FURBAKE_THREADS"
"""Environment variable that sets them, for several bakes beside each other."""


def cores() -> int:
    """Threads of `FURBAKE_THREADS`, else the cores that this process may use. No result depends on them."""
    given = os.environ.get(VARIABLE, "")
    if given.isdecimal() and int(given) > 0:
        return int(given)
    affinity = getattr(os, "sched_getaffinity", None)  # a cluster gives a job some of a machine's cores
    return len(affinity(0)) if affinity else os.cpu_count() or 1


def shared_cores(count: int) -> dict[str, str]:
    """Environment of each of `count` bakes beside each other, unless `FURBAKE_THREADS` is set already."""
    return {VARIABLE: os.environ.get(VARIABLE) or str(max(1, cores() // count))}
