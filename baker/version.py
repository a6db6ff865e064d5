"""The version of this build: that of package.json, the one place where it stands."""

import json
from pathlib import Path

HERE = Path(__file__).parent

FOUND = next(file for file in (HERE / "package.json", HERE.parent / "package.json") if file.exists())

__version__ = json.loads(FOUND.read_text("utf-8"))["version"]
