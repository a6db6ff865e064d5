"""Arguments of `export`, and of `swatch`, which draws what museums have, too."""

from __future__ import annotations

from furbake.cli.arguments import QUIET, folder, out, preset_options
from furbake.cli.parsing import Argument, Command, action, option, switch
from furbake.cli.values import DIRECTION, PLACE, WHOLE, NewFile

EXPORT = [
    folder(),
    option(
        "--ptm", metavar="FILE.ptm", type=NewFile(".ptm"),
        help="PTM 1.2, for RTIViewer and others; replaced where it exists",
    ),
    option(
        "--relight", metavar="FOLDER", type=PLACE,
        help="info.json and planes, for OpenLIME and relight; a new folder",
    ),
    option(
        "--glb", metavar="FILE.glb", type=NewFile(".glb"),
        help="the body without its fur, for any program that reads glTF; replaced where it exists",
    ),
    option(
        "--format", "kind", metavar="lrgb|rgb",
        help="a polynomial beside a colour (default), or one for each channel",
    ),
    option("--state", metavar="NAME", help="dry (default), damp, moist, wet, soaked or dirty"),
    option(
        "--layer", metavar="K|composite",
        help="all slabs from above (default), or one alone before black, 0 at the skin",
    ),
    switch("--linear", "bytes proportional to light, not as a screen shows them"),
    option("--planes", metavar="jpg|png", help="pictures of --relight: with losses (default), or without"),
    option("--tiles", metavar="T", type=WHOLE, help="repeats of the tile along a side (default: 2); of the composite"),
    option("--pixels", metavar="P", type=WHOLE, help="side of the picture (default: 512); of the composite"),
    switch("--json", "figures as one JSON object"),
    switch("--quiet", QUIET),
]  # fmt: skip

SWATCH = [
    Argument(
        "files", "DIR|FILE", "a baked folder, or FILE.ptm, FILE.lp with its photographs, info.json of relight; "
        "with several, the first is drawn and the others are compared with it; without any a preset is baked for this",
        type=PLACE, nargs=-1,
    ),
    *preset_options(None),
    out("FILE.png|FILE.ptm", "picture to write; of an .lp also its fit as a PTM", NewFile(".png", ".ptm")),
    option("--light", type=DIRECTION, help="towards the lamp: right, up, at you"),
    option("--state", metavar="NAME", help="dry (default), damp, moist, wet, soaked or dirty"),
    option("--format", "kind", metavar="lrgb|rgb", help="how an .lp is fitted: lrgb (default) or rgb"),
    option("--tiles", metavar="T", type=WHOLE, help="repeats of the tile along a side (default: 3)"),
    option(
        "--pixels", metavar="P", type=WHOLE,
        help="side of the picture (default: 512; a FILE has its own size)",
    ),
    switch("--json", "what was drawn, and figures of the fits of an .lp, as one JSON object"),
    switch("--quiet", QUIET),
]  # fmt: skip

COMMANDS = {
    command.name: command
    for command in (
        Command(
            "export", "DIR --ptm FILE.ptm|--relight FOLDER|--glb FILE.glb", action("rti.actions", "run_export"), EXPORT
        ),
        Command("swatch", "DIR|FILE -o FILE.png", action("rti.actions", "run_swatch"), SWATCH),
    )
}
