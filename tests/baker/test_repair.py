"""Whatever triangles come in, a surface that every later step can stand on goes out, or one sentence."""

from __future__ import annotations

import base64
import contextlib
import io
import re
import shutil
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from furbake import cli, validate
from furbake.surface.manifold import separate
from furbake.surface.mesh import MAX_FACES, MeshError, Surface, clean, load_mesh
from furbake.surface.repair import MOST
from furbake.surface.topology import face_vectors

Mesh = tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]

PACKAGES = Path(__file__).parents[2] / "node_modules"
TINY = ("--layers", "4", "--size", "8", "--lights", "8", "--quiet")
SMALL = 2_000_000
"""Bytes of a file that is baked here too."""

SUFFIXES = {".glb", ".gltf", ".obj", ".ply", ".stl", ".off", ".3mf", ".dae"}


def assert_sound(surface: Surface) -> None:
    """Finite, wound alike, two faces at most per edge, one fan or disc per vertex."""
    vertices, faces = surface.vertices, surface.faces
    assert np.isfinite(vertices).all()
    np.testing.assert_allclose(np.linalg.norm(surface.normals, axis=1), 1.0)
    assert len(np.unique(faces)) == len(vertices)
    assert (faces != np.roll(faces, 1, axis=1)).all()
    directed = np.stack([faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)], axis=1)
    assert len(np.unique(directed, axis=0)) == len(directed), "an edge is used twice in one direction"
    again = separate(vertices, faces)
    assert len(again.source) == len(vertices), "a vertex has two fans"
    for line in surface.notices:
        assert re.fullmatch(r"[^\n]+: .*\d.*", line), line


def assert_sound_or_refused(vertices: Any, faces: Any) -> Surface | None:
    try:
        surface = clean("mesh", np.asarray(vertices, dtype=float), np.asarray(faces, dtype=np.int64).reshape(-1, 3))
    except MeshError as error:
        assert re.fullmatch(r"mesh: [^\n]+", str(error))  # noqa: PT017 — refusing is as good
        return None
    assert_sound(surface)
    return surface


def volume(surface: Surface) -> float:
    a, b, c = (surface.vertices[surface.faces[:, i]] for i in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def strip(segments: int, twists: int, width: float = 0.4) -> Mesh:
    """A closed band of quads, cut in two; an odd number of half twists gives it one side."""
    angle = np.linspace(0.0, 2.0 * np.pi, segments, endpoint=False)
    tilt = 0.5 * twists * angle
    out = np.stack([np.cos(angle), np.zeros(segments), np.sin(angle)], axis=1)
    across = np.cos(tilt)[:, None] * out + np.sin(tilt)[:, None] * np.array([0.0, 1.0, 0.0])
    vertices = np.concatenate([out + width * across, out - width * across])
    faces = []
    for i in range(segments):
        a, b, j = i, i + segments, (i + 1) % segments
        c, d = (j, j + segments) if i + 1 < segments or twists % 2 == 0 else (j + segments, j)
        faces += [(a, b, c), (c, b, d)]
    return vertices, np.array(faces)


def flipped(faces: Any, seed: int, share: float = 0.5) -> Any:
    chance = np.random.default_rng(seed).random(len(faces)) < share
    return np.where(chance[:, None], faces[:, ::-1], faces)


seeds = st.integers(0, 2**32 - 1)
scales = st.floats(-6.0, 6.0).map(lambda power: 10.0**power)


@st.composite
def soups(draw: Any) -> Mesh:
    chance = np.random.default_rng(draw(seeds))
    count = draw(st.integers(3, 40))
    vertices = chance.normal(size=(count, 3))
    if draw(st.booleans()):  # on a lattice, so that places, edges and faces coincide
        vertices = np.rint(1.2 * vertices)
    return vertices, chance.integers(0, count, (draw(st.integers(1, 80)), 3))


@st.composite
def strips(draw: Any) -> Mesh:
    vertices, faces = strip(draw(st.integers(3, 40)), draw(st.integers(0, 5)), draw(st.floats(0.01, 0.9)))
    return vertices, flipped(faces, draw(seeds), draw(st.sampled_from([0.0, 0.5, 1.0])))


@st.composite
def fans(draw: Any) -> Mesh:
    """Pages bound along one edge, and fans around one vertex that share nothing else."""
    chance = np.random.default_rng(draw(seeds))
    pages, leaves = draw(st.integers(1, 24)), draw(st.integers(0, 4))
    vertices = [np.zeros(3), np.array([0.0, 1.0, 0.0]), *chance.normal(size=(pages, 3))]
    faces = [(0, 1, 2 + i) for i in range(pages)]
    for _ in range(leaves):
        rim = [*range(len(vertices), len(vertices) + draw(st.integers(3, 9)))]
        vertices += [*chance.normal(size=(len(rim), 3))]
        faces += [(0, a, b) for a, b in pairwise([*rim, rim[0]])]
    return np.array(vertices), flipped(np.array(faces), draw(seeds))


@st.composite
def slivers(draw: Any) -> Mesh:
    """A grid whose columns draw together, with points put on edges or next to them."""
    chance = np.random.default_rng(draw(seeds))
    n, m = draw(st.integers(1, 6)), draw(st.integers(1, 6))
    x = np.cumsum(np.append(0.0, 10.0 ** chance.uniform(-9, 0, n)))
    place = np.stack(np.meshgrid(x, np.arange(m + 1.0), indexing="ij"), axis=-1).reshape(-1, 2)
    vertices = np.column_stack([place[:, 0], 0.1 * np.sin(place.sum(axis=1)), place[:, 1]])
    a = (np.arange(n)[:, None] * (m + 1) + np.arange(m)).reshape(-1)
    faces = np.concatenate([np.stack([a, a + 1, a + m + 1], axis=1), np.stack([a + 1, a + m + 2, a + m + 1], axis=1)])
    for _ in range(draw(st.integers(0, 5))):  # split a face, but not the one beyond the edge: a cap closes the slit
        f, t = int(chance.integers(len(faces))), float(chance.uniform(0.1, 0.9))
        p, q, r = faces[f]
        near = vertices[p] * (1 - t) + vertices[q] * t + 10.0 ** chance.uniform(-12, -5) * chance.normal(size=3)
        new = len(vertices)
        vertices = np.concatenate([vertices, near[None]])
        faces = np.concatenate([np.delete(faces, f, axis=0), [(p, new, r), (new, q, r), (p, q, new)]])
    return vertices, faces


@st.composite
def nests(draw: Any) -> Mesh:
    """Balls within balls, each wound anyhow, some with holes."""
    ball = trimesh.creation.icosphere(subdivisions=1)
    vertices, faces = [], []
    for i in range(draw(st.integers(1, 4))):
        mine = flipped(ball.faces, draw(seeds), draw(st.sampled_from([0.0, 0.5, 1.0])))
        mine = mine[draw(st.sampled_from([0, 1, 4])) :]
        vertices.append(ball.vertices / (i + 1.0))
        faces.append(mine + i * len(ball.vertices))
    return np.concatenate(vertices), np.concatenate(faces)


@given(st.one_of(soups(), strips(), fans(), slivers(), nests()), scales, seeds)
def test_any_triangles(mesh: Mesh, scale: float, seed: int) -> None:
    vertices, faces = mesh
    assert_sound_or_refused(scale * (vertices + np.random.default_rng(seed).normal(size=3)), faces)


@given(soups())
def test_soups(mesh: Mesh) -> None:
    assert_sound_or_refused(*mesh)


@given(slivers(), scales)
def test_slivers(mesh: Mesh, scale: float) -> None:
    surface = assert_sound_or_refused(scale * mesh[0], mesh[1])
    if np.ptp(mesh[0][:, 0]) > 0.01:
        assert surface is not None


@given(strips(), scales)
def test_one_sided_strips(mesh: Mesh, scale: float) -> None:
    assert assert_sound_or_refused(scale * mesh[0], mesh[1]) is not None


@given(nests(), scales, seeds)
def test_shells_in_shells_all_face_outward(mesh: Mesh, scale: float, seed: int) -> None:
    shift = np.random.default_rng(seed).normal(size=3)
    surface = clean("mesh", scale * (mesh[0] + shift), mesh[1])
    outward = surface.vertices - scale * shift
    assert (np.einsum("ij,ij->i", surface.normals, outward) > 0).all()


@given(fans())
def test_fans(mesh: Mesh) -> None:
    assert_sound_or_refused(*mesh)


def test_moebius_strip_gets_two_sides() -> None:
    surface = clean("band", *strip(40, 1))
    assert_sound(surface)
    assert len(surface.faces) == 80
    assert [line for line in surface.notices if "one-sided" in line] == [
        "band: 1 edge cut to give a one-sided surface two sides"
    ]
    assert not any("one-sided" in line for line in clean("band", *strip(40, 2)).notices)


def test_notices_count(cube: Mesh) -> None:
    vertices, faces = cube
    split = vertices[faces].reshape(-1, 3)
    corners = np.arange(36).reshape(-1, 3)
    junk = np.array([[0, 0, 1], corners[0], corners[3][::-1]])
    turned = np.where(np.arange(12)[:, None] < 3, corners[:, ::-1], corners)
    surface = clean("cube", np.concatenate([split, [[9, 9, 9]]]), np.concatenate([turned, junk]))
    assert surface.notices == (
        "cube: 1 vertex without a face dropped",
        "cube: 36 vertices welded into 8",
        "cube: 2 duplicate faces dropped",
        "cube: 1 face without area dropped",
        "cube: 3 faces turned over",
    )
    assert volume(surface) == pytest.approx(1.0)
    assert clean("cube", vertices, faces).notices == ()


def test_two_boxes_that_share_an_edge_stay_two(cube: Mesh) -> None:
    vertices, faces = cube
    both = np.concatenate([vertices, vertices + np.array([1, 1, 0])])
    surface = clean("boxes", both, np.concatenate([faces, faces + 8]))
    assert_sound(surface)
    assert len(surface.vertices) == 16
    assert volume(surface) == pytest.approx(2.0)
    assert surface.notices == (
        "boxes: 16 vertices welded into 14",
        "boxes: 1 edge of more than two faces cut",
    )
    for corners in (surface.faces[:12], surface.faces[12:]):
        assert len(np.unique(corners)) == 8


def test_bodies_that_touch_in_a_point_are_split(cube: Mesh) -> None:
    vertices, faces = cube
    surface = clean("x", np.concatenate([vertices, vertices + 1]), np.concatenate([faces, faces + 8]))
    assert len(surface.vertices) == 16
    assert surface.notices[-1] == "x: 1 vertex split where pieces touch in a point"


def test_a_wall_on_a_floor_leaves_the_floor_whole() -> None:
    vertices = [(x, 0, z) for x in (-1, 0, 1) for z in (0, 1)] + [(0, 1, 0), (0, 1, 1)]
    floor = [(0, 1, 2), (2, 1, 3), (2, 3, 4), (4, 3, 5)]
    surface = clean("x", np.array(vertices, dtype=float), np.array([*floor, (2, 3, 6), (6, 3, 7)]))
    assert_sound(surface)
    assert len(np.unique(surface.faces[:4])) == 6
    assert len(surface.vertices) == 10


def test_body_with_a_hole_is_turned_outward() -> None:
    ball = trimesh.creation.icosphere(subdivisions=2)
    faces = ball.faces[20:, ::-1]
    surface = clean("ball", ball.vertices, faces)
    assert (
        np.einsum("ij,ij->i", face_vectors(surface.vertices, surface.faces), surface.vertices[surface.faces[:, 0]]) > 0
    ).all()
    assert surface.notices[-1] == f"ball: {len(faces)} faces turned over"


def test_a_cap_in_an_edge_closes_without_a_slit() -> None:
    # A square cut in two; one half is cut again at the middle of the diagonal, and a face without area fills the slit.
    vertices = np.array([(0, 0, 0), (1, 0, 0), (1, 0, -1), (0, 0, -1), (0.5, 0, -0.5)])
    surface = clean("x", vertices, np.array([(0, 1, 2), (0, 4, 3), (4, 2, 3), (0, 2, 4)]))
    assert_sound(surface)
    assert len(surface.faces) == 4
    edges = np.sort(np.stack([surface.faces, np.roll(surface.faces, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 1).sum() == 4
    assert surface.notices == ("x: 1 sliver mended",)


def test_needle_is_closed_at_its_short_side() -> None:
    disc = [(np.cos(t), 0.0, -np.sin(t)) for t in 2 * np.pi * np.array([0.0, 0.2, 0.2 + 1e-6, 0.5, 0.8])]
    faces = np.array([(0, 1 + i, 1 + (i + 1) % 5) for i in range(5)])
    surface = clean("x", np.array([(0, 0, 0), *disc]), faces)
    assert len(surface.faces) == 4
    assert surface.notices == ("x: 1 sliver mended",) or "welded" in surface.notices[0]


def test_too_many_faces_are_decimated(tmp_path: Path) -> None:
    ball = trimesh.creation.icosphere(subdivisions=5)
    surface = clean("ball", ball.vertices, ball.faces, max_faces=2000)
    assert_sound(surface)
    assert 1800 <= len(surface.faces) <= 2100
    assert volume(surface) == pytest.approx(4 / 3 * np.pi, rel=0.01)
    assert surface.notices == (f"ball: 20480 faces decimated to {len(surface.faces)}",)
    np.testing.assert_allclose(np.linalg.norm(surface.vertices, axis=1), 1.0, atol=0.01)


def test_loose_pieces_are_decimated_or_refused() -> None:
    corners = np.random.default_rng(0).normal(size=(3000, 3))
    try:
        surface = clean("x", corners, np.arange(3000).reshape(-1, 3), max_faces=100)
    except MeshError as error:
        assert re.match(r"x: 1000 faces in pieces too small to simplify, expected at most 100 or", str(error))  # noqa: PT017
    else:
        assert_sound(surface)
        assert len(surface.faces) <= 105


def test_more_faces_than_can_be_handled() -> None:
    faces = np.zeros((MOST + 1, 3), dtype=np.int64)
    with pytest.raises(MeshError, match=rf"^x: {MOST + 1} faces, expected at most {MOST}$"):
        clean("x", np.eye(3), faces)


@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1.0, 1e3, 1e6])
def test_unit_does_not_matter(cube: Mesh, scale: float) -> None:
    surface = clean("cube", scale * cube[0], cube[1])
    assert surface.extent == pytest.approx(scale)
    assert len(surface.vertices) == 8
    assert volume(surface) == pytest.approx(scale**3)


def test_polygons(write_obj: Callable[..., Path], tmp_path: Path) -> None:
    path = tmp_path / "prism.obj"
    ring = [(np.cos(t), y, -np.sin(t)) for y in (0, 1) for t in 2 * np.pi * np.arange(6) / 6]
    lines = [f"v {x} {y} {z}" for x, y, z in ring] + ["f 7 8 9 10 11 12", "f 6 5 4 3 2 1"]
    lines += [f"f {i + 1} {(i + 1) % 6 + 1} {(i + 1) % 6 + 7} {i + 7}" for i in range(6)]
    path.write_text("\n".join(lines))
    surface = load_mesh(path)
    assert_sound(surface)
    assert len(surface.faces) == 20
    assert volume(surface) == pytest.approx(1.5 * np.sqrt(3))
    assert surface.notices == ()


@pytest.mark.parametrize("start", range(8))
def test_hollow_polygons(tmp_path: Path, start: int) -> None:
    """A letter U as the lid and the floor of a box, whatever corner its polygon begins at."""
    ring = [(0, 0), (3, 0), (3, 3), (2.1, 3), (2, 1), (1, 1), (0.9, 3), (0, 3)]
    lines = [f"v {x} {y} {-z}" for y in (0, 1) for x, z in ring]
    turned = [(start + i) % 8 for i in range(8)]
    lines += ["f " + " ".join(str(i + 9) for i in turned), "f " + " ".join(str(i + 1) for i in turned[::-1])]
    lines += [f"f {i + 1} {(i + 1) % 8 + 1} {(i + 1) % 8 + 9} {i + 9}" for i in range(8)]
    path = tmp_path / "u.obj"
    path.write_text("\n".join(lines))
    surface = load_mesh(path)
    assert_sound(surface)
    area = 9 - 0.5 * (1.2 + 1) * 2
    assert volume(surface) == pytest.approx(area)
    upward = face_vectors(surface.vertices, surface.faces)[:, 1] / 2
    assert upward[upward > 1e-9].sum() == pytest.approx(area), "nothing lies on anything else"


@pytest.mark.parametrize("start", range(4))
def test_hollow_quads(tmp_path: Path, start: int) -> None:
    ring = [(0, 0), (2, 0), (0.3, 0.3), (0, 2)]
    lines = [f"v {x} 0 {-z}" for x, z in ring] + ["f " + " ".join(str((start + i) % 4 + 1) for i in range(4))]
    path = tmp_path / "dart.obj"
    path.write_text("\n".join(lines))
    surface = load_mesh(path)
    assert face_vectors(surface.vertices, surface.faces)[:, 1] / 2 == pytest.approx(np.array([0.3, 0.3]))
    folds = (f"{path}: 1 fold of hollow polygons undone",)
    assert surface.notices[-1:] == (() if start in (0, 2) else folds)


def shipped() -> list[Path]:
    """Mesh files of the packages that this project depends on; @pmndrs/assets wraps its own in JavaScript."""
    if not PACKAGES.exists():
        return []
    roots = [PACKAGES, Path(trimesh.__file__).parents[1]]
    found = {path for root in roots for path in root.rglob("*") if path.suffix.lower() in SUFFIXES and path.is_file()}
    return sorted(found | set(PACKAGES.glob("@pmndrs/assets/models/*.glb.js")))


def unpacked(path: Path, folder: Path) -> Path:
    """The mesh file itself."""
    if path.suffix != ".js":
        return path
    data = re.search(r"base64,([A-Za-z0-9+/=]+)", path.read_text())
    assert data
    inner = folder / path.name.removesuffix(".js")
    inner.write_bytes(base64.b64decode(data[1]))
    return inner


@pytest.mark.parametrize("path", shipped(), ids=lambda path: path.name)
def test_shipped_meshes(tmp_path: Path, path: Path) -> None:
    path = unpacked(path, tmp_path)
    try:
        surface = load_mesh(path)
    except MeshError as error:
        assert re.fullmatch(re.escape(str(path)) + r": [^\n]+", str(error))  # noqa: PT017 — refusing is as good
        return
    assert_sound(surface)
    assert len(surface.faces) <= 1.05 * MAX_FACES


def assert_baked_or_refused(path: Path, folder: Path) -> None:
    """Exit 0 with a valid asset, or exit 2 with one line and nothing written."""
    shutil.rmtree(folder, ignore_errors=True)
    errors = io.StringIO()
    with contextlib.redirect_stderr(errors):
        status = cli.main(["bake", str(path), "-o", str(folder), *TINY])
    if status == 0:
        assert validate(folder) == []
    else:
        assert status == 2
        assert re.fullmatch(r"furbake: error: [^\n]+\n", errors.getvalue())
        assert not folder.exists()


@pytest.mark.parametrize("path", [p for p in shipped() if p.stat().st_size < SMALL], ids=lambda path: path.name)
def test_shipped_meshes_are_baked(tmp_path: Path, path: Path) -> None:
    assert_baked_or_refused(unpacked(path, tmp_path), tmp_path / "out")


@given(st.one_of(soups(), strips(), fans(), slivers(), nests()), scales)
def test_any_mesh_is_baked_or_refused(tmp_path_factory: pytest.TempPathFactory, mesh: Mesh, scale: float) -> None:
    folder = tmp_path_factory.mktemp("any")
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in (scale * mesh[0]).tolist()]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in mesh[1].tolist()]
    (folder / "mesh.obj").write_text("\n".join(lines))
    assert_baked_or_refused(folder / "mesh.obj", folder / "out")
