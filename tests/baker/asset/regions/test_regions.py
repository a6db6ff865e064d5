"""Several furs on one body, as they are stored; the documentation's example as it stands."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake.asset.read import read_asset
from furbake.asset.validate import validate
from furbake.groom.several import cell_numbers
from furbake.groom.strands import groom
from helpers.command import TINY, files

PAGE = Path(__file__).parents[4] / "web" / "docs" / "regions.md"
FUR = (*TINY, "--set", "coat.guard.count=30", "--set", "coat.under.count=30", "--quiet", "--no-cache")


def bake(run: Callable[..., Any], toml: str, out: str = "out", *options: str) -> Any:
    Path("furs.toml").write_text(toml, "utf-8")
    return run("bake", "torus:12x16", "-o", out, *FUR, "--regions", "furs.toml", *options)


def shares(folder: Path) -> np.ndarray[Any, Any]:
    """Sum of the furs' stored shares at every corner of every face of a patch, in plain loops over the file."""
    asset = read_asset(folder)
    primitive = asset.primitive(asset.fur["shells"])
    values = {name: asset.accessor(index) for name, index in primitive["attributes"].items()}
    sums: dict[tuple[Any, ...], dict[tuple[Any, ...], int]] = {}
    for face in asset.accessor(primitive["indices"]).reshape(-1, 3):
        corners = [(*values["POSITION"][v], *values["TEXCOORD_0"][v]) for v in face]
        of_face = sums.setdefault(tuple(sorted(corners)), {})
        for corner, v in zip(corners, face, strict=True):
            low, high = (int(bound) for bound in values["_REGION"][v][:2])
            of_face[corner] = of_face.get(corner, 0) + high - low
    return np.array([share for face in sums.values() for share in face.values()])


def test_the_page_s_example_bakes_and_its_shares_sum_to_one(
    run: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    done = bake(run, re.search(r"```toml\n(.*?)```", PAGE.read_text("utf-8"), re.DOTALL)[1])
    assert done.status == 0, done.err
    assert validate(Path("out")) == []
    asset = read_asset(Path("out"))
    assert asset.fur["version"] == "2.3"
    assert [fur["name"] for fur in asset.fur["regions"]["furs"]] == ["ruff", "sole"]
    assert (np.abs(shares(Path("out")) / 255 - 1) <= 1 / 255).all()
    listed = json.loads(run("inspect", "out", "--json").out)
    assert set(listed["regions"]) == {"coat", "ruff", "sole"}
    assert 0 < listed["drawn twice"] < listed["shells"]["faces"] / 2
    assert len(asset.record["regions"]) == 2


def test_the_same_hairs_share_their_planes(
    run: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    ball = "near = [[1, 0, 0, 0.7]]\n"
    assert bake(run, f"[same]\n{ball}").status == 0
    assert not [name for name in files(Path("out")) if name.startswith("region")]
    assert bake(run, f"[red]\n{ball}tip = [0.8, 0, 0]", "red").status == 0
    own = sorted(name for name in files(Path("red")) if name.startswith("region"))
    assert own == ["region1-colour.png", "region1-fin-colour.png"]
    assert validate(Path("red")) == []


@pytest.mark.parametrize(
    ("toml", "message"),
    [
        ("[a]\nnear = [[90, 0, 0, 1]]", "regions: a is nowhere on the body, expected"),
        ("[a]\nnear = [[0, 0, 0, 90]]", "regions: coat is nowhere on the body, expected"),
        ('[a]\nmask = "none.png"', "regions: a.mask: none.png: no such file"),
        ('[a]\nmask = "furs.toml"', "regions: a.mask: furs.toml"),
        ('[a]\nmask = "vertex:mane"', "regions: a.mask: vertex:mane: got 'mane', expected"),
        ('[a]\nmaterial = "Mane"', "regions: a.material: got 'Mane', expected a model with materials"),
    ],
)
def test_a_place_that_is_none_gets_one_sentence(
    run: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, toml: str, message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    done = bake(run, toml)
    assert done.status == 2
    assert done.err.startswith(f"furbake: error: {message}")
    assert done.err.count("\n") == 1
    assert not Path("out").exists()


def test_broken_shares_are_found(run: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert bake(run, "[a]\nnear = [[1, 0, 0, 0.7]]", "out", "--no-meshopt").status == 0
    document = json.loads(Path("out/model.gltf").read_text("utf-8"))
    index = document["meshes"][1]["primitives"][0]["attributes"]["_REGION"]
    view = document["bufferViews"][document["accessors"][index]["bufferView"]]
    data = bytearray(Path("out/model.bin").read_bytes())
    data[view["byteOffset"] + 1] -= 9
    Path("out/model.bin").write_bytes(data)
    assert any("shares of the furs sum to 0.965" in problem for problem in validate(Path("out")))


def test_every_hair_of_the_groom_belongs_to_one_fur(
    run: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert bake(run, "[a]\nnear = [[1, 0, 0, 0.9]]\nborder = 0.8", "two").status == 0
    one = run("bake", "torus:12x16", "-o", "one", *FUR)
    assert one.status == 0, one.err
    whole, parted = groom(Path("one")), groom(Path("two"))
    assert len(parted.points) == pytest.approx(len(whole.points), rel=0.01)
    rings = np.linspace(-1.4, 1.4, 8)
    before, after = (np.histogram(each.points[:, 0, 0], rings)[0] for each in (whole, parted))
    assert after == pytest.approx(before, rel=0.08)
    strands = int(whole.hair.max()) + 1
    assert 0.2 < np.mean(parted.hair >= strands) < 0.8


def test_numbers_of_cells_are_even() -> None:
    cells = np.stack(np.meshgrid(np.arange(-40, 60), np.arange(-30, 70)), -1).reshape(-1, 2)
    numbers = cell_numbers(cells)
    for share in (0.1, 0.5, 0.8):
        assert np.mean(numbers < share) == pytest.approx(share, abs=0.015)
    row = numbers.reshape(100, 100)
    assert abs(np.corrcoef(row[:, 1:].ravel(), row[:, :-1].ravel())[0, 1]) < 0.03
