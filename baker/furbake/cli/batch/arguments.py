"""Arguments of `furbake batch`."""

from __future__ import annotations

from furbake.cli.arguments import QUIET, SCHEDULER, out, preset_options
from furbake.cli.parsing import Argument, Command, action, option, switch
from furbake.cli.values import PLACE, SIZE, WHOLE

BATCH = [
    Argument(
        "models", "LIST.toml|FOLDER|MODEL ...", "a list of models with options, folders of them, files or 'globs*'",
        type=PLACE, nargs=-1, required=True,
    ),
    out("OUT", "folder of the baked folders, with index.html, a contact sheet"),
    *preset_options(None),
    option("--jobs", metavar="N", type=WHOLE, help="bakes at the same time, at most (default: one per core)"),
    option(
        "--memory", metavar="BYTES", type=SIZE,
        help="memory for all of them and the command together, such as 8G or 500M (default: 80 % of what is free); "
        "with the address of a --scheduler, of each",
    ),
    option("--scheduler", metavar="local|tcp://HOST:PORT", help=SCHEDULER),
    switch("--send", "with --scheduler: send models there and results back, where no folder is shared"),
    option("--cache", metavar="DIR", type=PLACE, help="where finished pelts are kept (default: the user's cache)"),
    switch("--no-cache", "neither take a finished pelt nor keep one"),
    switch("--json", "print one JSON object for each bake that has ended, and one for all of them"),
    switch("--quiet", QUIET),
]  # fmt: skip

COMMANDS = {"batch": Command("batch", "LIST.toml|FOLDER|MODEL ... -o OUT", action("batch.run", "run_batch"), BATCH)}
