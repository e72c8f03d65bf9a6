"""Scene files whose bearing is a data sheet, typed as printed: one command gives ranges."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

import qsbearing as qs
from qsbearing.cli import cli

# Rows of the tables beside; ball sets as far as they are printed or known. SNFA prints kgf.
PRINTED: dict[str, tuple[str, tuple[int, float]]] = {
    "GMN S 6210 C TA": (
        'bore_diameter_mm = 50\noutside_diameter_mm = 90\nwidth_mm = 20\nfree_contact_angle_deg = 15\nmaker = "GMN"\n'
        "dynamic_load_rating_N = 47500\nstatic_load_rating_N = 37000",
        (15, 12.7),
    ),
    "GMN S 6210 E TA": (
        'bore_diameter_mm = 50\noutside_diameter_mm = 90\nwidth_mm = 20\nfree_contact_angle_deg = 25\nmaker = "GMN"\n'
        "dynamic_load_rating_N = 45000\nstatic_load_rating_N = 35500\n"
        "pair_rigidity_N_per_um = 271\npair_preload_N = 1140",
        (15, 12.7),
    ),
    "GMN HY S 61914 C TA": (
        'bore_diameter_mm = 70\noutside_diameter_mm = 100\nwidth_mm = 16\nfree_contact_angle_deg = 15\nmaker = "GMN"\n'
        'dynamic_load_rating_N = 24400\nstatic_load_rating_N = 18200\nball_material = "silicon nitride"',
        (24, 7.9375),
    ),
    "SNFA SEB 50": (
        'bore_diameter_mm = 50\noutside_diameter_mm = 72\nwidth_mm = 12\nfree_contact_angle_deg = 15\nmaker = "SNFA"\n'
        "dynamic_load_rating_N = 18878\nstatic_load_rating_N = 20692\n"
        "dynamic_rating_factor = 1.0\nstatic_rating_factor = 1.248",
        (21, 7.14375),
    ),
    "SNFA VEB 50": (
        'bore_diameter_mm = 50\noutside_diameter_mm = 72\nwidth_mm = 12\nfree_contact_angle_deg = 25\nmaker = "SNFA"\n'
        "dynamic_load_rating_N = 12160\nstatic_load_rating_N = 9611\n"
        "dynamic_rating_factor = 0.681\nstatic_rating_factor = 0.613",
        (21, 7.14375),
    ),
    "SKF 6305": (
        'bore_diameter_mm = 25\noutside_diameter_mm = 62\nwidth_mm = 17\nkind = "deep_groove"\nmaker = "SKF"\n'
        "dynamic_load_rating_N = 23400\nstatic_load_rating_N = 11600\nf0 = 12\ndiametral_clearance_mm = 0.01",
        (7, 11.509375),
    ),
    "SKF 7210 BEP": (
        'bore_diameter_mm = 50\noutside_diameter_mm = 90\nwidth_mm = 20\nfree_contact_angle_deg = 40\nmaker = "SKF"\n'
        "dynamic_load_rating_N = 37700\nstatic_load_rating_N = 28500",
        (14, 13.096875),
    ),
    "NSK 6305": (
        'bore_diameter_mm = 25\noutside_diameter_mm = 62\nwidth_mm = 17\nkind = "deep_groove"\nmaker = "NSK"\n'
        "dynamic_load_rating_N = 20600\nstatic_load_rating_N = 11200\nf0 = 13.2\ndiametral_clearance_mm = 0.01",
        (8, 10.31875),
    ),
    "NTN 7010UCG": (
        'name = "7010C"\nmaker = "NTN"\ndynamic_load_rating_N = 26900\nstatic_load_rating_N = 23100\n'
        "pair_rigidity_N_per_um = 70.5\npair_preload_N = 157",
        (20, 8.73125),
    ),
    "NTN 7914UCG": (
        'bore_diameter_mm = 70\noutside_diameter_mm = 100\nwidth_mm = 16\nfree_contact_angle_deg = 15\nmaker = "NTN"\n'
        "dynamic_load_rating_N = 29700\nstatic_load_rating_N = 30000",
        (25, 8.73125),
    ),
}
SEVERAL = PRINTED["SKF 7210 BEP"][0]
"""Of six ball sets."""
LOADED = "[operation]\naxial_load_N = 300\n"
STIFFNESS = "ring_effective_stiffness_axial_N_per_um"


def scene(tmp_path: Path, bearing: str, rest: str = LOADED) -> str:
    """A file with this [bearing]."""
    file = tmp_path / "scene.toml"
    file.write_text(f"[bearing]\n{bearing}\n{rest}", encoding="utf-8")
    return str(file)


def run(tmp_path: Path, bearing: str, *options: str, rest: str = LOADED) -> Result:
    """`qsbearing run` of it."""
    file = scene(tmp_path, bearing, rest)
    result = CliRunner().invoke(cli, ["run", file, *options])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exc_info
    return result


def ball_sets(found: dict[str, Any]) -> list[tuple[int, float]]:
    return [(each["ball_count"], each["ball_diameter_mm"]) for each in found["ball_sets"]]


@pytest.mark.parametrize("name", PRINTED)
def test_a_data_sheet_as_printed_gives_an_answer_with_its_range(name: str, tmp_path: Path) -> None:
    bearing, known = PRINTED[name]
    result = run(tmp_path, bearing, "--json")
    assert result.exit_code == 0, result.output
    found = json.loads(result.stdout)
    assert known in ball_sets(found)
    least, most = found["inferred"][STIFFNESS]
    assert 0.0 < least < most < 2.0 * least
    numbers = {each["number"] for each in found["ball_sets"]}
    assert all(set(ends) <= numbers for ends in found["inferred_ends"].values())
    best = found["effective_stiffness"]["axial_N_per_um"]
    assert least <= best <= most, "beside the ranges stand the results of the set that fits best"


def test_text_and_csv_say_what_is_inferred(tmp_path: Path) -> None:
    text = run(tmp_path, PRINTED["GMN S 6210 C TA"][0], "--csv", str(tmp_path / "balls.csv")).output
    assert "from its data sheet: " in text and "inferred" in text and "rigidity" in text
    assert "often is not the true" in text
    with (tmp_path / "balls.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    sets = {(row["ball_count"], row["ball_diameter_mm"]) for row in rows}
    assert len(rows) == 3 * sum(float(count) for count, _ in sets) and len(sets) > 1, "all balls of the list"
    plain = run(tmp_path, PRINTED["NTN 7010UCG"][0]).output
    assert "rigidity" not in plain, "which is given"


def test_json_is_run_again(tmp_path: Path) -> None:
    first = run(tmp_path, PRINTED["SKF 7210 BEP"][0], "--json").stdout
    (tmp_path / "first.json").write_text(first, encoding="utf-8")
    again = CliRunner().invoke(cli, ["run", str(tmp_path / "first.json"), "--json"]).stdout
    assert json.loads(again)["inferred"] == json.loads(first)["inferred"]
    assert json.loads(again)["input"] == json.loads(first)["input"]


def test_python_has_a_case_of_each(tmp_path: Path) -> None:
    loaded = qs.load_scene(scene(tmp_path, PRINTED["SKF 7210 BEP"][0]))
    solution = qs.solve(loaded)
    assert solution.shape == loaded.bearing.inferred.misfit.shape and solution.converged.all()
    assert loaded.bearing.outline is not None and loaded.bearing.outline.width == 0.02


PROPORTIONS = "bore_diameter_mm = 70\noutside_diameter_mm = 110\nwidth_mm = 20\nfree_contact_angle_deg = 15"
LIGHT = (  # GMN KH 61914 C TA
    "bore_diameter_mm = 70\noutside_diameter_mm = 100\nfree_contact_angle_deg = 17\n"
    "dynamic_load_rating_N = 13100\nstatic_load_rating_N = 10600"
)


@pytest.mark.parametrize(
    ("bearing", "said"),
    [
        (PROPORTIONS, ["dynamic_load_rating_N: missing", "static_load_rating_N: missing", "8 times off"]),
        (LIGHT, ["dynamic_load_rating_N = 13100 N: cannot be read", 'rating_practice = "iso"', "SNFA"]),
        (LIGHT + '\nmaker = "GMN"', ["static_load_rating_N = 10600 N: no ball set", "series_factors"]),
        (LIGHT + '\nmaker = "SNFA"', ["dynamic_rating_factor: missing", "static_rating_factor: missing"]),
        (LIGHT + '\nrating_practice = "isso"', ["Did you mean iso?"]),
        (LIGHT + '\nmaker = "NSK"\npair_preload_N = 100', ["pair_rigidity_N_per_um: missing"]),
        (LIGHT + "\ninner_groove_radius_mm = 4", ["groove_radius_coefficient"]),
        (LIGHT.replace("17", "1.7e3"), ["free_contact_angle_deg = 1700 deg"]),
        ('name = "B218"\npair_preload_N = 157\nmaker = "NTN"', ["1 error", "pair_preload_N = 157: has no use"]),
    ],
    ids=["proportions", "light balls", "own grooves", "factors", "a word", "half", "radius", "angle", "named"],
)
def test_what_cannot_be_known_is_asked_for(bearing: str, said: list[str], tmp_path: Path) -> None:
    result = run(tmp_path, bearing)
    assert result.exit_code == 2
    for each in said:
        assert each in result.output, result.output


SET = (
    '[operation]\n[preload]\nrigid_N = 300\n[[rows]]\nposition_mm = 0\ncarries = "+x"\n'
    '[[rows]]\nposition_mm = 20\ncarries = "-x"\n'
)


@pytest.mark.parametrize("option", ["--accuracy", "--plot"])
def test_what_takes_one_bearing_says_how_to_choose_one(option: str, tmp_path: Path) -> None:
    bearing, _ = PRINTED["NTN 7914UCG"]
    given = {"--accuracy": "1e-3", "--plot": str(tmp_path / "out.png")}[option]
    result = CliRunner().invoke(cli, ["run", scene(tmp_path, bearing), option, given])
    assert result.exit_code == 2 and "allows several ball sets" in result.output, result.output


@pytest.mark.parametrize("command", ["explain", "report", "sweep", "find", "run"])
def test_other_commands_solve_the_best_set_and_print_the_range_over_the_others(command: str, tmp_path: Path) -> None:
    """Of a set both rows have the same bearing."""
    rest = SET if command == "run" else LOADED
    file, out = scene(tmp_path, SEVERAL, rest), str(tmp_path / "out")
    more = {
        "report": ["--out", out],
        "sweep": ["--vary", "axial_load_N=300,600"],
        "find": ["--vary", "axial_load_N=100:1000", "--maximise", "inner_load_max"],
    }.get(command, [])
    result = CliRunner().invoke(cli, [command, file, *more])
    assert result.exit_code == 0, result.output
    said = result.output if command != "report" else (tmp_path / "out" / "scene_report.html").read_text("utf-8")
    assert "ball set 1 of 6, the best fit" in said and "Range over all 6 ball sets" in said
    assert ("rows 1 and 2" in said) == (command == "run")


def test_the_range_of_a_set_is_that_over_its_chosen_ball_sets(tmp_path: Path) -> None:
    """Solved one by one with `ball_set`, at the usual groove radius, all lie within; the first is the one run."""
    listed = json.loads(run(tmp_path, SEVERAL, "--json", rest=SET).stdout)
    (other,) = listed["other_ball_sets"]
    assert other["rows"] == [1, 2] and other["ball_sets"] == 6
    least, most = other["inferred"]["shaft_effective_stiffness_axial_N_per_um"]
    single = []
    for number in range(1, 7):
        one = json.loads(run(tmp_path, f"{SEVERAL}\nball_set = {number}", "--json", rest=SET).stdout)
        assert "other_ball_sets" not in one
        single.append(one["effective_stiffness"]["axial_N_per_um"])
    assert single[0] == listed["effective_stiffness"]["axial_N_per_um"]
    assert least < min(single) < max(single) < most


def test_standard_input_and_tables_of_points_say_which_set_is_solved(tmp_path: Path) -> None:
    text = Path(scene(tmp_path, SEVERAL, SET)).read_text(encoding="utf-8")
    piped = CliRunner().invoke(cli, ["run", "-"], input=text)
    assert piped.exit_code == 0 and "Range over all 6 ball sets" in piped.output
    (tmp_path / "points.csv").write_text("axial_load_N\n300\n600\n", encoding="utf-8")
    points = run(tmp_path, SEVERAL, "--points", str(tmp_path / "points.csv"), "--out", str(tmp_path / "out.csv"))
    assert points.exit_code == 0 and "ball set 1 of 6, the best fit" in points.stderr


def test_rows_of_two_numbers_have_a_range_each(tmp_path: Path) -> None:
    rows = SET.replace('carries = "-x"\n', 'carries = "-x"\n[rows.bearing]\nname = "SKF 7211 BEP"\n')
    listed = json.loads(run(tmp_path, 'name = "SKF 7210 BECBP"', "--json", rest=rows).stdout)
    assert [each["rows"] for each in listed["other_ball_sets"]] == [[1], [2]]
    for each in listed["other_ball_sets"]:
        least, most = each["inferred"]["shaft_effective_stiffness_axial_N_per_um"]
        assert least < listed["effective_stiffness"]["axial_N_per_um"] < most


def test_a_spectrum_says_which_set_it_solves(tmp_path: Path) -> None:
    rest = LOADED + "[[spectrum]]\nshare = 1\nspeed_rpm = 1000\n[readings.life]\n"
    result = run(tmp_path, SEVERAL, rest=rest)
    assert result.exit_code == 0, result.output
    assert "ball set 1 of 6, the best fit" in result.output


def test_python_is_warned_of_the_set_that_it_gets(tmp_path: Path) -> None:
    with pytest.warns(UserWarning, match="ball set 1 of 6, the best fit"):
        loaded = qs.load_set(scene(tmp_path, SEVERAL, SET))
    assert all("ball set 1 of 6" in row.bearing.name for row in loaded.rows)


def test_one_bearing_is_chosen_as_the_refusal_says(tmp_path: Path) -> None:
    bearing, _ = PRINTED["NTN 7914UCG"]
    refused = run(tmp_path, bearing, "--accuracy", "1e-3").output
    lines = refused.partition("fit best with ")[2].partition(", which often")[0].replace(", ", "\n")
    one = f'{bearing}\n{lines}\nball_material = "steel"\nring_material = "steel"'
    assert run(tmp_path, one).exit_code == 0


def test_unsolved_bearings_of_the_list_are_said(tmp_path: Path) -> None:
    bearing, _ = PRINTED["NTN 7914UCG"]
    result = run(tmp_path, bearing, "--json", rest="[operation]\naxial_load_N = -10\n")
    assert result.exit_code == 1
    found = json.loads(result.stdout)
    assert found["inferred"] == {} and found["status"] == "no_equilibrium"
    assert any("are not solved" in each for each in found["warnings"])
    assert np.isfinite(found["ball_sets"][0]["misfit"])


def test_a_chosen_ball_set_is_one_of_the_list(tmp_path: Path) -> None:
    """With the results that `run` has for it in its list, and a name that says which it is."""
    listed = qs.load_scene(scene(tmp_path, SEVERAL)).bearing
    sets = int(listed.inferred.set_number[-1]) + 1
    assert sets > 2
    for number in range(1, sets + 1):
        one = qs.load_scene(scene(tmp_path, f"{SEVERAL}\nball_set = {number}")).bearing
        case = int(np.flatnonzero(listed.inferred.set_number == number - 1)[0])
        for name in ("ball_count", "ball_diameter", "inner_groove_radius", "pitch_diameter", "free_contact_angle"):
            assert getattr(one, name) == np.broadcast_to(getattr(listed, name), listed.inferred.misfit.shape)[case]
        assert one.inferred is None
        assert f"ball set {number} of {sets}" in one.name
        assert one.outline == listed.outline


@pytest.mark.parametrize("number", ["0", "1.5", "25"])
def test_a_ball_set_that_is_not_on_the_list_is_refused(number: str, tmp_path: Path) -> None:
    result = run(tmp_path, f"{SEVERAL}\nball_set = {number}")
    assert result.exit_code == 2
    assert f"bearing.ball_set = {number}" in result.stderr
    given = run(tmp_path, 'name = "7210C"\nball_set = 1')
    assert given.exit_code == 2
    assert "bearing.ball_set" in given.stderr and "has no use" in given.stderr


def test_a_sweep_takes_a_chosen_ball_set_and_varies_none(tmp_path: Path) -> None:
    file, out = scene(tmp_path, f"{SEVERAL}\nball_set = 2"), tmp_path / "out.csv"
    swept = CliRunner().invoke(cli, ["sweep", file, "--vary", "axial_load_N=300,600", "--out", str(out)])
    assert swept.exit_code == 0, swept.output
    with out.open(encoding="utf-8") as table:
        assert {row["axial_load_N"] for row in csv.DictReader(table)} == {"300.0", "600.0"}
    refused = CliRunner().invoke(cli, ["sweep", file, "--vary", "bearing.ball_set=1,2"])
    assert refused.exit_code == 2
    assert "is not a numeric key of a scene" in refused.stderr
