"""`report.html` of a baked folder: one self-contained page that shows how good the bake is, and where it is not."""

from __future__ import annotations

from pathlib import Path

from furbake.asset.store import atomic_file
from furbake.show.report.measure import STAGES, Progress, measure
from furbake.show.report.page import page

__all__ = ["NAME", "STAGES", "write"]

NAME = "report.html"


def write(folder: Path, progress: Progress = lambda stage, fraction: None) -> Path:
    """Write the report of a baked folder into it, whole or not at all; where it is.

    progress : called with a stage of `STAGES` and the fraction of it that is done

    The same folder and version give the same bytes. Raises AssetError or StoreError, each with one sentence.
    """
    measured = measure(folder, progress)
    progress("write", 0.0)
    text = page(measured)
    out = folder / NAME
    with atomic_file(out) as file:
        file.write(text.encode("utf-8"))
    progress("write", 1.0)
    return out
