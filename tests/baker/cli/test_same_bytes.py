"""The same input gives the same bytes, whatever threads, seed of hashes, language and folder the process has."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from helpers.command import CUBE, TINY, files

SMALL = (*TINY, "--set", "coat.guard.count=20", "--set", "coat.under.count=20")


THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "FURBAKE_THREADS")


def test_same_bytes_everywhere(tmp_path: Path) -> None:
    (tmp_path / "model").mkdir()
    model = tmp_path / "model" / "four.obj"
    model.write_text(CUBE)
    settings = [("1", "0", "C", "a"), ("2", "1", "C.UTF-8", "b")]
    if os.environ.get("FURBAKE_TEST_ALL") == "1":
        settings += [("2", "4294967295", "C", "b"), ("1", "1", "C.UTF-8", "a")]
    found = []
    for threads, hashes, language, place in settings:
        folder = tmp_path / place
        folder.mkdir(exist_ok=True)
        counts = dict.fromkeys(THREADS, threads)
        changed = {"PYTHONHASHSEED": hashes, "LC_ALL": language, "LANG": language, "TZ": f"UTC-{threads}"}
        command = [sys.executable, "-m", "furbake.cli", "bake", model, "-o", f"out{hashes}", *SMALL, "--quiet"]
        subprocess.run(command, cwd=folder, env=os.environ | counts | changed, check=True)
        found.append(files(folder / f"out{hashes}"))
    assert found[0]["model.bin"]
    assert all(one == found[0] for one in found)
