"""The two shapes that all of a report is made of."""

from __future__ import annotations

from html import escape


def section(title: str, lead: str, *body: str) -> str:
    """A heading, a sentence (HTML) on what to look for, and what it is about (HTML)."""
    return f'<section>\n<h2>{escape(title)}</h2>\n<p class="lead">{lead}</p>\n{"".join(body)}\n</section>'


def figure(drawing: str, caption: str) -> str:
    """A drawing with words (HTML) below it."""
    return f"<figure>{drawing}<figcaption>{caption}</figcaption></figure>"
