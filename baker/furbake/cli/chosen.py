"""From arguments of the command to the options of a bake."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

from furbake.options import BakeOptions, OptionError, override, preset
from furbake.options.bake_options import THIN
from furbake.pelt.hairs.states import WETNESS
from furbake.rti.relight import INFO
from furbake.surface.shapes import is_builtin

GIVEN = (
    "layers", "size", "lights", "basis", "coefficients", "bits", "curves", "length", "tile", "height", "seed", "flat",
    "guide", "length_by_thickness", "fins", "uv", "max_faces", "length_map", "mask", "comb", "features", "directions",
    "meshopt", "states", "dirt", "pose", "swatch", "colour", "regions", "rig", "groom", "follow",
)  # fmt: skip
"""Options of the command that are options of the bake; one that is not given is the preset's."""


def chosen(args: SimpleNamespace) -> BakeOptions:
    """The preset's options, overridden by every `--set`, then by the options of the command."""
    options = preset(args.preset, bool(getattr(args, "own_colours", None)))
    try:
        options = override(options, dict(args.set))
    except OptionError as error:
        raise OptionError(f"set: {error}") from None
    given = {name: getattr(args, name, None) for name in GIVEN}
    if given["states"] == ("dry..wet",):
        given["states"] = tuple(WETNESS)
    if given["swatch"] is not None:
        beside = {name: getattr(args, name, None) for name in ("lights", "device")}
        _refuse_grown({**dict(args.set), **beside})
        if (info := Path(given["swatch"], INFO)).is_file():  # in a folder of relight
            given["swatch"] = str(info)
        options = replace(options, **THIN)
    options = replace(options, **{name: value for name, value in given.items() if value is not None})
    if options.guide.endswith(".json"):  # strokes, and where there are none from nose to tail
        if options.comb is not None:
            raise OptionError(f"comb: got {options.comb} beside the strokes of --guide, expected one file of strokes")
        options = replace(options, guide=BakeOptions.guide, comb=options.guide)
    options.check()
    return options


def _refuse_grown(given: Mapping[str, object]) -> None:
    """Raise OptionError for what says how hairs are grown and lit, beside photographs of them; given : knobs."""
    for name, value in given.items():
        if value is not None and name.startswith(("lights", "device", "coat.", "ramp.")):
            raise OptionError(f"{name}: got {value} beside a swatch, expected it of fur that is grown and lit here")


def options_for(model: str, args: SimpleNamespace) -> BakeOptions:
    """As `chosen`, of a bake of this model: the length of fur on a file follows its thickness unless that is said."""
    options = chosen(args)
    plain = options.length_by_thickness or options.flat or options.groom is not None or is_builtin(model)
    if args.length_by_thickness is None and not plain:
        options = replace(options, auto_length=True)
    return options
