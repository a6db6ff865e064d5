"""Mean curves of a body as it is seen from straight above."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from furbake.options import preset
from furbake.pelt.above import as_seen, smooth_ratio
from furbake.pelt.curves import KNOTS
from furbake.pelt.eye import rings
from furbake.pelt.light.fibre import ABOVE
from furbake.pelt.seen import LitHairs, ShownTexels
from furbake.tile.fitting import fit_pelt
from furbake.tile.lighting import grown, light

UPRIGHT = replace(preset("mole"), size=16, layers=6, lights=32)


def test_ratio() -> None:
    """By what is shown, however much that is; where no light is it goes on as it ends."""
    x = np.linspace(7, 15, 30)
    shown, knots = np.linspace(0.2, 3, 30), np.arange(KNOTS)
    np.testing.assert_allclose(smooth_ratio(x, 0.6 * shown, shown), 0.6, atol=1e-9)
    found = smooth_ratio(x, (0.4 + 0.03 * x) * shown, shown)
    np.testing.assert_allclose(found[8:15], 0.4 + 0.03 * knots[8:15], atol=0.02)
    np.testing.assert_allclose(found[:6], found[6], atol=0.01)


def test_shells_of_an_upright_coat_show_the_light_of_its_hairs() -> None:
    """From straight above, under lights that no fit has seen."""
    strands, fine, volume = grown(UPRIGHT)
    pelt, _ = fit_pelt(volume, light(fine, UPRIGHT), UPRIGHT)
    curves = as_seen(pelt, strands, UPRIGHT.coat)
    lights = rings((0.7, 0.3, 0.1), 6, 0.3)[1:]
    every = np.arange(len(lights))
    hairs, all_hairs = LitHairs(fine, 6, 16, lights, UPRIGHT.coat).towards(ABOVE, every)
    wanted = hairs.sum(1).reshape(3, -1).mean(1) / all_hairs
    seen = []
    for one in (pelt, replace(pelt, curves=curves)):
        texels, all_texels = ShownTexels(one, lights).towards(ABOVE, every)
        seen.append(texels.sum(1).reshape(3, -1).mean(1) / all_texels / wanted)
    assert (seen[0][1:] > 1.3).all()
    np.testing.assert_allclose(seen[1], 1, atol=0.2)
