"""Khronos' own validator of glTF, where the web wing is installed."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[3]

SCRIPT = """
    const { validateBytes } = require('gltf-validator');
    const { readFileSync } = require('fs');
    const folder = process.argv[1];
    const read = async (uri) => new Uint8Array(readFileSync(`${folder}/${uri}`));
    read('model.gltf').then((bytes) => validateBytes(bytes, { uri: 'model.gltf', externalResourceFunction: read }))
        .then(({ issues }) => console.log(JSON.stringify(issues.messages.filter(({ severity }) => severity < 2))));
"""


def issues(folder: Path) -> list[dict[str, Any]]:
    """Errors and warnings of a folder's model.gltf; the test is skipped where the validator is missing."""
    node = shutil.which("node")
    if node is None or not (ROOT / "node_modules" / "gltf-validator").is_dir():
        pytest.skip("the web wing is not installed")
    found = subprocess.run(
        [node, "-e", SCRIPT, str(folder)], capture_output=True, text=True, check=True, cwd=ROOT, timeout=60
    )
    messages: list[dict[str, Any]] = json.loads(found.stdout)
    return messages


def errors(folder: Path) -> list[dict[str, Any]]:
    """Errors alone."""
    return [issue for issue in issues(folder) if issue["severity"] == 0]
