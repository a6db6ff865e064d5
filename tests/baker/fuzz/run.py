"""The fuzzer: processes one after another, each until it dies or has read enough."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

GIB = 2**30

EACH = 5000
"""Inputs of one process."""

HERE = Path(__file__).parents[1]


@dataclass
class Found:
    """Number of inputs, failures (by number, with the reason), largest resident memory in bytes."""

    count: int = 0
    failures: dict[int, str] = field(default_factory=dict)
    peak: int = 0


def run(seed: str, first: int, last: int, seconds: float, folder: Path, say: Callable[[str], None]) -> Found:
    """Read the inputs `first` to `last` of a seed while there is time; what fails is kept in `folder`."""
    found, end = Found(), time.monotonic() + seconds
    at = first
    while at < last and time.monotonic() < end:
        many = min(last, at + EACH)
        command = [sys.executable, "-m", "fuzz.worker", seed, str(at), str(many), str(end - time.monotonic())]
        scratch = folder / "work"
        shutil.rmtree(scratch, ignore_errors=True)
        scratch.mkdir(parents=True)
        with (folder / "stderr").open("w+") as errors:
            process = subprocess.Popen(
                [*command, str(scratch)], stdout=subprocess.PIPE, stderr=errors, text=True, cwd=HERE
            )
            with process:
                assert process.stdout
                began, done = at, False
                for text in process.stdout:
                    line = json.loads(text)
                    at = line.get("at", at)
                    if "failed" in line:
                        keep(found, folder, scratch, line["failed"], f"{line['kind']}: {line['why']}", say)
                    if "next" in line:
                        at, done = line["next"], True
                        found.peak = max(found.peak, line["peak"])
            if not done:
                errors.seek(0)
                why = f"died with {process.returncode}:\n{errors.read()[-3000:]}"
                keep(found, folder, scratch, at, why, say)
                at += 1
            found.count += at - began
    if found.peak > GIB:
        found.failures[-1] = f"peak of {found.peak} bytes, expected at most 1 GiB"
    return found


def keep(found: Found, folder: Path, scratch: Path, number: int, why: str, say: Callable[[str], None]) -> None:
    found.failures[number] = why
    say(f"input {number}: {why}")
    if (scratch / "input").is_dir():
        shutil.copytree(scratch / "input", folder / str(number), dirs_exist_ok=True)
