"""Bakes fur that can be relit in real time: from a mesh to a folder with glTF and two small images."""

from typing import TYPE_CHECKING

from furbake.lazy import lazily

if TYPE_CHECKING:
    from furbake.asset.store import StoreError
    from furbake.asset.validate import validate
    from furbake.options import BakeOptions, OptionError, preset, preset_names
    from furbake.pipeline import BakeResult, bake
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

__getattr__ = lazily(
    __name__,
    {
        "BakeOptions": "furbake.options",
        "BakeResult": "furbake.pipeline",
        "MeshError": "furbake.surface.mesh",
        "OptionError": "furbake.options",
        "StoreError": "furbake.asset.store",
        "bake": "furbake.pipeline",
        "preset": "furbake.options",
        "preset_names": "furbake.options",
        "validate": "furbake.asset.validate",
    },
)
