"""Four-point bearings by the keys of a file: shims or clearance, there and back, and every fault at once."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli, main
from qsbearing.files.scene_file import scene_of
from qsbearing.files.scene_tables import input_tables

BEARING: dict[str, Any] = {
    "kind": "four_point", "ball_count": 16, "ball_diameter_mm": 22.225, "pitch_diameter_mm": 125.26,
    "groove_radius_coefficient": 0.52, "free_contact_angle_deg": 35, "ball_material": "steel", "ring_material": "steel",
}  # fmt: skip
EFFECTS = {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "friction"}
OPERATION = {"speed_rpm": 10_000.0, "axial_load_N": 5000.0}


def tables(**bearing: Any) -> dict[str, Any]:
    return {"bearing": BEARING | bearing, "operation": OPERATION, "effects": EFFECTS}


def test_a_clearance_and_its_shims_make_one_bearing() -> None:
    by_clearance = scene_of(tables(axial_clearance_mm=0.12), "a file")
    shims = {
        f"{side}_shim_mm": 1e3 * float(getattr(by_clearance.bearing, f"{side}_shim")) for side in ("inner", "outer")
    }
    by_shims = scene_of(tables(**shims), "a file")
    assert by_clearance.bearing.inner_shim == pytest.approx(by_shims.bearing.inner_shim, rel=1e-15)
    assert by_shims.bearing.axial_clearance == pytest.approx(120e-6, rel=1e-11)
    one_ring = scene_of(tables(inner_shim_mm=0.4), "a file").bearing
    assert one_ring.outer_shim is None and one_ring.inner_shim == pytest.approx(0.4e-3)


@pytest.mark.parametrize("given", [{"axial_clearance_mm": 0.12}, {"inner_shim_mm": 0.4}, {"axial_clearance_mm": -0.01}])
def test_tables_come_back(given: dict[str, float]) -> None:
    scene = scene_of(tables(**given), "a file")
    again = scene_of(input_tables(scene), "a file")
    assert again.bearing == scene.bearing
    assert "axial_clearance_mm" not in input_tables(scene)["bearing"]
    assert "inner_shim_mm" not in input_tables(qs.load_scene("b218"))["bearing"]


@pytest.mark.parametrize(
    ("changed", "keys"),
    [
        ({}, ["bearing.inner_shim_mm"]),
        ({"axial_clearance_mm": 0.12, "outer_shim_mm": 0.4}, ["bearing.outer_shim_mm"]),
        ({"axial_clearance_mm": 12.0, "ball_count": 0}, ["bearing.ball_count", "bearing.axial_clearance_mm"]),
        ({"inner_shim_mm": -0.4, "outer_shim_mm": 0.9}, ["bearing.inner_shim_mm"]),
        ({"inner_shim_mm": 0.9, "outer_shim_mm": 0.95}, ["bearing.inner_shim_mm", "bearing.outer_shim_mm"]),
        ({"kind": "deep_groove", "inner_shim_mm": 0.4}, ["bearing.inner_shim_mm"]),
        ({"kind": "angular_contact", "axial_clearance_mm": 0.1}, ["bearing.axial_clearance_mm"]),
        ({"inner_shim_mm": 0.4, "diametral_clearance_mm": 0.1}, ["bearing.diametral_clearance_mm"]),
    ],
)
def test_faults_are_told_at_once_by_their_keys(changed: dict[str, Any], keys: list[str]) -> None:
    with pytest.raises(qs.SceneFileError) as caught:
        scene_of(tables(**changed), "a file")
    assert [each.key for each in caught.value.errors] == keys  # type: ignore[attr-defined]


TEXT = """
bearing = {kind = "four_point", ball_count = 16, ball_diameter_mm = 22.225, pitch_diameter_mm = 125.26,
 groove_radius_coefficient = 0.52, free_contact_angle_deg = 35, axial_clearance_mm = 0.12, ball_material = "steel",
 ring_material = "steel"}
operation = {speed_rpm = 10000, axial_load_N = 5000}
effects = {ball = ["centrifugal_force", "gyroscopic_moment"], raceway_control = "friction",
 traction = {friction_coefficient = 0.06}}
readings.life = true
""".replace(",\n ", ", ")


@pytest.fixture
def file(tmp_path: Path) -> str:
    path = tmp_path / "qj.toml"
    path.write_text(TEXT, encoding="utf-8")
    return str(path)


def test_run_shows_both_arcs(file: str) -> None:
    shown = CliRunner().invoke(cli, ["run", file])
    assert shown.exit_code == 0, shown.output
    for words in (
        "four point",
        "axial clearance 120",
        "Opposite arcs: Contacts",
        "contacts of the opposite arcs",
        "apex",
    ):
        assert words in shown.output, words
    said = json.loads(CliRunner().invoke(cli, ["run", file, "--json"]).stdout)
    assert said["balls"][0]["opposite"]["outer"]["load_N"] == pytest.approx(280.98, abs=0.05)
    assert said["readings"]["life"]["outer_life_Mrev"] > 0.0 and said["readings"]["life"]["equivalent_load_N"] is None
    assert said["axial_from_middle_um"] == pytest.approx(said["displacement"]["axial_um"] + 60.0, abs=1e-9)


def test_a_sweep_takes_names_of_opposite_arcs(file: str) -> None:
    names = ["-y", "outer_opposite_load_max", "-y", "outer_opposite_traction_heat_max"]
    shown = CliRunner().invoke(cli, ["sweep", file, "--vary", "axial_clearance_mm=0.02:0.2:3", *names])
    assert shown.exit_code == 0, shown.output
    assert "outer_opposite_load_max" in shown.output and "converged" in shown.output


@pytest.mark.parametrize("command", ["explain", "cost", "compare", "report"])
def test_doors_that_know_one_contact_a_ring_refuse_it_by_name(
    command: str, file: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    more = {"compare": [file], "report": ["--out", str(tmp_path / "out")]}.get(command, [])
    monkeypatch.setattr(sys, "argv", ["qsbearing", command, file, *more])
    with pytest.raises(SystemExit) as ended:
        main()
    said = capsys.readouterr().err
    assert ended.value.code == 2, said
    assert "'four_point'" in said and f"`{command}` does not know" in said and "Traceback" not in said
    assert not [*(tmp_path / "out").glob("*")]


def test_rows_and_hypotheses_refuse_it(tmp_path: Path) -> None:
    path = tmp_path / "set.toml"
    rows = 'rows = [{position_mm = 0, carries = "+x"}, {position_mm = 50, carries = "-x"}]\n'
    path.write_text("\n".join(line for line in TEXT.split("\n") if "readings" not in line) + rows, encoding="utf-8")
    ended = CliRunner().invoke(cli, ["run", str(path)])
    assert ended.exit_code == 2 and "row 1.bearing: is a four-point bearing" in ended.output
    outer = TEXT.replace('"friction"', '"outer"').replace(", traction = {friction_coefficient = 0.06}", "")
    path.write_text(outer, encoding="utf-8")
    ended = CliRunner().invoke(cli, ["run", str(path)])
    assert ended.exit_code == 2 and 'must be "friction" for a four-point bearing' in ended.output


def test_it_cannot_be_inferred_from_a_data_sheet() -> None:
    sheet = {"kind": "four_point", "bore_diameter_mm": 50, "outside_diameter_mm": 90, "dynamic_load_rating_N": 60000,
             "static_load_rating_N": 50000, "free_contact_angle_deg": 35}  # fmt: skip
    with pytest.raises(qs.SceneFileError) as caught:
        scene_of({"bearing": sheet, "operation": {"axial_load_N": 100.0}}, "a file", may_infer=True)
    assert "bearing.kind" in [each.key for each in caught.value.errors]  # type: ignore[attr-defined]


def test_the_page_of_the_app_refuses_it() -> None:
    from qsbearing.app import answers

    with pytest.raises(qs.SceneError, match="this page does not know"):
        answers.checked(tables(axial_clearance_mm=0.12), "a file")
