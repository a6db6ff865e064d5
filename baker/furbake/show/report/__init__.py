"""`report.html` of a baked folder: one self-contained page that shows how good the bake is, and where it is not."""

from __future__ import annotations

from pathlib import Path

from furbake.asset.store import atomic_file
from furbake.show.report.measure import STAGES, Progress, measure
from furbake.show.report.page import page
from furbake.show.report.sides import model_section

__all__ = ["NAME", "STAGES", "write"]

NAME = "report.html"


def write(folder: Path, progress: Progress = lambda stage, fraction: None, *, shown: bool = True) -> Path:
    """Write the report of a baked folder into it, whole or not at all; where it is.

    progress : called with a stage of `STAGES` and the fraction of it that is done
    shown : whether it opens with pictures of the model, which need Node, a browser and the repository

    The same folder and version give the same bytes, on the same machine where the model is shown. Raises AssetError or
    StoreError, each with one sentence.
    """
    measured = measure(folder, progress)
    progress("model", 0.0)
    opening = model_section(folder) if shown else ""
    progress("model", 1.0)
    progress("write", 0.0)
    text = page(measured, opening)
    out = folder / NAME
    with atomic_file(out) as file:
        file.write(text.encode("utf-8"))
    progress("write", 1.0)
    return out
