"""Many bakes, killed and resumed, are those that would be made one by one; `FURBAKE_TEST_ALL=1` makes 40 of them."""

from __future__ import annotations

import json
import os
import signal
import sys
import time
from collections.abc import Callable
from pathlib import Path
from random import Random
from threading import Thread
from typing import Any

import pytest

from furbake import preset
from furbake.apart import Apart, CrashError
from furbake.batch.crew import LocalCrew, MemoryShortError
from furbake.batch.job import Job, bake_apart
from furbake.batch.journal import Entry, journal
from helpers.batches import SETTINGS, contents, family, models, one_by_one, started, watched

ALL = os.environ.get("FURBAKE_TEST_ALL") == "1"

GOOD, BAD, KILLS = (34, 6, 20) if ALL else (2, 1, 1)
MEMORY = 900e6


@pytest.mark.skipif(sys.platform != "linux", reason="memory is read from /proc")
def test_killed_and_resumed_batches_are_those_of_one_by_one(tmp_path: Path) -> None:
    made = models(tmp_path / "models", GOOD, BAD)
    expected = one_by_one(made, tmp_path / "one")
    assert len(expected) == GOOD
    chance, most, killed = Random(7), 0, 0
    out = tmp_path / "out"
    for _ in range(KILLS):
        batch = started(tmp_path / "models", "-o", out, "--jobs", 2, "--memory", f"{MEMORY:.0f}")
        done, held = watched(batch, chance.uniform(1.0, 6.0 if ALL else 3.0))
        batch.communicate()
        killed += not done
        most = max(most, held)
    batch = started(tmp_path / "models", "-o", out, "--jobs", 2, "--memory", f"{MEMORY:.0f}")
    done, held = watched(batch, 600)
    *rows, summary = map(json.loads, batch.communicate()[0].splitlines())
    assert killed > 0
    assert max(most, held) <= MEMORY
    assert contents(out) == expected
    assert batch.returncode == 1
    assert (summary["failed"], summary["baked"] + summary["fresh"]) == (BAD, GOOD)
    failed = {row["name"]: row["error"] for row in rows if row["status"] == "failed"}
    assert sorted(failed) == sorted(model.stem for model in made[GOOD:])
    assert all(name in text and "expected" in text and "\n" not in text for name, text in failed.items())
    assert sorted(path.name for path in out.iterdir()) == sorted([*expected, "batch.jsonl", "index.html"])
    page = (out / "index.html").read_text()
    assert page.count("<img ") == GOOD
    assert page.count('class="failed"') == BAD
    print(f"killed {killed} times, at most {max(most, held) / 1e6:.0f} MB of {MEMORY / 1e6:.0f}")


def test_too_little_memory_is_a_sentence(run: Callable[..., Any], tmp_path: Path) -> None:
    done = run("batch", "plane", "-o", tmp_path / "out", "--memory", "20M", "--no-cache", *SETTINGS)
    assert done.status == 1
    bound = "a bound of 20 MB for bakes and command together"
    assert done.err == f"furbake: error: plane: memory: got {bound}, expected more for this bake\n"
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["batch.jsonl", "index.html"]


def test_a_bake_beyond_the_bound_comes_later(tmp_path: Path) -> None:
    crew = LocalCrew(2, 10**12)
    jobs = [Job(name, "plane", preset("paper"), tmp_path / name) for name in "ab"]
    for job in jobs:
        assert crew.room(job)
        crew.start(job)
    crew.bound = 1
    seen = []
    while crew.running:
        event = crew.next()
        if event is not None and event.kind != "step":
            seen.append((event.kind, event.job.name, type(event.value)))
    assert seen == [("again", "b", type(None)), ("done", "a", MemoryShortError)]
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="signals of POSIX")
def test_a_killed_bake_leaves_a_sentence_and_nothing_else(tmp_path: Path) -> None:
    job = Job("plane", "plane", preset("paper"), tmp_path / "plane")

    def killed(process: Apart) -> None:
        Thread(target=lambda: (wait_for(tmp_path), process.process.kill())).start()

    with pytest.raises(CrashError, match="SIGKILL"):
        bake_apart(job, own=killed)
    assert list(tmp_path.iterdir()) == []


def wait_for(folder: Path) -> None:
    """Until something is written there."""
    while not any(path.suffix == ".part" for path in folder.iterdir()):
        time.sleep(0.01)


@pytest.mark.skipif(sys.platform != "linux", reason="processes are read from /proc")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_batch_says_how_to_go_on(tmp_path: Path, number: signal.Signals) -> None:
    out = tmp_path / "out"
    batch = started("plane", "torus:8x8", "-o", out, "--jobs", 1)
    assert batch.stdout is not None
    assert json.loads(batch.stdout.readline())["status"] == "baked"
    below = family(batch.pid)
    batch.send_signal(number)
    _, err = batch.communicate()
    assert batch.returncode == 130
    assert err == "furbake: interrupted: 1 of 2 are done, the same command goes on from there\n"
    assert not any(Path(f"/proc/{number}").exists() for number in below)
    assert sorted(path.name for path in out.iterdir()) == ["batch.jsonl", "index.html", "plane"]
    assert "stopped: 1 of 2 models" in (out / "index.html").read_text("utf-8")


def test_a_log_of_somebody_else_is_left(run: Callable[..., Any], tmp_path: Path) -> None:
    log = tmp_path / "batch.jsonl"
    log.write_text('{"my": "log"}\n')
    done = run("batch", "plane", "-o", tmp_path)
    assert done.status == 2
    assert done.err == f"furbake: error: {log}: not written by furbake batch, expected a folder without it\n"
    assert log.read_text() == '{"my": "log"}\n'
    # Cut off in its first line, as by a kill.
    log.write_text('{"na')
    with journal(tmp_path) as ours:
        assert ours.entries == {}


def test_two_batches_do_not_share_a_folder(run: Callable[..., Any], tmp_path: Path) -> None:
    with journal(tmp_path / "out"):
        done = run("batch", "plane", "-o", tmp_path / "out")
    assert done.status == 2
    assert done.err == (
        f"furbake: error: {tmp_path / 'out'}: is being written by another process, expected to be alone there\n"
    )


def test_a_journal_that_was_cut_off_is_read(tmp_path: Path) -> None:
    with journal(tmp_path) as log:
        log.add(Entry("a", key="1", seconds=2.0))
        log.add(Entry("a", key="2", seconds=3.0))
        log.add(Entry("b", error="no"))
    text = (tmp_path / "batch.jsonl").read_bytes()
    (tmp_path / "batch.jsonl").write_bytes(text[:-9])
    with journal(tmp_path) as log:
        assert log.entries == {"a": Entry("a", key="2", seconds=3.0)}
        log.add(Entry("c"))
    with journal(tmp_path) as log:
        assert sorted(log.entries) == ["a", "c"]
