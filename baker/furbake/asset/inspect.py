"""Figures of a baked folder."""

from __future__ import annotations

from typing import Any

import numpy as np

from furbake.asset.read import Asset, AssetError
from furbake.asset.regions.alone import furs
from furbake.asset.regions.check import share_sums
from furbake.asset.regions.parted import REGION
from furbake.asset.roots.read import picture


def summary(asset: Asset) -> dict[str, Any]:
    """Figures of an asset: plain data, lengths in the model's units. Raises AssetError where it is malformed."""
    try:
        return _summary(asset)
    except (LookupError, TypeError, AttributeError) as error:
        raise AssetError(f"{asset.folder}: malformed, expected a bake that furbake validate finds valid") from error


def _summary(asset: Asset) -> dict[str, Any]:
    fur, record = asset.fur, asset.record
    states = fur["pelts"]
    images = sum(len(state["planes"]) for state in states)
    colours, directions = (sum(role in state for state in states) for role in ("colour", "direction"))
    texels = fur["layers"] * fur["size"] ** 2 * (images + colours + directions)
    for fin in (state["fin"] for state in states if "fin" in state):
        texels += fin["width"] * fin["height"] * (len(fin["planes"]) + ("colour" in fin))
    names = [asset.document["buffers"][0]["uri"], *(image["uri"] for image in asset.document.get("images", []))]
    files = {name: (asset.folder / name).stat().st_size for name in ["model.gltf", *names] if _exists(asset, name)}
    fits = {state["name"]: state["fit"]["psnr"] for state in record.get("states", [])}
    return {
        "folder": str(asset.folder),
        "furbake": record.get("furbake", "unknown"),
        "input": record.get("input", {}),
        "fur": {
            "version": fur["version"],
            "layers": fur["layers"],
            "size": fur["size"],
            "coefficients": fur["coefficients"],
            "basis": fur["basis"]["kind"],
            "curves": len(fur["curves"]["even"]) if "curves" in fur else 0,
            "length": fur["length"],
            "height": fur["height"],
            "tile": fur["regions"]["tile"] if "regions" in fur else fur["length"] / fur["height"],
            "pelts": [state["name"] for state in states],
            "colour plane": colours > 0,
            "direction plane": directions > 0,
            **({"roots picture": _roots(asset)} if "roots" in fur else {}),
            "texture bytes": 4 * texels,
        },
        "skin": _mesh(asset, "skin"),
        "shells": _mesh(asset, "shells"),
        **({"fins": _mesh(asset, "fins")} if "fins" in fur else {}),
        **({"fins": _edges(asset)} if "edges" in fur else {}),
        **_motion(asset),
        **_regions(asset),
        "fit": record.get("fit", {}),
        **({"states": fits} if fits else {}),
        "files": files,
    }


def _mesh(asset: Asset, name: str) -> dict[str, Any]:
    primitives = asset.primitives(asset.fur[name])
    accessors = asset.document["accessors"]
    return {
        "vertices": sum(accessors[primitive["attributes"]["POSITION"]]["count"] for primitive in primitives),
        "faces": sum(accessors[primitive["indices"]]["count"] // 3 for primitive in primitives),
        "attributes": list(dict.fromkeys(name for primitive in primitives for name in primitive["attributes"])),
    }


def _roots(asset: Asset) -> dict[str, Any]:
    """Texels and bytes of the picture of the roots."""
    height, width = picture(asset).shape[:2]
    source = asset.document["textures"][asset.fur["roots"]["texture"]]["source"]
    size = (asset.folder / asset.document["images"][source]["uri"]).stat().st_size
    return {"width": width, "height": height, "bytes": size}


def _edges(asset: Asset) -> dict[str, Any]:
    """Quads that a reader makes of the edges."""
    count = int(np.unpackbits(asset.accessor(asset.fur["edges"]["mask"])).sum())
    return {"vertices": 4 * count, "faces": 2 * count, "attributes": ["edges"]}


def _regions(asset: Asset) -> dict[str, Any]:
    """Faces of every fur, and those that are drawn twice; nothing of a body with one fur."""
    fur = asset.fur
    if "regions" not in fur:
        return {}
    primitive = asset.primitive(fur["shells"])
    region = asset.accessor(primitive["attributes"][REGION])
    of_face = region[asset.accessor(primitive["indices"])[::3], 2]
    faces = np.bincount(of_face, minlength=len(furs(asset))).tolist()
    return {"regions": dict(zip(furs(asset), faces, strict=True)), "drawn twice": len(of_face) - len(share_sums(asset))}


def _motion(asset: Asset) -> dict[str, Any]:
    """Joints, clips and morph targets; nothing of a body that has none of them."""
    node = asset.document["nodes"][asset.fur["skin"]]
    mesh = asset.document["meshes"][node["mesh"]]
    count = len(mesh["primitives"][0].get("targets", []))
    found = {
        "joints": len(asset.document["skins"][node["skin"]]["joints"]) if "skin" in node else 0,
        "clips": [_clip(asset, animation) for animation in asset.document.get("animations", [])],
        "targets": mesh.get("extras", {}).get("targetNames", [""] * count),
    }
    return {"motion": found} if any(found.values()) else {}


def _clip(asset: Asset, animation: dict[str, Any]) -> dict[str, Any]:
    """Name, length and number of channels of an animation."""
    ends = [asset.document["accessors"][sampler["input"]]["max"][0] for sampler in animation["samplers"]]
    return {"name": animation.get("name", ""), "seconds": max(ends), "channels": len(animation["channels"])}


def _exists(asset: Asset, name: Any) -> bool:
    return isinstance(name, str) and (asset.folder / name).is_file()
