"""The design report of a set: its numbers are the solution's, what was not asked for is absent."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import nullcontext
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.documents.model import Columns, RowGroup, Table
from qsbearing.model.operation import STRAIGHT
from qsbearing.model.solution.judgement import percent
from qsbearing.reports import set_curves, set_inputs, statements
from qsbearing.results.remarks import every_remark, together
from qsbearing.systems.heat.network import Conductance, Thermal
from tests.documents.browser import Browser, installed, layout_faults
from tests.documents.page import Page
from tests.drawing import drawing
from tests.reports.test_report import FRONT
from tests.systems.sets.arrangements import PAIR_FILE

PAIR = (
    PAIR_FILE.replace("[preload]", "radial_load_y_N = 500\nmoment_z_Nm = 0\n[preload]").replace(
        '["centrifugal_force"]', '["centrifugal_force", "gyroscopic_moment"]'
    )
    + "[readings.life]\n"
)
EACH = '[report]\nball_tables = "each"\n'
"""Asks for tables of every ball."""

TRIPLE = """
[[rows]]
position_mm = 0
carries = "+x"
offset_um = 2
  [rows.bearing]
  name = "7210C"
  [rows.ring_expansion]
  bore_diameter_mm = 50
  outside_diameter_mm = 90
[[rows]]
position_mm = 25
carries = "+x"
  [rows.bearing]
  name = "7210C"
  [rows.readings.life]
[[rows]]
position_mm = 120
carries = "-x"
sprung = true
  [rows.bearing]
  name = "7210C_hybrid"
[shaft]
reference_position_mm = 40
[operation]
speed_rpm = 12000
axial_load_N = 300
radial_load_y_N = 600
radial_load_z_N = 150
moment_y_Nm = 0
moment_z_Nm = 5
[preload]
spring_N = 450
[effects]
ball = ["centrifugal_force", "gyroscopic_moment"]
raceway_control = "outer"
"""
SETS = {"pair": PAIR + EACH, "triple": TRIPLE + EACH}


def as_float(cell: str) -> float:
    """Of a cell as people read it."""
    return float(cell.replace("−", "-"))


def call(*arguments: str) -> Result:
    return CliRunner().invoke(cli, ["report", *arguments], catch_exceptions=False)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    into = tmp_path_factory.mktemp("sets")
    for name, text in SETS.items():
        (into / f"{name}.toml").write_text(text)
        with drawing() if name == "pair" else nullcontext():
            result = call(str(into / f"{name}.toml"), "--out", str(into / "out"))
        assert result.exit_code == 0, result.output
    return into


@cache
def page_of(folder: Path, name: str) -> Page:
    return Page.of((folder / f"{name}_report.html").read_text(encoding="utf-8"))


def report_of(folder: Path, text: str) -> Page:
    (folder / "one.toml").write_text(text)
    assert call(str(folder / "one.toml"), "--out", str(folder)).exit_code == 0
    return page_of.__wrapped__(folder, "one")


def titles(page: Page) -> list[str]:
    return [text.removesuffix(" #") for _, text in page.headings]


def tables_with(page: Page, *headings: str) -> Iterator[list[list[str]]]:
    """The tables of these headings; without them, and one line each."""
    for table in page.tables:
        if set(headings) <= {" ".join(cell.split()) for cell in table[0]}:
            yield table[1:]


@pytest.mark.parametrize("name", SETS)
def test_both_forms_are_written_and_sound(folder: Path, name: str) -> None:
    names = sorted(path.name for path in (folder / "out").iterdir())
    assert names == [f"{each}_report.{form}" for each in sorted(SETS) for form in ("html", "pdf")]
    assert (folder / "out" / f"{name}_report.pdf").read_bytes().startswith(b"%PDF")
    assert page_of(folder / "out", name).faults == []


@pytest.mark.parametrize("name", SETS)
def test_the_numbers_are_those_of_the_solution(folder: Path, name: str) -> None:
    page, solution = page_of(folder / "out", name), qs.solve_set(qs.load_set(folder / f"{name}.toml"))
    (shaft,) = tables_with(page, "displacement", "load", "imposed")
    found = np.array([[as_float(line[1]), as_float(line[3])] for line in shaft])
    sizes = np.array([qs.um, qs.um, qs.um, qs.mrad, qs.mrad])
    np.testing.assert_allclose(found[:, 0], solution.displacement / sizes, rtol=1e-5, atol=1e-9)
    np.testing.assert_allclose(found[:, 1], solution.load, rtol=1e-5, atol=1e-6)
    (matrix,) = tables_with(page, "axial /µm", "tilt z /mrad")
    printed = np.array([[as_float(cell) for cell in line[2:]] for line in matrix])
    np.testing.assert_allclose(printed, solution.stiffness * sizes, rtol=1e-5, atol=1e-5)
    (stiffness,) = tables_with(page, "locked (other displacements held)", "effective (other loads held)")
    effective = [as_float(line[2]) * unit for line, unit in zip(stiffness, (1e6, 1e6, 1e6, 1e3, 1e3), strict=True)]
    np.testing.assert_allclose(effective, solution.effective_stiffness, rtol=1e-5)
    (preload,) = tables_with(page, "before fitting N", "mounted N", "with the loads N")
    forces = np.array([[as_float(cell) for cell in (*line[1:4], line[5])] for line in preload])
    known = solution.preload_unmounted, solution.preload_mounted, solution.preload_in_operation, solution.axial_loads
    np.testing.assert_allclose(forces, np.transpose(known), rtol=1e-5)
    assert [line[4] for line in preload] == [percent(share, digits=3) for share in solution.preload_share]
    assert [line[6] for line in preload] == list(solution.preload_state)
    contacts = list(tables_with(page, "angle i deg", "load o N", "p0 i MPa"))
    assert len(contacts) == len(solution.rows)
    for table, row in zip(contacts, solution.rows, strict=True):
        first = [as_float(cell) for cell in table[0][2:]]
        contact = [(row.inner.angle, qs.deg), (row.outer.angle, qs.deg), (row.inner.load, 1.0), (row.outer.load, 1.0)]
        contact += [(row.inner.max_pressure, qs.MPa), (row.outer.max_pressure, qs.MPa)]
        np.testing.assert_allclose(first, [values[0] / size for values, size in contact], rtol=1e-5)


@pytest.mark.parametrize("name", SETS)
def test_the_printed_loads_of_the_rows_are_the_load_on_the_shaft(folder: Path, name: str) -> None:
    page, of = page_of(folder / "out", name), qs.load_set(folder / f"{name}.toml")
    (rows,) = tables_with(page, "row", "carries", "axial N", "largest ball N")
    axial = sum(as_float(line[4]) * (1.0 if line[3] == "+x" else -1.0) for line in rows)
    assert axial == pytest.approx(of.operation.axial_load, abs=0.02)
    for column, load in ((5, of.operation.radial_load_y), (6, of.operation.radial_load_z)):
        assert sum(as_float(line[column]) for line in rows) == pytest.approx(load or 0.0, abs=0.01)


def test_the_input_names_every_row(folder: Path) -> None:
    (rows,) = tables_with(page_of(folder / "out", "triple"), "carries", "at x, mm")
    assert rows == [
        ["1", "7210C", "+x", "0", "", "2", "fixed"],
        ["2", "7210C", "+x", "25", "25", "0", "fixed"],
        ["3", "7210C_hybrid", "-x", "120", "95", "0", "slides, sprung"],
    ]
    (pair,) = tables_with(page_of(folder / "out", "pair"), "carries", "at x, mm")
    assert pair == [["1", "7210C", "+x", "0", ""], ["2", "7210C", "-x", "20", "20"]]  # no offset, no spring
    triple = page_of(folder / "out", "triple")
    lines = [line for table in tables_with(triple, "key of the file", "from") for line in table]
    for expected in (["reference_position_mm", "40", "mm", "as given"], ["spring_N", "450", "N", ""]):
        assert expected in lines
    assert "Row 1: Rings change their size" in triple.text and "Rows 2 and 3: Rings keep the size" in triple.text
    for title in ("Bearing of rows 1 and 2", "Bearing of row 3", "Effects of row 1 alone", "Readings of row 2 alone"):
        assert title in triple.text
    assert "Bearing of all rows" in page_of(folder / "out", "pair").text


def test_what_a_set_asks_for_is_there_and_nothing_else(folder: Path) -> None:
    pair, triple = page_of(folder / "out", "pair"), page_of(folder / "out", "triple")
    assert titles(pair) == [
        "pair, DB (back to back)", *FRONT, "Remarks", "Results", "Preload", "Load distribution", "Rows",
        "Row 1 (7210C, carries +x)", "Row 2 (7210C, carries -x)", "Around the operating point",
        "Assumptions and effects", "Input", "Evidence that applies", "Made with",
    ]  # fmt: skip
    solution = qs.solve_set(qs.load_set(folder / "pair.toml"))
    hours = (
        qs.system_life([qs.readings.life(row, dynamic_load_rating=47.5e3).duration for row in solution.rows]) / 3600.0
    )
    assert f"Life of all rows together: {hours:.5g} h" in pair.text
    # Each life stands twice, in revolutions and hours; those of both rows in one table, of one row alone in its own.
    assert pair.text.count("basic reference rating life") == 2
    (lives,) = (table for table in pair.tables if table[0] == ["quantity", "row 1", "row 2", "unit"])
    ((_, *own, _),) = (line for line in lives if line[0] == "basic reference rating life in hours")
    assert [float(each.replace(",", "")) for each in own] == [
        pytest.approx(qs.readings.life(row, dynamic_load_rating=47.5e3).duration / 3600.0, rel=1e-4)
        for row in solution.rows
    ]
    assert triple.text.count("basic reference rating life") == 2
    assert "Life of all rows together" not in triple.text
    assert "Stiffness (free: axial, radial y, radial z, tilt y, tilt z)" in pair.text
    assert triple.text.count("Geometry before loading") == 1  # ring expansion of one row
    assert "Geometry before loading" not in pair.text


def test_balls_of_rows_are_listed_only_where_they_are_asked_for(tmp_path: Path) -> None:
    """Thirty lines that nearly agree are one for each row, with the range over its balls."""
    page = report_of(tmp_path, PAIR)
    assert not list(tables_with(page, "angle i deg", "load o N"))
    (rows,) = tables_with(page, "largest pressure MPa", "contact angles deg")
    assert len(rows) == 2 and all(" to " in line[-2] for line in rows)
    (read,) = tables_with(page, "row 1", "row 2")
    assert [line[0] for line in read].count("basic reference rating life in hours") == 1, "what was read off is there"
    wrong = call(str(_written(tmp_path, PAIR + EACH.replace("each", "all"))), "--out", str(tmp_path))
    assert wrong.exit_code == 2 and "is none of the choices\n    One of folded, each" in wrong.stderr


def _written(folder: Path, text: str) -> Path:
    (folder / "wrong.toml").write_text(text)
    return folder / "wrong.toml"


def test_what_is_said_of_several_rows_opens_the_report_once(folder: Path) -> None:
    """With the rows that lack it, from solves of the whole set; nothing of it stands on the rows' own pages."""
    page = page_of(folder / "out", "triple")
    first, rest = page.text.split("Results #", 1)
    assert "Incomplete model: Rows 2 and 3: the expansion of the rings is not included; it would change" in first
    assert "Incomplete model: Rings and their seats are taken as rigid" in first
    assert "Incomplete model" not in rest


def test_rows_whose_warnings_differ_in_numbers_share_one_with_their_range() -> None:
    bearing = qs.load_scene("b218").bearing
    rows = tuple(qs.Row(bearing, at, way) for at, way in ((0.0, "+x"), (0.06, "-x"), (0.2, "-x")))
    turning = qs.Operation(speed=6000 * qs.rpm, axial_load=3000.0, **STRAIGHT)
    solution = qs.solve_set(qs.BearingSet(rows, turning, preload=qs.Preload(rigid=1.2e6)))
    found = [each.said() for each in together(every_remark(solution))]
    own = [re.findall(r"reaches (\d+) MPa", each) for row in solution.rows for each in qs.warnings(row)]
    numbers = sorted({value for each in own for value in each}, key=float)
    assert len(numbers) > 1
    (said,) = (each for each in found if "contact pressure" in each)
    assert said.startswith("Rows 1 to 3: ") and f"reaches {numbers[0]} to {numbers[-1]} MPa" in said
    assert [each.rank for each in found] == sorted(each.rank for each in found)
    light = qs.solve_set(replace(solution.set, preload=qs.Preload(rigid=2000.0)))
    (reduced,) = (each.text for each in together(every_remark(light)) if each.code == "preload_reduced")
    assert reduced.startswith("Rows 2 and 3: Preload reduced: the loads leave each only ")


def test_key_results_of_a_set_are_those_of_its_solution(folder: Path) -> None:
    solution = qs.solve_set(qs.load_set(folder / "pair.toml"))
    page = page_of(folder / "out", "pair")
    (rows,) = tables_with(page, "preload mounted N", "largest pressure MPa", "life h")
    x, y = (float(np.asarray(each)) / qs.um for each in solution.displacement[:2])
    facts = dict(page.facts)
    assert facts["displacement of the shaft"].startswith(f"axial {x:.3g} µm, radial y {y:.3g} µm")
    hours = (
        qs.system_life([qs.readings.life(row, dynamic_load_rating=47.5e3).duration for row in solution.rows]) / 3600.0
    )
    assert facts["basic life of the set"] == f"{float(f'{hours:.3g}'):,.0f} h"
    for number, (row, line) in enumerate(zip(solution.rows, rows, strict=True)):
        assert line[:3] == [
            f"Row {number + 1} (7210C, carries {'+-'[number]}x)",
            f"{solution.axial_loads[number]:.4g}",
            "720",
        ]
        pressures = [side.max_pressure[side.load > 0.0].max() / 1e6 for side in (row.inner, row.outer)]
        assert line[3] == f"{pressures[0]:.4g} / {pressures[1]:.4g}"
        life = qs.readings.life(row, dynamic_load_rating=47.5e3).duration / 3600.0
        assert as_float(line[-1]) == pytest.approx(life, rel=1e-3)


def test_where_a_row_loses_its_preload_is_said_and_drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A light preload under a heavy axial load; the mark stands where a solve says so."""
    drawn = []
    real = set_curves._figure

    def watched(*arguments: object) -> object:
        drawn.append(arguments)
        return real(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(set_curves, "_figure", watched)
    text = PAIR.replace("rigid_N = 720", "rigid_N = 200").replace("axial_load_N = 200", "axial_load_N = 900")
    page = report_of(tmp_path, text.replace("radial_load_y_N = 500\nmoment_z_Nm = 0\n", ""))
    assert "Row 2 (7210C, carries -x) has lost its preload already at rest, under these loads." in page.text
    (loads,) = (each for each in drawn if "load factor" in str(each[3]))
    ((factor, words),) = loads[4]  # type: ignore[misc]
    assert words == "row 2: preload lost"
    assert f"loses its preload at {factor:.3g} times the loads" in page.text
    of = qs.load_set(tmp_path / "one.toml")
    (found,) = qs.preload_loads(of)
    assert factor == found.factor
    assert np.max(loads[1]) > factor  # type: ignore[operator]


def test_sets_without_a_preload_speed_or_load(tmp_path: Path) -> None:
    rows = PAIR.partition("[operation]")[0]
    tandem = report_of(tmp_path, rows.replace('"-x"', '"+x"') + "[operation]\naxial_load_N = 800\n")
    assert "All rows carry in +x: no row presses another" in tandem.text
    assert not list(tables_with(tandem, "at rest N"))
    assert "No curve over the speed" in tandem.text
    held = report_of(tmp_path, rows + "[operation]\naxial_displacement_um = 3\n[preload]\naxial_displacement_um = 8\n")
    assert "No curve over the loads" in held.text
    assert "The rings are held at a fixed distance, pressed together by 8 µm" in held.text
    assert "Results over the preload" in held.text


def test_no_equilibrium_writes_nothing(tmp_path: Path) -> None:
    text = PAIR.replace("rigid_N", "spring_N").replace('"-x"', '"-x"\nsprung = true').replace("= 200", "= -900")
    (tmp_path / "lost.toml").write_text(text)
    result = call(str(tmp_path / "lost.toml"), "--out", str(tmp_path / "out"))
    assert result.exit_code == 1
    assert "is more than the spring's 720 N" in result.stderr
    assert not (tmp_path / "out").exists()


def test_bad_input_is_refused(tmp_path: Path) -> None:
    (tmp_path / "bad.toml").write_text(PAIR.replace('"-x"', '"-X"'))
    result = call(str(tmp_path / "bad.toml"), "--out", str(tmp_path / "out"))
    assert result.exit_code == 2
    assert "row 2.carries" in result.stderr
    assert not (tmp_path / "out").exists()


def test_the_input_has_points_the_matrix_of_a_housing_and_the_numbers_of_the_heat(folder: Path) -> None:
    """What a shaft's scene and [thermal] give is in the table of the input, under the keys of a file."""
    pair = qs.load_set(folder / "pair.toml")
    soft = qs.HousingStiffness(matrix=np.diag([1e9, 2e9, 3e9, 4e5, 5e5]))
    shaft = qs.Shaft((qs.ShaftSection(length=0.3, outer_diameter=0.05),), start=-0.09, points={"tool": -0.08})
    of = replace(pair, rows=(replace(pair.rows[0], housing_stiffness=soft), pair.rows[1]), shaft=shaft)
    between = (("inner_ring", "ambient"), ("inner_ring", "balls"), ("balls", "outer_ring"))
    heat = Thermal(
        tuple(Conductance(each, 2.5, row=2) for each in between),
        fixed={"ambient": 22.0 + qs.zero_celsius},
        ring_width=0.02,
        friction="skf",
    )
    (halves,) = (each for each in set_inputs.section(of, "", heat).blocks if isinstance(each, Columns))
    tables = [table for (table,) in halves.columns if isinstance(table, Table)]
    lines = {str(row[0]): tuple(row[1:3]) for table in tables for row in table.rows if not isinstance(row, RowGroup)}
    assert lines["tool_mm"] == ("-80", "mm")
    assert lines["matrix_SI, row 4"] == ("0, 0, 0, 400000, 0", "SI")
    assert lines["friction"] == ("skf", "")
    assert lines["ring_width_mm"] == ("20", "mm")
    assert lines["ambient_C"] == ("22", "°C")
    assert lines["W_per_K, inner_ring to ambient of row 2"] == ("2.5", "W/K")


@pytest.mark.skipif(installed() is None, reason="no Chromium is installed")
def test_a_browser_has_nothing_to_complain_of(folder: Path) -> None:
    with Browser() as browser:
        for name in SETS:
            assert layout_faults(browser, folder / "out" / f"{name}_report.html") == []


def test_a_panel_without_curves_says_why() -> None:
    """A preloaded pair without loads: nothing moves, and nothing holds it."""
    bearing = qs.load_scene("b218").bearing
    rows = (qs.Row(bearing, 0.0, "+x"), qs.Row(bearing, 0.06, "-x"))
    forces = np.array([500.0, 900.0])
    for load, is_empty in ((None, True), (300.0, False)):
        of = qs.BearingSet(rows, qs.Operation(speed=0.0, axial_load=load), preload=qs.Preload(rigid=forces))
        figure = set_curves._figure(qs.solve_set(of), forces, 700.0, "preload, N", [])
        panel = figure.axes[2]
        assert (not panel.axison) == is_empty
        assert [text.get_text() for text in panel.texts] == ([set_curves.NOTHING] if is_empty else [])


def test_the_pressures_of_rows_stand_as_a_range() -> None:
    (elastic,) = (each for each in statements.STATEMENTS if "yield below the surface" in each.says)
    facts: Any = [SimpleNamespace(pressure=value * qs.MPa) for value in (1108.0, 1042.0)]
    assert elastic.found(facts) == "Maximum pressure here: 1042 to 1108 MPa"
    assert elastic.found(facts[:1]) == "Maximum pressure here: 1108 MPa"


def test_rows_with_the_same_effects_and_readings_have_them_once() -> None:
    lines = [[("a", "1", "", "")], [("a", "2", "", "")], [("a", "1", "", "")]]
    assert set_inputs._alike("Effects", lines) == [
        ("Effects of rows 1 and 3", lines[0]),
        ("Effects of row 2 alone", lines[1]),
    ]


def test_a_page_has_room_for_the_loads_and_the_angles_of_four_rows() -> None:
    """A page of A4 is 10.3 inches high inside, a heading and captions need one; pictures are printed at 0.77."""
    bearing = qs.load_scene("b218").bearing
    rows = tuple(qs.Row(bearing, 0.06 * n, way) for n, way in enumerate(("+x", "-x", "+x", "-x")))
    solution = qs.solve_set(qs.BearingSet(rows, qs.Operation(speed=0.0), preload=qs.Preload(rigid=900.0)))
    pictures = (qs.pictures.load_distribution(solution), qs.pictures.contact_angles(solution))
    assert 0.77 * sum(each.get_figheight() for each in pictures) < 10.3 - 1.0
