"""Files that are read: regular ones of a bounded size, and beside a model only what lies in its own folder."""

from __future__ import annotations

import errno
import json
import os
import posixpath
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, BinaryIO

from furbake.surface.limits import Budget, Budgets
from furbake.surface.soup import MeshError


class Source:
    """A model's bytes, and those of the files that it names, all within the bounds of one model.

    name : the path as given, with that in an archive; data : the model's own bytes
    fetch : bytes of a file by the name that the model gives it
    """

    def __init__(self, name: str, data: bytes, fetch: Callable[[str], bytes], budgets: Budgets) -> None:
        self.name, self.data, self.budgets = name, data, budgets
        self._fetch = fetch
        self._found: dict[str, bytes] = {}
        budgets.took(data)

    def read(self, name: str) -> bytes:
        """Bytes of a file that the model names. Raises OSError, or MeshError where it is too large."""
        if name not in self._found:
            self._found[name] = self._fetch(name)
            self.budgets.took(self._found[name])
        return self._found[name]

    def find(self, name: str) -> bytes:
        """The same for a name that another machine may have given: as it is, from the model's folder, or bare."""
        first, *others = nearby(name)
        try:
            return self.read(first)
        except OSError:
            for other in others:
                with suppress(OSError):
                    return self.read(other)
            raise


def nearby(name: str) -> tuple[str, str, str]:
    """Places beside a model where a file may lie that was named on another machine."""
    plain = name.strip().replace("\\", "/")
    return plain, plain.lstrip("/"), posixpath.basename(plain)


def source(path: Path) -> Source:
    """A model on the disk. Raises OSError, or MeshError where it is too large."""
    budgets = Budgets(str(path))
    data = read_regular(path, budgets.bytes)
    return Source(str(path), data, lambda name: read_regular(beside(path, name), budgets.bytes), budgets)


def beside(model: Path, name: str) -> Path:
    """Path of a file that a model names. Raises PermissionError where it lies outside the model's own folder."""
    folder, plain = Path(os.path.realpath(model.parent)), name.replace("\\", "/")
    if Path(plain).is_absolute() or not Path(os.path.realpath(folder / plain)).is_relative_to(folder):
        raise PermissionError(errno.EACCES, "names a file outside its folder", name)
    return model.parent / plain


def read_regular(path: Path, budget: Budget) -> bytes:
    """Bytes of a regular file. Raises OSError where it is none, MeshError where more is in it than the budget has."""
    with _regular(path, budget) as (file, size):
        data = file.read(size + 1)
    if len(data) > size:
        raise OSError(errno.EINVAL, "is no regular file, or one that grows", str(path))
    return data


def check_regular(path: Path, budget: Budget) -> None:
    """Raise what `read_regular` does, before a library opens the file by its name."""
    with _regular(path, budget):
        pass


def read_text(path: Path, expected: str) -> str:
    """Text of a file that an option names. Raises MeshError, which ends with what was expected, or ValueError."""
    try:
        return read_regular(path, Budget(str(path), "bytes")).decode("utf-8")
    except OSError as error:
        raise MeshError(f"{path}: {(error.strerror or 'cannot be read').lower()}, {expected}") from error


def read_records(path: Path, name: str, expected: str) -> dict[str, Any]:
    """The object in a JSON file that an option names, which has a list by this name.

    Raises MeshError, which ends with what was expected.
    """
    try:
        found = json.loads(read_text(path, expected))
    except MeshError:
        raise
    except (ValueError, RecursionError) as error:
        raise MeshError(f"{path}: not JSON ({str(error).splitlines()[0]}), {expected}") from error
    if not isinstance(found, dict) or not isinstance(found.get(name), list):
        raise MeshError(f"{path}: no list of {name}, {expected}")
    return found


@contextmanager
def _regular(path: Path, budget: Budget) -> Iterator[tuple[BinaryIO, int]]:
    """A regular file and its size in bytes, taken from the budget."""
    # Without O_NONBLOCK the mere opening of a pipe waits for a writer.
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0) | getattr(os, "O_CLOEXEC", 0)
    with os.fdopen(os.open(path, flags), "rb") as file:
        found = os.fstat(file.fileno())
        if not stat.S_ISREG(found.st_mode):
            raise OSError(errno.EINVAL, "is no regular file", str(path))
        budget.take(found.st_size)
        yield file, found.st_size
