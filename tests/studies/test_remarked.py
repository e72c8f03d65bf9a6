"""What a sweep remarks is what each of its points remarks by itself, counted; of many points it says how many are
looked at."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.results.remarks import every_remark
from qsbearing.studies import points as grid
from qsbearing.studies import remarked
from qsbearing.studies.chooser.choose_set import solve_any
from qsbearing.studies.keys import known
from qsbearing.studies.store import open_results
from qsbearing.studies.study import Study
from qsbearing.studies.sweep import sweep
from tests.cli.command import call

h5netcdf = pytest.importorskip("h5netcdf")

B218 = {"bearing": {"name": "B218"}, "operation": {"speed_rpm": 10000, "axial_load_N": 17800}}
BOTH = {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "outer"}
HELD = {
    "bearing": {"name": "7210C"},
    "operation": {"speed_rpm": 0, "radial_load_y_N": 100, "tilt_z_mrad": 0},
    "preload": {"rigid_N": 300},
    "effects": {"ring_expansion": {"bore_diameter_mm": 50, "outside_diameter_mm": 90, "inner_ring_temperature_C": 20}},
    "readings": {"overrun": {}, "static_safety": {}},
}
PAIR = {
    "operation": {"speed_rpm": 12000, "radial_load_y_N": 300, "moment_z_Nm": 0},
    "preload": {"rigid_N": 200},
    "rows": [
        {"bearing": {"name": "7210C"}, "position_mm": -10, "carries": "+x"},
        {"bearing": {"name": "7210C"}, "position_mm": 10, "carries": "-x"},
    ],
}
STUDIES: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "without effects": (B218, {"speed_rpm": "0:15000:7", "axial_load_N": [2000, 300000]}),
    "slip": (B218 | {"effects": BOTH}, {"speed_rpm": "0:15000:5", "axial_load_N": [-10, 300, 17800]}),
    "a preload that is lost": (HELD, {"inner_ring_temperature_C": "-100:150:9"}),
    "a pair": (PAIR, {"radial_load_y_N": "100:20000:6"}),
    "a pair under thrust": (PAIR, {"axial_load_N": [0, 300, 3000]}),
}


def in_file(of: dict[str, Any], values: dict[str, float]) -> dict[str, Any]:
    found = json.loads(json.dumps(of))
    for name, value in values.items():
        *tables, key = known(name).path
        table = found
        for each in tables:
            table = table[each]
        table[key] = value
    return found


def about(record: dict[str, Any]) -> tuple[Any, ...]:
    of = {name: value for name, value in record["of"].items() if name not in ("balls", "cases")}
    return record["code"], repr(sorted(of.items())), record["values"].get("effect")


def kept(results: Any) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(results.attrs["remarks"])
    return found


@pytest.mark.parametrize("name", STUDIES)
def test_a_sweep_counts_what_each_point_remarks_by_itself(name: str) -> None:
    of, vary = STUDIES[name]
    results = sweep(Study.of(of, vary))
    counts: Counter[Any] = Counter()
    places: dict[Any, list[dict[str, float]]] = {}
    flat = results["status"].stack(point=results["status"].dims)
    for point in flat.point.values:
        values = dict(zip(results["status"].dims, np.atleast_1d(np.array(point, object)).tolist(), strict=True))
        solution = solve_any(scene_or_set_of(in_file(of, values), "", ""))
        for each in {about(json.loads(json.dumps(each.record(remarked.IN_FILE)))) for each in every_remark(solution)}:
            counts[each] += 1
            places.setdefault(each, []).append(values)
    found = {about(each): each["of"]["cases"] for each in kept(results)}
    assert {key: cases["count"] for key, cases in found.items()} == counts
    assert len(counts) > 1, "or there is nothing to count"
    for key, cases in found.items():
        assert cases["of"] == int((results["status"] == 0).sum())
        assert cases["first"] == pytest.approx(places[key][0]) and cases["last"] == pytest.approx(places[key][-1])
        for variable in cases["least"]:
            values_there = [each[variable] for each in places[key]]
            assert (cases["least"][variable], cases["most"][variable]) == (min(values_there), max(values_there))
        assert cases["at"] in places[key]


@pytest.mark.parametrize("name", ["a preload that is lost", "a pair under thrust"])
def test_a_preload_falls_at_the_same_points_where_there_are_too_many_to_solve_again(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The load on the rings is known there too."""

    def fallen() -> list[tuple[str, Any]]:
        found = kept(sweep(Study.of(*STUDIES[name])))
        return [(each["code"], each["of"]) for each in found if each["code"] in ("preload_lost", "preload_reduced")]

    few = fallen()
    monkeypatch.setattr(remarked, "MOST_CASES", 0)
    assert fallen() == few and few


def test_chunks_on_the_disk_are_counted_together(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    study = Study.of(B218, {"speed_rpm": "0:15000:30", "axial_load_N": "2000:300000:3"}, quantities=["inner_load_max"])
    whole = sweep(study)
    monkeypatch.setattr(grid, "CHUNK", 12)
    with sweep(study, out=tmp_path / "parts.nc") as parts:
        assert kept(parts) == kept(whole)
    with open_results(tmp_path / "parts.nc") as again:
        assert kept(again) == kept(whole) and kept(whole)
        assert again.attrs["remarks_looked_at"] == again.attrs["remarks_of_points"] == 90


def test_of_many_points_some_are_looked_at_and_it_is_said() -> None:
    count = 3 * remarked.LOOKED_AT
    study = Study.of(B218, {"speed_rpm": f"0:15000:{count}"}, quantities=["inner_load_max"])
    results = sweep(study)
    assert results.attrs["remarks_looked_at"] == remarked.LOOKED_AT
    (missing,) = (each for each in kept(results) if each["code"] == "effects_missing")
    share = missing["of"]["cases"]["count"] / missing["of"]["cases"]["of"]
    fast = missing["of"]["cases"]["least"]["speed_rpm"]
    assert share == pytest.approx(1.0 - fast / 15000, abs=0.01)  # all above some speed, and no others
    assert "of the 1,024 points looked at" in missing["text"]
    said = " ".join(each.text for each in remarked.of_results(results.attrs))
    assert "1,024 of 3,072 points are looked at" in said


def test_points_that_are_looked_at_are_different_and_spread_over_all() -> None:
    for count in (1, 64, 1024, 1025, 3000, 16384):
        looked = remarked.looked_at(count)
        assert len(set(looked.tolist())) == looked.size == min(count, remarked.LOOKED_AT)
        assert looked[0] <= count / looked.size and looked[-1] >= count - 1 - count / looked.size
        assert (np.diff(looked) <= 2 * np.ceil(count / looked.size)).all()


def test_results_do_not_depend_on_which_points_are_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    study = Study.of(
        B218 | {"effects": BOTH}, {"speed_rpm": "0:15000:50"}, quantities=["outer_load_max", "inner_angle_max"]
    )
    whole = sweep(study)
    monkeypatch.setattr(remarked, "LOOKED_AT", 7)
    some = sweep(study)
    for name in whole.data_vars:
        if name not in ("residual", "iterations"):
            np.testing.assert_allclose(some[name].values, whole[name].values, rtol=1e-9)


@pytest.mark.parametrize("kept", ['[{"code": "slip', '[{"code": "slip"}]', "[1]", '{"a": 1}'])
@pytest.mark.parametrize("command", ["run", "plot"])
def test_remarks_that_a_damaged_file_kept_are_refused(command: str, kept: str, tmp_path: Path) -> None:
    made = tmp_path / "r.nc"
    sweep(Study.of("b218", {"speed_rpm": [0, 10_000]}), out=made).close()
    with h5netcdf.File(made, "a") as file:
        file.attrs["remarks"] = kept
    ran = call(command, str(made))
    assert ran.exit_code == 2 and "damaged" in ran.stderr
