"""The design report: its numbers are the solution's, both forms sound, errors and outcomes as of any command."""

from __future__ import annotations

import importlib.util
import re
from functools import cache
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.cli.report import _refuse_another
from qsbearing.documents.installation import pip_install
from qsbearing.readings.asked import take_asked
from qsbearing.studies.chooser.explain import explain
from tests.documents.browser import Browser, barriers, installed, layout_faults
from tests.documents.page import Page
from tests.drawing import drawing

SCENE = """
[bearing]
name = "7210C"
ball_count = 14

[operation]
speed_rpm = 12000
radial_load_y_N = 900
tilt_z_mrad = 0
tilt_y_mrad = 0

[preload]
rigid_N = 800

[effects]
ball = ["centrifugal_force", "gyroscopic_moment"]
raceway_control = "outer"

[readings]
frequencies = true

[readings.life]
reliability = 0.95

[readings.lubricant]
iso_viscosity_grade = 32
oil_temperature_C = 45

[readings.film]
ball_roughness_um = 0.02
raceway_roughness_um = 0.1
"""


def call(*arguments: str) -> Result:
    return CliRunner().invoke(cli, ["report", *arguments])


@pytest.fixture(scope="module")
def spindle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("report")
    (folder / "Spindle.toml").write_text(SCENE)
    with drawing():
        result = call(str(folder / "Spindle.toml"), "--out", str(folder / "out"))
    assert result.exit_code == 0, result.output
    return folder


@pytest.fixture(scope="module")
def b218(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The report of a bearing by its name."""
    folder = tmp_path_factory.mktemp("b218")
    assert call("b218", "--out", str(folder)).exit_code == 0
    return folder


def test_pictures_by_azimuth_only_where_balls_differ(spindle: Path, b218: Path) -> None:
    """A section in any report; of a bearing under thrust alone no circles and level lines."""
    heads = "Contact angles by azimuth", "Contact ellipses"
    for path, shown in ((spindle / "out", (1, 1)), (b218, (0, 0))):
        (page,) = path.glob("*.html")
        text = page.read_text(encoding="utf-8")
        assert tuple(len(re.findall(f"<figcaption[^>]*>{head}", text)) for head in heads) == shown
        assert len(re.findall('aria-label="Section through the ball that carries most', text)) == 1, "of page 1"


@cache
def page_of(folder: Path, name: str) -> Page:
    """Of one report a folder and name."""
    return Page.of((folder / f"{name}_report.html").read_text(encoding="utf-8"))


def input_of(folder: Path, name: str) -> dict[str, list[str]]:
    """The rows of the Input tables by their keys: value, unit, source; a source that stands below is put back."""
    page = page_of(folder, name)
    notes = dict(page.notes)
    return {
        row[0]: [notes.get(each, each) for each in row[1:]]
        for table in page.tables
        if table[0][0] == "key of a scene file"
        for row in table
    }


def test_both_forms_are_written_and_sound(spindle: Path) -> None:
    assert sorted(path.name for path in (spindle / "out").iterdir()) == ["spindle_report.html", "spindle_report.pdf"]
    assert (spindle / "out" / "spindle_report.pdf").read_bytes().startswith(b"%PDF")
    assert page_of(spindle / "out", "spindle").faults == []


def test_the_numbers_are_those_of_the_solution(spindle: Path) -> None:
    tables = page_of(spindle / "out", "spindle").tables
    solution = qs.solve(qs.load_scene(spindle / "Spindle.toml"))
    ring = next(table for table in tables if table[0][1:2] == ["displacement"])
    assert float(ring[1][3]) == pytest.approx(solution.load[0], rel=1e-5)
    assert float(ring[2][1]) == pytest.approx(solution.displacement[1] / qs.um, rel=1e-5)
    contacts = next(table for table in tables if table[0][2:3] == ["angle i\ndeg"])
    assert float(contacts[1][4]) == pytest.approx(solution.inner.load[0], rel=1e-5)
    assert float(contacts[1][2]) == pytest.approx(solution.inner.angle[0] / qs.deg, rel=1e-5)


def test_the_input_says_where_its_numbers_are_from(spindle: Path) -> None:
    """A number of the scene's own does not get the catalogue's source; units are those of the file."""
    rows = input_of(spindle / "out", "spindle")
    assert rows["ball_count"] == ["14", "balls", "scene"]
    assert rows["ball_diameter_mm"][0] == "12.7"
    assert "S 6210 C" in rows["ball_diameter_mm"][2]
    assert rows["diametral_clearance_mm"][2] == "computed from the free contact angle"
    assert rows["rigid_N"][:2] == ["800", "N"]
    assert rows["lubricant.oil_temperature_C"][:2] == ["45", "°C"]


def test_a_material_of_the_scene_is_not_the_catalogue_s(tmp_path: Path) -> None:
    table = "[bearing.ball_material]\nelastic_modulus_GPa = 315\npoisson_ratio = 0.26\ndensity_kg_m3 = 3200\n"
    text = f'[bearing]\nname = "B218"\n{table}[operation]\naxial_load_N = 1000\n'
    (tmp_path / "hybrid.toml").write_text(text)
    assert call(str(tmp_path / "hybrid.toml"), "--out", str(tmp_path)).exit_code == 0
    rows = input_of(tmp_path, "hybrid")
    assert rows["ball_material.elastic_modulus_GPa"] == ["315", "GPa", "scene"]
    assert rows["ring_material.elastic_modulus_GPa"][2] != "scene"
    assert "No curve over the speed" in page_of(tmp_path, "hybrid").text


def test_each_number_of_a_material_has_its_own_source(b218: Path, tmp_path: Path) -> None:
    """The source of the bearing gives no thermal expansion; a maker's density is no source of elastic constants."""
    rows = input_of(b218, "b218")
    assert "Wang" in rows["ball_material.density_kg_m3"][2]
    assert "assumed" in rows["ball_material.thermal_expansion_per_K"][2]
    assert "Wang" not in rows["ball_material.thermal_expansion_per_K"][2]
    text = '[bearing]\nname = "7210C"\nball_material = "silicon nitride"\n[operation]\naxial_load_N = 500\n'
    (tmp_path / "maker.toml").write_text(text)
    assert call(str(tmp_path / "maker.toml"), "--out", str(tmp_path)).exit_code == 0
    rows = input_of(tmp_path, "maker")
    assert "7.8 g/cm3" in rows["ring_material.density_kg_m3"][2]
    assert rows["ring_material.elastic_modulus_GPa"][2].startswith("assumed")
    assert rows["ball_material.density_kg_m3"][2] == "this program's silicon nitride"
    assert "Rings and their seats are taken as rigid" in page_of(tmp_path, "maker").text.split("Results #")[0]


UNEQUAL = """
[bearing]
name = "B218"

[operation]
speed_rpm = 18000
axial_load_N = 17800
radial_load_y_N = 15000
tilt_y_mrad = 0
tilt_z_mrad = 0

[effects]
ball = ["centrifugal_force", "gyroscopic_moment"]
raceway_control = "per_ball"
ball_diameter_deviations_um = [5, 0, 0, 0, 0, 0, 0, -0.5, 0, 0, 0, 0, 0, 0, 0, 0]

[effects.ring_expansion]
bore_diameter_mm = 90
outside_diameter_mm = 160
shaft_interference_um = 10
shaft_material = "steel"

[report]
title = "Feed screw, fixed end"
customer = "Works & Co"
document = "R-17"
"""
"""Far from all that B218 was checked at, with every kind of ring effect but heat."""


@pytest.fixture(scope="module")
def unequal(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("unequal")
    (folder / "unequal.toml").write_text(UNEQUAL)
    result = call(str(folder / "unequal.toml"), "--out", str(folder))
    assert result.exit_code == 0, result.output
    return folder


def test_lists_and_materials_of_effects_are_input_too(unequal: Path) -> None:
    rows = input_of(unequal, "unequal")
    value, unit, numbers = rows["ball_diameter_deviations_um"]
    assert (value, unit) == ("-0.5 ... 5", "µm")
    assert [float(each.replace("−", "-")) for each in numbers.split(",")] == [5.0, *6 * [0.0], -0.5, *8 * [0.0]]
    assert rows["ring_expansion.shaft_interference_um"][:2] == ["10", "µm"]
    assert rows["ring_expansion.shaft_material.elastic_modulus_GPa"] == ["208", "GPa", "this program's steel"]


def test_assumptions_are_those_of_the_scene(unequal: Path, spindle: Path) -> None:
    text, plain = page_of(unequal, "unequal").text, page_of(spindle / "out", "spindle").text
    assert "balls alike" not in text
    assert "balls of the diameters in the input" in text
    assert "Rings change their size" in text
    assert "by Jones's criterion" in text
    assert "all balls alike" in plain
    assert "Rings keep the size" in plain
    assert "on the outer raceway (outer control" in plain


def test_estimates_are_told_from_what_was_solved(unequal: Path, spindle: Path) -> None:
    """Expansion of the rings is solved with usual parameters where a scene has none: such numbers are marked alone."""
    effects = next(
        t for t in page_of(spindle / "out", "spindle").tables if t[0][:2] == ["effect or choice", "in scene"]
    )
    marked = {row[0] for row in effects if any("≈" in cell for cell in row)}
    assert "the expansion of the rings" in marked
    _, rows = explain(qs.load_scene(spindle / "Spindle.toml"), 0.01)
    assert marked == {
        row.what for row in rows if row.actual is None and any(each["actual"]["load"] for each in row.assumed)
    }
    solved = next(t for t in page_of(unequal, "unequal").tables if t[0][:2] == ["effect or choice", "in scene"])
    assert not any("≈" in cell for row in solved if row[0] == "the expansion of the rings" for cell in row)


def value_of(folder: Path, name: str) -> dict[str, str]:
    """The numbers of page 1."""
    return dict(page_of(folder, name).facts)


DIGITS = 5e-3
"""Half of the last of three digits, at most."""


def test_key_results_are_those_of_the_solution(unequal: Path, spindle: Path, tmp_path: Path) -> None:
    found, solution = value_of(unequal, "unequal"), qs.solve(qs.load_scene(unequal / "unequal.toml"))

    def numbers(key: str) -> list[float]:
        return [
            float(each.replace(",", ""))
            for each in re.findall(r"-?\d[\d,]*\.?\d*(?:e-?\d+)?(?= |$|,)", found[key].replace("−", "-"))
        ]

    sides = (solution.inner, solution.outer)
    pressures = [side.max_pressure.max() / qs.MPa for side in sides]
    assert numbers("maximum contact pressure") == pytest.approx(pressures, rel=DIGITS)
    assert numbers("maximum contact load") == pytest.approx([side.load.max() for side in sides], rel=DIGITS)
    angles = [end / qs.deg for side in sides for end in (side.angle.min(), side.angle.max())]
    assert numbers("contact angles") == pytest.approx(angles, abs=0.051)
    moved = solution.displacement[:3] / qs.um
    assert numbers("displacement of the inner ring") == pytest.approx(moved, rel=DIGITS)
    assert "tilt" not in found["displacement of the inner ring"], "tilts are given"
    stiffness = solution.effective_stiffness[:3] * qs.um
    free = "free: axial, radial y, radial z; displacement given: tilt y, tilt z"
    assert numbers("effective stiffness") == pytest.approx(stiffness, rel=DIGITS)
    assert f"Stiffness ({free})" in page_of(unequal, "unequal").text
    assert numbers("required friction coefficient")[1] == pytest.approx(
        solution.outer.required_friction.max(), rel=0.05
    )
    assert numbers("load where a displacement is given") == pytest.approx(solution.load[3:], rel=DIGITS)
    assert "life" not in " ".join(found)

    found = value_of(spindle / "out", "spindle")
    life = take_asked(qs.solve(qs.load_scene(spindle / "Spindle.toml")))["life"]
    assert numbers("basic reference rating life")[0] == pytest.approx(
        life.basic_reference_rating_life / 1e6, rel=DIGITS
    )
    assert numbers("preload")[0] == pytest.approx(800.0)
    # Basic first; then with a1, which is all that the scene asks for.
    assert numbers("basic reference rating life")[1] == pytest.approx(life.basic_duration / 3600.0, rel=DIGITS)
    names = [name for name in found if "reference rating life" in name]
    assert names == ["basic reference rating life", "modified reference rating life"]
    modified = numbers("modified reference rating life")
    assert modified[:2] == pytest.approx([life.reference_rating_life / 1e6, life.duration / 3600.0], rel=DIGITS)
    assert found[names[1]].endswith("h: a1 0.64")


def test_the_cap_of_a_modified_life_is_said_beside_the_basic_one(tmp_path: Path) -> None:
    """On page 1 and in what `run` prints: basic life before modified life, aISO, and that it is at its limit."""
    text = '[bearing]\nname = "B218"\n[operation]\nspeed_rpm = 9000\naxial_load_N = 3000\n[readings.life]\n'
    (tmp_path / "light.toml").write_text(f"{text}viscosity_ratio = 3\ncontamination_factor = 0.9\n")
    assert call(str(tmp_path / "light.toml"), "--out", str(tmp_path)).exit_code == 0
    found = value_of(tmp_path, "light")
    assert " million revolutions, " in found["basic reference rating life"]
    assert found["modified reference rating life"].endswith(" h: aISO 50, at its limit")
    shown = CliRunner().invoke(cli, ["run", str(tmp_path / "light.toml")]).output
    answer, _, shown = shown.partition("Inner ring\n")
    assert 0 < answer.index("basic reference rating life") < answer.index("modified reference rating life")
    order = ["basic reference rating life", "factor aISO", "modified reference rating life", "aISO is at the upper"]
    places = [shown.index(words) for words in order]
    assert places == sorted(places)


def test_a_report_says_for_whom_it_is(unequal: Path, tmp_path: Path) -> None:
    page = page_of(unequal, "unequal")
    assert page.headings[0][1] == "Feed screw, fixed end"
    assert "B218: angular contact, 16 balls of 22.225 mm" in page.text
    assert "Never in the model: vibration, cage forces" in page.text
    assert re.search(r"Customer\s*Works & Co\s*Document\s*R-17", page.text)
    assert "Author" not in page.text
    (tmp_path / "wrong.toml").write_text(PLAIN + '[report]\ncustomer = 17\ntitel = "a"\n')
    refused = call(str(tmp_path / "wrong.toml"), "--out", str(tmp_path / "out"))
    assert refused.exit_code == 2
    assert "report.customer" in refused.stderr and "report.titel: unknown key" in refused.stderr


def test_warnings_stand_in_full_before_the_contents_end(spindle: Path) -> None:
    first = page_of(spindle / "out", "spindle").text.split("Results #")[0]
    assert (
        "Check your data: The pressure-viscosity coefficient is an estimate for mineral oil, good to some 30 %" in first
    )


FRONT = ["How it stands under load", "What the model leaves out", "In numbers", "Over the speed"]
"""Of page 1 of a bearing that turns."""


def test_what_a_scene_asks_for_is_there_and_nothing_else(spindle: Path, b218: Path) -> None:
    asked = page_of(spindle / "out", "spindle")
    titles = [text.removesuffix(" #") for _, text in asked.headings]
    assert titles == [
        "7210C, modified", *FRONT, "Remarks", "Results", "Pictures", "Readings", "Around the operating point",
        "Assumptions and effects", "Input", "Evidence that applies", "Made with",
    ]  # fmt: skip
    assert "basic reference rating life" in asked.text
    assert "Ball-pass frequencies" in asked.text
    assert "iso_viscosity_grade = 32" in asked.text
    plain = page_of(b218, "b218")
    assert "Readings" not in [text.removesuffix(" #") for _, text in plain.headings]
    assert "Ball-pass frequencies" not in plain.text


def test_effects_chosen_by_tolerance_are_said(tmp_path: Path) -> None:
    asked = 'effects = "auto"\ntolerance = 0.02\n'
    text = f'{asked}[bearing]\nname = "B218"\n[operation]\nspeed_rpm = 500\naxial_load_N = 9000\n'
    (tmp_path / "slow.toml").write_text(text)
    assert call(str(tmp_path / "slow.toml"), "--out", str(tmp_path)).exit_code == 0
    assert re.search(
        r"Tolerance 0\.02: left out, with the expected error: .*centrifugal", page_of(tmp_path, "slow").text
    )


def test_no_equilibrium_writes_nothing(tmp_path: Path) -> None:
    (tmp_path / "pulled.toml").write_text('[bearing]\nname = "B218"\n[operation]\naxial_load_N = -1000\n')
    result = call(str(tmp_path / "pulled.toml"), "--out", str(tmp_path / "out"))
    assert result.exit_code == 1
    assert "No equilibrium" in result.stderr
    assert not (tmp_path / "out").exists()


def test_bad_input_and_a_missing_extra_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert call("no_such_bearing", "--out", str(tmp_path / "a")).exit_code == 2
    (tmp_path / "file").write_text("")
    assert "cannot be a folder" in call("b218", "--out", str(tmp_path / "file")).stderr
    real = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "typst" else real(name))
    result = call("b218", "--out", str(tmp_path / "b"))
    assert result.exit_code == 2
    assert f"report needs typst: {pip_install('report')}" in " ".join(result.stderr.split())
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file"]


PLAIN = '[bearing]\nname = "B218"\n[operation]\naxial_load_N = 1000\n'


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("latin.toml", PLAIN.encode() + b"# \xe9", "is not UTF-8 text"),
        ("a" * 300, None, "neither a file nor a bearing"),
        ("long.toml", b"#" * 1_000_001, "longer than 1 MB"),
    ],
)
def test_its_file_is_read_as_that_of_any_command(name: str, content: bytes | None, said: str, tmp_path: Path) -> None:
    if content is not None:
        (tmp_path / name).write_bytes(content)
    result = call(name if content is None else str(tmp_path / name), "--out", str(tmp_path / "out"))
    assert result.exit_code == 2
    assert said in result.stderr
    assert not (tmp_path / "out").exists()


def test_no_name_or_comment_steers_a_terminal_or_hides_text(tmp_path: Path) -> None:
    """Also: a byte order mark, a file of many lines, one of long ones, and a ring that nothing loads."""
    scene = tmp_path / "a\x1b[31m\u202eb.toml"
    lines = PLAIN.replace("1000", "0") + "# \u202ex" + "x" * 5_000 + "\n" + "# a\n" * 5_000
    scene.write_bytes(b"\xef\xbb\xbf" + lines.encode())
    result = call(str(scene), "--out", str(tmp_path / "out"))
    assert (result.exit_code, result.stderr) == (0, "")
    page = (tmp_path / "out" / "a\x1b[31m\u202eb_report.html").read_text(encoding="utf-8")
    for text in (result.stdout, page):
        assert not set("\x1b\u202e\ufeff") & set(text)
        assert "\\x1b[31m\\u202eb" in text
    assert "The first 400 of 5,005 lines of the file" in page
    assert page.count("# a\n") < 400
    assert "x" * 201 not in page


def test_the_report_of_another_file_is_not_replaced(tmp_path: Path) -> None:
    """My.toml and my.toml would be one report; of the same file it is made anew, and of one that is gone."""
    other, out = tmp_path / "sub" / "my.toml", tmp_path / "out"
    other.parent.mkdir()
    for file in (tmp_path / "My.toml", other):
        file.write_text(PLAIN)
    assert call(str(tmp_path / "My.toml"), "--out", str(out)).exit_code == 0
    before = (out / "my_report.html").read_bytes()
    refused = call(str(other), "--out", str(out))
    assert refused.exit_code == 2
    assert f"my_report.html: is the report of {tmp_path / 'My.toml'}" in refused.stderr
    assert (out / "my_report.html").read_bytes() == before
    _refuse_another(out / "my_report.html", tmp_path / "sub" / ".." / "My.toml")
    (tmp_path / "My.toml").unlink()
    assert call(str(other), "--out", str(out)).exit_code == 0


@pytest.mark.skipif(installed() is None, reason="no Chromium is installed")
def test_a_browser_has_nothing_to_complain_of(spindle: Path) -> None:
    with Browser() as browser:
        assert layout_faults(browser, spindle / "out" / "spindle_report.html") == [] == barriers(browser)
        browser.open(spindle / "out" / "spindle_report.html", width=390)
        parts = "[...document.querySelectorAll('table.stack')].map(table => table.closest('.table'))"
        cut = f"Math.max(...{parts}.map(part => part.scrollWidth - part.clientWidth))"
        assert browser.value(cut) == 0, "nothing of the Input table lies beyond a phone's page"
        rows = "[...document.querySelectorAll('table.stack tbody tr:not(.across)')].map(row => [...row.cells].map("
        rows += "e => [e.className, ...['left', 'top', 'right', 'bottom'].map(k => e.getBoundingClientRect()[k])]))"
        placed = [[each for each in row if each[1] != each[3]] for row in browser.value(rows)]
        below = [row for row in placed if row[-1][2] >= row[0][4]]
        assert len(below) > 10, "cells are below their row's first where there is no room beside it"
        named = [(row[0], each) for row in placed for each in row if each[0] == "verdict"]
        assert len(named) > 10
        for name, verdict in named:
            assert verdict[1] >= name[3]
            assert name[2] <= verdict[2] < name[4], "a verdict is beside its row's name"
        assert browser.complaints == []


HEATED = """
[bearing]
ball_count = 16
ball_diameter_mm = 7.14
pitch_diameter_mm = 46.5
bore_diameter_mm = 35
outside_diameter_mm = 62
groove_radius_coefficient = 0.535
free_contact_angle_deg = 24
ball_material = "steel"
ring_material = "steel"
[operation]
speed_rpm = 9000
[preload]
rigid_N = 400
[effects]
ball = ["centrifugal_force", "gyroscopic_moment"]
raceway_control = "outer"
[effects.ring_expansion]
[readings.friction]
friction_coefficient = 0.06
[thermal]
friction = "contacts"
[thermal.fixed]
ambient_C = 27
[[thermal.conductances]]
between = ["inner_ring", "outer_ring"]
W_per_K = 2
[[thermal.conductances]]
between = ["outer_ring", "ambient"]
W_per_K = 3
"""


def test_a_heat_balance_is_reported_with_its_stability(tmp_path: Path) -> None:
    """Temperatures are results, not given; where all balls are alike there is one number for each raceway."""
    (tmp_path / "hot.toml").write_text(HEATED)
    assert call(str(tmp_path / "hot.toml"), "--out", str(tmp_path)).exit_code == 0
    page, solution = page_of(tmp_path, "hot"), qs.solve(qs.load_scene(tmp_path / "hot.toml"))
    assert solution.thermal is not None
    assert value_of(tmp_path, "hot")["heat balance"] == solution.thermal.message()
    assert solution.thermal.onset() in page.text
    inner = float(solution.thermal.temperatures["inner_ring"]) - qs.zero_celsius
    (nodes,) = (table for table in page.tables if table[0] == ["node", "temperature °C"])
    assert float(dict(nodes[1:])["inner ring"]) == pytest.approx(inner, rel=1e-4)
    assert input_of(tmp_path, "hot")["ring_expansion.inner_ring_temperature_C"][2] == "heat balance"
    assert input_of(tmp_path, "hot")["ring_expansion.reference_temperature_C"][2] == ""
    assert [table[0] for table in page.tables if "sliding power" in table[1]] == [
        ["quantity", "inner", "outer", "unit"]
    ]


ELASTIC = """
[bearing]
name = "B218"
[operation]
axial_load_N = 17800
radial_load_y_N = 10000
tilt_y_mrad = 0
tilt_z_mrad = 0
[effects.elastic_rings]
inner.bore_diameter_mm = 90
inner.width_mm = 30
inner.shaft = "solid"
"""


def test_elastic_rings_are_drawn_and_what_they_touch_has_its_key(tmp_path: Path) -> None:
    (tmp_path / "elastic.toml").write_text(ELASTIC)
    assert call(str(tmp_path / "elastic.toml"), "--out", str(tmp_path)).exit_code == 0
    assert input_of(tmp_path, "elastic")["elastic_rings.inner.shaft"][0] == "solid"
    page = (tmp_path / "elastic_report.html").read_text(encoding="utf-8")
    assert "beside it the grooves of the elastic rings" in page, "of page 1"
    assert "Contact loads by the azimuth" in page_of(tmp_path, "elastic").text
