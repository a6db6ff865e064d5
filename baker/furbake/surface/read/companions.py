"""Files that a mesh file names and that are part of the input: buffers and pictures of glTF, materials of OBJ."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from furbake.surface.files import beside, nearby, read_regular
from furbake.surface.limits import Budget


def companions(path: Path) -> list[Path]:
    """Existing files beside a mesh file that are read with it, by name."""
    kind = path.suffix.lower()
    budget = Budget(str(path), "bytes")
    try:
        if kind == ".gltf":
            names = _of_gltf(json.loads(read_regular(path, budget).decode("utf-8-sig")))
            found = {file for name in names if (file := _found(path, (name,)))}
        elif kind == ".obj":
            found = set(_of_obj(path, budget))
        else:
            found = set()
        return sorted(found)
    except (OSError, ValueError, TypeError, AttributeError, RecursionError):
        return []


def _found(model: Path, names: tuple[str, ...]) -> Path | None:
    """The first of these that is a file in the model's own folder."""
    for name in names:
        try:
            file = beside(model, name)
            if file.is_file():
                return file
        except (OSError, ValueError):
            continue
    return None


def _of_gltf(document: Any) -> list[str]:
    entries = [*document.get("buffers", []), *document.get("images", [])]
    uris = [str(entry["uri"]) for entry in entries if "uri" in entry]
    return [unquote(uri) for uri in uris if not uri.startswith("data:") and "://" not in uri]


def _of_obj(path: Path, budget: Budget) -> Iterator[Path]:
    for name in _named(read_regular(path, budget), "mtllib", exact=True):
        library = _found(path, nearby(name))
        if library is not None:
            yield library
            pictures = _named(read_regular(library, budget), "map_kd")
            yield from (file for picture in pictures if (file := _found(path, nearby(picture))))


def _named(data: bytes, word: str, exact: bool = False) -> Iterator[str]:
    """Names behind a word that begins a line; unless exact, in letters of either case and after blanks."""
    for line in data.decode("utf-8", "replace").splitlines():
        begin = line if exact else line.strip()
        if (begin if exact else begin.lower()).startswith(word) and begin[len(word) : len(word) + 1].isspace():
            name = begin[len(word) :].strip()
            if name:
                yield name
