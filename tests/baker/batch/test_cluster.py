"""Bakes on workers of Dask: the same bytes as here, also where a worker is killed. `FURBAKE_TEST_ALL=1` kills ten."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

import pytest

from furbake.cluster.versions import ClusterError, compare, versions
from helpers.batches import contents, models, one_by_one, started
from helpers.command import TINY, files
from helpers.workers import workers

ALL = os.environ.get("FURBAKE_TEST_ALL") == "1"

whole = pytest.mark.skipif(not ALL, reason="takes minutes: npm test -- --all")

QUIET = ("--no-cache", "--quiet")


def furbake(*arguments: object, **more: str) -> subprocess.CompletedProcess[str]:
    """The command in a process of its own."""
    command = [sys.executable, "-m", "furbake.cli", *map(str, arguments)]
    return subprocess.run(command, env=os.environ | more, capture_output=True, text=True, check=False)


def test_workers(run: Callable[..., Any], tmp_path: Path) -> None:
    """One bake on two; then a batch of files that are sent, during which one of them is killed."""
    made = models(tmp_path / "models", 2, 1)
    (tmp_path / "comb.json").write_text('{"strokes": [{"points": [[0, 0, 1], [0, 1, 0]], "strength": 1}]}')
    (tmp_path / "list.toml").write_text("comb = 'comb.json'\n[[model]]\nfile = 'models/*.obj'\n")
    expected = one_by_one(made, tmp_path / "one", "--comb", tmp_path / "comb.json")
    assert run("bake", "torus:8x8", "-o", tmp_path / "here", *TINY, *QUIET).status == 0
    with workers(tmp_path / "workers", 2) as crew:
        there = ("--scheduler", crew.address)
        found = furbake("bake", "torus:8x8", "-o", tmp_path / "there", *TINY, *QUIET, *there)
        assert found.returncode == 0, found.stderr
        assert files(tmp_path / "there") == files(tmp_path / "here")

        batch = started(tmp_path / "list.toml", "-o", tmp_path / "out", *there, "--send")
        assert batch.stdout is not None
        first = batch.stdout.readline()
        crew.processes[1].kill()
        rows = [json.loads(line) for line in [first, *batch.communicate()[0].splitlines()]]
        assert batch.returncode == 1
        assert contents(tmp_path / "out") == expected
        assert [row["name"] for row in rows if row.get("status") == "failed"] == ["bad00"]


@whole
def test_workers_of_another_version_are_refused(tmp_path: Path) -> None:
    (tmp_path / "numpy-0.1.dist-info").mkdir()
    (tmp_path / "numpy-0.1.dist-info" / "METADATA").write_text("Metadata-Version: 2.1\nName: numpy\nVersion: 0.1\n")
    with workers(tmp_path / "workers", 0) as crew:
        crew.add(PYTHONPATH=str(tmp_path))
        found = furbake("batch", "plane", "-o", tmp_path / "out", "--scheduler", crew.address)
    assert found.returncode == 2
    assert found.stderr.startswith("furbake: error: tcp://")
    assert found.stderr.endswith(f": numpy is 0.1, expected {versions()['numpy']} as here\n")
    assert not (tmp_path / "out").exists()


@whole
def test_ten_killed_workers_of_a_batch_cost_nothing(tmp_path: Path) -> None:
    made = models(tmp_path / "models", 6, 1)
    expected = one_by_one(made, tmp_path / "one")
    chance, hit = Random(5), 0
    for turn in range(10):
        with workers(tmp_path / f"workers{turn}", 3) as crew:
            out = tmp_path / f"out{turn}"
            batch = started(tmp_path / "models", "-o", out, "--scheduler", crew.address, *(["--send"] * (turn % 2)))
            time.sleep(chance.uniform(0.5, 5.0))
            hit += batch.poll() is None
            crew.processes[1 + turn % 3].kill()
            _, err = batch.communicate()
        assert batch.returncode == 1, err
        assert contents(out) == expected
    assert hit > 5


@whole
def test_ten_killed_workers_of_one_bake_cost_nothing(run: Callable[..., Any], tmp_path: Path) -> None:
    size = ("--layers", "8", "--size", "32", "--lights", "32", "--states", "dry,wet", "--dirt", *QUIET)
    assert run("bake", "torus:8x8", "-o", tmp_path / "here", *size).status == 0
    chance, hit = Random(6), 0
    for turn in range(10):
        with workers(tmp_path / f"workers{turn}", 3) as crew:
            out = tmp_path / f"out{turn}"
            arguments = ["bake", "torus:8x8", "-o", out, *size, "--scheduler", crew.address]
            command = [sys.executable, "-m", "furbake.cli", *map(str, arguments)]
            bake = subprocess.Popen(command)
            time.sleep(chance.uniform(2.0, 7.0))
            hit += bake.poll() is None
            crew.processes[1 + turn % 3].kill()
            assert bake.wait() == 0
        assert files(out) == files(tmp_path / "here")
    assert hit > 5


@pytest.mark.parametrize(
    ("theirs", "expected"),
    [
        ({"furbake": "1", "code": "b", "scipy": "1"}, "w: other code of furbake 1, expected the same as here"),
        ({"furbake": "2", "code": "b", "scipy": "1"}, "w: furbake is 2, expected 1 as here"),
        ({"furbake": "1", "code": "a"}, "w: scipy is missing, expected 1 as here"),
        ({"furbake": "1", "code": "a", "scipy": "1", "embreex": "2"}, "w: embreex is 2, expected none as here"),
    ],
)
def test_versions_that_differ(theirs: dict[str, str], expected: str) -> None:
    with pytest.raises(ClusterError) as error:
        compare("w", theirs, {"furbake": "1", "code": "a", "scipy": "1"})
    assert str(error.value) == expected


def test_without_dask(tmp_path: Path) -> None:
    (tmp_path / "distributed.py").write_text("raise ImportError")
    found = furbake("batch", "plane", "-o", tmp_path / "out", "--scheduler", "local", PYTHONPATH=str(tmp_path))
    assert found.returncode == 2
    assert found.stderr == (
        "furbake: error: distributed: not installed, expected pip install 'furbake[cluster]' "
        "(in a clone, './baker[cluster]')\n"
    )
    assert not (tmp_path / "out").exists()
