"""Options of a bake, and the presets that set them."""

from typing import TYPE_CHECKING

from furbake.lazy import lazily
from furbake.options.knobs import OptionError

if TYPE_CHECKING:
    from furbake.options.bake_options import BakeOptions
    from furbake.options.presets import as_toml, override, preset, preset_names, preset_summary

__all__ = ["BakeOptions", "OptionError", "as_toml", "override", "preset", "preset_names", "preset_summary"]

__getattr__ = lazily(
    __name__,
    {
        "BakeOptions": "furbake.options.bake_options",
        **dict.fromkeys(("as_toml", "override", "preset", "preset_names", "preset_summary"), "furbake.options.presets"),
    },
)
