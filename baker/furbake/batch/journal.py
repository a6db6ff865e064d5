"""Record of a batch so far: a line for each bake that has ended, beside the folders that it wrote."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import IO

from furbake.asset.store import StoreError, alone, atomic_file

NAME = "batch.jsonl"

BEGINNING = b'{"name": "'
"""Beginning of every line."""


@dataclass(frozen=True)
class Entry:
    """How a bake ended.

    key : of its result, as in `bake.json`; empty where it failed
    seconds, memory : that it took, bytes at most; 0 where that is not known
    error : why it failed; picture : data URI
    """

    name: str
    key: str = ""
    seconds: float = 0.0
    memory: int = 0
    error: str = ""
    picture: str = ""


@dataclass
class Journal:
    """The entries of a folder, the latest of each name; a line that was cut off by a kill is none."""

    entries: dict[str, Entry]
    file: IO[bytes]

    def add(self, entry: Entry) -> None:
        self.entries[entry.name] = entry
        self.file.write(_line(entry))
        self.file.flush()


@contextmanager
def journal(out: Path) -> Iterator[Journal]:
    """The journal of a folder, for one batch alone. Raises StoreError where another has it, or it cannot be written."""
    place = out / NAME
    with alone(out / "batch"):
        _check(place)
        entries = {entry.name: entry for entry in _read(place)}
        with atomic_file(place) as whole:
            whole.writelines(map(_line, entries.values()))
        with place.open("ab") as file:
            yield Journal(entries, file)


def _check(place: Path) -> None:
    """Raise StoreError for a file with lines of somebody else; one that a kill has cut off is ours."""
    lines = place.read_bytes().splitlines() if place.exists() else []
    if any(line and not (line.startswith(BEGINNING) or BEGINNING.startswith(line)) for line in lines):
        raise StoreError(f"{place}: not written by furbake batch, expected a folder without it")


def _line(entry: Entry) -> bytes:
    return json.dumps(asdict(entry)).encode() + b"\n"


def _read(place: Path) -> Iterator[Entry]:
    if not place.exists():
        return
    for line in place.read_bytes().splitlines():
        try:
            yield Entry(**json.loads(line))
        except (ValueError, TypeError):
            continue
