"""Arguments of the commands that measure how good a bake is."""

from __future__ import annotations

import click

from furbake.cli.parsing import Argument, Command, Many, action, option, switch
from furbake.cli.values import NAMES, NUMBER, PLACE, SHARE, WHOLE, NewFile, Whole
from furbake.options.knobs import KNOBS, MAX_FACES
from furbake.study.bend import AZIMUTHS, TIPS
from furbake.study.trim import LENGTHS
from furbake.study.verify.body import METHODS, SIZE, SPP
from furbake.study.verify.cells import PLANS
from furbake.study.verify.tile import SAMPLES

OWN_SIZE = "texels per side of a slab (default: the preset's)"


def names() -> Argument:
    """The presets that are measured."""
    return Argument("names", "NAME", "presets or .toml files (default: all)", type=PLACE, nargs=-1)


def lights(default: int, text: str = "lights of the fit") -> click.Option:
    """The number of sampled lights."""
    return option(
        "--lights", metavar="N", type=Whole(KNOBS["lights"]), default=default, help=f"{text} (default: {default})"
    )


QUIET = switch("--quiet", "no progress")

VERIFY = [
    Argument("folder", "DIR", type=PLACE),
    switch("--body", "the strands on their body, beside the page's own shader (needs Node)"),
    option(
        "-o", "--out", "--picture", "out", metavar="FILE.png", type=NewFile(".png"),
        help="picture with both side by side",
    ),
    option("--spp", metavar="N", type=WHOLE, help=f"paths per pixel (default: {SAMPLES}, with --body {SPP})"),
    option("--size", metavar="N", type=WHOLE, default=SIZE, help=f"with --body: pixels across (default: {SIZE})"),
    option(
        "--distance", metavar="D", type=NUMBER, default=1.0,
        help="with --body: of the camera, 1: all of the fur is seen (default), 0.35: close up",
    ),
    option(
        "--methods", metavar="NAME,...", type=NAMES, default=METHODS,
        help=f"with --body: ways to light the fur (default: {','.join(METHODS)})",
    ),
    option("--plan", metavar="|".join(PLANS), help="with --body: eyes and lamps (default: round of sphere and torus)"),
    switch("--colour", "with --body: hairs in their own colours; tells mean colours alone"),
    switch("--ceiling", "with --body: the samples' own composite too, without any fit"),
    option("--gloss", metavar="N", type=NUMBER, default=0.0, help="with --body: highlights on the page (default: 0)"),
    option(
        "--backlight", metavar="N", type=NUMBER, default=0.0,
        help="with --body: light from behind on the page (default: 0)",
    ),
    option(
        "--groom", metavar="FILE", type=PLACE,
        help="fields of a baked groom beside strands they have not seen; with --body: the strands that are the truth",
    ),
    option(
        "--truth", metavar="FILE.npz", type=NewFile(".npz"), help="with --body: keeps what was traced for the next run"
    ),
    option(
        "--cycles", metavar="PYTHON", type=PLACE,
        help="with --body: truth by Blender's path tracer, of this Python (pip install bpy==4.5.*), not by Mitsuba",
    ),
    option(
        "--beside", metavar="DIR", type=PLACE,
        help="another bake of the same body: the page's pictures of both (needs Node), and how far strands differ",
    ),
    switch("--eyes", "of a flat bake: brightness seen from twelve places under five lights"),
    switch("--scalar", "with --body: trace without LLVM: slower, in less memory"),
    switch("--json", "figures as one JSON object"),
    switch("--quiet", "no progress, no summary"),
]  # fmt: skip

STATES = [
    names(),
    lights(64, "lights of the fits"),
    option("--size", metavar="N", type=WHOLE, default=64, help="texels per side of a slab (default: 64)"),
    switch("--json", "every figure, as a JSON list"),
    QUIET,
]

TRIM = [
    names(),
    Many(["--lengths"], metavar="S...", type=SHARE, default=LENGTHS, help="shares of the fur that are left"),
    lights(64),
    option("--size", metavar="N", type=WHOLE, help=OWN_SIZE),
    QUIET,
]

BEND = [
    names(),
    Many(
        ["--tips"], metavar="H...", type=NUMBER, default=TIPS,
        help="how far tips are displaced, shares of the height (default: 0.3 0.5)",
    ),
    option(
        "--azimuths", metavar="N", type=WHOLE, default=AZIMUTHS,
        help=f"in how many directions, the first along the lean (default: {AZIMUTHS})",
    ),
    option("--size", metavar="N", type=WHOLE, help=OWN_SIZE),
    QUIET,
]  # fmt: skip

PATCHES = [
    Argument("models", "MODEL", type=PLACE, nargs=-1, required=True),
    option(
        "--faces", metavar="F", type=Whole(MAX_FACES),
        help=f"of a simplified copy of each, {MAX_FACES.range} (default: as they are)",
    ),
]  # fmt: skip

COMPARE = [names(), lights(192), option("--size", metavar="N", type=WHOLE, help=OWN_SIZE), QUIET]

COMMANDS = {
    command.name: command
    for command in (
        Command("verify", "DIR", action("actions", "run_verify"), VERIFY),
        Command("compare", "[NAME ...]", action("tables", "run_compare"), COMPARE),
        Command("states", "[NAME ...]", action("tables", "run_states"), STATES),
        Command("trim", "[NAME ...]", action("tables", "run_trim"), TRIM),
        Command("bend", "[NAME ...]", action("tables", "run_bend"), BEND),
        Command("patches", "MODEL ...", action("tables", "run_patches"), PATCHES),
    )
}
