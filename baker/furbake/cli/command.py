"""The command as a whole: from arguments to an exit status, every failure in one line."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Sequence

from furbake.asset.planes import PlaneError
from furbake.asset.read import AssetError
from furbake.asset.store import StoreError
from furbake.cli.actions import INVALID
from furbake.cli.arguments import UsageError, parser
from furbake.groom.files import GroomError
from furbake.options import OptionError
from furbake.pathtrace import VerifyError
from furbake.surface.mesh import MeshError

BAD_INPUT, INTERRUPTED = 2, 130


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command; its exit status: 0 done, 1 something is invalid, 2 bad input, 130 interrupted."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")  # a name of a file may hold anything
    try:
        args = parser().parse_args(_joined(sys.argv[1:] if argv is None else argv))
        run: Callable[[argparse.Namespace], int] = args.run
        status = run(args)
        sys.stdout.flush()
    except (UsageError, OptionError, MeshError, StoreError, AssetError, PlaneError, VerifyError, GroomError) as error:
        return _fail(str(error))
    except BrokenPipeError:  # whoever read the output has gone
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return INVALID
    except OSError as error:
        what = error.filename or "file"
        return _fail(f"{what}: {(error.strerror or str(error)).lower()}, expected it to be readable or writable")
    except MemoryError:
        return _fail("memory: not enough for this bake, expected smaller --layers, --size or --lights")
    except KeyboardInterrupt:
        print("furbake: interrupted, nothing written", file=sys.stderr)
        return INTERRUPTED
    return status


def _joined(argv: Sequence[str]) -> list[str]:
    """`--light -1,0,1` as `--light=-1,0,1`: argparse takes what begins with a minus for another option."""
    joined: list[str] = []
    for argument in argv:
        if joined and joined[-1] == "--light" and argument[:1] == "-" and argument[1:2].isdigit():
            joined[-1] += f"={argument}"
        else:
            joined.append(argument)
    return joined


def _fail(message: str) -> int:
    print(f"furbake: error: {' '.join(message.split())}", file=sys.stderr)
    return BAD_INPUT
