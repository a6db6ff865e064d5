"""The table of a batch: rows that come as bakes end, below them those that are running."""

from __future__ import annotations

from types import TracebackType
from typing import Self

from rich.console import Console, Group
from rich.live import Live
from rich.markup import escape
from rich.progress_bar import ProgressBar
from rich.table import Table as Grid
from rich.text import Text

from furbake.batch.crew import Event
from furbake.batch.run import Row
from furbake.cli.output import printable, say

NAME, STAGE = 28, 8
"""Columns of a name and of a stage."""


def facts(row: Row) -> tuple[str, ...]:
    """Size, fit, time and memory of a bake, those that are known."""
    if row.record is None:
        return ()
    entry, options = row.entry, row.record["options"]
    found = [
        f"{options['layers']} × {options['size']}², {options['preset']}",
        f"{sum(row.record['asset']['bytes'].values()) / 1e6:.2f} MB",
        f"{row.record['fit']['psnr']:.1f} dB",
    ]
    if entry.seconds:
        found.append(f"{entry.seconds:.1f} s")
    if entry.memory:
        found.append(f"{entry.memory / 1e6:.0f} MB of memory")
    return tuple(found)


class Table:
    """A table on a terminal, plain lines elsewhere, on standard output; nothing where it is quiet."""

    def __init__(self, count: int, quiet: bool) -> None:
        self.count, self.quiet, self.ended = count, quiet, 0
        self.running: dict[str, tuple[str, float]] = {}
        self.console = Console(highlight=False)
        self.live = Live(console=self.console, auto_refresh=False, transient=True)

    def __enter__(self) -> Self:
        if not self.quiet and self.console.is_terminal:
            self.live.start()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.live.stop()

    def event(self, event: Event) -> None:
        """Show what the crew is at."""
        name = event.job.name
        if event.kind == "step":
            stage, fraction = event.value
            self.running[name] = (str(stage), float(fraction))
        elif event.kind == "began":
            self.running[name] = ("begins", 0.0)
        else:
            self.running.pop(name, None)
        self._refresh()

    def row(self, row: Row) -> None:
        """Add a bake that has ended."""
        self.ended += 1
        if self.quiet:
            return
        name, words = printable(row.job.name), printable(row.entry.error or ", ".join(facts(row)))
        state = {"baked": "baked", "fresh": "up to date", "failed": "failed"}[row.status]
        if not self.live.is_started:
            say(f"{name}: {state}, {words}" if row.status != "failed" else f"{name}: {state}: {words}")
            return
        style = {"baked": "green", "fresh": "dim", "failed": "red"}[row.status]
        self.console.print(f"{escape(name):<{NAME}} [{style}]{state:<10}[/] {escape(words)}", soft_wrap=True)
        self._refresh()

    def _refresh(self) -> None:
        if not self.live.is_started:
            return
        grid = Grid.grid(padding=(0, 1))
        for name, (stage, fraction) in self.running.items():
            bar = ProgressBar(total=1.0, completed=min(max(fraction, 0.0), 1.0), width=20)
            grid.add_row(Text(printable(name)[:NAME].ljust(NAME)), Text(stage.ljust(STAGE)), bar)
        self.live.update(Group(grid, Text(f"{self.ended} of {self.count}", style="dim")), refresh=True)
