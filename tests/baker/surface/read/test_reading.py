"""Colours, pictures and coordinates of files that trimesh reads."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from furbake.surface.mesh import load_mesh
from furbake.surface.read.companions import companions

OBJ = """mtllib coat.mtl
v 0 0 0
v 1 0 0
v 1 0 -1
v 0 0 -1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl coat
f 1/1 2/2 3/3 4/4
"""


@pytest.fixture
def textured(tmp_path: Path) -> Path:
    """A square whose picture is white above and black below."""
    pixels = np.zeros((8, 8, 3), dtype=np.uint8)
    pixels[:4] = 255
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, "PNG")
    (tmp_path / "coat.png").write_bytes(stream.getvalue())
    (tmp_path / "coat.mtl").write_text("newmtl coat\nKd 0.8 0.8 0.8\nmap_Kd coat.png\n")
    path = tmp_path / "square.obj"
    path.write_text(OBJ)
    return path


def test_picture_of_an_obj_file(textured: Path) -> None:
    surface = load_mesh(textured)
    assert surface.uv is not None
    np.testing.assert_allclose(surface.uv[..., 1], 1.0 + surface.vertices[surface.faces][..., 2], atol=1e-9)
    assert surface.colours is not None
    np.testing.assert_allclose(surface.colours[:, 1], -surface.vertices[:, 2], atol=0.2)
    (skin,) = surface.skin
    assert skin.material.picture
    assert skin.material.picture.data == (textured.parent / "coat.png").read_bytes()
    assert skin.material.factor == (1.0, 1.0, 1.0, 1.0)


def test_colour_of_an_obj_file(textured: Path) -> None:
    (textured.parent / "coat.mtl").write_text("newmtl coat\nKd 1 0.5 0\n")
    assert load_mesh(textured).colour == pytest.approx((1.0, 0.214, 0.0), abs=0.005)


def test_what_an_obj_file_names_and_is_not_there_is_told(textured: Path) -> None:
    (textured.parent / "coat.png").unlink()
    told = f"{textured}: 1 picture left out that cannot be read"
    assert told in load_mesh(textured).notices
    library = textured.parent / "coat.mtl"
    library.write_text(library.read_text() + "newmtl other\nmap_Kd coat.png\n")
    assert told in load_mesh(textured).notices
    library.unlink()
    assert f"{textured}: materials of coat.mtl left out, which cannot be read" in load_mesh(textured).notices


def test_vertex_colours_are_srgb(tmp_path: Path) -> None:
    ball = trimesh.creation.icosphere(subdivisions=1)
    ball.visual.vertex_colors = np.column_stack([np.full((42, 3), (255, 188, 0)), np.linspace(0, 255, 42)]).astype(
        np.uint8
    )
    path = tmp_path / "ball.ply"
    path.write_bytes(ball.export(file_type="ply"))
    surface = load_mesh(path)
    assert surface.colour == pytest.approx((1.0, 0.503, 0.0), abs=0.001)
    assert surface.attributes["color"][:, 1] == pytest.approx(np.full(42, 188 / 255))
    assert np.ptp(surface.attributes["color"][:, 3]) == pytest.approx(1.0)


def test_files_beside_a_model(textured: Path, tmp_path: Path) -> None:
    assert [path.name for path in companions(textured)] == ["coat.mtl", "coat.png"]
    gltf = tmp_path / "model.gltf"
    gltf.write_text('{"buffers": [{"uri": "a%20b.bin"}, {"uri": "data:,x"}], "images": [{"uri": "coat.png"}, {}]}')
    assert [path.name for path in companions(gltf)] == ["coat.png"]
    (tmp_path / "a b.bin").write_bytes(b"1")
    assert [path.name for path in companions(gltf)] == ["a b.bin", "coat.png"]
    gltf.write_text("no JSON")
    assert companions(gltf) == []
    assert companions(tmp_path / "coat.png") == []
