"""The figures judge the same mixture as the page shows."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from furbake.options import BakeOptions
from furbake.pelt.hairs.states import PeltState
from furbake.pelt.light.transport import hemisphere
from furbake.pelt.pelt import Pelt
from furbake.study.states import Row, compare_states, markdown, mean, soiled, texels
from furbake.tile.lighting import Lighting

LIGHTS = hemisphere(8)


def lighting(pelt: Pelt) -> Lighting:
    shape = (len(LIGHTS), *pelt.alpha.shape)
    return Lighting(LIGHTS, np.arange(len(LIGHTS)) >= 4, np.zeros(shape, np.float32))


@pytest.fixture(scope="module")
def rows() -> list[Row]:
    return list(compare_states(replace(BakeOptions(), layers=4, size=16, lights=8)))


def test_half_way_between_states(rows: list[Row]) -> None:
    """Acceptance 3, on a small tile."""
    half = [row for row in rows if row.kind == "half-way"]
    assert [row.shown for row in half] == ["dry, damp", "damp, moist", "moist, wet", "wet, soaked"]
    assert min(row.bake for row in half) >= 0.75
    assert min(row.samples for row in half) >= 0.75


def test_at_a_state(rows: list[Row]) -> None:
    at = [row for row in rows if row.kind == "state"]
    assert [row.shown for row in at] == ["dry", "damp", "moist", "wet", "soaked"]
    assert min(row.bake for row in at) >= 0.97
    assert min(row.samples for row in at) >= 0.8


def test_dirt(rows: list[Row]) -> None:
    whole, half = (row for row in rows if row.kind == "dirt")
    assert whole.bake > 0.95
    assert half.bake > 0.5


def test_a_row_per_preset(rows: list[Row]) -> None:
    lines = markdown([*rows, *(replace(row, preset="other") for row in rows)]).splitlines()
    assert len(lines) == 4
    assert lines[2].startswith("| paper | ")
    assert len({line.count("|") for line in lines}) == 1


def test_mixing_a_pelt_with_itself_is_the_pelt(make_pelt: Callable[..., Pelt]) -> None:
    pelt = make_pelt()
    mixed, own = mean(pelt, pelt, lighting(pelt)), texels(pelt, pelt, lighting(pelt))
    np.testing.assert_allclose(mixed.light, own.light, atol=1e-5)
    np.testing.assert_allclose(mixed.alpha, own.alpha)


def test_no_dirt_is_clean_and_opaque_mud_hides_all(make_pelt: Callable[..., Pelt]) -> None:
    dry = make_pelt()
    dirty = replace(dry, state=PeltState(name="dirty", dirt=1.0), alpha=0 * dry.alpha + 255, tint=0 * dry.tint + 255)
    clean = soiled(dry, dirty, 0.0, lighting(dry))
    np.testing.assert_allclose(clean.alpha, dry.alpha / 255)
    np.testing.assert_allclose(clean.tint, dry.tint / 255)
    assert (soiled(dry, dirty, 1.0, lighting(dry)).alpha == 1).all()


def test_command(run: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[BakeOptions] = []

    def few(options: BakeOptions, step: Callable[[float], None]) -> list[Row]:
        told.append(options)
        step(0.5)
        kinds = ("state", "half-way", "dirt")
        return [Row(options.preset, kind, kind, 0.9, 0.8) for kind in kinds]

    monkeypatch.setattr("furbake.cli.tables.compare_states", few)
    done = run("states", "paper", "fox", "--size", "32", "--lights", "16", "--quiet")
    assert (done.status, done.err) == (0, "")
    assert len(done.out.splitlines()) == 4
    assert {(options.size, options.lights, options.layers) for options in told} == {(32, 16, 16)}
    assert json.loads(run("states", "paper", "--json", "--quiet").out)[1] == {
        "preset": "paper", "kind": "half-way", "shown": "half-way", "bake": 0.9, "samples": 0.8,
    }  # fmt: skip
    assert run("states", "nobody").status == 2
    assert run("states", "paper", "--size", "48").err == "furbake: error: size: got 48, expected a power of two\n"
