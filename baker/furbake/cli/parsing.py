"""Commands, arguments and options by click, their errors as one sentence.

click, because its errors are objects: argparse's were English text to be matched. It takes 25 ms longer to import;
typer, with rich, 110. Help is click's own: rich's would take those 110.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from types import SimpleNamespace
from typing import Any

import click

from furbake.cli.interrupt import importing

FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
"""Errors of a disk, a quota or a file that is full."""

HELP = {"help_option_names": ["-h", "--help"], "allow_extra_args": True}


class UsageError(ValueError):
    """A command line that cannot be understood; the message names the argument, what was got and expected."""


class Argument(click.Argument):
    """Argument that help explains."""

    def __init__(self, name: str, metavar: str, text: str = "", **settings: Any) -> None:
        super().__init__([name], metavar=metavar, **settings)
        self.text = text


class Many(click.Option):
    """Option that takes all values up to the next option."""

    def __init__(self, names: Sequence[str], **settings: Any) -> None:
        super().__init__(names, multiple=True, **settings)


class Command(click.Command):
    """Command whose help shows its usage as `shape`, and explains its arguments."""

    def __init__(self, name: str, shape: str, run: Callable[..., int], params: Sequence[click.Parameter]) -> None:
        super().__init__(name, callback=run, params=list(params), context_settings=HELP)
        self.shape = shape

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """The values, into the context. Raises UsageError for arguments too many."""
        many = {name for param in self.params if isinstance(param, Many) for name in param.opts}
        try:
            rest = super().parse_args(ctx, _repeated(args, many))
        except click.UsageError as error:
            error.ctx = error.ctx or ctx
            raise
        if ctx.args:
            raise UsageError(f"{' '.join(ctx.args)}: unknown, expected arguments of '{ctx.command_path} --help'")
        return rest

    def collect_usage_pieces(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 — click's signature
        """The usage after the command's name."""
        return [self.shape, "[OPTIONS]"]

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Arguments, then options."""
        rows = [(str(param.metavar), param.text) for param in self.params if isinstance(param, Argument) and param.text]
        if rows:
            with formatter.section("Arguments"):
                formatter.write_dl(rows)
        super().format_options(ctx, formatter)


@dataclass(frozen=True)
class Entry:
    """A command before it is imported: module of `furbake.cli` that defines it, and its line of help."""

    module: str
    text: str


class Group(click.Group):
    """Commands that are imported when they are asked for."""

    def __init__(self, name: str, entries: Mapping[str, Entry], **settings: Any) -> None:
        super().__init__(name, callback=_missing, invoke_without_command=True, context_settings=HELP, **settings)
        self.entries = entries

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 — click's signature
        """Names in the order of help."""
        return list(self.entries)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command:  # noqa: ARG002 — click's signature
        """The command of a name. Raises UsageError for an unknown one."""
        if cmd_name not in self.entries:
            raise UsageError(f"command: got {cmd_name!r}, expected {', '.join(self.entries)}")
        entry = self.entries[cmd_name]
        with importing():
            home = import_module(f"furbake.cli.{entry.module}")
        command: click.Command = home.COMMANDS[cmd_name]
        command.help = entry.text
        return command

    def collect_usage_pieces(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 — click's signature
        """The usage after the command's name."""
        return ["COMMAND ..."]

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """A line for each command."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, entry.text) for name, entry in self.entries.items()])


def option(*names: str, **settings: Any) -> click.Option:
    """An option."""
    return click.Option(names, **settings)


def switch(name: str, text: str, **settings: Any) -> click.Option:
    """An option without a value: False where it is not given."""
    return click.Option([name], is_flag=True, help=text, **settings)


def unset_switch(name: str, text: str, dest: str | None = None, value: bool = True) -> click.Option:
    """An option without a value: None where it is not given."""
    names = [name] if dest is None else [name, dest]
    return click.Option(names, is_flag=True, flag_value=value, default=None, type=bool, help=text)


def action(module: str, name: str) -> Callable[..., int]:
    """Callback that imports and runs an action: a function of the given values that returns an exit status."""

    def callback(**given: Any) -> int:
        with importing():
            run = getattr(import_module(f"furbake.cli.{module}"), name)
        try:
            status: int = run(SimpleNamespace(**given))
        except OSError as error:
            if error.errno not in FULL:
                raise
            place = given.get("out") or given.get("folder")  # the system does not name it
            raise OSError(error.errno, error.strerror, place) from error
        return status

    return callback


def sentence(error: click.UsageError, argv: Sequence[str]) -> str:
    """An error of click in the words of all other errors."""
    command, path = (error.ctx.command, error.ctx.command_path) if error.ctx else (None, "furbake")
    if isinstance(error, click.NoSuchOption):
        return _unknown(error, argv, path)
    if isinstance(error, click.MissingParameter) and command is not None and error.ctx is not None:
        wanted = [
            param for param in command.params if param.required and error.ctx.params.get(param.name or "") is None
        ]
        expected = f"furbake {command.name} {command.shape}" if isinstance(command, Command) else f"{path} --help"
        return f"{', '.join(_label(param, short=True) for param in wanted)}: missing, expected {expected}"
    if isinstance(error, click.BadOptionUsage) and command is not None:
        (param,) = (param for param in command.params if error.option_name in param.opts)
        flag = isinstance(param, click.Option) and param.is_flag
        return f"{_label(param)}: {'got a value, expected none' if flag else 'got nothing, expected a value'}"
    if isinstance(error, click.BadParameter) and error.param is not None:
        return f"{_label(error.param)}: {error.message}"
    return f"arguments: {error.message}"


def _unknown(error: click.NoSuchOption, argv: Sequence[str], path: str) -> str:
    """Sentence on an option that there is not; it may be a file whose name begins with a minus."""
    name = error.option_name
    if not name.startswith("--"):  # click names the first letter alone
        name = next((text for text in argv if text.startswith(name)), name)
    if os.path.lexists(name):
        return f"{name}: taken for an option, expected ./{name} for the file of that name"
    near = f"{error.possibilities[0]}, or others" if error.possibilities else "arguments"
    return f"{name}: unknown, expected {near} of '{path} --help'"


def _label(param: click.Parameter, short: bool = False) -> str:
    """A parameter's name in errors."""
    if isinstance(param, click.Argument):
        return str(param.metavar)
    return param.opts[0] if short else next(name for name in param.opts if name.startswith("--"))[2:]


def _repeated(args: Iterable[str], many: set[str]) -> list[str]:
    """Arguments with the name of an option in `many` before each of its values."""
    found: list[str] = []
    name = None
    for argument in args:
        if argument.startswith("-") and not argument[1:2].isdigit():
            name = argument if argument in many else None
        elif name is not None and found[-1] != name:
            found.append(name)
        found.append(argument)
    return found


@click.pass_context
def _missing(ctx: click.Context) -> None:
    """Raise UsageError where no command is named."""
    if ctx.invoked_subcommand is None and isinstance(ctx.command, Group):
        raise UsageError(f"COMMAND: missing, expected furbake {', '.join(ctx.command.entries)}")
