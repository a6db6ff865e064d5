"""The command `furbake`: the only room that prints, shows progress or exits."""

import os
from collections.abc import Sequence

from furbake.cli.interrupt import importing

# One thread for algebra, before NumPy reads it: a bake has a thread for each core already.
for library in ("OPENBLAS", "OMP", "MKL"):
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; its exit status: 0 done, 1 something is invalid, 2 bad input, 130 interrupted."""
    with importing():
        from furbake.cli.command import run  # noqa: PLC0415 — so that Ctrl-C is understood meanwhile
    return run(argv)


__all__ = ["main"]
