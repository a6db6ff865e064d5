"""Figures of a lapped texture, measured at samples within every face of the surface."""

from __future__ import annotations

import numpy as np

from furbake.surface.charts import Charts, Floats, Ints
from furbake.surface.mesh import Surface
from furbake.surface.repair.topology import unit

STEPS = 6
"""Along a side of a face: (STEPS + 1)(STEPS + 2)/2 samples, corners and sides among them."""


def lapped_figures(surface: Surface, charts: Charts, direction: Floats, tile: float) -> dict[str, float]:
    """Figures of charts of a surface.

    direction : (V, 3) float, the field; tile : width of a tile, model units

    coverage : share of all samples at which the weights sum to more than a half
    faces_ratio : faces of the charts per face of the surface
    sum_error, sum_error_vertices : largest |Σ weights − 1| at samples, at the corners of faces
    stretch_mean, stretch_95, stretch_most : max(σ1, 1/σ2) from the surface to tile units, over the area of all faces
        of the charts; stretch_seen_mean, stretch_seen_95 : the same over area · weight
    angle_mean, angle_95 : degrees on the surface between growing v and the field, over area · weight
    mirrored : faces of the charts without a positive Jacobian
    """
    face = faces_of(surface, charts)
    slot = np.argmax(surface.faces[face][:, None] == charts.source[charts.faces][:, :, None], axis=2)
    weights = np.zeros((len(face), 3))
    np.put_along_axis(weights, slot, charts.weights[charts.faces], axis=1)
    samples = lattice(STEPS)
    heap, ends = np.zeros((len(surface.faces), len(samples))), np.zeros(surface.faces.shape)
    np.add.at(heap, face, weights @ samples.T)
    np.add.at(ends, face, weights)

    ways = np.diff(surface.vertices[charts.source[charts.faces]], axis=1) / surface.extent
    steps = np.diff(charts.uv[charts.faces], axis=1)
    steps, across = steps * (tile / surface.extent), np.cross(ways[:, 0], ways[:, 1])
    area = 0.5 * np.linalg.norm(across, axis=1)
    along = _inverse(steps) @ ways
    from_tile = np.linalg.svd(along, compute_uv=False)
    stretch = np.maximum(from_tile[:, 0], 1.0 / np.maximum(from_tile[:, 1], 1e-30))

    normal = unit(across)
    field = np.einsum("sc,fcx->fsx", samples, direction[surface.faces])[face]
    field -= np.einsum("fsx,fx->fs", field, normal)[..., None] * normal[:, None]
    cosine = np.einsum("fsx,fx->fs", field, unit(along[:, 1])) / np.maximum(np.linalg.norm(field, axis=2), 1e-300)
    angle = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))

    angle_mean, angle_95 = _mean_and_95(angle, area[:, None] * (weights @ samples.T))
    stretch_mean, stretch_95 = _mean_and_95(stretch, area)
    seen_mean, seen_95 = _mean_and_95(stretch, area * weights.mean(axis=1))
    return {
        "coverage": float((heap > 0.5).mean()),
        "faces_ratio": len(charts.faces) / len(surface.faces),
        "sum_error": float(np.abs(heap - 1.0).max()),
        "sum_error_vertices": float(np.abs(ends - 1.0).max()),
        "stretch_mean": stretch_mean,
        "stretch_95": stretch_95,
        "stretch_most": float(stretch.max()),
        "stretch_seen_mean": seen_mean,
        "stretch_seen_95": seen_95,
        "angle_mean": angle_mean,
        "angle_95": angle_95,
        "mirrored": float((np.linalg.det(steps) <= 0.0).sum()),
    }


def lattice(steps: int) -> Floats:
    """(n, 3) barycentric coordinates of a regular lattice in a triangle."""
    i, j = np.meshgrid(np.arange(steps + 1), np.arange(steps + 1), indexing="ij")
    i, j = i[i + j <= steps], j[i + j <= steps]
    return np.stack([steps - i - j, i, j], axis=1) / steps


def faces_of(surface: Surface, charts: Charts) -> Ints:
    """(F',) face of the surface that each face of the charts repeats."""
    own, copies = np.sort(surface.faces, axis=1), np.sort(charts.source[charts.faces], axis=1)
    _, index = np.unique(np.concatenate([own, copies]), axis=0, return_inverse=True)
    index = index.reshape(-1)
    number = np.full(index.max() + 1, -1)
    number[index[: len(own)]] = np.arange(len(own))
    return np.asarray(number[index[len(own) :]])


def _inverse(matrices: Floats) -> Floats:
    """(n, 2, 2) inverses; where there is none, huge numbers."""
    (a, b), (c, d) = matrices[:, 0].T, matrices[:, 1].T
    det = a * d - b * c
    adjugate = np.stack([np.stack([d, -b], axis=1), np.stack([-c, a], axis=1)], axis=1)
    return np.asarray(adjugate / np.where(np.abs(det) > 1e-30, det, 1e-30)[:, None, None])


def _mean_and_95(values: Floats, weights: Floats) -> tuple[float, float]:
    """Mean and 95th percentile by weight."""
    values, weights = values.ravel(), weights.ravel()
    order = np.argsort(values)
    heap = np.cumsum(weights[order])
    at = min(int(np.searchsorted(heap, 0.95 * heap[-1])), len(values) - 1)
    return float(np.average(values, weights=weights)), float(values[order[at]])
