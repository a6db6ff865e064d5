"""The states of one fur: dry, ever wetter, dirty. The same hairs in all of them, so that texels of two can be mixed."""

from __future__ import annotations

from dataclasses import dataclass, replace

from furbake.pelt.hairs.dirt import MUD, Crumbs, crumbs, soiled
from furbake.pelt.hairs.ramp import RGB
from furbake.pelt.hairs.strands import Coat, Strands
from furbake.pelt.hairs.volume import Volume, fine_shape, voxelise
from furbake.pelt.hairs.wet import ALBEDO, GLOSS, SHADE, SHARPNESS, SHORTER, wet

WETNESS = {"dry": 0.0, "damp": 0.25, "moist": 0.5, "wet": 0.75, "soaked": 1.0}
"""Wetness of the states by name."""


@dataclass(frozen=True)
class PeltState:
    """Wetness and dirt of a pelt, 0..1 each, and their effects on its hairs.

    length : of the fur over that of the dry one
    shade : factor of the hairs' colour; gloss, sharpness : of the strength and the exponent of their highlights
    mud : linear colour of what a dirty pelt's `tint` is the share of, None where it is clean
    """

    name: str = "dry"
    wetness: float = 0.0
    dirt: float = 0.0
    length: float = 1.0
    shade: float = 1.0
    gloss: float = 1.0
    sharpness: float = 1.0
    mud: RGB | None = None


DRY = PeltState()

DIRTY = PeltState(name="dirty", dirt=1.0, mud=MUD)


@dataclass(frozen=True)
class Fur:
    """One state of the fur of a tile.

    coat : as dry, except for the albedo; height : tile widths; mud : of a dirty state, or None
    """

    state: PeltState
    coat: Coat
    strands: Strands
    height: float
    mud: Crumbs | None = None

    def voxels(self, layers: int, size: int) -> Volume:
        """The oversampled volume of what is stored as `layers` slabs of `size` × `size` texels."""
        fine = voxelise(self.strands, self.height, *fine_shape(layers, size, self.height), self.coat.opacity)
        return fine if self.mud is None else soiled(fine, self.mud, self.coat.opacity)


def moistened(name: str, wetness: float) -> PeltState:
    """A clean state of some wetness, 0..1."""
    return PeltState(
        name=name,
        wetness=wetness,
        length=1 - SHORTER * wetness,
        shade=1 + (SHADE - 1) * wetness,
        gloss=1 + (GLOSS - 1) * wetness,
        sharpness=1 + (SHARPNESS - 1) * wetness,
    )


def chosen(names: tuple[str, ...], dirt: bool) -> list[PeltState]:
    """States by name, and with `dirt` the dirty one after them."""
    return [*(moistened(name, WETNESS[name]) for name in names), *([DIRTY] if dirt else [])]


def in_state(state: PeltState, coat: Coat, strands: Strands, height: float, seed: int) -> Fur:
    """The dry hairs of a coat in a state; height : of the dry fur, tile widths."""
    albedo = coat.albedo * (1 + (ALBEDO - 1) * state.wetness)
    mud = crumbs(strands, height, seed, state.dirt) if state.dirt else None
    soaked = wet(strands, state.wetness, coat.clumps, seed)
    return Fur(state, replace(coat, albedo=albedo), soaked, height * state.length, mud)
