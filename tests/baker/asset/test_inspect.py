from __future__ import annotations

from pathlib import Path

from furbake.asset.inspect import summary
from furbake.asset.read import read_asset


def test_summary(good: Path) -> None:
    found = summary(read_asset(good))
    assert found["fur"]["layers"] == 4
    assert found["skin"] == {"vertices": 2562, "faces": 5120, "attributes": ["POSITION", "NORMAL"]}
    assert found["fur"]["direction plane"] is False
    assert found["fur"]["texture bytes"] == 4 * 3 * (4 * 64 + 8 * 8)
    assert found["fins"]["attributes"] == ["POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "_EDGE"]
    assert 2 * 5120 < found["fins"]["faces"] < 2 * 7680
    assert found["files"]["model.bin"] == (good / "model.bin").stat().st_size
