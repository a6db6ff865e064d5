"""Folders as `furbake` leaves them, in the least number of bytes."""

from __future__ import annotations

import json
from pathlib import Path

RECORD = json.dumps({"furbake": "0.1.0", "key": "old", "asset": {"bytes": {"model.gltf": 2}}})


def names(folder: Path) -> list[str]:
    return sorted(entry.name for entry in folder.iterdir())


def make_old(folder: Path) -> Path:
    folder.mkdir()
    (folder / "bake.json").write_text(RECORD)
    (folder / "model.gltf").write_text("{}")
    return folder
