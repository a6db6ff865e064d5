"""Faces along sharp edges are divided: normals turn within a hair's length there, all else stays as it was."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh

from furbake.body.body import TURN, prepare
from furbake.options import BakeOptions
from furbake.surface.divide import divide
from furbake.surface.material import Material, Picture, Skin
from furbake.surface.mesh import Surface, clean
from furbake.surface.shapes import builtin

MANY = 20_000


def surface_of(mesh: trimesh.Trimesh) -> Surface:
    return clean("mesh", mesh.vertices, mesh.faces)


def as_mesh(surface: Surface) -> trimesh.Trimesh:
    """The surface as trimesh sees it, nothing merged or dropped."""
    return trimesh.Trimesh(surface.vertices, surface.faces, process=False)


def parted(surface: Surface, length: float, most: int = MANY) -> Surface:
    """The surface divided for fur of one length."""
    return divide(surface, np.full(len(surface.vertices), length), most)


def angles_to(normals: np.ndarray, way: np.ndarray) -> np.ndarray:
    return np.degrees(np.arccos(np.clip(np.einsum("...i,...i->...", normals, way), -1, 1)))


@pytest.mark.parametrize("length", [0.3, 0.1, 0.02])
def test_box_is_flat_but_along_its_edges(length: float) -> None:
    box = parted(surface_of(trimesh.creation.box((1, 2, 3))), length)
    far = np.sort(np.array([0.5, 1.0, 1.5]) - np.abs(box.vertices), axis=1)
    on_one_face = far[:, 1] > 1e-9
    side = np.argmin(np.array([0.5, 1.0, 1.5]) - np.abs(box.vertices), axis=1)
    outward = np.eye(3)[side] * np.sign(box.vertices[np.arange(len(side)), side])[:, None]
    assert angles_to(box.normals, outward)[on_one_face].max() < 1e-4
    edge = (far[:, 1] < 1e-9) & (far[:, 2] > 1e-9)
    np.testing.assert_allclose(angles_to(box.normals, outward)[edge], 45.0, atol=0.5)
    corners = far[box.faces]
    at_edge = (corners[:, :, 1] < 1e-9).any(axis=1)
    sizes = np.linalg.norm(np.diff(box.vertices[box.faces], axis=1, append=box.vertices[box.faces][:, :1]), axis=2)
    assert sizes[at_edge].max() <= max(length, 0.03)


@pytest.mark.parametrize(
    "mesh",
    [
        trimesh.creation.box((1, 2, 3)),
        trimesh.creation.cone(0.7, 1.6, sections=32),
        trimesh.creation.cylinder(0.5, 2, sections=12),
        trimesh.creation.annulus(0.3, 0.8, 0.4),
    ],
    ids=["box", "cone", "cylinder", "ring"],
)
def test_shape_stays_without_gaps(mesh: trimesh.Trimesh) -> None:
    before = surface_of(mesh)
    after = parted(before, 0.05)
    assert len(before.faces) < len(after.faces) <= MANY
    whole, parts = as_mesh(before), as_mesh(after)
    assert parts.is_watertight
    assert parts.is_winding_consistent
    assert parts.euler_number == whole.euler_number
    np.testing.assert_allclose([parts.area, parts.volume], [whole.area, whole.volume], rtol=1e-9)
    np.testing.assert_array_equal(after.vertices[: len(before.vertices)], before.vertices)
    # Rivara: no angle is less than half of the least.
    assert parts.face_angles.min() >= whole.face_angles.min() / 2 - 1e-9
    np.testing.assert_allclose(np.linalg.norm(after.normals, axis=1), 1.0)


def test_short_fur_wants_smaller_faces() -> None:
    """Where the fur is short, along one side of the box, normals turn within less."""
    box = surface_of(trimesh.creation.box())
    after = divide(box, np.where(box.vertices[:, 0] > 0, 0.03, 0.3), MANY)
    sizes = as_mesh(after).edges_unique_length
    middles = after.vertices[as_mesh(after).edges_unique].mean(axis=1)
    short, long = np.abs(middles[:, 0] - 0.5) < 1e-9, np.abs(middles[:, 0] + 0.5) < 1e-9
    assert sizes[short].min() < 0.03
    assert sizes[long].min() > 0.1


def test_cone_is_round_up_to_its_tip() -> None:
    cone = parted(surface_of(trimesh.creation.cone(1.0, 1.0, sections=48)), 0.05)
    x, y, z = cone.vertices.T
    radius = np.hypot(x, y)
    mantle = (z > 1e-9) & (radius > 0.1)
    exact = np.stack([x, y, radius], axis=1)[mantle] / (np.sqrt(2) * radius[mantle, None])
    off = angles_to(cone.normals[mantle], exact)
    assert off.max() < 15
    assert off.mean() < 3
    before = surface_of(trimesh.creation.cone(1.0, 1.0, sections=48))
    assert (before.vertices[:, 2] > 1e-9).sum() == 1, "the mantle had no normal but that of the tip"


@pytest.mark.parametrize(
    "mesh",
    [
        trimesh.creation.icosphere(subdivisions=1),
        trimesh.creation.torus(1.0, 0.4, major_sections=12, minor_sections=6),
    ],
    ids=["ball", "torus"],
)
def test_round_bodies_of_few_faces_stay(mesh: trimesh.Trimesh) -> None:
    surface = surface_of(mesh)
    assert parted(surface, 0.01) is surface


def test_hardly_any_sharp_edge_is_left() -> None:
    """A dent in a fine ball is the chance of a mesh; a built-in shape is made as it is meant."""
    ball = surface_of(trimesh.creation.icosphere(subdivisions=4))
    dented = ball.vertices.copy()
    dented[100] *= 0.8
    dented = replace(ball, vertices=dented)
    assert parted(dented, 0.01) is dented
    coarse = builtin("torus:4x4")
    assert parted(coarse, 0.01) is coarse


def test_few_faces_are_asked_for() -> None:
    """Edges stay larger where the faces would be too many, all of them alike."""
    box = surface_of(trimesh.creation.box())
    few = parted(box, 0.01, 2000)
    assert 500 < len(few.faces) <= 2000
    per_side = np.unique(np.abs(few.normals).round(3), axis=0, return_counts=True)
    flat = per_side[1][(per_side[0] == 1).any(axis=1)]
    assert flat.max() < 1.5 * flat.min()
    assert parted(box, 0.01, 12) is box


def test_everything_painted_comes_along() -> None:
    box = surface_of(trimesh.creation.box())
    red, blue = Material("red", picture=Picture(b"", "image/png")), Material("blue")
    corners = box.vertices[box.faces]
    pictured = corners[..., :2].copy()
    pictured[6:] = np.nan
    box = replace(
        box,
        colours=0.5 + box.vertices,
        uv=pictured,
        attributes={"length": box.vertices[:, 2:]},
        skin=(
            Skin(red, box.faces[:6].reshape(-1), np.arange(18).reshape(6, 3), corners[:6, :, :2].reshape(-1, 2)),
            Skin(blue, np.arange(8), box.faces[6:], colour=np.column_stack([0.5 + box.vertices, np.ones(8)])),
        ),
    )
    after = parted(box, 0.1)
    assert after.colours is not None
    assert after.uv is not None
    np.testing.assert_allclose(after.colours, 0.5 + after.vertices, atol=1e-12)
    np.testing.assert_allclose(after.attributes["length"], after.vertices[:, 2:], atol=1e-12)
    has = np.isfinite(after.uv).all(axis=(1, 2))
    np.testing.assert_allclose(after.uv[has], after.vertices[after.faces[has]][..., :2], atol=1e-12)
    assert np.isnan(after.uv[~has]).all()
    one, two = after.skin
    assert one.uv is not None
    assert two.colour is not None
    np.testing.assert_allclose(one.uv, after.vertices[one.source][:, :2], atol=1e-12)
    np.testing.assert_allclose(two.colour[:, :3], 0.5 + after.vertices[two.source], atol=1e-12)
    worn = np.concatenate([one.source[one.faces], two.source[two.faces]])
    np.testing.assert_array_equal(np.sort(worn, axis=0), np.sort(after.faces, axis=0))
    areas = [as_mesh(replace(after, faces=piece.source[piece.faces])).area for piece in after.skin]
    np.testing.assert_allclose(areas, [3.0, 3.0])


def test_fur_stands_upright_on_a_box(tmp_path: Path) -> None:
    """All of the bake's ground but a hair's length along the edges has the normals of the sides, and it says so."""
    path = tmp_path / "box.ply"
    trimesh.creation.box().export(path)
    body = prepare(str(path), BakeOptions(sweep=0.0))
    assert body.skin is body.ground
    assert body.notices[0] == f"{path}: 12 faces divided into {len(body.ground.faces)} along sharp edges"
    whole = as_mesh(body.ground)
    upright = np.einsum("fij,fj->fi", body.ground.normals[body.ground.faces], whole.face_normals).min(axis=1) > 0.999
    strip = 2 * 12 * TURN * body.length
    assert whole.area_faces[~upright].sum() < strip
    assert len(body.fur.lengths) == len(body.ground.vertices)
