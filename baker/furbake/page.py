"""The page's own shaders at work: scripts of the repository that draw in a browser, run by Node."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections import deque
from collections.abc import Callable, Sequence
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[2] / "web" / "tools" / "measure"
"""The drawing scripts, in furbake's own repository and not in the Python package."""


class PageError(ValueError):
    """The page cannot draw; the message says what is missing or went wrong, and what was expected."""


def draw(
    script: str, arguments: Sequence[str], part: str, step: Callable[[float], None] = lambda fraction: None
) -> None:
    """Run a script of `TOOLS` until it has written its files.

    part : what it draws, in messages
    step : called with the fraction that is done

    Raises PageError where there is no Node, no repository, no browser, or a failure.
    """
    node = shutil.which("node")
    if node is None:
        raise PageError(f"node: not found, expected Node 20.19 or newer, which draws {part}")
    if not (TOOLS / script).exists():
        raise PageError(f"{script}: not found, expected furbake's own repository, whose page draws {part}")
    output: deque[str] = deque(maxlen=5)
    with subprocess.Popen(  # noqa: S603 — Node, and a file of ours
        [node, str(TOOLS / script), *arguments], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True
    ) as run:
        for line in run.stderr or ():
            output.append(line.strip())
            if match := re.fullmatch(r"furbake: page (\d+)/(\d+)", line.strip()):
                step(int(match[1]) / int(match[2]))
    if run.returncode != 0:
        last = next((line.removeprefix("furbake: ") for line in reversed(output) if line.startswith("furbake: ")), "")
        raise PageError(f"page: {last or ' '.join(output) or f'exit code {run.returncode}'}, expected its pictures")
