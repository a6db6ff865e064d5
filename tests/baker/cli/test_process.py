from __future__ import annotations

import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from furbake.cli import baking
from helpers.command import TINY, listed


def test_interrupt(run: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    def stop(*args: Any, **kwargs: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(baking, "bake", stop)
    done = run("bake", "plane", "-o", "out")
    assert (done.status, done.out, done.err) == (130, "", "furbake: interrupted, nothing written\n")


def test_bar_on_a_terminal(run: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TTY_COMPATIBLE", "1")
    monkeypatch.setenv("FORCE_COLOR", "1")
    done = run("bake", "plane", "-o", "out", *TINY)
    assert done.status == 0
    assert "%" in done.err
    assert "\x1b[" in done.err
    assert "furbake: mesh" not in done.err


def test_sigkill_leaves_no_folder(here: Path) -> None:
    """Acceptance 9: a bake killed half-way leaves no DIR, and the next one clears up behind it."""
    command = [sys.executable, "-m", "furbake.cli", "bake", "sphere", "-o", "out", "--quiet"]
    with subprocess.Popen([*command, "--layers", "64", "--size", "128", "--lights", "512"]) as process:
        limit = time.monotonic() + 60
        while not [name for name in listed() if name.endswith(".part")]:
            assert process.poll() is None
            assert time.monotonic() < limit
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
    assert not Path("out").exists()
    assert len(listed()) == 2  # the half folder and the lock
    assert subprocess.run([*command, *TINY], check=False).returncode == 0
    assert listed() == ["out"]
