"""A baked folder is read from regular files of a bounded size."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from furbake.asset.read import AssetError, read_asset

PIPED = '{"buffers": [{"uri": "pipe"}]}'


@pytest.mark.parametrize(("name", "text"), [("model.gltf", None), ("pipe", PIPED)])
def test_pipes_are_not_waited_for(tmp_path: Path, name: str, text: str | None) -> None:
    if text is not None:
        (tmp_path / "model.gltf").write_text(text)
    os.mkfifo(tmp_path / name)
    with pytest.raises(AssetError, match=rf"^{name}: is no regular file, expected"):
        read_asset(tmp_path)


def test_size_of_a_file_is_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "model.gltf").write_text("{" + " " * 100 + "}")
    monkeypatch.setenv("FURBAKE_LIMITS", "bytes=99")
    with pytest.raises(AssetError, match=r"model\.gltf: .*more than 99 bytes to read"):
        read_asset(tmp_path)
