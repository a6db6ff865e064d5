"""The file of `--rig`: joints and clips as JSON, and a sentence for each mistake in it."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from furbake.surface.files import read_records
from furbake.surface.rig.rig import Floats
from furbake.surface.skeleton.skeleton import Joint, Motion, Skeleton, Track
from furbake.surface.soup import MeshError

JOINT_KEYS = ("name", "parent", "at", "to", "forward", "skin")
CLIP_KEYS = ("name", "tracks")
TRACK_KEYS = ("joint", "path", "times", "values", "interpolation")

PATHS = ("rotation", "translation", "scale")
INTERPOLATIONS = ("LINEAR", "STEP", "CUBICSPLINE")

MAX_JOINTS, MAX_CLIPS, MAX_KEYS = 256, 64, 10_000
"""Joints and clips of a file, and keys of a track. 256 joints are numbered by a byte."""

LARGEST = 1e30
"""Numbers up to this are held by a 32-bit float."""

WHOLE = 'expected {"joints": [...], "clips": [...]}'


def read_skeleton(path: Path) -> Skeleton:
    """The skeleton in a JSON file. Raises MeshError with one sentence that begins with its name."""
    found = read_records(path, "joints", WHOLE)
    _known(found, ("joints", "clips"), str(path))
    if not found["joints"]:
        raise MeshError(f"{path}: no joints, expected 1 to {MAX_JOINTS}")
    if len(found["joints"]) > MAX_JOINTS:
        raise MeshError(f"{path}: {len(found['joints'])} joints, expected at most {MAX_JOINTS}")
    records = [_object(record, f"{path}: joints[{i}]") for i, record in enumerate(found["joints"])]
    joints = _joints(records, str(path))
    if not any(joint.skin for joint in joints):
        raise MeshError(f"{path}: no joint moves the skin, expected one without skin: false")
    return Skeleton(joints, _clips(found.get("clips", []), joints, str(path)))


def _joints(records: Sequence[dict[str, Any]], path: str) -> tuple[Joint, ...]:
    """The joints, parents first and else in the order of the file."""
    names: dict[str, int] = {}
    for i, record in enumerate(records):
        where = f"{path}: joints[{i}]"
        _known(record, JOINT_KEYS, where)
        name = _name(record, where)
        if name in names:
            raise MeshError(f"{where}.name is {_shown(name)}, which joints[{names[name]}] has, expected another")
        names[name] = i
    parents = [_parent(record, names, f"{path}: joints[{i}]") for i, record in enumerate(records)]
    place: dict[int, int] = {-1: -1}
    while len(place) <= len(records):
        ready = [i for i, parent in enumerate(parents) if i not in place and parent in place]
        if not ready:
            lost = next(i for i in range(len(records)) if i not in place)
            raise MeshError(f"{path}: joints[{lost}] is its own parent in the end, expected parents without a circle")
        for i in ready:
            place[i] = len(place) - 1
    order = sorted(range(len(records)), key=place.__getitem__)
    return tuple(_joint(records[i], place[parents[i]], f"{path}: joints[{i}]") for i in order)


def _parent(record: dict[str, Any], names: dict[str, int], where: str) -> int:
    """Index of a joint's parent in the file; -1: none."""
    parent = record.get("parent")
    if parent is None:
        return -1
    if not isinstance(parent, str) or parent not in names:
        raise MeshError(f"{where}.parent is {_shown(parent)}, expected the name of a joint")
    return names[parent]


def _joint(record: dict[str, Any], parent: int, where: str) -> Joint:
    if "at" not in record:
        raise MeshError(f"{where} has no at, expected three numbers")
    points = {key: _numbers(record[key], 3, f"{where}.{key}") for key in ("at", "to", "forward") if key in record}
    if "forward" in points and not np.linalg.norm(points["forward"]) > 0.0:
        raise MeshError(f"{where}.forward is {_shown(record['forward'])}, expected a direction of three numbers")
    skin = record.get("skin", True)
    if not isinstance(skin, bool):
        raise MeshError(f"{where}.skin is {_shown(skin)}, expected true or false")
    return Joint(record["name"], parent, points["at"], points.get("to"), points.get("forward"), skin)


def _clips(records: Any, joints: Sequence[Joint], path: str) -> tuple[Motion, ...]:
    if not isinstance(records, list):
        raise MeshError(f"{path}: clips is {_shown(records)}, expected a list")
    if len(records) > MAX_CLIPS:
        raise MeshError(f"{path}: {len(records)} clips, expected at most {MAX_CLIPS}")
    index = {joint.name: i for i, joint in enumerate(joints)}
    found: dict[str, Motion] = {}
    for i, record in enumerate(records):
        where = f"{path}: clips[{i}]"
        _known(_object(record, where), CLIP_KEYS, where)
        name, tracks = _name(record, where), record.get("tracks")
        if name in found:
            raise MeshError(f"{where}.name is {_shown(name)}, which another clip has, expected another")
        if not isinstance(tracks, list) or not tracks:
            raise MeshError(f"{where} has no tracks, expected a list of at least one")
        made = [_track(track, index, f"{where}.tracks[{k}]") for k, track in enumerate(tracks)]
        aims = [(track.joint, track.path) for track in made]
        for k, aim in enumerate(aims):
            if aim in aims[:k]:
                raise MeshError(f"{where}.tracks[{k}] is the second {aim[1]} of {joints[aim[0]].name}, expected one")
        found[name] = Motion(name, tuple(made))
    return tuple(found.values())


def _track(record: Any, index: dict[str, int], where: str) -> Track:
    _known(_object(record, where), TRACK_KEYS, where)
    joint, path, kind = record.get("joint"), record.get("path"), record.get("interpolation", "LINEAR")
    if not isinstance(joint, str) or joint not in index:
        raise MeshError(f"{where}.joint is {_shown(joint)}, expected the name of a joint")
    if path not in PATHS:
        raise MeshError(f"{where}.path is {_shown(path)}, expected one of {', '.join(PATHS)}")
    if kind not in INTERPOLATIONS:
        raise MeshError(f"{where}.interpolation is {_shown(kind)}, expected one of {', '.join(INTERPOLATIONS)}")
    times, values = record.get("times"), record.get("values")
    if not isinstance(times, list) or not 1 <= len(times) <= MAX_KEYS:
        raise MeshError(f"{where}.times is {_shown(times)}, expected a list of 1 to {MAX_KEYS} seconds")
    seconds = _numbers(times, len(times), f"{where}.times")
    if seconds[0] < 0.0 or (np.diff(seconds) <= 0.0).any():
        raise MeshError(f"{where}.times is {_shown(times)}, expected rising seconds from 0")
    if not isinstance(values, list) or len(values) != len(times):
        number = len(values) if isinstance(values, list) else "no"
        raise MeshError(f"{where} has {number} values at {len(times)} times, expected as many")
    keys = [_key(value, path, f"{where}.values[{i}]") for i, value in enumerate(values)]
    return Track(index[joint], path, seconds, _nearest(np.array(keys)) if path == "rotation" else np.array(keys), kind)


def _key(value: Any, path: str, where: str) -> Floats:
    """A key: three numbers, of a rotation a unit quaternion from that or from degrees about x, y and z."""
    if path != "rotation" or not (isinstance(value, list) and len(value) == 4):
        numbers = _numbers(value, 3, where, " or a quaternion of four" if path == "rotation" else "")
        # About x first, then y, then z, seen in axes that turn along: y turns the head, x nods it.
        return Rotation.from_euler("YXZ", numbers[[1, 0, 2]], degrees=True).as_quat() if path == "rotation" else numbers
    turn = _numbers(value, 4, where)
    if not np.linalg.norm(turn) > 0.0:
        raise MeshError(f"{where} is {_shown(value)}, expected a quaternion that is not 0")
    return turn / np.linalg.norm(turn)


def _nearest(turns: Floats) -> Floats:
    """The same rotations, each by that of its two quaternions that is nearer to the one before."""
    for i in range(1, len(turns)):
        turns[i] *= 1.0 if turns[i] @ turns[i - 1] >= 0.0 else -1.0
    return turns


def _object(record: Any, where: str) -> dict[str, Any]:
    if not isinstance(record, dict):
        raise MeshError(f"{where} is {_shown(record)}, expected an object")
    return record


def _known(record: dict[str, Any], keys: Sequence[str], where: str) -> None:
    strange = [key for key in record if key not in keys]
    if strange:
        raise MeshError(f"{where}: {_shown(strange[0])} is unknown, expected only {', '.join(keys)}")


def _name(record: dict[str, Any], where: str) -> str:
    name = record.get("name")
    if not isinstance(name, str) or not name:
        raise MeshError(f"{where}.name is {_shown(name)}, expected text")
    return name


def _numbers(values: Any, count: int, where: str, more: str = "") -> Floats:
    words = {3: "three numbers", 4: "four numbers"}.get(count, "numbers")
    good = isinstance(values, list) and len(values) == count
    if not good or not all(type(value) in (int, float) and abs(value) < LARGEST for value in values):
        raise MeshError(f"{where} is {_shown(values)}, expected {words}{more}")
    return np.array(values, dtype=np.float64)


def _shown(value: Any) -> str:
    """A value in a message: JSON, but not all of a long one."""
    text = json.dumps(value)
    return text if len(text) <= 40 else f"{text[:37]}..."
