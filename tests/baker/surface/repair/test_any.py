from __future__ import annotations

import re
from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from furbake.surface.mesh import MeshError, Surface, clean
from helpers.soups import Mesh, assert_sound, fans, nests, scales, seeds, slivers, soups, strips


def assert_sound_or_refused(vertices: Any, faces: Any) -> Surface | None:
    try:
        surface = clean("mesh", np.asarray(vertices, dtype=float), np.asarray(faces, dtype=np.int64).reshape(-1, 3))
    except MeshError as error:
        assert re.fullmatch(r"mesh: [^\n]+", str(error))  # noqa: PT017 — refusing is as good
        return None
    assert_sound(surface)
    return surface


@given(st.one_of(soups(), strips(), fans(), slivers(), nests()), scales, seeds)
def test_any_triangles(mesh: Mesh, scale: float, seed: int) -> None:
    vertices, faces = mesh
    assert_sound_or_refused(scale * (vertices + np.random.default_rng(seed).normal(size=3)), faces)


@given(soups())
def test_soups(mesh: Mesh) -> None:
    assert_sound_or_refused(*mesh)


@given(slivers(), scales)
def test_slivers(mesh: Mesh, scale: float) -> None:
    surface = assert_sound_or_refused(scale * mesh[0], mesh[1])
    if np.ptp(mesh[0][:, 0]) > 0.01:
        assert surface is not None


@given(strips(), scales)
def test_one_sided_strips(mesh: Mesh, scale: float) -> None:
    assert assert_sound_or_refused(scale * mesh[0], mesh[1]) is not None


@given(nests(), scales, seeds)
def test_shells_in_shells_all_face_outward(mesh: Mesh, scale: float, seed: int) -> None:
    shift = np.random.default_rng(seed).normal(size=3)
    surface = clean("mesh", scale * (mesh[0] + shift), mesh[1])
    outward = surface.vertices - scale * shift
    assert (np.einsum("ij,ij->i", surface.normals, outward) > 0).all()


@given(fans())
def test_fans(mesh: Mesh) -> None:
    assert_sound_or_refused(*mesh)
