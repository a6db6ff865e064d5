"""From options to pelts: the stages of a bake that know no mesh."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.beside import Beside, Later, results
from furbake.options import BakeOptions
from furbake.pelt.bent import Unbent, bent_light, fit_bends, tips_of, unbent_light
from furbake.pelt.eye import SeenHairs, fit_eye, gauge, seen_hairs
from furbake.pelt.fin_eye import fit_fin_eye, level_hairs
from furbake.pelt.hairs.shown import DENSE, open_share, spread_of
from furbake.pelt.hairs.states import Fur, chosen, in_state
from furbake.pelt.hairs.strands import Coat, Strands, grow
from furbake.pelt.hairs.volume import Volume, slab_means
from furbake.pelt.light.beam import Beam, Fields
from furbake.pelt.light.transport import Beams, beams_here
from furbake.pelt.pelt import Pelt
from furbake.pelt.short import fit_short
from furbake.tile.fitting import fit_pelts
from furbake.tile.lighting import Sampled, directions, on_bodies, options_of, parts, sampled, setting_of
from furbake.tile.sides import fit_sides

Floats = NDArray[np.float64]
Single = NDArray[np.float32]
Step = Callable[[float], None]
Fitted = list[tuple[Pelt, dict[str, Any]]]
"""Pelts of all states, dry first, and the figures of each that `bake.json` reports."""

Spread = Callable[[BakeOptions, float, int], Sequence[Beams]]
"""From options and height of a tile and the number of its states to who lets light through each of them."""


@dataclass(frozen=True)
class Tile:
    """A tile of fur in all its states.

    height : of the dry fur, tile widths; strands : of the dry fur; furs : the states, dry first
    beside : who does what can be done beside the samples
    """

    options: BakeOptions
    height: float
    strands: Strands
    furs: tuple[Fur, ...]
    beside: Beside = field(default_factory=Beside)

    @classmethod
    def grow(
        cls, options: BakeOptions, height: float, strands: Strands | None = None, beside: Beside | None = None
    ) -> Tile:
        """Strands of every state that the options ask for; strands : dry ones in place of those that they grow."""
        strands = grow(options.coat, height, options.seed) if strands is None else strands
        states = chosen(options.states, options.dirt)
        return cls(
            options,
            height,
            strands,
            tuple(in_state(state, options.coat, strands, height, options.seed) for state in states),
            beside or Beside(),
        )

    @cached_property
    def dry(self) -> Volume:
        """The oversampled volume of the dry state."""
        return self._voxels(self.furs[0])

    def sample(self, step: Step, spread: Spread | None = None) -> list[Sampled]:
        """Stored slabs of all states and the light in them.

        spread : who lets light through the hairs, if not this process
        """
        count = len(self.furs)
        beams = [None] * count if spread is None else spread(self.options, self.height, count)
        found = list[Sampled]()
        for fur, part, some in zip(self.furs, parts(step, count), beams, strict=True):
            fine = self._volume(fur)
            bodies = on_bodies(fine, options_of(fur, self.options), self.beside)
            if not found and not self.options.flat:  # the first state's bodies are wanted before these
                _ = self._bent, self._unbent
            found.append(sampled(fur, fine, self.options, part, some or self._beams, bodies))
        return found

    def fit(self, samples: Sequence[Sampled], step: Step) -> Fitted:
        """Pelts of all states; the first has the hairs' spread and the laws of bent hairs and of light and eye."""
        (pelt, figures), *others = fit_pelts(samples, self.options)
        step(0.3)
        if self._seen is not None:
            share = open_share(pelt.alpha / 255)
            pelt = replace(
                pelt,
                spread=round(spread_of(self.strands, self.height), 3),
                open=round(share, 3) if share > DENSE else 0.0,
            )
            law = fit_eye(pelt, self._seen.result(), self._gauge.result(), flat=self.options.flat)
            if law is not None:
                pelt = replace(pelt, eye=law.weights, surge=law.surge)
        step(0.6)
        if not self.options.flat:
            pelt = replace(pelt, bent=fit_bends(pelt, results(self._bent), self._unbent.result()))
        if self._short is not None:
            pelt = replace(pelt, short=self._short.result())
        return [(pelt, figures), *others]

    def fit_fins(self, fitted: Fitted) -> Fitted:
        """The same pelts with their fins."""
        volumes = ((fur, self._volume(fur)) for fur in self.furs)
        sides = fit_sides(volumes, [pelt for pelt, _ in fitted], self.options)
        (pelt, figures), *others = [
            (replace(pelt, fin=fin), figures | {"fin": found})
            for (pelt, figures), (fin, found) in zip(fitted, sides, strict=True)
        ]
        if pelt.fin is not None and pelt.eye is not None and self._level is not None:
            pelt = replace(pelt, fin_eye=fit_fin_eye(pelt, pelt.fin, self._level.result(), self._gauge.result()))
        return [(pelt, figures), *others]

    def begin(self) -> None:
        """Have the process beside this one begin with what needs no volume."""
        _ = self._seen and self._gauge, self._level, self._short

    def _beams(self, beam: Beam, lights: Floats) -> Iterator[Fields]:
        return beams_here(beam, lights, lambda: self.beside.busy)

    @cached_property
    def _unbent(self) -> Later[Unbent | None]:
        """Light for the law of bent hairs, as the next; each of these is begun when it is first asked for."""
        return self.beside.submit(unbent_light, *self._own_hairs)

    @cached_property
    def _bent(self) -> list[Later[Single]]:
        lean = slab_means(self.dry.drift, self.options.layers)[-1] / self.height
        return [self.beside.submit(bent_light, *self._own_hairs, tip) for tip in tips_of(lean)]

    @cached_property
    def _seen(self) -> Later[SeenHairs] | None:
        """Hairs for the law of light and eye."""
        if self.options.curves == "none":
            return None
        return self.beside.submit(seen_hairs, *self._own_hairs, self.options.flat)

    @cached_property
    def _gauge(self) -> Later[Floats]:
        """Light in finer voxels, for both of these laws."""
        return self.beside.submit(gauge, *self._own_hairs, self.options.flat)

    @cached_property
    def _level(self) -> Later[SeenHairs] | None:
        """Hairs for the same law of fins."""
        if self.options.curves == "none" or self.options.flat:
            return None
        return self.beside.submit(level_hairs, *self._own_hairs)

    @cached_property
    def _short(self) -> Later[Floats] | None:
        """Numbers of the law of shorter hairs."""
        if self.options.curves == "none" or self.options.flat:
            return None
        return self.beside.submit(fit_short, *self._own_hairs)

    @property
    def _own_hairs(self) -> tuple[Strands, Coat, float, int, int]:
        options = self.options
        return self.strands, options.coat, self.height, options.layers, options.size

    def _volume(self, fur: Fur) -> Volume:
        """Oversampled volume of a state. Only the dry one is kept: all of them at once take much memory."""
        return self.dry if fur is self.furs[0] else self._voxels(fur)

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
