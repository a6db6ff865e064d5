"""Read and repair a mesh, and attach its materials: the result is a `Surface`, or a `MeshError` of one sentence.

The surface is welded by position: seams of texture or normal would otherwise split patches and grow fins.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from furbake.surface.colours import base_colours, portable
from furbake.surface.material import Material, Skin, dress
from furbake.surface.read.reading import read
from furbake.surface.repair.repair import LARGEST, SMALLEST, check, count, straighten, tidy
from furbake.surface.repair.simplify import decimate
from furbake.surface.repair.topology import angle_normals
from furbake.surface.rig.at import in_pose
from furbake.surface.rig.kept import kept
from furbake.surface.soup import MeshError, Soup, plain

if TYPE_CHECKING:
    from furbake.surface.charts import Natural
    from furbake.surface.rig.rig import Rig

__all__ = ["LARGEST", "MAX_FACES", "SMALLEST", "MeshError", "Surface", "clean", "load_mesh", "simplify"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
RGB = tuple[float, float, float]
WHITE: RGB = (1.0, 1.0, 1.0)

MAX_FACES = 60_000
"""Faces of a model that are kept, unless more are asked for."""

MIN_FACES = 4
"""Faces that a model may be decimated to."""

RAGGED = 1.05
"""Faces above `max_faces` at which decimation has failed."""

ALIKE = 1.5 / 255.0
"""Colours nearer than this are one."""

_COLOUR = "COLOUR"
"""Name of the base colour among the numbers of a simplified surface; those of files are lower-case."""


@dataclass(frozen=True)
class Surface:
    """A welded, consistently wound triangle mesh, right-handed, y up, in the model's own units.

    Every edge has one or two faces, every vertex one fan or disc of them. Where a model was cut to make it so, copies
    of a vertex have bit-equal places.

    vertices : (V, 3) float, each used by a face
    faces : (F, 3) int, counter-clockwise seen from outside
    normals : (V, 3) float, unit, outward
    natural : texture coordinates that a built-in shape has by itself
    colour : linear base colour of the model's own material, white where it has none or where `colours` says it
    colours : (V, 3) float, linear base colour of every vertex where it is not the same everywhere
    uv : (F, 3, 2) float, the model's own texture coordinates at the corners of its faces, v down the image as in glTF;
        NaN on faces that have none
    attributes : (V, n) further numbers that the file gives its vertices, by lower-case name without underscore
    skin : the visible skin under the fur, one piece per material; () where the file has none
    rig : all that moves it, with the triangles of the file; None: nothing does, or it is a simplified copy
    notices : what was repaired and what is not kept, one sentence each, beginning with the model's name
    """

    vertices: Floats
    faces: Ints
    normals: Floats
    natural: Natural | None = None
    colour: RGB = WHITE
    colours: Floats | None = None
    uv: Floats | None = None
    attributes: dict[str, Floats] = field(default_factory=dict)
    skin: tuple[Skin, ...] = ()
    rig: Rig | None = None
    notices: tuple[str, ...] = ()

    @property
    def extent(self) -> float:
        """Largest side of the bounding box, model units."""
        return float(np.ptp(self.vertices, axis=0).max())


def load_mesh(path: Path, max_faces: int = MAX_FACES, pose: tuple[str, float] | None = None) -> Surface:
    """Surface of a file; the parts of a scene are joined where their transforms put them.

    pose : a clip, by its name or number from 0, and seconds, in place of the pose that skins are bound in

    Raises MeshError for every file that does not give one.
    """
    reading = read(path)
    soup, rig = reading.soup, reading.rig
    if pose is not None:
        rig = in_pose(str(path), rig, *pose)
        soup = replace(soup, vertices=rig.posed)
    surface = _finish(str(path), soup, reading.materials, max_faces, reading.missing)
    told = reading.notices if rig is None else (*reading.notices, kept(rig))
    return replace(surface, rig=rig, notices=(*surface.notices, *(f"{path}: {notice}" for notice in told)))


def clean(name: str, vertices: Floats, faces: Ints, colour: RGB = WHITE, max_faces: int = MAX_FACES) -> Surface:
    """Surface of bare triangles: welded, repaired, wound outward.

    vertices : (V, 3) float, model units; faces : (F, 3) int. Raises MeshError, starting with `name`.
    """
    return _finish(name, plain(vertices, faces), (Material(factor=(*colour, 1.0)),), max_faces)


def simplify(surface: Surface, faces: int) -> Surface:
    """A copy with about `faces` faces, for shells and fins to stand on; the surface itself where it has no more.

    It keeps colours, texture coordinates and attributes, but no skin: that is the whole surface's.
    """
    if len(surface.faces) <= faces:
        return surface
    numbers = {name: values[surface.faces] for name, values in surface.attributes.items()}
    if surface.colours is not None:
        numbers[_COLOUR] = surface.colours[surface.faces]
    natural = surface.natural
    uv = surface.uv if natural is None else natural.uv[natural.faces]
    soup = replace(plain(surface.vertices, surface.faces), uv=uv, attributes=numbers)
    soup, _ = tidy("simplified surface", decimate(soup, faces))
    soup, _ = straighten(soup)
    attributes = _at_vertices(soup)
    return Surface(
        vertices=soup.vertices,
        faces=soup.faces,
        normals=angle_normals(soup.vertices, soup.faces),
        colour=surface.colour,
        colours=attributes.pop(_COLOUR, None),
        uv=soup.uv,
        attributes=attributes,
    )


def _finish(name: str, soup: Soup, materials: tuple[Material, ...], max_faces: int, missing: int = 0) -> Surface:
    check(name, soup)
    soup, notices = tidy(name, soup)
    if len(soup.faces) > max_faces:
        soup = _fewer(name, soup, max(max_faces, MIN_FACES), notices)
    soup, repaired = straighten(soup)
    notices += repaired
    colours, broken = base_colours(soup, materials)
    materials = tuple(_wearable(material, i in broken) for i, material in enumerate(materials))
    if missing + len(broken):
        notices.append(f"{count(missing + len(broken), 'picture')} left out that cannot be read")
    same = bool((np.ptp(colours, axis=0) < ALIKE).all())
    return Surface(
        vertices=soup.vertices,
        faces=soup.faces,
        normals=angle_normals(soup.vertices, soup.faces),
        colour=_one_colour(colours) if same else WHITE,
        colours=None if same else colours,
        uv=soup.uv if soup.uv is not None and bool(np.isfinite(soup.uv).any()) else None,
        attributes=_at_vertices(soup),
        skin=dress(soup, materials) if soup.paint is not None or any(m != Material() for m in materials) else (),
        notices=tuple(f"{name}: {line}" for line in notices),
    )


def _wearable(material: Material, broken: bool) -> Material:
    """A material as it is stored on the skin."""
    if material.picture is None:
        return material
    return replace(material, picture=None if broken else portable(material.picture))


def _fewer(name: str, soup: Soup, max_faces: int, notices: list[str]) -> Soup:
    before = len(soup.faces)
    fewer, _ = tidy(name, decimate(soup, max_faces))
    if len(fewer.faces) > RAGGED * max_faces:
        raise MeshError(
            f"{name}: {before} faces in pieces too small to simplify, expected at most {max_faces} or larger pieces"
        )
    notices.append(f"{before} faces decimated to {len(fewer.faces)}")
    return fewer


def _one_colour(colours: Floats) -> RGB:
    """The colour of a model that has one. Grey is what exporters write by default and counts as white."""
    red, green, blue = (float(value) for value in colours.mean(axis=0))
    return WHITE if max(red, green, blue) - min(red, green, blue) < ALIKE else (red, green, blue)


def _at_vertices(soup: Soup) -> dict[str, Floats]:
    """(V, n) mean over the corners at each vertex; where a part lacks them, scalars are 1 and vectors 0."""
    corners, count = soup.faces.reshape(-1), len(soup.vertices)
    uses = np.bincount(corners, minlength=count)
    found = {}
    for name, values in soup.attributes.items():
        flat = values.reshape(len(corners), -1)
        flat = np.where(np.isfinite(flat), flat, 1.0 if flat.shape[1] == 1 else 0.0)
        sums = [np.bincount(corners, flat[:, i], count) for i in range(flat.shape[1])]
        found[name] = np.stack(sums, axis=1) / uses[:, None]
    return found
