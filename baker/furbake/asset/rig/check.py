"""Checks of what moves a baked body: skin, morph targets, animations; every problem in one sentence."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.asset.read import Asset

Record = dict[str, Any]

PARTS = ("skin", "shells", "fins")

ROUNDING = 2e-3
"""Tolerance of the sum of weights that are floats."""

WIDTHS = {"translation": 3, "rotation": 4, "scale": 3, "weights": 1}
"""Numbers of a key by the path of its channel; weights have one for each target."""


def joints(asset: Asset) -> Iterator[str]:
    """Skin, shells and fins have one skin or none, whose joints exist and move all of their vertices."""
    nodes = {name: asset.document["nodes"][asset.fur[name]] for name in PARTS if name in asset.fur}
    own = nodes["skin"].get("skin")
    for name, node in nodes.items():
        if node.get("skin") != own:
            yield f"{name}: skin {node.get('skin')}, expected {own} as of the skin's node"
    if own is None:
        if any("JOINTS_0" in each["attributes"] for each in asset.primitives(asset.fur["skin"])):
            yield "skin: joints but its node has no skin, expected both or none"
        return
    skins = asset.document.get("skins", [])
    if own >= len(skins):
        yield f"skin: node uses skin {own}, expected one of {len(skins)}"
        return
    yield from _skin(asset, skins[own])
    for name in nodes:
        for primitive in asset.primitives(asset.fur[name]):
            yield from _moved(asset, name, primitive, len(skins[own]["joints"]))


def _skin(asset: Asset, skin: Record) -> Iterator[str]:
    nodes, seen = asset.document["nodes"], drawn(asset)
    outside = [joint for joint in skin["joints"] if not 0 <= joint < len(nodes)]
    absent = [joint for joint in skin["joints"] if joint not in seen and joint not in outside]
    if outside or not skin["joints"]:
        yield f"skin: joint {outside[0] if outside else 'none'}, expected nodes 0 to {len(nodes) - 1}"
    elif absent:
        yield f"skin: joint {absent[0]} is in no scene, expected {len(skin['joints'])} nodes of it"
    if "inverseBindMatrices" not in skin:
        yield f"skin: no inverse bind matrices, expected {len(skin['joints'])}, which undo the quantisation"
        return
    matrices = asset.accessor(skin["inverseBindMatrices"])
    if matrices.shape != (len(skin["joints"]), 16):
        yield f"skin: {len(matrices)} inverse bind matrices, expected {len(skin['joints'])}, one per joint"
    elif not np.isfinite(matrices).all() or (matrices[:, 3::4] != (0.0, 0.0, 0.0, 1.0)).any():
        yield "skin: an inverse bind matrix that is not finite or whose last row is not 0, 0, 0, 1, expected such ones"


def _moved(asset: Asset, name: str, primitive: Record, count: int) -> Iterator[str]:
    """Joints and weights of a primitive; in the shells those of copies of a vertex are equal."""
    attributes = primitive["attributes"]
    missing = [attribute for attribute in ("JOINTS_0", "WEIGHTS_0") if attribute not in attributes]
    if missing:
        yield f"{name}: no {', '.join(missing)}, expected joints and weights as its node has a skin"
        return
    which, weights = asset.accessor(attributes["JOINTS_0"]), asset.accessor(attributes["WEIGHTS_0"])
    if which.shape != weights.shape or which.ndim != 2 or which.shape[1] != 4 or which.dtype.kind != "u":
        yield f"{name}: {which.shape} joints and {weights.shape} weights, expected whole numbers, four and four"
        return
    if which.max() >= count:
        yield f"{name}: joint {which.max()}, expected 0 to {count - 1}"
    whole = float(np.iinfo(weights.dtype).max) if weights.dtype.kind == "u" else 1.0
    sums = weights.sum(axis=1, dtype=np.float64) / whole
    off = ~(np.abs(sums - 1.0) <= (ROUNDING if weights.dtype.kind == "f" else 0.0))
    if off.any():
        yield f"{name}: weights sum to {sums[off][0]:.4f} at {int(off.sum())} vertices, expected 1"
    if name == "shells":
        torn = _torn(asset, attributes, which, weights)
        if torn:
            yield f"shells: joints or weights of {torn} copies of a vertex differ, expected equal ones: a crack opens"


def _torn(asset: Asset, attributes: Record, which: NDArray[Any], weights: NDArray[Any]) -> int:
    """Vertices that coincide with one before them, in place and normal, and follow other joints."""
    places, normals = asset.accessor(attributes["POSITION"]), asset.accessor(attributes["NORMAL"])
    rows = np.column_stack([places.astype(np.float64), normals.astype(np.float64)])
    _, first, index = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    follow = np.column_stack([which.astype(np.float64), weights.astype(np.float64)])
    return int((follow != follow[first[index.reshape(-1)]]).any(axis=1).sum())


def targets(asset: Asset) -> Iterator[str]:
    """Skin, shells and fins have the same morph targets, with their names and weights."""
    meshes = {name: _mesh(asset, name) for name in PARTS if name in asset.fur}
    expected = meshes["skin"]["primitives"][0].get("targets", [])
    names = meshes["skin"].get("extras", {}).get("targetNames")
    good: set[tuple[int, int]] = set()
    for name, mesh in meshes.items():
        for primitive in mesh["primitives"]:
            found = primitive.get("targets", [])
            if len(found) != len(expected):
                yield f"{name}: {len(found)} morph targets, expected {len(expected)} as of the skin"
            for i, target in enumerate(found):
                yield from _target(asset, f"{name}: target {i}", target, primitive["attributes"], good)
        weights = mesh.get("weights", [0.0] * len(expected))
        if len(weights) != len(expected):
            yield f"{name}: {len(weights)} weights of morph targets, expected {len(expected)}"
        told = mesh.get("extras", {}).get("targetNames")
        if told != names:
            yield f"{name}: targetNames differ from those of the skin, expected the same in the same order"
    if names is not None and len(names) != len(expected):
        yield f"skin: {len(names)} targetNames, expected {len(expected)}"


def _target(asset: Asset, name: str, target: Record, attributes: Record, good: set[tuple[int, int]]) -> Iterator[str]:
    """Problems of a target; good : accessors that have none for vertices of such a count."""
    if "POSITION" not in target:
        yield f"{name} has no POSITION, expected displacements"
    accessors = asset.document["accessors"]
    for attribute, index in target.items():
        if attribute not in attributes:
            yield f"{name} moves {attribute}, expected only what the vertices have"
            continue
        got, count = accessors[index], accessors[attributes[attribute]]["count"]
        if (index, count) in good:
            continue
        if (got["count"], got["type"]) != (count, "VEC3"):
            yield f"{name} has {got['count']} values of {attribute}, expected {count} of three numbers"
        elif not np.isfinite(asset.accessor(index)).all():
            yield f"{name}: {attribute} is not finite, expected numbers"
        else:
            good.add((index, count))


def clips(asset: Asset) -> Iterator[str]:
    """Animations move nodes of the scene, by as many numbers as there are keys."""
    seen = drawn(asset)
    shapes = len(_mesh(asset, "skin")["primitives"][0].get("targets", []))
    good: set[tuple[int, int, bool, str]] = set()
    for i, animation in enumerate(asset.document.get("animations", [])):
        name = f"animation {animation.get('name', i)!r:.60}"
        for channel in animation["channels"]:
            node, path = channel["target"].get("node"), channel["target"]["path"]
            if node not in seen:
                yield f"{name}: moves node {node}, expected one of the scene"
            elif path not in WIDTHS or (path == "weights" and (node != asset.fur["skin"] or not shapes)):
                yield f"{name}: moves {path} of node {node}, expected {', '.join(WIDTHS)}, weights of the skin's node"
            elif not 0 <= channel["sampler"] < len(animation["samplers"]):
                yield f"{name}: sampler {channel['sampler']}, expected one of {len(animation['samplers'])}"
            else:
                yield from _sampler(asset, name, animation["samplers"][channel["sampler"]], path, shapes, good)


def _sampler(
    asset: Asset, name: str, sampler: Record, path: str, shapes: int, good: set[tuple[int, int, bool, str]]
) -> Iterator[str]:
    """Problems of a sampler; good : those, by keys, values and use, that have none."""
    cubic = sampler.get("interpolation", "LINEAR") == "CUBICSPLINE"
    key = sampler["input"], sampler["output"], cubic, path
    if key in good:
        return
    times, values = asset.accessor(sampler["input"]), asset.accessor(sampler["output"])
    expected = len(times) * (3 if cubic else 1) * (shapes if path == "weights" else 1)
    width = 1 if values.ndim == 1 else values.shape[1]
    finite = np.isfinite(times).all() and np.isfinite(values).all()
    some = len(values) == expected and width == WIDTHS[path]
    rising = times.ndim == 1 and finite and times[0] >= 0.0 and (np.diff(times) > 0.0).all()
    if not some:
        yield (
            f"{name}: {len(values)} values of {width} numbers for {path} at {len(times)} keys, "
            f"expected {expected} of {WIDTHS[path]}"
        )
    if not rising:
        yield f"{name}: keys of {path} that are not finite or whose times do not rise from 0, expected such ones"
    if some and rising:
        good.add(key)


def tree(asset: Asset) -> Iterator[str]:
    """Every node hangs on one other at most, and none on itself."""
    nodes = asset.document["nodes"]
    children = [child for node in nodes for child in node.get("children", [])]
    outside = [child for child in children if not 0 <= child < len(nodes)]
    if outside:
        yield f"model.gltf: node {outside[0]} is a child, expected nodes 0 to {len(nodes) - 1}"
        return
    uses = np.bincount(np.array(children, dtype=np.int64), minlength=len(nodes))
    if (uses > 1).any():
        yield f"model.gltf: node {int(np.argmax(uses))} hangs on {int(uses.max())} nodes, expected one at most"
    # Peel off leaves: what is left hangs on itself.
    above = {child: index for index, node in enumerate(nodes) for child in node.get("children", [])}
    left = [len(node.get("children", [])) for node in nodes]
    free = [index for index, count in enumerate(left) if not count]
    done = 0
    while free:
        index, done = free.pop(), done + 1
        if index in above:
            left[above[index]] -= 1
            if not left[above[index]]:
                free.append(above[index])
    if done < len(nodes) and not (uses > 1).any():
        yield f"model.gltf: {len(nodes) - done} nodes hang on themselves, expected a tree"


def _mesh(asset: Asset, name: str) -> Record:
    mesh: Record = asset.document["meshes"][asset.document["nodes"][asset.fur[name]]["mesh"]]
    return mesh


def drawn(asset: Asset) -> set[int]:
    """Nodes of the scenes, with all below them."""
    nodes = asset.document["nodes"]
    todo, found = list(chain.from_iterable(scene.get("nodes", []) for scene in asset.document["scenes"])), set[int]()
    while todo:
        node = todo.pop()
        if node not in found:
            found.add(node)
            todo.extend(nodes[node].get("children", []))
    return found
