"""The extension in Blender itself: `npm run blender -- --bpy` installs it, else its tests are skipped."""

from __future__ import annotations

import ast
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake.asset.read import read_asset
from furbake.asset.validate import validate
from furbake.groom.ground import read_ground

ROOT = Path(__file__).parents[3]
BAKER = ROOT / "baker"
BLENDER = BAKER / ".bpy" / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
WITHOUT = ("command.py", "job.py", "serve.py")
"""Modules of the extension that do without Blender."""

installed = pytest.mark.skipif(not BLENDER.exists(), reason="no Blender: npm run blender -- --bpy installs it")


def packed(folder: Path) -> Path:
    """The extension as it would be published, but for the viewer, which is an empty file."""
    for name in ("fur-view.js", "fur-view.licenses.md"):
        (folder / name).touch()
    module = (ROOT / "web" / "tools" / "supply" / "extension.mjs").as_uri()
    call = f"import('{module}').then(({{ packExtension }}) => console.log(packExtension(...process.argv.slice(1))))"
    node = shutil.which("node")
    assert node
    done = subprocess.run([node, "-e", call, str(folder), str(folder)], capture_output=True, text=True, check=True)
    return Path(done.stdout.strip())


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """Findings of `inside.py` in Blender; `folder` has the baked folders."""
    folder = tmp_path_factory.mktemp("blender")
    package = packed(folder)
    furbake = Path(sys.executable).with_name("furbake.exe" if os.name == "nt" else "furbake")
    script = Path(__file__).with_name("inside.py")
    done = subprocess.run(
        [BLENDER, script, package, furbake, folder],
        env=os.environ | {"BLENDER_USER_RESOURCES": str(folder / "user")},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    return json.loads((folder / "found.json").read_text("utf-8")) | {"folder": folder}


@installed
def test_a_bake_of_a_monkey_keeps_joints_clip_and_groom(found: dict[str, Any]) -> None:
    assert found["haired"] == ["FINISHED"]
    folder = found["folder"] / "haired"
    assert validate(folder) == []
    record = json.loads((folder / "bake.json").read_text("utf-8"))
    assert record["asset"]["rig"] == {"joints": 2, "clips": 1, "targets": 0}
    assert [clip["name"] for clip in read_asset(folder).document["animations"]] == ["nod"]
    assert record["options"]["groom"]
    assert any(f"{found['strands']['count']} hairs" in line for line in found["told"])
    assert not any("furbake-" in line or ".glb" in line for line in found["told"])


@installed
def test_a_bake_leaves_the_scene_as_it_was(found: dict[str, Any]) -> None:
    assert found["kept"]


@installed
def test_a_vertex_group_is_the_length(found: dict[str, Any]) -> None:
    assert found["plain"] == ["FINISHED"]
    ground = read_ground(read_asset(found["folder"] / "plain fur"), (1.0, 1.0, 1.0))
    wanted = 0.2 * np.clip(0.3 + 0.35 * (ground.vertices[:, 1] + 1), 0, 1)
    assert wanted.min() < 0.08
    assert wanted.max() > 0.18
    np.testing.assert_allclose(ground.reach, wanted, atol=0.2 * 2.5 / 255)  # lengths have 6 bits


@installed
def test_hairs_stand_on_the_body_at_rest(found: dict[str, Any]) -> None:
    """The monkey nods in the frame that is seen; without the rest pose its hairs were off by a tenth."""
    strands = found["strands"]
    assert strands["count"] > 1000
    assert strands["off"] < 0.06  # one hair of quick_fur, beside an edge; the others are on it to 1e-7
    assert 0.05 < strands["lengths"][1] < 0.2


@installed
def test_particle_hair_comes_with_its_children(found: dict[str, Any]) -> None:
    hairs = found["particles"]
    assert hairs["count"] == 50 * 5
    assert hairs["off"] < 1e-5
    assert hairs["lengths"][2] == pytest.approx(0.2, rel=1e-3)
    assert hairs["widths"] == pytest.approx([0.01, 0.0], abs=1e-6)
    assert hairs["colour"] == pytest.approx([0.5, 0.25, 0.125])


@installed
def test_hairs_are_as_thick_as_their_object_is_large(found: dict[str, Any]) -> None:
    """Cycles scales widths with the object: a hair that is scaled along itself stays as thin, one across is a slab."""
    assert found["large"]["widths"] == pytest.approx([8 * 0.01, 0.0], abs=1e-6)
    assert found["stretched"] == pytest.approx([1, 8**0.5, 8])


@installed
def test_a_body_is_written_as_it_is_rendered(found: dict[str, Any]) -> None:
    assert found["divided"] == [2 * 16, True]


@installed
def test_hairs_take_the_colour_that_their_material_uses(found: dict[str, Any]) -> None:
    """Neither a shader that hangs loose nor an attribute that the skin hands on is theirs."""
    colours = {name: hairs["colour"] for name, hairs in found["colours"].items()}
    assert colours.pop("plain") == pytest.approx([0.5, 0.25, 0.125])
    assert colours.pop("attribute") == pytest.approx([0, 1, 0])
    assert set(colours.values()) == {None}
    notes = {name: hairs["notes"][1:] for name, hairs in found["colours"].items()}
    about, rest = "hair colour of material", "which is not read; the preset's are taken"
    assert notes == {
        "plain": [],
        "attribute": [f"{about} attribute: by attribute paint, without what the node Gamma makes of it"],
        "missing": [f"{about} missing: by attribute none, which its hairs have not; the preset's are taken"],
        "picture": [f"{about} picture: by a picture, {rest}"],
        "melanin": [f"{about} melanin: by melanin, {rest}"],
    }
    assert found["spline"]["notes"][1:] == ["hairs without a material: colours by their attribute paint"]


@installed
def test_hairs_that_are_not_taken_are_told(found: dict[str, Any]) -> None:
    hidden = found["hidden"]
    assert hidden["some"] == [True, ["hairs left out, as they are not rendered: 1 (bow.001)"]]
    assert "hairs that are not rendered (bow, bow.001), expected some that are" in hidden["none"]
    has, (note,) = hidden["loose"]
    assert not has
    assert note.endswith("the preset's are taken; hair curves without a surface: bow")


@installed
def test_paths_begin_at_the_saved_file(found: dict[str, Any]) -> None:
    places = found["places"]
    refused = {places.pop(f"preset {name}").strip() for name in ("my.toml", "//my.toml")}
    assert refused == {"Error: my.toml: layers: got 99, expected 1 to 64"}
    assert places.pop("warnings") == []
    assert places == {"": "fur-Plane-001", "out rel": "out rel", "//out rel": "out rel", "OUT/whole": "whole"}


@installed
def test_messages_name_the_artists_things(found: dict[str, Any]) -> None:
    assert found["hidden"]["afar"].startswith("Error: hairs of Plane.001: ")
    assert "Suzanne: 2 joints and 1 clip (nod) are kept" in found["told"]
    assert "lengths are Blender units, 0.01 m each by the scene's Unit Scale" in found["unit"]


@installed
def test_imported_hairs_are_attached_and_cover_as_much(found: dict[str, Any]) -> None:
    regrown = found["regrown"]
    assert regrown["few"] == [[2.0, 2.0]] * 2  # of eight hairs with a radius of 0.5
    assert regrown["root"] == pytest.approx([3.5, -0.5, 0])
    assert regrown["place"] == pytest.approx([0.75, 0.25])


@installed
def test_a_bezier_hair_is_a_line_of_points_in_its_own_colour(found: dict[str, Any]) -> None:
    hairs = found["spline"]
    assert hairs["lengths"][1] == pytest.approx(np.pi / 2, rel=1e-2)
    assert hairs["widths"] == pytest.approx([0.02, 0.02])
    assert hairs["colour"] == pytest.approx([0, 1, 0])


@installed
def test_a_baked_folder_is_taken_back(found: dict[str, Any]) -> None:
    assert found["take"] == ["FINISHED"]
    taken = found["taken"]
    assert {"ARMATURE", "CURVES", "MESH"} <= set(taken["kinds"])
    assert taken["hairs"] > 1000
    assert taken["off"] < 0.01
    assert any(name.startswith("nod") for name in taken["actions"])
    assert taken["materials"] == [["ATTRIBUTE", "BSDF_HAIR_PRINCIPLED", "OUTPUT_MATERIAL"]]


@installed
def test_refusals_are_sentences(found: dict[str, Any]) -> None:
    refused = {name: text.strip() for name, text in found["refused"].items()}
    assert refused["option"].endswith("layers: got 99, expected 1 to 64")
    assert "no vertex group none" in refused["group"]
    assert "expected quotes that close" in refused["quotes"]
    assert "unsaved" in refused["unsaved"]
    assert "no such command, install it with: pip install ./baker" in refused["command"]


@installed
def test_a_cancelled_bake_writes_nothing(found: dict[str, Any]) -> None:
    assert found["cancelled"] == "cancelled, nothing was written"
    left = {path.name for path in found["folder"].iterdir()}
    assert {"haired", "plain fur"} <= left
    assert not [name for name in left if name.startswith(".") and name.endswith(".part")]


@installed
def test_the_extension_goes_without_a_trace(found: dict[str, Any]) -> None:
    assert found["gone"]


@installed
def test_blender_takes_the_manifest(tmp_path: Path) -> None:
    site = next((BAKER / ".bpy").rglob("site-packages"))
    (tool,) = site.glob("bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py")
    done = subprocess.run([BLENDER, tool, "validate", packed(tmp_path)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def modules(path: Path) -> set[str]:
    """Libraries that a module imports."""
    nodes = list(ast.walk(ast.parse(path.read_text("utf-8"))))
    plain = {alias.name.split(".")[0] for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    return plain | {(node.module or "").split(".")[0] for node in nodes if isinstance(node, ast.ImportFrom)}


def test_only_the_extension_knows_blender_and_it_knows_no_furbake() -> None:
    extension = sorted((BAKER / "blender").glob("*.py"))
    for path in [*(BAKER / "furbake").rglob("*.py"), *(path for path in extension if path.name in WITHOUT)]:
        assert not modules(path) & {"bpy", "mathutils"}, path
    for path in extension:
        assert "furbake" not in modules(path), path
        assert len(path.read_text("utf-8").splitlines()) <= 300
    assert len(extension) <= 15
