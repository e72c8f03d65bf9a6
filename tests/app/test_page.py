"""The page in a real browser: a slider is dragged, a number is typed, and what is shown is what `run` prints; all of it
on one screen, old results never as if they were new, and for people without a mouse or good eyes too."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")

from qsbearing.app import answers
from qsbearing.model.operation import CHANNELS
from tests.app.served import served, started
from tests.app.test_answers import ran
from tests.app.test_sets import SPINDLE
from tests.documents.browser import OVERFLOWS, WIDTHS, Browser, barriers, installed
from tests.systems.sets.arrangements import PAIR_FILE

pytestmark = pytest.mark.skipif(installed() is None, reason="no Chromium is installed")

KEY = r"document.getElementById('key').innerText.replaceAll('\u00a0', ' ').replaceAll('\u2060', '')"
LOAD = "document.getElementById('operation.axial_load_N')"
SLIDER = "document.querySelector('[data-slides=\"operation.axial_load_N\"]')"
DIAMETER = "document.getElementById('bearing.ball_diameter_mm')"
UNDO, PIN = "document.getElementById('undo')", "document.getElementById('pin')"
OF = "document.getElementById('of').textContent"
SOLVED = "document.getElementById('of').textContent.startsWith('Solved')"
WHOLE = f"{SOLVED} && document.querySelectorAll('#tables table').length > 0 && !document.querySelector('.stale')"
BOXES = "[...document.querySelectorAll('#boxes span')].map(e => e.textContent)"


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with served("7210C_hybrid") as found:
        yield found


@pytest.fixture
def page(browser: Browser, address: str) -> Browser:
    browser.open(address)
    browser.soon("document.querySelectorAll('#effects tbody tr').length > 0")
    return browser


def opened(browser: Browser, text: str) -> None:
    """A file, on the page that is there."""
    given = json.dumps({"text": text, "label": "mine"})
    assert browser.value(f"workbench.take('open', {given})")
    browser.soon(f"!workbench.page.busy && {WHOLE}")


def press(browser: Browser, key: str, code: int) -> None:
    for kind in ("rawKeyDown", "keyUp"):
        browser.ask("Input.dispatchKeyEvent", type=kind, key=key, code=key, windowsVirtualKeyCode=code)


def boxes(browser: Browser, *names: str) -> dict[str, Any]:
    """Where elements are in the window: left, top, right, bottom."""
    script = "(name => { const r = document.getElementById(name).getBoundingClientRect();"
    return {name: browser.value(f"{script} return [r.left, r.top, r.right, r.bottom]; }})({name!r})") for name in names}


def drag(browser: Browser, slider: str, pixels: float) -> None:
    """The thumb in the middle of a slider to the right."""
    x, y = browser.middle(slider)
    for kind, at in (("mousePressed", x), ("mouseMoved", x + pixels / 2), ("mouseMoved", x + pixels)):
        browser.ask("Input.dispatchMouseEvent", type=kind, x=at, y=y, button="left", buttons=1, clickCount=1)
    browser.ask("Input.dispatchMouseEvent", type="mouseReleased", x=x + pixels, y=y, button="left", clickCount=1)


def write(browser: Browser, field: str, text: str) -> None:
    browser.value(f"(e => {{ e.closest('details')?.setAttribute('open', ''); e.focus(); e.select(); }})({field})")
    browser.type(text)
    browser.value(f"{field}.blur()")
    # The fields are new ones around it, and undo knows it.
    browser.soon("JSON.stringify(workbench.page.now) === workbench.page.settled")


def test_a_dragged_slider_shows_what_run_prints(drawn: None, page: Browser, address: str, tmp_path: Path) -> None:
    before, load, drawing = (
        page.value(KEY),
        float(page.value(f"{LOAD}.value")),
        "document.querySelector('#section svg')",
    )
    first = page.value(f"{drawing}.outerHTML")
    drag(page, SLIDER, 40.0)
    page.soon(f"{KEY} !== {before!r}")
    dragged = float(page.value(f"{LOAD}.value"))
    assert dragged > load
    tables = started(address)
    tables["document"]["operation"]["axial_load_N"] = dragged
    found = ran(tables, tmp_path)
    pressure = max(ball["inner"]["max_pressure_MPa"] for ball in found["balls"])
    page.soon(f"{KEY}.includes('{pressure:.0f} / ')")
    stiffness = found["effective_stiffness"]
    shown = " / ".join(f"{stiffness[f'{name}_N_per_um']:.4g}" for name in ("axial", "radial_y", "radial_z"))
    assert f"{shown} N/µm\naxial / radial y / radial z" in page.value(KEY)
    assert page.value(f"{drawing}.outerHTML") != first
    page.click(UNDO)
    page.soon(f"{KEY} === {before!r}")
    assert float(page.value(f"{LOAD}.value")) == load
    assert page.complaints == []


def test_a_wrong_number_is_told_at_its_field(page: Browser) -> None:
    before = page.value(KEY)
    write(page, DIAMETER, "-3")
    said = f"document.getElementById({DIAMETER}.getAttribute('aria-describedby'))?.textContent"
    page.soon(f"{said}?.includes('ball_diameter_mm = -3 mm') && {said}.includes('allowed')")
    page.soon(f"{DIAMETER}.getAttribute('aria-invalid') === 'true'")
    page.soon("document.getElementById('key').classList.contains('stale')")
    page.click(UNDO)
    page.soon(f"!{DIAMETER}.hasAttribute('aria-invalid') && {KEY} === {before!r}")
    assert page.complaints == []


def hold(page: Browser, question: str) -> None:
    """Let the page wait for the answers to a question until `back()`."""
    page.value(
        "(() => { const real = window.fetch; window.fetch = async (...asked) => {"
        f" if (asked[0] === '/{question}') await new Promise(done => {{ window.go = done; }});"
        " return real(...asked); };"
        " window.back = () => { window.fetch = real; window.go?.(); }; })()"
    )


def test_an_old_answer_is_grey_and_says_of_which_input_it_is(page: Browser) -> None:
    """From the very change on, while the next one is worked out, and where there is none."""
    page.soon(WHOLE)
    before, shares = page.value(f"{LOAD}.value"), page.value(BOXES)
    assert any(each.endswith("%") for each in shares)
    hold(page, "solve")
    parts = ("section", "key", "warnings", "angles", "life", "effects", "tables")
    grey = "[" + ", ".join(f"document.getElementById('{part}')" for part in parts) + "]"
    at_once = page.value(
        f"(e => {{ e.value = 12345; e.oninput(); return [{OF}, {grey}.map(each => each.className),"
        f" {BOXES}, {PIN}.disabled]; }})({LOAD})"
    )
    said = f"Solving ... The results are of axial load {float(before):,.0f} N."
    assert at_once[0] == said and all("stale" in each for each in at_once[1]) and at_once[3]
    assert set(at_once[2]) == {"not yet solved"}
    page.value("window.back()")
    page.soon(f"{SOLVED} && {grey}.every(each => !each.classList.contains('stale'))")
    page.soon(
        f"{BOXES}.some(each => each.endsWith('%')) && JSON.stringify({BOXES}) !== {json.dumps(json.dumps(shares))}",
    )
    write(page, DIAMETER, "-3")
    page.soon(f"{OF}.startsWith('Not solved. The results are of ball diameter ')")
    write(page, LOAD, "-7")
    page.soon(f"{OF}.includes(', axial load 12,345 N.') && {grey}.every(each => each.classList.contains('stale'))")
    assert page.complaints == []


def test_an_answer_to_an_input_that_has_changed_since_stays_grey(page: Browser) -> None:
    page.soon(WHOLE)
    hold(page, "solve")
    page.value(f"(e => {{ e.value = 700; e.oninput(); }})({LOAD})")
    page.soon("window.go !== undefined")
    page.value(f"(e => {{ const go = window.go; e.value = 800; e.oninput(); window.go = undefined; go(); }})({LOAD})")
    page.soon(f"window.go !== undefined && {OF}.includes('axial load 700 N')")
    assert page.value("document.getElementById('key').classList.contains('stale')")
    page.value("window.back()")
    page.soon(SOLVED)


def test_shares_of_effects_come_after_the_results(page: Browser) -> None:
    page.soon(WHOLE)
    hold(page, "effects")
    write(page, LOAD, "777")
    page.soon(f"{SOLVED} && !document.getElementById('tables').classList.contains('stale')")
    assert set(page.value(BOXES)) == {"not yet solved"}
    assert page.value("document.getElementById('effects').classList.contains('stale')")
    page.value("window.back()")
    page.soon(WHOLE)
    told = answers.effects(page.value("workbench.page.now.document"), "")["effects"]
    assert page.value(BOXES) == [each["most"] or each["verdict"] for each in told]


def test_pinned_states_stand_beside_the_present_one(page: Browser) -> None:
    """With differences in the unit of each result."""
    page.soon(WHOLE)
    first, load = page.value("workbench.page.found.key"), float(page.value(f"{LOAD}.value"))
    page.click(PIN)
    assert "A 0 / 0 MPa" in page.value(KEY)
    write(page, LOAD, "900")
    page.soon(f"{SOLVED} && {LOAD}.value === '900'")
    page.click(PIN)
    write(page, LOAD, "700")
    page.soon(f"{SOLVED} && {LOAD}.value === '700'")
    third = page.value("workbench.page.found.key")
    second = page.value("workbench.page.pins[1].found.key")
    table = "[...document.querySelectorAll('#pinned tr')].map(row => [...row.cells].map(cell => cell.innerText))"
    head, inputs, *rows = page.value(table)
    assert [each.split()[0] for each in head] == ["result", "now", "A", "B"]
    assert inputs[2:] == [f"axial load {load:,.0f} N", "axial load 900 N"]
    parts = [
        next(each["parts"] for each in key if each["name"] == "maximum contact load") for key in (first, second, third)
    ]
    now = parts.pop()
    (line,) = (row for row in rows if row[0].startswith("maximum contact load, N"))
    assert line[1] == " / ".join(each["number"] for each in now)
    for cell, own in zip(line[2:], parts, strict=True):
        sizes = [one["values"][0] - other["values"][0] for one, other in zip(own, now, strict=True)]
        shown = " / ".join(f"{each:+.3g}" for each in sizes).replace("-", "\u2212")
        assert cell == f"{' / '.join(each['number'] for each in own)}\n{shown} N"
    assert f"{line[1]} N\ninner / outer\nB {shown} N" in page.value(KEY)  # the last one pinned
    page.click("document.getElementById('unpin B')")
    assert "\nA " in page.value(KEY) and "\nB " not in page.value(KEY)
    page.click("document.getElementById('go to A')")
    page.soon(f"{SOLVED} && Number({LOAD}.value) === {load} && {KEY}.includes('A 0 / 0 N')")
    page.click(UNDO)
    page.soon(f"{SOLVED} && {LOAD}.value === '700'")
    page.click("document.getElementById('unpin A')")
    assert "\nA " not in page.value(KEY) and page.value("document.getElementById('states').hidden")


def test_keys_move_a_slider_and_undo(page: Browser) -> None:
    before, load = page.value(KEY), page.value(f"{LOAD}.value")
    page.value(f"{SLIDER}.focus()")
    press(page, "PageUp", 33)
    page.soon(f"{KEY} !== {before!r}")
    assert page.value(f"document.activeElement === {SLIDER}")
    for kind in ("rawKeyDown", "keyUp"):
        page.ask("Input.dispatchKeyEvent", type=kind, key="z", code="KeyZ", windowsVirtualKeyCode=90, modifiers=2)
    page.soon(f"{KEY} === {before!r} && {LOAD}.value === {load!r}")


def test_the_focus_stays_where_tab_brings_it(page: Browser) -> None:
    page.value(f"(e => {{ e.focus(); e.select(); }})({LOAD})")
    page.type("1300")
    press(page, "Tab", 9)
    page.soon(f"Number({SLIDER}.max) === 2600")  # the fields are new ones around the number typed
    assert page.value("document.activeElement !== document.body")


def test_a_switch_takes_an_effect_out(page: Browser) -> None:
    before = page.value(KEY)
    page.click("document.getElementById('effect gyroscopic_moment')")
    page.soon(f"{KEY} !== {before!r}")
    assert "friction" in before and "friction" not in page.value(KEY)
    assert page.value("document.getElementById('effects.moment_shares')") is None
    page.click(UNDO)
    page.soon(f"{KEY} === {before!r}")


def test_a_preload_is_chosen_in_place_of_what_excludes_it(page: Browser) -> None:
    page.soon(WHOLE)
    load = page.value(f"{LOAD}.value")
    choose(page, "document.getElementById('way preload')", "rigid_N")
    page.soon("document.getElementById('preload.rigid_N') !== null")
    assert page.value(LOAD) is None and page.value("document.getElementById('preload.rigid_N').value") == load
    write(page, "document.getElementById('preload.rigid_N')", "300")
    page.soon(f"{KEY}.includes('300 / ') && {KEY}.includes('before fitting / mounted at rest / in operation')")


def choose(browser: Browser, control: str, value: str) -> None:
    browser.value(f"(s => {{ s.value = '{value}'; s.dispatchEvent(new Event('change')); }})({control})")


def test_a_key_is_added_with_the_number_that_is_typed_and_not_before(page: Browser) -> None:
    options = "[...document.getElementById('add').options]"
    number = page.value(f"{options}.findIndex(o => o.text === 'bearing.inner_groove_radius_coefficient') - 1")
    before = page.value("JSON.stringify(workbench.page.now)")
    choose(page, "document.getElementById('add')", str(number))
    added = "document.getElementById('added')"
    assert page.value(f"document.activeElement === {added} && {added}.value === ''")
    assert page.value("JSON.stringify(workbench.page.now)") == before
    page.type("0.53")
    press(page, "Tab", 9)
    page.soon(f"{SOLVED} && document.activeElement.id === 'bearing.inner_groove_radius_coefficient'")
    assert page.value("workbench.page.now.document.bearing.inner_groove_radius_coefficient") == 0.53
    assert page.value("document.getElementById('bearing.inner_groove_radius_mm')") is None


def test_daily_use_needs_no_scrolling(browser: Browser, address: str, drawn: None) -> None:
    """Of b218, on a screen of 1280 x 900: speed and load first, results beside them."""
    browser.open(address)
    browser.soon("!workbench.page.busy && document.querySelectorAll('#effects tbody tr').length > 0")
    document = answers.start("b218")["document"]
    assert browser.value(f"workbench.take('check', {json.dumps({'document': document, 'label': 'b218'})})")
    browser.soon(f"!workbench.page.busy && {WHOLE}")
    ways = [f"way {channel.label} load" for channel in CHANNELS]
    bar = ("pin", "undo", "save", "report", "link")
    inputs = ("operation.speed_rpm", "operation.axial_load_N", *ways, "way preload", "switches", "add")
    results = ("of", "key", "warnings", "section", "stiffness", "life", "angles", "loads")
    found = boxes(browser, *bar, *inputs, *results)
    for name, (left, top, right, bottom) in found.items():
        assert left >= 0.0 and top >= 0.0 and right <= 1280.0 and 0.0 < bottom <= 900.0, name
        assert right > left, name
    assert max(found[name][2] for name in inputs) < min(found[name][0] for name in results)
    assert found["operation.speed_rpm"][1] < found["operation.axial_load_N"][1] < found["switches"][1]


def test_on_a_phone_results_stay_above_the_inputs(page: Browser) -> None:
    page.ask("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=1, mobile=False)
    page.soon(WHOLE)
    found = boxes(page, "results", "operation.speed_rpm", "warnings")
    assert found["results"][3] <= found["operation.speed_rpm"][1] < found["warnings"][1]
    for target in ("add", "tables"):
        page.value(f"document.getElementById('{target}').scrollIntoView({{block: 'end'}})")
        _, top, _, bottom = boxes(page, "results")["results"]
        assert top == 0.0 and bottom <= 0.3 * 844
        assert page.value("document.elementFromPoint(100, 60).closest('#results') !== null"), "covered"
    assert page.value("scrollY") > 0.0


def test_rows_are_tabs_and_the_tool_comes_first(page: Browser, drawn: None) -> None:
    opened(page, SPINDLE)
    assert page.value(KEY).startswith("tool: deflection\n")
    row = "document.getElementById('row').innerText"
    loads = [each["key"][0]["parts"][0]["number"] for each in page.value("workbench.page.found.rows")]
    assert loads[0] != loads[1] and page.value(row).startswith(f"axial load\n{loads[0]} N")
    first, shaft = (page.value(f"document.getElementById('{name}').innerHTML") for name in ("section", "shaft"))
    page.value("document.getElementById('tab 1').focus()")
    press(page, "Enter", 13)
    page.ask("Input.dispatchKeyEvent", type="char", text="\r")
    page.soon(f"{row}.startsWith('axial load\\n{loads[1]} N')")
    assert page.value("document.activeElement.id") == "tab 1"
    assert page.value("document.getElementById('tab 1').getAttribute('aria-pressed')") == "true"
    page.soon(WHOLE)
    assert page.value("document.getElementById('section').innerHTML") != first
    assert page.value("document.getElementById('shaft').innerHTML") == shaft
    field = "document.getElementById('shaft.load 1.radial_y_N')"
    before = page.value(KEY)
    write(page, field, "650")
    page.soon(f"{SOLVED} && {KEY} !== {before!r}")
    write(page, field, "1e30")
    page.soon(f"{field}.getAttribute('aria-invalid') === 'true' && {OF}.includes('shaft, load 1, radial y 650 N')")
    assert page.complaints == []


def test_every_input_is_reached_by_tab_and_shows_it(page: Browser) -> None:
    """Those of closed tables once they are opened, by the keyboard too."""
    page.value("document.getElementById('table bearing').querySelector('summary').focus()")
    page.ask("Input.dispatchKeyEvent", type="char", text=" ")
    press(page, " ", 32)
    page.soon("document.getElementById('table bearing').open")
    page.soon(f"!workbench.page.busy && {WHOLE}")
    wanted = page.value(
        "[...document.querySelectorAll('input, select, button, summary, #key')]"
        ".filter(e => !e.disabled && e.checkVisibility() && (e.type !== 'radio' || e.checked))"
        ".map((e, k) => e.id ||= `unnamed ${k}`)"
    )
    page.value("document.activeElement.blur(); scrollTo(0, 0)")
    seen: dict[str, bool] = {}
    outlined = (
        "(e => { const style = getComputedStyle(e.closest('.file, .ways label') ?? e);"  # the field itself is invisible
        " return [e.id, style.outlineStyle === 'solid' && parseFloat(style.outlineWidth) >= 2]; })"
        "(document.activeElement)"
    )
    for _ in range(3 * len(wanted)):  # round the page: tables that scroll are reached too
        press(page, "Tab", 9)
        name, is_seen = page.value(outlined)
        seen[name] = is_seen
        if set(wanted) <= set(seen):
            break
    assert set(wanted) - set(seen) == set()
    assert [name for name in wanted if not seen[name]] == []


@pytest.mark.parametrize("text", ["", PAIR_FILE, SPINDLE], ids=["scene", "set", "spindle"])
def test_the_page_fits_its_window_and_bars_nobody(page: Browser, text: str) -> None:
    """Nothing is wider than what holds it, and axe-core finds no violation of any of its rules."""
    if text:
        opened(page, text)
    page.soon(WHOLE)
    page.click(PIN)
    for width in WIDTHS:
        page.ask("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
        assert page.value("document.documentElement.scrollWidth") <= width
        assert page.value(OVERFLOWS) == [], width
        if width == WIDTHS[-1] or not text:
            assert barriers(page) == [], width
