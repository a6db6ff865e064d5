"""Files of museums by their names: which are read, and how."""

from __future__ import annotations

from pathlib import Path

from furbake.rti.lp import find, read_lp
from furbake.rti.ptm import read_ptm
from furbake.rti.relight import INFO, read_relight
from furbake.rti.relit import Relit, RtiError

LP, PTM, JSON = ".lp", ".ptm", ".json"


def suffix_of(path: Path) -> str:
    """The ending by which a file is read; a folder of relight is read by its `info.json`."""
    return JSON if path.is_dir() and (path / INFO).exists() else path.suffix.lower()


def is_rti(path: Path) -> bool:
    """True for names of files of this field; a baked folder is none."""
    if path.is_dir():
        return (path / INFO).exists() and not (path / "model.gltf").exists()
    return bool(path.suffix)


def members(path: Path) -> list[Path]:
    """The other files that are read with one: photographs of a list, planes of relight. Raises RtiError."""
    kind = suffix_of(path)
    if kind == LP:
        found = (find(path, name) for name in read_lp(path).names)
        return [place for place in found if place is not None]
    folder = path if path.is_dir() else path.parent
    return sorted(folder.glob("plane_*.*")) if kind == JSON else []


def read_relit(path: Path) -> Relit:
    """The picture in a PTM or a folder of relight. Raises RtiError."""
    kind = suffix_of(path)
    if kind == PTM:
        return read_ptm(path)
    if kind == JSON:
        return read_relight(path)
    raise RtiError(f"{path}: unknown kind, expected FILE.ptm, FILE.lp, or {INFO} of relight")
