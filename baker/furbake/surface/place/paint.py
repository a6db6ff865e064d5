"""Numbers painted on a model: in a picture over its texture coordinates, in its vertex colours or its attributes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from furbake.surface.charts import Natural
from furbake.surface.colours import luminance, sample_picture
from furbake.surface.mesh import Floats, Ints, MeshError, Surface

CHANNELS = ("red", "green", "blue", "alpha")
"""Channels of the vertex colours."""

COLOUR = "color"
"""Attribute that holds the vertex colours as they are in the file, 0..1."""

FUR = ("length", "density", "mask")
"""Attributes for the fur that a file may have, each 0..1, as _LENGTH in glTF."""

BARE = 0.5 / 255.0
"""A mask that a byte cannot tell from black."""


def vertex_map(surface: Surface, pixels: NDArray[Any], name: str) -> Floats:
    """(V,) 0..1 value of a picture at each vertex: black 0, white 1, as painted (no sRGB curve).

    pixels : (height, width) or (height, width, 1 to 4) bytes, first row on top; colours count by their luminance,
        transparent parts as white. The picture repeats beyond 0..1. Faces without texture coordinates count as white.
    name : of the picture's file, for the message

    Raises MeshError where the model has no texture coordinates or the pixels are none.
    """
    try:
        grey = luminance(pixels)
    except ValueError as error:
        raise MeshError(f"{name}: {error}") from error
    uv = surface.uv
    if uv is None and surface.natural is not None:
        uv = surface.natural.uv[surface.natural.faces]
    if uv is None:
        raise MeshError(f"{name}: the model has no texture coordinates, expected some to lay the picture on")
    finite = np.isfinite(uv).all(axis=2).reshape(-1)
    corners = surface.faces.reshape(-1)[finite]
    seen = sample_picture(grey[..., None], uv.reshape(-1, 2)[finite])[:, 0]
    uses = np.bincount(corners, minlength=len(surface.vertices))
    total = np.bincount(corners, seen, len(surface.vertices))
    return np.where(uses > 0, total / np.maximum(uses, 1), 1.0)


def vertex_numbers(surface: Surface, which: str, name: str) -> Floats:
    """(V,) 0..1 a channel of the vertex colours (red, green, blue, alpha), or an attribute of one number by its name.

    name : of the model or of the option that asked, for the message. Raises MeshError where the model has none such.
    """
    colour = surface.attributes.get(COLOUR)
    scalars = sorted(key for key, values in surface.attributes.items() if values.shape[1] == 1)
    channels = [] if colour is None else list(CHANNELS[: colour.shape[1]])
    if colour is not None and which in channels:
        values = colour[:, channels.index(which)]
    elif which in scalars:
        values = surface.attributes[which][:, 0]
    else:
        have = ", ".join([*channels, *scalars])
        raise MeshError(f"{name}: got '{which}', expected {have or 'a model with vertex colours or attributes'}")
    return np.clip(values, 0.0, 1.0)


def brought(surface: Surface) -> dict[str, Floats]:
    """(V,) 0..1 attributes of `FUR` that a file has."""
    found = {name: surface.attributes.get(name, surface.attributes.get(f"fur_{name}")) for name in FUR}
    return {
        name: np.clip(values[:, 0], 0.0, 1.0)
        for name, values in found.items()
        if values is not None and values.shape[1] == 1
    }


def uncover(surface: Surface, mask: Floats, name: str) -> tuple[Surface, Ints]:
    """The part of a surface that carries fur, for shells and fins to stand on, and (V',) which vertices it keeps.

    Faces that are bare at all three corners go; normals stay as they were.

    mask : (V,) 0..1; name : of its picture, for the message. Raises MeshError where nothing is left.
    """
    keep = np.asarray((mask[surface.faces] > BARE).any(axis=1))
    if not keep.any():
        raise MeshError(f"{name}: every face is bare, expected some fur (white)")
    used, index = np.unique(surface.faces[keep], return_inverse=True)
    covered = replace(
        surface,
        vertices=surface.vertices[used],
        faces=index.reshape(-1, 3),
        normals=surface.normals[used],
        natural=None if surface.natural is None else _part(surface.natural, keep, used),
        colours=None if surface.colours is None else surface.colours[used],
        uv=None if surface.uv is None else surface.uv[keep],
        attributes={key: values[used] for key, values in surface.attributes.items()},
        skin=(),
    )
    return covered, used


def _part(natural: Natural, keep: NDArray[np.bool_], used: Ints) -> Natural:
    """These faces of a shape's own coordinates, above the vertices in `used` (ascending)."""
    copies, index = np.unique(natural.faces[keep], return_inverse=True)
    return replace(
        natural,
        source=np.searchsorted(used, natural.source[copies]),
        faces=index.reshape(-1, 3),
        tangents=natural.tangents[copies],
        uv=natural.uv[copies],
    )
