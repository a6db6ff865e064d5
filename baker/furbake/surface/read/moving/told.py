"""Repairs of one file, counted."""

from __future__ import annotations

from collections import Counter

from furbake.surface.repair.repair import count

Words = tuple[str, str]
"""A repair in words, of one thing and of several, without the number."""


class Told:
    """Repairs by their words."""

    def __init__(self) -> None:
        self._numbers: Counter[Words] = Counter()

    def add(self, words: Words, number: int = 1) -> None:
        """So many more of this repair."""
        self._numbers[words] += number

    def lines(self) -> tuple[str, ...]:
        """One sentence for each repair that happened."""
        return tuple(count(number, *words) for words, number in self._numbers.items() if number)
