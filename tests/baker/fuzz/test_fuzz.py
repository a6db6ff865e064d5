"""Broken inputs of every format end in one sentence, within memory and time."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from fuzz.run import run

INPUTS = 300


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the bound on memory is Linux's")
def test_broken_inputs_are_read_or_refused_in_one_sentence(tmp_path: Path) -> None:
    found = run("trust", 0, INPUTS, 600.0, tmp_path, print)
    assert found.failures == {}
    assert found.count == INPUTS
    assert 0 < found.peak < 2**30
