"""The models of a batch and the options of each, from a list, folders, files and globs."""

from __future__ import annotations

import glob
import json
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import click

from furbake.batch.job import Job
from furbake.cli.arguments import BAKE
from furbake.cli.chosen import GIVEN, options_for
from furbake.options import OptionError
from furbake.options.bake_options import FILES, OF_GROOM, OF_VERTICES
from furbake.options.knobs import flatten, show
from furbake.surface.files import read_regular
from furbake.surface.limits import Budget
from furbake.surface.read.reading import ARCHIVES, MESHES, STAGES, kind_of
from furbake.surface.shapes import is_builtin
from furbake.surface.soup import MeshError

OPTIONS = ("preset", "set", *GIVEN)
"""Options that a list may give, to all models or to some."""

PARAMETERS = {param.name: param for param in BAKE if param.name in OPTIONS}

KINDS = (*MESHES, *ARCHIVES, *STAGES)
"""Ends of the names of files that are taken from folders and by globs."""

OWN = ("name", "file")

TAKEN = ("index.html", "batch.jsonl")
"""Names in the folder of a batch that no bake may have."""


def listed(places: Sequence[str], out: Path, given: SimpleNamespace, cache: Path | None) -> list[Job]:
    """All bakes that the arguments name.

    given : preset and settings of the command line, for models without their own

    Raises OptionError with one sentence where a list, an option or a name is wrong, or there is no model.
    """
    jobs: dict[str, Job] = {}
    for model, named, options, where in _entries(places):
        settings = (*given.set, *options.get("set", ()))
        args = SimpleNamespace(
            **{**dict.fromkeys(OPTIONS), "preset": given.preset or "paper", **options, "set": settings}
        )
        name = named if named is not None else model.replace(":", "-") if is_builtin(model) else Path(model).stem
        if name in ("", *TAKEN) or name.startswith(".") or not name.isprintable() or {"/", "\\"} & {*name}:
            raise OptionError(f"name: got {name!r} of {model}, expected one that a folder can have")
        other = jobs.get(name.casefold())
        if other is not None:
            raise OptionError(f"{name}: named so by {other.model} and by {model}, expected a name of its own for each")
        try:
            found = options_for(model, args)
        except OptionError as error:
            raise OptionError(f"{where}: {error}" if where else str(error)) from None
        jobs[name.casefold()] = Job(name, model, found, out / name, cache)
    return list(jobs.values())


def _entries(places: Sequence[str]) -> Iterator[tuple[str, str | None, dict[str, Any], str | None]]:
    """Model, name, options, and the list that says so, of each bake."""
    for place in places:
        if place.lower().endswith(".toml"):
            yield from _of_list(place)
        else:
            for model in _models(place, place):
                yield model, None, {}, None


def _models(pattern: str, what: str) -> list[str]:
    """Files that a path means: itself, those of a folder, those that fit a glob. Raises OptionError for none."""
    if is_builtin(pattern):
        return [pattern]
    path = Path(pattern)
    if path.is_dir():
        found = sorted(str(file) for file in path.iterdir() if kind_of(file.name) in KINDS and file.is_file())
    elif glob.has_magic(pattern) and not path.exists():
        matching = glob.glob(pattern, recursive=True)  # noqa: PTH207 — from any folder
        found = sorted(file for file in matching if kind_of(file) in KINDS and Path(file).is_file())
    else:
        return [pattern]  # whether it is there, its own bake says
    if not found:
        raise OptionError(f"{what}: no model, expected files that end in {', '.join(KINDS)}")
    return found


def _of_list(place: str) -> Iterator[tuple[str, str | None, dict[str, Any], str]]:
    table = _read(place)
    entries = table.pop("model", None)
    if not isinstance(entries, list) or not entries or not all(isinstance(entry, dict) for entry in entries):
        raise OptionError(f"{place}: got no list of models, expected [[model]] and then file = '...' for each")
    folder = Path(place).parent
    of_all = _options(table, place, folder)
    for number, entry in enumerate(entries, 1):
        where = f"{place}: model {number}"
        file, name = entry.get("file"), entry.get("name")
        patterns = [file] if isinstance(file, str) else file
        if not patterns or not isinstance(patterns, list) or not all(isinstance(one, str) for one in patterns):
            got = "none" if file is None else show(file)
            raise OptionError(f"{where}: file: got {got}, expected a path, a glob or a list of them")
        if name is not None and not isinstance(name, str):
            raise OptionError(f"{where}: name: got {show(name)}, expected text")
        options = _options({key: value for key, value in entry.items() if key not in OWN}, where, folder)
        models = [model for one in patterns for model in _models(one if is_builtin(one) else str(folder / one), where)]
        if name is not None and len(models) != 1:
            raise OptionError(f"{where}: name: got {name!r} for {len(models)} models, expected one")
        both = {**of_all.get("set", {}), **options.get("set", {})}
        for model in models:
            yield model, name, {**of_all, **options, "set": tuple(both.items())}, where


def _read(place: str) -> dict[str, Any]:
    try:
        return tomllib.loads(read_regular(Path(place), Budget(place, "bytes")).decode())
    except OSError as error:
        raise OptionError(f"{place}: {(error.strerror or str(error)).lower()}, expected a list of models") from None
    except MeshError as error:
        raise OptionError(str(error)) from None
    except (ValueError, RecursionError) as error:
        detail = "too deeply nested" if isinstance(error, RecursionError) else " ".join(str(error).split())
        raise OptionError(f"{place}: got no valid TOML ({detail}), expected lines such as file = 'a.glb'") from None


def _options(table: Mapping[str, Any], where: str, folder: Path) -> dict[str, Any]:
    """Options of the command from a table of a list, paths in it seen from the list's own folder."""
    found: dict[str, Any] = {}
    for key, value in table.items():
        name = key.replace("-", "_")
        if name.removeprefix("no_") in OPTIONS and isinstance(value, bool) and name not in OPTIONS:
            name, value = name.removeprefix("no_"), not value  # noqa: PLW2901 — as the command spells it
        if name not in OPTIONS:
            if key in OWN:
                raise OptionError(f"{where}: {key}: got it for all models, expected it below a [[model]]")
            known = ", ".join(option.replace("_", "-") for option in (*OWN, *OPTIONS))
            raise OptionError(f"{where}: {key}: unknown, expected one of {known}")
        found[name] = _settings(value, where) if name == "set" else _value(PARAMETERS[name], value, where)
        file = name in FILES or (name in ("preset", "guide") and str(value).endswith((".toml", ".json")))
        if file and not str(value).startswith(OF_VERTICES) and not (name == "regions" and str(value) in OF_GROOM):
            found[name] = str(folder / found[name])
    return found


def _value(param: click.Parameter, value: Any, where: str) -> Any:
    """The value of an option as the command line would have it."""
    name = str(param.name).replace("_", "-")
    if isinstance(param, click.Option) and param.is_flag:
        if not isinstance(value, bool):
            raise OptionError(f"{where}: {name}: got {show(value)}, expected true or false")
        return value
    if isinstance(value, (bool, dict)) or (isinstance(value, list) and name != "states"):
        raise OptionError(f"{where}: {name}: got {show(value)}, expected a number or text")
    try:
        return param.type.convert(tuple(map(str, value)) if isinstance(value, list) else str(value), param, None)
    except click.BadParameter as error:
        raise OptionError(f"{where}: {name}: {error.message}") from None


def _settings(value: Any, where: str) -> dict[str, str]:
    """Knobs by dotted name, as text."""
    if not isinstance(value, dict):
        raise OptionError(f"{where}: set: got {show(value)}, expected a table such as {{ 'coat.guard.count' = 300 }}")
    return {name: one if isinstance(one, str) else json.dumps(one, default=str) for name, one in flatten(value)}
