"""PTM files are read as their specification has them, and written so that others read them."""

from __future__ import annotations

import io

import numpy as np
import pytest

from furbake.rti import relit
from furbake.rti.ptm import parse_ptm, write_ptm
from furbake.rti.relit import RtiError
from helpers.museum import H, W, head, jpeg_ptm, lamps, ptm_under

SCALE, BIAS = [0.5, 0.75, 0.25, 1.0, 0.5, 2.0], [167, 97, 120, 128, 30, 0]


def data(kind: str) -> bytes:
    chance = np.random.default_rng(3)
    return head(kind, W, H, SCALE, BIAS) + chance.bytes(W * H * (9 if kind == "LRGB" else 18))


@pytest.mark.parametrize("kind", ["LRGB", "RGB"])
def test_plain_files_are_relit_by_the_letter_of_the_specification(kind: str) -> None:
    found = parse_ptm(data(kind), "a.ptm")
    for light in lamps(7):
        wanted = ptm_under(data(kind), light)
        assert (wanted > 0).mean() > 0.05
        assert np.abs(found.lit(light) * 255 - wanted).max() < 2e-3
        assert np.abs(found.picture(light) - wanted).max() <= 0.502


@pytest.mark.parametrize(
    "ends",
    [
        lambda head: head.replace(b"13\n9\n", b"13 9\n"),
        lambda head: head.replace(b"\n", b" \n"),
        lambda head: head.replace(b"\n", b"\r\n"),
        lambda head: head.replace(b"2.0\n", b"2.0 "),
    ],
)
def test_lines_of_the_header_end_where_writers_like(ends: object) -> None:
    first = len(head("LRGB", W, H, SCALE, BIAS))
    whole = data("LRGB")
    other = ends(whole[:first]) + whole[first:]  # type: ignore[operator]
    assert (parse_ptm(other, "a.ptm").codes == parse_ptm(whole, "a.ptm").codes).all()


def test_version_1_1_has_the_colour_of_a_pixel_behind_its_coefficients() -> None:
    whole = data("LRGB")
    first = len(head("LRGB", W, H, SCALE, BIAS))
    body = np.frombuffer(whole[first:], np.uint8)
    six, three = body[: W * H * 6].reshape(-1, 6), body[W * H * 6 :].reshape(-1, 3)
    old = whole[:first].replace(b"1.2", b"1.1", 1) + np.concatenate([six, three], 1).tobytes()
    new, found = parse_ptm(whole, "a.ptm"), parse_ptm(old, "a.ptm")
    assert (found.codes == new.codes).all()
    assert found.colour is not None
    assert (found.colour == new.colour).all()


@pytest.mark.parametrize("quality", [60, 92])
def test_jpeg_planes_with_references_inversion_and_side_information(quality: int) -> None:
    chance = np.random.default_rng(5)
    width, height = 41, 23
    waves = np.add.outer(np.arange(height) / 5, np.arange(width) / 7)
    planes = np.stack([127 + 120 * np.sin(waves * (1 + i / 6) + i) for i in range(9)], -1)
    planes = np.clip(planes + chance.normal(0, 12, planes.shape), 0, 255).astype(np.uint8)
    stored, wanted = jpeg_ptm(planes, SCALE, BIAS, quality)
    found = parse_ptm(stored, "a.ptm")
    assert found.colour is not None
    got = np.concatenate([found.codes, found.colour], -1)[::-1]
    assert (got == wanted).all()
    assert np.abs(got.astype(int) - planes).mean() < 12


@pytest.mark.parametrize("kind", ["LRGB", "RGB"])
def test_what_is_written_is_read_by_others(kind: str) -> None:
    chance = np.random.default_rng(9)
    scale, bias = np.array([0.51234567, *SCALE[1:]]), np.array(BIAS, float)
    codes = chance.integers(0, 256, (H, W, 6 if kind == "LRGB" else 18), dtype=np.uint8)
    colour = chance.integers(0, 256, (H, W, 3), dtype=np.uint8)
    made = relit.lrgb(codes, scale, bias, colour) if kind == "LRGB" else relit.rgb(codes, scale, bias)
    file = io.BytesIO()
    write_ptm(file, made)
    for light in lamps(5):
        assert np.abs(made.lit(light) * 255 - ptm_under(file.getvalue(), light)).max() < 2e-3
    again = io.BytesIO()
    write_ptm(again, parse_ptm(file.getvalue(), "a.ptm"))
    assert again.getvalue() == file.getvalue()


LRGB = head("LRGB", W, H, SCALE, BIAS)


def jpegs(size: str, body: bytes = b"") -> bytes:
    """A file of nine JPEG streams of that size each."""
    rows = [
        "90",
        *[" ".join(["0"] * 9)] * 3,
        "0 1 2 3 4 5 6 7 8",
        *(" ".join([word] * 9) for word in ("-1", size, "0")),
    ]
    return head("JPEG_LRGB", 2, 2, SCALE, BIAS) + "".join(f"{row}\n" for row in rows).encode() + body


BAD = {
    "empty": (b"", "no PTM file, expected one that begins with PTM_1.2"),
    "picture": (b"\x89PNG\r\n", "no PTM file"),
    "version": (b"PTM_1.23\nPTM_FORMAT_LRGB\n", "got PTM_1.23 PTM_FORMAT_LRGB, expected PTM_1.2 and one of"),
    "kind": (b"PTM_1.2\nPTM_FORMAT_LUM\n1\n1\n", "got PTM_1.2 PTM_FORMAT_LUM, expected PTM_1.2 and one of PTM_"),
    "cut header": (LRGB[:30], "the header ends early, expected"),
    "no size": (b"PTM_1.2\nPTM_FORMAT_LRGB\nwide\n", "got 'wide', expected width and height, pixels"),
    "no pixels": (head("LRGB", 0, 5, SCALE, BIAS), "got 0 x 5 pixels, expected 1 x 1 or more"),
    "large": (head("LRGB", 10**9, 10**9, SCALE, BIAS), "more than 250000000 bytes to read, expected fewer"),
    "scale": (LRGB.replace(b"0.75", b"nan"), "got 'nan', expected six scales"),
    "bias": (LRGB.replace(b"167", b"1e999"), "got '1e999', expected six biases"),
    "short": (LRGB + bytes(W * H * 9 - 1), f"{W * H * 9 - 1} bytes of pixels, expected {W * H * 9} for 13 x 9 LRGB"),
    "streams": (jpegs("9"), "0 bytes of JPEG streams, expected 81"),
    "negative": (jpegs("-9"), "a JPEG stream of negative size"),
    "no JPEG": (jpegs("1", b"x" * 9), "plane 0: cannot be read, expected a JPEG of 2 x 2"),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_a_bad_file_is_refused_in_a_sentence(name: str) -> None:
    stored, message = BAD[name]
    with pytest.raises(RtiError) as caught:
        parse_ptm(stored, "a.ptm")
    assert str(caught.value).startswith(f"a.ptm: {message}")
    assert "expected" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_references_that_do_not_come_first_and_motion_are_refused() -> None:
    planes = np.full((8, 8, 9), 90, np.uint8)
    stored, _ = jpeg_ptm(planes, SCALE, BIAS)
    order = b"1 2 0 3 4 5 6 8 7\n"
    with pytest.raises(RtiError, match="plane 1 is told by plane 0, expected one before it"):
        parse_ptm(stored.replace(order, b"2 1 0 3 4 5 6 8 7\n", 1), "a.ptm")
    still = b"0 1 0 0 0 0 0 0 0\n" + b"0 0 0 0 0 0 0 0 0\n"
    moving = b"0 2 0 0 0 0 0 0 0\n" + b"0 3 0 0 0 0 0 0 0\n"
    assert still in stored
    with pytest.raises(RtiError, match="plane 1 has motion 3, 0, expected planes without motion"):
        parse_ptm(stored.replace(still, moving, 1), "a.ptm")
