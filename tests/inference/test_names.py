"""Bearings by the number on them: printed ratings, clearance by class, guesses, and what stays refused."""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

import qsbearing as qs
from fem_check.book.published import columns_of
from qsbearing.cli import cli
from qsbearing.files.designations import read
from qsbearing.files.designations.ratings import ratings_of
from qsbearing.files.scene_file import scene_of
from qsbearing.inference.clearance import ClearanceClass, clearance_limits
from qsbearing.model.validation import SceneError

LOADED = {"speed_rpm": 3000, "axial_load_N": 300.0}


def bearing(name: str, **more: Any) -> Any:
    """Every bearing that a name, with numbers beside it, allows."""
    tables = {"bearing": {"name": name} | more, "operation": dict(LOADED)}
    return scene_of(tables, "a file", may_infer=True).bearing


def sets(of: Any) -> list[tuple[int, float]]:
    first = [int(np.flatnonzero(of.inferred.set_number == number)[0]) for number in np.unique(of.inferred.set_number)]
    return [(int(of.ball_count[case]), round(float(of.ball_diameter[case] / qs.mm), 2)) for case in first]


def run(tmp_path: Path, name: str, rest: str = "", *options: str) -> Result:
    file = tmp_path / "scene.toml"
    text = f'[bearing]\nname = "{name}"\n[operation]\nspeed_rpm = 3000\naxial_load_N = 300\n{rest}'
    file.write_text(text, encoding="utf-8")
    return CliRunner().invoke(cli, ["run", str(file), *options])


@pytest.mark.parametrize(
    ("name", "known"),
    [
        ("SKF 6205", (9, 7.94)),
        ("SKF 6308", (8, 15.08)),
        ("NSK 6203", (8, 6.75)),
        ("NSK 6206-C3", (9, 9.52)),
        ("NSK 6804", (13, 3.5)),
        ("NTN 7014UCG", (21, 11.91)),
        ("SKF 6305", (7, 11.51)),
        ("NSK 6305", (8, 10.32)),
    ],
)
def test_a_name_runs_from_its_makers_ratings(name: str, known: tuple[int, float]) -> None:
    found = sets(bearing(name))
    assert found[0] == known and len(found) <= 2


def test_a_bare_number_lists_the_sets_of_all_makers() -> None:
    """6305: SKF 7 x 11.509, NSK 8 x 10.319; of 6205 both have the same."""
    both = bearing("6305")
    assert {(7, 11.51), (8, 10.32)} <= set(sets(both))
    assert {str(each) for each in both.inferred.practice} == {"iso, SKF", "iso, NSK"}
    assert {str(each) for each in bearing("6205").inferred.practice} == {"iso, SKF; iso, NSK"}
    assert sets(bearing("6305", maker="NSK")) == [(8, 10.32)]


def test_the_clearance_is_that_of_the_class_with_its_range() -> None:
    """ISO 5753-1, bore 25 mm: C3 13 to 28 um; no letters mean the normal class, 5 to 20 um."""
    for name, of, least, most in (
        ("SKF 6205-C3", "C3", 13, 28),
        ("SKF 6205", "CN", 5, 20),
        ("SKF 6205/C2", "C2", 1, 11),
    ):
        found = bearing(name)
        clearances = np.unique(np.round(np.asarray(found.diametral_clearance) / qs.um, 6))
        assert clearances == pytest.approx([least, 0.5 * (least + most), most])
        assert found.inferred.at(0).diametral_clearance == pytest.approx(0.5 * (least + most) * qs.um)
        assert any(f"clearance {of} of ISO 5753-1" in each for each in found.inferred.remarks)
    given = bearing("SKF 6205-C3", diametral_clearance_mm=0.004)
    assert np.asarray(given.diametral_clearance) == pytest.approx(4e-6)


def test_clearance_classes_follow_each_other() -> None:
    """Each step of class is looser at both ends and overlaps the one before; larger bores are no tighter."""
    for bore in range(6, 201):
        limits = [clearance_limits(bore * qs.mm, each) for each in ClearanceClass]
        assert None not in limits
        assert limits == sorted(limits)  # type: ignore[type-var]
        assert all(looser[0] < tighter[1] for tighter, looser in pairwise(limits))  # type: ignore[index]
        larger = [clearance_limits((bore + 1) * qs.mm, each) for each in ClearanceClass]
        if None not in larger:
            assert all(one[1] <= other[1] for one, other in zip(limits, larger, strict=True))  # type: ignore[index]
    assert clearance_limits(0.205, ClearanceClass.CN) is None and clearance_limits(5e-3, ClearanceClass.CN) is None


def test_the_range_over_the_class_is_in_the_results() -> None:
    """From the least at any clearance of the class to the most."""

    def stiffness(**clearance: Any) -> Any:
        solution = qs.solve(qs.Scene(bearing("SKF 6205", **clearance), qs.Operation(axial_load=300.0)))
        assert solution.converged.all()
        return solution.stiffness[:, 0, 0]

    single = np.concatenate([stiffness(diametral_clearance_mm=each) for each in (0.005, 0.0125, 0.02)])
    of_class = stiffness()
    assert (of_class.min(), of_class.max()) == pytest.approx((single.min(), single.max()), rel=1e-9)
    middle = stiffness(diametral_clearance_mm=0.0125)
    assert of_class.min() < middle.min() and middle.max() < of_class.max()


@pytest.mark.parametrize("name", ["7014 CTYNSULP4 NSK", "FAG B7210-E-T-P4S", "SKF 7210 BECBP", "SKF 6004"])
def test_without_ratings_there_are_stiffness_and_pressure_and_no_life(name: str, tmp_path: Path) -> None:
    result = run(tmp_path, name, "", "--json")
    assert result.exit_code == 0, result.output
    found = json.loads(result.stdout)
    least, most = found["inferred"]["ring_effective_stiffness_axial_N_per_um"]
    assert 0.0 < least < most
    assert any("guessed by the proportions" in each for each in found["warnings"])
    life = run(tmp_path, name, "[readings.life]\n")
    assert life.exit_code == 2 and "readings.life: needs load ratings" in life.output
    rated = run(tmp_path, name, "[readings.life]\ndynamic_load_rating_N = 40000\n")
    assert rated.exit_code == 0, rated.output


def test_a_life_takes_the_ratings_of_the_name(tmp_path: Path) -> None:
    """SKF 6205: C = 14,800 N; the makers of a bare number differ."""
    by_name = json.loads(run(tmp_path, "SKF 6205", "[readings.life]\n", "--json").stdout)
    given = "[readings.life]\ndynamic_load_rating_N = 14800\n"
    assert by_name["inferred"] == json.loads(run(tmp_path, "SKF 6205", given, "--json").stdout)["inferred"]
    bare = run(tmp_path, "6205", "[readings.life]\n")
    assert bare.exit_code == 2 and "Makers rate it differently" in bare.output


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("NSK 6310", "Nearest is 8 x 19.05 mm"),
        ("SKF 71914 CE/HCP4A", "of a series of light balls"),
        ("HSS71914C", "of a series of light balls"),
        ("SNFA VEB 50 CE1", "of a series of light balls"),
        ("ZZZ7014C", "is not known"),
        ("NSK 7818C", "give dynamic_load_rating_N"),  # of series 18 no usual proportions are known
    ],
)
def test_what_nobody_knows_is_refused(name: str, said: str, tmp_path: Path) -> None:
    result = run(tmp_path, name)
    assert result.exit_code == 2
    assert said in result.output, result.output


def test_a_result_by_name_is_run_again(tmp_path: Path) -> None:
    for name in ("6305", "SKF 6205-C3", "SKF 7210 BECBP"):
        first = run(tmp_path, name, "", "--json").stdout
        (tmp_path / "first.json").write_text(first, encoding="utf-8")
        again = CliRunner().invoke(cli, ["run", str(tmp_path / "first.json"), "--json"])
        assert again.exit_code == 0, again.output
        assert json.loads(again.stdout)["inferred"] == json.loads(first)["inferred"], name


def test_a_count_beside_a_name_narrows_its_list() -> None:
    every = sets(bearing("SKF 7210 BECBP"))
    counted = sets(bearing("SKF 7210 BECBP", ball_count=15))
    assert counted and set(counted) == {each for each in every if each[0] == 15}
    with pytest.raises(SceneError, match="of 9 balls"):
        bearing("SKF 7210 BECBP", ball_count=9)


def test_printed_ratings_are_those_of_their_sources() -> None:
    """NTN's stand in the book's data too."""
    columns = columns_of("ntn_ultage_rigidities")
    for name, dynamic, static in zip(columns["name"], columns["C"], columns["C0"], strict=True):
        told = read(f"NTN {name}")
        assert told is not None
        (printed,) = ratings_of(told)
        assert (printed.dynamic, printed.static) == pytest.approx((1e3 * float(dynamic), 1e3 * float(static)))
    assert not ratings_of(read("NTN 7014C")), "of another design than ULTAGE"  # type: ignore[arg-type]
    assert not ratings_of(read("NSK 7210C")), "which judges"  # type: ignore[arg-type]


def test_most_typed_designations_are_answered(tmp_path: Path) -> None:
    """Others than those above."""
    names = ["SKF 6207-2Z/C3", "NSK 6010ZZ", "SKF 61908", "6306", "NSK 6910", "FAG B71908-C-T-P4S", "SKF 7306 BEP"]
    for name in names:
        assert run(tmp_path, name, "", "--json").exit_code == 0, name


OPERATION_OF_E_DRIVE = """
[operation]
speed_rpm = 12000
radial_load_y_N = 1500
axial_load_N = 300
tilt_y_mrad = 0
tilt_z_mrad = 0
[effects.ring_expansion]
shaft_fit = "k5"
housing_fit = "H6"
tolerance_class = "P6"
inner_ring_temperature_C = 90
outer_ring_temperature_C = 70
housing_outside_diameter_mm = 120
[readings.life]
"""


def solved(tmp_path: Path, table: str, rest: str = OPERATION_OF_E_DRIVE) -> Result:
    file = tmp_path / "scene.toml"
    file.write_text(f"[bearing]\n{table}\n{rest}", encoding="utf-8")
    return CliRunner().invoke(cli, ["run", str(file), "--json"])


def test_fits_and_temperatures_reduce_the_clearance_of_the_class(tmp_path: Path) -> None:
    """To the clearance in operation, whose range is as wide as the class: C3 of 40 mm is 15 to 33 um."""
    found = json.loads(solved(tmp_path, 'name = "SKF 6208-C3"').stdout)["inferred"]
    least, most = found["operating_diametral_clearance_um"]
    assert most - least == pytest.approx(18.0, rel=0.01)
    assert most < 15.0, "k5 and 20 K take more than half"
    single = json.loads(solved(tmp_path, 'name = "SKF 6208"\ndiametral_clearance_mm = 0.033').stdout)["inferred"]
    assert single["operating_diametral_clearance_um"][1] == pytest.approx(most)
    life = found["life_basic_duration_h"]
    assert 0.0 < life[0] < life[1]


BALLS = """
kind = "deep_groove"
bore_diameter_mm = 40
outside_diameter_mm = 80
ball_count = 9
ball_diameter_mm = 12.303
pitch_diameter_mm = 60
groove_radius_coefficient = 0.52
ball_material = "steel"
ring_material = "steel"
dynamic_load_rating_N = 32500
static_load_rating_N = 19000
"""


def test_a_class_may_stand_in_place_of_the_clearance_of_known_balls(tmp_path: Path) -> None:
    """With the range over the class alone."""
    loaded = "[operation]\nspeed_rpm = 3000\naxial_load_N = 300\n"
    name = "ring_effective_stiffness_axial_N_per_um"
    least, most = json.loads(solved(tmp_path, f'{BALLS}clearance_class = "C3"', loaded).stdout)["inferred"][name]
    for clearance, end in ((0.015, least), (0.033, most)):
        one = json.loads(solved(tmp_path, f"{BALLS}diametral_clearance_mm = {clearance}", loaded).stdout)
        stiffness = one["effective_stiffness"]["axial_N_per_um"]
        assert stiffness == pytest.approx(end, rel=1e-6)


def test_classes_of_clearance_and_of_tolerance_are_told_apart(tmp_path: Path) -> None:
    as_tolerance = OPERATION_OF_E_DRIVE.replace('"P6"', '"C3"')
    said = solved(tmp_path, 'name = "SKF 6208"', as_tolerance)
    assert said.exit_code == 2 and 'write clearance_class = "C3" in [bearing]' in said.output
    said = solved(tmp_path, 'name = "SKF 6208"\nclearance_class = "P5"')
    assert said.exit_code == 2 and "tolerance_class in [effects.ring_expansion]" in said.output
    said = solved(tmp_path, 'name = "SKF 7210 BECBP"\nclearance_class = "C3"')
    assert said.exit_code == 2 and "clearance_class" in said.output


@pytest.mark.parametrize("command", ["run", "catalogue"])
def test_a_number_in_place_of_a_file_is_told_where_it_goes(command: str) -> None:
    result = CliRunner().invoke(cli, [command, "SKF 6205"])
    assert result.exit_code == 2 and "[bearing] name = 'SKF 6205' is enough" in result.output
    light = CliRunner().invoke(cli, [command, "HSS71914C"])
    assert light.exit_code == 2 and "is enough" not in light.output
