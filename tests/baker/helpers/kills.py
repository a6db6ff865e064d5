"""Writers of one folder that are killed, watched and let run at once: forks of a process that has imported all.

    python -m helpers.kills WHAT COUNT FOLDER

WHAT is kills, watch or two; the result is one line of JSON.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import time
from collections.abc import Callable
from pathlib import Path
from random import Random

from furbake import BakeOptions, bake
from furbake.asset import store
from furbake.asset.store import StoreError, atomic_folder
from furbake.pelt.hairs.strands import Coat, Hairs

FILES = 12

HAIRS = Hairs(count=12)
TINY = BakeOptions(layers=4, size=8, lights=8, coat=Coat(guard=HAIRS, under=HAIRS, clumps=3))


def write(out: Path, force: bool, seconds: float = 0.002) -> None:
    """Files and a record of them, in the place of a bake."""
    with atomic_folder(out, force) as folder:
        names = [f"plane{i}.png" for i in range(FILES)]
        for name in names:
            (folder / name).write_bytes(bytes(1000))
            time.sleep(seconds / FILES)
        record = {"furbake": "0", "key": "", "asset": {"bytes": dict.fromkeys(names, 1000)}}
        (folder / "bake.json").write_text(json.dumps(record))


def write_bake(out: Path, force: bool) -> None:
    bake("sphere", out, TINY, force=force)


def whole(out: Path) -> bool:
    """True if every file that the record names is there, of its size."""
    sizes = json.loads((out / "bake.json").read_text())["asset"]["bytes"]
    return all((out / name).stat().st_size == size for name, size in sizes.items())


def forked(run: Callable[[], None]) -> int:
    """Number of a process that runs this and ends: 0 done, 1 refused."""
    number = os.fork()
    if number:
        return number
    status = 2
    try:
        run()
        status = 0
    except StoreError as error:
        status = 1 if "\n" not in str(error) else 3
    finally:
        os._exit(status)


def dying(name: str, after: bool) -> None:
    """Let this process be killed at a rename of the store."""
    real = getattr(store, name)

    def kill(*paths: Path) -> object:
        if after:
            real(*paths)
        os.kill(os.getpid(), signal.SIGKILL)
        raise AssertionError

    setattr(store, name, kill)


def kills(count: int, folder: Path, writer: Callable[[Path, bool], None]) -> dict[str, object]:
    """Kill writers at random moments, then `count` / 10 before and after each rename; look at what is left."""
    chance, out, broken, states = Random(count), folder / "out", 0, {"none": 0, "whole": 0}
    began = time.perf_counter()
    writer(out, False)
    usual = time.perf_counter() - began
    moments: list[tuple[str, bool] | None] = [None] * count
    moments += [(name, after) for name in ("move", "swap") for after in (False, True)] * max(count // 10, 1)
    for turn, moment in enumerate(moments):
        force = turn % 2 == 0 if moment is None else moment[0] == "swap"
        if not force and out.exists():
            for path in (*out.iterdir(), out):
                path.rmdir() if path.is_dir() else path.unlink()
        if force and not out.exists():
            writer(out, False)

        def run(moment: tuple[str, bool] | None = moment, force: bool = force) -> None:
            if moment is not None:
                dying(*moment)
            writer(out, force)

        number = forked(run)
        if moment is None:
            time.sleep(usual * chance.uniform(0.0, 1.2))
            os.kill(number, signal.SIGKILL)
        os.waitpid(number, 0)
        there = out.exists()
        states["whole" if there else "none"] += 1
        expected = force or (moment is None and there) or moment == ("move", True)
        broken += there != expected or (there and not whole(out))
    writer(out, True)
    return {"killed": len(moments), "broken": broken, **states, "left": sorted(path.name for path in folder.iterdir())}


def watch(count: int, folder: Path) -> dict[str, object]:
    """Replace a folder while another process looks at it."""
    out = folder / "out"
    write(out, False, 0.0)
    asked, answer = os.pipe(), os.pipe()
    number = os.fork()
    if not number:
        os.set_blocking(asked[0], False)
        looks = misses = 0
        while True:
            try:
                (out / "bake.json").stat()
            except FileNotFoundError:
                misses += not out.is_dir()
            looks += 1
            time.sleep(0.0002)
            try:
                os.read(asked[0], 1)
            except BlockingIOError:
                continue
            os.write(answer[1], json.dumps({"looks": looks, "misses": misses}).encode())
            os._exit(0)
    for _ in range(count):
        write(out, True, 0.0)
    os.write(asked[1], b".")
    found = json.loads(os.read(answer[0], 1000))
    os.waitpid(number, 0)
    return {**found, "left": sorted(path.name for path in folder.iterdir())}


def two(count: int, folder: Path, writer: Callable[[Path, bool], None]) -> dict[str, object]:
    """Let two writers begin at the same moment in a new place, `count` times; how they end."""
    ends = []
    for turn in range(count):
        gate = os.pipe()

        def run(turn: int = turn, gate: tuple[int, int] = gate) -> None:
            os.close(gate[1])
            os.read(gate[0], 1)
            writer(folder / f"out{turn}", False)

        numbers = [forked(run), forked(run)]
        os.close(gate[1])
        ends.append(sorted(os.waitstatus_to_exitcode(os.waitpid(number, 0)[1]) for number in numbers))
        os.close(gate[0])
    return {"ends": ends, "left": sorted(path.name for path in folder.iterdir())}


def main(what: str, count: int, folder: Path, real: bool) -> dict[str, object]:
    writer = write_bake if real else write
    if what == "watch":
        return watch(count, folder)
    return (kills if what == "kills" else two)(count, folder, writer)


if __name__ == "__main__":
    print(json.dumps(main(sys.argv[1], int(sys.argv[2]), Path(sys.argv[3]), "bakes" in sys.argv)))
