"""Broken inputs from sound ones: by the structure of their format, then by their bytes."""

from __future__ import annotations

import bz2
import json
import re
import struct
import tarfile
import zipfile
import zlib
from io import BytesIO
from random import Random
from typing import Any

from fuzz.seeds import Seed, archive, glb

NUMBERS = (
    0, 1, -1, 2, 3, 4, 7, 255, 256, 65535, 65536, 10**6, 2**31 - 1, 2**31, 2**32, -(2**31), 2**53, 10**18, 10**40,
)  # fmt: skip
REALS = (0.5, -0.0, 1e-45, 5e-324, 1e38, 1e39, 1e308, float("inf"), float("-inf"), float("nan"))
NAMES = (
    "", ".", "..", "../a", "/dev/zero", "/etc/passwd", "a.gltf", "coat.png", "body.bin", "x" * 300, "\0", "\x1b[2J\n",
)  # fmt: skip
WORDS = (
    "nan", "inf", "1e999", "-0", "//", "1/", "f", "v", "newmtl", "element", "end_header", "list", "property", "usemtl",
)  # fmt: skip


def mutated(seed: Seed, chance: Random) -> dict[str, bytes]:
    """Files of a seed, one to four of them changed once."""
    files = dict(seed.files)
    for _ in range(chance.choice((1, 1, 1, 2, 4))):
        name = chance.choice([*files, *[one for one in files if one == seed.main] * 3])
        files[name] = change(name, files[name], chance)
        if chance.random() < 0.02:
            del files[name]
            if not files:
                return {name: b""}
    return files


def change(name: str, data: bytes, chance: Random) -> bytes:
    """One change: mostly of the structure."""
    if chance.random() < 0.2:
        return of_bytes(data, chance)
    try:
        if name.endswith((".gltf", ".json")):
            return of_json(data, chance)
        if name.endswith(".glb"):
            return of_glb(data, chance)
        if name.endswith(".png"):
            return of_png(data, chance)
        if name.endswith((".zip", ".tar.gz", ".tar.bz2")):
            return of_archive(name.partition(".")[2], data, chance)
        if name.endswith(".obj.bz2"):
            return bz2.compress(of_text(bz2.decompress(data), chance))
        if name.endswith(".ply"):
            return of_ply(data, chance)
        if name.endswith(".ptm"):
            return of_ptm(data, chance)
        if name.endswith((".obj", ".mtl", ".off", ".lp")) or data.startswith(b"solid"):
            return of_text(data, chance)
    except Exception:
        return of_bytes(data, chance)  # broken already
    return of_bytes(data, chance)


def of_bytes(data: bytes, chance: Random) -> bytes:
    """Bits, numbers, cuts and copies."""
    found = bytearray(data)
    at = chance.randrange(len(found) + 1)
    size = chance.choice((1, 2, 4, 8, 64, 1000))
    match chance.randrange(6):
        case 0 if found:
            found[min(at, len(found) - 1)] ^= 1 << chance.randrange(8)
        case 1:
            kind = chance.choice(["<I", "<H", "<f", "<d", ">I", "<q"])
            value = chance.choice(REALS) if kind[1] in "fd" else chance.choice(NUMBERS)
            wide = struct.calcsize(kind)
            whole = (int(value) if kind[1] not in "fd" else 0) % 2 ** (8 * wide)
            real = struct.pack("<d", value)[-wide:]
            found[at : at + wide] = real if kind[1] in "fd" else whole.to_bytes(wide, "little")
        case 2:
            del found[at:]
        case 3:
            del found[at : at + size]
        case 4:
            found[at:at] = found[at : at + size] * chance.choice((1, 2, 50))
        case _:
            found[at:at] = chance.randbytes(size)
    return bytes(found)


def of_json(data: bytes, chance: Random) -> bytes:
    document = json.loads(data)
    places: list[tuple[Any, Any]] = []

    def walk(value: Any) -> None:
        for key in value if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ():
            places.append((value, key))
            walk(value[key])

    walk(document)
    if not places:
        return data
    inside, key = chance.choice(places)
    match chance.randrange(8):
        case 0:
            del inside[key]
        case 1:
            inside[key] = chance.choice(NUMBERS)
        case 2:
            inside[key] = chance.choice(REALS)
        case 3:
            inside[key] = chance.choice(NAMES)
        case 4:
            inside[key] = chance.choice((None, True, [], {}, [[]], [0] * 1000, {"": 0}))
        case 5:
            other, where = chance.choice(places)
            inside[key] = json.loads(json.dumps(other[where]))
        case 6 if isinstance(inside, list):
            inside[key:key] = [inside[key]] * chance.choice((1, 2, 1000))
        case 7 if isinstance(inside[key], int | float):
            inside[key] = type(inside[key])(
                min(inside[key], 1e18) * chance.choice((2, 1000, -1)) + chance.choice((-1, 0, 1))
            )
        case _:
            inside[key] = [inside[key]]
    text = json.dumps(document)
    if chance.random() < 0.02:
        text = "[" * 5000 + text
    return text.encode("utf-8", "surrogatepass")


def of_glb(data: bytes, chance: Random) -> bytes:
    size = struct.unpack_from("<I", data, 12)[0]
    text, rest = data[20 : 20 + size], data[28 + size :]
    if chance.random() < 0.3:
        rest = of_bytes(rest, chance)
    else:
        text = of_json(text, chance)
    return glb(text, rest)


def of_png(data: bytes, chance: Random) -> bytes:
    """A number of a picture's header, its checksum mended."""
    if not data.startswith(b"\x89PNG"):
        return of_bytes(data, chance)
    found = bytearray(data)
    if chance.random() < 0.5:
        at = chance.choice((16, 20))
        found[at : at + 4] = (chance.choice(NUMBERS) % 2**32).to_bytes(4, "big")
    else:
        found[chance.randrange(24, 29)] = chance.randrange(256)
    found[29:33] = zlib.crc32(bytes(found[12:29])).to_bytes(4, "big")
    return bytes(found)


def of_text(data: bytes, chance: Random) -> bytes:
    lines = data.decode("utf-8", "surrogateescape").split("\n")
    at = chance.randrange(len(lines))
    words = lines[at].split(" ")
    match chance.randrange(7):
        case 0:
            del lines[at]
        case 1:
            lines[at:at] = [lines[at]] * chance.choice((1, 3, 300))
        case 2:
            other = chance.randrange(len(lines))
            lines[at], lines[other] = lines[other], lines[at]
        case 3:
            words[chance.randrange(len(words))] = str(chance.choice((*NUMBERS, *REALS, *NAMES, *WORDS)))
            lines[at] = " ".join(words)
        case 4:
            lines[at] = " ".join(words * chance.choice((2, 100)))
        case 5:
            lines[at] += chance.choice((" " * 5000, "\\", "\t\r", "\u2028", " #"))
        case _:
            del words[chance.randrange(len(words))]
            lines[at] = " ".join(words)
    return "\n".join(lines).encode("utf-8", "surrogateescape")


def of_ply(data: bytes, chance: Random) -> bytes:
    """The header by its words; the rest as text or bytes."""
    head, end, body = data.partition(b"end_header\n")
    if chance.random() < 0.6:
        return of_text(head, chance) + end + body
    return head + end + (of_text if b"ascii" in head else of_bytes)(body, chance)


def of_ptm(data: bytes, chance: Random) -> bytes:
    """The header by its words, six lines or fourteen; the rest as bytes."""
    lines = data.split(b"\n", 14 if b"JPEG" in data[:40] else 6)
    if chance.random() < 0.7:
        head = b"\n".join(lines[:-1])
        return of_text(head, chance) + b"\n" + lines[-1]
    return b"\n".join([*lines[:-1], of_bytes(lines[-1], chance)])


def of_archive(kind: str, data: bytes, chance: Random) -> bytes:
    """An archive of changed files or names."""
    files: dict[str, bytes] = {}
    if kind == "zip":
        with zipfile.ZipFile(BytesIO(data)) as zipped:
            files = {name: zipped.read(name) for name in zipped.namelist()}
    else:
        with tarfile.open(fileobj=BytesIO(data)) as tar:
            for info in tar:
                part = tar.extractfile(info)
                files[info.name] = part.read() if part else b""
    name = chance.choice([*files])
    if chance.random() < 0.3:
        clean = re.sub(r"[\0\x1b]", "", chance.choice(NAMES))
        files[clean + chance.choice(("", ".obj", ".glb", ".zip"))] = files.pop(name)
    else:
        files[name] = change(name, files[name], chance)
    return archive(kind, files)
