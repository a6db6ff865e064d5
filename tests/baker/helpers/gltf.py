"""Builders shared by tests of gltf."""

from __future__ import annotations

from furbake.surface.charts import Charts
from furbake.surface.lay.field import comb_field
from furbake.surface.lay.lapped import lap
from furbake.surface.mesh import Surface


def lapped(surface: Surface) -> Charts:
    return lap(surface, comb_field(surface).direction, 0.2)
