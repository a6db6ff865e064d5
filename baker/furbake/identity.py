"""Input, options and versions of a bake, as recorded; a key of them tells stale assets from fresh ones."""

from __future__ import annotations

import hashlib
import json
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from furbake.options import BakeOptions
from furbake.options.bake_options import named_files
from furbake.options.regions import region_files
from furbake.rti.files import members
from furbake.surface.files import read_regular
from furbake.surface.limits import Budget
from furbake.surface.mesh import Surface
from furbake.surface.read.companions import companions
from furbake.surface.shapes import is_builtin

LIBRARIES = (
    "numpy",
    "scipy",
    "OpenImageIO",
    "trimesh",
    "embreex",
    "DracoPy",
    "fast-simplification",
    "meshopt",
    "Pillow",
)


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
    budget = Budget(model, "bytes")
    found = hashlib.sha256(read_regular(Path(model), budget))
    for beside in companions(Path(model)):
        found.update(read_regular(beside, budget))
    return found.hexdigest()


def bake_key(model: str, options: BakeOptions) -> str:
    """SHA-256 of everything that decides the result: version, options, input. A differing key means a stale asset."""
    files = list(named_files(options).values())
    if options.swatch is not None:
        files += [str(path) for path in members(Path(options.swatch))]
    if options.region_file is not None:
        files += region_files(options.region_file)
    parts = {
        "furbake": version("furbake"),
        "options": options.as_record(),
        "input": input_hash(model),
        "files": [hashlib.sha256(read_regular(Path(file), Budget(file, "bytes"))).hexdigest() for file in files],
    }
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()
