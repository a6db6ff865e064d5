"""Readers of grooms."""
