"""Files of museums, written and read here in a few lines each: oracles that share no code with furbake."""

from __future__ import annotations

import io
import json
from pathlib import Path

import numpy as np
from PIL import Image

W, H = 13, 9


def lamps(count: int = 20, low: float = 0.15) -> np.ndarray:
    """Directions on a spiral over the upper half, (count, 3)."""
    i = np.arange(count) + 0.5
    z = low + (1 - low) * i / count
    return np.stack([np.sqrt(1 - z * z) * np.cos(2.4 * i), np.sqrt(1 - z * z) * np.sin(2.4 * i), z], 1)


def terms(light: np.ndarray) -> np.ndarray:
    u, v, _ = light
    return np.array([u * u, v * v, u * v, u, v, 1.0])


def known(width: int = W, height: int = H) -> tuple[np.ndarray, np.ndarray]:
    """A polynomial per pixel, (H, W, 6), of 0 to 1 under all lamps, and colours (H, W, 3) of 0 to 1."""
    chance = np.random.default_rng(7)
    polynomial = chance.uniform(-0.12, 0.12, (height, width, 6))
    polynomial[..., 5] = chance.uniform(0.55, 0.7, (height, width))
    return polynomial, chance.uniform(0.2, 1, (height, width, 3))


def picture_under(light: np.ndarray, polynomial: np.ndarray, colour: np.ndarray) -> np.ndarray:
    return np.clip((polynomial @ terms(light))[..., None] * colour, 0, 1)


def photographed(folder: Path, lights: np.ndarray, kind: str = "png", **size: int) -> Path:
    """An .lp of photographs of `known`; the path of the list."""
    polynomial, colour = known(**size)
    lines = [str(len(lights))]
    for i, light in enumerate(lights):
        pixels = np.rint(picture_under(light, polynomial, colour) * 255).astype(np.uint8)
        Image.fromarray(pixels).save(folder / f"photo {i:02}.{kind}", **({"quality": 95} if kind == "jpg" else {}))
        lines.append(f"photo {i:02}.{kind} {light[0]:.6f} {light[1]:.6f} {light[2]:.6f}")
    path = folder / "set.lp"
    path.write_text("\n".join(lines) + "\n")
    return path


def head(kind: str, width: int, height: int, scale: list[float], bias: list[int]) -> bytes:
    numbers = (" ".join(map(str, scale)), " ".join(map(str, bias)))
    return f"PTM_1.2\nPTM_FORMAT_{kind}\n{width}\n{height}\n{numbers[0]}\n{numbers[1]}\n".encode()


def ptm_under(data: bytes, light: np.ndarray) -> np.ndarray:
    """A plain PTM by the letter of its specification, (H, W, 3) of 0 to 255, row 0 on top."""
    *lines, body = data.split(b"\n", 6)
    width, height = int(lines[2]), int(lines[3])
    scale, bias = (np.array([float(word) for word in line.split()]) for line in lines[4:6])
    count = width * height * 6

    def light_of(start: int) -> np.ndarray:
        stored = np.array(list(body[start : start + count]), float).reshape(height, width, 6)
        return ((stored - bias) * scale @ terms(light))[::-1]

    if lines[1] == b"PTM_FORMAT_RGB":
        return np.clip(np.stack([light_of(i * count) for i in range(3)], -1), 0, 255)
    colour = np.array(list(body[count : count + width * height * 3]), float).reshape(height, width, 3)[::-1]
    return np.clip(light_of(0)[..., None] * colour / 255, 0, 255)


def jpeg(grey: np.ndarray, quality: int = 92) -> bytes:
    stream = io.BytesIO()
    Image.fromarray(grey).save(stream, "JPEG", quality=quality)
    return stream.getvalue()


def unjpeg(data: bytes) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(data)).convert("L"))


def jpeg_ptm(planes: np.ndarray, scale: list[float], bias: list[int], quality: int = 92) -> tuple[bytes, np.ndarray]:
    """PTM_FORMAT_JPEG_LRGB of (H, W, 9) bytes, row 0 at the bottom, and what a reader has to find in it.

    Colours G and B are differences to R, coefficient 1 to the inverse of 0, 3 to 2, told out of their order. Pixels
    that JPEG's error would carry round 256 are corrected, and three others, to be seen.
    """
    height, width, count = planes.shape
    order = [1, 2, 0, 3, 4, 5, 6, 8, 7]
    reference = [-1, 0, -1, 2, -1, -1, -1, 6, 6]
    transforms = [0, 1, 0, 0, 0, 0, 0, 0, 0]
    found = np.zeros((height, width, count), int)
    streams, sides = [b""] * count, [b""] * count
    for plane in sorted(range(count), key=lambda i: order[i]):
        want = planes[..., plane].astype(int)
        base = np.zeros_like(want)
        if reference[plane] >= 0:
            base = found[..., reference[plane]]
            base = (255 - base if transforms[plane] else base) - 128
        streams[plane] = jpeg(((want - base) % 256).astype(np.uint8), quality)
        got = (unjpeg(streams[plane]).astype(int) + base) % 256
        wrong = np.abs(got - want) > 40
        wrong.reshape(-1)[[0, width + 2, -1]] = True
        for pixel in np.flatnonzero(wrong):
            sides[plane] += int(pixel).to_bytes(4, "big") + bytes([want.reshape(-1)[pixel]])
        found[..., plane] = np.where(wrong, want, got)
    rows = [transforms, [0] * count, [0] * count, order, reference, [*map(len, streams)], [*map(len, sides)]]
    text = "".join(" ".join(map(str, row)) + "\n" for row in rows)
    body = b"".join(stream + side for stream, side in zip(streams, sides, strict=True))
    return head("JPEG_LRGB", width, height, scale, bias) + f"{quality}\n{text}".encode() + body, found


def relight_under(folder: Path, light: np.ndarray) -> np.ndarray:
    """A folder of relight with a polynomial, as OpenLIME's shader has it, (H, W, 3) of 0 to 255."""
    info = json.loads((folder / "info.json").read_text())
    material, count = info["materials"][0], info["nplanes"]
    planes = np.concatenate(
        [
            np.asarray(Image.open(folder / f"plane_{i}.{info['format']}").convert("RGB"), float) / 255
            for i in range(count // 3)
        ],
        -1,
    )
    value = (planes - material["bias"]) * material["scale"]
    u, v, _ = light
    base = [1, u, v, u * u, u * v, v * v]
    if info["colorspace"] == "lrgb":
        return np.clip((value[..., 3:] @ base)[..., None] * value[..., :3], 0, 1) * 255
    return np.clip(np.einsum("rcjk,j->rck", value.reshape(*value.shape[:2], 6, 3), base), 0, 1) * 255
