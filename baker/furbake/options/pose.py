"""The pose in which fur is laid, by its words."""

from __future__ import annotations

from furbake.options.knobs import OptionError


def clip_at(pose: str) -> tuple[str, float]:
    """Clip and seconds of `pose`. Raises OptionError."""
    clip, at, seconds = pose.rpartition("@")
    try:
        number = float(seconds)
    except ValueError:
        number = -1.0
    if not clip or not at or not 0.0 <= number < float("inf"):
        raise OptionError(f"pose: got {pose!r}, expected CLIP@SECONDS with seconds from 0, such as Walk@0.4")
    return clip, number
