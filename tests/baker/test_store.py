"""A folder appears whole or not at all, whatever happens."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from furbake.asset.store import StoreError, atomic_file, atomic_folder

DEAD = 2**22 + 7
"""Above the largest process number that Linux gives."""


def names(folder: Path) -> list[str]:
    return sorted(entry.name for entry in folder.iterdir())


def make_old(folder: Path) -> Path:
    folder.mkdir()
    (folder / "bake.json").write_text("old")
    return folder


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
    assert (out / "bake.json").read_text() == "old"
    assert names(tmp_path) == ["out"]


def test_existing_folder_needs_force(tmp_path: Path) -> None:
    out = make_old(tmp_path / "out")
    message = r"out: exists already, expected a new folder \(or --force to replace it\)"
    with pytest.raises(StoreError, match=message), atomic_folder(out):
        pytest.fail("the block must not run")
    with atomic_folder(out, force=True) as folder:
        (folder / "x").write_text("new")
        assert (out / "bake.json").read_text() == "old"
    assert names(out) == ["x"]
    assert names(tmp_path) == ["out"]


def test_force_replaces_nothing_that_cannot_be_a_bake(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    work = tmp_path / "work"
    (work / "thesis").mkdir(parents=True)
    with pytest.raises(StoreError, match="holds the folder thesis and is no bake"), atomic_folder(work, force=True):
        pytest.fail("the block must not run")
    here = make_old(tmp_path / "here")
    monkeypatch.chdir(here)
    for place in (Path(), here, tmp_path, Path.home(), Path("/")):
        with pytest.raises(StoreError, match="is the current folder"), atomic_folder(place, force=True):
            pytest.fail("the block must not run")
    assert names(tmp_path) == ["here", "work"]


def test_force_replaces_files(tmp_path: Path) -> None:
    for name in ("empty", "notes"):
        (tmp_path / name).mkdir()
    (tmp_path / "notes" / "old.txt").touch()
    for name in ("empty", "notes"):
        with atomic_folder(tmp_path / name, force=True) as folder:
            (folder / "x").touch()
        assert names(tmp_path / name) == ["x"]


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


def test_failed_rename_puts_the_old_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = make_old(tmp_path / "out")
    rename = Path.rename

    def fail(self: Path, target: Path) -> Path:
        if self.name.endswith(".part"):
            raise OSError(28, "No space left on device")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", fail)
    with pytest.raises(StoreError, match="no space left on device, expected a folder"), atomic_folder(out, force=True):
        pass
    assert (out / "bake.json").read_text() == "old"
    assert names(tmp_path) == ["out"]


def test_leftovers_of_dead_processes_go(tmp_path: Path) -> None:
    leftovers = [f".out.{DEAD}-0123abcd.part", f".out.{DEAD}-0123abcd.old"]
    others = [f".out.{os.getppid()}-0123abcd.part", f".other.{DEAD}-0123abcd.part", ".out.note"]
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
    assert (tmp_path / "out" / "bake.json").read_text() == "old"


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
    assert len(names(tmp_path)) == 1 + old  # the half folder, hidden
    with atomic_folder(out, force=True) as folder:
        (folder / "x").touch()
    assert names(tmp_path) == ["out"]
    assert names(out) == ["x"]


def test_two_at_once_do_not_clear_each_other(tmp_path: Path) -> None:
    out = tmp_path / "out"
    process = subprocess.Popen([sys.executable, "-c", WAIT, out], stdout=subprocess.PIPE, text=True)
    with process:
        assert process.stdout
        assert process.stdout.readline() == "ready\n"
        with atomic_folder(out) as folder:
            (folder / "x").touch()
        assert len([name for name in names(tmp_path) if name.endswith(".part")]) == 1
        process.kill()


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
