"""Standard spindle bearings of the catalogue, and bearings given as catalogues and people give them."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from fem_check.book.cases.gmn_rigidities import LEAST_RIGIDITY, column, columns, fitted_groove, rounding
from fem_check.book.published import gmn_rows
from qsbearing.files import catalogue
from qsbearing.files.catalogue.spindle_series import spindle_bearings
from qsbearing.files.scene_file import scene_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.set_file import set_of
from qsbearing.model.material import BY_NAME
from tests.cli.command import call

SCENE: dict[str, Any] = {
    "bearing": {
        "ball_count": 15, "ball_diameter_mm": 12.7, "pitch_diameter_mm": 70.0, "groove_radius_coefficient": 0.52,
        "free_contact_angle_deg": 15.0, "ball_material": "Si3N4", "ring_material": "100Cr6",
    },
    "operation": {"axial_load_N": 500.0},
}  # fmt: skip


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
    inferred, is_s = column(rows, "inferred_f"), np.array([row["name"].startswith("S") for row in rows])
    own = is_s | (column(rows, "CaxS") >= LEAST_RIGIDITY)
    assert np.abs(inferred - fitted)[own].max() <= 0.51e-4, "four decimals"
    assert np.abs(inferred[~own] - np.median(fitted[own & ~is_s])).max() <= 0.51e-4, "one for all of series KH"


def test_a_row_of_few_digits_has_the_groove_of_its_stiffer_twin() -> None:
    """Fitted to rigidities of two digits at 15 degrees; held against the same bearing's at 25 degrees, of three."""
    rows = {row["name"]: row for row in gmn_rows() if row["name"].startswith("S")}
    pairs = [
        (row["inferred_f"], rows[twin]["inferred_f"])
        for name, row in rows.items()
        if row["CaxS"] < LEAST_RIGIDITY
        and (twin := name.replace(" C ", " E ")) in rows
        and rows[twin]["CaxS"] >= LEAST_RIGIDITY
    ]
    apart = np.diff(pairs, axis=1)
    # Rounding alone, 1 to 2.8 % of three rigidities that go with exp(-20 f), leaves 0.0007 of f; the median of the
    # series, which stood there before, is off by 0.0043 and the groove that the static rating asks for by 0.0011.
    assert len(pairs) == 9 and np.sqrt((apart**2).mean()) < 0.0008


MISPRINT = ("KH 61903 E TA", 1)
"""62 N/um at medium preload, between 35 and 67: every other row of its kind has some 0.77 of the last, here 52."""
AMONG_THEMSELVES = 1.5
"""By how much the printed rigidities of one row disagree beyond their rounding [%]: rows whose rounding is below 0.5 %
leave up to 1.3 % (S 61907 E)."""
C_OVER_PRINTED = {"S": (0.95, 1.0), "S small": (0.88, 1.0), "KH": (1.07, 1.14)}
C0_OVER_PRINTED = {"S": (0.91, 1.0), "S small": (0.81, 1.0), "KH": (1.29, 1.35)}
"""What the geometry makes of C and C0. S: the maker's ratings are those of the inner groove, f 0.0013 below the mean of
both that the rigidities tell, and C0 goes with exp(-30 f), C with half of that. Small (below 80 N/um): the rigidities
ask for a groove wider by up to 0.0098 (S 627 C). KH: no one groove has both, C0 asks for f = 0.561, the rigidities for
0.538. What is used of a named bearing are the printed ones."""


def test_what_is_computed_of_every_row_is_what_is_printed() -> None:
    """Bearings by their names, so through all of the catalogue: dimensions and ratings, exactly; twice the axial
    stiffness at the printed preloads, within their rounding; C and C0 of the geometry, as far as they can."""
    rows = {row["name"]: row for row in gmn_rows()}
    entries = {
        each.source.split("row ")[1].partition(";")[0]: each for each in spindle_bearings().values()
    }  # the last of a row is the hybrid one
    assert set(entries) == set(rows)
    for name, row in rows.items():
        entry = entries[name]
        steel = entry.name.removesuffix("_hybrid")
        if steel == "7210C":  # an example too, with a groove of its own
            assert row["inferred_f"] == pytest.approx(6.58 / 12.7, abs=1e-4)
        made = scene_of({"bearing": {"name": steel}, "operation": {"axial_load_N": 1.0}}, "")
        hybrid = scene_of({"bearing": {"name": entry.name}, "operation": {"axial_load_N": 1.0}}, "")
        numbers, of_hybrid = qs.catalogue_numbers(made.bearing), qs.catalogue_numbers(hybrid.bearing)
        used = [numbers[key] / qs.mm for key in ("bore_diameter", "outside_diameter", "width")]
        assert used == pytest.approx([row["d_mm"], row["D_mm"], row["B_mm"]], rel=1e-12), name
        used = [numbers["dynamic_load_rating"], numbers["static_load_rating"], of_hybrid["static_load_rating"]]
        assert used == [row["C"], row["C0"], row["C0_HY"]], name
        solution = qs.solve(qs.Scene(made.bearing, qs.Operation(axial_load=columns([row], "Fv")[0])))
        printed = columns([row], "Cax")[0]
        off = 100.0 * np.abs(2e-6 * solution.stiffness[:, 0, 0] / printed - 1.0)
        wrong = [(name, i) for i in np.flatnonzero(off > rounding(printed) + AMONG_THEMSELVES)]
        assert set(wrong) <= {MISPRINT}, (wrong, off)
        kind = "KH" if name.startswith("KH") else "S" if row["CaxS"] >= LEAST_RIGIDITY else "S small"
        for least_most, computed, key in (
            (C_OVER_PRINTED, qs.readings.dynamic_load_rating(made.bearing), "C"),
            (C0_OVER_PRINTED, qs.readings.static_load_rating(made.bearing), "C0"),
        ):
            least, most = least_most[kind]
            assert least <= float(computed) / row[key] <= most, (name, key)


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
    text = call("catalogue", "--bore", "70", "--angle", "15").stdout
    assert "71914C" in text and "71914C_hybrid" in text and "71914E" not in text and "inferred" in text
    text = call("catalogue", "--series", "kh70", "--hybrid").stdout
    assert "KH7014E_hybrid" in text and "KH7014E " not in text and "71914" not in text
    assert "bore_diameter_mm" in call("catalogue", "71914E").stdout
    assert call("catalogue", "--bore", "71").exit_code == 2
    assert call("catalogue", "b218", "--bore", "71").exit_code == 2
    result = call("run", "7210")
    assert result.exit_code == 2 and "7210C or 7210E?" in result.output and "KH" not in result.output


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


@pytest.mark.parametrize("spelling", [name for name in BY_NAME if not name.startswith("stainless")])
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
