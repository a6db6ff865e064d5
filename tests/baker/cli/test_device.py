"""`furbake bake --device`."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import furbake.device
import furbake.pelt.light.card
from furbake.cli import main
from furbake.cluster import work
from furbake.cluster.versions import versions
from furbake.device import VARIABLE, card_arrays, device, on_device
from furbake.options import BakeOptions
from furbake.tile.kept import pelt_key
from helpers.command import TINY


@pytest.fixture(autouse=True)
def _anew() -> None:
    card_arrays.cache_clear()


def said(capsys: pytest.CaptureFixture[str], tmp_path: Path, *options: str) -> str:
    assert main(["bake", "sphere", "-o", str(tmp_path / "ball"), "--quiet", *options]) == 2
    assert not (tmp_path / "ball").exists()
    return capsys.readouterr().err.strip()


def test_a_device_that_there_is_not_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert said(capsys, tmp_path, "--device", "tpu") == "furbake: error: device: got 'tpu', expected cpu or cuda"
    monkeypatch.setenv(VARIABLE, "gpu")
    assert said(capsys, tmp_path) == "furbake: error: device: got 'gpu', expected cpu or cuda"


def test_a_card_without_cupy_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "cupy", None)
    text = "furbake: error: device: got cuda without CuPy, expected pip install 'furbake[cuda]'"
    assert said(capsys, tmp_path, "--device", "cuda") == text


def test_cupy_without_a_card_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def zeros(*shape: Any) -> Any:
        raise RuntimeError("cudaErrorNoDevice: no CUDA-capable device is detected\nmore")

    monkeypatch.setitem(sys.modules, "cupy", SimpleNamespace(zeros=zeros, fft=SimpleNamespace(rfft2=abs)))
    assert said(capsys, tmp_path, "--device", "cuda") == (
        "furbake: error: device: got cuda (cudaErrorNoDevice: no CUDA-capable device is detected), "
        "expected an NVIDIA card and its driver"
    )


def test_a_bake_with_a_card(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """NumPy stands in for CuPy."""
    for module in (furbake.device, furbake.pelt.light.card):
        monkeypatch.setattr(module, "card_arrays", lambda: np)
    found = {}
    for name in ("cpu", "cuda"):
        folder = tmp_path / name
        assert main(["bake", "sphere", "-o", str(folder), "--quiet", *TINY, "--device", name]) == 0
        assert main(["validate", str(folder)]) == 0
        found[name] = json.loads((folder / "bake.json").read_text("utf-8"))
    assert "device" not in found["cpu"]
    assert found["cuda"]["device"] == "cuda"
    assert found["cuda"]["key"] == found["cpu"]["key"], "neither is stale"
    assert found["cuda"]["fit"]["psnr"] == pytest.approx(found["cpu"]["fit"]["psnr"], abs=0.01)


def test_pelts_of_card_and_processor_are_kept_apart() -> None:
    keys = set()
    for name in ("cpu", "cuda"):
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv(VARIABLE, name)
            keys.add(pelt_key(BakeOptions(), 0.5))
    assert len(keys) == 2


def test_workers_use_the_device_of_the_bake(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever their own environment says."""
    seen = []

    def apart(environment: dict[str, str]) -> SimpleNamespace:
        seen.append(environment[VARIABLE])
        return SimpleNamespace(call=lambda *given: [], end=lambda: None)

    monkeypatch.setattr(work, "_worker", lambda: ("a worker", {VARIABLE: "cuda"}))
    monkeypatch.setattr(work, "Apart", apart)
    for name in ("cpu", "cuda"):
        assert work.lit_there(BakeOptions(), 0.5, 0, range(2), versions(), name) == []
        work.let_go()
    assert seen == ["cpu", "cuda"]


def test_the_environment_is_as_before(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(VARIABLE, raising=False)
    with on_device("cpu"):
        assert device() == "cpu"
    monkeypatch.setenv(VARIABLE, "cpu")
    with on_device(None), on_device("cpu"):
        pass
    assert device() == "cpu"
