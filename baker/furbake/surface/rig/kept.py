"""A rig in a sentence."""

from __future__ import annotations

from furbake.surface.repair.repair import count
from furbake.surface.rig.rig import Rig

MAX_NAMES, LONGEST_NAME = 5, 40
"""Clips that a notice names, and characters of each name."""


def kept(rig: Rig) -> str:
    """A notice of what moves the fur."""
    names = [clip.name[:LONGEST_NAME] for clip in rig.clips if clip.name]
    named = f" ({', '.join(names[:MAX_NAMES])}{', ...' if len(names) > MAX_NAMES else ''})" if names else ""
    numbers = (
        (len(rig.joints), count(len(rig.joints), "joint")),
        (len(rig.clips), count(len(rig.clips), "clip") + named),
        (len(rig.targets), count(len(rig.targets), "morph target")),
    )
    *some, last = [text for number, text in numbers if number]
    one = sum(number for number, _ in numbers) == 1
    return f"{', '.join(some)}{' and ' if some else ''}{last} {'is' if one else 'are'} kept"
