"""Pages that say how far results can be trusted: each section with measured numbers names what makes them again."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from fem_check.book.cases import ALL as BOOK
from fem_check.checks import ALL, OPTIONAL
from tests.guide.pages import GUIDE, ROOT

_TRUST = re.search(r"^## Trust$(.*?)^## ", (GUIDE / "index.md").read_text("utf-8"), re.DOTALL | re.MULTILINE)
PAGES = [
    GUIDE / name for name in re.findall(r"^- \[.*?\]\((\w+\.md)\)", _TRUST[1] if _TRUST else "", re.MULTILINE)
    if name != "bibliography.md"
]  # fmt: skip
_MEASURED = re.compile(
    r"(?<![\w.,`])\d[\d.,]*(?: to [\d.,]+)? ?(?:%|µm|N/µm|MPa|GPa|°)(?!\w)"
    r"|\d[\d.,]* of [\d,]*\d|\d,\d{3} (?:random|scenes)"
)
COMMAND = re.compile(r"python -m tests\.\w|fem-check \w|qsbearing \w|pytest \w|[Nn]o command")


def untraced(page: str) -> list[str]:
    """Headings of sections with measured numbers that name no command, and do not say that there is none."""
    outside = re.sub(r"^```toml\n.*?^```$", "", page, flags=re.DOTALL | re.MULTILINE)
    found = []
    for section in re.split(r"^(?=## )", outside, flags=re.MULTILINE):
        plain = re.sub(r"\s+", " ", section)
        if _MEASURED.search(plain) and not COMMAND.search(plain):
            found.append(section.partition("\n")[0])
    return found


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_numbers_name_what_makes_them_again(page: Path) -> None:
    assert untraced(page.read_text("utf-8")) == []


def test_pages_and_sections_without_a_command_are_found() -> None:
    assert len(PAGES) >= 8
    assert untraced("# A\n\nIt errs by 3 %.\n\n## B\n\n`pytest tests` says 2.4 µm.\n") == ["# A"]
    assert untraced("# A\n\nNumbers without a size: 3.\n\n## B\n\nOf 3 of 10,000 no command tells.\n") == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_what_is_named_exists(page: Path) -> None:
    text = re.sub(r"\s+", " ", page.read_text("utf-8"))
    checks = re.findall(r"fem-check run (\w+)", text)
    assert set(checks) <= ALL.keys() | OPTIONAL.keys()
    assert set(re.findall(r"fem-check book (\w+)", text)) <= set(BOOK)
    for path in re.findall(r"pytest (tests/[\w/]+(?:\.py)?)", text):
        assert (ROOT / path).exists(), path
