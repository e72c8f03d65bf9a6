"""A page in a real browser: sorting and filtering by clicks and keys, nothing to complain of, readable when narrow."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from qsbearing.documents.html import html
from qsbearing.documents.model import Document, Section, Table
from tests.documents.browser import OVERFLOWS, WIDE, Browser, installed, layout_faults
from tests.documents.example import document

pytestmark = pytest.mark.skipif(installed() is None, reason="no Chromium is installed")

NAMES = (
    "[...document.querySelectorAll('table[data-tools] tbody tr')].filter(r => r.checkVisibility())"
    ".map(r => r.cells[0].textContent)"
)


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with Browser() as found:
        yield found


@pytest.fixture
def page(tmp_path: Path) -> Path:
    path = tmp_path / "page.html"
    path.write_text(html(document()), encoding="utf-8")
    return path


def test_a_table_is_sorted_and_filtered(browser: Browser, page: Path) -> None:
    browser.open(page)
    heading = "document.querySelectorAll('table[data-tools] th button')[1]"
    assert browser.value(NAMES) == ["alpha", "beta", "gamma", "delta"]
    browser.click(heading)
    assert browser.value(NAMES) == ["beta", "gamma", "alpha", "delta"]
    browser.click(heading)
    assert browser.value(NAMES) == ["alpha", "gamma", "beta", "delta"]
    assert browser.value(f"{heading}.closest('th').ariaSort") == "descending"
    browser.click("document.querySelectorAll('table[data-tools] th button')[2]")
    assert browser.value(NAMES) == ["beta", "delta", "alpha", "gamma"], "rows alike keep their order"
    browser.click("document.querySelectorAll('table[data-tools] th button')[2]")
    assert browser.value(NAMES) == ["alpha", "gamma", "delta", "beta"]
    browser.click("document.querySelector('.tools input')")
    browser.type("ETA")
    assert browser.value(NAMES) == ["beta"]
    assert browser.value("document.querySelector('.tools output').textContent") == "1 of 4 rows"
    assert browser.complaints == []


def test_a_table_is_filtered_by_verdict(browser: Browser, page: Path) -> None:
    browser.open(page)
    browser.click("document.querySelector('.tools select')")
    browser.value(
        "(s => { s.value = 'pass'; s.dispatchEvent(new Event('input')); })(document.querySelector('.tools select'))"
    )
    assert browser.value(NAMES) == ["alpha", "gamma"]
    assert browser.complaints == []


def test_a_page_is_whole_without_scripts(browser: Browser, page: Path) -> None:
    browser.open(page, scripts=False)
    found = browser.ask("DOM.getDocument", depth=-1)
    assert "alpha" in str(found)
    assert "'tools'" not in str(found)
    assert browser.complaints == []


@pytest.mark.parametrize("width", [360, 800, 1600])
def test_no_page_is_wider_than_its_window(browser: Browser, page: Path, width: int) -> None:
    browser.open(page, width=width)
    assert browser.value(WIDE) <= width


def test_a_table_that_stacks_on_a_phone_is_not_cut_on_a_tablet(browser: Browser, tmp_path: Path) -> None:
    head = ("case", "quantity", "computed by the model", "reference", "deviation, largest", "allowed by it", "verdict")
    long = "123.456 N/mm² ± 0.0012 " * 2
    row = ["a case", "outer load", long, long, "0.00123456 of 12", "0.00123456", "pass"]
    page = tmp_path / "wide.html"
    table = Table(head, [row], "llrrrrl", stack=True)
    page.write_text(html(Document("One", "two", [Section("Three", [table])])), encoding="utf-8")
    browser.open(page, width=768)
    box = "document.querySelector('table').parentElement"
    assert browser.value(f"{box}.scrollWidth") <= browser.value(f"{box}.clientWidth")


def test_an_element_that_is_too_wide_is_found(browser: Browser, page: Path) -> None:
    page.write_text(page.read_text().replace('<main id="start">', '<main id="start"><p style="width: 900px">wide</p>'))
    browser.open(page, width=390)
    assert any("wide" in each for each in browser.value(OVERFLOWS))
    page.write_text(page.read_text().replace("</main>", '<a href="#nowhere">x</a></main>'))
    faults = layout_faults(browser, page)
    assert any("wide" in each for each in faults)
    assert any("wider than its window" in each for each in faults)
    assert any("nowhere" in each for each in faults)


def test_the_browser_hears_complaints(browser: Browser, tmp_path: Path) -> None:
    """The page may load nothing: a picture from elsewhere is refused, and said. What is thrown is heard as well."""
    text = html(document()).replace("<main", '<img src="https://example.invalid/a.png"><main')
    spoilt = tmp_path / "spoilt.html"
    spoilt.write_text(
        text.replace('"use strict";', '"use strict"; setTimeout(() => { throw 1; }, 0);'), encoding="utf-8"
    )
    browser.open(spoilt)
    browser.value("new Promise(done => setTimeout(done, 50))")
    assert any("Content Security Policy" in said for said in browser.complaints)
    assert any("Uncaught" in said for said in browser.complaints)
    browser.complaints.clear()
