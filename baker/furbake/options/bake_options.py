"""Options of a bake: meaning, unit and default of each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any, Literal

from furbake.options import knobs
from furbake.options.knobs import BITS, FOLLOW, KNOBS, LENGTH, MAX_FACES, OptionError
from furbake.options.pose import clip_at
from furbake.pelt.hairs.ramp import Ramp
from furbake.pelt.hairs.states import WETNESS
from furbake.pelt.hairs.strands import Coat

BasisKind = Literal["ptm", "eigen"]
CurvesKind = Literal["slab", "none"]
Guide = Literal["nose-tail", "down"]
Uv = Literal["lapped", "own"]
ColourKind = Literal["texture", "vertex"]

COLOURS = ("texture", "vertex")

OF_GROOM = ("auto", "1", "2", "3", "4")
"""Values of `regions` that leave it to a groom where its regions are, and how many there are."""

FILES = ("length_map", "mask", "comb", "features", "rig", "swatch", "regions", "groom")
"""Options that name files."""

OF_VERTICES = "vertex:"
"""Prefix of a `length_map` or `mask` that names a channel of the vertex colours, or an attribute, not a file."""

THIN: dict[str, Any] = {"layers": 1, "height_share": 0.05}
"""Options of fur that is photographed, where the command is not given others: photographs show the top alone."""

LATER = (
    "directions", "states", "dirt", "auto_length", "pose", "swatch", "colour", "regions", "rig", "groom", "follow",
    "own_colours",
)  # fmt: skip
"""Options that early records do not have."""

OF_BODY = (
    "preset", "length", "tile", "height", "guide", "sweep", "uv", "length_by_thickness", "auto_length", "length_noise",
    "tip_noise", "belly", "max_faces", "pose", "length_map", "mask", "comb", "features", "rig", "fins",
    "tile_share", "height_share", "meshopt", "colour", "own_colours", "regions", "groom", "follow",
)  # fmt: skip
"""Options of the body that wears a tile, or by which the tile's height is found; all others are the tile's own."""


@dataclass(frozen=True)
class BakeOptions:
    """Options of one bake; ranges are in `furbake.options.knobs`.

    length = height × tile: at most two of the three may be given; `None` means that one follows from the other two.
    """

    preset: str = "paper"
    layers: int = 16
    """Slabs of the tile."""
    size: int = 64
    """Texels per side of the tile, a power of two."""
    lights: int = 64
    """Sampled light directions on the upper hemisphere."""
    basis: BasisKind = "ptm"
    coefficients: int = 6
    """Numbers per texel: 6 for ptm, 3 to 6 for eigen."""
    bits: int = 6
    """Bits of a stored number, 4 to 8: 6 are 52 dB above the rounding, and a quarter less to load than 8."""
    curves: CurvesKind = "slab"
    """Mean light of each slab, by which its numbers are multiplied, or none: version 1 of the format."""
    length: float | None = None
    """Longest fur, the model's own units."""
    tile: float | None = None
    """Width of a tile, the model's own units. Default: `tile_share` of the model's largest side."""
    height: float | None = None
    """Longest fur in tile widths. Default: `height_share`."""
    seed: int = 0
    """Seed of all chance, 0 or above."""
    flat: bool = False
    """A flat patch under a point at infinity: for checks against other renderers."""
    guide: Guide = "nose-tail"
    """Direction in which the fur is laid."""
    sweep: float = 0.0
    """How far shells bend along the fur's direction, share of its length, besides the lean in the tile."""
    uv: Uv = "lapped"
    """Lapped patches along the fur, or the model's own texture coordinates."""
    colour: ColourKind = "texture"
    """Colour of hairs on a model with a picture: the picture's at their roots, or one per vertex."""
    own_colours: bool = False
    """Hairs in the model's own colours: `preset` has left the hues of `ramp` out, and regions do."""
    length_by_thickness: bool = False
    """Shorter fur where the body is thin (ears, feet)."""
    auto_length: bool = False
    """Length from the body's thickness, where none is given, and shorter fur on thin parts. The command's default."""
    length_noise: float = 0.0
    """How much shorter fur may be from place to place."""
    tip_noise: float = 0.0
    """How far tips turn to the ramp's second tip colour from place to place."""
    belly: float = 0.0
    """How far they turn to it on the underside."""
    max_faces: int = 60_000
    """Faces above which a model is simplified."""
    pose: str | None = None
    """CLIP@SECONDS: the pose in which the fur is laid and lit, in place of the bind pose."""
    length_map: str | None = None
    """PNG over the model's texture coordinates, or `vertex:red` of its vertices: white is full length, black none."""
    mask: str | None = None
    """The same for where fur grows: black is bare skin."""
    comb: str | None = None
    """JSON file of strokes along which the fur is laid."""
    features: str | None = None
    """JSON file of eyes, a nose and the like."""
    rig: str | None = None
    """JSON file of joints and clips for a model that stands still."""
    swatch: str | None = None
    """`.lp`, `.ptm` or `info.json` of real fur or cloth under many lamps, from which the tile is made, not grown."""
    regions: str | None = None
    """TOML file of parts of the body with a fur of their own; of a groom their number, or auto: as plainly differ."""
    groom: str | None = None
    """`.usd`, `.hair`, `.tfx` or `.npz` with the strands of an artist, of which fur and tile are made."""
    follow: int | None = None
    """Hairs beside each strand of the groom. Default: none, or as many as cover the skin where it is one of guides."""
    fins: bool = True
    """Quads on the edges that show the fur from the side, where shells are seen edge-on."""
    meshopt: bool = True
    """Compress meshes by `EXT_meshopt_compression`, where that makes them smaller."""
    coat: Coat = field(default_factory=Coat)
    ramp: Ramp = field(default_factory=Ramp)
    colour_plane: bool = True
    """Store the paper's original colour of every texel as a third plane."""
    directions: bool = False
    """Store the hairs' mean direction in every texel, for renderers that compute the light themselves."""
    states: tuple[str, ...] = ("dry",)
    """States of wetness by name, dry first: some of those in `WETNESS`."""
    dirt: bool = False
    """A dirty state besides."""
    tile_share: float = 0.13
    """Default width of a tile as a share of the model's largest side."""
    height_share: float = 0.5
    """Default height in tile widths."""

    def check(self) -> None:
        """Raise `OptionError` for the first value that is out of range."""
        for name, value in values_of(self).items():
            KNOBS[name].take(name, value)
        if self.size & (self.size - 1):
            raise OptionError(f"size: got {self.size}, expected a power of two")
        if self.basis == "ptm" and self.coefficients != 6:
            raise OptionError(
                f"coefficients: got {self.coefficients}, expected 6 for the basis ptm (eigen takes 3 to 6)"
            )
        knobs.within("bits", self.bits, BITS.low, BITS.high)
        knobs.within("max-faces", self.max_faces, MAX_FACES.low, MAX_FACES.high)
        if self.colour not in COLOURS:
            raise OptionError(f"colour: got {knobs.show(self.colour)}, expected {' or '.join(COLOURS)}")
        if self.pose is not None:
            clip_at(self.pose)
        for name, length in (("length", self.length), ("tile", self.tile)):
            if length is not None and not LENGTH.low <= length <= LENGTH.high:
                raise OptionError(
                    f"{name}: got {length:g}, expected a length above 0 ({LENGTH.low:g} to {LENGTH.high:g})"
                )
        if None not in (self.length, self.tile, self.height):
            raise OptionError(
                "length: got length, tile and height, expected at most two of them (length = height × tile)"
            )
        known = list(WETNESS)
        if self.states[:1] != ("dry",) or self.states != tuple(name for name in known if name in self.states):
            expected = f"dry..wet, or dry and then some of {', '.join(known[1:])}"
            raise OptionError(f"states: got {','.join(self.states)}, expected {expected}")
        if self.dirt and self.coefficients < 4:
            raise OptionError("dirt: got 3 coefficients, which leave no room for the share of mud, expected 4 to 6")
        if self.swatch is not None and (len(self.states) > 1 or self.dirt):
            raise OptionError(f"swatch: got {self.swatch} beside wet or dirty states, expected dry fur alone")
        self._check_regions()
        self._check_groom()
        hairs = self.coat.guard.count + self.coat.under.count
        knobs.within("coat.guard.count + coat.under.count", hairs, 1, KNOBS["coat.guard.count"].high)

    def _check_regions(self) -> None:
        """Raise `OptionError` for what cannot stand beside regions."""
        if self.regions is None:
            return
        alone = self.groom is None
        if alone == (self.regions in OF_GROOM):
            beside, expected = ("without", "a .toml file of them") if alone else ("beside", "auto or 1 to 4 of its own")
            raise OptionError(f"regions: got {self.regions} {beside} a groom, expected {expected}")
        for name, got in (("swatch", self.swatch), ("basis", self.basis), ("curves", self.curves)):
            if got not in (None, "ptm", "slab"):
                raise OptionError(f"regions: got {name} {got} beside them, expected grown fur, ptm and slab")

    def _check_groom(self) -> None:
        """Raise `OptionError` for what a groom says by itself, and for what only a groom can have."""
        if self.groom is None:
            if self.follow is not None:
                raise OptionError(f"follow: got {self.follow} without a groom, expected --groom FILE beside it")
            return
        if self.follow is not None:
            knobs.within("follow", self.follow, FOLLOW.low, FOLLOW.high)
        for name in ("length", "height", "comb", "swatch"):
            if (given := getattr(self, name)) is not None:
                raise OptionError(f"{name}: got {knobs.show(given)} beside a groom, expected the strands' own")
        if self.uv != "lapped" or self.flat:
            raise OptionError("groom: got it with --uv own or --flat, expected lapped patches on a round body")

    def of_tile(self) -> BakeOptions:
        """The same with the body's own options at their defaults: equal for two bodies in the same fur."""
        return replace(self, **{name: getattr(BakeOptions, name) for name in OF_BODY})

    @property
    def region_file(self) -> str | None:
        """The file of regions; None where there is none, or a groom says where they are."""
        return None if self.groom is not None else self.regions

    @property
    def groom_regions(self) -> int | None:
        """Number of furs of a groom; None: as many as plainly differ."""
        return None if self.regions == "auto" else int(self.regions or 1)

    @property
    def length_given(self) -> bool:
        """True where the options say how long the fur is, not only how a tile looks."""
        return self.length is not None or None not in (self.tile, self.height)

    @property
    def own_height(self) -> float:
        """Longest fur in tile widths, without a body."""
        return self.height if self.height is not None else self.height_share

    def dimensions(self, extent: float) -> tuple[float, float]:
        """(tile, length) in the model's units, for a model whose largest side is `extent`.

        Raises OptionError when length and tile together give a height out of range.
        """
        height = self.own_height
        if self.length is not None and self.tile is not None:
            knob = KNOBS["height"]
            knobs.within("height (length / tile)", self.length / self.tile, knob.low, knob.high)
            return self.tile, self.length
        if self.length is not None:
            return self.length / height, self.length
        tile = self.tile if self.tile is not None else self.tile_share * extent
        return tile, height * tile

    def as_record(self) -> dict[str, Any]:
        """Plain data, for bake.json. Options in `LATER` are left out at their defaults: old records stay equal."""
        unused = {name for name in LATER if getattr(self, name) == getattr(BakeOptions, name)}
        return {name: value for name, value in asdict(self).items() if name not in unused}

    @classmethod
    def from_record(cls, record: dict[str, Any]) -> BakeOptions:
        """The options that `as_record` wrote, JSON's lists and all; older ones know no curves, and have bytes.

        Raises OptionError for anything else.
        """
        if record.get("swatch") is not None:
            raise OptionError(f"options: got fur that was photographed ({record['swatch']}), expected grown hairs")
        try:
            options = build({"curves": "none", "bits": 8, "meshopt": False, **record})
            options.check()
        except (TypeError, ValueError, AttributeError, KeyError) as error:
            raise OptionError(
                f"options: got a record that is not understood ({error}), expected one of bake.json"
            ) from None
        return options


def named_files(options: BakeOptions) -> dict[str, str]:
    """Files that the options name, by option."""
    named = {name: getattr(options, name) for name in FILES} | {"regions": options.region_file}
    return {name: file for name, file in named.items() if file is not None and not file.startswith(OF_VERTICES)}


def values_of(options: BakeOptions) -> dict[str, Any]:
    """Values of all knobs by dotted name; `height` is `own_height`."""
    values = dict(knobs.flatten(asdict(options)))
    values["height"] = options.own_height
    return {name: values[name] for name in KNOBS}


def build(table: Mapping[str, Any]) -> BakeOptions:
    """Options from nested tables and lists, the rest at their defaults."""
    coat = dict(table.get("coat", {}))
    defaults = Coat()
    for kind in ("guard", "under"):
        coat[kind] = replace(getattr(defaults, kind), **_tuples(coat.get(kind, {})))
    built = {"coat": Coat(**_tuples(coat)), "ramp": Ramp(**_tuples(table.get("ramp", {})))}
    return BakeOptions(**{**_tuples(table), **built})


def _tuples(table: Mapping[str, Any]) -> dict[str, Any]:
    return {key: tuple(value) if isinstance(value, list) else value for key, value in table.items()}
