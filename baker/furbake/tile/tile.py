"""From options to pelts: the stages of a bake that know no mesh."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

from furbake.options import BakeOptions
from furbake.pelt.bent import fit_bends
from furbake.pelt.eye import EyeLaw, fit_eye
from furbake.pelt.fin_eye import fit_fin_eye
from furbake.pelt.hairs.shown import spread_of
from furbake.pelt.hairs.states import Fur, chosen, in_state
from furbake.pelt.hairs.strands import Strands, grow
from furbake.pelt.hairs.volume import Volume
from furbake.pelt.light.beam import Beam, Fields
from furbake.pelt.light.transport import Beams, beams_here
from furbake.pelt.pelt import Pelt
from furbake.tile.fitting import fit_pelts
from furbake.tile.lighting import Sampled, directions, parts, sampled, setting_of
from furbake.tile.sides import fit_sides

Step = Callable[[float], None]
Fitted = list[tuple[Pelt, dict[str, Any]]]
"""Pelts of all states, dry first, and the figures of each that `bake.json` reports."""

Spread = Callable[[BakeOptions, float, int], Sequence[Beams]]
"""From options and height of a tile and the number of its states to who lets light through each of them."""


@dataclass(frozen=True)
class Tile:
    """A tile of fur in all its states.

    height : of the dry fur, tile widths; strands : of the dry fur; furs : the states, dry first
    """

    options: BakeOptions
    height: float
    strands: Strands
    furs: tuple[Fur, ...]

    @classmethod
    def grow(cls, options: BakeOptions, height: float, strands: Strands | None = None) -> Tile:
        """Strands of every state that the options ask for; strands : dry ones in place of those that they grow."""
        strands = grow(options.coat, height, options.seed) if strands is None else strands
        states = chosen(options.states, options.dirt)
        return cls(
            options,
            height,
            strands,
            tuple(in_state(state, options.coat, strands, height, options.seed) for state in states),
        )

    def dry_volume(self) -> Volume:
        """The oversampled volume of the dry state, for `sample` and `fit_fins`."""
        return self._voxels(self.furs[0])

    def sample(self, dry: Volume, step: Step, spread: Spread | None = None) -> list[Sampled]:
        """Stored slabs of all states and the light in them.

        spread : who lets light through the hairs, if not this process
        """
        count = len(self.furs)
        beams = [None] * count if spread is None else spread(self.options, self.height, count)
        share = zip(self.furs, parts(step, count), beams, strict=True)
        return [sampled(fur, self._volume(fur, dry), self.options, part, some) for fur, part, some in share]

    def fit(self, samples: Sequence[Sampled], step: Step) -> Fitted:
        """Pelts of all states; the first has the hairs' spread and the laws of bent hairs and of light and eye."""
        (pelt, figures), *others = fit_pelts(samples, self.options)
        if self.options.curves != "none":
            pelt = replace(pelt, spread=round(spread_of(self.strands, self.height), 3))
        with ThreadPoolExecutor(1) as beside:  # each of the two has gaps in which a core would wait
            law = beside.submit(self._eye, pelt)
            bent = None if self.options.flat else fit_bends(pelt, self.strands, self.options.coat, step)
            eye = law.result()
        pelt = replace(pelt, bent=bent)
        if eye is not None:
            pelt = replace(pelt, eye=eye.weights, surge=eye.surge)
        return [(pelt, figures), *others]

    def _eye(self, pelt: Pelt) -> EyeLaw | None:
        options = self.options
        return None if options.curves == "none" else fit_eye(pelt, self.strands, options.coat, flat=options.flat)

    def fit_fins(self, dry: Volume, fitted: Fitted) -> Fitted:
        """The same pelts with their fins."""
        volumes = ((fur, self._volume(fur, dry)) for fur in self.furs)
        sides = fit_sides(volumes, [pelt for pelt, _ in fitted], self.options)
        (pelt, figures), *others = [
            (replace(pelt, fin=fin), figures | {"fin": found})
            for (pelt, figures), (fin, found) in zip(fitted, sides, strict=True)
        ]
        if pelt.fin is not None and pelt.eye is not None and not self.options.flat:
            pelt = replace(pelt, fin_eye=fit_fin_eye(pelt, pelt.fin, self.strands, self.options.coat))
        return [(pelt, figures), *others]

    def _volume(self, fur: Fur, dry: Volume) -> Volume:
        """Oversampled volume of a state. Only the dry one is kept: all of them at once take much memory."""
        return dry if fur is self.furs[0] else self._voxels(fur)

    def _voxels(self, fur: Fur) -> Volume:
        return fur.voxels(self.options.layers, self.options.size)

    def beam(self, state: int) -> Beam:
        """Beams of light through the fine voxels of a state."""
        options = replace(self.options, coat=self.furs[state].coat)
        fine = self._voxels(self.furs[state])
        return Beam(fine, options.layers, options.size, setting_of(options).radius)


@lru_cache(1)
def _beam(options: BakeOptions, height: float, state: int) -> Beam:
    return Tile.grow(options, height).beam(state)


def lit(options: BakeOptions, height: float, state: int, first: int, last: int) -> list[Fields]:
    """Fields of some of the lights of a state, made from nothing but its options; the voxels stay for the next call."""
    return list(beams_here(_beam(options, height, state), directions(options)[first:last]))
