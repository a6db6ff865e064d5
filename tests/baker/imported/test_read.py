"""Readers of grooms: what they take, and one sentence for what they do not."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import BSpline, CubicHermiteSpline, CubicSpline

from furbake.groom.files import write_groom
from furbake.groom.strands import Groom
from furbake.imported.curves import GroomError
from furbake.imported.read.reading import read_curves
from furbake.imported.read.splines import weights
from furbake.surface.read.usd import read_usd
from helpers.grooms import hair, strands, tfx, usda

POINTS = strands(20)

INPUTS = 300
"""Broken headers in every run."""


def written(path: Path, data: bytes) -> Path:
    path.write_bytes(data)
    return path


@pytest.fixture
def usd() -> None:
    pytest.importorskip("pxr", reason="usd-core reads USD")


def test_a_hair_file_gives_its_strands(tmp_path: Path) -> None:
    found = read_curves(written(tmp_path / "a.hair", hair(POINTS)))
    assert np.allclose(found.points.reshape(POINTS.shape), POINTS, atol=1e-6)
    assert found.widths is not None
    assert np.allclose(found.widths, 0.01)
    assert found.colours is not None
    assert np.allclose(found.colours, (0.5, 0.25, 0.125))


def test_a_hair_file_may_have_strands_of_many_lengths(tmp_path: Path) -> None:
    counts = np.array([3, 2, 5])
    flat = POINTS.reshape(-1, 3)[:10]
    header = hair(POINTS, 3, strands=3, points=10)[:128]
    found = read_curves(
        written(tmp_path / "a.hair", header + (counts - 1).astype("<u2").tobytes() + flat.astype("<f4").tobytes())
    )
    assert found.counts.tolist() == counts.tolist()
    steps = [np.linalg.norm(np.diff(part, axis=0), axis=1).sum() for part in np.split(flat, [3, 5])]
    assert np.allclose(found.lengths(), steps, rtol=1e-5)


def test_a_tfx_file_gives_its_strands(tmp_path: Path) -> None:
    found = read_curves(written(tmp_path / "a.tfx", tfx(POINTS)))
    assert np.allclose(found.points.reshape(POINTS.shape), POINTS, atol=1e-6)
    assert found.widths is not None
    assert np.allclose(found.widths, 0.01)


@pytest.mark.parametrize("flat", [False, True])
def test_an_archive_gives_its_strands(tmp_path: Path, flat: bool) -> None:
    more = {"points": POINTS.reshape(-1, 3), "counts": np.full(20, 5)} if flat else {"points": POINTS}
    np.savez(tmp_path / "a.npz", **more, widths=np.linspace(1, 2, 20), colours=np.array([0.1, 0.2, 0.3]))
    found = read_curves(tmp_path / "a.npz")
    assert np.allclose(found.points.reshape(POINTS.shape), POINTS, atol=1e-6)
    assert found.widths is not None
    assert np.allclose(found.widths[::5], np.linspace(1, 2, 20))
    assert found.colours is not None
    assert np.allclose(found.colours, (0.1, 0.2, 0.3))


@pytest.mark.parametrize("ending", [".npz", ".usdc", ".usda"])
def test_a_groom_of_ours_comes_back_without_loss(tmp_path: Path, ending: str) -> None:
    if ending != ".npz":
        pytest.importorskip("pxr", reason="usd-core reads USD")
    rng = np.random.default_rng(1)
    points = rng.random((30, 25, 3), np.float32)
    radius, colour = rng.random((30, 25), np.float32), rng.random((30, 25, 3), np.float32)
    made = Groom(points, radius, radius, colour, np.arange(30), np.arange(30))
    write_groom(tmp_path / f"a{ending}", made)
    found = read_curves(tmp_path / f"a{ending}")
    assert found.widths is not None
    assert found.colours is not None
    assert np.array_equal(found.points.reshape(points.shape), points)
    assert np.array_equal(found.widths.reshape(radius.shape), 2 * radius)
    assert np.allclose(found.colours.reshape(colour.shape), colour, atol=1e-7)


def test_bases_are_those_of_other_books() -> None:
    rng = np.random.default_rng(2)
    controls = rng.random((7, 3))
    knots = np.arange(11.0)
    spline = BSpline(knots, controls, 3)
    drawn = weights(7, "cubic", "bspline", "nonperiodic") @ controls
    assert np.allclose(drawn, spline(np.linspace(3, 7, len(drawn))))
    tangents = (controls[2:] - controls[:-2]) / 2
    hermite = CubicHermiteSpline(np.arange(5.0), controls[1:-1], tangents)
    drawn = weights(7, "cubic", "catmullRom", "nonperiodic") @ controls
    assert np.allclose(drawn, hermite(np.linspace(0, 4, len(drawn))))
    drawn = weights(7, "cubic", "bezier", "nonperiodic") @ controls
    bends = CubicHermiteSpline([0.0, 1.0, 2.0], controls[[0, 3, 6]], 3 * (controls[[1, 3, 6]] - controls[[0, 2, 5]]))
    assert np.allclose(drawn[: len(drawn) // 2], bends(np.linspace(0, 1, len(drawn) // 2 + 1))[:-1])
    straight = np.linspace([0.0, 0, 0], [1, 2, 3], 4)
    for basis in ("bspline", "catmullRom"):  # pinned ones begin and end at their first and last point
        drawn = weights(4, "cubic", basis, "pinned") @ straight
        assert np.allclose(drawn, CubicSpline([0, 1], straight[[0, -1]])(np.linspace(0, 1, len(drawn))))


@pytest.mark.usefixtures("usd")
def test_a_stage_is_placed_by_its_units_axes_and_transforms(tmp_path: Path) -> None:
    head = 'metersPerUnit = 0.01\nupAxis = "Z"'
    told = {"double3 xformOp:translate": "(0, 0, 100)", "uniform token[] xformOpOrder": '["xformOp:translate"]'}
    more = {
        "float[] widths": '[2] (\n interpolation = "constant"\n)',
        "color3f[] primvars:displayColor": "[(1, 0.5, 0)]",
    }
    found = read_curves(usda(tmp_path / "a.usda", 100 * POINTS, head, **told, **more))
    x, y, z = POINTS.reshape(-1, 3).T
    assert np.allclose(found.points, np.stack([x, z + 1, -y], axis=1), atol=1e-5)
    assert found.widths is not None
    assert np.allclose(found.widths, 0.02)
    assert found.colours is not None
    assert np.allclose(found.colours, (1, 0.5, 0))


def broken_archive(path: Path, **arrays: np.ndarray) -> Path:
    np.savez(path, **arrays)
    return path


@pytest.mark.parametrize(
    ("name", "make", "message"),
    [
        ("a.hair", lambda p: written(p, b""), "does not begin with HAIR"),
        ("a.hair", lambda p: written(p, hair(POINTS, strands=7)), "7 strands of 4 segments and 100 points"),
        ("a.hair", lambda p: written(p, hair(POINTS, strands=2**31, points=2**31 * 5 % 2**32)), "segments and"),
        ("a.hair", lambda p: written(p, hair(POINTS, 3, strands=2**32 - 1)), "for the segments that its header counts"),
        ("a.hair", lambda p: written(p, hair(POINTS, 0)), "holds no points"),
        ("a.hair", lambda p: written(p, hair(POINTS[:, :1])), "curves of one point"),
        ("a.hair", lambda p: written(p, hair(POINTS[:0])), "no curves"),
        ("a.tfx", lambda p: written(p, b"numStrands 3\nnumVerts 4\n0 0 0\n"), "is text, expected the binary .tfx"),
        ("a.tfx", lambda p: written(p, tfx(POINTS, strands=10**9)), "for the points that its header counts"),
        ("a.tfx", lambda p: written(p, tfx(POINTS, version=np.nan)), "version nan"),
        ("a.npz", lambda p: written(p, b"PK"), "cannot be read as .npz"),
        (
            "a.npz",
            lambda p: broken_archive(p, points=np.full((3, 4, 3), np.nan)),
            "every curve has a point that is NaN",
        ),
        ("a.npz", lambda p: broken_archive(p, points=np.zeros((3, 4))), "points of shape (3, 4)"),
        ("a.npz", lambda p: broken_archive(p, lines=np.zeros(3)), "has no array 'points'"),
        ("a.npz", lambda p: broken_archive(p, points=np.zeros((4, 3)), counts=np.array([7])), "4 points for strands"),
        ("a.npz", lambda p: broken_archive(p, points=POINTS, widths=np.zeros(3)), "3 widths, expected one"),
        ("a.npz", lambda p: broken_archive(p, points=np.array([[["a"] * 3] * 2])), "expected numbers"),
        ("a.abc", lambda p: written(p, b""), "open it in Blender"),
        ("a.xgen", lambda p: written(p, b""), "file type is 'xgen'"),
        ("a.npz", lambda p: p, "no such file"),
    ],
)
def test_bad_grooms_get_one_sentence(tmp_path: Path, name: str, make, message: str) -> None:
    with pytest.raises(GroomError) as caught:
        read_curves(make(tmp_path / name))
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.usefixtures("usd")
def test_bad_stages_get_one_sentence(tmp_path: Path) -> None:
    cases = {
        "periodic curves have no root": usda(tmp_path / "p.usda", POINTS, **{"uniform token wrap": '"periodic"'}),
        "points for curves that count": usda(tmp_path / "c.usda", POINTS, **{"int[] curveVertexCounts": "[7, 8]"}),
        "curves of one point": usda(tmp_path / "o.usda", POINTS[:, :1]),
        "a bezier curve of 5 points": usda(tmp_path / "b.usda", POINTS, **{"uniform token type": '"cubic"'}),
        "no curves (nothing with a shape)": tmp_path / "e.usda",
        "cannot be read as USD": written(tmp_path / "x.usdc", b"PXR-USDC" + bytes(200)),
    }
    (tmp_path / "e.usda").write_text("#usda 1.0\n")
    for message, path in cases.items():
        with pytest.raises(GroomError) as caught:
            read_curves(path)
        assert message in str(caught.value)
        assert "\n" not in str(caught.value)


def test_usd_without_its_library_names_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pxr", None)
    with pytest.raises(GroomError, match=r"usd-core is missing.*pip install 'furbake\[groom\]'"):
        read_curves(written(tmp_path / "a.usda", b"#usda 1.0\n"))


def test_strands_that_are_none_are_left_out_and_told(tmp_path: Path) -> None:
    points = POINTS.copy()
    points[3, 1] = np.nan
    np.savez(tmp_path / "a.npz", points=points)
    found = read_curves(tmp_path / "a.npz")
    assert found.count == 19
    assert found.notices == (f"{tmp_path / 'a.npz'}: 1 curves with NaN or infinity left out",)


def test_strands_without_a_length_are_left_out_and_told(tmp_path: Path) -> None:
    points = POINTS.copy()
    points[3] = points[3, :1]
    np.savez(tmp_path / "a.npz", points=points)
    found = read_curves(tmp_path / "a.npz")
    assert found.count == 19
    assert found.notices == (f"{tmp_path / 'a.npz'}: 1 curves without a length left out",)
    np.savez(tmp_path / "b.npz", points=np.repeat(POINTS[:, :1], 3, axis=1))
    assert "all its points at one place" in (refusal(tmp_path / "b.npz") or "")


def test_widths_of_nothing_are_none(tmp_path: Path) -> None:
    for width in (0.0, -0.01):
        np.savez(tmp_path / "a.npz", points=POINTS, widths=width)
        found = read_curves(tmp_path / "a.npz")
        assert found.widths is None
        assert found.notices == (f"{tmp_path / 'a.npz'}: all widths are 0 or less, taken as none",)


@pytest.mark.usefixtures("usd")
def test_what_a_stage_does_not_show_is_left_out_and_told(tmp_path: Path) -> None:
    """Cages, stand-ins, kinds of curves that are not read, and prototypes, which stand nowhere."""
    faces = "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]"
    mesh = f"{faces}\npoint3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]"
    cage = f'def Mesh "body" {{\n{mesh}\n}}\ndef Mesh "cage" {{\nuniform token purpose = "{{}}"\n{mesh}\n}}\n'
    other = 'def NurbsCurves "nurbs" {\n}\ndef PointInstancer "many" {\ndef BasisCurves "one" {\n}\n}\n'
    for purpose in ("guide", "proxy"):
        path = usda(
            tmp_path / f"{purpose}.usda", POINTS, "subLayers = [@gone.usda@]", cage.replace("{}", purpose) + other
        )
        found = read_curves(path)
        assert found.count == len(POINTS)
        assert found.notices == (
            f"{path}: gone.usda is missing, and what it has with it",
            f"{path}: 1 NurbsCurves, 1 PointInstancer left out, only BasisCurves are read",
        )
        scene = read_usd(path)
        assert scene.soup is not None
        assert len(scene.soup.faces) == 1
        assert scene.notices[1] == "1 meshes are guides, proxies or invisible and left out"
    alone = tmp_path / "alone.usda"
    alone.write_text(f"#usda 1.0\n{other}", "utf-8")
    assert "no curves (1 NurbsCurves, 1 PointInstancer)" in (refusal(alone) or "")


def refusal(path: Path) -> str | None:
    """Sentence with which a groom is refused, if it is."""
    try:
        read_curves(path)
    except GroomError as error:
        return str(error)
    return None


def test_headers_that_lie_get_one_sentence(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    whole = {".hair": hair(POINTS), ".tfx": tfx(POINTS)}
    np.savez(tmp_path / "a.npz", points=POINTS)
    whole[".npz"] = (tmp_path / "a.npz").read_bytes()
    refused = 0
    for number in range(INPUTS):
        ending = list(whole)[number % 3]
        data = bytearray(whole[ending])
        for _ in range(rng.integers(1, 5)):
            data[rng.integers(0, min(len(data), 200))] = rng.integers(0, 256)
        if rng.random() < 0.2:
            data = data[: rng.integers(0, len(data))]
        said = refusal(written(tmp_path / f"f{ending}", bytes(data)))
        refused += said is not None
        assert "\n" not in (said or "")
    assert INPUTS / 5 < refused < INPUTS
