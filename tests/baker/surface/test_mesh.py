"""Every file becomes a clean surface, or one sentence."""

from __future__ import annotations

import base64
import contextlib
import json
import re
import struct
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import DracoPy
import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from furbake.surface.mesh import LARGEST, MeshError, Surface, clean, load_mesh
from furbake.surface.repair.topology import angle_normals, face_vectors, orient, weld

BUNNY = Path(__file__).parents[3] / "node_modules" / "@pmndrs" / "assets" / "models" / "bunny.glb.js"


def glb(document: dict[str, Any], data: bytes) -> bytes:
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data += bytes(-len(data) % 4)
    body = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def draco_glb(
    vertices: Any, faces: Any, spoil: Any = lambda data: data, extension: str = "KHR_draco_mesh_compression"
) -> bytes:
    data = DracoPy.encode(vertices.astype(np.float32), faces.astype(np.uint32), quantization_bits=14)
    low, high = vertices.min(axis=0).tolist(), vertices.max(axis=0).tolist()
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "translation": [0, 5, 0]}],
        "meshes": [
            {
                "primitives": [
                    {
                        "attributes": {"POSITION": 1},
                        "indices": 0,
                        "extensions": {extension: {"bufferView": 0, "attributes": {"POSITION": 0}}},
                    }
                ]
            }
        ],
        "accessors": [
            {"componentType": 5125, "count": int(faces.size), "type": "SCALAR"},
            {"componentType": 5126, "count": len(vertices), "type": "VEC3", "min": low, "max": high},
        ],
        "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
        "buffers": [{"byteLength": len(data)}],
        "extensionsUsed": [extension],
        "extensionsRequired": [extension],
    }
    return glb(document, spoil(data))


def volume(surface: Surface) -> float:
    a, b, c = (surface.vertices[surface.faces[:, i]] for i in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def test_cube(write_obj: Callable[..., Path], cube: tuple[Any, Any]) -> None:
    surface = load_mesh(write_obj(*cube))
    assert len(surface.vertices) == 8
    assert len(surface.faces) == 12
    assert surface.extent == 1.0
    assert volume(surface) == pytest.approx(1.0)
    np.testing.assert_allclose(surface.normals, (surface.vertices - 0.5) / np.sqrt(0.75), atol=1e-12)


def test_seams_are_welded(write_obj: Callable[..., Path], cube: tuple[Any, Any]) -> None:
    vertices, faces = cube
    chance = np.random.default_rng(0)
    split = vertices[faces].reshape(-1, 3) + chance.uniform(-1e-7, 1e-7, (36, 3))
    surface = load_mesh(write_obj(split, np.arange(36).reshape(-1, 3)))
    assert len(surface.vertices) == 8
    assert len(surface.faces) == 12


@given(st.integers(0, 2**32 - 1))
def test_winding_is_repaired(seed: int) -> None:
    ball = trimesh.creation.icosphere(subdivisions=2)
    flip = np.random.default_rng(seed).random(len(ball.faces)) < 0.5
    faces = np.where(flip[:, None], ball.faces[:, ::-1], ball.faces)
    two = np.concatenate([faces, faces + len(ball.vertices)])
    vertices = np.concatenate([ball.vertices, ball.vertices + 3.0])
    turned = orient(vertices, two)
    centre = np.where(np.arange(len(two)) < len(faces), 0.0, 3.0)[:, None]
    outward = vertices[turned].mean(axis=1) - centre
    assert (np.einsum("ij,ij->i", face_vectors(vertices, turned), outward) > 0).all()


def test_open_surface_keeps_the_side_of_most_of_its_faces(write_obj: Callable[..., Path]) -> None:
    grid = trimesh.creation.box().faces  # any small index array will do to get a dtype
    vertices = [(x, 0, z) for x in range(4) for z in range(4)]
    up = [(4 * x + z, 4 * x + z + 1, 4 * x + z + 4) for x in range(3) for z in range(3)]
    up += [(4 * x + z + 1, 4 * x + z + 5, 4 * x + z + 4) for x in range(3) for z in range(3)]
    faces = np.array(up, dtype=grid.dtype)
    faces[:4] = faces[:4, ::-1]
    np.testing.assert_allclose(load_mesh(write_obj(vertices, faces)).normals, np.tile([0, 1, 0], (16, 1)), atol=1e-12)


def test_degenerate_and_repeated_faces_go(write_obj: Callable[..., Path], cube: tuple[Any, Any]) -> None:
    vertices, faces = cube
    junk = [(0, 0, 1), (0, 1, 0), tuple(faces[0]), tuple(faces[3][::-1])]
    surface = load_mesh(write_obj([*vertices, (9, 9, 9)], [*faces, *junk]))
    assert len(surface.vertices) == 8
    assert len(surface.faces) == 12


def test_two_triangles_are_a_surface(write_obj: Callable[..., Path]) -> None:
    surface = load_mesh(write_obj([(0, 0, 0), (1, 0, 0), (1, 0, -1), (0, 0, -1)], [(0, 1, 2), (0, 2, 3)]))
    assert len(surface.faces) == 2


def test_parts_of_a_scene_stand_where_their_transforms_put_them(tmp_path: Path) -> None:
    scene = trimesh.Scene()
    scene.add_geometry(trimesh.creation.box())
    scene.add_geometry(trimesh.creation.box(), transform=trimesh.transformations.translation_matrix([4, 0, 0]))
    path = tmp_path / "two.glb"
    path.write_bytes(scene.export(file_type="glb"))
    surface = load_mesh(path)
    assert len(surface.faces) == 24
    assert surface.vertices[:, 0].min() == pytest.approx(-0.5)
    assert surface.vertices[:, 0].max() == pytest.approx(4.5)
    assert volume(surface) == pytest.approx(2.0)


@pytest.mark.parametrize("kind", ["ply", "stl", "off", "obj", "glb"])
def test_kinds_of_file(tmp_path: Path, kind: str) -> None:
    path = tmp_path / f"ball.{kind}"
    data = trimesh.creation.icosphere(subdivisions=1).export(file_type=kind)
    path.write_bytes(data.encode() if isinstance(data, str) else data)
    surface = load_mesh(path)
    assert (len(surface.vertices), len(surface.faces)) == (42, 80)


@pytest.mark.parametrize(
    ("factor", "colour"), [([0.4, 0.2, 0.1, 1.0], (0.4, 0.2, 0.1)), ([0.8, 0.8, 0.8, 1.0], (1.0, 1.0, 1.0))]
)
def test_base_colour(tmp_path: Path, factor: list[float], colour: tuple[float, ...]) -> None:
    box = trimesh.creation.box()
    material = trimesh.visual.material.PBRMaterial(baseColorFactor=factor)
    box.visual = trimesh.visual.TextureVisuals(material=material)
    path = tmp_path / "box.glb"
    path.write_bytes(box.export(file_type="glb"))
    assert load_mesh(path).colour == pytest.approx(colour, abs=0.003)


def test_comment_in_latin_1(tmp_path: Path, write_obj: Callable[..., Path], cube: tuple[Any, Any]) -> None:
    path = write_obj(*cube)
    path.write_bytes("# ein hübscher Würfel, né en été\n".encode("latin-1") + path.read_bytes())
    assert len(load_mesh(path).faces) == 12


def test_draco_is_decoded(tmp_path: Path) -> None:
    ball = trimesh.creation.icosphere(subdivisions=2)
    path = tmp_path / "ball.glb"
    path.write_bytes(draco_glb(ball.vertices, ball.faces))
    surface = load_mesh(path)
    assert len(surface.faces) == len(ball.faces)
    distance = np.linalg.norm(surface.vertices - [0, 5, 0], axis=1)
    np.testing.assert_allclose(distance, 1.0, atol=2e-4)


@pytest.mark.skipif(not BUNNY.exists(), reason="the npm packages are not installed")
def test_bunny(tmp_path: Path) -> None:
    data = re.search(r"base64,([A-Za-z0-9+/=]+)", BUNNY.read_text())
    assert data
    path = tmp_path / "bunny.glb"
    path.write_bytes(base64.b64decode(data[1]))
    surface = load_mesh(path)
    assert (len(surface.vertices), len(surface.faces)) == (2826, 5648)
    assert surface.extent == pytest.approx(1.831, abs=1e-3)
    assert volume(surface) > 0.5


NAN = "v 0 0 0\nv nan 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n"
FLAT = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3\nf 2 3 4\n"
POINT = "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n"
HUGE = "v 0 0 0\nv 1e30 0 0\nv 0 1e30 0\nf 1 2 3\n"
ball = trimesh.creation.icosphere(subdivisions=2)

PLY_POINTS = b"""ply
format ascii 1.0
element vertex 2
property float x
property float y
property float z
end_header
0 0 0
1 1 1
"""

BAD = {
    "empty.obj": (b"", "empty.obj: 0 bytes, expected a mesh file"),
    "text.obj": (b"Dear diary,\nno triangles today.\n", "text.obj: no faces, expected a surface of triangles"),
    "points.obj": (b"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "points.obj: no faces, expected a surface of triangles"),
    "points.ply": (
        PLY_POINTS,
        "points.ply: no faces, expected a surface of triangles",
    ),
    "nan.obj": (NAN.encode(), "nan.obj: 1 of 4 vertices are not finite, expected numbers (no NaN, no infinity)"),
    "inf.obj": (NAN.replace("nan", "inf").encode(), "inf.obj: 1 of 4 vertices are not finite, expected numbers"),
    "flat.obj": (FLAT.encode(), "flat.obj: all faces have zero area, expected a surface"),
    "point.obj": (POINT.encode(), "point.obj: all faces have zero area, expected a surface"),
    "huge.obj": (HUGE.encode(), f"huge.obj: largest side is 1e+30 units, expected 1e-09 to {LARGEST:g}"),
    "what.foo": (b"1", "what.foo: file type is 'foo', expected one of "),
    "head.blend": (b"1", "head.blend: is a scene of Blender, expected a mesh file such as .glb, or a bake in Blender"),
    "noise.glb": (bytes(range(256)), "noise.glb: cannot be read as glb ("),
    "short.ply": (ball.export(file_type="ply")[:-40], "short.ply: cannot be read as ply ("),
    "draco.glb": (
        draco_glb(ball.vertices, ball.faces, lambda data: data[:20] + bytes(len(data) - 20)),
        "draco.glb: geometry that cannot be decoded (KHR_draco_mesh_compression), expected intact Draco or plain data",
    ),
    "codec.glb": (
        draco_glb(ball.vertices, ball.faces, extension="EXT_meshopt_compression"),
        "codec.glb: geometry that cannot be decoded (EXT_meshopt_compression), expected intact Draco or plain data",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_file_is_one_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str], name: str
) -> None:
    monkeypatch.chdir(tmp_path)
    data, message = BAD[name]
    Path(name).write_bytes(data)
    with pytest.raises(MeshError) as caught:
        load_mesh(Path(name))
    assert str(caught.value).startswith(message)
    assert "\n" not in str(caught.value)
    assert capfd.readouterr() == ("", "")


def test_missing_file_and_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("folder.obj").mkdir()
    expected = r"^nope\.obj: no such file, expected a mesh file or sphere, plane, plane:RxC, torus"
    with pytest.raises(MeshError, match=expected):
        load_mesh(Path("nope.obj"))
    with pytest.raises(MeshError, match=r"^folder\.obj: is a folder, expected a mesh file$"):
        load_mesh(Path("folder.obj"))


def test_face_of_a_missing_vertex() -> None:
    with pytest.raises(MeshError, match="a face uses vertex 9, expected 0 to 3"):
        clean("x", np.eye(4, 3), np.array([[0, 1, 9]]))


@given(st.integers(0, 10_000))
def test_broken_bytes_never_end_in_a_traceback(tmp_path_factory: pytest.TempPathFactory, seed: int) -> None:
    chance = np.random.default_rng(seed)
    kind = ("glb", "ply", "obj", "stl", "off")[seed % 5]
    whole = ball.export(file_type=kind)
    data = np.frombuffer(whole.encode() if isinstance(whole, str) else whole, np.uint8).copy()
    start = chance.integers(len(data))
    data[start : start + chance.integers(1, 40)] = chance.integers(256)
    path = tmp_path_factory.mktemp("fuzz") / f"x.{kind}"
    path.write_bytes(data[: chance.integers(1, len(data) + 1)].tobytes())
    with contextlib.suppress(MeshError):
        surface = load_mesh(path)
        assert np.isfinite(surface.vertices).all()
        np.testing.assert_allclose(np.linalg.norm(surface.normals, axis=1), 1.0)


def test_normals_do_not_depend_on_the_triangulation(cube: tuple[Any, Any]) -> None:
    vertices, faces = cube
    other = np.array([(a, b, d) if i % 2 == 0 else (b, c, d) for i, (a, b, c, d) in enumerate(_quads(faces))])
    np.testing.assert_allclose(angle_normals(vertices, faces), angle_normals(vertices, other), atol=1e-12)


def _quads(faces: Any) -> Iterator[tuple[Any, ...]]:
    for one, two in zip(faces[::2], faces[1::2], strict=True):
        quad = (one[0], one[1], one[2], two[2])
        yield quad
        yield quad


def test_weld_joins_chains_across_cells() -> None:
    vertices = np.array([[0.0, 0, 0], [0.9, 0, 0], [1.8, 0, 0], [9, 0, 0]])
    joined, faces = weld(vertices, np.array([[0, 1, 2], [2, 3, 0]]), 1.0)
    assert len(joined) == 2
    assert faces.tolist() == [[0, 0, 0], [0, 1, 0]]
