"""Documents as pages of one folder: links between them, and the search."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from qsbearing.documents.data import BrokenLinkError
from qsbearing.documents.model import Document, Md, Paragraph, Section, Table
from qsbearing.documents.pages import SEARCH, pages
from tests.documents.browser import Browser, barriers, installed, layout_faults


def folder(link: str = "b.html#b-part") -> dict[str, Document]:
    """Two pages, one of which has a link to the other."""
    table = Table(("name", "value"), [["**stars** stay", Md("`code`")]])
    part = Section("Part <b>", [Paragraph("Preload, twice: preload."), table], "b-part")
    return {
        "a.html": Document("Home", "guide", [Section("First", [Paragraph(Md(f"See [there]({link})."))], "a-first")]),
        "b.html": Document("Other", "guide", [part], head=[Paragraph("Stiffness before.")]),
    }


def test_the_search_knows_each_section_by_its_words() -> None:
    found = pages(folder(), "a.html")
    assert list(found) == ["a.html", "b.html", SEARCH]
    first, _, _ = found[SEARCH].partition(";\n")
    entries = json.loads(first.removeprefix("const SECTIONS = "))
    assert entries == [
        ["a.html", "Home", "", ""],
        ["a.html#a-first", "Home", "First", "See there."],
        ["b.html", "Other", "", "Stiffness before."],
        ["b.html#b-part", "Other", "Part <b>", "Preload, twice: preload. name value **stars** stay code"],
    ]


@pytest.mark.parametrize("link", ["c.html", "b.html#b-nowhere"])
def test_a_link_to_no_page_or_section_is_refused(link: str) -> None:
    with pytest.raises(BrokenLinkError, match=link):
        pages(folder(link), "a.html")


@pytest.mark.skipif(installed() is None, reason="no Chromium is installed")
def test_a_browser_searches_without_network(tmp_path: Path) -> None:
    for name, text in pages(folder(), "a.html").items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    with Browser() as browser:
        for width in (1280, 390):
            browser.open(tmp_path / "a.html", width=width)
            typed = "const field = document.getElementById('search'); field.value = '{}'; "
            typed += "field.dispatchEvent(new Event('input')); "
            links = "[...document.querySelectorAll('#found a')].map(a => a.getAttribute('href'))"
            asked = f"(() => {{ {typed} return {links}; }})()"
            assert browser.value(asked.replace("{}", "PRELOAD part")) == ["b.html#b-part"]
            marks = "[...document.querySelectorAll('#found mark')].map(each => each.textContent)"
            assert browser.value(marks) == ["Preload", "preload"]
            assert browser.value("document.querySelector('#found a').textContent") == "Other: Part <b>"
            assert browser.value(asked.replace("{}", "other stiffness")) == ["b.html"]
            assert browser.value(asked.replace("{}", "xyzzy")) == []
            assert browser.value("document.getElementById('found').textContent") == "Nothing has all these words."
            assert browser.value(asked.replace("{}", "")) == []
            assert browser.value("document.getElementById('found').hidden")
        assert browser.complaints == []
        assert layout_faults(browser, tmp_path / "b.html") == [] == barriers(browser)
        browser.open(tmp_path / "a.html")
        assert barriers(browser) == []
