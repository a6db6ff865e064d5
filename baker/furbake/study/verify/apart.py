"""The path tracer in a process of its own: where it crashes, or is out of memory, a sentence is left."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from furbake.apart import TELL, Apart, CrashError
from furbake.study.verify import truth
from furbake.study.verify.cells import Cell, Frame
from furbake.study.verify.pathtrace import DEPTH, VerifyError


def trace(
    scene: truth.Scene,
    seen: Frame,
    cells: list[Cell],
    spp: int,
    step: Callable[[float], None] = lambda fraction: None,
    *,
    fast: bool = True,
) -> list[truth.Traced]:
    """As `truth.trace`. Raises VerifyError where Mitsuba is missing, and where it crashes."""
    process = Apart()
    try:
        found: list[truth.Traced] = process.call(
            partial(truth.trace, fast=fast), scene, seen, cells, spp, DEPTH, TELL, tell=step
        )
    except CrashError as error:
        other = " or --scalar" if fast else ""
        raise VerifyError(
            f"mitsuba: ended by {error} with {len(scene.groom.points)} hairs, expected fewer of them "
            f"(bake with a larger --tile, or fewer by --set coat.under.count=N){other}"
        ) from error
    finally:
        process.end()
    return found
