"""Formulas of the guide as MathML, for Python-Markdown: `$...$` within a line, `$$...$$` as a line of its own."""

from __future__ import annotations

import re
from typing import Any

from markdown import Extension, Markdown
from markdown.preprocessors import Preprocessor

from qsbearing.documents.formula import forms, split

CODE = r"^(?P<fence>`{3,}|~{3,})[^\n]*\n.*?^(?P=fence)[ \t]*$|(?P<ticks>`+)[^`].*?(?P=ticks)"
FORMULA = re.compile(rf"{CODE}|\$\$(?P<block>.+?)\$\$|(?<![\\$])\$(?P<line>[^$\n]+?)\$", re.DOTALL | re.MULTILINE)


class Formulas(Preprocessor):
    """Before all else, so that no other rule reads what stands between dollars: a bar in a table, an underscore."""

    def run(self, lines: list[str]) -> list[str]:
        return FORMULA.sub(self._shown, "\n".join(lines)).split("\n")

    def _shown(self, match: re.Match[str]) -> str:
        if match["block"] is not None:
            latex, number = split(match["block"])
            number = f'<span class="number">{number}</span>' if number else ""
            shown = f'<div class="formula">{forms(latex, is_block=True)["mathml"]}{number}</div>'
            return f"\n\n{self.md.htmlStash.store(shown)}\n\n"
        if match["line"] is not None:
            return self.md.htmlStash.store(forms(match["line"])["mathml"])
        return match[0]


class FormulaExtension(Extension):
    """Registers it after the fences are put away (25), before HTML blocks (20) are."""

    def extendMarkdown(self, md: Markdown) -> None:
        md.preprocessors.register(Formulas(md), "formulas", 26)


def makeExtension(**kwargs: Any) -> FormulaExtension:
    """By this name Python-Markdown finds it."""
    return FormulaExtension(**kwargs)
