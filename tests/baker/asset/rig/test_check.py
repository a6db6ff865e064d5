"""A character is valid; every way to spoil what moves it has one problem, in a sentence."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake.asset.inspect import summary
from furbake.asset.read import read_asset
from furbake.asset.validate import validate
from furbake.surface.rig.rig import Rig
from helpers.arms import arm
from helpers.moving import Moving

Edit = Callable[[dict[str, Any]], Any]


@pytest.fixture
def spoilt(character: Callable[..., Moving], tmp_path: Path) -> Callable[[Edit], list[str]]:
    """Problems of a character whose document has been changed."""

    def change(edit: Edit) -> list[str]:
        document = character(*arm()).document
        edit(document)
        (tmp_path / "model.gltf").write_text(json.dumps(document))
        return validate(tmp_path)

    return change


def part(document: dict[str, Any], mesh: int) -> Any:
    return document["meshes"][mesh]["primitives"][0]


def accessor(document: dict[str, Any], mesh: int, name: str) -> Any:
    return document["accessors"][part(document, mesh)["attributes"][name]]


def sampler(document: dict[str, Any]) -> Any:
    return document["animations"][0]["samplers"][0]


def target(document: dict[str, Any]) -> Any:
    return document["animations"][0]["channels"][0]["target"]


SPOILS: dict[str, tuple[Edit, str]] = {
    "one without skin": (lambda d: d["nodes"][1].pop("skin"), "shells: skin None, expected 0 as of the skin's node"),
    "no such skin": (
        lambda d: [node.update(skin=3) for node in d["nodes"][:3]], "skin: node uses skin 3, expected one of 1"
    ),
    "no such joint": (lambda d: d["skins"][0]["joints"].append(99), "skin: joint 99, expected nodes 0 to 6"),
    "joint elsewhere": (lambda d: d["skins"][0]["joints"].append(1), "skin: joint 1 is in no scene"),
    "too few matrices": (lambda d: d["skins"][0]["joints"].append(3), "skin: 3 inverse bind matrices, expected 4"),
    "no matrices": (lambda d: d["skins"][0].pop("inverseBindMatrices"), "skin: no inverse bind matrices"),
    "joints beyond": (lambda d: d["skins"][0]["joints"].pop(), "shells: joint 2, expected 0 to 1"),
    "no weights": (lambda d: part(d, 2)["attributes"].pop("WEIGHTS_0"), "fins: no WEIGHTS_0, expected joints and"),
    "weights of others": (
        lambda d: part(d, 1)["attributes"].update(WEIGHTS_0=part(d, 1)["attributes"]["JOINTS_0"]),
        r"shells: weights sum to 0\.\d+ at \d+ vertices, expected 1",
    ),
    "fewer targets": (lambda d: part(d, 1)["targets"].pop(), "shells: 1 morph targets, expected 2 as of the skin"),
    "other names": (
        lambda d: d["meshes"][2]["extras"]["targetNames"].reverse(), "fins: targetNames differ from those of the skin"
    ),
    "fewer names": (
        lambda d: [each["extras"]["targetNames"].pop() for each in d["meshes"]], "skin: 1 targetNames, expected 2"
    ),
    "fewer weights": (lambda d: d["meshes"][0]["weights"].pop(), "skin: 1 weights of morph targets, expected 2"),
    "target of another length": (
        lambda d: part(d, 1)["targets"][0].update(POSITION=part(d, 2)["targets"][0]["POSITION"]),
        r"shells: target 0 has \d+ values of POSITION, expected \d+ of three numbers",
    ),
    "target of what is not there": (
        lambda d: part(d, 0)["targets"][0].update(TANGENT=0), "skin: target 0 moves TANGENT, expected only what"
    ),
    "clip of no node": (lambda d: target(d).update(node=77), "animation 'bend': moves node 77, expected one of the"),
    "clip of no target": (lambda d: target(d).pop("node"), "animation 'bend': moves node None, expected one of the"),
    "clip of nothing": (lambda d: target(d).update(path="colour"), "animation 'bend': moves colour of node 6"),
    "weights of a joint": (lambda d: target(d).update(path="weights"), "animation 'bend': moves weights of node 6"),
    "keys and values": (
        lambda d: d["accessors"][sampler(d)["output"]].update(count=2),
        "animation 'bend': 2 values of 4 numbers for rotation at 3 keys, expected 3 of 4",
    ),
    "times that fall": (
        lambda d: sampler(d).update(input=sampler(d)["input"] + 5), "animation 'bend': keys of rotation that are not"
    ),
    "no sampler": (
        lambda d: d["animations"][0]["channels"][0].update(sampler=9), "animation 'bend': sampler 9, expected one of 3"
    ),
    "two parents": (lambda d: d["nodes"][3]["children"].append(6), "node 6 hangs on 2 nodes, expected one at most"),
    "circle": (
        lambda d: (d["nodes"][3]["children"].clear(), d["nodes"][6].update(children=[4])),
        "3 nodes hang on themselves, expected a tree",
    ),
    "no such child": (lambda d: d["nodes"][6].update(children=[44]), "node 44 is a child, expected nodes 0 to 6"),
}  # fmt: skip


@pytest.mark.parametrize("name", SPOILS)
def test_spoilt(spoilt: Callable[[Edit], list[str]], name: str) -> None:
    edit, message = SPOILS[name]
    problems = spoilt(edit)
    assert any(re.search(message, problem) for problem in problems), problems
    assert all(len(problem.splitlines()) == 1 for problem in problems)


@pytest.mark.parametrize("targets", [True, False])
def test_characters_are_valid(character: Callable[..., Moving], tmp_path: Path, targets: bool) -> None:
    surface, rig = arm(targets=targets)
    character(surface, rig)
    assert validate(tmp_path) == []
    many: tuple[Any, Rig] = arm(joints=300, targets=targets)
    character(*many)
    assert validate(tmp_path) == []


def test_a_copy_that_goes_its_own_way_is_found(character: Callable[..., Moving], tmp_path: Path) -> None:
    document = character(*arm()).document
    shells = accessor(document, 1, "JOINTS_0")
    data = bytearray((tmp_path / "model.bin").read_bytes())
    places = Moving(tmp_path / "model.gltf").raw(part(document, 1)["attributes"]["POSITION"])
    _, index, uses = np.unique(places, axis=0, return_inverse=True, return_counts=True)
    vertex = int(np.argmax(uses[index.reshape(-1)] > 1))
    start = document["bufferViews"][shells["bufferView"]]["byteOffset"] + 4 * vertex
    data[start : start + 4] = bytes((data[start] ^ 1, *data[start + 1 : start + 4]))
    (tmp_path / "model.bin").write_bytes(data)
    (problem,) = validate(tmp_path)
    assert re.fullmatch(r"shells: joints or weights of \d+ copies of a vertex differ, .*: a crack opens", problem)


def test_what_moves_is_told(character: Callable[..., Moving], tmp_path: Path) -> None:
    character(*arm())
    asset = read_asset(tmp_path)
    assert summary(asset)["motion"] == {
        "joints": 3,
        "clips": [
            {"name": "bend", "seconds": 1.25, "channels": 3},
            {"name": "sway", "seconds": 1.25, "channels": 1},
            {"name": "shapes", "seconds": 1.25, "channels": 1},
        ],
        "targets": ["bump", "twist"],
    }
    assert asset.record["asset"]["rig"] == {"joints": 3, "clips": 3, "targets": 2}
