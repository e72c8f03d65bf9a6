"""Numbers of the README follow from records and runs, and each has its command on the page on releases."""

from __future__ import annotations

import re

import pytest

from tests.guide import claims
from tests.guide.pages import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")
TRUST = README.partition("## How far to trust it")[2].partition("\n## ")[0]


@pytest.fixture(scope="module")
def made() -> list[claims.Claim]:
    return claims.all_claims()


def test_the_readme_says_what_records_and_runs_say(made: list[claims.Claim]) -> None:
    text = claims.plain(README)
    assert [each.says for each in made if each.says not in text] == []


NOT_CLAIMS = {"50": "digits, of which the reference has so many", "15": "degrees, at which the grooves are fitted"}
"""Numbers in the section on trust that state no result."""


def test_every_number_of_the_section_on_trust_is_a_claim(made: list[claims.Claim]) -> None:
    text = claims.plain(TRUST)
    for each in made:
        text = text.replace(each.says, "")
    text = re.sub(r"`[^`]*`|<!--.*?-->|wrong in \d+ campaigns: 0", "", text)
    assert [each for each in re.findall(r"\d[\d.,]*\d|\d", text) if each not in NOT_CLAIMS] == []
