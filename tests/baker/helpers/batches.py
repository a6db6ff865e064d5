"""Models for batches, and batches that run in processes of their own."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from furbake import cli

TINY = ("layers=4", "size=8", "lights=8", "coat.guard.count=12", "coat.under.count=12")
SETTINGS = tuple(part for knob in TINY for part in ("--set", knob))

BROKEN = ("", "v 0 0 0\nf 1 2 9\n", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "no mesh at all\n")
"""Files that are no models."""


def models(folder: Path, good: int, bad: int) -> list[Path]:
    """Tetrahedra, octahedra and bumpy balls, and files that are none, in turn."""
    folder.mkdir()
    chance = np.random.default_rng(3)
    made = []
    for number in range(good):
        rows, columns = 4 + number % 5, 6 + number % 7
        made.append(folder / f"ball{number:02}.obj")
        made[-1].write_text(ball(rows, columns, chance))
    for number in range(bad):
        made.append(folder / f"bad{number:02}.obj")
        made[-1].write_text(BROKEN[number % len(BROKEN)])
    return made


def ball(rows: int, columns: int, chance: np.random.Generator) -> str:
    """A closed ball with noise, as .obj."""
    lines = ["v 0 0 1"]
    for row in range(1, rows):
        for column in range(columns):
            up, round_ = np.pi * row / rows, 2 * np.pi * column / columns
            place = np.array([np.sin(up) * np.cos(round_), np.sin(up) * np.sin(round_), np.cos(up)])
            lines.append("v {} {} {}".format(*(place * chance.uniform(0.9, 1.1))))
    lines.append("v 0 0 -1")
    last = (rows - 1) * columns + 2

    def at(row: int, column: int) -> int:
        return 2 + row * columns + column % columns

    for column in range(columns):
        lines.append(f"f 1 {at(0, column)} {at(0, column + 1)}")
        for row in range(rows - 2):
            a, b, c, d = at(row, column), at(row, column + 1), at(row + 1, column), at(row + 1, column + 1)
            lines += [f"f {a} {c} {d}", f"f {a} {d} {b}"]
        lines.append(f"f {last} {at(rows - 2, column + 1)} {at(rows - 2, column)}")
    return "\n".join(lines) + "\n"


def contents(out: Path) -> dict[str, dict[str, bytes]]:
    """Files of each baked folder."""
    return {
        folder.name: {path.name: path.read_bytes() for path in folder.iterdir()}
        for folder in sorted(out.iterdir())
        if folder.is_dir()
    }


def one_by_one(made: Sequence[Path], out: Path, *options: object) -> dict[str, dict[str, bytes]]:
    """Folders that `furbake bake` writes of each; none of those that it refuses."""
    out.mkdir()
    for model in made:
        given = [str(option) for option in options]
        cli.main(["bake", str(model), "-o", str(out / model.stem), *SETTINGS, *given, "--quiet", "--no-cache"])
    return contents(out)


def started(*arguments: object, **more: str) -> subprocess.Popen[str]:
    """A batch in a process of its own, in a group of its own."""
    command = [sys.executable, "-m", "furbake.cli", "batch", *map(str, arguments), *SETTINGS, "--no-cache", "--json"]
    return subprocess.Popen(  # noqa: S603 — this interpreter
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
        env=os.environ | more,
    )  # fmt: skip


def family(number: int) -> list[int]:
    """A process and all below it, by the system's own list."""
    below: dict[int, list[int]] = {}
    for entry in Path("/proc").iterdir():
        try:
            text = (entry / "stat").read_text() if entry.name.isdecimal() else ""
        except OSError:
            continue
        if text:
            below.setdefault(int(text.rpartition(")")[2].split()[1]), []).append(int(entry.name))
    found = [number]
    for one in found:
        found += below.get(one, [])
    return found


def resident(number: int) -> int:
    """Bytes that a process and all below it hold."""
    total = 0
    for one in family(number):
        try:
            total += int(Path(f"/proc/{one}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
        except (OSError, IndexError):
            continue
    return total


def watched(batch: subprocess.Popen[str], until: float) -> tuple[bool, int]:
    """Kill a batch alone, not those below it, when its time is over; whether it had ended, and the most bytes."""
    end, most = time.monotonic() + until, 0
    while time.monotonic() < end:
        most = max(most, resident(batch.pid))
        if batch.poll() is not None:
            return True, most
        time.sleep(0.04)
    os.kill(batch.pid, signal.SIGKILL)
    batch.wait()
    return False, most
