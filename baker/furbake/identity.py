"""What decides a bake: input, options, versions. It is recorded, and tells a stale asset from a fresh one."""

from __future__ import annotations

import hashlib
import json
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from furbake.options import FILES, OF_VERTICES, BakeOptions
from furbake.surface.companions import companions
from furbake.surface.mesh import Surface
from furbake.surface.shapes import is_builtin

LIBRARIES = ("numpy", "scipy", "OpenImageIO", "trimesh", "embreex", "DracoPy", "fast-simplification", "Pillow")


def library_versions() -> dict[str, str]:
    """Versions of the libraries that the result depends on, of those that are there."""
    versions = {}
    for name in LIBRARIES:
        with suppress(PackageNotFoundError):
            versions[name] = version(name)
    return versions


def describe_input(model: str, surface: Surface) -> dict[str, Any]:
    """Name, hash and size of what was baked."""
    return {
        "name": Path(model).name,
        "sha256": input_hash(model),
        "vertices": len(surface.vertices),
        "faces": len(surface.faces),
    }


def input_hash(model: str) -> str:
    """SHA-256 of the file and those that it is read with, or of the built-in shape's name."""
    if is_builtin(model):
        return hashlib.sha256(model.encode()).hexdigest()
    found = hashlib.sha256(Path(model).read_bytes())
    for beside in companions(Path(model)):
        found.update(beside.read_bytes())
    return found.hexdigest()


def bake_key(model: str, options: BakeOptions) -> str:
    """SHA-256 of everything that decides the result: version, options, input. A differing key means a stale asset."""
    named = [getattr(options, name) for name in FILES]
    files = [name for name in named if name is not None and not name.startswith(OF_VERTICES)]
    parts = {
        "furbake": version("furbake"),
        "options": options.as_record(),
        "input": input_hash(model),
        "files": [hashlib.sha256(Path(file).read_bytes()).hexdigest() for file in files],
    }
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()
