"""The site: made without a warning, whole, sound in a browser without network, and found by the command."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from qsbearing.cli import cli
from qsbearing.documents.guide import FOLDER
from qsbearing.model.version import __version__
from qsbearing.site.versions import list_versions
from tests.documents.browser import WIDE, Browser, barriers, installed

pytest.importorskip("mkdocs")
in_browser = pytest.mark.skipif(installed() is None, reason="no Chromium is installed")

MATHML = {
    "mrow", "mi", "mn", "mo", "mtext", "mspace", "mstyle", "mfrac", "msqrt", "msub", "msup", "msubsup", "munder",
    "munderover",
}  # fmt: skip
"""Elements that MathML Core knows: a browser shows others as a row of letters."""
TEN = (
    "index", "ten_minutes", "model", "limits", "readings", "reference/python/solution", "reference/python/sets",
    "reference/files/effects", "reference/commands/qsbearing", "reference/results/bearing",
)  # fmt: skip
"""Pages of each kind."""
MOST_SECONDS = 60.0
"""Of a processor, to make the site."""
OLDER = "0.1.9"


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The folder of the site and that of its pages in Markdown; made in less than a minute of a processor."""
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "qsbearing.site", str(folder / "made"), "--pages", str(folder / "pages")]
    before = os.times().children_user
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout + ended.stderr) == (0, "")
    assert os.times().children_user - before < MOST_SECONDS
    return folder / "made" / __version__, folder / "pages"


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with Browser() as found:
        found.ask("Network.enable")
        found.ask("Network.emulateNetworkConditions", offline=True, latency=0, downloadThroughput=0, uploadThroughput=0)
        yield found


def test_every_page_of_the_guide_is_there(site: tuple[Path, Path]) -> None:
    made, _ = site
    assert {path.stem for path in FOLDER.glob("*.md")} <= {path.stem for path in made.glob("*.html")}


def test_the_names_that_stay_are_those_that_are_shown(site: tuple[Path, Path]) -> None:
    from tests.guide.interface import classes, kept, words_of

    made, _ = site
    text = "".join(path.read_text(encoding="utf-8") for path in (made / "reference" / "python").glob("*.html"))
    places = set(re.findall(r'id="qsbearing\.([\w.]+)"', text))
    for name, of in classes().items():
        path = f"{name.removeprefix('qs.')}."
        shown = {place.removeprefix(path) for place in places if place.startswith(path)}
        assert words_of(of, shown) == set(kept()["python"][name]), name


def test_every_key_has_a_meaning(site: tuple[Path, Path]) -> None:
    _, pages = site
    rows = [
        line.split(" | ")
        for path in (pages / "reference" / "files").glob("*.md")
        for line in path.read_text(encoding="utf-8").splitlines()
        if line.startswith("| `")
    ]
    assert len(rows) > 370
    assert [key for key, meaning, *_ in rows if not meaning.strip()] == []


def test_every_command_and_option_is_there(site: tuple[Path, Path]) -> None:
    _, pages = site
    sections = (pages / "reference" / "commands" / "qsbearing.md").read_text(encoding="utf-8").split("\n## qsbearing ")
    told = {text.partition("\n")[0]: text for text in sections}
    for name, command in cli.commands.items():
        text = told[name]
        shown = [each for each in command.params if not getattr(each, "hidden", False)]
        options = [option for each in shown for option in each.opts if option.startswith("--")]
        assert [option for option in options if option not in text] == []


def test_nothing_is_asked_of_the_network(site: tuple[Path, Path]) -> None:
    made, _ = site
    for path in made.rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        assert re.findall(r"<(?:script|img|iframe)[^>]*src=\"?(?:https?:)?//[^>]*>", text) == []
        assert re.findall(r"<link[^>]*rel=\"?(?:stylesheet|preconnect)[^>]*href=\"?(?:https?:)?//[^>]*>", text) == []


def test_no_formula_is_left_as_it_is_written(site: tuple[Path, Path]) -> None:
    made, _ = site
    shown = 0
    for path in made.glob("*.html"):
        if path.name in ("changes.html", "cite.html"):
            continue
        text = re.sub(r"<(code|pre|script|title)\b.*?</\1>", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
        assert "$" not in re.sub(r"<[^>]*>", "", text), path.name
        shown += text.count("<math")
    assert shown > 250


@in_browser
@pytest.mark.parametrize(
    ("typed", "page"),
    [
        ("preload", "sets.html"),
        ("solution.inner.required_friction", "solution.html"),
        ("effects.traction", "ball_axis.html"),
        ("contributing", "contributing.html"),
        ("add a reading", "adding_a_reading.html"),
    ],
)
def test_the_search_needs_no_network(site: tuple[Path, Path], browser: Browser, typed: str, page: str) -> None:
    """Names with points too, by their parts."""
    made, _ = site
    browser.open(made / "index.html")
    browser.value("document.querySelector('[name=query]').focus()")
    browser.type(typed)
    assert browser.soon("document.querySelectorAll('.md-search-result__item').length") >= 1
    links = browser.value("[...document.querySelectorAll('.md-search-result__link')].map(a => a.pathname)")
    assert any(link.endswith(page) for link in links)
    assert browser.complaints == []


@in_browser
@pytest.mark.parametrize("page", TEN)
def test_the_content_is_wide_enough_and_bars_nobody(site: tuple[Path, Path], browser: Browser, page: str) -> None:
    made, _ = site
    for width in (1280, 390):
        browser.open(made / f"{page}.html", width=width)
        assert browser.value(WIDE) <= width
    assert barriers(browser) == []
    assert browser.complaints == []


@in_browser
def test_dark_pages_bar_nobody(site: tuple[Path, Path]) -> None:
    """In a browser of its own: one keeps the colours that it has shown first."""
    made, _ = site
    with Browser() as browser:
        browser.ask("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        for page in ("index", "ten_minutes", "agreement"):
            browser.open(made / f"{page}.html")
            assert browser.value("document.body.dataset.mdColorScheme") == "slate"
            assert barriers(browser) == []


@in_browser
def test_the_agreement_is_the_first_page_of_trust(site: tuple[Path, Path], browser: Browser) -> None:
    made, _ = site
    browser.open(made / "index.html")
    tabs = browser.value("[...document.querySelectorAll('.md-tabs__link')].map(a => [a.innerText.trim(), a.pathname])")
    assert Path(dict(tabs)["Trust"]).name == "agreement.html"


@pytest.fixture
def several(site: tuple[Path, Path]) -> Iterator[str]:
    """The address of a server of this version and an older one."""
    made, _ = site
    folder = made.parent
    shutil.copytree(made, folder / OLDER)
    list_versions(folder)
    quiet = type("Quiet", (SimpleHTTPRequestHandler,), {"log_message": lambda *_: None})
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(quiet, directory=str(folder))) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()
    shutil.rmtree(folder / OLDER)


@in_browser
def test_a_version_offers_the_others(several: str) -> None:
    """The folder leads to the newest, which lists all; an older one says that it is none."""
    listed = "[...document.querySelectorAll('.md-version__link')].map(a => a.href)"
    is_warned = "document.querySelector('[data-md-component=outdated]')?.hidden === false"
    with Browser() as browser:
        browser.open(several)
        assert browser.soon(listed) == [f"{several}{__version__}/", f"{several}{OLDER}/"]
        assert browser.value("location.pathname") == f"/{__version__}/index.html"
        assert not browser.value(is_warned)
        browser.value(f"location.href = '{several}{OLDER}/limits.html'")
        assert browser.soon(is_warned)
        newest = browser.value("document.querySelector('.md-banner a').href")
        assert newest == several
        assert browser.complaints == []


@in_browser
def test_formulas_are_drawn(site: tuple[Path, Path], browser: Browser) -> None:
    """A numerator is above its denominator, an index lower than its base: the browser knows MathML."""
    made, _ = site
    browser.open(made / "model.html")
    assert browser.value("document.querySelectorAll('math').length") > 100
    used = browser.value("[...document.querySelectorAll('math *')].map(e => e.tagName)")
    assert set(used) <= MATHML
    assert used.count("mfrac") > 20 and used.count("msub") > 100 and used.count("msqrt") > 0
    assert browser.value(
        "[...document.querySelectorAll('mfrac')].every(e => e.children[0].getBoundingClientRect().bottom"
        " <= e.children[1].getBoundingClientRect().top + 1)"
    )
    assert browser.value(
        "[...document.querySelectorAll('msub')].every(e => e.children[1].getBoundingClientRect().bottom"
        " > e.children[0].getBoundingClientRect().bottom - 1)"
    )
