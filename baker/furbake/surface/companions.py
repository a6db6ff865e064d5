"""Files that a mesh file names and that are part of the input: buffers and pictures of glTF, materials of OBJ."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any
from urllib.parse import unquote


def companions(path: Path) -> list[Path]:
    """The files beside a mesh file that it is read with, those that exist, in the order of their names."""
    kind = path.suffix.lower()
    try:
        if kind == ".gltf":
            names = _of_gltf(json.loads(path.read_text("utf-8-sig")))
        elif kind == ".obj":
            names = _of_obj(path)
        else:
            names = []
        found = {path.parent / name for name in names}
        return sorted(file for file in found if file.is_file())
    except (OSError, ValueError, TypeError, AttributeError):
        return []


def _of_gltf(document: Any) -> list[str]:
    entries = [*document.get("buffers", []), *document.get("images", [])]
    uris = [str(entry["uri"]) for entry in entries if "uri" in entry]
    return [unquote(uri) for uri in uris if not uri.startswith("data:") and "://" not in uri]


def _of_obj(path: Path) -> list[str]:
    libraries = re.findall(r"^mtllib\s+(.+?)\s*$", path.read_text("utf-8", "replace"), flags=re.MULTILINE)
    pictures: list[str] = []
    for name in libraries:
        library = path.parent / name
        if library.is_file():
            text = library.read_text("utf-8", "replace")
            pictures += re.findall(r"^\s*map_kd\s+(.+?)\s*$", text, flags=re.MULTILINE | re.IGNORECASE)
    return [*libraries, *pictures]
