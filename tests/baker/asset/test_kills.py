"""Writers that are killed, watched and let run at once; `FURBAKE_TEST_ALL=1` makes 100 real bakes of them."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from furbake.asset.exchange import swap

ALL = os.environ.get("FURBAKE_TEST_ALL") == "1"

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="writers are forks")


def result(what: str, count: int, folder: Path) -> Any:
    folder.mkdir()
    command = [sys.executable, "-m", "helpers.kills", what, str(count), str(folder), *(["bakes"] if ALL else [])]
    done = subprocess.run(command, cwd=Path(__file__).parents[1], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


@pytest.fixture
def exchange(tmp_path: Path) -> None:
    for name in "ab":
        (tmp_path / name).mkdir()
    if not swap(tmp_path / "a", tmp_path / "b"):
        pytest.skip("this system cannot exchange folders")


@pytest.mark.usefixtures("exchange")
def test_killed_writers_leave_the_old_or_the_new_whole(tmp_path: Path) -> None:
    found = result("kills", 100 if ALL else 10, tmp_path / "kills")
    assert found["broken"] == 0, found
    assert found["left"] == ["out"]
    assert min(found["none"], found["whole"]) > 0, "some are killed before, some after"


@pytest.mark.usefixtures("exchange")
def test_a_watcher_never_misses_the_folder(tmp_path: Path) -> None:
    found = result("watch", 100, tmp_path / "watch")
    assert found["misses"] == 0
    assert found["looks"] > 0
    assert found["left"] == ["out"]


def test_of_two_writers_at_once_one_is_refused(tmp_path: Path) -> None:
    times = 10 if ALL else 3
    found = result("two", times, tmp_path / "two")
    assert found["ends"] == [[0, 1]] * times, "one done, one refused"
    assert len(found["left"]) == times
