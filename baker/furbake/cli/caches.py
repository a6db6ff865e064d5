"""Where finished pelts are kept."""

from __future__ import annotations

import os
from pathlib import Path
from types import SimpleNamespace

from platformdirs import user_cache_path

from furbake.options import OptionError

FOLDER = "FURBAKE_CACHE"
"""Environment variable that names the folder; empty: no cache."""


def pelt_cache(args: SimpleNamespace) -> Path | None:
    """Folder of `--cache`, of the environment, or the user's own; None where nothing is to be kept."""
    given = getattr(args, "cache", None)
    if getattr(args, "no_cache", False):
        if given:
            raise OptionError(f"cache: got {given!r} and --no-cache, expected one of them")
        return None
    folder = given or os.environ.get(FOLDER)
    if folder == "":
        return None
    return user_cache_path("furbake", appauthor=False) / "pelts" if folder is None else Path(folder)
