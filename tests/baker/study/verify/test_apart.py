from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from furbake.study.verify import truth
from furbake.study.verify.apart import apart, trace
from furbake.study.verify.pathtrace import VerifyError
from helpers.crash import crash, double, fail


def test_results_steps_and_errors_come_back() -> None:
    steps: list[float] = []
    assert apart(double, 21, step=steps.append) == 42
    assert steps == [1.0]
    with pytest.raises(VerifyError, match="mitsuba: no, expected yes"):
        apart(fail, step=steps.append)
    assert steps == [1.0, 0.0]


def test_a_tracer_that_crashes_is_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(truth, "trace", crash)
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
