"""Optical depth on a graphics card, by the same convolution: all slabs of some rays in one product.

Only what is left of the light leaves the card. It differs by some 1e-6 from what the processor finds, and by more in
the few voxels that light reaches far below others: as more slabs are followed together, fewer are left black (`DARK`).
"""

from __future__ import annotations

from threading import Lock
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.device import card_arrays
from furbake.pelt.light.depth import STRIP, Depth, Points

Array = NDArray[np.float64]
Single = NDArray[np.float32]

LARGEST = 2**28
"""Bytes of the largest array, where `STRIP` slabs take no more; each process uses some four of them on the card."""

BYTES = 8
"""Size of a complex number of single precision."""

IN_USE = Lock()
"""Held by the light of this process that uses the card: others keep their slabs there, and wait."""


class CardDepth(Depth):
    """As `Depth`, with arrays on the card."""

    def __init__(
        self,
        sigma: NDArray[np.floating],
        slab: float,
        beta: float | None,
        aside: Array | None = None,
        arrays: Any = None,
    ) -> None:
        """arrays : a module like NumPy, by default CuPy; the others as of `Depth`."""
        self.arrays = card_arrays() if arrays is None else arrays
        with IN_USE:
            super().__init__(sigma, slab, beta, aside)

    def through(self, light: Array) -> tuple[Single, Single]:
        with IN_USE:
            return super().through(light)

    def _on_device(self, values: NDArray[Any]) -> Any:
        return self.arrays.asarray(values)

    def _together(self, points: Points) -> int:
        most = max(int(points.counts.max()), self.size // 2 + 1)
        together: int = LARGEST // (self.layers * self.size * most * BYTES)
        return max(together, STRIP)

    def _spectrum(self, fields: NDArray[np.floating]) -> Any:
        return self.arrays.fft.rfft2(self._on_device(np.asarray(fields, np.float32)))

    def _left(self, spectrum: Any) -> Single:
        depths = self.arrays.fft.irfft2(spectrum, s=(self.size, self.size))
        left = self.arrays.exp(-self.arrays.maximum(depths, 0))
        return np.asarray(left.get() if hasattr(left, "get") else left, np.float32)

    def _depths(self, points: Points, of: slice, light: Array) -> Any:
        feet, weights = points.padded(of)
        way = light[:2] / max(float(np.hypot(*light[:2])), 1e-9)
        rows = self._look(self._on_device(feet * way[1]), self.size)
        columns = self._look(self._on_device(feet * way[0]), self.size // 2 + 1)
        columns *= self._on_device(weights)[..., None]
        kernels = self.arrays.matmul(rows.swapaxes(-1, -2), columns)
        kernels *= self.spectrum
        return kernels.sum(1)
