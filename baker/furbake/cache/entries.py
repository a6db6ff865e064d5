"""A folder of entries, a file each, that any number of bakes read and write at once.

An entry is written under a name of its own and renamed: it is there whole or not at all, also where its writer is
killed. What cannot be read is missing, what cannot be written is left out: a cache stops no bake. Entries that were
not used for longest go first when the folder holds more than it may.
"""

from __future__ import annotations

import os
import time
import zlib
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any
from zipfile import BadZipFile

import numpy as np

from furbake.cache.trees import packed, unpacked

MAX_BYTES = 2**29
"""Bytes of all entries together, 512 MiB: a hundred pelts with their images."""

LEFT = 3600.0
"""Seconds after which an unfinished file is that of a bake that was killed."""

ENTRY, UNFINISHED = ".npz", ".part"


@dataclass(frozen=True)
class Cache:
    """folder : made when it is first written to; max_bytes : of all entries in it; classes : that entries may hold."""

    folder: Path
    classes: tuple[type, ...]
    max_bytes: int = MAX_BYTES

    def get(self, key: str) -> Any | None:
        """The value under this key; None where there is none, or the file is not what was written."""
        path = self.folder / f"{key}{ENTRY}"
        try:
            with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
                value = unpacked(dict(archive), self.classes)
            os.utime(path)
        except (OSError, ValueError, TypeError, LookupError, EOFError, BadZipFile, zlib.error, NotImplementedError):
            return None
        return value

    def put(self, key: str, value: Any) -> None:
        """Keep what `packed` takes, in place of what there is under this key."""
        with suppress(OSError):
            self.folder.mkdir(parents=True, exist_ok=True)
            with NamedTemporaryFile(dir=self.folder, suffix=UNFINISHED, delete=False) as file:
                unfinished = Path(file.name)
                try:
                    np.savez(file, allow_pickle=False, **packed(value))
                    file.close()
                    unfinished.replace(self.folder / f"{key}{ENTRY}")
                finally:
                    unfinished.unlink(missing_ok=True)
            self._trim()

    def _trim(self) -> None:
        """Remove what is too much, and what killed bakes left."""
        entries = sorted(_known(self.folder.glob(f"*{ENTRY}")), reverse=True)
        total = 0
        for _, size, path in entries:
            total += size
            if total > self.max_bytes:
                path.unlink(missing_ok=True)
        for used, _, path in _known(self.folder.glob(f"*{UNFINISHED}")):
            if used < time.time() - LEFT:
                path.unlink(missing_ok=True)


def _known(paths: Iterable[Path]) -> list[tuple[float, int, Path]]:
    """When each file was last used, its bytes, and its path; without those that another bake has removed."""
    found = []
    for path in paths:
        with suppress(OSError):
            stat = path.stat()
            found.append((stat.st_mtime, stat.st_size, path))
    return found
