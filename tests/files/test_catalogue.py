"""The catalogue: every entry complete, sourced, and solvable."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

import qsbearing as qs
from qsbearing.files import catalogue
from qsbearing.files import keys as scene_keys
from qsbearing.files.file_keys import reading_tables
from qsbearing.files.template import scene_template

NAMES = [entry.name for entry in catalogue.entries()]


def test_the_catalogue_holds_every_data_file_once() -> None:
    files = list(Path(catalogue.__file__).parent.glob("*.toml"))
    assert len(NAMES) == len(set(NAMES)) == len(files) >= 6
    assert {file.stem for file in files} == {name.lower() for name in NAMES}, "the file's name is what a user types"


@pytest.mark.parametrize("name", NAMES)
def test_every_number_says_where_it_comes_from(name: str) -> None:
    entry = catalogue.find(name)
    assert set(entry.bearing) - {"kind"} == set(entry.provenance)
    assert all(len(origin) > 10 for origin in entry.provenance.values())
    assert len(entry.source) > 20
    assert len(entry.description) > 20


def test_assumed_values_are_known_as_such() -> None:
    assert catalogue.find("7210C").assumed == ("inner_groove_radius_mm", "outer_groove_radius_mm")
    assert catalogue.find("B218").assumed == ()


@pytest.mark.parametrize("name", NAMES)
def test_every_example_solves(name: str) -> None:
    solution = qs.solve(qs.load_scene(name))
    assert solution.converged
    assert solution.scene.bearing.name == name


def test_b218_is_as_published() -> None:
    bearing = qs.load_scene("b218").bearing
    assert (bearing.ball_count, bearing.ball_diameter, bearing.pitch_diameter) == pytest.approx((16, 0.022225, 0.12526))
    assert bearing.inner_groove_radius == bearing.outer_groove_radius == pytest.approx(0.0116281)
    assert bearing.free_contact_angle / qs.deg == pytest.approx(40.0)
    # The literature gives the 218 bearing a diametral clearance of 0.4826 mm; the angle is known to four digits.
    assert bearing.diametral_clearance / qs.mm == pytest.approx(0.4826, abs=2e-4)


def test_names_are_found_in_any_case_and_near_ones_are_suggested() -> None:
    assert catalogue.find(" iso16281_7BALL ").name == "ISO16281_7ball"
    assert catalogue.find("B219") is None
    assert catalogue.nearest("B219") == "Did you mean B218?"
    assert "B218" in catalogue.nearest("qqqqqqq")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("by_name", [True, False])
def test_a_printed_scene_file_says_what_the_example_says(name: str, by_name: bool, tmp_path: Path) -> None:
    text = scene_template(catalogue.find(name), by_name)
    file = tmp_path / f"{name}.toml"
    file.write_text(text)
    written, example = qs.load_scene(file), qs.load_scene(name)
    assert written == example
    assert max(len(line) for line in text.splitlines()) <= 125


@pytest.mark.parametrize("name", NAMES)
def test_every_commented_line_of_a_printed_scene_is_good_when_taken_in(name: str, tmp_path: Path) -> None:
    text = scene_template(catalogue.find(name), by_name=True)
    lines = text.splitlines()
    commented = [i for i, line in enumerate(lines) if line.startswith("# ") and " = " in line.partition("  #")[0]]
    tables = next(i for i, line in enumerate(lines) if line.startswith("# [effects."))
    known = [i for i in commented if i < tables and lines[i][2:].partition(" = ")[0].isidentifier()]
    assert len(known) >= 12
    given = set(tomllib.loads(text)["operation"])
    for i in known:
        changed = [line.removeprefix("# ") if j == i else line for j, line in enumerate(lines)]
        key = lines[i][2:].partition(" = ")[0]
        # These need company: a radial load its tilt, ball effects and raceway control each other.
        if key == "radial_load_y_N" and "tilt_z_mrad" not in given:
            changed.insert(i, "tilt_z_mrad = 0")
        if key in scene_keys.SECTIONS["preload"]:  # its table, in place of the axial load
            changed = [line.removeprefix("# ") if line.startswith("# [preload]") else line for line in changed]
            axial = ("axial_load_N", "axial_displacement_um")
            changed = [f"# {each}" if each.startswith(axial) and j != i else each for j, each in enumerate(changed)]
        of_motion = ("ball", "raceway_control", "moment_shares", "friction_coefficient", "orbit_radius")
        if key in of_motion and not qs.load_scene(name).ball_effects:
            continue
        file = tmp_path / "scene.toml"
        file.write_text("\n".join(changed))
        qs.load_scene(file)


def test_the_commented_tables_of_a_printed_scene_are_good_when_taken_in(tmp_path: Path) -> None:
    """All of them at once, but the law of friction, which goes alone; their diameters are those of B218."""
    text = scene_template(catalogue.find("B218"), by_name=True)
    before, mark, tables = text.partition("# [effects.")
    law, rest = (each.replace("\n# ", "\n").removeprefix("# ") for each in (mark + tables).split("\n\n", 1))
    file = tmp_path / "scene.toml"
    file.write_text(before.replace('"outer"', '"friction"') + law)
    assert qs.load_scene(file).traction is not None
    file.write_text(before + rest)
    scene = qs.load_scene(file)
    names = ["ring_expansion", "ball_expansion", "elastic_rings", "seats_out_of_round"]
    assert [effect.name for effect in scene.ring_effects] == names
    assert set(scene.readings) == set(reading_tables())
    effects, _, _ = tables.partition("# [readings]")
    keys = [line.lstrip("# ").partition(" = ")[0] for line in effects.splitlines()[1:] if " = " in line]
    known = {key for section in scene_keys.EFFECT_SECTIONS.values() for key in section}
    assert set(keys) == known, "every key is shown"
