"""The report shows the truth of a bake, in one file, the same every time."""

from __future__ import annotations

import base64
import json
import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from furbake.asset.planes import read_png, write_png
from furbake.asset.read import AssetError
from furbake.asset.store import StoreError
from furbake.options import BakeOptions
from furbake.pelt.hairs.strands import Coat, Hairs
from furbake.pelt.pelt import Pelt
from furbake.pelt.texels.fit import Judge
from furbake.pipeline import bake
from furbake.show import report
from furbake.show.report.measure import measure
from furbake.show.report.page import flat, page
from furbake.show.report.sides import SIDES

SECTIONS = (
    "The fur under eight lights", "Figures", "Sample, fit, error", "Contact sheet", "Light curves of single texels",
    "How good could it be?", "Where the error is", "Bytes", "Weight", "How it was made",
)  # fmt: skip


def small(**changes: Any) -> BakeOptions:
    hairs = Hairs(count=40)
    coat = Coat(guard=hairs, under=hairs, clumps=5)
    return replace(BakeOptions(layers=4, size=16, lights=16, coat=coat), **changes)


@pytest.fixture(scope="module")
def baked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A small bake with its report; tests change copies of it."""
    folder = tmp_path_factory.mktemp("report") / "fur"
    bake("sphere", folder, small())
    report.write(folder, shown=False)
    return folder


@pytest.fixture
def copy(baked: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(baked, tmp_path / "copy"))


def record_of(folder: Path) -> Any:
    return json.loads((folder / "bake.json").read_text("utf-8"))


def change_record(folder: Path, change: Callable[[Any], None]) -> None:
    record = record_of(folder)
    change(record)
    (folder / "bake.json").write_text(json.dumps(record), "utf-8")


class Checker(HTMLParser):
    """Every element is closed in its turn, and nothing is fetched."""

    VOID = ("meta", "link", "img", "br", "path", "circle", "rect")

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.images = 0
        self.words: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert tag != "script"
        for name, value in attrs:
            assert value is not None
            if name in ("src", "href"):
                assert value.startswith("data:")
            assert not name.startswith("on")
        found = dict(attrs)
        if tag == "img":
            self.images += 1
            assert found["alt"]
        if tag == "svg":
            assert found["aria-label"]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if tag not in self.VOID:
            assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] != "style":
            self.words.append(data)


def read(folder: Path) -> tuple[str, Checker]:
    html = (folder / "report.html").read_text("utf-8")
    checker = Checker()
    checker.feed(html)
    checker.close()
    assert checker.open == []
    return html, checker


def test_sections_in_reading_order(baked: Path) -> None:
    html, checker = read(baked)
    assert tuple(re.findall(r"<h2>(.*?)</h2>", html)) == SECTIONS
    assert len(re.findall(r'<p class="lead">.*?<b>', html, re.DOTALL)) >= len(SECTIONS) - 1, (
        "each says what to look for"
    )
    # Eight swatches; sample, fit and error of the pelt and of every large layer; three sheets; six light curves.
    layers = len(re.findall(r"<h3>Layer \d+ of 4", html))
    assert layers >= 2
    assert checker.images == 8 + 3 * (1 + layers) + 3 + 6


def test_one_file_that_fetches_nothing(baked: Path) -> None:
    html, _ = read(baked)
    assert "://" not in html  # letters of an address may stand in a picture's base64 by chance
    assert "url(" not in html
    assert "@import" not in html
    assert "prefers-color-scheme: dark" in html
    assert "@media print" in html
    assert str(baked) not in html


def test_figures_are_those_of_the_record(baked: Path) -> None:
    html, _ = read(baked)
    record = record_of(baked)
    fit = flat(record["fit"])
    for key in ("psnr", "psnr_composite", "psnr_worst_layer", "bound.psnr", "psnr_quantised", "psnr_quantisation"):
        assert f'<p class="value">{fit[key]:.1f}<small> dB</small>' in html
    table = dict(re.findall(r"<tr><td><code>([\w.]+)</code></td><td>(-?[\d.]+)</td></tr>", html))
    assert table == {key: f"{value:.2f}" for key, value in fit.items()}
    for name, size in record["asset"]["bytes"].items():
        assert f"<tr><td><code>{name}</code></td><td>{size:,}</td>" in html
    total = sum(record["asset"]["bytes"].values()) + (baked / "bake.json").stat().st_size
    assert f"<th>all</th><th>{total:,}</th>" in html
    assert "<h1>sphere</h1>" in html
    assert f"<dt>lights</dt><dd>{record['options']['lights']}</dd>" in html
    assert record["input"]["sha256"] in html
    assert 'class="doubt"' not in html


def test_the_pelt_is_sampled_as_it_was_baked(baked: Path) -> None:
    measured = measure(baked)
    fit = record_of(baked)["fit"]
    assert measured.doubts == ()
    assert measured.rivals.stored == pytest.approx(fit["psnr_quantised"], abs=1e-3)
    assert measured.rivals.ptm == pytest.approx(fit["psnr"], abs=1e-3)
    assert measured.rivals.bound[5] == pytest.approx(fit["bound"]["psnr"], abs=1e-3)
    assert measured.quantisation.stored == pytest.approx(fit["psnr_quantisation"], abs=1e-2)
    assert min(measured.layers) == pytest.approx(fit["psnr_worst_layer"], abs=0.3)
    assert measured.rivals.eigen[6] > measured.rivals.eigen[3]
    assert (np.diff(measured.rivals.bound) > 0).all()


def test_same_bytes_every_time(baked: Path, copy: Path) -> None:
    before = (baked / "report.html").read_bytes()
    stages: list[str] = []
    assert report.write(copy, lambda stage, _fraction: stages.append(stage), shown=False) == copy / "report.html"
    assert (copy / "report.html").read_bytes() == before
    assert sorted(set(stages), key=report.STAGES.index) == list(report.STAGES)
    assert sorted(path.name for path in copy.iterdir()) == sorted(path.name for path in baked.iterdir())


@pytest.mark.parametrize(("layers", "size"), [(16, 64), (24, 128)])
def test_pelts_of_the_presets_stay_light(baked: Path, make_pelt: Callable[..., Pelt], layers: int, size: int) -> None:
    # Sampling a pelt of the article's size takes too long here: noise stands for it, which is harder to compress.
    chance = np.random.default_rng(0)
    measured = measure(baked)
    alpha = np.clip(chance.normal(-0.2, 0.5, (layers, size, size)), 0, 1)
    pelt = replace(make_pelt(layers=layers, size=size), alpha=np.round(255 * alpha).astype(np.uint8))
    truth, fitted = (chance.random((8, layers, size, size), np.float32) for _ in range(2))
    large = replace(
        measured,
        pelt=pelt,
        alpha=alpha,
        judge=Judge(truth, alpha, np.ones_like(alpha)),
        truth=truth,
        fitted=truth + fitted / 5,
        layers=np.full(layers, 20.0),
    )
    html = page(large)
    assert 500_000 < len(html.encode("utf-8")) <= 3_000_000


@pytest.mark.parametrize("count", [3, 6])
def test_eigen_without_a_colour_plane(tmp_path: Path, count: int) -> None:
    options = small(basis="eigen", coefficients=count, colour_plane=False, flat=True, layers=1)
    bake("sphere", tmp_path / "out", options)
    report.write(tmp_path / "out", shown=False)
    html, _ = read(tmp_path / "out")
    assert f"eigen curves, {count} numbers per texel" in html
    assert f"× light curve {count}" in html
    assert "<dt>flat</dt><dd>yes</dd>" in html


def test_states_are_shown_where_there_are_any(tmp_path: Path, baked: Path) -> None:
    folder = tmp_path / "fur"
    bake("plane:1x1", folder, small(size=8, lights=8, states=("dry", "soaked"), dirt=True, fins=False))
    html = report.write(folder, shown=False).read_text("utf-8")
    assert "<h2>Its states</h2>" in html
    assert [f'alt="{name} fur"' in html for name in ("dry", "soaked", "dirty")] == [True] * 3
    assert "<h2>Its states</h2>" not in (baked / report.NAME).read_text("utf-8")


def test_names_are_text_and_never_markup(copy: Path) -> None:
    def rename(record: Any) -> None:
        record["input"]["name"] = "<b onclick=x>&.glb"

    change_record(copy, rename)
    report.write(copy, shown=False)
    html, _ = read(copy)
    assert "<h1>&lt;b onclick=x&gt;&amp;.glb</h1>" in html


def test_another_version_is_said(copy: Path) -> None:
    change_record(copy, lambda record: record.update(furbake="0.0.9"))
    report.write(copy, shown=False)
    _, checker = read(copy)
    assert any("baked by furbake 0.0.9; its samples are shown here as furbake" in words for words in checker.words)


def test_other_strands_and_figures_are_said(copy: Path) -> None:
    plane = read_png(copy / "plane1.png")
    plane[..., 2] = 255 - plane[..., 2]
    write_png(copy / "plane1.png", plane)
    change_record(copy, lambda record: record["fit"].update(psnr_quantised=33.0))
    doubts = measure(copy).doubts
    assert any("strands that the recorded options grow today are not those in the planes" in doubt for doubt in doubts)
    assert any("bake.json says 33.00 dB for the stored bytes" in doubt for doubt in doubts)


def test_what_is_no_bake(copy: Path, tmp_path: Path) -> None:
    def broken(change: Callable[[Path], object], message: str) -> None:
        folder = Path(shutil.copytree(copy, tmp_path / "broken"))
        (folder / "report.html").write_text("the old one", "utf-8")
        change(folder)
        with pytest.raises(AssetError, match=message) as caught:
            report.write(folder, shown=False)
        assert "\n" not in str(caught.value)
        assert (folder / "report.html").read_text("utf-8") == "the old one"
        shutil.rmtree(folder)

    def record(change: Callable[[Any], object]) -> Callable[[Path], object]:
        return lambda folder: change_record(folder, lambda found: change(found) and None)

    with pytest.raises(AssetError, match="no such folder, expected a folder that furbake wrote"):
        report.write(tmp_path / "nowhere", shown=False)
    broken(
        lambda folder: (folder / "bake.json").unlink(), r"bake.json: missing or empty, expected the record of a bake"
    )
    broken(lambda folder: (folder / "plane1.png").unlink(), "plane1.png: no such file or directory, expected a picture")
    broken(lambda folder: (folder / "model.gltf").unlink(), "broken: holds no model.gltf, expected a folder")
    broken(record(lambda found: found.pop("fit")), "bake.json: no fit, expected the record of a bake")
    broken(record(lambda found: found["options"].update(frobs=3)), "options that this furbake cannot read .*frobs")
    broken(record(lambda found: found["options"].update(lights=-1) or 1), "cannot read .*lights: got -1")
    broken(record(lambda found: found["options"].update(layers=8) or 1), "bake.json: layers 8, expected 4 as in model")


def test_the_model_opens_the_report(copy: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    drawn: list[list[str]] = []

    def draw(script: str, arguments: list[str], part: str) -> None:
        drawn.append([script, *arguments])
        for side in SIDES:
            (Path(arguments[1]) / f"{side}.jpg").write_bytes(side.encode())

    monkeypatch.setattr("furbake.show.report.sides.draw", draw)
    report.write(copy)
    html, _ = read(copy)
    assert re.findall(r"<h2>(.*?)</h2>", html) == ["The model", *SECTIONS]
    pictures = re.findall(r'src="data:image/jpeg;base64,(.*?)"', html)
    assert [base64.b64decode(picture).decode() for picture in pictures] == list(SIDES)
    assert [call[:2] for call in drawn] == [["sides.mjs", str(copy.resolve())]]


def test_a_model_that_cannot_be_drawn_is_said(copy: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("furbake.page.shutil.which", lambda name: None)
    report.write(copy)
    _, checker = read(copy)
    said = "Not shown here. node: not found, expected Node 20.19 or newer, which draws the model."
    assert said in checker.words


def test_a_place_that_cannot_be_written(copy: Path) -> None:
    (copy / "report.html").unlink()
    (copy / "report.html").mkdir()
    with pytest.raises(StoreError, match="is a folder, expected a file to write"):
        report.write(copy, shown=False)
