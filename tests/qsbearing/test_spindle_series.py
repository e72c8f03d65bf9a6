"""Standard spindle bearings of the catalogue, and bearings given as catalogues and people give them."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

import qsbearing as qs
from fem_check.book.cases.gmn_rigidities import LEAST_RIGIDITY, column, columns, fitted_groove
from fem_check.book.published import gmn_rows
from qsbearing.cli import cli
from qsbearing.io import catalogue
from qsbearing.io.catalogue.spindle_series import spindle_bearings
from qsbearing.io.scene_file import scene_of
from qsbearing.io.scene_tables import input_tables
from qsbearing.io.set_file import set_of
from qsbearing.material import BY_NAME

SCENE: dict[str, Any] = {
    "bearing": {
        "ball_count": 15, "ball_diameter_mm": 12.7, "pitch_diameter_mm": 70.0, "groove_radius_coefficient": 0.52,
        "free_contact_angle_deg": 15.0, "ball_material": "Si3N4", "ring_material": "100Cr6",
    },
    "operation": {"axial_load_N": 500.0},
}  # fmt: skip


def run(*arguments: object) -> Result:
    result = CliRunner().invoke(cli, [str(argument) for argument in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def scene(**bearing: Any) -> qs.Scene:
    tables = copy.deepcopy(SCENE)
    tables["bearing"] |= bearing
    tables["bearing"] = {key: value for key, value in tables["bearing"].items() if value is not None}
    return scene_of(tables, "file")


def test_every_row_is_there_with_steel_and_ceramic_balls() -> None:
    found = spindle_bearings()
    assert len(found) == 2 * len(gmn_rows())
    for name, entry in found.items():
        assert catalogue.find(name) is not None
        assert set(entry.bearing) - {"kind"} == set(entry.provenance)
        if name not in ("7210c", "7210c_hybrid"):
            assert entry.assumed == ("inner_groove_radius_mm", "outer_groove_radius_mm")


def test_every_example_solves() -> None:
    unsolved = [name for name in spindle_bearings() if not qs.solve(qs.load_scene(name)).converged]
    assert unsolved == []


def test_what_is_inferred_is_what_the_rigidities_say() -> None:
    rows = gmn_rows()
    fitted = fitted_groove(rows)
    stiff = column(rows, "CaxS") >= LEAST_RIGIDITY
    assert stiff.sum() > 50
    assert np.abs(column(rows, "inferred_f") - fitted)[stiff].max() <= 0.51e-4, "four decimals"
    series = np.array([row["name"].split()[0] + ("619" if "S 619" in row["name"] else "") for row in rows])
    for each in set(series):
        median = np.median(fitted[stiff & (series == each)])
        assert np.abs(column(rows, "inferred_f")[~stiff & (series == each)] - median).max(initial=0.0) <= 0.51e-4


def test_computed_rigidities_are_the_printed_ones() -> None:
    """Twice the axial stiffness at the printed preloads; bearings by their names, so through all of the catalogue."""
    rows = [row for row in gmn_rows() if row["CaxS"] >= LEAST_RIGIDITY]
    found = []
    for row in rows:
        entry = next(
            each for each in spindle_bearings().values() if each.source.split("row ")[1].startswith(row["name"])
        )
        document = {"bearing": {"name": entry.name}, "operation": {"axial_load_N": 1.0}}
        bearing = scene_of(document, "").bearing
        solution = qs.solve(qs.Scene(bearing, qs.Operation(axial_load=columns([row], "Fv")[0])))
        found.append(2e-6 * solution.stiffness[:, 0, 0])
    off = np.array(found) / columns(rows, "Cax") - 1.0
    # f has four decimals: 0.5e-4 of 0.02 in f - 0.5 is 0.1 % of the stiffness; the fit itself leaves up to 1.1 % rms.
    assert np.sqrt((off**2).mean(axis=1)).max() < 0.013


def test_an_example_that_is_a_row_too_keeps_its_numbers_and_has_the_row_s_dimensions() -> None:
    entry = catalogue.find("7210C")
    assert entry.bearing["inner_groove_radius_mm"] == 6.58
    assert entry.dimensions["bore_diameter_mm"] == 50.0 and entry.dimensions["outside_diameter_mm"] == 90.0


def test_dimensions_and_ratings_are_the_printed_ones() -> None:
    """S 6210 C of the catalogue: 50 x 90 x 20 mm, 47.5 kN and 37 kN, with ceramic balls 26 kN."""
    steel, ceramic = (catalogue.find(name).dimensions for name in ("7210C", "7210C_hybrid"))
    assert [steel[f"{key}_mm"] for key in ("bore_diameter", "outside_diameter", "width")] == [50.0, 90.0, 20.0]
    assert (steel["dynamic_load_rating_N"], steel["static_load_rating_N"]) == (47500.0, 37000.0)
    assert ceramic["static_load_rating_N"] == 26000.0
    assert (steel["inner_shoulder_diameter_mm"], steel["outer_shoulder_diameter_mm"]) == (62.5, 76.9)


def test_the_command_chooses() -> None:
    text = run("catalogue", "--bore", "70", "--angle", "15").stdout
    assert "71914C" in text and "71914C_hybrid" in text and "71914E" not in text and "inferred" in text
    text = run("catalogue", "--series", "kh70", "--hybrid").stdout
    assert "KH7014E_hybrid" in text and "KH7014E " not in text and "71914" not in text
    assert "bore_diameter_mm" in run("catalogue", "71914E").stdout
    assert run("catalogue", "--bore", "71").exit_code == 2
    assert run("catalogue", "b218", "--bore", "71").exit_code == 2
    result = run("run", "7014")
    assert result.exit_code == 2 and "KH7014C" in result.output


def test_a_coefficient_is_the_radius_over_the_diameter() -> None:
    bearing = scene().bearing
    assert bearing.inner_groove_radius == bearing.outer_groove_radius == pytest.approx(0.52 * 12.7e-3, rel=1e-15)
    bearing = scene(outer_groove_radius_coefficient=0.53).bearing
    assert bearing.inner_groove_radius == pytest.approx(0.52 * 12.7e-3, rel=1e-15)
    assert bearing.outer_groove_radius == pytest.approx(0.53 * 12.7e-3, rel=1e-15)
    bearing = scene(inner_groove_radius_mm=6.7).bearing
    assert bearing.inner_groove_radius == 6.7e-3
    assert bearing.outer_groove_radius == pytest.approx(0.52 * 12.7e-3, rel=1e-15)


def test_a_coefficient_replaces_the_catalogue_s_radius_and_follows_its_ball() -> None:
    bearing = scene_of(
        {"bearing": {"name": "B218", "groove_radius_coefficient": 0.53}, "operation": {"axial_load_N": 1.0}}, ""
    ).bearing
    assert bearing.inner_groove_radius == pytest.approx(0.53 * 22.225e-3)
    assert bearing.name == "B218, modified"
    results = qs.sweep(qs.Study.of(copy.deepcopy(SCENE), {"ball_diameter_mm": [11.0, 12.0]}, quantities=["inner_load"]))
    assert (results["status"] == 0).all(), "f stays, so both balls fit their grooves"


@pytest.mark.parametrize("given", ["inner_groove_radius_mm", "inner_groove_radius_coefficient", "ball_diameter_mm"])
def test_a_study_of_f_takes_the_place_of_what_the_file_says(given: str) -> None:
    value = {"inner_groove_radius_mm": 6.6, "inner_groove_radius_coefficient": 0.525, "ball_diameter_mm": 12.7}[given]
    tables = copy.deepcopy(SCENE)
    tables["bearing"] |= {given: value}
    for key in ("groove_radius_coefficient", "inner_groove_radius_coefficient", "inner_groove_radius_mm"):
        f, size = 0.53, 12.7 if key.endswith("mm") else 1.0
        vary = {key: [f * size, 0.54 * size]}
        study = qs.Study.of(copy.deepcopy(tables), vary, quantities=["inner_max_pressure_max"])
        found = float(qs.sweep(study)["inner_max_pressure_max"][0])
        outer = f if key == "groove_radius_coefficient" else 0.52
        radii = {"inner_groove_radius_mm": f * 12.7, "outer_groove_radius_mm": outer * 12.7}
        alone = {"groove_radius_coefficient": None, **radii}
        wanted = qs.solve(scene(**alone)).inner.max_pressure.max() / 1e6
        assert found == pytest.approx(wanted, rel=1e-9), key


def test_bore_and_outside_diameter_are_stated_once() -> None:
    tables = copy.deepcopy(SCENE) | {
        "effects": {"ring_expansion": {"shaft_interference_um": 5.0}},
        "readings": {
            "friction_estimate": {"static_load_rating_N": 3e4},
            "lubricant": {"iso_viscosity_grade": 68.0, "oil_temperature_C": 40.0},
        },
    }
    tables["bearing"] |= {"bore_diameter_mm": 50.0, "outside_diameter_mm": 90.0}
    made = scene_of(copy.deepcopy(tables), "")
    assert made.ring_expansion.bore_diameter == 0.05 and made.ring_expansion.outside_diameter == 0.09
    assert made.readings["friction_estimate"]["bore_diameter"] == 0.05
    tables["effects"]["ring_expansion"]["bore_diameter_mm"] = 51.0
    assert scene_of(tables, "").ring_expansion.bore_diameter == pytest.approx(0.051), (
        "what the effect states itself stays"
    )
    again = scene_of(input_tables(made), "")
    assert again == made


def test_the_catalogue_s_diameters_need_no_typing() -> None:
    tables = {
        "bearing": {"name": "71914C"}, "operation": {"speed_rpm": 1e4, "axial_load_N": 500.0},
        "effects": {"ring_expansion": {"shaft_interference_um": 5.0}},
    }  # fmt: skip
    expansion = scene_of(copy.deepcopy(tables), "").ring_expansion
    assert (expansion.bore_diameter, expansion.outside_diameter) == (0.07, 0.1)
    rows = [{"position_mm": 0.0, "carries": "+x"}, {"position_mm": 20.0, "carries": "-x"}]
    rows[1] |= {"bearing": {"name": "71915C"}, "ring_expansion": {"shaft_interference_um": 3.0}}
    of = set_of(tables | {"rows": rows, "operation": {"speed_rpm": 1e4}, "preload": {"rigid_N": 300.0}}, "")
    assert [of.effects_of(row)[0].bore_diameter for row in of.rows] == [0.07, 0.075]
    tables["bearing"] = {"name": "ISO16281_7ball"}
    with pytest.raises(qs.SceneError, match="bore_diameter_mm: missing"):
        scene_of(tables, "")


@pytest.mark.parametrize("spelling", BY_NAME)
def test_a_material_goes_by_each_of_its_names_and_says_where_it_is_from(spelling: str, tmp_path: Path) -> None:
    made = scene(ball_material=spelling.upper(), ring_material=spelling)
    material = made.bearing.ball_material
    assert material is BY_NAME[spelling]
    assert len(material.source) > 20
    assert scene_of(input_tables(made), "").bearing.ring_material is material


def test_names_of_the_same_steel_are_one_material() -> None:
    assert BY_NAME["aisi 52100"] is BY_NAME["100cr6"]
    assert BY_NAME["si3n4"] is qs.SILICON_NITRIDE
    assert BY_NAME["m50"].elastic_modulus == 214e9


@pytest.mark.parametrize(
    ("bearing", "said"),
    [
        ({"groove_radius_coefficient": "0.52"}, ["groove_radius_coefficient", "is not a number"]),
        ({"groove_radius_coefficient": 0.4}, ["smaller than the ball", "0.4"]),
        (
            {"inner_groove_radius_coefficient": 0.52, "inner_groove_radius_mm": 6.6},
            ["is given together with inner_groove"],
        ),
        ({"inner_groove_radius_mm": 6.6, "outer_groove_radius_mm": 6.6}, ["is given together with inner_groove"]),
        ({"ball_diameter_mm": None}, ["1 error", "ball_diameter_mm: missing"]),
        ({"groove_radius_coeficient": 0.52}, ["Did you mean groove_radius_coefficient?"]),
        ({"ball_material": "Si3N5"}, ["Did you mean si3n4?"]),
        ({"bore_diameter_mm": True}, ["bore_diameter_mm", "is not a number"]),
    ],
)
def test_what_cannot_be_is_said(bearing: dict[str, Any], said: list[str]) -> None:
    with pytest.raises(qs.SceneError) as error:
        scene(**bearing)
    for words in said:
        assert words in str(error.value)
