"""The guide's page on rotor dynamics: its program in ROSS, its record, and what its sentences rest on."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import qsbearing as qs
from tests.guide.pages import blocks, run_page, run_program, write_file
from tests.systems.rotor_dynamics import rotor_program, spindle

TOLERANCE = 1e-4
"""Of a critical speed: the record keeps 0.1 rpm, the search stops at 0.01 rad/s, and eigenvalues of a rotor of hundred
unknowns are good to 1e-8."""
INTERPOLATION = 5e-4
"""The same where the page's stiffness at every 1000 rpm is interpolated by another ROSS than the record's: 2.6e-4."""


@pytest.fixture(scope="module")
def page() -> dict[str, Any]:
    """What the page's program defines and prints."""
    ross = rotor_program.load()  # first, which skips without it
    return spindle.program() | {"ross": ross}


def test_the_page_runs(tmp_path: Path) -> None:
    rotor_program.load()
    run_page(spindle.PAGE, tmp_path, heavy=False)
    assert (tmp_path / "7210c.csv").exists()


def test_the_record_is_what_ross_gives(page: dict[str, Any]) -> None:
    record = spindle.read()
    found = spindle.critical_speeds(page, 240.0)
    tolerance = TOLERANCE if page["ross"].__version__ == record["ross"] else INTERPOLATION
    assert found == pytest.approx(record["critical_speed_rpm"]["240"], rel=tolerance)
    assert spindle.tilt_choices(page) == pytest.approx(record["tilt_rpm"], rel=TOLERANCE)
    at_rest, at_speed = (float(line.split()[-2]) for line in page["printed"].splitlines())
    assert (at_rest, at_speed) == pytest.approx((found["rest"], found["spring"]), abs=0.6)  # whole rpm


def test_critical_speeds_move_with_preload_and_speed() -> None:
    """What the page says of its picture."""
    table = spindle.read()["critical_speed_rpm"]
    for kind in spindle.KINDS:
        found = [row[kind] for row in table.values()]
        assert found == sorted(found)
    lost = {kind: [1.0 - row[kind] / row["rest"] for row in table.values()] for kind in ("spring", "rigid")}
    for values in lost.values():
        assert values == sorted(values, reverse=True)
        assert min(values) > 0.0
    assert all(springs > held for springs, held in zip(lost["spring"], lost["rigid"], strict=True))


def test_a_node_in_the_load_centre_loses_least_without_tilts() -> None:
    whole, centre, middle, free = spindle.read()["tilt_rpm"].values()
    assert abs(centre - whole) < 0.1 * abs(middle - whole) < 0.1 * abs(free - whole)


def test_the_page_on_a_spindle_prints_the_critical_speed_that_it_names(tmp_path: Path) -> None:
    """Its programs, which without ROSS end before that."""
    rotor_program.load()
    page = spindle.PAGE.with_name("spindle.md")
    names: dict[str, object] = {"__name__": "page"}
    for block in blocks(page):
        if block.language == "toml":
            write_file(block.text, tmp_path)
        elif block.language == "python":
            run_program(block.text, tmp_path, names)
    (said,) = re.findall(r"first critical speed is ([\d,]+) rpm", " ".join(page.read_text(encoding="utf-8").split()))
    found = float(names["critical"]) / qs.rpm  # type: ignore[arg-type]
    whirl: Any = names["whirl"]
    assert whirl(found * qs.rpm) / qs.rpm == pytest.approx(found, rel=1e-6)
    assert found == pytest.approx(float(said.replace(",", "")), rel=INTERPOLATION)
