"""Lines on the terminal: names from files cannot steer it."""

from __future__ import annotations

import os
import sys


def open_streams() -> None:
    """Open the null device in place of closed standard streams, and show what a terminal's encoding lacks as escapes.

    Otherwise the next file that is opened would get the number of the closed one, and what is printed.
    """
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            number = os.open(os.devnull, os.O_RDWR)
            os.set_inheritable(number, True)
            setattr(sys, name, os.fdopen(number, mode))
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")


def drop_output() -> None:
    """Forget what standard output has not taken."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def printable(text: str) -> str:
    """Text with its control characters, but for ends of lines, as escapes."""
    return "".join(
        character if character.isprintable() or character == "\n" else character.encode("unicode_escape").decode()
        for character in text
    )


def say(text: str, end: str = "\n", *, flush: bool = False) -> None:
    """Print to standard output."""
    print(printable(text), end=end, flush=flush)


def complain(text: str) -> None:
    """Print one line to standard error."""
    print(f"furbake: {printable(' '.join(text.split()))}", file=sys.stderr)
