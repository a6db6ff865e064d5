"""Pictures as numbers: sRGB, filtering, wrapping."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

from furbake.surface.colours import LINEAR, base_colours, decode, from_srgb, luminance, sample_picture
from furbake.surface.material import CLAMP, MIRROR, REPEAT, Material, Picture
from furbake.surface.soup import Soup


def picture(pixels: object, kind: str = "PNG") -> Picture:
    stream = io.BytesIO()
    Image.fromarray(np.asarray(pixels, dtype=np.uint8)).save(stream, kind)
    return Picture(stream.getvalue(), f"image/{kind.lower()}")


def test_srgb() -> None:
    np.testing.assert_allclose(
        from_srgb(np.array([0.0, 0.04, 0.5, 1.0])), [0.0, 0.04 / 12.92, 0.214041, 1.0], atol=1e-6
    )
    assert LINEAR[188] == pytest.approx(0.5029, abs=1e-4)


@pytest.mark.parametrize(
    ("wrap", "values"),
    [(REPEAT, [0, 1, 0.5, 0, 1, 1]), (CLAMP, [0, 1, 0, 1, 1, 0]), (MIRROR, [0, 1, 0, 1, 0, 0])],
)
def test_wrapping(wrap: int, values: list[float]) -> None:
    """Two texels, black and white; at the middle of each, at the edge, and beyond."""
    pixels = np.array([[[0], [255]]], dtype=np.uint8)
    u = np.array([0.25, 0.75, 0.0, 1.25, 1.75, -0.25])
    seen = sample_picture(pixels, np.stack([u, np.full(6, 0.5)], axis=1), (wrap, wrap))[:, 0]
    np.testing.assert_allclose(seen, values, atol=1e-12)


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "WEBP"])
def test_kinds_of_picture(kind: str) -> None:
    pixels = decode(picture(np.full((8, 8, 3), (200, 100, 50)), kind))
    assert pixels is not None
    np.testing.assert_allclose(pixels.reshape(-1, 4).mean(axis=0), [200, 100, 50, 255], atol=4)


def test_broken_picture_is_none() -> None:
    whole = picture(np.zeros((64, 64, 3)))
    assert decode(Picture(whole.data[:60], "image/png")) is None
    assert decode(Picture(b"no picture", "image/png")) is None


def test_one_line_of_a_picture_does_not_colour_a_vertex() -> None:
    pixels = np.zeros((256, 256, 3))
    pixels[0] = 255
    uv = np.array([[[0, 0], [1, 0], [0, 1.0]]])
    soup = Soup(np.eye(3), np.array([[0, 1, 2]]), np.zeros(1, dtype=np.int64), uv)
    colours, broken = base_colours(soup, (Material(picture=picture(pixels)),))
    assert not broken
    assert colours.max() < 0.1


def test_luminance() -> None:
    grey = np.array([[7, 255]], dtype=np.uint8)
    np.testing.assert_array_equal(luminance(grey), grey)
    np.testing.assert_array_equal(luminance(np.repeat(grey[..., None], 3, axis=2)), grey)
    np.testing.assert_array_equal(luminance(np.stack([grey, np.full_like(grey, 0)], axis=2)), 255)
