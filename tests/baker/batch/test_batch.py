"""Many bakes, killed and resumed, are those that would be made one by one; `FURBAKE_TEST_ALL=1` makes 40 of them."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from random import Random

import pytest

from helpers.batches import contents, models, one_by_one, started, watched

ALL = os.environ.get("FURBAKE_TEST_ALL") == "1"

GOOD, BAD, KILLS = (34, 6, 20) if ALL else (3, 1, 1)
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
