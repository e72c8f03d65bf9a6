"""The drawing of a set and the map in a real browser, by mouse and by keys: what moves there is a number of the page,
and what is shown then is what `run` prints."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")
from qsbearing.app import answers
from qsbearing.app.inputs import ASIDE
from qsbearing.files.file_errors import SceneFileError
from tests.app.served import served
from tests.app.test_answers import ran
from tests.app.test_page import KEY, OF, SOLVED, UNDO, boxes, hold, opened, press
from tests.app.test_sets import SPINDLE
from tests.app.test_shaft_drawing import MORE
from tests.documents.browser import OVERFLOWS, WIDTHS, Browser, barriers, installed

pytestmark = pytest.mark.skipif(installed() is None, reason="no Chromium is installed")

ROW, PLACE = "drawn row 2.position_mm", "row 2.position_mm"
DIAMETER = "shaft.section 1.outer_diameter_mm"
LENGTH = "shaft.section 1.length_mm"
MAP, POINT = "document.getElementById('map')", "map-point"
SPEED, LOAD = "operation.speed_rpm", "operation.axial_load_N"
SAID = "document.getElementById('map-said').textContent"
SETTLED = f"!{UNDO}.disabled && JSON.stringify(workbench.page.now) === workbench.page.settled"
"""What was done can be undone: the server has answered."""
DRAWN = "document.getElementById('map-progress')?.hidden === true && document.getElementById('map-point') !== null"


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    file = tmp_path_factory.mktemp("set") / "spindle.toml"
    file.write_text(SPINDLE)
    with served(str(file)) as found:
        yield found


@pytest.fixture
def page(browser: Browser, address: str) -> Browser:
    browser.open(address)
    browser.soon(SOLVED)
    return browser


def number(page: Browser, key: str) -> float:
    return float(page.value(f"document.getElementById({key!r}).value"))


def drag(page: Browser, name: str, right: float, down: float, count: int = 1) -> None:
    """What has this id by its ring, knob or dot, in steps as a hand makes them."""
    x, y = page.middle(f"document.getElementById({name!r}).querySelector('.ring, .knob, .dot')")
    for part in range(5):
        kind, at = ("mousePressed", 0.0) if part == 0 else ("mouseMoved", part / 4.0)
        where = {"x": x + at * right, "y": y + at * down}
        page.ask("Input.dispatchMouseEvent", type=kind, button="left", buttons=1, clickCount=count, **where)
    where = {"x": x + right, "y": y + down}
    page.ask("Input.dispatchMouseEvent", type="mouseReleased", button="left", clickCount=count, **where)


def scale(rows: dict[str, Any]) -> float:
    """Millimetres of a pixel, by the boxes of both rows, which are 20 mm apart."""
    return 20.0 / (rows[ROW][0] - rows["drawn row 1.position_mm"][0])


def focus(page: Browser, name: str) -> None:
    page.value(f"document.getElementById({name!r}).focus()")


def run_with(tmp_path: Path, change: Any) -> dict[str, Any]:
    tables = {"document": answers.opened(SPINDLE, "spindle")["document"], "label": "spindle"}
    change(tables["document"])
    return ran(tables, tmp_path)["shaft"]["points"]["tool"]["effective_stiffness"]


def shows(found: dict[str, Any]) -> str:
    """Whether the page has this stiffness of the tool."""
    numbers = " / ".join(f"{found[f'{name}_N_per_um']:.4g}" for name in ("axial", "radial_y", "radial_z"))
    return f"{SOLVED} && {KEY}.includes('tool: stiffness\\n{numbers}')"


def test_a_row_is_dragged_along_the_shaft(page: Browser, tmp_path: Path) -> None:
    before, first = page.value(KEY), boxes(page, ROW, "drawn row 1.position_mm")
    drag(page, ROW, 60.0, 4.0)
    page.soon(f"{SOLVED} && {KEY} !== {before!r} && {SETTLED}")
    place = number(page, PLACE)
    after = boxes(page, ROW, "drawn row 1.position_mm")
    distances = [found[ROW][0] - found["drawn row 1.position_mm"][0] for found in (first, after)]
    assert place == pytest.approx(20.0 + 60.0 * scale(first), abs=0.6), "the row is where the pointer is"
    assert distances[1] / distances[0] == pytest.approx(place / 20.0, rel=0.02), "drawn to scale"
    assert page.value(f"document.getElementById({ROW!r}).getAttribute('aria-valuetext')") == f"{place:g} mm"

    def moved(tables: dict[str, Any]) -> None:
        tables["rows"][1]["position_mm"] = place

    page.soon(shows(run_with(tmp_path, moved)))
    page.click(UNDO)
    page.soon(f"{KEY} === {before!r}")
    assert number(page, PLACE) == 20.0
    assert page.complaints == []


def test_keys_move_a_row_and_open_its_number(page: Browser) -> None:
    before = page.value(KEY)
    focus(page, ROW)
    said = "document.getElementById('drawn-now').textContent"
    assert page.value(said) == "row 2, position: 20 mm"
    press(page, "ArrowRight", 39)
    page.soon(f"{SOLVED} && {KEY} !== {before!r} && !{UNDO}.disabled")
    step = number(page, PLACE) - 20.0
    assert 0.0 < step <= 1.0 and page.value(said).startswith(f"row 2, position: {20.0 + step:g} mm")
    assert page.value("document.activeElement.id") == ROW, "though the fields are new ones"
    press(page, "PageDown", 34)
    page.soon(f"document.getElementById({PLACE!r}).value === '{20.0 - 9.0 * step:g}'")
    slider = f"document.getElementById('{PLACE} slider')"
    page.soon(f"Number({slider}.min) === {20.0 - 9.0 * step - ASIDE:g}")  # the fields are new ones around it
    press(page, "Enter", 13)
    assert page.value("document.activeElement.id") == PLACE
    assert page.value("document.activeElement.closest('details').open")
    for kind in ("rawKeyDown", "keyUp"):
        page.ask("Input.dispatchKeyEvent", type=kind, key="z", code="KeyZ", windowsVirtualKeyCode=90, modifiers=2)
    page.soon(f"document.getElementById({PLACE!r}).value === '{20.0 + step:g}'")


def test_a_double_click_opens_the_number(page: Browser) -> None:
    for count in (1, 2):
        drag(page, ROW, 0.0, 0.0, count)
    assert page.value("document.activeElement.id") == PLACE and number(page, PLACE) == 20.0


def test_a_diameter_is_dragged_by_its_edge(page: Browser, tmp_path: Path) -> None:
    before, pixel = page.value(KEY), scale(boxes(page, ROW, "drawn row 1.position_mm"))
    drag(page, f"drawn {DIAMETER}", 3.0, -12.0)
    page.soon(f"{SOLVED} && {KEY} !== {before!r}")
    outer = number(page, DIAMETER)
    assert outer == pytest.approx(50.0 + 2.0 * 12.0 * pixel, abs=1.1), "the edge is where the pointer is"

    def wider(tables: dict[str, Any]) -> None:
        tables["shaft"]["sections"][0]["outer_diameter_mm"] = outer

    page.soon(shows(run_with(tmp_path, wider)))
    focus(page, f"drawn {DIAMETER}")
    press(page, "ArrowDown", 40)
    page.soon(f"Number(document.getElementById({DIAMETER!r}).value) < {outer}")
    page.soon(SOLVED)
    assert page.complaints == []


def test_what_is_wrong_is_told_in_the_words_of_a_number_that_is_typed(page: Browser) -> None:
    """A shaft that ends before its load does not bear it."""
    focus(page, f"drawn {LENGTH}")
    wrong = f"document.getElementById({LENGTH!r})"
    while number(page, LENGTH) > 0.0:
        before = number(page, LENGTH)
        press(page, "PageDown", 34)
        assert number(page, LENGTH) < before
    page.soon(f"{OF}.startsWith('Not solved.') && {wrong}.getAttribute('aria-invalid') === 'true'")
    tables = answers.opened(SPINDLE, "spindle")["document"]
    tables["shaft"]["sections"][0]["length_mm"] = number(page, LENGTH)
    with pytest.raises(SceneFileError) as caught:
        answers.solved(tables, "spindle")
    (said,) = (str(each) for each in caught.value.errors if each.key == LENGTH)
    page.soon(f"document.getElementById({wrong}.getAttribute('aria-describedby'))?.textContent.trim() === {said!r}")
    assert " ".join(said.split()) in page.value("document.getElementById('drawn-now').innerText.replace(/\\s+/g, ' ')")
    assert page.value(f"document.getElementById('drawn {LENGTH}').classList.contains('wrong')")
    page.click(UNDO)
    page.soon(f"!{wrong}.hasAttribute('aria-invalid')")
    assert page.complaints == []


def test_a_row_is_turned_round(page: Browser, tmp_path: Path) -> None:
    before = page.value(KEY)
    for row in (1, 2):
        focus(page, f"turns row {row}.carries")
        press(page, "Enter", 13)
        word = "-x" if row == 1 else "+x"
        page.soon(f"document.getElementById('row {row}.carries').value === '{word}'")
        if row == 1:  # no row is left that carries +x, against which the preload would press
            page.soon(f"{OF}.startsWith('Not solved.')")
            assert "has no row to press against" in page.value("document.getElementById('drawn-now').textContent")
    page.soon(f"{SOLVED} && {KEY} !== {before!r}")

    def turned(tables: dict[str, Any]) -> None:
        for row, carries in zip(tables["rows"], ("-x", "+x"), strict=True):
            row["carries"] = carries

    page.soon(shows(run_with(tmp_path, turned)))


def test_loads_and_what_stands_on_the_shaft_are_at_their_places(page: Browser) -> None:
    opened(page, SPINDLE.replace("[shaft.points]", f"{MORE}\n[shaft.points]"))
    texts = page.value("[...document.querySelectorAll('#drawing text')].map(each => each.textContent)")
    assert {"load 1: radial y 500 N", "gear 1: torque 20 N m", "mass 1: mass 2 kg", "tool"} <= set(texts)
    rim, rows = "drawn shaft.gear 1.pitch_diameter_mm", [f"drawn row {row}.position_mm" for row in (1, 2)]
    first, second, gear = (0.5 * (left + right) for left, _, right, _ in boxes(page, *rows, rim).values())
    assert gear == pytest.approx(first + 30.0 / 20.0 * (second - first), abs=2.0)
    before = number(page, "shaft.gear 1.pitch_diameter_mm")
    drag(page, rim, 0.0, -10.0)
    page.soon(f"Number(document.getElementById('shaft.gear 1.pitch_diameter_mm').value) > {before}")
    assert page.complaints == []


def shown_map(page: Browser) -> None:
    page.value(f"{MAP}.open = true")
    page.soon(DRAWN)


def test_the_point_of_the_map_is_dragged(page: Browser, tmp_path: Path) -> None:
    before, speed, load = page.value(KEY), number(page, SPEED), number(page, LOAD)
    shown_map(page)
    drag(page, POINT, 70.0, -40.0)
    page.soon(f"{SOLVED} && {KEY} !== {before!r} && {SETTLED}")
    now = {"speed_rpm": number(page, SPEED), "axial_load_N": number(page, LOAD)}
    assert now["speed_rpm"] > speed and now["axial_load_N"] > load
    found = run_with(tmp_path, lambda tables: tables["operation"].update(now))
    page.soon(shows(found))
    told = page.value(f"document.getElementById({POINT!r}).getAttribute('aria-valuetext')")
    words, _, about = told.partition(": tool effective stiffness radial y ≈ ")
    assert words == f"speed {now['speed_rpm']:,.6g} rpm, axial load {now['axial_load_N']:,.6g} N"
    assert float(about.removesuffix(" N/µm")) == pytest.approx(found["radial_y_N_per_um"], rel=0.02)
    page.click(UNDO)
    page.soon(f"{KEY} === {before!r}")
    assert (number(page, SPEED), number(page, LOAD)) == (speed, load)
    assert page.complaints == []


def test_keys_move_the_point_and_the_map_stays(page: Browser) -> None:
    shown_map(page)
    speed, load = number(page, SPEED), number(page, LOAD)
    picture = "document.querySelector('#map-plot canvas').toDataURL()"
    first = page.value(picture)
    focus(page, POINT)
    for name, code, key, before in (("ArrowLeft", 37, SPEED, speed), ("ArrowUp", 38, LOAD, load)):
        press(page, name, code)
        page.soon(f"Number(document.getElementById({key!r}).value) !== {before}")
    assert number(page, SPEED) < speed and number(page, LOAD) > load
    page.soon(SOLVED)
    assert page.value("document.activeElement.id") == POINT and page.value(picture) == first
    assert not page.value("document.querySelector('#map-plot .stale')")


def test_a_map_of_other_inputs_is_grey_until_it_is_drawn_anew(page: Browser) -> None:
    shown_map(page)
    page.value("document.getElementById('map-points').value = 5")  # soon done, else it waits to be asked for
    page.click("document.getElementById('map-draw')")
    page.soon(f"{DRAWN} && {SAID} === '25 points.'")
    first = page.value("document.querySelector('#map-plot canvas').toDataURL()")
    hold(page, "map_values")
    focus(page, ROW)
    press(page, "PageUp", 33)
    page.soon("document.querySelector('#map-plot .stale') !== null")
    page.soon("window.go !== undefined")
    page.value("window.back()")
    page.soon(f"{DRAWN} && document.querySelector('#map-plot .stale') === null")
    assert page.value("document.querySelector('#map-plot canvas').toDataURL()") != first


def test_a_map_shows_how_far_it_is_and_is_stopped(page: Browser) -> None:
    shown_map(page)
    hold(page, "map_values")
    page.click("document.getElementById('map-draw')")
    page.soon("window.go !== undefined")
    assert page.value("!document.getElementById('map-progress').hidden") and page.value(SAID) == "0 of 441 points"
    page.value("(() => { const go = window.go; window.go = undefined; go(); })()")
    page.soon(f"window.go !== undefined && {SAID} === '3 of 441 points'")
    assert page.value("document.getElementById('map-progress').value") == 3
    page.click("document.getElementById('map-stop')")
    page.value("window.back()")
    page.soon(f"{SAID}.startsWith('Stopped after 3 of 441 points.')")
    assert page.value("document.getElementById('map-progress').hidden && document.getElementById('map-stop').hidden")


def test_inputs_and_result_of_the_map_are_chosen(page: Browser) -> None:
    """An axis begins at the ends of the input's slider; equal ones are no map."""
    shown_map(page)

    def choose(name: str, value: str) -> None:
        page.value(
            f"(e => {{ e.value = {value!r}; e.dispatchEvent(new Event('change')); }})"
            f"(document.getElementById('map-{name}'))"
        )

    choose("y", SPEED)
    page.click("document.getElementById('map-draw')")
    page.soon(f"{SAID} === 'Choose two different inputs.'")
    choose("y", PLACE)
    assert page.value("document.getElementById('map-y-low').value") == "-30"
    choose("result", "row_1_axial_load")
    page.value("document.getElementById('map-points').value = 5")
    page.click("document.getElementById('map-draw')")
    page.soon(f"{DRAWN} && {SAID}.startsWith('25 points.')")
    assert "row 1 axial load" in page.value(f"document.getElementById({POINT!r}).getAttribute('aria-valuetext')")
    titles = page.value("[...document.querySelectorAll('#map-plot .title')].map(each => each.textContent)")
    assert titles == ["speed, rpm", "row 2, position, mm"]
    drag(page, POINT, 0.0, -20.0)
    page.soon(f"Number(document.getElementById({PLACE!r}).value) > 20")


def test_drawing_and_map_fit_and_bar_nobody(page: Browser) -> None:
    shown_map(page)
    for width in WIDTHS:
        page.resize(width)
        page.soon(DRAWN)
        assert page.value("document.documentElement.scrollWidth") <= width
        assert page.value(OVERFLOWS) == [], width
    assert barriers(page) == []
