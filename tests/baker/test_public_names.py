from __future__ import annotations

import furbake


def test_public_names() -> None:
    assert sorted(furbake.__all__) == [
        "BakeOptions", "BakeResult", "MeshError", "OptionError", "StoreError", "bake", "preset", "preset_names",
        "validate",
    ]  # fmt: skip
    assert all(hasattr(furbake, name) for name in furbake.__all__)
