"""Formulas: one notation in two forms."""

from __future__ import annotations

import re

import pytest

from qsbearing.documents.formula import forms, in_text, split
from qsbearing.documents.guide import topics

WIDTH = 78
"""Of a line of code in a terminal of 80 columns, as rich sets it."""

READ = {
    r"\tan\beta = \frac{\sin\alpha_o}{\cos\alpha_o + g}": "tan β = sin αₒ/(cos αₒ + g)",
    r"Q = K \max(\delta, 0)^{1.5}": "Q = K max(δ, 0)^1.5",
    r"\frac{1.5\,Q}{\pi a b}": "1.5 Q/(πab)",
    r"\frac{r}{E} (\sigma_\theta - \nu\,\sigma_r)": "(r/E)(σ_θ − ν σᵣ)",
    r"t = -\frac{\delta_i}{0.02\,l_i}": "t = −δᵢ/(0.02 lᵢ)",
    r"\langle |X| - l_o \rangle^{2.5}": "⟨|X| − lₒ⟩^2.5",
    r"\sqrt{\frac{\mathcal{E}}{4.5}} \cdot d": "√(ℰ/4.5)·d",
    r"\left[1 + x\right]^{-1}": "[1 + x]⁻¹",
}


@pytest.mark.parametrize(("latex", "line"), READ.items(), ids=READ.values())
def test_a_line_of_text_says_the_same(latex: str, line: str) -> None:
    """Brackets stand wherever a fraction on one line would be read otherwise."""
    assert forms(latex)["text"] == line


def _formulas() -> list[str]:
    text = "\n".join(page.text for page in topics().values())
    text = re.sub(r"^```.*?^```$|`[^`\n]*`", "", text, flags=re.DOTALL | re.MULTILINE)
    own = re.findall(r"^\$\$\n(.*?)\n\$\$$", text, flags=re.DOTALL | re.MULTILINE)
    return [split(each)[0] for each in own] + re.findall(r"(?<![\w$])\$([^\s$][^$]*)\$(?!\w)", text)


def test_every_formula_of_the_guide_has_all_forms() -> None:
    """None is left as LaTeX."""
    found = sorted(set(_formulas()))
    assert len(found) > 80
    for latex in found:
        each = forms(latex)
        assert not re.search(r"\\[a-z]+|[{}]", each["mathml"] + each["text"]), each
        assert each["mathml"].startswith("<math ")


def test_lines_of_formulas_fit_a_terminal() -> None:
    for name, page in topics().items():
        for own in re.findall(r"^\$\$\n.*?\n\$\$$", page.text, flags=re.DOTALL | re.MULTILINE):
            assert len(in_text(own).removeprefix("    ")) <= WIDTH, (name, in_text(own))


def test_a_page_for_the_terminal_keeps_its_code() -> None:
    page = "The angle $\\alpha_i$ costs $5.\n\n```sh\necho $x $y$\n```\n\n$$\na = b \\tag{19.3}\n$$\n"
    assert in_text(page) == "The angle αᵢ costs $5.\n\n```sh\necho $x $y$\n```\n\n    a = b    (19.3)\n"


def test_what_has_no_rule_is_refused() -> None:
    with pytest.raises(ValueError, match="no rule for <mover>"):
        forms(r"\dot x")
