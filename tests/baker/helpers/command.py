"""Builders shared by tests of command."""

from __future__ import annotations

from pathlib import Path

TINY = ("--layers", "4", "--size", "8", "--lights", "8")


CUBE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


def files(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def listed() -> list[str]:
    return sorted(path.name for path in Path().iterdir())
