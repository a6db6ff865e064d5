"""Folders and files that appear whole or not at all, whenever the process that writes them stops.

Everything is written to a hidden sibling, `.NAME.PID-xxxxxxxx.part`, then renamed once. What a killed process leaves
behind is cleared away at the next bake to the same place.
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

MARKS = ("bake.json", "model.gltf")
"""A folder that holds one of these is a bake, whatever else somebody put in it."""


class StoreError(OSError):
    """A place that cannot be written; the message names it, what was got and what was expected."""


@contextmanager
def atomic_folder(target: Path, force: bool = False) -> Iterator[Path]:
    """A new empty folder to write in, which becomes `target` when the block ends, and vanishes when it fails.

    force : replace an old `target`, which stays untouched until the new one is complete. A folder that can't be a
        bake is never replaced: one with folders in it, the current one, the home folder

    Raises StoreError before the block where `target` cannot be written, after it where the rename fails.
    """
    name, target = str(target), Path(os.path.realpath(target))
    made = _make_parents(name, target.parent)
    try:
        _recover(target)
        check_free(target, force, name)
        fresh = _sibling(target, "part")
        with _told(name, "expected a folder that can be written"):
            fresh.mkdir()
        try:
            yield fresh
            with _told(name, "expected a folder that can be written"):
                _replace(fresh, target)
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

    Raises StoreError where it cannot be written.
    """
    name, target = str(target), Path(os.path.realpath(target))
    if target.is_dir():
        raise StoreError(f"{name}: is a folder, expected a file to write")
    _recover(target)
    fresh = _sibling(target, "part")
    try:
        with _told(name, "expected a file that can be written"):
            file = fresh.open("xb")
        with file:
            yield file
        with _told(name, "expected a file that can be written"):
            fresh.replace(target)
    finally:
        fresh.unlink(missing_ok=True)


def check_free(target: Path, force: bool, name: str | None = None) -> None:
    """Raise StoreError unless a bake may be written to `target`."""
    name = name or str(target)
    if not os.path.lexists(target):
        return
    if not target.is_dir():
        raise StoreError(f"{name}: is a file, expected a new folder")
    if not force:
        raise StoreError(f"{name}: exists already, expected a new folder (or --force to replace it)")
    here = Path(os.path.realpath(target))
    if here in (Path.cwd(), *Path.cwd().parents, Path.home()):
        raise StoreError(f"{name}: is the current folder, one above it or the home folder, expected one to replace")
    with _told(name, "expected a folder that can be read"):
        folders = sorted(entry.name for entry in target.iterdir() if entry.is_dir())
        baked = any((target / mark).exists() for mark in MARKS)
    if folders and not baked:
        raise StoreError(f"{name}: holds the folder {folders[0]} and is no bake, expected a bake to replace")


def _replace(fresh: Path, target: Path) -> None:
    """Rename `fresh` to `target`; an old target is set aside first, and put back if that fails."""
    if not target.exists():
        fresh.rename(target)
        return
    old = _sibling(target, "old")
    target.rename(old)
    try:
        fresh.rename(target)
    except BaseException:
        old.rename(target)
        raise
    shutil.rmtree(old, ignore_errors=True)


def _recover(target: Path) -> None:
    """Clear away what killed processes left beside `target`; an old folder that they had set aside comes back."""
    pattern = re.compile(rf"\.{re.escape(target.name)}\.(\d+)-[0-9a-f]{{8}}\.(part|old)")
    with suppress(OSError):
        for entry in sorted(target.parent.iterdir()):
            match = pattern.fullmatch(entry.name)
            if not match or _alive(int(match[1])):
                continue
            if match[2] == "old" and not os.path.lexists(target):
                entry.rename(target)
            elif entry.is_dir() and not entry.is_symlink():
                shutil.rmtree(entry, ignore_errors=True)
            else:
                entry.unlink()


def _alive(pid: int) -> bool:
    """Whether a process runs. Where the system gives no harmless way to ask, the answer is yes."""
    if os.name != "posix":
        return True
    try:
        os.kill(pid, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except PermissionError:
        return True
    return True


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
    """Turns what the system says into one sentence."""
    try:
        yield
    except OSError as error:
        text = (error.strerror or str(error) or type(error).__name__).lower()
        raise StoreError(f"{name}: {text}, {expected}") from error
