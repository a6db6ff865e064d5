"""Stages of USD as plain arrays, read by `usd-core` in a process of its own."""
