"""Checks of the pelts of a baked folder against its extension; every problem in one sentence."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from furbake.asset.extension import EXTENSION
from furbake.asset.read import Asset
from furbake.pelt.texels.basis import smooth_terms


def _basis(basis: dict[str, Any], count: int) -> Iterator[str]:
    if basis["kind"] == "ptm" and count != 6:
        yield f"{EXTENSION}: {count} coefficients of the basis ptm, expected 6"
    if basis["kind"] == "eigen":
        terms = smooth_terms(basis["degree"])
        for length in sorted({len(row) for row in basis["matrix"]} - {terms}):
            yield f"{EXTENSION}: basis.matrix has a row of {length} weights, expected {terms}"


def pelts(asset: Asset) -> Iterator[str]:
    """Images of the sizes that the extension says, and as many numbers as there are coefficients and slabs."""
    fur = asset.fur
    count, layers, size = fur["coefficients"], fur["layers"], fur["size"]
    if size & (size - 1):
        yield f"{EXTENSION}: size {size}, expected a power of two"
    wrong = list(_basis(fur["basis"], count))
    yield from wrong
    lists = {"drift": (fur["drift"], layers)}
    lists |= {key: (fur[key], rows) for key, rows in (("environment", count), ("bent", 3), ("eye", 3)) if key in fur}
    if fur["basis"]["kind"] == "eigen" and not wrong:
        lists["basis.matrix"] = (fur["basis"]["matrix"], count)
    for i, pelt in enumerate(fur["pelts"]):
        lists |= {f"pelts[{i}].{key}": (pelt[key], count) for key in ("scale", "bias")}
        lists[f"pelts[{i}].planes"] = (pelt["planes"], 1 if count == 3 else 2)
        for index in pelt["planes"]:
            yield from _image(asset, index, (layers * size, size, 4))
        for role in ("colour", "direction"):
            if role in pelt:
                yield from _image(asset, pelt[role], (layers * size, size, 3))
        if "fin" in pelt:
            yield from _fin(asset, pelt["fin"])
    for name, (values, expected) in lists.items():
        if len(values) != expected:
            yield f"{EXTENSION}: {name} has {len(values)} rows, expected {expected}"
        elif not np.isfinite(np.array(values, dtype=np.float64)).all():
            yield f"{EXTENSION}: {name} is not finite, expected numbers"


def curves(asset: Asset) -> Iterator[str]:
    """As many tables of either kind as there are weights in each slab of each pelt; dark at the first knot."""
    fur = asset.fur
    if not fur["version"].startswith("2."):
        if "curves" in fur:
            yield f"{EXTENSION}: curves in version {fur['version']}, expected 2.0"
        return
    even, along = (fur["curves"][name] for name in ("even", "along"))
    if len(along) != len(even):
        yield f"{EXTENSION}: curves.along has {len(along)} tables, expected {len(even)} as curves.even"
    for name, tables in (("even", even), ("along", along)):
        if any(row[0] != 0 for table in tables for row in table):
            yield f"{EXTENSION}: curves.{name} is not 0 at the first knot, expected 0: no tip sees that light"
    for i, pelt in enumerate(fur["pelts"]):
        rows = pelt["weights"]
        if len(rows) != fur["layers"]:
            yield f"{EXTENSION}: pelts[{i}].weights has {len(rows)} rows, expected {fur['layers']}"
        for length in sorted({len(row) for row in rows} - {len(even)}):
            yield f"{EXTENSION}: pelts[{i}].weights has a row of {length} numbers, expected {len(even)}"
        if pelt.get("dirt", 0) and rows != fur["pelts"][0]["weights"]:
            yield f"{EXTENSION}: pelts[{i}].weights differs though it is dirty, expected that of pelts[0]"
    if "environment" in fur or any("environment" in pelt.get("fin", {}) for pelt in fur["pelts"]):
        yield f"{EXTENSION}: an environment in version {fur['version']}, expected none: curves tell it"


def multiple(asset: Asset) -> Iterator[str]:
    """In all pelts or none, a row or number per slab, colours there where the first has a plane of them."""
    fur = asset.fur
    several = ["multiple" in pelt for pelt in fur["pelts"]]
    if not any(several):
        return
    if not all(several):
        yield f"{EXTENSION}: {several.count(False)} of {len(several)} pelts have no multiple, expected all or none"
    if "curves" not in fur:
        yield f"{EXTENSION}: multiple without curves, expected both"
    for i, pelt in enumerate(fur["pelts"]):
        record = pelt.get("multiple", {})
        for key in ("shares", "ratio", "seen", "tint", "colour"):
            if key in record and len(record[key]) != fur["layers"]:
                yield f"{EXTENSION}: pelts[{i}].multiple.{key} has {len(record[key])} rows, expected {fur['layers']}"
        if record and ("colour" in record) != ("colour" in fur["pelts"][0]):
            yield f"{EXTENSION}: one of pelts[{i}].multiple and pelts[0] has no colour, expected both or none"


def states(asset: Asset) -> Iterator[str]:
    """Several states: dry first, each with a name of its own, all to be mixed texel by texel."""
    fur = asset.fur
    found = fur["pelts"]
    if found[0].get("wetness", 0) or found[0].get("dirt", 0):
        yield f"{EXTENSION}: pelts[0] is not dry and clean, expected what a reader of one pelt shows"
    names = [pelt["name"] for pelt in found]
    if len(set(names)) < len(names):
        yield f"{EXTENSION}: pelts are called {', '.join(names)}, expected names that differ"
    dirty = [pelt for pelt in found if pelt.get("dirt", 0)]
    wetness = [pelt.get("wetness", 0) for pelt in found if pelt not in dirty]
    if sorted(set(wetness)) != wetness:
        listed = ", ".join(f"{value:g}" for value in wetness)
        yield f"{EXTENSION}: clean pelts have the wetness {listed}, expected one that rises"
    if any(pelt.get("wetness", 0) for pelt in dirty):
        yield f"{EXTENSION}: pelt {dirty[0]['name']} is wet and dirty, expected one of the two"
    if len(dirty) > 1:
        yield f"{EXTENSION}: {len(dirty)} pelts are dirty, expected one"
    if dirty and "mud" not in fur:
        yield f"{EXTENSION}: pelt {dirty[0]['name']} is dirty but there is no mud, expected its colour"
    if dirty and fur["coefficients"] == 3:
        yield f"{EXTENSION}: pelt {dirty[0]['name']} is dirty with 3 coefficients, expected 4 to 6"
    yield from _mixable(found)


def _mixable(found: list[dict[str, Any]]) -> Iterator[str]:
    """The bytes of all states mean the same."""
    first = found[0]
    for i, pelt in enumerate(found[1:], 1):
        for key in ("scale", "bias"):
            if pelt[key] != first[key]:
                yield f"{EXTENSION}: pelts[{i}].{key} differs, expected that of pelts[0]"
        if not pelt.get("dirt", 0) and ("colour" in pelt) != ("colour" in first):
            yield f"{EXTENSION}: one of pelts[0] and pelts[{i}] has no colour, expected both or none"
        if "fin" in pelt and "fin" in first:
            for key in ("width", "height", "scale", "bias"):
                if pelt["fin"][key] != first["fin"][key]:
                    yield f"{EXTENSION}: pelts[{i}].fin.{key} differs, expected that of pelts[0]"


def _fin(asset: Asset, fin: dict[str, Any]) -> Iterator[str]:
    """The fur's side view: a polynomial of six coefficients in two planes."""
    shape = (fin["height"], fin["width"])
    for index in fin["planes"]:
        yield from _image(asset, index, (*shape, 4))
    if "colour" in fin:
        yield from _image(asset, fin["colour"], (*shape, 3))
    for key, expected in (("planes", 2), ("scale", 6), ("bias", 6), ("environment", 6)):
        if key not in fin:
            continue
        if len(fin[key]) != expected:
            yield f"{EXTENSION}: fin.{key} has {len(fin[key])} rows, expected {expected}"
        elif not np.isfinite(np.array(fin[key], dtype=np.float64)).all():
            yield f"{EXTENSION}: fin.{key} is not finite, expected numbers"
    if fin["basis"]["kind"] != "ptm":
        yield f"{EXTENSION}: fin.basis is {fin['basis']['kind']}, expected ptm"


def _image(asset: Asset, index: int, shape: tuple[int, int, int]) -> Iterator[str]:
    images = asset.document.get("images", [])
    if index >= len(images):
        yield f"{EXTENSION}: a pelt uses image {index}, expected one of {len(images)}"
        return
    got = asset.image(index).shape
    if got != shape:
        yield (
            f"{images[index]['uri']}: {got[1]} × {got[0]} texels with {got[2]} channels, "
            f"expected {shape[1]} × {shape[0]} with {shape[2]}"
        )
