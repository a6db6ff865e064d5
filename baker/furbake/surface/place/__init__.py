"""Fur from place to place: length, colour, comb, fins and features."""
