"""The page in a real browser: a slider is dragged, a number is typed, and what is shown is what `run` prints."""

from __future__ import annotations

import importlib.util
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")

from tests.app.served import served, started
from tests.app.test_answers import ran
from tests.documents.browser import Browser, installed

pytestmark = pytest.mark.skipif(installed() is None, reason="no Chromium is installed")

KEY = r"document.getElementById('key').innerText.replaceAll('\u00a0', ' ').replaceAll('\u2060', '')"
LOAD = "document.getElementById('operation.axial_load_N')"
SLIDER = "document.querySelector('[data-slides=\"operation.axial_load_N\"]')"
DIAMETER = "document.getElementById('bearing.ball_diameter_mm')"
UNDO = "document.getElementById('undo')"


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with served("7210C_hybrid") as found:
        yield found


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with Browser() as found:
        yield found


@pytest.fixture
def page(browser: Browser, address: str) -> Browser:
    browser.open(address)
    wait(browser, "document.querySelectorAll('#effects tbody tr').length > 0")
    return browser


def wait(browser: Browser, script: str) -> None:
    until = time.monotonic() + 60.0
    while not browser.value(script):
        assert time.monotonic() < until, script
        time.sleep(0.05)


def drag(browser: Browser, slider: str, pixels: float) -> None:
    """The thumb in the middle of a slider to the right."""
    x, y = browser.value(
        f"(() => {{ const e = {slider}; e.scrollIntoView({{block: 'center'}}); const r = e.getBoundingClientRect();"
        " return [r.x + r.width / 2, r.y + r.height / 2]; })()"
    )
    for kind, at in (("mousePressed", x), ("mouseMoved", x + pixels / 2), ("mouseMoved", x + pixels)):
        browser.ask("Input.dispatchMouseEvent", type=kind, x=at, y=y, button="left", buttons=1, clickCount=1)
    browser.ask("Input.dispatchMouseEvent", type="mouseReleased", x=x + pixels, y=y, button="left", clickCount=1)


def write(browser: Browser, field: str, text: str) -> None:
    browser.value(f"(e => {{ e.focus(); e.select(); }})({field})")
    browser.type(text)
    browser.value(f"{field}.blur()")


def test_a_dragged_slider_shows_what_run_prints(drawn: None, page: Browser, address: str, tmp_path: Path) -> None:
    before, load, drawing = (
        page.value(KEY),
        float(page.value(f"{LOAD}.value")),
        "document.querySelector('#section svg')",
    )
    first = page.value(f"{drawing}.outerHTML")
    drag(page, SLIDER, 40.0)
    wait(page, f"{KEY} !== {before!r}")
    dragged = float(page.value(f"{LOAD}.value"))
    assert dragged > load
    tables = started(address)
    tables["document"]["operation"]["axial_load_N"] = dragged
    found = ran(tables, tmp_path)
    pressure = max(ball["inner"]["max_pressure_MPa"] for ball in found["balls"])
    wait(page, f"{KEY}.includes('inner {pressure:.0f} MPa')")
    assert f"axial {found['effective_stiffness']['axial_N_per_um']:.4g} N/µm" in page.value(KEY)
    assert page.value(f"{drawing}.outerHTML") != first
    page.click(UNDO)
    wait(page, f"{KEY} === {before!r}")
    assert float(page.value(f"{LOAD}.value")) == load
    assert page.complaints == []


def test_a_wrong_number_is_told_at_its_field(page: Browser) -> None:
    before = page.value(KEY)
    write(page, DIAMETER, "-3")
    said = f"document.getElementById({DIAMETER}.getAttribute('aria-describedby'))?.textContent"
    wait(page, f"{said}?.includes('ball_diameter_mm = -3 mm') && {said}.includes('allowed')")
    wait(page, f"{DIAMETER}.getAttribute('aria-invalid') === 'true'")
    wait(page, "document.getElementById('key').classList.contains('stale')")
    page.click(UNDO)
    wait(page, f"!{DIAMETER}.hasAttribute('aria-invalid') && {KEY} === {before!r}")
    assert page.complaints == []


def test_an_old_answer_is_grey_and_says_of_which_input_it_is(page: Browser) -> None:
    """While the next one is worked out, and where there is none."""
    before = page.value(f"{LOAD}.value")
    page.value(
        "(() => { const real = window.fetch; window.fetch = async (...asked) => {"
        " if (asked[0] === '/solve') await new Promise(done => { window.go = done; }); return real(...asked); };"
        " window.back = () => { window.fetch = real; window.go?.(); }; })()"
    )
    write(page, LOAD, "1234")
    parts = ("section", "key", "warnings", "angles", "life", "effects", "tables")
    grey = "[" + ", ".join(f"document.getElementById('{part}')" for part in parts) + "]"
    of = "document.getElementById('of').textContent"
    wait(page, f"{grey}.every(each => each.classList.contains('stale'))")
    assert page.value(of) == f"Solving ... The results shown are those of operation.axial_load_N = {before}."
    page.value("window.back()")
    wait(page, f"{of} === '' && {grey}.every(each => !each.classList.contains('stale'))")
    write(page, DIAMETER, "-3")
    wait(page, f"{of}.startsWith('Not solved. The results shown are those of bearing.ball_diameter_mm = ')")
    page.click(UNDO)
    page.click(UNDO)
    wait(page, f"{LOAD}.value === {before!r} && {of} === ''")
    assert page.complaints == []


def test_keys_move_a_slider_and_undo(page: Browser) -> None:
    before, load = page.value(KEY), page.value(f"{LOAD}.value")
    page.value(f"{SLIDER}.focus()")
    for kind in ("rawKeyDown", "keyUp"):
        page.ask("Input.dispatchKeyEvent", type=kind, key="PageUp", code="PageUp", windowsVirtualKeyCode=33)
    wait(page, f"{KEY} !== {before!r}")
    assert page.value(f"document.activeElement === {SLIDER}")
    for kind in ("rawKeyDown", "keyUp"):
        page.ask("Input.dispatchKeyEvent", type=kind, key="z", code="KeyZ", windowsVirtualKeyCode=90, modifiers=2)
    wait(page, f"{KEY} === {before!r} && {LOAD}.value === {load!r}")


def test_the_focus_stays_where_tab_brings_it(page: Browser) -> None:
    page.value(f"(e => {{ e.focus(); e.select(); }})({LOAD})")
    page.type("1300")
    for kind in ("rawKeyDown", "keyUp"):
        page.ask("Input.dispatchKeyEvent", type=kind, key="Tab", code="Tab", windowsVirtualKeyCode=9)
    wait(page, f"Number({SLIDER}.max) === 2600")  # the fields are new ones around the number typed
    assert page.value("document.activeElement !== document.body")


def test_a_switch_takes_an_effect_out(page: Browser) -> None:
    before = page.value(KEY)
    page.click("document.getElementById('effect gyroscopic_moment')")
    wait(page, f"{KEY} !== {before!r}")
    assert "friction" in before and "friction" not in page.value(KEY)
    assert page.value("document.getElementById('effects.moment_shares')") is None
    page.click(UNDO)
    wait(page, f"{KEY} === {before!r}")


def test_a_key_is_added_in_place_of_what_excludes_it(page: Browser) -> None:
    number = page.value("[...document.getElementById('add').options].findIndex(o => o.text === 'preload.rigid_N') - 1")
    page.value(
        f"(s => {{ s.value = {number}; s.dispatchEvent(new Event('change')); }})(document.getElementById('add'))"
    )
    wait(page, "document.getElementById('preload.rigid_N') !== null")
    assert page.value(LOAD) is None
    write(page, "document.getElementById('preload.rigid_N')", "300")
    wait(page, f"{KEY}.includes('300 N before fitting')")


@pytest.mark.parametrize("width", [360, 1400])
def test_the_page_is_no_wider_than_its_window(page: Browser, width: int) -> None:
    page.ask("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
    assert page.value("document.documentElement.scrollWidth") <= width


def test_nothing_serious_bars_anybody(page: Browser) -> None:
    """By the rules of axe-core."""
    package = importlib.util.find_spec("axe_core_python")
    if package is None or package.submodule_search_locations is None:
        pytest.skip("axe-core-python is not installed")
    script = Path(package.submodule_search_locations[0]) / "axe.min.js"
    page.value(script.read_text(encoding="utf-8") + "; true")
    wait(page, "document.querySelectorAll('#tables table').length > 0 && !document.querySelector('.stale')")
    found = page.value(
        "axe.run().then(r => r.violations.map(v => [v.impact, v.id, v.nodes.slice(0, 3).map(n => n.html)]))"
    )
    assert [each for each in found if each[0] in ("serious", "critical")] == []
