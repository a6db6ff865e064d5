"""Tables of the docs agree with the command.

    baker/.venv/bin/python tests/baker/test_docs.py

writes the ranges of the knobs into `web/docs/presets.md`.
"""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path

import pytest

from furbake import cli
from furbake.cli.arguments import BAKE
from furbake.cli.command import COMMANDS
from furbake.options.knobs import KNOBS

DOCS = Path(__file__).parents[2] / "web" / "docs"
PRESETS, OPTIONS = DOCS / "presets.md", DOCS / "options.md"


def printed(*arguments: str) -> str:
    """Standard output of the command."""
    with contextlib.redirect_stdout(io.StringIO()) as out:
        cli.main(list(arguments))
    return out.getvalue()


def between(page: Path, name: str) -> str:
    """Text between the markers `<!-- name -->` and `<!-- /name -->` of a page."""
    _, _, rest = page.read_text("utf-8").partition(f"<!-- {name} -->\n")
    table, end, _ = rest.partition(f"<!-- /{name} -->")
    assert end, f"{page.name}: got no markers {name}, expected both"
    return table


def ranges() -> dict[str, str]:
    """Range of every knob by its dotted name."""
    return {name: knob.expected for name, knob in KNOBS.items()}


def with_ranges(table: str) -> str:
    """The table of knobs with today's ranges in its second column."""
    takes = ranges()
    row = re.compile(r"^\| `([\w.]+)` \|[^|]*\|", re.MULTILINE)
    return row.sub(lambda found: f"| `{found[1]}` | {takes.get(found[1], 'no such knob')} |", table)


def test_every_knob_is_in_the_docs_with_its_range() -> None:
    table = between(PRESETS, "knobs")
    written = re.findall(r"^\| `([\w.]+)` \|", table, re.MULTILINE)
    # Both kinds of hair have the same knobs: one row each.
    assert written == [name for name in ranges() if not name.startswith("coat.under.")]
    assert table == with_ranges(table), "run baker/.venv/bin/python tests/baker/test_docs.py"


def test_both_kinds_of_hair_have_the_same_knobs() -> None:
    def kind(prefix: str) -> dict[str, str]:
        return {name.removeprefix(prefix): takes for name, takes in ranges().items() if name.startswith(prefix)}

    assert kind("coat.guard.") == kind("coat.under.") != {}


def test_every_option_of_a_bake_is_in_the_docs() -> None:
    flags = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
    known = {name for param in BAKE for name in param.opts if name.startswith("--")}
    first_cells = re.findall(r"^\| (`.*?) \| ", between(OPTIONS, "options"), re.MULTILINE)
    written = [flag for cell in first_cells for flag in flags.findall(cell)]
    assert sorted(written) == sorted(known)


def test_every_command_is_in_the_docs() -> None:
    written = re.findall(r"^\| `(\w+)` \|", between(OPTIONS, "commands"), re.MULTILINE)
    assert sorted(written) == sorted(COMMANDS) != []


@pytest.mark.parametrize("name", ["bunny", "fox", "mole", "paper", "sheep", "teddy", "wolf"])
def test_presets_are_stored_as_the_docs_have_it(name: str) -> None:
    values = dict(re.findall(r"^(\w+) = (\S+)", printed("presets", name), re.MULTILINE))
    stored = f"{values['layers']} × {values['size']}²"
    colours = ", colour plane" if values["colour_plane"] == "true" else ""
    assert re.search(rf"^\| `{name}` \| .+ \| {stored}{colours} \|$", PRESETS.read_text("utf-8"), re.MULTILINE)


if __name__ == "__main__":
    before = between(PRESETS, "knobs")
    PRESETS.write_text(PRESETS.read_text("utf-8").replace(before, with_ranges(before)), "utf-8")
