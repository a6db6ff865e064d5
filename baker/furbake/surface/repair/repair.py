"""Make a surface of a soup: each step takes triangles, gives better ones, and counts what it did in a sentence."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from furbake.surface.repair.folds import flip_folds
from furbake.surface.repair.manifold import separate
from furbake.surface.repair.slivers import mend
from furbake.surface.repair.topology import duplicates, face_vectors, orient, weld
from furbake.surface.soup import MeshError, Soup

SMALLEST, LARGEST = 1e-9, 1e9
"""Largest side of a mesh that 32-bit floats can still carry with its fur, model units."""

MAX_FACES_READ = 2_000_000
"""Faces that are repaired and decimated within a minute."""

WELD = 1e-6
"""Vertices nearer than this share of the largest side become one."""

SLIVER = 1e-12
"""Faces whose area is below this share of the largest side squared are dropped."""


def check(name: str, soup: Soup) -> None:
    """Raises MeshError where no repair can help."""
    vertices, faces = soup.vertices, soup.faces
    if len(faces) == 0:
        raise MeshError(f"{name}: no faces, expected a surface of triangles")
    if len(faces) > MAX_FACES_READ:
        raise MeshError(f"{name}: {len(faces)} faces, expected at most {MAX_FACES_READ}")
    if faces.min() < 0 or faces.max() >= len(vertices):
        got = faces.min() if faces.min() < 0 else faces.max()
        raise MeshError(f"{name}: a face uses vertex {got}, expected 0 to {len(vertices) - 1}")
    used = np.unique(faces)
    bad = int((~np.isfinite(vertices[used]).all(axis=1)).sum())
    if bad:
        raise MeshError(f"{name}: {bad} of {len(used)} vertices are not finite, expected numbers (no NaN, no infinity)")
    with np.errstate(over="ignore"):
        extent = float(np.ptp(vertices[used], axis=0).max())
    if extent == 0.0:
        raise MeshError(f"{name}: all faces have zero area, expected a surface")
    if not SMALLEST <= extent <= LARGEST:
        raise MeshError(f"{name}: largest side is {extent:.3g} units, expected {SMALLEST:g} to {LARGEST:g}")


def tidy(name: str, soup: Soup) -> tuple[Soup, list[str]]:
    """Welded, without unused vertices, slivers, degenerate and repeated faces. Raises MeshError where none is left."""
    notices = []
    loose = len(soup.vertices) - len(np.unique(soup.faces))
    if loose:
        notices.append(f"{count(loose, 'vertex', 'vertices')} without a face dropped")
    soup = _some(name, soup.compact())
    before = len(soup.vertices)
    extent = float(np.ptp(soup.vertices, axis=0).max())
    vertices, faces = weld(soup.vertices, soup.faces, WELD * extent)
    soup = replace(soup, vertices=vertices, faces=faces)
    if len(vertices) < before:
        notices.append(f"{before} vertices welded into {len(vertices)}")

    faces = soup.faces
    whole = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    flat = int((~whole).sum())
    soup = _some(name, soup.take(whole))
    again = duplicates(soup.faces)
    if again.any():
        notices.append(f"{count(int(again.sum()), 'duplicate face')} dropped")
        soup = soup.take(~again)
    soup, slim = mend(soup)
    if slim:
        notices.append(f"{count(slim, 'sliver')} mended")
        soup = _some(name, soup.take(~duplicates(soup.faces)))
    area = 0.5 * np.linalg.norm(face_vectors(soup.vertices / extent, soup.faces), axis=1)
    if flat or (area <= SLIVER).any():
        notices.append(f"{count(flat + int((area <= SLIVER).sum()), 'face')} without area dropped")
        soup = _some(name, soup.take(area > SLIVER))
    return soup.compact(), notices


def straighten(soup: Soup) -> tuple[Soup, list[str]]:
    """Wound alike and outward, every edge with one or two faces, every vertex with one fan or disc of them."""
    notices = []
    extent = float(np.ptp(soup.vertices, axis=0).max())
    shape = (soup.vertices - soup.vertices.min(axis=0)) / extent
    turned = orient(shape, soup.faces)[:, 0] != soup.faces[:, 0]
    if turned.any():
        notices.append(f"{count(int(turned.sum()), 'face')} turned over")
        soup = soup.turn(turned)
    soup, folds = flip_folds(soup)
    if folds:
        notices.append(f"{count(folds, 'fold')} of hollow polygons undone")
        soup, _ = mend(soup)
        soup = soup.take(~duplicates(soup.faces)).compact()
        shape = (soup.vertices - soup.vertices.min(axis=0)) / extent
    apart = separate(shape, soup.faces)
    if apart.crowded:
        notices.append(f"{count(apart.crowded, 'edge')} of more than two faces cut")
    if apart.torn:
        notices.append(f"{count(apart.torn, 'edge')} cut to give a one-sided surface two sides")
    if apart.split and not (apart.crowded or apart.torn):
        notices.append(f"{count(apart.split, 'vertex', 'vertices')} split where pieces touch in a point")
    return replace(soup, vertices=soup.vertices[apart.source], faces=apart.faces), notices


def count(number: int, one: str, many: str | None = None) -> str:
    """A number with its noun."""
    return f"{number} {one if number == 1 else many or one + 's'}"


def _some(name: str, soup: Soup) -> Soup:
    if len(soup.faces) == 0:
        raise MeshError(f"{name}: all faces have zero area, expected a surface")
    return soup
