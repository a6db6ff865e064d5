"""A rig in a sentence."""

from __future__ import annotations

from furbake.surface.repair.repair import count
from furbake.surface.rig.rig import Rig

MAX_NAMES, LONGEST_NAME = 5, 40
"""Clips that a notice names, and characters of each name."""


def shown(name: str) -> str:
    """A name in one line, not longer than `LONGEST_NAME`."""
    return "".join(letter if letter.isprintable() else " " for letter in name[:LONGEST_NAME])


def listed(names: list[str]) -> str:
    """The first few names."""
    return ", ".join([shown(name) for name in names[:MAX_NAMES]] + ["..."] * (len(names) > MAX_NAMES))


def kept(rig: Rig) -> str:
    """A notice of what moves the fur."""
    names = listed([clip.name for clip in rig.clips if clip.name])
    named = f" ({names})" if names else ""
    numbers = (
        (len(rig.joints), count(len(rig.joints), "joint")),
        (len(rig.clips), count(len(rig.clips), "clip") + named),
        (len(rig.targets), count(len(rig.targets), "morph target")),
    )
    *some, last = [text for number, text in numbers if number]
    one = sum(number for number, _ in numbers) == 1
    return f"{', '.join(some)}{' and ' if some else ''}{last} {'is' if one else 'are'} kept"
