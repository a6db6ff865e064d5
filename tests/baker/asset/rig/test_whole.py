"""A character goes in, the same character comes out: the file and its bake, posed by a reader of the tests."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake import BakeOptions, bake
from furbake.asset.validate import validate
from helpers.arms import arm
from helpers.khronos import errors
from helpers.moving import Moving
from helpers.written import write_glb

Baked = Callable[..., tuple[Moving, Moving, Path]]


@pytest.fixture
def baked(tmp_path: Path) -> Baked:
    def build(joints: int = 3, targets: bool = True, **options: Any) -> tuple[Moving, Moving, Path]:
        _, rig = arm(joints, targets)
        path = write_glb(tmp_path / "arm.glb", rig)
        # Not compressed: the tests' own reader knows no codec. That nothing is lost by it is shown in test_meshopt.
        bake(str(path), tmp_path / "out", BakeOptions(layers=4, size=8, lights=8, meshopt=False, **options))
        return Moving(path), Moving(tmp_path / "out" / "model.gltf"), tmp_path / "out"

    return build


@pytest.mark.parametrize("targets", [True, False])
def test_every_clip_moves_the_bake_as_the_file(baked: Baked, targets: bool) -> None:
    source, asset, folder = baked(targets=targets)
    assert asset.document["extensions"]["FUR_ptm_shells"]["version"] == "2.1"
    still = {0: {"weights": (0.0, 0.0)}}
    there, here = (each.posed(0, pose=still)["POSITION"] for each in (source, asset))
    away = np.linalg.norm(there[:, None] - here[None], axis=2)
    assert away.min(axis=1).max() < 1e-4
    which = away.argmin(axis=1)
    assert [each["name"] for each in asset.document["animations"]] == ["bend", "sway", "shapes"][: 2 + targets]
    for clip in range(2 + targets):
        for share in (0.0, 0.2, 0.45, 0.8, 1.0):
            seconds = share * source.seconds(clip)
            one, two = (still | each.clip(clip, seconds) for each in (source, asset))
            right, found = source.posed(0, pose=one)["POSITION"], asset.posed(0, pose=two)["POSITION"]
            assert np.abs(right - found[which]).max() < 1e-4 * 4.6 + 1.5 / 255  # weights are bytes
            shells = asset.posed(1, pose=two, skin=0)["POSITION"]
            assert np.linalg.norm(shells[:, None] - found[None], axis=2).min(axis=1).max() < 1e-5
            joints = [each.document["skins"][0]["joints"] for each in (source, asset)]
            for a, b in zip(*joints, strict=True):
                np.testing.assert_allclose(source.worlds(one)[a], asset.worlds(two)[b], atol=1e-5)
    assert validate(folder) == []
    assert errors(folder) == []


def test_the_record_counts_what_moves(baked: Baked) -> None:
    *_, folder = baked()
    text = (folder / "bake.json").read_text()
    assert '"joints": 3' in text
    assert '"clips": 3' in text
    assert '"targets": 2' in text


@pytest.mark.parametrize("pose", ["bend@0.5", "shapes@0.5"])
def test_fur_laid_in_a_pose_is_stored_in_the_bind_pose(baked: Baked, pose: str) -> None:
    source, asset, folder = baked(pose=pose)
    clip = 0 if pose.startswith("bend") else 2
    still = {0: {"weights": (0.0, 0.0)}}
    one, two = (still | each.clip(clip, 0.5) for each in (source, asset))
    for here, there, near in ((still, still, 1.5 / 255), (one, two, 1e-4 * 4.6)):
        right, found = source.posed(0, pose=here)["POSITION"], asset.posed(0, pose=there)["POSITION"]
        assert np.linalg.norm(right[:, None] - found[None], axis=2).min(axis=1).max() < near
    assert validate(folder) == []
