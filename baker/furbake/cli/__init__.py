"""The command `furbake`: the only room that prints, shows progress or exits."""

from furbake.cli.command import main

__all__ = ["main"]
