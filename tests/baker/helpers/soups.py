"""Builders shared by tests of soups."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import Any

import numpy as np
import trimesh
from hypothesis import strategies as st

from furbake.surface.mesh import Surface
from furbake.surface.repair.manifold import separate

Mesh = tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]


def assert_sound(surface: Surface) -> None:
    """Finite, wound alike, two faces at most per edge, one fan or disc per vertex."""
    vertices, faces = surface.vertices, surface.faces
    assert np.isfinite(vertices).all()
    np.testing.assert_allclose(np.linalg.norm(surface.normals, axis=1), 1.0)
    assert len(np.unique(faces)) == len(vertices)
    assert (faces != np.roll(faces, 1, axis=1)).all()
    directed = np.stack([faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)], axis=1)
    assert len(np.unique(directed, axis=0)) == len(directed), "an edge is used twice in one direction"
    again = separate(vertices, faces)
    assert len(again.source) == len(vertices), "a vertex has two fans"
    for line in surface.notices:
        assert re.fullmatch(r"[^\n]+: .*\d.*", line), line


def volume(surface: Surface) -> float:
    a, b, c = (surface.vertices[surface.faces[:, i]] for i in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def strip(segments: int, twists: int, width: float = 0.4) -> Mesh:
    """A closed band of quads, cut in two; an odd number of half twists gives it one side."""
    angle = np.linspace(0.0, 2.0 * np.pi, segments, endpoint=False)
    tilt = 0.5 * twists * angle
    out = np.stack([np.cos(angle), np.zeros(segments), np.sin(angle)], axis=1)
    across = np.cos(tilt)[:, None] * out + np.sin(tilt)[:, None] * np.array([0.0, 1.0, 0.0])
    vertices = np.concatenate([out + width * across, out - width * across])
    faces = []
    for i in range(segments):
        a, b, j = i, i + segments, (i + 1) % segments
        c, d = (j, j + segments) if i + 1 < segments or twists % 2 == 0 else (j + segments, j)
        faces += [(a, b, c), (c, b, d)]
    return vertices, np.array(faces)


def flipped(faces: Any, seed: int, share: float = 0.5) -> Any:
    chance = np.random.default_rng(seed).random(len(faces)) < share
    return np.where(chance[:, None], faces[:, ::-1], faces)


seeds = st.integers(0, 2**32 - 1)


scales = st.floats(-6.0, 6.0).map(lambda power: 10.0**power)


@st.composite
def soups(draw: Any) -> Mesh:
    chance = np.random.default_rng(draw(seeds))
    count = draw(st.integers(3, 40))
    vertices = chance.normal(size=(count, 3))
    if draw(st.booleans()):  # on a lattice, so that places, edges and faces coincide
        vertices = np.rint(1.2 * vertices)
    return vertices, chance.integers(0, count, (draw(st.integers(1, 80)), 3))


@st.composite
def strips(draw: Any) -> Mesh:
    vertices, faces = strip(draw(st.integers(3, 40)), draw(st.integers(0, 5)), draw(st.floats(0.01, 0.9)))
    return vertices, flipped(faces, draw(seeds), draw(st.sampled_from([0.0, 0.5, 1.0])))


@st.composite
def fans(draw: Any) -> Mesh:
    """Pages bound along one edge, and fans around one vertex that share nothing else."""
    chance = np.random.default_rng(draw(seeds))
    pages, leaves = draw(st.integers(1, 24)), draw(st.integers(0, 4))
    vertices = [np.zeros(3), np.array([0.0, 1.0, 0.0]), *chance.normal(size=(pages, 3))]
    faces = [(0, 1, 2 + i) for i in range(pages)]
    for _ in range(leaves):
        rim = [*range(len(vertices), len(vertices) + draw(st.integers(3, 9)))]
        vertices += [*chance.normal(size=(len(rim), 3))]
        faces += [(0, a, b) for a, b in pairwise([*rim, rim[0]])]
    return np.array(vertices), flipped(np.array(faces), draw(seeds))


@st.composite
def slivers(draw: Any) -> Mesh:
    """A grid whose columns draw together, with points put on edges or next to them."""
    chance = np.random.default_rng(draw(seeds))
    n, m = draw(st.integers(1, 6)), draw(st.integers(1, 6))
    x = np.cumsum(np.append(0.0, 10.0 ** chance.uniform(-9, 0, n)))
    place = np.stack(np.meshgrid(x, np.arange(m + 1.0), indexing="ij"), axis=-1).reshape(-1, 2)
    vertices = np.column_stack([place[:, 0], 0.1 * np.sin(place.sum(axis=1)), place[:, 1]])
    a = (np.arange(n)[:, None] * (m + 1) + np.arange(m)).reshape(-1)
    faces = np.concatenate([np.stack([a, a + 1, a + m + 1], axis=1), np.stack([a + 1, a + m + 2, a + m + 1], axis=1)])
    for _ in range(draw(st.integers(0, 5))):  # split a face, but not the one beyond the edge: a cap closes the slit
        f, t = int(chance.integers(len(faces))), float(chance.uniform(0.1, 0.9))
        p, q, r = faces[f]
        near = vertices[p] * (1 - t) + vertices[q] * t + 10.0 ** chance.uniform(-12, -5) * chance.normal(size=3)
        new = len(vertices)
        vertices = np.concatenate([vertices, near[None]])
        faces = np.concatenate([np.delete(faces, f, axis=0), [(p, new, r), (new, q, r), (p, q, new)]])
    return vertices, faces


@st.composite
def nests(draw: Any) -> Mesh:
    """Balls within balls, each wound anyhow, some with holes."""
    ball = trimesh.creation.icosphere(subdivisions=1)
    vertices, faces = [], []
    for i in range(draw(st.integers(1, 4))):
        mine = flipped(ball.faces, draw(seeds), draw(st.sampled_from([0.0, 0.5, 1.0])))
        mine = mine[draw(st.sampled_from([0, 1, 4])) :]
        vertices.append(ball.vertices / (i + 1.0))
        faces.append(mine + i * len(ball.vertices))
    return np.concatenate(vertices), np.concatenate(faces)
