"""The section of a report that shows the model itself, drawn by the page."""

from __future__ import annotations

import base64
from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory

from furbake.page import PageError, draw
from furbake.show.report.section import section

SIDES = ("front", "left", "back", "right")
"""Sides that the page draws, in reading order."""

SIZE = 360
"""Side of a picture, pixels; shown at half of it and more."""

BACKDROP = "#161310"
"""Colour behind the model."""

LEAD = (
    "From its four sides in daylight, drawn by the page. "
    "<b>Look for</b> seams, bald or stretched places, and fur that hides what should be seen: eyes, paws, a face."
)


def model_section(folder: Path) -> str:
    """The section as HTML; where the page cannot draw, the reason takes the place of the pictures."""
    with TemporaryDirectory(prefix="furbake-") as scratch:
        try:
            draw("sides.mjs", [str(folder.resolve()), scratch, str(SIZE), BACKDROP], "the model")
            files = {side: (Path(scratch) / f"{side}.jpg").read_bytes() for side in SIDES}
        except (PageError, OSError) as error:
            return section("The model", f"Not shown here. {escape(str(error))}.")
    figures = (
        f'<figure><img src="data:image/jpeg;base64,{base64.b64encode(data).decode("ascii")}" '
        f'width="{SIZE}" height="{SIZE}" alt="The model from its {side}"><figcaption>{side}</figcaption></figure>'
        for side, data in files.items()
    )
    return section("The model", LEAD, f'<div class="sides">{"".join(figures)}</div>')
