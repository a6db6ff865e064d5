"""Values of lists, tuples, tables and data classes as arrays by name: no code is run to read them."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Arrays = dict[str, NDArray[Any]]

TREE = "tree"
"""Name of the array that holds all but the arrays, as JSON."""


def packed(value: Any) -> Arrays:
    """A value as arrays: of None, numbers, text, arrays, and lists, tuples, tables by text and data classes of these.

    Raises TypeError for anything else.
    """
    arrays: Arrays = {}

    def plain(part: Any) -> Any:
        if part is None or isinstance(part, (bool, int, float, str)):
            return part
        if isinstance(part, np.ndarray):
            name = f"array{len(arrays)}"
            arrays[name] = part
            return {"array": name}
        if isinstance(part, (list, tuple)):
            return {type(part).__name__: [plain(item) for item in part]}
        if isinstance(part, dict):
            return {"dict": {str(name): plain(item) for name, item in part.items()}}
        if is_dataclass(part):
            values = {field.name: plain(getattr(part, field.name)) for field in fields(part)}
            return {"class": type(part).__name__, "fields": values}
        raise TypeError(f"got {type(part).__name__}, expected plain data, arrays and data classes")

    tree = json.dumps(plain(value))
    return {TREE: np.frombuffer(tree.encode(), np.uint8), **arrays}


def unpacked(arrays: Mapping[str, NDArray[Any]], classes: Sequence[type]) -> Any:
    """The reverse of `packed`, for values of these data classes. Raises ValueError, TypeError or LookupError."""
    known = {found.__name__: found for found in classes}

    def whole(part: Any) -> Any:
        if not isinstance(part, dict):
            return part
        if "array" in part:
            return arrays[part["array"]]
        if "list" in part:
            return [whole(item) for item in part["list"]]
        if "tuple" in part:
            return tuple(whole(item) for item in part["tuple"])
        if "dict" in part:
            return {name: whole(item) for name, item in part["dict"].items()}
        return known[part["class"]](**{name: whole(item) for name, item in part["fields"].items()})

    return whole(json.loads(arrays[TREE].tobytes().decode()))
