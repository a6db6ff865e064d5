"""Arguments of the commands that bake, read and draw; ranges are those of the knobs."""

from __future__ import annotations

import click

from furbake.cli.parsing import Argument, Command, action, option, switch, unset_switch
from furbake.cli.values import GUIDE, NAMES, NUMBER, PLACE, SETTING, WHOLE, NewFile, Place
from furbake.options.knobs import BITS, FOLLOW, KNOBS, MAX_FACES

QUIET = "no progress, no summary"

SCHEDULER = "workers of this machine, or those of the Dask scheduler at an address, do the work"


def ranged(text: str, knob: str) -> str:
    """Help with the range of a knob."""
    return f"{text}, {KNOBS[knob].range}"


def folder(text: str = "", **settings: object) -> Argument:
    """The baked folder that is read."""
    return Argument("folder", "DIR", text, type=PLACE, **settings)


def out(metavar: str, text: str, kind: Place = PLACE) -> click.Option:
    """The file or folder that is written."""
    return option("-o", "--out", metavar=metavar, type=kind, required=True, help=text)


def preset_options(default: str | None) -> list[click.Option]:
    """A preset, and changes of it."""
    changes = "change a knob of the preset, such as coat.guard.count=300 (furbake presets NAME lists them); repeatable"
    return [
        option(
            "--preset", metavar="NAME|FILE.toml", type=PLACE, default=default,
            help="sets what is not given (default: paper)",
        ),
        option("--set", multiple=True, type=SETTING, help=changes),
    ]  # fmt: skip


BAKE = [
    Argument(
        "model", "MODEL", "a mesh file, or sphere, plane, plane:RxC, torus, torus:RxC; by default the mesh of --groom",
        type=PLACE, required=False,
    ),
    out("DIR", "folder to write, whole or not at all"),
    *preset_options("paper"),
    option("--layers", metavar="K", type=WHOLE, help=ranged("slabs of the tile", "layers")),
    option("--size", metavar="N", type=WHOLE, help=ranged("texels per side of a slab, a power of two", "size")),
    option("--lights", metavar="N", type=WHOLE, help=ranged("sampled directions of light", "lights")),
    option("--basis", metavar="ptm|eigen", help="the paper's polynomial, or curves found for this fur"),
    option(
        "--coefficients", metavar="C", type=WHOLE,
        help=f"numbers per texel: 6, with eigen {KNOBS['coefficients'].range}",
    ),
    option("--bits", metavar="B", type=WHOLE, help=f"of a stored number, {BITS.range} (default: 6)"),
    option(
        "--curves", metavar="slab|none",
        help="mean light of each slab beside its numbers (default), or none: version 1 of the format",
    ),
    option("--length", metavar="L", type=NUMBER, help="longest fur, the model's own units"),
    option("--tile", metavar="W", type=NUMBER, help="width of a tile, the model's own units"),
    option(
        "--height", metavar="H", type=NUMBER, help=ranged("longest fur in tile widths: length / tile", "height")
    ),
    option("--seed", metavar="S", type=WHOLE, help="of all chance"),
    option("--guide", metavar="nose-tail|down|FILE.json", type=GUIDE, help="where the fur is laid"),
    option("--comb", metavar="FILE.json", type=PLACE, help="strokes along which it is combed, besides"),
    option("--uv", metavar="lapped|own", help="lapped patches (default), or the model's own coordinates"),
    option(
        "--colour", metavar="texture|vertex",
        help="each hair in the colour of the model's picture at its root (default), or one colour per vertex",
    ),
    unset_switch(
        "--own-colours", "hairs in the model's own colours, from dark to light as the preset's are, without their hues"
    ),
    option(
        "--max-faces", metavar="F", type=WHOLE,
        help=f"simplify larger models, {MAX_FACES.range} (default: 60000)",
    ),
    option("--pose", metavar="CLIP@SECONDS", help="lay the fur in a pose of the model, not in the one it is bound in"),
    option("--length-map", metavar="FILE.png|vertex:red", type=PLACE, help="black is no length"),
    option("--mask", metavar="FILE.png|vertex:red", type=PLACE, help="black is bare skin"),
    option(
        "--regions", metavar="FILE.toml|auto|1..4", type=PLACE,
        help="parts of the body with a fur of their own; of a groom their number (1), or as many as plainly differ",
    ),
    option("--features", metavar="FILE.json", type=PLACE, help="eyes, a nose and the like"),
    option("--rig", metavar="FILE.json", type=PLACE, help="joints and clips for a model that stands still"),
    unset_switch(
        "--length-by-thickness",
        "the length itself from the model's size, and down to a third of it where the body is thin "
        "(default for a file: all from the body's thickness, so that it keeps its shape)",
    ),
    unset_switch("--no-length-by-thickness", "the same length everywhere", dest="length_by_thickness", value=False),
    unset_switch("--no-fins", "no quads on the edges", dest="fins", value=False),
    unset_switch(
        "--no-meshopt", "meshes as they are, for readers without EXT_meshopt_compression", dest="meshopt", value=False
    ),
    unset_switch("--directions", "store the hairs' directions too, for other shaders"),
    unset_switch("--flat", "a flat patch under a point at infinity, for checks"),
    option("--states", metavar="dry..wet|dry,NAME", type=NAMES, help="wet states too: all five, or some"),
    unset_switch("--dirt", "a dirty state too"),
    option(
        "--swatch", metavar="FILE.lp|FILE.ptm|info.json", type=PLACE,
        help="real fur or cloth under many lamps, as a thin skin: the tile is made of it, not grown",
    ),
    option(
        "--groom", metavar="FILE", type=PLACE,
        help="an artist's strands (.usd, .hair, .tfx, .npz): length, direction, density, colours and tile are theirs",
    ),
    option(
        "--follow", metavar="N", type=WHOLE,
        help=f"hairs beside each strand of the groom, {FOLLOW.range} (default: as many as cover the skin)",
    ),
    option("--samples", metavar="FILE.npz", type=PLACE, help="write the sampled physics too, for others to check"),
    option("--cache", metavar="DIR", type=PLACE, help="where finished pelts are kept (default: the user's cache)"),
    switch("--no-cache", "neither take a finished pelt nor keep this one"),
    option("--scheduler", metavar="local|tcp://HOST:PORT", help=SCHEDULER),
    option("--device", metavar="cpu|cuda", help="where light is sampled: the processor (default), or an NVIDIA card"),
    switch("--force", "replace DIR if it is a bake"),
    switch("--if-stale", "only if DIR differs in options, input or versions; implies --force"),
    switch("--json", "print one JSON object with the record and the seconds of every stage"),
    switch("--percent", "progress as a line for every percent, for other programs to read"),
    switch("--quiet", QUIET),
]  # fmt: skip

REPORT = [
    folder(),
    switch("--no-model", "without pictures of the model, which need Node and a browser"),
    switch("--quiet", QUIET),
]

PRESETS = [
    Argument("name", "NAME", "a preset or a .toml file", type=PLACE, required=False),
    switch("--json", "as one JSON object with all their options"),
]

LESSON = [
    *preset_options("paper"),
    out("DIR", "folder to write, whole or not at all"),
    switch("--force", "replace DIR"),
    switch("--if-stale", "only if DIR differs in options or versions; implies --force"),
    switch("--json", "print the record as one JSON object"),
    switch("--quiet", QUIET),
]

GROOM = [
    folder(),
    out("FILE.npz|FILE.usdc", "file to write", NewFile(".npz", ".usdc", ".usda", ".usd")),
    switch("--json", "what was written as one JSON object"),
    switch("--quiet", QUIET),
]

COMMANDS = {
    command.name: command
    for command in (
        Command("bake", "[MODEL] -o DIR", action("baking", "run_bake"), BAKE),
        Command("inspect", "DIR", action("actions", "run_inspect"), [folder(), switch("--json", "as one JSON object")]),
        Command("validate", "DIR", action("actions", "run_validate"), [folder()]),
        Command("presets", "[NAME]", action("actions", "run_presets"), PRESETS),
        Command("report", "DIR", action("actions", "run_report"), REPORT),
        Command("lesson", "-o DIR", action("actions", "run_lesson"), LESSON),
        Command("groom", "DIR -o FILE.npz", action("actions", "run_groom"), GROOM),
    )
}
