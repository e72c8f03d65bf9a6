"""Inline Markdown as runs of text, each with its styles and where it links to."""

from __future__ import annotations

from functools import cache
from typing import Any

from qsbearing.documents.model import Md
from qsbearing.documents.numbers import with_minus

STYLES = {"strong": "strong", "em": "emph"}
Run = dict[str, Any]


@cache
def _parser() -> Any:
    from markdown_it import MarkdownIt

    return MarkdownIt("commonmark")


def runs(text: str) -> list[Run]:
    """Text as runs: {"text", "styles", "href"}; plain text is one run."""
    if not isinstance(text, Md):
        return [{"text": with_minus(text), "styles": [], "href": None}]
    of_line: list[Run] = []
    styles: list[str] = []
    href = None
    for token in _parser().parseInline(text)[0].children:
        kind, _, end = token.type.rpartition("_")
        if kind in STYLES:
            (styles.append if end == "open" else styles.remove)(STYLES[kind])
        elif kind == "link":
            href = token.attrGet("href") if end == "open" else None
        elif token.type in ("text", "code_inline", "softbreak", "hardbreak"):
            content = token.content if token.type == "code_inline" else with_minus(token.content)
            if not content:  # before a mark that begins a line there is an empty text
                if token.type == "text":
                    continue
                content = " "
            kinds = [*styles, "code"] if token.type == "code_inline" else list(styles)
            if of_line and of_line[-1]["styles"] == kinds and of_line[-1]["href"] == href:
                of_line[-1]["text"] += content
            else:
                of_line.append({"text": content, "styles": kinds, "href": href})
    return of_line
