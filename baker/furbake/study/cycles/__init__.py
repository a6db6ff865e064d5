"""Hairs on a body as Blender's path tracer, Cycles, sees them: a second truth, by other code."""
