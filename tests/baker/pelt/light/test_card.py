"""Optical depth on a graphics card: with NumPy's arrays everywhere, with CuPy's where there is a card."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

from furbake.device import VARIABLE, DeviceError, card_arrays
from furbake.pelt.hairs.strands import Coat, grow
from furbake.pelt.hairs.volume import voxelise
from furbake.pelt.light import card
from furbake.pelt.light.card import CardDepth
from furbake.pelt.light.depth import Depth
from furbake.pelt.light.transport import hemisphere, sample


def there() -> bool:
    try:
        card_arrays()
    except DeviceError:
        return False
    return True


on_a_card = pytest.mark.skipif(not there(), reason="needs CuPy and an NVIDIA card")


@pytest.mark.parametrize(
    "kind", [pytest.param(partial(CardDepth, arrays=np), id="numpy"), pytest.param(CardDepth, marks=on_a_card)]
)
@pytest.mark.parametrize(
    ("beta", "lz"), [(None, 0.99), (None, 0.1), *((4.0, lz) for lz in (0.99, 0.5, 0.1, 0.0, -0.1, -0.3, -0.9))]
)
def test_the_card_finds_what_the_processor_finds(
    kind: partial[CardDepth], beta: float | None, lz: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    volume = voxelise(grow(Coat(), 0.6, 0), 0.6, 12, 32, 2.2)
    aside = np.random.default_rng(0).normal(0, 0.1, (12, 2))
    light = np.array([*(np.sqrt(1 - lz * lz) * np.array([0.8, -0.6])), lz])
    monkeypatch.setattr(card, "LARGEST", 5 * 12 * 32 * 17 * 8)  # five slabs at a time, or the fewest
    for moved in (None, aside):
        for found, expected in zip(
            kind(volume.sigma, volume.slab, beta, moved).through(light),
            Depth(volume.sigma, volume.slab, beta, moved).through(light),
            strict=True,
        ):
            assert isinstance(found, np.ndarray)
            np.testing.assert_allclose(found, expected, atol=1e-5)


@on_a_card
def test_samples_by_the_card_are_those_by_the_processor(monkeypatch: pytest.MonkeyPatch) -> None:
    fine = voxelise(grow(Coat(), 0.6, 0), 0.6, 16, 64, 2.2)
    found = []
    for name in ("cpu", "cuda"):
        monkeypatch.setenv(VARIABLE, name)
        found.append(sample(fine, 8, 32, hemisphere(6)))
    np.testing.assert_allclose(*found, atol=1e-4)
