"""Light along hairs that lean over a curved body.

Where fur leans over round skin, hairs send more of a lamp's light along their lean than voxels of flat fur and samples
say, the more, the longer they are beside the body's radius. Light of a lamp l for an eye at v counts times

    1 + κ·b²·(0.28 + 0.16·b)·v_z²·(1 − |l·v|),   κ = 12·|lean|/β − 0.8 within 0..1, b = l·m

along the lean m of length 1, l held on the horizon, β the body's radius towards l: numbers for all furs, by pictures
of balls and bunnies beside the path tracer. Beside the eye the surge of `eye` has that light; light from behind is
bright enough without it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.curves import lean_direction
from furbake.pelt.texels.basis import held

Array = NDArray[np.float64]

ALONG = (0.28, 0.16)
"""Numbers of `along_lean`.

Path-traced light of balls over a page without the factor, the lamp at 90°, n·l from -.15 to .7, asks for κ = 1.2
(`fox`, |lean|/β .172), 1.1 (`wolf`, .155), .5 (`bunny` twice as long, .142), .2 (`paper`, .094), 0 (`bunny`, .071), .4
(`wolf` half as long, .068). Bunnies have .9 of the traced light in `wolf`, .91 in `fox` without it.
"""


def along_lean(lights: Array, eyes: Array, lean: Array, beta: float) -> Array:
    """Factor of the light of lamps for eyes, n pairs of unit vectors in the tile's frame, (n,).

    lean : (2,) of the tips, shares of the height; beta : radius of the body, lengths of the hair
    """
    kappa = np.clip(12 * np.hypot(*lean) / beta - 0.8, 0, 1)
    b, up = held(lights)[:, :2] @ lean_direction(lean), np.maximum(eyes[:, 2], 0)
    aside = 1 - np.abs((lights * eyes).sum(-1))
    return np.asarray(1 + kappa * b**2 * (ALONG[0] + ALONG[1] * b) * up**2 * aside)
