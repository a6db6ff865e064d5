from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from furbake.asset.inspect import summary
from furbake.asset.read import AssetError, read_asset


def test_summary(good: Path) -> None:
    found = summary(read_asset(good))
    assert found["fur"]["layers"] == 4
    assert found["skin"] == {"vertices": 2562, "faces": 5120, "attributes": ["POSITION", "NORMAL"]}
    assert found["fur"]["direction plane"] is False
    assert found["fur"]["texture bytes"] == 4 * 3 * (4 * 64 + 8 * 8)
    assert found["fins"]["attributes"] == ["POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "_FUR", "_EDGE"]
    assert 2 * 5120 < found["fins"]["faces"] < 2 * 7680
    assert found["files"]["model.bin"] == (good / "model.bin").stat().st_size


def test_a_malformed_bake_is_told_in_plain_words(good: Path, tmp_path: Path) -> None:
    folder = Path(shutil.copytree(good, tmp_path / "a"))
    (folder / "bake.json").write_text('{"states": [3]}')
    with pytest.raises(AssetError) as error:
        summary(read_asset(folder))
    assert str(error.value) == f"{folder}: malformed, expected a bake that furbake validate finds valid"
