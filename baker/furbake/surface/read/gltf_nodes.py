"""The hierarchy of a glTF file's scene."""

from __future__ import annotations

from typing import Any

import numpy as np

from furbake.surface.read.gltf_data import GltfData, Record
from furbake.surface.soup import Floats


def places(data: GltfData) -> tuple[dict[int, Floats], dict[int, int]]:
    """(4, 4) matrix of every node of the scene, and the node above each, -1 above the roots. The first by
    rising number, the second in the order of a walk through the scene.

    Raises ValueError where a node is below itself or below two others.
    """
    nodes = data.list_of("nodes")
    scenes = data.list_of("scenes")
    if scenes:
        roots = list(data.item("scenes", data.json.get("scene", 0)).get("nodes", []))
    else:
        below = {child for node in nodes for child in node.get("children", [])}
        roots = [index for index in range(len(nodes)) if index not in below]
    found: dict[int, Floats] = {}
    parents: dict[int, int] = {}
    todo = [(root, np.eye(4), -1) for root in roots]
    while todo:
        index, above, parent = todo.pop()
        node = data.item("nodes", index)
        if index in found:
            raise ValueError(f"node {index} is in the scene twice")
        found[index], parents[index] = above @ matrix(node), parent
        todo += [(child, found[index], index) for child in node.get("children", [])]
    return dict(sorted(found.items())), parents


def text(name: Any, otherwise: str = "") -> str:
    """A name as it may be written again: what is none is the other one, halves of characters are question marks."""
    return otherwise if name is None else str(name).encode("utf-8", "replace").decode()


def matrix(node: Record) -> Floats:
    """(4, 4) matrix of a node in the one above it."""
    if "matrix" in node:
        return np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
    x, y, z, w = np.array(node.get("rotation", (0, 0, 0, 1)), dtype=np.float64)
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    matrix = np.eye(4)
    matrix[:3, :3] = turn * np.array(node.get("scale", (1, 1, 1)), dtype=np.float64).reshape(3)
    matrix[:3, 3] = np.array(node.get("translation", (0, 0, 0)), dtype=np.float64).reshape(3)
    return matrix
