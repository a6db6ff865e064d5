"""Section and figure, the building blocks of a report."""

from __future__ import annotations

from html import escape


def section(title: str, lead: str, *body: str) -> str:
    """A heading, a lead sentence (HTML) and the body (HTML)."""
    return f'<section>\n<h2>{escape(title)}</h2>\n<p class="lead">{lead}</p>\n{"".join(body)}\n</section>'


def figure(drawing: str, caption: str) -> str:
    """A drawing with a caption (HTML) below it."""
    return f"<figure>{drawing}<figcaption>{caption}</figcaption></figure>"
