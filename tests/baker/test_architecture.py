"""Imports only go down, and only the command prints or exits."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import furbake

ROOT = Path(furbake.__file__).parent
MODULES = sorted(ROOT.rglob("*.py"))

FLOORS = {
    "pelt": {"pelt"},
    "surface": {"surface"},
    "asset": {"asset", "pelt", "surface"},
    "knobs": set(),
    "options": {"pelt", "knobs"},
    "identity": {"options", "surface"},
    "body": {"asset", "surface", "options"},
    "tile": {"pelt", "options"},
    "sides": {"pelt", "options"},
    "bake": {"asset", "pelt", "surface", "options", "identity", "body", "sides", "tile"},
    "swatch": {"asset", "pelt", "options"},
    "report": {"asset", "pelt", "options", "tile", "swatch", "report"},
    "pathtrace": {"pelt"},
    "verify": {"asset", "pelt", "options", "tile", "pathtrace"},
    "compare": {"pelt", "options", "tile"},
    "halfway": {"pelt", "options", "tile", "verify"},
    "trim": {"pelt", "options", "tile", "verify"},
    "bend": {"pelt", "knobs", "options", "tile"},
    "lesson": {"asset", "pelt", "options", "identity", "tile"},
    "cli": {
        "asset",
        "pelt",
        "surface",
        "options",
        "identity",
        "bake",
        "body",
        "swatch",
        "report",
        "verify",
        "pathtrace",
        "compare",
        "halfway",
        "trim",
        "bend",
        "lesson",
        "cli",
    },
    "__init__": {"asset", "surface", "options", "bake"},
}
"""What each room may import. `pelt` and `surface` never know each other."""

ONLY_IN = {
    "OpenImageIO": "asset/planes.py",
    "embreex": "surface/thickness.py",
    "DracoPy": "surface/gltf_data.py",
    "PIL": "surface/colours.py",
    "fast_simplification": "surface/simplify.py",
    "rich": "cli/progress.py",
    "argparse": "cli",
}


def imports(tree: ast.AST) -> set[str]:
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports are absolute"
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return found


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_imports_go_down(path: Path) -> None:
    room = path.relative_to(ROOT).parts[0].removesuffix(".py")
    used = {name.split(".")[1] for name in imports(ast.parse(path.read_text("utf-8"))) if name.startswith("furbake.")}
    assert used <= FLOORS[room]


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_libraries_have_one_home(path: Path) -> None:
    used = {name.split(".")[0] for name in imports(ast.parse(path.read_text("utf-8")))}
    for library, home in ONLY_IN.items():
        assert library not in used or path.is_relative_to(ROOT / home), f"{library} belongs to {home}"


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_only_the_command_prints_or_exits(path: Path) -> None:
    if path.parent == ROOT / "cli":
        return
    tree = ast.parse(path.read_text("utf-8"))
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    assert not names & {"print", "input", "exit", "quit", "SystemExit", "breakpoint"}
    assert not imports(tree) & {"sys", "sys.exit", "sys.stdout", "sys.stderr"}


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_a_module_has_one_job(path: Path) -> None:
    text = path.read_text("utf-8")
    assert len(text.splitlines()) <= 300
    assert not text or ast.get_docstring(ast.parse(text)), "a module says what it is for"
