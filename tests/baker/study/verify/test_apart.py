from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from furbake.apart import TELL, Apart
from furbake.study.verify import truth
from furbake.study.verify.apart import trace
from furbake.study.verify.pathtrace import VerifyError
from helpers import crash


@pytest.fixture(autouse=True)
def _importable(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the other process find this folder's helpers."""
    monkeypatch.setenv("PYTHONPATH", str(Path(crash.__file__).parents[1]))


def test_results_steps_and_errors_come_back() -> None:
    steps: list[float] = []
    process = Apart()
    try:
        assert process.call(crash.double, 21, TELL, tell=steps.append) == 42
        assert steps == [1.0]
        with pytest.raises(VerifyError, match="mitsuba: no, expected yes"):
            process.call(crash.fail, TELL, tell=steps.append)
        assert steps == [1.0, 0.0]
    finally:
        process.end()


def test_a_tracer_that_crashes_is_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(truth, "trace", crash.crash)
    scene: Any = SimpleNamespace(groom=SimpleNamespace(points=np.zeros((7, 2, 3))))
    nothing: Any = None
    steps: list[float] = []
    with pytest.raises(VerifyError) as told:
        trace(scene, nothing, [], 2, steps.append)
    assert str(told.value) == (
        "mitsuba: ended by SIGKILL with 7 hairs, expected fewer of them "
        "(bake with a larger --tile, or fewer by --set coat.under.count=N) or --scalar"
    )
    assert steps == [0.5]
