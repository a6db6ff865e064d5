"""Parcels: all that a bake reads is sent along with it."""

from __future__ import annotations

from pathlib import Path

import pytest

from furbake.batch.job import Job
from furbake.cluster.parcel import packed, unpacked
from furbake.options import BakeOptions


def test_photographs_are_sent_with_their_list(tmp_path: Path) -> None:
    (tmp_path / "photos").mkdir()
    (tmp_path / "felt.lp").write_text("2\nphotos/a.jpg 0 0 1\nb.jpg 0.5 0 0.8\n")
    for name in ("photos/a.jpg", "b.jpg"):
        (tmp_path / name).write_bytes(name.encode())
    job = Job("ball", "sphere", BakeOptions(swatch=str(tmp_path / "felt.lp")), tmp_path / "out")
    parcel = packed(job)
    with unpacked(job, parcel) as there:
        swatch = Path(str(there.options.swatch))
        assert swatch != tmp_path / "felt.lp"
        sent = {path.relative_to(swatch.parent).as_posix() for path in swatch.parent.rglob("*") if path.is_file()}
        assert sent == {"felt.lp", "photos/a.jpg", "b.jpg"}


def test_photographs_of_another_folder_lie_beside_their_list(tmp_path: Path) -> None:
    for folder in ("lists", "jpeg-exports"):
        (tmp_path / folder).mkdir()
    (tmp_path / "lists" / "felt.lp").write_text("1\n../jpeg-exports/a.jpg 0 0 1\n")
    (tmp_path / "jpeg-exports" / "a.jpg").write_bytes(b"a")
    job = Job("ball", "sphere", BakeOptions(swatch=str(tmp_path / "lists" / "felt.lp")), tmp_path / "out")
    assert sorted(packed(job).files) == ["swatch/a.jpg", "swatch/felt.lp"]


def test_list_that_cannot_be_read_is_left_to_the_bake(tmp_path: Path) -> None:
    (tmp_path / "felt.lp").write_text("many\n")
    job = Job("ball", "sphere", BakeOptions(swatch=str(tmp_path / "felt.lp")), tmp_path / "out")
    assert list(packed(job).files) == ["swatch/felt.lp"]


def test_sentences_name_the_file_of_the_batch(tmp_path: Path) -> None:
    (tmp_path / "felt.lp").write_text("1\na.jpg 0 0 1\n")
    job = Job("ball", "sphere", BakeOptions(swatch=str(tmp_path / "felt.lp")), tmp_path / "out")
    with pytest.raises(ValueError, match=f"^{tmp_path / 'felt.lp'}: no$"), unpacked(job, packed(job)) as there:
        raise ValueError(f"{there.options.swatch}: no")
