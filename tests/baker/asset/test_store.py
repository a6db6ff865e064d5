"""A folder appears whole or not at all, whatever happens."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from furbake.asset import store
from furbake.asset.store import StoreError, atomic_file, atomic_folder
from helpers.folders import RECORD, make_old, names

DEAD = 2**22 + 7
"""Above the largest process number that Linux gives."""


def test_whole(tmp_path: Path) -> None:
    out = tmp_path / "a" / "b" / "out"
    with atomic_folder(out) as folder:
        (folder / "x").write_text("new")
        assert not out.exists()
        assert folder.parent == out.parent
        assert folder.name.startswith(".out.")
    assert names(out) == ["x"]
    assert names(out.parent) == ["out"]
    assert out.stat().st_mode & 0o777 == 0o777 & ~_umask()


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def test_failure_leaves_nothing_not_even_the_parents(tmp_path: Path) -> None:
    with pytest.raises(ZeroDivisionError), atomic_folder(tmp_path / "a" / "b" / "out") as folder:
        (folder / "x").write_text("half")
        raise ZeroDivisionError
    assert names(tmp_path) == []


def test_failure_keeps_the_old(tmp_path: Path) -> None:
    out = make_old(tmp_path / "out")
    with pytest.raises(KeyboardInterrupt), atomic_folder(out, force=True):
        raise KeyboardInterrupt
    assert (out / "bake.json").read_text() == RECORD
    assert names(tmp_path) == ["out"]


def test_existing_folder_needs_force(tmp_path: Path) -> None:
    out = make_old(tmp_path / "out")
    message = r"out: exists already, expected a new folder \(or --force to replace it\)"
    with pytest.raises(StoreError, match=message), atomic_folder(out):
        pytest.fail("the block must not run")
    with atomic_folder(out, force=True) as folder:
        (folder / "x").write_text("new")
        assert (out / "bake.json").read_text() == RECORD
    assert names(out) == ["x"]
    assert names(tmp_path) == ["out"]


def test_file_in_the_way(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("a file")
    for target in (tmp_path / "out", tmp_path / "out" / "below"):
        with pytest.raises(StoreError), atomic_folder(target, force=True):
            pytest.fail("the block must not run")
    assert (tmp_path / "out").read_text() == "a file"


def test_link_to_a_folder_is_followed(tmp_path: Path) -> None:
    out = make_old(tmp_path / "real")
    (tmp_path / "link").symlink_to(out)
    with atomic_folder(tmp_path / "link", force=True) as folder:
        (folder / "x").touch()
    assert (tmp_path / "link").is_symlink()
    assert names(out) == ["x"]


@pytest.mark.parametrize("place", ["/proc/nowhere/out", "/dev/null/out"])
def test_unwritable_place(place: str) -> None:
    message = f"^{place}: .*, expected a folder that can be written$"
    with pytest.raises(StoreError, match=message), atomic_folder(Path(place)):
        pytest.fail("the block must not run")


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_unwritable_folder(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    with pytest.raises(StoreError, match="permission denied"), atomic_folder(tmp_path / "out"):
        pytest.fail("the block must not run")
    tmp_path.chmod(0o700)


def test_name_too_long(tmp_path: Path) -> None:
    with pytest.raises(StoreError, match="name too long"), atomic_folder(tmp_path / ("x" * 300)):
        pytest.fail("the block must not run")


def test_without_an_exchange_two_renames_do(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(store, "swap", lambda first, second: False)
    out = make_old(tmp_path / "out")
    with atomic_folder(out, force=True) as folder:
        (folder / "x").touch()
    assert names(out) == ["x"]
    assert names(tmp_path) == ["out"]


def test_failed_rename_puts_the_old_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = make_old(tmp_path / "out")
    rename = Path.rename

    def fail(self: Path, target: Path) -> Path:
        if self.name.endswith(".part"):
            raise OSError(28, "No space left on device")
        return rename(self, target)

    monkeypatch.setattr(store, "swap", lambda first, second: False)
    monkeypatch.setattr(Path, "rename", fail)
    with pytest.raises(StoreError, match="no space left on device, expected a folder"), atomic_folder(out, force=True):
        pass
    assert (out / "bake.json").read_text() == RECORD
    assert names(tmp_path) == ["out"]


def test_leftovers_of_dead_processes_go_whatever_their_number(tmp_path: Path) -> None:
    numbers = (0, 1, os.getpid(), os.getppid(), DEAD, 10**30)  # a number is given again to another process
    leftovers = [f".out.{number}-0123abcd.{kind}" for number in numbers for kind in ("part", "old")]
    others = [f".other.{DEAD}-0123abcd.part", ".out.note", ".out.7-0123.part"]
    for name in leftovers + others:
        (tmp_path / name).mkdir()
        (tmp_path / name / "x").touch()
    make_old(tmp_path / "out")
    with atomic_folder(tmp_path / "out", force=True):
        pass
    assert names(tmp_path) == sorted([*others, "out"])


def test_old_folder_comes_back_after_a_kill_between_the_renames(tmp_path: Path) -> None:
    make_old(tmp_path / f".out.{DEAD}-0123abcd.old")
    with pytest.raises(StoreError, match="exists already"), atomic_folder(tmp_path / "out"):
        pytest.fail("the block must not run")
    assert (tmp_path / "out" / "bake.json").read_text() == RECORD


WAIT = """
import sys, time
from furbake.asset.store import atomic_folder
with atomic_folder(sys.argv[1], force=True) as folder:
    (folder / "half").touch()
    print("ready", flush=True)
    time.sleep(60)
"""


@pytest.mark.parametrize("old", [False, True])
def test_sigkill(tmp_path: Path, old: bool) -> None:
    out = tmp_path / "out"
    if old:
        make_old(out)
    process = subprocess.Popen([sys.executable, "-c", WAIT, out], stdout=subprocess.PIPE, text=True)
    with process:
        assert process.stdout
        assert process.stdout.readline() == "ready\n"
        process.send_signal(signal.SIGKILL)
    assert out.exists() == old
    assert len(names(tmp_path)) == 2 + old  # the half folder and the lock, hidden
    with atomic_folder(out, force=True) as folder:
        (folder / "x").touch()
    assert names(tmp_path) == ["out"]
    assert names(out) == ["x"]


def test_the_second_at_one_place_is_refused(tmp_path: Path) -> None:
    out = tmp_path / "out"
    process = subprocess.Popen([sys.executable, "-c", WAIT, out], stdout=subprocess.PIPE, text=True)
    message = "out: is being written by another process, expected to be alone there"
    with process:
        assert process.stdout
        assert process.stdout.readline() == "ready\n"
        for force in (False, True):
            with pytest.raises(StoreError, match=message), atomic_folder(out, force):
                pytest.fail("the block must not run")
        with pytest.raises(StoreError, match=message), atomic_file(out):
            pytest.fail("the block must not run")
        assert [(tmp_path / name / "half").exists() for name in names(tmp_path) if name.endswith(".part")] == [True]
        process.kill()
    with atomic_folder(out):
        pass
    assert names(tmp_path) == ["out"]


def test_the_second_of_one_process_is_refused(tmp_path: Path) -> None:
    with atomic_folder(tmp_path / "out") as folder:
        with pytest.raises(StoreError, match="is being written"), atomic_folder(tmp_path / "out"):
            pytest.fail("the block must not run")
        assert folder.is_dir()
    assert names(tmp_path) == ["out"]


def test_file(tmp_path: Path) -> None:
    path = tmp_path / "x.npz"
    with atomic_file(path) as file:
        file.write(b"whole")
        assert not path.exists()
    with pytest.raises(ZeroDivisionError), atomic_file(path) as file:
        file.write(b"half")
        raise ZeroDivisionError
    assert path.read_bytes() == b"whole"
    assert names(tmp_path) == ["x.npz"]


def test_file_in_a_bad_place(tmp_path: Path) -> None:
    with pytest.raises(StoreError, match="is a folder, expected a file to write"), atomic_file(tmp_path):
        pytest.fail("the block must not run")
    with (
        pytest.raises(StoreError, match="no such file or directory, expected a file"),
        atomic_file(tmp_path / "a" / "b"),
    ):
        pytest.fail("the block must not run")
