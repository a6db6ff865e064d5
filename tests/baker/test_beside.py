"""Work beside a bake's own: the same results wherever they are found, and nothing is left of the process."""

from __future__ import annotations

import operator
import os
import time
from collections.abc import Callable
from pathlib import Path

import psutil
import pytest

from furbake.beside import Beside, results
from furbake.options import BakeOptions
from furbake.pipeline import bake
from furbake.tile import pelts

TINY = BakeOptions(layers=4, size=8, lights=8, states=("dry", "wet"))


@pytest.fixture(autouse=True)
def two_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FURBAKE_THREADS", "2")


def children() -> list[int]:
    return [child.pid for child in psutil.Process().children()]


def test_calls_are_made_there_one_after_another() -> None:
    before = children()
    with Beside(apart=True) as beside:
        assert beside.busy == 0
        beside.start()
        (there,) = set(children()) - set(before)
        first, waits = beside.submit(os.getpid), beside.submit(time.sleep, 0.2)
        assert beside.busy == 1
        assert first.result() == there
        assert waits.result() is None
        assert beside.busy == 0
    assert children() == before


@pytest.mark.parametrize("start", [lambda beside: None, Beside.start])
@pytest.mark.parametrize("apart", [False, True])
def test_without_a_process_they_are_made_here_when_they_are_wanted(
    start: Callable[[Beside], None], apart: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    if apart:
        monkeypatch.setenv("FURBAKE_THREADS", "1")
    made = list[int]()
    with Beside(apart=apart) as beside:
        start(beside)
        here, call = beside.submit(os.getpid), beside.submit(made.append, 1)
        assert made == []
        assert [call.result(), call.result()] == [None, None]
        assert made == [1]
        assert here.result() == os.getpid()
        assert beside.busy == 0


def test_what_is_wanted_before_it_has_begun_is_made_here() -> None:
    with Beside(apart=True) as beside:
        beside.start()
        calls = [beside.submit(operator.add, n, n) for n in range(5)]
        assert results(calls) == [0, 2, 4, 6, 8]
        beside.submit(time.sleep, 60)
        assert beside.submit(os.getpid).result() == os.getpid()
        assert beside.busy == 1


def test_what_it_raises_is_raised_where_it_is_wanted() -> None:
    with Beside(apart=True) as beside:
        beside.start()
        call = beside.submit(operator.truediv, 1, 0)
        for _ in range(2):
            with pytest.raises(ZeroDivisionError):
                call.result()


def test_a_process_that_ends_costs_its_calls_only_time() -> None:
    with Beside(apart=True) as beside:
        beside.start()
        lost = beside.submit(_end_unless, os.getpid())
        later = beside.submit(os.getpid)
        assert lost.result() == "here"
        assert later.result() == os.getpid()


def _end_unless(process: int) -> str:
    if os.getpid() != process:
        os._exit(1)
    return "here"


def test_a_bake_with_another_process_writes_the_same_bytes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    began = list[bool]()
    start = Beside.start
    monkeypatch.setattr(Beside, "start", lambda self: began.append(True) or start(self))
    bake("torus:8x6", tmp_path / "alone", TINY)
    assert began == []
    monkeypatch.setattr(pelts, "LONG", 0)
    bake("torus:8x6", tmp_path / "helped", TINY)
    bake("torus:8x6", tmp_path / "not helped", TINY, helped=False)
    assert began == [True, True]
    files = {path.name: path.read_bytes() for path in (tmp_path / "alone").iterdir()}
    for folder in ("helped", "not helped"):
        assert {path.name: path.read_bytes() for path in (tmp_path / folder).iterdir()} == files
