"""Folders and files that appear whole or not at all, whenever the process that writes them stops.

Everything is written to a hidden sibling, `.NAME.PID-xxxxxxxx.part`, then renamed once; where something is replaced,
the two change places in one step, so that a reader finds the old or the new at any moment.

Whoever writes holds the lock of the hidden sibling `.NAME.lock`, which the system gives back when a process dies. So
all that lies beside a free lock is left by the dead, whatever its number, and is cleared away by the next to write.
"""

from __future__ import annotations

import os
import re
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from filelock import FileLock, Timeout

from furbake.asset.exchange import move, swap
from furbake.asset.owned import strangers

PATIENCE = 0.2
"""Seconds in which another process may give a lock back; it is gone between two looks where that one just ends."""

NAMED = 5
"""Names that a message lists at the most."""


class StoreError(OSError):
    """A place that cannot be written; the message names it, what was got and what was expected."""


class BusyError(StoreError):
    """A place that another process is writing."""


@contextmanager
def atomic_folder(target: Path, force: bool | None = False) -> Iterator[Path]:
    """A new empty folder to write in, which becomes `target` when the block ends, and vanishes when it fails.

    force : replace an old `target` that furbake wrote, and nothing else: it stays untouched until the new one is
        complete, and then both change places; None: no, and there is no --force to name

    Raises StoreError before the block where `target` cannot be written or is being written by another process, after
    it where it has appeared meanwhile or the rename fails.
    """
    name, target = str(target), Path(os.path.realpath(target))
    check_free(target, force, name)
    made = _make_parents(name, target.parent)
    try:
        with _locked(name, target):
            check_free(target, force, name)
            fresh = _sibling(target, "part")
            with _told(name, "expected a folder that can be written"):
                fresh.mkdir()
            try:
                yield fresh
                with _told(name, "expected a folder that can be written"):
                    _place(fresh, target, force, name)
            finally:
                shutil.rmtree(fresh, ignore_errors=True)
    except BaseException:
        for folder in reversed(made):
            with suppress(OSError):
                folder.rmdir()
        raise


@contextmanager
def atomic_file(target: Path) -> Iterator[BinaryIO]:
    """An open file that becomes `target`, replacing it, when the block ends, and vanishes when it fails.

    Raises StoreError where it cannot be written or is being written by another process.
    """
    name, target = str(target), Path(os.path.realpath(target))
    if target.is_dir():
        raise StoreError(f"{name}: is a folder, expected a file to write")
    fresh = _sibling(target, "part")
    with _locked(name, target, "expected a file that can be written"):
        try:
            with _told(name, "expected a file that can be written"):
                file = fresh.open("xb")
            with file:
                yield file
            with _told(name, "expected a file that can be written"):
                fresh.replace(target)
        finally:
            fresh.unlink(missing_ok=True)


def check_folder(folder: Path) -> None:
    """Raise StoreError unless `folder` is one or can be made, which is tried."""
    if folder.exists() and not folder.is_dir():
        raise StoreError(f"{folder}: is a file, expected a folder")
    for made in reversed(_make_parents(str(folder), folder)):
        with suppress(OSError):  # another process has begun to use it
            made.rmdir()


@contextmanager
def alone(target: Path) -> Iterator[None]:
    """Hold the lock of `target`, a file to be written bit by bit, in a folder that is made where it is missing.

    Raises StoreError where the folder cannot be written, and where another process holds the lock.
    """
    _make_parents(str(target.parent), target.parent)
    with _locked(str(target.parent), target):
        yield


def clear(target: Path) -> None:
    """Clear away what a killed writer of `target` left, unless another process is writing it."""
    target = Path(os.path.realpath(target))
    with suppress(StoreError), _locked(str(target), target):
        pass


def check_free(target: Path, force: bool | None, name: str | None = None) -> None:
    """Raise StoreError unless a bake may be written to `target`; with `force` that may hold what furbake wrote."""
    name = name or str(target)
    if not os.path.lexists(target):
        return
    if not target.is_dir():
        raise StoreError(f"{name}: is a file, expected a new folder")
    if not force:
        other = "" if force is None else " (or --force to replace it)"
        raise StoreError(f"{name}: exists already, expected a new folder{other}")
    here = Path(os.path.realpath(target))
    if here in (Path.cwd(), *Path.cwd().parents, Path.home()):
        raise StoreError(f"{name}: is the current folder, one above it or the home folder, expected one to replace")
    with _told(name, "expected a folder that can be read"):
        _check_own(target, name)


def _check_own(folder: Path, name: str) -> None:
    """Raise StoreError where a folder holds anything that furbake did not write."""
    lost = strangers(folder)
    if lost:
        more = f" and {len(lost) - NAMED} more" if len(lost) > NAMED else ""
        what = ", ".join(lost[:NAMED])
        raise StoreError(f"{name}: holds {what}{more}, not written by furbake, expected nothing beside a bake")


def _place(fresh: Path, target: Path, force: bool | None, name: str) -> None:
    """Rename `fresh` to `target`, looked at once more; afterwards `fresh` is the old folder, if there was one."""
    if not os.path.lexists(target):
        with suppress(FileExistsError):
            move(fresh, target)
            return
    check_free(target, force, name)
    if swap(fresh, target):
        try:
            _check_own(fresh, name)
        except BaseException:
            swap(fresh, target)
            raise
        return
    old = _sibling(target, "old")
    target.rename(old)
    try:
        _check_own(old, name)
        fresh.rename(target)
    except BaseException:
        old.rename(target)
        raise
    shutil.rmtree(old, ignore_errors=True)


@contextmanager
def _locked(name: str, target: Path, expected: str = "expected a folder that can be written") -> Iterator[None]:
    """Hold the lock of `target`, where what others left is cleared away first.

    Raises StoreError where another process, or another part of this one, holds it.
    """
    lock = FileLock(target.with_name(f".{target.name}.lock"), timeout=PATIENCE, is_singleton=False)
    with _told(name, expected):
        target.parent.stat()  # the library would create the folder
        try:
            lock.acquire()
        except Timeout:
            raise BusyError(f"{name}: is being written by another process, expected to be alone there") from None
    try:
        _recover(target)
        yield
    finally:
        with suppress(OSError):  # while it is held: nobody else can come by a lock on a file without a name
            Path(lock.lock_file).unlink()
        lock.release()


def _recover(target: Path) -> None:
    """Clear away what dead processes left beside `target`; an old folder that they had set aside comes back.

    Call it under the lock alone: then no living process owns any of it.
    """
    pattern = re.compile(rf"\.{re.escape(target.name)}\.\d+-[0-9a-f]{{8}}\.(part|old)")
    with suppress(OSError):
        for entry in sorted(target.parent.iterdir()):
            match = pattern.fullmatch(entry.name)
            if not match:
                continue
            if match[1] == "old" and not os.path.lexists(target):
                entry.rename(target)
            elif entry.is_dir() and not entry.is_symlink():
                shutil.rmtree(entry, ignore_errors=True)
            else:
                entry.unlink()


def _sibling(target: Path, kind: str) -> Path:
    return target.with_name(f".{target.name}.{os.getpid()}-{secrets.token_hex(4)}.{kind}")


def _make_parents(name: str, parent: Path) -> list[Path]:
    """Create what is missing of `parent`; the folders that were created, outermost first."""
    missing = [folder for folder in (parent, *parent.parents) if not folder.exists()]
    made: list[Path] = []
    try:
        with _told(name, "expected a folder that can be written"):
            for folder in reversed(missing):
                folder.mkdir()
                made.append(folder)
    except StoreError:
        for folder in reversed(made):
            folder.rmdir()
        raise
    return made


@contextmanager
def _told(name: str, expected: str) -> Iterator[None]:
    """Turn an error of the system into one sentence."""
    try:
        yield
    except StoreError:
        raise
    except OSError as error:
        text = (error.strerror or str(error) or type(error).__name__).lower()
        raise StoreError(f"{name}: {text}, {expected}") from error
