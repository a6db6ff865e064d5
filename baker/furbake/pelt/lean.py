"""Light along hairs that lean.

A lamp in the plane in which hairs lean casts their shadows behind themselves, for an eye above that plane, and its
light runs along hairs. Voxels know neither, nor do samples, so light of a lamp l for an eye at v counts times

    1 + κ·b²·(0.28 + 0.16·b)·v_z²·(1 − |l·v|),   κ = 4·|lean| − 1 within 0..1, b = l·m

along the lean m of length 1, l held on the horizon: two numbers for all furs, by pictures of balls and bunnies beside
the path tracer. Beside the eye the surge of `eye` has that light; light from behind is bright
enough without it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from furbake.pelt.curves import lean_direction
from furbake.pelt.texels.basis import held

Array = NDArray[np.float64]

ALONG = (0.28, 0.16)
"""Numbers of `along_lean`.

Flat tiles of hairs that lean by 1 and .55, path-traced and seen from straight above, are 1.1 to 1.2 times as bright as
their samples under lights at 50° and 70° towards which they lean, 1.03 to 1.1 away from which, 1.01 to 1.04 across; by
.25 they are alike. On balls and bunnies a page without the factor has .85 to .9 of the traced light where a lamp aside
from the eye is along the lean, .97 to 1.1 where across; an eye at 20° over a flat field has none of it.
"""


def along_lean(lights: Array, eyes: Array, lean: Array) -> Array:
    """Factor of the light of lamps for eyes, n pairs of unit vectors in the tile's frame, (n,).

    lean : (2,) of the tips, shares of the height
    """
    kappa = np.clip(4 * np.hypot(*lean) - 1, 0, 1)
    b, up = held(lights)[:, :2] @ lean_direction(lean), np.maximum(eyes[:, 2], 0)
    aside = 1 - np.abs((lights * eyes).sum(-1))
    return np.asarray(1 + kappa * b**2 * (ALONG[0] + ALONG[1] * b) * up**2 * aside)
