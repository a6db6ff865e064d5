"""Bakes fur that can be relit in real time: from a mesh to a folder with glTF and two small images."""

from furbake.asset.store import StoreError
from furbake.asset.validate import validate
from furbake.bake import BakeResult, bake
from furbake.options import BakeOptions, OptionError, preset, preset_names
from furbake.surface.mesh import MeshError

__all__ = [
    "BakeOptions",
    "BakeResult",
    "MeshError",
    "OptionError",
    "StoreError",
    "bake",
    "preset",
    "preset_names",
    "validate",
]
