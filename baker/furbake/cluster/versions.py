"""Versions that must be the same on all machines, so that results are the same bytes."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from importlib.metadata import version

from furbake.identity import library_versions
from furbake.tile.kept import code_hash

CODE = "code"
"""Name of the hash of furbake's own code, which may differ within a version."""


class ClusterError(RuntimeError):
    """Machines that cannot be used; the message says what was got and what was expected."""


def versions() -> dict[str, str]:
    """Versions of furbake, its code, Python, the kind of machine and the libraries that results depend on."""
    return {
        "furbake": version("furbake"),
        CODE: code_hash(("",)),
        "Python": ".".join(platform.python_version_tuple()[:2]),
        "machine": platform.machine(),
        "distributed": version("distributed"),
        **library_versions(),
    }


def compare(where: str, theirs: Mapping[str, str], ours: Mapping[str, str]) -> None:
    """Raise ClusterError for the first version that differs on a worker."""
    for name in [*ours, *theirs]:
        got, expected = theirs.get(name), ours.get(name)
        if got == expected:
            continue
        if name == CODE:
            raise ClusterError(f"{where}: other code of furbake {ours['furbake']}, expected the same as here")
        raise ClusterError(f"{where}: {name} is {got or 'missing'}, expected {expected or 'none'} as here")
