"""Locked versions are those that the project asks for."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

BAKER = Path(__file__).parents[2] / "baker"
PROJECT = tomllib.loads((BAKER / "pyproject.toml").read_text("utf-8"))["project"]
BUILD = (BAKER / "requirements" / "build.in").read_text("utf-8").split()
USE = [*PROJECT["dependencies"], *BUILD]


@pytest.mark.parametrize(
    ("name", "wanted"), [("use", USE), ("dev", [*USE, *PROJECT["optional-dependencies"]["dev"]])], ids=["use", "dev"]
)
def test_the_lock_is_of_this_project(name: str, wanted: list[str]) -> None:
    text = (BAKER / "requirements" / f"{name}.txt").read_text("utf-8")
    locked = dict(re.findall(r"^([\w.-]+)==([\w.]+)", text, re.MULTILINE))
    for requirement in map(Requirement, wanted):
        version = locked[canonicalize_name(requirement.name)]
        assert requirement.specifier.contains(version), f"{requirement}: locked is {version}: run npm run lock"
    assert len(re.findall(r"^[\w.-]+==.*\\\n +--hash=sha256:", text, re.MULTILINE)) == len(locked)
