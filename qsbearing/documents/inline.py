"""Inline Markdown as runs of text, each with its styles and where it links to."""

from __future__ import annotations

from functools import cache
from typing import Any

from qsbearing.documents.formula import forms
from qsbearing.documents.model import Md
from qsbearing.documents.numbers import with_minus

STYLES = {"strong_open": "strong", "em_open": "emph", "s_open": "strike"}
Run = dict[str, Any]


@cache
def parser() -> Any:
    """The Markdown parser, with tables, and with formulas between dollars."""
    from markdown_it import MarkdownIt
    from mdit_py_plugins.dollarmath import dollarmath_plugin

    return MarkdownIt("commonmark").enable("table").use(dollarmath_plugin, allow_space=False, allow_digits=False)


def runs(text: str) -> list[Run]:
    """Text as runs: {"text", "styles", "href"}, a formula with "math", its forms; plain text is one run."""
    if not isinstance(text, Md):
        return [{"text": with_minus(text), "styles": [], "href": None}]
    return runs_of(parser().parseInline(text)[0].children)


def runs_of(tokens: Any) -> list[Run]:
    """The tokens of a line as runs; pictures among them are left to whoever splits the line."""
    of_line: list[Run] = []
    styles: list[str] = []
    href = None
    for token in tokens:
        if token.type in STYLES:
            styles.append(STYLES[token.type])
        elif token.type.removesuffix("_close") + "_open" in STYLES:
            styles.remove(STYLES[token.type.removesuffix("_close") + "_open"])
        elif token.type == "link_open":
            href = token.attrGet("href")
        elif token.type == "link_close":
            href = None
        elif token.type == "math_inline":
            of_line.append(
                {"text": forms(token.content)["text"], "styles": [], "href": href, "math": forms(token.content)}
            )
        elif token.type in ("text", "code_inline", "softbreak", "hardbreak"):
            content = token.content if token.type == "code_inline" else with_minus(token.content)
            if not content:  # before a mark that begins a line there is an empty text
                if token.type == "text":
                    continue
                content = " "
            kinds = [*styles, "code"] if token.type == "code_inline" else list(styles)
            if of_line and "math" not in of_line[-1] and of_line[-1]["styles"] == kinds and of_line[-1]["href"] == href:
                of_line[-1]["text"] += content
            else:
                of_line.append({"text": content, "styles": kinds, "href": href})
    return of_line
