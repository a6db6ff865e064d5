"""Broken characters still bake: what cannot be kept is left out and counted, or the file is refused in a sentence."""

from __future__ import annotations

import json
import re
import time
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from furbake.surface.mesh import MeshError, Surface, load_mesh
from furbake.surface.rig.at import pose_at
from furbake.surface.rig.pose import posed
from helpers.broken import REPAIRED, character, long_target, nan_values, out_of_range
from helpers.characters import Character, bent_tube, standing, tube


def assert_sound(surface: Surface) -> None:
    """Finite, within its own lists, and playable."""
    assert all(re.fullmatch(r"[^\n]+: .*\d.*", line) for line in surface.notices), surface.notices
    rig = surface.rig
    if rig is None:
        return
    count = len(rig.vertices)
    assert rig.which.shape == rig.shares.shape == (count, 4)
    assert np.isfinite(rig.inverse_bind).all()
    assert ((rig.which >= 0) & (rig.which < max(len(rig.joints), 1))).all()
    np.testing.assert_allclose(rig.shares.sum(axis=1), 1.0)
    assert len(set(rig.joints)) == len(rig.joints)
    assert all(target.deltas.shape == (count, 3) and np.isfinite(target.deltas).all() for target in rig.targets)
    for clip in rig.clips:
        for channel in clip.channels:
            width = channel.values.shape[1]
            assert width == {"rotation": 4, "weights": len(rig.targets)}.get(channel.path, 3)
            assert np.isfinite(channel.values).all()
            assert (np.diff(channel.times) > 0).all()
        assert np.isfinite(posed(rig, pose_at(rig, clip, 1.0))).all()


@pytest.mark.parametrize(("breaks", "sentence"), REPAIRED.items(), ids=lambda value: getattr(value, "__name__", ""))
def test_what_cannot_be_kept_is_told(tmp_path: Path, breaks: Callable[[Character], None], sentence: str) -> None:
    made = character()
    breaks(made)
    path = made.write(tmp_path)
    surface = load_mesh(path)
    assert f"{path}: {sentence}" in surface.notices
    assert len(surface.faces) == len(tube()[1])
    assert_sound(surface)


def test_what_is_sound_beside_what_is_not_is_kept(tmp_path: Path) -> None:
    made = character()
    long_target(made)
    nan_values(made)
    rig = load_mesh(made.write(tmp_path)).rig
    assert rig is not None
    assert [target.name for target in rig.targets] == ["1"]
    bend, swell = rig.clips
    np.testing.assert_array_equal(bend.channels[0].times, [0, 2])
    np.testing.assert_array_equal(bend.channels[1].times, [0, 1, 2])
    np.testing.assert_array_equal(swell.channels[0].values, [[0], [0], [1]])


def test_vertices_with_bad_weights_follow_what_is_left(tmp_path: Path) -> None:
    made = character()
    out_of_range(made)
    rig = load_mesh(made.write(tmp_path)).rig
    assert rig is not None
    np.testing.assert_array_equal(rig.which[:5, 0], 0)
    np.testing.assert_array_equal(rig.shares[:5], [[1, 0, 0, 0]] * 5)


def test_a_value_that_jumps_still_jumps(tmp_path: Path) -> None:
    """Two keys at one time, as exporters write a cut."""
    made = bent_tube()
    made.clip("cut", (2, "translation", [0, 1, 1, 1, 2, 2, 3], [[i, 0, 0] for i in (0, 1, 8, 5, 6, 6, 7)], "LINEAR"))
    path = made.write(tmp_path)
    surface = load_mesh(path)
    assert surface.rig is not None
    (channel,) = surface.rig.clips[0].channels
    np.testing.assert_allclose(channel.times, [0, 1, 1, 2, 3], rtol=1e-6)
    assert (np.diff(channel.times.astype(np.float32)) > 0).all()
    np.testing.assert_array_equal(channel.values[:, 0], [0, 1, 5, 6, 7])
    told = "2 keys of clips that are not finite or do not follow the one before them left out"
    assert f"{path}: {told}" in surface.notices


@pytest.mark.parametrize("loop", [[0], [1], [4]])
def test_nodes_below_themselves_are_refused_at_once(tmp_path: Path, loop: list[int]) -> None:
    made = character()
    made.json["nodes"][4]["children"] = loop
    with pytest.raises(
        MeshError, match=r"^[^\n]+ \(ValueError: node \d is in the scene twice\), expected a valid file$"
    ):
        load_mesh(made.write(tmp_path))


def test_joints_in_a_circle_outside_of_the_scene_stand_still(tmp_path: Path) -> None:
    made = character()
    made.json["nodes"] += [{"children": [7]}, {"children": [6]}]
    made.json["skins"][0]["joints"] = [2, 6, 7]
    surface = load_mesh(made.write(tmp_path))
    assert_sound(surface)
    assert surface.rig is not None


@pytest.mark.parametrize("chain", [False, True])
def test_seventy_thousand_joints_are_left_out(tmp_path: Path, chain: bool) -> None:
    made = character()
    first = len(made.json["nodes"])
    made.json["nodes"] += [{} for _ in range(70_000)]
    if chain:
        for i in range(69_999):
            made.json["nodes"][first + i]["children"] = [first + i + 1]
        made.json["scenes"][0]["nodes"].append(first)
    else:
        made.json["scenes"][0]["nodes"] += range(first, first + 70_000)
    made.json["skins"][0]["joints"] += range(first, first + 70_000)
    inverse = np.tile(np.eye(4), (70_003, 1, 1))
    inverse[:3, 3, 1] = 0.0, -1.0, -2.0
    made.json["skins"][0]["inverseBindMatrices"] = made.add(inverse)
    path = made.write(tmp_path)
    start = time.process_time()
    surface = load_mesh(path)
    assert time.process_time() - start < 20.0
    assert f"{path}: 70003 joints, more than 65535, left out: none moves the fur" in surface.notices
    assert f"{path}: 1 clip (swell) and 2 morph targets are kept" in surface.notices
    assert_sound(surface)
    assert surface.rig is not None
    assert surface.rig.joints == ()
    np.testing.assert_allclose(surface.rig.vertices, standing(bent_tube()), atol=1e-5)


def test_joints_below_a_scale_of_zero(tmp_path: Path) -> None:
    """Exporters hide parts so."""
    made = character()
    made.json["nodes"][3]["scale"] = [0, 0, 0]
    assert_sound(load_mesh(made.write(tmp_path)))


def test_clips_of_an_archive(tmp_path: Path) -> None:
    one, other = character().write(tmp_path, "one.glb"), character().write(tmp_path, "other.glb")
    single, both = tmp_path / "single.zip", tmp_path / "both.zip"
    for path, files in ((single, [one]), (both, [one, other])):
        with zipfile.ZipFile(path, "w") as archive:
            for file in files:
                archive.write(file, file.name)
    surface = load_mesh(single)
    assert surface.rig is not None
    assert f"{single}: 3 joints, 2 clips (bend, swell) and 2 morph targets are kept" in surface.notices
    surface = load_mesh(both)
    assert surface.rig is None
    told = "joints, clips and morph targets of 2 models in an archive left out: the fur stands still"
    assert f"{both}: {told}" in surface.notices


def test_names_of_clips_stay_in_one_line(tmp_path: Path) -> None:
    made = character()
    made.json["animations"][0]["name"] = "a\nb\x1b[31m" + "c" * 500
    made.json["animations"][1]["name"] = "\ud800"
    surface = load_mesh(made.write(tmp_path))
    assert all("\n" not in line and "\x1b" not in line and len(line) < 400 for line in surface.notices)
    assert surface.rig is not None
    json.dumps(surface.rig.clips[1].name, ensure_ascii=False).encode()
