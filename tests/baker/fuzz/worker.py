"""One process of the fuzzer: broken inputs are read under a bound on memory and time; each line it prints is JSON.

    python -m fuzz.worker SEED FIRST LAST SECONDS FOLDER

`at` is printed before each input: whoever reads the lines knows at which one the process has died.
"""

from __future__ import annotations

import faulthandler
import json
import re
import resource
import shutil
import signal
import sys
import time
import traceback
import warnings
from pathlib import Path
from random import Random

import numpy as np
from fuzz.mutate import mutated
from fuzz.seeds import Seed, seeds

from furbake.asset.inspect import summary
from furbake.asset.owned import strangers
from furbake.asset.read import AssetError, read_asset
from furbake.asset.validate import validate
from furbake.identity import input_hash
from furbake.rti.files import members, read_relit
from furbake.rti.fit import fit_photographs, held_out
from furbake.rti.measured import measure
from furbake.rti.photographs import read_photographs
from furbake.rti.relit import RtiError
from furbake.surface.mesh import MeshError, load_mesh

GIB = 2**30
HANG, BLOCKED = 20, 300
"""Seconds of work in which every input is read or refused, and of waiting, which other work on the machine adds to."""

MOST_FACES, MOST_TEXELS = 2000, 10_000


class BadRefusalError(Exception):
    """A refusal that is none."""


def read(folder: Path, seed: Seed) -> None:
    """Read one input as the command does. Raises what no user should see."""
    if not seed.main:
        validate(folder)
        strangers(folder)
        try:
            summary(read_asset(folder))
        except AssetError as error:
            told(error)
        return
    path = folder / seed.main
    if not path.exists():
        return
    if path.suffix in {".ptm", ".lp"} or path.name == "info.json":
        relight(path)
        return
    input_hash(str(path))
    try:
        load_mesh(path, MOST_FACES)
    except MeshError as error:
        told(error)


def relight(path: Path) -> None:
    """Read and relight, and make a tile of it, as `swatch` and `bake --swatch` do."""
    try:
        members(path)
        if path.suffix == ".lp":
            photographs = read_photographs(path)
            found = fit_photographs(photographs)
            held_out(photographs)
        else:
            found = read_relit(path)
        found.picture(np.array([0.6, -0.3, 0.7]))
        if found.width * found.height < MOST_TEXELS:
            measure(path, 2, 8)
    except (RtiError, MeshError) as error:
        told(error)


def told(error: Exception) -> None:
    """Raises BadRefusalError unless a refusal is one sentence on the file, and not on memory."""
    text = str(error)
    if "\n" in text or "MemoryError" in text or not re.search(r": .+(expected|see furbake validate)", text):
        raise BadRefusalError(text) from error


def write(folder: Path, files: dict[str, bytes]) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for name, data in files.items():
        (folder / name).write_bytes(data)


def say(**line: object) -> None:
    print(json.dumps(line), flush=True)


def bound_memory() -> None:
    """One GiB more of addresses than there are now."""
    pages = int(Path("/proc/self/statm").read_text().split()[0]) if Path("/proc/self/statm").exists() else 0
    if pages:
        limit = pages * resource.getpagesize() + GIB
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))


def main(seed: str, first: int, last: int, seconds: float, folder: Path) -> None:
    warnings.simplefilter("error")
    everything = seeds(folder)
    bound_memory()
    faulthandler.enable()
    faulthandler.register(signal.SIGPROF, chain=True)  # then the signal ends the process
    end = time.monotonic() + seconds
    index = first
    while index < last and time.monotonic() < end:
        chance = Random(f"{seed}/{index}")
        chosen = chance.choice(everything)
        files = mutated(chosen, chance)
        say(at=index, kind=chosen.name)
        write(folder / "input", files)
        faulthandler.dump_traceback_later(BLOCKED, exit=True)
        signal.setitimer(signal.ITIMER_PROF, HANG)
        try:
            read(folder / "input", chosen)
        except Exception:
            say(failed=index, kind=chosen.name, why=traceback.format_exc())
        signal.setitimer(signal.ITIMER_PROF, 0)
        faulthandler.cancel_dump_traceback_later()
        index += 1
    say(next=index, peak=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), float(sys.argv[4]), Path(sys.argv[5]))
