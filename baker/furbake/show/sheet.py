"""Contact sheet of many bakes: one self-contained page with a small picture and figures of each."""

from __future__ import annotations

import base64
import hashlib
import io
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from pathlib import Path
from urllib.parse import quote

from PIL import Image

from furbake.show.swatch import render

NAME, MARK = "index.html", "<!-- Written by furbake batch. -->"
"""File of the sheet, and the words by which it is told from a page of somebody else."""

SIDE, TILES, QUALITY = 200, 2, 80
"""Side of a small picture in pixels, repeats of the tile on it, and quality of its WebP."""


@dataclass(frozen=True)
class Cell:
    """One bake on the sheet: its name, picture as a data URI, figures in words, and why it failed, if it did."""

    name: str
    picture: str
    facts: tuple[str, ...]
    error: str = ""


def thumbnail(folder: Path) -> str:
    """The fur of a baked folder, small, as a data URI."""
    found = io.BytesIO()
    Image.fromarray(render(folder, tiles=TILES, size=SIDE)).save(found, "webp", quality=QUALITY)
    return f"data:image/webp;base64,{base64.b64encode(found.getvalue()).decode('ascii')}"


def sheet(cells: Sequence[Cell], summary: str) -> str:
    """The page, without a script; its policy lets in its own style and pictures and nothing else.

    summary : of all, one sentence
    """
    style = (files("furbake.show") / "sheet.css").read_text("utf-8")
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode("ascii")
    policy = f"default-src 'none'; img-src data:; style-src 'sha256-{digest}'; base-uri 'none'; form-action 'none'"
    return (
        f'<!doctype html>\n{MARK}\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta name="color-scheme" content="light dark">\n<link rel="icon" href="data:,">\n'
        f"<title>Furs: {len(cells)} bakes</title>\n<style>{style}</style>\n</head>\n<body>\n"
        f"<header><h1>Furs</h1><p>{escape(summary)}</p></header>\n<main>\n"
        + "\n".join(map(_cell, cells))
        + "\n</main>\n</body>\n</html>\n"
    )


def _cell(cell: Cell) -> str:
    name = escape(cell.name)
    if cell.error:
        return f'<article class="failed"><h2>{name}</h2><p>{escape(cell.error)}</p></article>'
    facts = "".join(f"<li>{escape(fact)}</li>" for fact in cell.facts)
    image = f'<img src="{escape(cell.picture)}" width="{SIDE}" height="{SIDE}" alt="Fur of {name} from above">'
    link = f'<a href="{escape(quote(cell.name))}/model.gltf">{name}</a>'
    return f"<article>{image}<h2>{link}</h2><ul>{facts}</ul></article>"
