"""Files of a bake that are sent to another machine, and those that come back."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from furbake.asset.store import atomic_folder
from furbake.batch.job import Job
from furbake.identity import bake_key
from furbake.options.bake_options import named_files
from furbake.options.regions import region_files
from furbake.rti.files import members
from furbake.rti.relit import RtiError
from furbake.surface.files import read_regular
from furbake.surface.limits import Budget
from furbake.surface.read.companions import companions
from furbake.surface.shapes import is_builtin


@dataclass(frozen=True)
class Parcel:
    """A bake's files by their place in a folder of its own, and the place of each option that names one."""

    files: dict[str, bytes]
    places: dict[str, str]


def packed(job: Job) -> Parcel:
    """All that a bake reads. What cannot be read is left out: the bake says so. Raises MeshError for too much."""
    files: dict[str, bytes] = {}
    places: dict[str, str] = {}
    budget = Budget(job.model, "bytes")

    def add(place: str, file: Path) -> None:
        with suppress(OSError):
            files[place] = read_regular(file, budget)

    if not is_builtin(job.model):
        model = Path(job.model)
        for file in (model, *companions(model)):
            add(f"model/{Path(os.path.relpath(file, model.parent)).as_posix()}", file)
    for name, value in named_files(job.options).items():
        places[name] = f"{name}/{Path(value).name}"
        add(places[name], Path(value))
    if job.options.region_file is not None:
        home = Path(job.options.region_file).parent
        for named in map(Path, region_files(job.options.region_file)):
            if named.is_relative_to(home):
                add(f"regions/{named.relative_to(home).as_posix()}", named)
    if job.options.swatch is not None:
        swatch = Path(job.options.swatch)
        with suppress(RtiError):
            for file in members(swatch):
                inside = file.is_relative_to(swatch.parent)
                add(f"swatch/{file.relative_to(swatch.parent).as_posix() if inside else file.name}", file)
    return Parcel(files, places)


@contextmanager
def unpacked(job: Job, parcel: Parcel) -> Iterator[Job]:
    """The same bake from and to a folder of its own, which vanishes; errors name the files as the job does."""
    with TemporaryDirectory(prefix="furbake-") as scratch:
        for place, data in parcel.files.items():
            path = Path(scratch) / place
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        there: dict[str, Any] = {name: str(Path(scratch) / place) for name, place in parcel.places.items()}
        model = job.model if is_builtin(job.model) else str(Path(scratch) / "model" / Path(job.model).name)
        given = {name: getattr(job.options, name) for name in there}
        words = {model: job.model, **{path: given[name] for name, path in there.items()}}
        try:
            yield replace(
                job, model=model, options=replace(job.options, **there), out=Path(scratch) / "out" / job.out.name
            )
        except Exception as error:  # noqa: BLE001 — raised again in other words
            raise _named(error, lambda text: _replaced(text, words)) from None


def _named(error: Exception, words: Callable[[str], str]) -> Exception:
    """The same error with other words."""
    text = words(str(error))
    return error if text == str(error) else type(error)(text)


def _replaced(text: str, words: dict[str, str]) -> str:
    for old, new in words.items():
        text = text.replace(old, new)
    return text


def written(job: Job) -> dict[str, bytes]:
    """Files of a baked folder."""
    return {path.name: path.read_bytes() for path in job.out.iterdir()}


def keep(job: Job, files: dict[str, bytes]) -> None:
    """Write what came back as the bake would have written it here. Raises StoreError."""
    record = json.loads(files["bake.json"])
    record["options"], record["key"] = job.options.as_record(), bake_key(job.model, job.options)
    text = json.dumps(record, indent=1) + "\n"
    with atomic_folder(job.out, force=True) as folder:
        for name, data in {**files, "bake.json": text.encode()}.items():
            (folder / name).write_bytes(data)
