"""Imports only go down, and only the command prints or exits."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import furbake

ROOT = Path(furbake.__file__).parent
MODULES = sorted(ROOT.rglob("*.py"))

FLOORS: dict[str, set[str]] = {
    "byte_units": set(),
    "cores": set(),
    "device": set(),
    "apart": set(),
    "beside": {"apart", "cores"},
    "usd": {"apart"},
    "pelt/hairs": set(),
    "pelt/light": {"pelt/hairs", "cores", "device"},
    "pelt/texels": {"pelt/hairs"},
    "pelt": {"pelt/hairs", "pelt/light", "pelt/texels", "cores"},
    "surface/soup": set(),
    "surface/charts": set(),
    "surface/repair": {"surface/soup"},
    "surface/rig": {"surface/soup", "surface/repair"},
    "surface/material": {"surface/soup", "surface/repair"},
    "surface/limits": {"surface/soup", "byte_units"},
    "surface/files": {"surface/limits", "surface/soup"},
    "surface/colours": {"surface/soup", "surface/material", "surface/limits"},
    "surface/read": {
        "usd",
        *(f"surface/{name}" for name in ("soup", "rig", "material", "colours", "repair", "limits", "files")),
    },
    "surface/mesh": {f"surface/{name}" for name in ("soup", "charts", "repair", "rig", "material", "colours", "read")},
    "surface/divide": {f"surface/{name}" for name in ("mesh", "soup", "material", "repair")},
    "surface/shapes": {"surface/mesh", "surface/charts", "surface/repair"},
    "surface/lay": {"surface/mesh", "surface/charts", "surface/soup", "surface/repair"},
    "surface/place": {f"surface/{name}" for name in ("mesh", "charts", "colours", "repair", "lay", "files")},
    "surface/roots": {
        "cores",
        *(f"surface/{name}" for name in ("mesh", "charts", "colours", "material", "repair", "soup")),
    },
    "surface/skeleton": {f"surface/{name}" for name in ("mesh", "soup", "files", "repair", "rig", "lay", "place")},
    "asset": {"pelt", "surface", "cores", "cache"},
    "options": {"pelt", "lazy", "surface/files", "surface/limits", "surface/soup"},
    "rti": {"asset", "pelt", "surface", "daylight"},
    "identity": {"options", "surface", "rti"},
    "imported": {"asset", "pelt", "surface", "usd"},
    "body": {"asset", "surface", "options", "imported", "pelt"},
    "cache": set(),
    "tile": {"pelt", "options", "cache", "rti", "beside", "device"},
    "lazy": set(),
    "page": set(),
    "daylight": set(),
    "pipeline": {"imported", "asset", "pelt", "surface", "options", "identity", "body", "tile", "beside", "device"},
    "freshness": {"asset", "identity", "options"},
    "batch": {"asset", "pelt", "surface", "options", "cores", "apart", "freshness", "identity", "pipeline", "show"},
    "cluster": {"asset", "identity", "options", "tile", "apart", "batch", "pelt", "surface", "cores", "rti", "device"},
    "groom": {"imported", "asset", "pelt", "options", "usd"},
    "show": {"imported", "asset", "pelt", "options", "identity", "tile", "page", "daylight", "rti"},
    "study": {
        "apart",
        "asset",
        "pelt",
        "surface",
        "options",
        "tile",
        "groom",
        "page",
        "daylight",
        "imported",
        "body",
    },
    "cli": {
        "imported",
        "asset",
        "pelt",
        "surface",
        "options",
        "identity",
        "body",
        "tile",
        "pipeline",
        "groom",
        "show",
        "study",
        "page",
        "byte_units",
        "cores",
        "device",
        "freshness",
        "batch",
        "cluster",
        "rti",
        "usd",
    },
    "": {"asset", "surface", "options", "pipeline", "lazy"},
}
"""Rooms and the rooms below each that it may import; a floor stands for all rooms in it. "" is the package's face.

`pelt` and `surface` never know each other.
"""

MAX_LINES = 60
"""Lines of a function; a longer one has a comment above it, `# Long: ` and the reason."""

MAX_FILES = 15
"""Files of code in a folder."""

ONLY_IN: dict[str, str | tuple[str, ...]] = {
    "OpenImageIO": "asset/planes.py",
    "cupy": "device.py",
    "embreex": "surface/place/thickness.py",
    "DracoPy": "surface/read/gltf_data.py",
    "PIL": ("surface/colours.py", "show/sheet.py"),
    "psutil": "batch/memory.py",
    "fast_simplification": "surface/repair/simplify.py",
    "filelock": "asset/store.py",
    "ctypes": "asset/exchange.py",
    "platformdirs": "cli/baking.py",
    "rich": "cli",
    "click": "cli",
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


def dotted(path: Path) -> str:
    """Name of a module below the package; "" of the package itself."""
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix("__init__").rstrip(".")


DOTTED = {dotted(path): path for path in MODULES}


def arrows(path: Path) -> set[str]:
    """Modules of the package that a module imports."""
    names = {
        name.partition(".")[2] for name in imports(ast.parse(path.read_text("utf-8"))) if name.startswith("furbake")
    }
    return {name if name in DOTTED else name.rpartition(".")[0] for name in names}


def room(module: str) -> str:
    """The innermost room of `FLOORS` that holds a module."""
    parts = module.split(".") if module else []
    return next(name for i in range(len(parts), -1, -1) if (name := "/".join(parts[:i])) in FLOORS)


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_imports_go_down(path: Path) -> None:
    own = room(dotted(path))
    used = {room(name) for name in arrows(path)} - {own}
    allowed = FLOORS[own]
    assert {name for name in used if name not in allowed and name.partition("/")[0] not in allowed} == set()


def circles(graph: dict[str, set[str]]) -> set[str]:
    """Nodes on a circle of arrows, or above one."""
    left = dict(graph)
    while free := [name for name, below in left.items() if not below & left.keys()]:
        for name in free:
            del left[name]
    return set(left)


def test_no_module_imports_itself_by_others() -> None:
    assert circles({name: arrows(path) - {name} for name, path in DOTTED.items()}) == set()


def test_floors_have_no_circle() -> None:
    def rooms(floor: str) -> set[str]:
        return {name for name in FLOORS if name == floor or name.startswith(f"{floor}/")}

    graph = {own: {name for floor in below for name in rooms(floor)} - {own} for own, below in FLOORS.items()}
    assert circles(graph) == set()


@pytest.mark.parametrize(
    "folder", sorted({path.parent for path in MODULES}), ids=lambda path: str(path.relative_to(ROOT))
)
def test_a_folder_is_seen_at_a_glance(folder: Path) -> None:
    assert len(list(folder.glob("*.py"))) <= MAX_FILES


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_libraries_have_one_home(path: Path) -> None:
    used = {name.split(".")[0] for name in imports(ast.parse(path.read_text("utf-8")))}
    for library, home in ONLY_IN.items():
        homes = (home,) if isinstance(home, str) else home
        assert library not in used or any(path.is_relative_to(ROOT / one) for one in homes), f"{library} is {home}'s"


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_only_the_command_prints_or_exits(path: Path) -> None:
    if path.is_relative_to(ROOT / "cli"):
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


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(ROOT)))
def test_a_long_function_says_why(path: Path) -> None:
    lines = path.read_text("utf-8").splitlines()
    functions = [node for node in ast.walk(ast.parse("\n".join(lines))) if isinstance(node, ast.FunctionDef)]
    starts = {node: min([node.lineno, *(mark.lineno for mark in node.decorator_list)]) for node in functions}
    for node, start in starts.items():
        reason = lines[start - 2].strip() if start > 1 else ""
        long = (node.end_lineno or start) - node.lineno + 1 > MAX_LINES
        assert long == reason.startswith("# Long: "), node.name
