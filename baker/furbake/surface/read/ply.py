"""PLY files whose faces trimesh does not take: strips of triangles, and polygons of different sizes.

They are written anew with triangles, all else kept as it is.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from furbake.surface.soup import Ints

TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2",
    "int": "i4", "uint": "u4", "float": "f4", "double": "f8",
    "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2",
    "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8",
}  # fmt: skip
"""Names of PLY's types, old and new."""

CORNERS = ("vertex_indices", "vertex_index")

VERTEX, FACE, STRIPS = "vertex", "face", "tristrips"

RESTART = -1
"""Index that ends a strip within a list."""


@dataclass
class _Element:
    """A table of a PLY file: name, rows, properties (name, type, and of a list the type of its length, else "")."""

    name: str
    rows: int
    properties: list[tuple[str, str, str]] = field(default_factory=list)

    @property
    def flat(self) -> bool:
        return not any(length for _, _, length in self.properties)

    def kind(self, order: str) -> np.dtype[np.void]:
        """Type of a row without lists, in this order of bytes."""
        return np.dtype([(name, order + code) for name, code, _ in self.properties])


_Read = tuple[_Element, NDArray[np.void], Ints]
"""Vertices, their table, (F, 3) triangles."""


def has_strips(data: bytes) -> bool:
    """True if a file holds strips, which trimesh passes over."""
    return re.search(rb"^element\s+tristrips\s", data.partition(b"end_header")[0], re.MULTILINE) is not None


def triangulated(data: bytes) -> bytes:
    """A file with triangles in the place of strips and polygons.

    A face's own colours and coordinates are dropped. Raises ValueError, KeyError or IndexError for a broken file.
    """
    head, end, body = data.partition(b"end_header")
    if not end:
        raise ValueError("a header without end")
    lines = head.decode("utf-8", "replace").splitlines()
    elements, body = _elements(lines), body[body.find(b"\n") + 1 :]
    if "ascii" in lines[1]:
        vertex, table, faces = _of_text(elements, body)
    else:
        vertex, table, faces = _of_bytes(elements, body, ">" if "big" in lines[1] else "<")
    return _written(lines, vertex, table, faces)


def _elements(lines: list[str]) -> list[_Element]:
    found: list[_Element] = []
    for words in (line.split() for line in lines):
        if words[:1] == ["element"] and len(words) == 3:
            found.append(_Element(words[1], int(words[2])))
            if found[-1].rows < 0:
                raise ValueError(f"{words[2]} rows of {words[1]}")
        elif words[:1] == ["property"] and found:
            if words[1:2] == ["list"] and len(words) == 5:
                found[-1].properties.append((words[4], TYPES[words[3]], TYPES[words[2]]))
            elif len(words) == 3:
                found[-1].properties.append((words[2], TYPES[words[1]], ""))
    return found


def _of_text(elements: list[_Element], body: bytes) -> _Read:
    """Vertices and triangles of an ASCII file."""
    lines, at = body.decode("utf-8", "replace").splitlines(), 0
    vertex, table, faces = None, np.zeros(0, dtype=np.void), []
    for element in elements:
        rows = lines[at : at + element.rows]
        at += element.rows
        if len(rows) < element.rows:
            raise ValueError(f"{len(rows)} of {element.rows} lines of {element.name}")
        if element.name == VERTEX and element.flat:
            vertex, table = element, np.array([tuple(row.split()) for row in rows], dtype=element.kind("<"))
        elif element.name in (FACE, STRIPS):
            faces += [_cut(element.name, _corners_of_text(element, row.split())) for row in rows]
    return _checked(vertex, table, faces)


def _corners_of_text(element: _Element, words: list[str]) -> Ints:
    at = 0
    for name, _, length in element.properties:
        count = int(words[at]) if length else 1
        at += 1 if length else 0
        if count < 0 or at + count > len(words):
            raise ValueError(f"a list of {count} in {len(words)} words")
        if length and name in CORNERS:
            return np.array(words[at : at + count], dtype=np.int64)
        at += count
    raise ValueError(f"{element.name} without {CORNERS[0]}")


def _of_bytes(elements: list[_Element], body: bytes, order: str) -> _Read:
    """Vertices and triangles of a binary file."""
    vertex, table, faces, at = None, np.zeros(0, dtype=np.void), [], 0
    for element in elements:
        if element.flat:
            kind = element.kind(order)
            size = element.rows * kind.itemsize
            if at + size > len(body):
                raise ValueError(f"{len(body) - at} bytes of {element.name}, {size} announced")
            if element.name == VERTEX:
                vertex, table = element, np.frombuffer(body, kind, element.rows, at)
            at += size
            continue
        for _ in range(element.rows):
            corners, at = _corners_of_bytes(element, body, at, order)
            if element.name in (FACE, STRIPS):
                faces.append(_cut(element.name, corners))
    return _checked(vertex, table, faces)


def _checked(vertex: _Element | None, table: NDArray[np.void], faces: list[Ints]) -> _Read:
    if vertex is None:
        raise ValueError("no vertices")
    return vertex, table, np.concatenate([*faces, np.zeros((0, 3), np.int64)])


def _corners_of_bytes(element: _Element, body: bytes, at: int, order: str) -> tuple[Ints, int]:
    """Corners of the row that begins at a byte, and where the next row does."""
    corners = np.zeros(0, dtype=np.int64)
    for name, code, length in element.properties:
        count = 1
        if length:
            count = int(np.frombuffer(body, order + length, 1, at)[0])
            at += int(length[1])
        size = int(code[1]) * count
        if count < 0 or at + size > len(body):
            raise ValueError(f"a list of {count} in {len(body) - at} bytes")
        if length and name in CORNERS:
            corners = np.frombuffer(body, order + code, count, at).astype(np.int64)
        at += size
    return corners, at


def _cut(name: str, corners: Ints) -> Ints:
    """(n, 3) triangles of a polygon, as a fan, or of strips that -1 ends; every second one of a strip is turned."""
    if name == FACE:
        first = np.full(max(len(corners) - 2, 0), corners[0] if len(corners) else 0)
        return np.stack([first, corners[1:-1], corners[2:]], axis=1) if len(first) else np.zeros((0, 3), np.int64)
    place = np.arange(len(corners))
    start = np.maximum.accumulate(np.where(corners == RESTART, place + 1, 0))
    three = np.stack([corners[:-2], corners[1:-1], corners[2:]], axis=1)
    odd = ((place - start)[:-2] % 2 == 1)[:, None]
    three = np.where(odd, three[:, [1, 0, 2]], three)
    a, b, c = three.T
    whole: Ints = three[(three != RESTART).all(axis=1) & (a != b) & (b != c) & (c != a)]
    return whole


def _written(lines: list[str], vertex: _Element, table: NDArray[np.void], faces: Ints) -> bytes:
    """A binary PLY file with the vertices as they are, their comments and these triangles."""
    codes = {code: name for name, code in reversed(TYPES.items())}
    header = ["ply", "format binary_little_endian 1.0"]
    header += [line for line in lines if line.startswith("comment")]
    header += [f"element {VERTEX} {len(table)}"]
    header += [f"property {codes[code]} {name}" for name, code, _ in vertex.properties]
    header += [f"element {FACE} {len(faces)}", f"property list uchar int {CORNERS[0]}", "end_header", ""]
    rows = np.zeros(len(faces), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    rows["count"], rows["corners"] = 3, faces
    return "\n".join(header).encode() + table.astype(vertex.kind("<")).tobytes() + rows.tobytes()
