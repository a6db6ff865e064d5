"""Freshness of a baked folder: the same bake would write it again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from furbake.asset.read import AssetError, read_asset
from furbake.identity import bake_key, library_versions
from furbake.options import BakeOptions


def fresh_record(model: str, out: Path, options: BakeOptions) -> dict[str, Any] | None:
    """The record of a whole bake of the same options, versions and input in `out`, if there is one."""
    try:
        record = read_asset(out).record
        whole = all((out / name).stat().st_size == size for name, size in record["asset"]["bytes"].items())
        made_alike = record["libraries"] == library_versions() and record["key"] == bake_key(model, options)
        return record if whole and made_alike else None
    except (AssetError, OSError, LookupError, TypeError, AttributeError):
        return None
