"""The command as a whole: from arguments to an exit status, every failure in one line."""

from __future__ import annotations

import sys
from collections.abc import Sequence

import click

from furbake.cli.interrupt import INTERRUPTED, MESSAGE, end_as_interrupted, importing
from furbake.cli.output import complain, drop_output, open_streams
from furbake.cli.parsing import FULL, Entry, Group, UsageError, sentence

INVALID, BAD_INPUT = 1, 2

COMMANDS = {
    "bake": Entry("arguments", "bake a mesh into a folder: 10 s to 1 min on two cores, by --layers and --size"),
    "batch": Entry("batch.arguments", "bake many meshes, several at a time, and a contact sheet of them"),
    "inspect": Entry("arguments", "say what is in a baked folder"),
    "validate": Entry("arguments", "check a baked folder: exit 1 and a list if it is bad"),
    "presets": Entry("arguments", "list the presets, or all knobs of one as TOML to copy"),
    "report": Entry("arguments", "write DIR/report.html: how good the bake is, and where it is not"),
    "swatch": Entry(
        "rti.arguments", "picture of a baked pelt, of a preset's, or of what museums have: .ptm, .lp, relight"
    ),
    "lesson": Entry("arguments", "data of the lesson on the page Learn"),
    "verify": Entry("studies", "compare a bake with a path tracer (Mitsuba 3)"),
    "compare": Entry("studies", "table of presets and bases, measured anew, as Markdown"),
    "states": Entry("studies", "table of how states of fur mix, baked anew, as Markdown"),
    "trim": Entry("studies", "table of fur that is cut at run time, as Markdown"),
    "bend": Entry("studies", "table of how right the light on bent fur is, as Markdown"),
    "patches": Entry("studies", "table of how lapped patches cover models, as Markdown"),
    "groom": Entry("arguments", "write the strands of a baked fur on its body"),
    "export": Entry("rti.arguments", "write a pelt from above for RTI viewers (PTM, relight), or the body as a GLB"),
}

FURBAKE = Group("furbake", COMMANDS, help="Bakes fur that can be relit in real time, from any mesh.")
click.version_option(package_name="furbake", message="%(prog)s %(version)s")(FURBAKE)


def run(argv: Sequence[str] | None) -> int:
    """Run the command; its exit status."""
    open_streams()
    end_as_interrupted()
    arguments = list(sys.argv[1:] if argv is None else argv)
    try:
        with FURBAKE.make_context("furbake", list(arguments)) as context:
            status: int = FURBAKE.invoke(context)
        sys.stdout.flush()
    except click.exceptions.Exit as end:
        return end.exit_code
    except click.UsageError as error:
        return _fail(sentence(error, arguments))
    except UsageError as error:
        return _fail(str(error))
    except KeyboardInterrupt:
        complain(MESSAGE)
        return INTERRUPTED
    except BrokenPipeError:  # the reader of the output has closed it
        drop_output()
        return INVALID
    except Exception as error:
        if (text := told(error)) is None:
            raise
        return _fail(text)
    return status


def told(error: Exception) -> str | None:
    """An error of the user's as a sentence; None for one of furbake's own."""
    with importing():
        from furbake.cli.failures import TOLD  # noqa: PLC0415 — imports all that can fail
    if isinstance(error, TOLD):
        return str(error)
    if isinstance(error, OSError):
        expected = "room to write" if error.errno in FULL else "it to be readable or writable"
        return f"{error.filename or 'file'}: {(error.strerror or str(error)).lower()}, expected {expected}"
    if isinstance(error, MemoryError):
        return "memory: not enough for this bake, expected smaller --layers, --size or --lights"
    return None


def _fail(message: str) -> int:
    complain(f"error: {message}")
    return BAD_INPUT
