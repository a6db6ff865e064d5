"""Comments and docstrings are noun-first or imperative: none has to be read twice."""

from __future__ import annotations

import ast
import io
import tokenize
from pathlib import Path

import pytest

import furbake

TESTS = Path(__file__).parent
EXTENSION = Path(furbake.__file__).parents[1] / "blender"
FILES = sorted(
    [
        *Path(furbake.__file__).parent.rglob("*.py"),
        *EXTENSION.glob("*.py"),
        *TESTS.rglob("*.py"),
        *TESTS.parent.glob("golden/*.py"),
    ]
)

OPENINGS = ("Of ", "What ", "Has ", "Whether ", "For what ", "With what ", "To what ", "Who ", "Whom ", "Somebody ")
"""Openings that leave the reader without a subject."""


def texts(source: str) -> list[str]:
    """All comments, docstrings and descriptions of constants in a module."""
    tokens = tokenize.generate_tokens(io.StringIO(source).readline)
    found = [token.string.lstrip("# ") for token in tokens if token.type == tokenize.COMMENT]
    values = [node.value for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Expr)]
    strings = [value.value for value in values if isinstance(value, ast.Constant)]
    return found + [text.lstrip() for text in strings if isinstance(text, str)]


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(path.parents[2])))
def test_comments_begin_with_their_subject(path: Path) -> None:
    assert [text for text in texts(path.read_text("utf-8")) if text.startswith(OPENINGS)] == []
