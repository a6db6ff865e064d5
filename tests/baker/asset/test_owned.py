"""Only what furbake wrote is replaced, and what else is in the way is named."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from furbake.asset import store
from furbake.asset.store import StoreError, atomic_folder
from helpers.folders import RECORD, make_old, names


def test_force_replaces_nothing_that_cannot_be_a_bake(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    work = tmp_path / "work"
    (work / "thesis").mkdir(parents=True)
    with (
        pytest.raises(StoreError, match="work: holds thesis, not written by furbake, expected nothing beside"),
        atomic_folder(work, force=True),
    ):
        pytest.fail("the block must not run")
    here = make_old(tmp_path / "here")
    monkeypatch.chdir(here)
    for place in (Path(), here, tmp_path, Path.home(), Path("/")):
        with pytest.raises(StoreError, match="is the current folder"), atomic_folder(place, force=True):
            pytest.fail("the block must not run")
    assert names(tmp_path) == ["here", "work"]


def test_force_replaces_an_empty_folder_and_all_that_furbake_writes(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    lesson = tmp_path / "lesson"
    lesson.mkdir()
    (lesson / "lesson.json").write_text(json.dumps({"furbake": "0.1.0", "key": "", "bytes": {"strands.bin": 0}}))
    reported = make_old(tmp_path / "reported")
    (reported / "report.html").write_text("<!doctype html><footer>Written by furbake 0.1.0. It can be mailed.</footer>")
    for left in (".report.html.12-0123abcd.part", ".report.html.lock", ".DS_Store"):
        (reported / left).touch()
    (lesson / "strands.bin").touch()
    for folder in (tmp_path / "empty", lesson, reported):
        with atomic_folder(folder, force=True) as fresh:
            (fresh / "x").touch()
        assert names(folder) == ["x"]


FOREIGN = {
    "no record": {"a.jpg": "hi"},
    "a file beside a bake": {"bake.json": RECORD, "model.gltf": "{}", "a.jpg": "hi"},
    "no mark": {"bake.json": '{"asset": {"bytes": {"a.jpg": 2}}}', "a.jpg": "hi"},
    "no bake": {"bake.json": "no JSON", "model.gltf": "{}"},
    "a page of somebody else": {"bake.json": RECORD, "report.html": "<footer>mine</footer>"},
}


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with names")
def test_force_waits_for_no_pipe(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    os.mkfifo(tmp_path / "out" / "bake.json")
    with pytest.raises(StoreError, match=r"holds bake\.json, not written"), atomic_folder(tmp_path / "out", force=True):
        pass


@pytest.mark.parametrize("kind", FOREIGN)
def test_force_replaces_nothing_that_furbake_did_not_write(tmp_path: Path, kind: str) -> None:
    out = tmp_path / "out"
    out.mkdir()
    for name, text in FOREIGN[kind].items():
        (out / name).write_text(text)
    what = r"(a\.jpg|a\.jpg, bake\.json|bake\.json, model\.gltf|report\.html)"
    message = rf"out: holds {what}, not written by furbake, expected nothing beside a bake$"
    with pytest.raises(StoreError, match=message), atomic_folder(out, force=True):
        pytest.fail("the block must not run")
    assert {path.name: path.read_text() for path in out.iterdir()} == FOREIGN[kind]
    assert names(tmp_path) == ["out"]


def test_a_refusal_names_what_would_be_lost(tmp_path: Path) -> None:
    out = make_old(tmp_path / "out")
    for i in range(7):
        (out / f"photo{i}.jpg").touch()
    (out / "link").symlink_to(out / "bake.json")
    (out / "link").replace(out / "model.gltf")  # a link with a name of the record is none of its files
    what = r"model\.gltf, photo0\.jpg, photo1\.jpg, photo2\.jpg, photo3\.jpg and 3 more"
    with pytest.raises(StoreError, match=what), atomic_folder(out, force=True):
        pytest.fail("the block must not run")


def test_a_folder_that_appears_meanwhile_stays(tmp_path: Path) -> None:
    out = tmp_path / "out"
    with pytest.raises(StoreError, match="out: exists already"), atomic_folder(out) as folder:
        (folder / "x").touch()
        out.mkdir()
    assert names(tmp_path) == ["out"]
    assert names(out) == []
    with pytest.raises(StoreError, match=r"holds a\.jpg"), atomic_folder(out, force=True):
        (out / "a.jpg").write_text("hi")
    assert names(out) == ["a.jpg"]


@pytest.mark.parametrize("exchange", [True, False])
def test_a_file_that_appears_at_the_last_moment_comes_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, exchange: bool
) -> None:
    """Written between the last look and the rename, which is found by one more look at the old folder."""
    out = make_old(tmp_path / "out")
    check = store.check_free

    def late(target: Path, force: bool, name: str) -> None:
        check(target, force, name)
        if len(names(tmp_path)) > 2:  # lock, old and new folder: the second look
            (out / "a.jpg").write_text("hi")

    monkeypatch.setattr(store, "check_free", late)
    if not exchange:
        monkeypatch.setattr(store, "swap", lambda first, second: False)
    with pytest.raises(StoreError, match=r"holds a\.jpg"), atomic_folder(out, force=True) as folder:
        (folder / "x").touch()
    assert names(out) == ["a.jpg", "bake.json", "model.gltf"]
    assert names(tmp_path) == ["out"]
