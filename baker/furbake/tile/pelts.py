"""The pelts of a fur, stage by stage, or from a cache."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from functools import cached_property
from pathlib import Path

from furbake.beside import Beside
from furbake.options import BakeOptions
from furbake.pelt.hairs.strands import Strands
from furbake.tile.kept import KeptPelts
from furbake.tile.lighting import Sampled
from furbake.tile.measured import measured_pelts
from furbake.tile.tile import Fitted, Spread, Step, Tile

HEIGHT_DIGITS = 12
"""Digits of a tile's height: bodies of other sizes have the same pelt."""

LONG = 1_000_000
"""Samples of texels from which on a bake is long enough for a second process, which takes half a second to start."""

Stage = Callable[[str], AbstractContextManager[Step]]


class Pelts:
    """The pelts of a tile, made stage by stage or taken from a cache."""

    def __init__(
        self,
        stage: Stage,
        beside: Beside,
        cache: Path | None,
        spread: Spread | None,
        options: BakeOptions,
        height: float,
        strands: Strands | None = None,
    ) -> None:
        """options : of the tile; height : tile widths, of which the last bits vary from body to body.

        stage : within which a stage of this name is made, with its progress
        beside, spread : as of `Tile` and its samples; cache : folder of finished pelts, None: there is none
        strands : that are not grown of the options
        """
        self.spread, self.strands, self.beside = spread, strands, beside
        self.stage, self.options, self.height = stage, options, float(f"{height:.{HEIGHT_DIGITS}g}")
        self.kept = None if cache is None else KeptPelts(cache, options, self.height, strands)
        self.sampled: list[Sampled] = []
        self.notices: tuple[str, ...] = ()

    @cached_property
    def tile(self) -> Tile:
        return Tile.grow(self.options, self.height, self.strands, self.beside)

    def fitted(self, *, anew: bool) -> Fitted:
        """Pelts of all states, without fins; anew : whatever the cache has."""
        if self.options.swatch is not None:
            with self.stage("fit"):
                made, self.notices = measured_pelts(Path(self.options.swatch), self.options, self.height)
            return made
        found = self.kept.pelts() if self.kept is not None and not anew else None
        if found is not None:
            return found
        if self.options.lights * self.options.layers * self.options.size**2 >= LONG:
            self.beside.start()
        with self.stage("strands"):
            tile = self.tile
            tile.begin()
        with self.stage("volume"):
            _ = tile.dry
        with self.stage("light") as step:
            self.sampled = tile.sample(step, self.spread)
        with self.stage("fit") as step:
            fitted = tile.fit(self.sampled, step)
        if self.kept is not None:
            self.kept.keep_pelts(fitted)
        return fitted

    def with_fins(self, fitted: Fitted) -> Fitted:
        """The same pelts with their fins."""
        found = self.kept.with_fins(fitted) if self.kept is not None else None
        if found is None:
            found = self.tile.fit_fins(fitted)
            if self.kept is not None:
                self.kept.keep_fins(found)
        return found
