"""Archives, unpacked in memory within the bounds of one model."""

from __future__ import annotations

import bz2
import errno
import gzip
import io
import posixpath
import tarfile
import zipfile
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Protocol

from furbake.surface.files import Source
from furbake.surface.limits import Budget

BLOCK = 1 << 20
"""Bytes that are unpacked together."""


class _Readable(Protocol):
    def read(self, size: int, /) -> bytes: ...


def sources(archive: Source, kind: str, wanted: Sequence[str]) -> tuple[list[Source], list[str]]:
    """Files of an archive whose names end as wanted, in the archive's order, and the names of all files.

    kind : zip, tar.gz, tar.bz2 or bz2. What a desktop adds (`__MACOSX`, `._NAME`) is none of them.

    Raises MeshError where it unpacks to more than the bounds have, and any error for a broken archive.
    """
    fetch = _members(archive, kind, archive.budgets.bytes)
    Budget(archive.name, "members").take(len(fetch))
    names = [
        name for name in fetch if not name.startswith("__MACOSX/") and not posixpath.basename(name).startswith("._")
    ]
    unpacked: dict[str, bytes] = {}

    def unpack(name: str) -> bytes:
        if name not in unpacked:
            unpacked[name] = fetch[name]()
        return unpacked[name]

    models = [name for name in names if name.lower().rpartition(".")[2] in wanted]
    return [_member(archive, name, names, unpack) for name in models], names


def _member(archive: Source, name: str, names: Sequence[str], unpack: Callable[[str], bytes]) -> Source:
    """A model in an archive, which may name the archive's other files."""
    known = set(names)
    by_base = {posixpath.basename(one): one for one in reversed(names)}

    def find(asked: str) -> bytes:
        plain = asked.replace("\\", "/")
        whole = posixpath.normpath(posixpath.join(posixpath.dirname(name), plain))
        found = whole if whole in known else by_base.get(posixpath.basename(plain))
        if found is None:
            raise FileNotFoundError(errno.ENOENT, "no such file in the archive", asked)
        return unpack(found)

    return Source(f"{archive.name}/{name}", unpack(name), find, archive.budgets)


def _members(archive: Source, kind: str, budget: Budget) -> Mapping[str, Callable[[], bytes]]:
    """How to unpack each regular file of an archive, by its name."""
    packed = io.BytesIO(archive.data)
    if kind == "zip":
        zipped = zipfile.ZipFile(packed)
        return {info.filename: partial(_unzip, zipped, info, budget) for info in zipped.infolist() if not info.is_dir()}
    with gzip.open(packed) if kind == "tar.gz" else bz2.open(packed) as stream:
        data = _whole(stream, budget)
    if kind == "bz2":
        return {posixpath.basename(archive.name.replace("\\", "/"))[: -len(".bz2")]: lambda: data}
    tar = tarfile.TarFile(fileobj=io.BytesIO(data))
    return {info.name: partial(_untar, tar, info, budget) for info in tar if info.isfile()}


def _unzip(zipped: zipfile.ZipFile, info: zipfile.ZipInfo, budget: Budget) -> bytes:
    with zipped.open(info) as file:
        return _whole(file, budget)


def _untar(tar: tarfile.TarFile, info: tarfile.TarInfo, budget: Budget) -> bytes:
    file = tar.extractfile(info)
    return b"" if file is None else _whole(file, budget)


def _whole(file: _Readable, budget: Budget) -> bytes:
    """All that a file unpacks to, block by block: what it says of its size is not believed."""
    blocks = []
    while block := file.read(min(BLOCK, budget.left + 1)):
        budget.take(len(block))
        blocks.append(block)
    return b"".join(blocks)
