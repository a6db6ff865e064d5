"""Folders that `furbake` wrote, told from all others by their own record: only such a folder is ever replaced."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

from furbake.surface.files import read_regular
from furbake.surface.limits import Budget

RECORDS = {"bake.json": ("asset", "bytes"), "lesson.json": ("bytes",)}
"""Record of each kind of folder, and where it lists the folder's other files."""

REPORT, REPORT_MARK = "report.html", "<footer>Written by furbake "
"""Page that `furbake report` adds to a bake, and the words by which it is told from a page of somebody else."""

TAIL = 500
"""Bytes at the end of a report in which its mark stands."""

LEFTOVER = re.compile(r"\.report\.html\.(\d+-[0-9a-f]{8}\.part|lock)")
"""Files that a killed `furbake report` leaves."""

OF_SYSTEMS = frozenset({".DS_Store", "Thumbs.db", "desktop.ini"})
"""Files that desktops put into any folder that is looked at."""


def strangers(folder: Path) -> list[str]:
    """Names of all in a folder that furbake did not write and that would be lost with it. Raises OSError."""
    known = OF_SYSTEMS | _recorded(folder)
    return sorted(
        entry.name
        for entry in folder.iterdir()
        if entry.is_symlink() or not entry.is_file() or not (entry.name in known or _of_report(entry))
    )


def _recorded(folder: Path) -> set[str]:
    """The records of a folder that carry furbake's mark, and the files that they name."""
    known: set[str] = set()
    for name, keys in RECORDS.items():
        try:
            found: Any = json.loads(read_regular(folder / name, Budget(name, "bytes")).decode("utf-8"))
            marked = isinstance(found["furbake"], str) and isinstance(found["key"], str)
            for key in keys:
                found = found[key]
            files = set(found)
        except (OSError, ValueError, LookupError, TypeError, RecursionError):
            continue
        if marked and isinstance(found, dict):
            known |= {name, *files}
    return known


def _of_report(path: Path) -> bool:
    """True if a file is a report, or a leftover of one."""
    if path.name != REPORT:
        return LEFTOVER.fullmatch(path.name) is not None
    with path.open("rb") as file:
        file.seek(max(path.stat().st_size - TAIL, 0))
        return REPORT_MARK.encode() in file.read()
