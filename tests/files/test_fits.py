"""Fits by name: the tables' rules against printed values, what a file may say, and what the limits do."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files.fits import classes, deviations, fit, names
from qsbearing.files.scene_file import scene_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.set_file import set_of
from qsbearing.results.fit_limits import fits_blocks, fits_record

PRINTED = {
    "k5": {70: (2, 15), 3: (0, 4), 120: (3, 18)},
    "m6": {50: (9, 25)},
    "n6": {30: (15, 28)},
    "p6": {100: (37, 59)},
    "g6": {40: (-25, -9)},
    "h4": {50: (-7, 0)},
    "h6": {80: (-19, 0)},
    "j5": {25: (-4, 5)},
    "j6": {100: (-9, 13)},
    "js5": {60: (-6.5, 6.5)},
    "JS6": {110: (-11, 11)},
    "H7": {52: (0, 30)},
    "G6": {90: (12, 34)},
    "J6": {72: (-6, 13)},
    "J7": {100: (-13, 22)},
    "K5": {80: (-10, 3)},
    "M5": {80: (-19, -6)},
    "N5": {80: (-28, -15)},
    "K6": {62: (-15, 4)},
    "K7": {62: (-21, 9)},
    "M6": {300: (-41, -9), 62: (-24, -5)},
    "M7": {62: (-30, 0)},
    "N7": {100: (-45, -10)},
    "P7": {100: (-59, -24)},
}
"""Of makers' tables of seats after ISO 286 [um]."""


@pytest.mark.parametrize("name", PRINTED)
def test_deviations_are_as_printed(name: str) -> None:
    for diameter, limits in PRINTED[name].items():
        np.testing.assert_allclose(deviations(name, diameter), limits, atol=1e-9)


def test_every_name_has_limits_that_grow_with_the_grade() -> None:
    for seat, letters in (("shaft", "k m n h js"), ("housing", "K M N H JS")):
        for name in names(seat):
            low, high = deviations(name, [1.0, 3.0, 500.0])
            assert (low < high).all(), name
        for letter in letters.split():
            widths = [np.ptp(deviations(f"{letter}{grade}", 70.0)) for grade in (4, 5, 6, 7)]
            assert widths == sorted(widths)
    assert np.isnan(deviations("k5", 501.0)).all()


def test_fits_with_a_bearing() -> None:
    """Least, mean and largest interference; of a housing the negative of the printed clearance."""
    shaft, housing = fit("shaft", "k5", "P4", 70 * qs.mm), fit("housing", "JS6", "P4A", 110 * qs.mm)
    assert np.array([shaft.least, shaft.mean, shaft.most]) / qs.um == pytest.approx([2, 12, 22])
    assert -np.array([housing.most, housing.mean, housing.least]) / qs.um == pytest.approx([-11, 4, 19])
    normal = fit("shaft", "k5", "normal", 70 * qs.mm)
    assert normal.most / qs.um == pytest.approx(30) and fit("shaft", "k5", "PN", 70 * qs.mm) == normal._replace(
        tolerance_class="PN"
    )
    assert set(classes()) >= {"normal", "P6", "P5", "P4", "P2"}


FITTED = {"shaft_fit": "k5", "housing_fit": "JS6", "tolerance_class": "P4", "housing_outside_diameter_mm": 150.0}


def document(**expansion: Any) -> dict[str, Any]:
    return {
        "bearing": {"name": "71914C"},
        "preload": {"rigid_N": 370.0},
        "operation": {"speed_rpm": 0.0},
        "effects": {"ring_expansion": FITTED | expansion},
    }


def test_a_scene_is_solved_at_the_mean_and_comes_back() -> None:
    scene = scene_of(document(), "a file")
    rings = scene.ring_expansion
    assert rings.shaft_interference == pytest.approx(12 * qs.um)
    assert rings.housing_interference == pytest.approx(-4 * qs.um)
    tables = input_tables(scene)
    written = tables["effects"]["ring_expansion"]
    assert written | FITTED == written and "shaft_interference_um" not in written
    assert scene_of(tables, "again").ring_expansion.fits == rings.fits


def test_the_limits_and_what_they_do(tmp_path: Path) -> None:
    scene = scene_of(document(), "a file")
    found = fits_record(qs.solve(scene))["fits"]
    seat = {key: found["seats"][0][key] for key in ("seat", "fit", "least_um", "mean_um", "largest_um", "diameter_mm")}
    assert list(seat.values()) == ["shaft", "k5", 2.0, 12.0, 22.0, 70.0]
    for place, interferences in enumerate([(2.0, -19.0), (22.0, 11.0)]):
        numbers = dict(zip(("shaft_interference_um", "housing_interference_um"), interferences, strict=True))
        plain = {key: value for key, value in document()["effects"]["ring_expansion"].items() if "_mm" in key}
        tables = document() | {"effects": {"ring_expansion": plain | numbers}}
        limit = qs.solve(scene_of(tables, "a file"))
        assert found["at_limits"]["preload_in_operation_N"][place] == pytest.approx(float(limit.preload_in_operation))
        axial = limit.locked_stiffness[0] / (qs.N / qs.um)
        assert found["at_limits"]["axial_N_per_um"][place] == pytest.approx(float(axial))
    path = tmp_path / "fits.toml"
    path.write_text(
        '[bearing]\nname="71914C"\npreload="medium"\n[operation]\nspeed_rpm=0\n[effects.ring_expansion]\nshaft_fit="k5"\n'
    )
    said = CliRunner().invoke(cli, ["run", str(path)]).output
    assert "shaft 70 k5, bearing of class normal" in said and "+2 ... +16 ... +30" in " ".join(said.split())
    record = json.loads(CliRunner().invoke(cli, ["run", str(path), "--json"]).output)
    assert record["fits"]["seats"][0]["mean_um"] == 16.0


def test_a_set_tells_of_its_rows() -> None:
    rows = [{"position_mm": 0.0, "carries": "+x"}, {"position_mm": 20.0, "carries": "-x"}]
    of = set_of(document() | {"rows": rows}, "a file")
    solution = qs.solve_set(of)
    found = fits_record(solution)["fits"]
    assert [each["row"] for each in found["seats"]] == [None, None]
    low, high = np.array(found["at_limits"]["preload_in_operation_N"]).T
    assert (low < solution.preload_in_operation).all() and (solution.preload_in_operation < high).all()
    own = set_of(document() | {"rows": [rows[0], rows[1] | {"ring_expansion": {"shaft_fit": "h5"}}]}, "a file")
    assert {each["row"] for each in fits_record(qs.solve_set(own))["fits"]["seats"]} == {1, 2}
    assert not fits_blocks(qs.solve_set(set_of(document() | {"rows": rows, "effects": {}}, "a file")))


@pytest.mark.parametrize(
    ("given", "key", "words"),
    [
        ({"shaft_fit": "K5"}, "shaft_fit", "Did you mean k5? (capitals mean holes)"),
        ({"housing_fit": "js6"}, "housing_fit", "Did you mean JS6? (small letters mean shafts)"),
        ({"shaft_fit": "z9"}, "shaft_fit", "Known are"),
        ({"shaft_fit": 5}, "shaft_fit", "is no fit of a shaft"),
        ({"shaft_fit": 10**5000}, "shaft_fit", "is no fit of a shaft"),
        ({"tolerance_class": [4]}, "tolerance_class", "is no tolerance class"),
        ({"shaft_interference_um": 5.0}, "shaft_fit", "given together with shaft_interference_um"),
        ({"tolerance_class": "P4Y"}, "tolerance_class", "limits of their own"),
        ({"bore_diameter_mm": 251.0, "outside_diameter_mm": 360.0}, "shaft_fit", "no limits in the tables"),
    ],
)
def test_what_is_no_fit_is_told_once(given: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(qs.SceneFileError) as raised:
        scene_of(document(**given), "a file")
    (error,) = raised.value.errors
    assert error.key == f"effects.ring_expansion.{key}" and words in str(error)


def test_diameters_that_vary_have_a_fit_each() -> None:
    found = fit("shaft", "k5", "P4", np.array([10.0, 70.0, 260.0]) * qs.mm)
    np.testing.assert_allclose(found.most / qs.um, [11.0, 22.0, np.nan])
