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
from furbake.pelt.light.depth import Depth, Points

Array = NDArray[np.float64]
Single = NDArray[np.float32]

ROOM = 2**28
"""Bytes of the kernels that are made together; about thrice as many are in use."""

ONE = Lock()
"""Held by the light that uses the card, so that its memory does not depend on the number of cores."""


class CardDepth(Depth):
    """As `Depth`, by the functions of NumPy for arrays elsewhere."""

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
        with ONE:
            super().__init__(sigma, slab, beta, aside)
        kernel = self.spectrum[0].size * self.spectrum.itemsize
        self.together = max(ROOM // (self.layers * kernel), 1)

    def through(self, light: Array) -> tuple[Single, Single]:
        with ONE:
            return super().through(light)

    def _there(self, values: NDArray[Any]) -> Any:
        return self.arrays.asarray(values)

    def _spectrum(self, fields: NDArray[np.floating]) -> Any:
        return self.arrays.fft.rfft2(self._there(np.asarray(fields, np.float32)))

    def _left(self, spectrum: Any) -> Single:
        depths = self.arrays.fft.irfft2(spectrum, s=(self.size, self.size))
        left = self.arrays.exp(-self.arrays.maximum(depths, 0))
        return np.asarray(left.get() if hasattr(left, "get") else left, np.float32)

    def _depths(self, points: Points, of: slice, light: Array) -> Any:
        feet, weights = points.padded(of)
        way = light[:2] / max(float(np.hypot(*light[:2])), 1e-9)
        rows = self._look(self._there(feet * way[1]), self.size)
        columns = self._look(self._there(feet * way[0]), self.size // 2 + 1)
        columns *= self._there(weights)[..., None]
        kernels = self.arrays.matmul(rows.swapaxes(-1, -2), columns)
        kernels *= self.spectrum
        return kernels.sum(1)
