from __future__ import annotations

import os
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from furbake.cache.entries import LEFT, Cache
from furbake.cache.trees import packed, unpacked


@dataclass(frozen=True)
class Part:
    name: str
    values: np.ndarray
    more: tuple[float, ...] | None = None


def cache(folder: Path, max_bytes: int = 2**20) -> Cache:
    return Cache(folder, (Part,), max_bytes)


VALUE = [(Part("a", np.arange(6.0).reshape(2, 3).T, (1 / 3, 1e-300)), {"psnr": 0.1 + 0.2, "rank": 6, "none": None})]


def test_values_come_back_exactly(tmp_path: Path) -> None:
    cache(tmp_path / "new").put("key", VALUE)
    [(part, figures)] = cache(tmp_path / "new").get("key")
    assert isinstance(part, Part)
    assert (part.name, part.more) == ("a", (1 / 3, 1e-300))
    np.testing.assert_array_equal(part.values, VALUE[0][0].values)
    assert part.values.dtype == np.float64
    assert figures == VALUE[0][1]
    assert type(figures["rank"]) is int


def test_a_key_without_an_entry_has_none(tmp_path: Path) -> None:
    assert cache(tmp_path / "none").get("key") is None
    assert not (tmp_path / "none").exists()


@pytest.mark.parametrize("share", [0.0, 0.3, 0.99])
def test_an_entry_cut_short_is_ignored_and_replaced(tmp_path: Path, share: float) -> None:
    kept = cache(tmp_path)
    kept.put("key", VALUE)
    [path] = tmp_path.iterdir()
    path.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])
    assert kept.get("key") is None
    kept.put("key", VALUE)
    assert kept.get("key")[0][1] == VALUE[0][1]


def test_an_entry_with_a_changed_byte_is_ignored(tmp_path: Path) -> None:
    kept = cache(tmp_path)
    kept.put("key", VALUE)
    [path] = tmp_path.iterdir()
    data = bytearray(path.read_bytes())
    at = data.index(np.float64(5.0).tobytes())
    data[at] ^= 1
    path.write_bytes(data)
    assert kept.get("key") is None


def test_entries_hold_only_known_classes_and_no_code(tmp_path: Path) -> None:
    with pytest.raises(TypeError, match="got object, expected plain data"):
        packed(object())
    with pytest.raises(KeyError):
        unpacked(packed(VALUE), ())
    np.savez(tmp_path / "key.npz", tree=np.array([VALUE], dtype=object))
    assert cache(tmp_path).get("key") is None


def test_entries_that_were_not_used_for_longest_go(tmp_path: Path) -> None:
    kept = cache(tmp_path, max_bytes=90_000)
    for number in range(4):
        if number == 3:
            assert kept.get("0") is not None
        kept.put(str(number), [np.zeros(2500) + number])
        os.utime(tmp_path / f"{number}.npz", (number, number))
        if number == 2:
            os.utime(tmp_path / "0.npz", (9, 9))
    assert [kept.get(str(number)) is not None for number in range(4)] == [True] * 4
    for number, used in enumerate((9, 1, 2, 3)):
        os.utime(tmp_path / f"{number}.npz", (used, used))
    kept.put("4", [np.zeros(2500)])
    assert [(tmp_path / f"{number}.npz").exists() for number in range(5)] == [True, False, True, True, True]


def test_unfinished_files_of_killed_bakes_go_after_a_while(tmp_path: Path) -> None:
    for name, age in (("new.part", 0), ("old.part", 2 * LEFT)):
        (tmp_path / name).write_bytes(b"half")
        os.utime(tmp_path / name, (time.time() - age,) * 2)
    cache(tmp_path).put("key", VALUE)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["key.npz", "new.part"]


def test_many_writers_and_readers_at_once_see_whole_entries(tmp_path: Path) -> None:
    kept = cache(tmp_path, max_bytes=60_000)

    def work(number: int) -> bool:
        key = str(number % 5)
        kept.put(key, [np.full(2500, number % 5)])
        found = kept.get(key)
        return found is None or bool((found[0] == number % 5).all())

    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(work, range(200)))
    assert not list(tmp_path.glob("*.part"))


def test_a_folder_that_cannot_be_written_stops_nothing(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    kept = cache(tmp_path / "file" / "below")
    kept.put("key", VALUE)
    assert kept.get("key") is None
