"""Three pieces of work in a real browser, by keys and mouse as a person does them; and what the page keeps between two
visits. What it shows is what `run` prints of the same input."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")

from qsbearing.cli import cli
from tests.app.served import served
from tests.app.test_page import KEY, SOLVED, WHOLE, boxes, press, write
from tests.documents.browser import OVERFLOWS, WIDTHS, Browser, barriers, installed
from tests.systems.sets.arrangements import PAIR_FILE

pytestmark = pytest.mark.skipif(installed() is None, reason="no Chromium is installed")

REQUIRED = "[...document.querySelectorAll('#required tbody tr')].map(row => [...row.cells].map(cell => cell.innerText))"


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with served("7210C") as found:
        yield found


@pytest.fixture
def page(browser: Browser, address: str) -> Browser:
    visit(browser, address)
    browser.soon(SOLVED)
    return browser


def visit(browser: Browser, address: str) -> None:
    """Anew, also where it differs from the one before behind # alone."""
    before = [*browser.complaints]
    browser.open("about:blank")
    browser.complaints[:] = before  # what the page before still asked for is not asked by this one
    browser.open(address)


def ran(file: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(CliRunner().invoke(cli, ["run", str(file), "--json"]).stdout)
    return found


def field(name: str) -> str:
    return f"document.getElementById('{name}')"


def ready(browser: Browser) -> None:
    """What was done is done, and what is shown is of it."""
    now = "JSON.stringify(workbench.page.now)"
    browser.soon(f"{SOLVED} && {now} === JSON.stringify(workbench.page.shown) && {now} === workbench.page.settled")


def keys(browser: Browser, text: str) -> None:
    """Letters, as a list takes them to find an entry."""
    for letter in text:
        browser.ask("Input.dispatchKeyEvent", type="keyDown", key=letter, text=letter)
        browser.ask("Input.dispatchKeyEvent", type="keyUp", key=letter)


def by_keys(browser: Browser, of: str, act: Callable[[], None], script: str) -> None:
    """Keys in a field, as often as it takes: a list forgets the first letter where the second comes a second later, as
    on a machine that has much else to do."""
    for _ in range(5):
        browser.value(f"(e => {{ e.focus(); e.select?.(); }})({of})")
        act()
        press(browser, "Tab", 9)
        until = time.monotonic() + 12.0
        while time.monotonic() < until:
            if browser.value(script):
                return
            time.sleep(0.05)
    raise AssertionError(script)


def upload(browser: Browser, file: Path) -> None:
    """As the dialogue of "Open a file" does."""
    root = browser.ask("DOM.getDocument")["root"]["nodeId"]
    node = browser.ask("DOM.querySelector", nodeId=root, selector="#open")["nodeId"]
    browser.ask("DOM.setFileInputFiles", nodeId=node, files=[str(file)])


def saved(browser: Browser, button: str, folder: Path, file: str) -> Path:
    """What a button hands out."""
    browser.ask("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(folder))
    path = folder / file
    for _ in range(5):  # a click may miss what moves as an answer comes
        browser.soon(SOLVED)
        browser.click(field(button))
        for _ in range(150):
            if path.exists() and path.stat().st_size:
                return path
            browser.value("new Promise(done => setTimeout(done, 100))")
    raise AssertionError(f"{button} hands out no {file}")


def largest(found: dict[str, Any], side: str, name: str) -> float:
    return max(float(ball[side][name]) for ball in found["balls"])


def shown_pressures(found: dict[str, Any]) -> str:
    return " / ".join(f"{largest(found, side, 'max_pressure_MPa'):.4g}" for side in ("inner", "outer")) + " MPa"


def test_a_radial_load_on_a_bearing(page: Browser, tmp_path: Path, drawn: None) -> None:
    """By mouse, and once more by keys: one choice and one number. The tilt beside it is free, as the page shows."""
    page.click(f"{field('way radial y load')}.closest('label')")
    page.soon(f"{field('operation.radial_load_y_N')} !== null")
    press(page, "Tab", 9)
    assert page.value("document.activeElement.id") == "operation.radial_load_y_N"
    page.type("800")
    press(page, "Tab", 9)
    page.soon("workbench.page.shown.document.operation.radial_load_y_N === 800")
    ready(page)
    text = (
        '[bearing]\nname = "7210C"\n[operation]\nspeed_rpm = 24500\naxial_load_N = 1220\nradial_load_y_N = 800\n'
        'moment_z_Nm = 0\n[effects]\nball = ["centrifugal_force", "gyroscopic_moment"]\nraceway_control = "outer"\n'
    )
    (tmp_path / "radial.toml").write_text(text)
    found = ran(tmp_path / "radial.toml")
    assert shown_pressures(found) in page.value(KEY)
    assert page.value(f"{field('way tilt z free')}.checked")
    place = found["displacement"]["radial_y_um"]
    page.value(f"{field('way radial y load')}.focus()")
    press(page, "ArrowRight", 39)
    page.soon(f"{field('operation.radial_displacement_y_um')} !== null")
    assert page.value("document.activeElement.id") == "way radial y place"
    assert float(page.value(f"{field('operation.radial_displacement_y_um')}.value")) == pytest.approx(place, rel=1e-3)
    ready(page)
    assert shown_pressures(found).split()[0][:3] in page.value(KEY)  # nothing has moved
    press(page, "ArrowRight", 39)
    page.soon(f"{field('way radial y free')}.checked && {field('operation.radial_displacement_y_um')} === null")
    ready(page)
    assert page.value("workbench.page.now.document.operation.radial_load_y_N") is None
    assert page.complaints == []


def test_fits_for_a_hot_pair(page: Browser, tmp_path: Path, drawn: None) -> None:
    """The file is opened, the growth of its rings switched on, a fit picked, and temperatures typed."""
    (tmp_path / "pair.toml").write_text(PAIR_FILE)
    upload(page, tmp_path / "pair.toml")
    page.soon("document.querySelectorAll('#tabs button').length === 2")
    ready(page)
    cold = page.value(KEY)
    page.value(f"{field('effect ring_expansion')}.focus()")
    page.ask("Input.dispatchKeyEvent", type="keyDown", key=" ", code="Space", windowsVirtualKeyCode=32, text=" ")
    page.ask("Input.dispatchKeyEvent", type="keyUp", key=" ", code="Space", windowsVirtualKeyCode=32)
    page.soon(f"{field('effects.ring_expansion.shaft_fit')} !== null")
    ready(page)
    assert page.value(f"{field('effects.ring_expansion.shaft_fit')}.checkVisibility()")
    assert page.value(f"{field('effects.ring_expansion.bore_diameter_mm')}.value") == "50"
    fit = field("effects.ring_expansion.shaft_fit")
    picked = "workbench.page.now.document.effects.ring_expansion.shaft_fit === 'k5'"
    by_keys(page, fit, lambda: keys(page, "k5"), picked)
    for name, value in (("inner_ring_temperature_C", "60"), ("outer_ring_temperature_C", "45")):
        write(page, field(f"effects.ring_expansion.{name}"), value)
    ready(page)
    assert page.value(KEY) != cold
    hot = 'raceway_control = "outer"\n[effects.ring_expansion]\nshaft_fit = "k5"\n'
    hot += "inner_ring_temperature_C = 60\nouter_ring_temperature_C = 45\n"
    (tmp_path / "hot.toml").write_text(PAIR_FILE.replace('raceway_control = "outer"\n', hot))
    found = ran(tmp_path / "hot.toml")
    pressure = shown_pressures(found["rows"][0])
    assert pressure in page.value(f"{field('row')}.innerText.replaceAll('\\u00a0', ' ')")
    write(page, field("effects.ring_expansion.inner_ring_temperature_C"), "")  # emptied: not given
    ready(page)
    assert page.value("workbench.page.now.document.effects.ring_expansion.inner_ring_temperature_C") is None
    assert page.complaints == []


def test_a_second_state_is_compared_and_saved(page: Browser, address: str, tmp_path: Path, drawn: None) -> None:
    """And is there again after a reload, as what it is compared with is."""
    page.click(field("pin"))
    first = page.value("workbench.page.found.key")
    faster = "workbench.page.shown.document.operation.speed_rpm === 12000"
    by_keys(page, field("operation.speed_rpm"), lambda: page.type("12000"), faster)
    ready(page)
    file = saved(page, "save", tmp_path, "7210c.toml")
    found = ran(file)
    pressures = [largest(found, side, "max_pressure_MPa") for side in ("inner", "outer")]
    before = next(each["parts"] for each in first if each["name"] == "maximum contact pressure")
    sizes = [old["values"][0] - new for old, new in zip(before, pressures, strict=True)]
    shown = " / ".join(f"{each:+.3g}" for each in sizes).replace("-", "\u2212")
    assert f"{shown_pressures(found)}\ninner / outer\nA {shown} MPa" in page.value(KEY)
    rows = page.value("[...document.querySelectorAll('#pinned tr')].map(row => [...row.cells].map(c => c.innerText))")
    assert rows[1][2] == "speed 24,500 rpm"
    table = saved(page, "states csv", tmp_path, "states.csv").read_text().splitlines()
    assert table[0] == "result,of,which,unit,now,A"
    (line,) = (each.split(",") for each in table if each.startswith("maximum contact pressure,inner"))
    assert [float(each) for each in line[4:]] == [pytest.approx(pressures[0]), before[0]["values"][0]]
    balls = saved(page, "table", tmp_path, "7210c.csv").read_text().splitlines()
    CliRunner().invoke(cli, ["run", str(file), "--csv", str(tmp_path / "own.csv")], catch_exceptions=False)
    assert balls[0] == (tmp_path / "own.csv").read_text().splitlines()[0] and len(balls) == 16
    key, link = page.value(KEY), page.value("workbench.remember().then(() => location.href)")  # once it is there
    visit(page, link)
    page.soon(f"{SOLVED} && workbench.page.pins.length === 1 && {KEY}.includes('\\nA ')")
    assert page.value(KEY) == key and page.value(f"{field('operation.speed_rpm')}.value") == "12000"
    assert page.complaints == []


def test_the_report_is_handed_out(page: Browser, tmp_path: Path) -> None:
    text = saved(page, "report", tmp_path, "7210c_report.html").read_text()
    assert text.startswith("<!doctype html>") and "7210C" in text
    assert page.complaints == []


def test_an_address_that_is_no_state_says_so(page: Browser, address: str) -> None:
    visit(page, f"{address}#no_state")
    page.soon(f"{SOLVED} && {field('refused')}.innerText.includes('no state of this page')")
    assert page.value(f"{field('operation.axial_load_N')}.value") == "1220"


def test_faults_of_a_file_that_is_not_opened_are_none_of_the_fields(page: Browser, tmp_path: Path) -> None:
    """Though it has keys of the same name, which the scene on the page has right."""
    page.soon(WHOLE)
    before = page.value(KEY)
    wrong = '[bearing]\nname = "B218"\nball_diameter_mm = -3\n[operation]\nspeed_rpm = "fast"\naxial_load_N = 5\n'
    (tmp_path / "wrong.toml").write_text(wrong)
    upload(page, tmp_path / "wrong.toml")
    page.soon(f"{field('refused')}.innerText.includes('wrong.toml is not opened')")
    told = page.value(f"{field('refused')}.innerText")
    assert "ball_diameter_mm" in told and "speed_rpm" in told
    assert page.value("document.querySelectorAll('[aria-invalid]').length") == 0
    assert page.value("[...document.querySelectorAll('.wrong')].every(each => each.textContent === '')")
    assert page.value(KEY) == before and page.value("document.querySelector('.stale')") is None
    page.click(f"{field('way radial z load')}.closest('label')")  # the work goes on, and the message with it
    page.soon(f"{field('refused')}.innerText === ''")


def test_requirements_are_answered_and_edited_in_place(page: Browser) -> None:
    page.click(f"{field('requirements')}.querySelector('summary')")
    page.value(f"{field('require name')}.focus()")
    page.soon("document.querySelectorAll('#results-known option').length > 100")
    page.type("max_pressure")
    page.value(f"{field('require end')}.value = 'most'")
    page.value(f"{field('require value')}.focus()")
    page.type("2000")
    press(page, "Enter", 13)
    page.ask("Input.dispatchKeyEvent", type="char", text="\r")
    page.soon(f"{REQUIRED}.length === 1 && {REQUIRED}[0][4].startsWith('met, ')")
    ready(page)
    found = max(part["values"][0] for part in page.value("workbench.page.found.key")[0]["parts"])
    (row,) = page.value(REQUIRED)
    assert row[1] == f"{found:.4g}" and f"{100 * (1 - found / 2000):.2g} % to spare" in row[4]
    limit = field("require.max_pressure.most")
    write(page, limit, "1000")
    page.soon(f"{REQUIRED}[0][4].startsWith('not met')")
    assert "1 not met" in page.value(f"{field('of')}.textContent")
    assert barriers(page) == []
    write(page, limit, "")
    page.soon(f"{limit}.getAttribute('aria-invalid') === 'true'")
    page.click(field("require.max_pressure.most out"))
    page.soon(f"{REQUIRED}.length === 0 && {field('headline')}.textContent === 'none'")
    assert page.value("workbench.page.now.document.require") is None
    page.value(f"{field('require name')}.focus()")
    page.type("no_such_result")
    page.value(f"{field('require value')}.focus()")
    page.type("1")
    page.click(field("require add"))
    page.soon(f"{field('require.no_such_result.most wrong')}?.textContent.includes('no_such_result')")
    assert page.complaints == []


def test_what_is_missing_is_added_where_it_is_said(page: Browser) -> None:
    page.soon(f"{field('add ring_expansion')} !== null")
    before = page.value(KEY)
    page.click(field("add ring_expansion"))
    page.soon(f"{field('effect ring_expansion')}.checked")
    ready(page)
    assert page.value(KEY) != before and page.value("document.querySelectorAll('[aria-invalid]').length") == 0
    assert page.value("document.activeElement.closest('details').id") == "table effects, ring_expansion"
    housing = field("effects.ring_expansion.housing_fit")
    page.value(f"(s => {{ s.value = 'H6'; s.dispatchEvent(new Event('change')); }})({housing})")
    ready(page)
    outside = field("effects.ring_expansion.housing_outside_diameter_mm")
    assert page.value(f"{outside}.value") == "126" and "Assumed" in page.value(f"{field('said')}.textContent")


def test_an_effect_of_which_nothing_is_known_asks_at_its_field(page: Browser) -> None:
    page.click(field("effect ball_expansion"))
    asked = field("effects.ball_expansion.ball_temperature_C")
    page.soon(f"{asked}?.getAttribute('aria-invalid') === 'true' && {asked}.value === ''")
    write(page, asked, "40")
    ready(page)
    assert page.value(f"!{asked}.hasAttribute('aria-invalid')")


def test_on_a_phone_the_effects_are_folded_below_the_strip_of_results(page: Browser) -> None:
    page.ask("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=1, mobile=False)
    page.soon(f"{WHOLE} && !{field('switches')}.open")
    page.value("scrollTo(0, 0)")
    found = boxes(page, "results", "head", "way axial load", "switches", "requirements")
    tops = [box[1] for box in found.values()]
    assert tops == sorted(tops) and found["results"][1] == 0.0
    assert found["switches"][3] - found["switches"][1] < 60.0 and found["switches"][1] < 844.0
    page.click(f"{field('switches')}.querySelector('summary')")
    page.soon(f"{field('effect centrifugal_force')}.checkVisibility()")
    page.resize(1280)
    page.soon(f"{field('switches')}.open")


def test_all_of_it_open_fits_its_window_and_bars_nobody(page: Browser) -> None:
    """Every table open, two states pinned, requirements met and not."""
    page.soon(f"{field('add ring_expansion')} !== null")
    page.click(field("pin"))
    page.click(field("add ring_expansion"))
    page.soon(f"{field('effect ring_expansion')}.checked")
    page.value(
        "workbench.page.now.document.require = {max_pressure: {most: 2000}, inner_load_max: {most: 1, source: 'x'}}"
    )
    write(page, field("operation.speed_rpm"), "20000")
    page.soon(f"{REQUIRED}.length === 2")
    ready(page)
    page.click(field("pin"))
    page.value("for (const each of document.querySelectorAll('details')) each.open = true")
    page.soon(WHOLE)
    for width in WIDTHS:
        page.ask("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
        page.value("for (const each of document.querySelectorAll('details')) each.open = true")
        assert page.value("document.documentElement.scrollWidth") <= width
        assert page.value(OVERFLOWS) == [], width
        assert barriers(page) == [], width
    page.resize(1280)
