from __future__ import annotations

import warnings

import pytest


@pytest.fixture
def mitsuba() -> None:
    """The path tracer; what asks for it is skipped where it is not installed."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        pytest.importorskip("mitsuba")
