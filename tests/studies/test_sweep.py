"""A sweep is what its points are alone; impossible points stay; files, executors and resuming change nothing."""

from __future__ import annotations

import copy
import subprocess
import sys
from concurrent.futures import ALL_COMPLETED, FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.result_names import reading_of
from qsbearing.files.scene_file import document_of, scene_of
from qsbearing.studies import chunk as chunks
from qsbearing.studies import dataset, keys, points
from qsbearing.studies import sweep as sweeping
from qsbearing.studies.points import Points
from qsbearing.studies.store import Store
from qsbearing.studies.study import Study
from qsbearing.studies.sweep import sweep

xarray = pytest.importorskip("xarray")

B218 = {"bearing": {"name": "B218"}, "operation": {"axial_load_N": 8000, "speed_rpm": 9000}}
COMBINED = copy.deepcopy(B218) | {
    "operation": {
        "axial_load_N": 8000.0,
        "speed_rpm": 9000,
        "radial_load_y_N": 3000,
        "tilt_z_mrad": 0,
        "tilt_y_mrad": 0,
    },
    "effects": {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "outer"},
}
RINGS = copy.deepcopy(COMBINED)
RINGS["effects"]["ring_expansion"] = {
    "bore_diameter_mm": 90.0,
    "outside_diameter_mm": 160.0,
    "shaft_interference_um": 5.0,
    "shaft_bore_diameter_mm": 20.0,
    "housing_interference_um": 0.0,
    "housing_outside_diameter_mm": 200.0,
    "inner_ring_temperature_C": 60.0,
}
RINGS["effects"]["ball_expansion"] = {"ball_temperature_C": 50.0}
SEAT = {"elastic_modulus_GPa": 208.0, "poisson_ratio": 0.3}
ELASTIC = copy.deepcopy(COMBINED)
ELASTIC["effects"]["elastic_rings"] = {
    "outer": {
        "outside_diameter_mm": 160.0,
        "width_mm": 30.0,
        "shoulder_diameter_mm": 130.0,
        "open_diameter_mm": 144.0,
        "housing": {"outside_diameter_mm": 200.0, **SEAT},
    },
    "inner": {
        "bore_diameter_mm": 90.0,
        "width_mm": 30.0,
        "shoulder_diameter_mm": 118.0,
        "open_diameter_mm": 106.0,
        "shaft": {"bore_diameter_mm": 20.0, **SEAT},
    },
}
WITHOUT_TEMPERATURES = {"ring_expansion": {"bore_diameter_mm": 90.0, "outside_diameter_mm": 160.0}}
ESTIMATE = {
    "lubricant": {"iso_viscosity_grade": 68.0, "oil_temperature_C": 70.0},
    "friction_estimate": {"bore_diameter_mm": 90.0, "outside_diameter_mm": 160.0},
}


def document_with(document: dict, path: tuple[str, ...], value: float) -> dict:
    changed = copy.deepcopy(document)
    table = changed
    *tables, last = ".".join(path).split(".")
    for step in tables:
        table = table.setdefault(step, {})
    table[last] = value
    return changed


def test_points_are_their_single_solves() -> None:
    results = sweep(Study.of(COMBINED, {"speed_rpm": "0:15000:4", "axial_load_N": "2000,17800"}))
    assert results["inner_angle"].dims == ("speed_rpm", "axial_load_N", "ball")
    for speed in (0.0, 5000.0, 15000.0):
        document = document_with(COMBINED, ("operation", "speed_rpm"), speed)
        document["operation"]["axial_load_N"] = 17800
        alone = qs.solve(scene_of(document, ""))
        point = results.sel(speed_rpm=speed, axial_load_N=17800)
        np.testing.assert_allclose(point["inner_angle"], alone.inner.angle / qs.deg, rtol=1e-10)
        np.testing.assert_allclose(point["outer_load"], alone.outer.load, rtol=1e-10)
        np.testing.assert_allclose(point["ring_displacement_axial"], alone.displacement[0] / qs.um, rtol=1e-9)
        stiffness = alone.locked_stiffness[1] * qs.um
        np.testing.assert_allclose(point["ring_locked_stiffness_radial_y"], stiffness, rtol=1e-10)


MOVED = {
    "bearing": {"name": "B218"},
    "operation": {"speed_rpm": 3000, "axial_load_N": 9000.0},
    "effects": {
        "ball": ["centrifugal_force", "gyroscopic_moment"],
        "raceway_control": "friction",
        "traction": {
            **{"friction_coefficient": 0.07, "slip_speed_m_s": 0.1, "cage_drag_N": 1.0, "drag_coefficient": 1.0},
            "fluid_density_kg_m3": 20.0,
        },
    },
}
"""By friction."""
OF_ARCHES = {
    "bearing": {
        "kind": "four_point", "ball_material": "steel", "ring_material": "steel",
        "ball_count": 16, "ball_diameter_mm": 22.225, "pitch_diameter_mm": 125.26,
        "inner_groove_radius_mm": 11.557, "outer_groove_radius_mm": 11.557, "free_contact_angle_deg": 35,
    },
    "operation": {"speed_rpm": 8000, "axial_load_N": 3000},
    "effects": {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "friction"},
}  # fmt: skip
"""Between arched rings, whose shims or clearance are to be added."""
ARCHED = {
    "inner_shim_mm": {"inner_shim_mm": 0.4, "outer_shim_mm": 0.45},
    "outer_shim_mm": {"inner_shim_mm": 0.4, "outer_shim_mm": 0.45},
    "axial_clearance_mm": {"axial_clearance_mm": 0.12},
}
CANNOT_STAND_ALONE = {
    "first_ball_azimuth_deg": 3.0,
    "outer_speed_rpm": 100.0,
    "yield_strength_MPa": 2000.0,
    "reference_temperature_C": 25.0,
    "friction_coefficient": 0.05,
    "spring_N": 5000.0,
    "rigid_N": 5000.0,
}
"""Values of keys that the scene leaves out."""


OF_READINGS = [name for name, key in keys.ALL.items() if key.path[0] == "readings"]
IN_PAIRS = [key.name for key in keys.RACEWAYS]
"""Which vary only where a file has both."""


@pytest.mark.parametrize("name", [name for name in keys.ALL if name not in (*OF_READINGS, *IN_PAIRS)])
def test_every_numeric_key_of_a_scene_can_vary(name: str) -> None:
    """Two values of each key: the scene's own, a little changed, give what two files give."""
    key = keys.ALL[name]
    document: Any = ELASTIC if "elastic_rings" in key.path else MOVED if "traction" in key.path else RINGS
    if name in ARCHED:
        document = OF_ARCHES | {"bearing": OF_ARCHES["bearing"] | ARCHED[name]}  # type: ignore[operator]
    if name.endswith("_lobe_phase_deg"):  # which is nothing without its amplitude
        lobes = {name.replace("phase_deg", "amplitude_um"): 3.0}
        document = RINGS | {"effects": RINGS.get("effects", {}) | {"seats_out_of_round": lobes}}
    if key.path[-1].startswith("thermal_expansion"):
        value = 11e-6
    elif name in keys.COEFFICIENTS:
        value = 0.53
    else:
        value = _own_value(document, key.path, name)
    values = [value, value + 1.0] if name == "ball_count" else [value, 1.01 * value if value else 1.0]
    results = sweep(Study.of(document, {name: values}, quantities=["inner_load"]))
    assert (results["status"] == 0).all(), results["reason"].attrs
    for given, found in zip(values, results["inner_load"], strict=True):
        alone = document_with(_with_tables(document, key), key.path, given)
        for path in key.replaces:
            alone.get(path.partition(".")[0], {}).pop(path.rpartition(".")[2], None)
        for radius in keys.COEFFICIENTS.get(name, ()):  # the file has it as a length
            alone["bearing"].pop(name, None)
            alone["bearing"][radius] = given * 22.225
        solution = qs.solve(scene_of(alone, ""))
        np.testing.assert_allclose(found[: solution.inner.load.size], solution.inner.load, rtol=1e-8, atol=1e-6)


def test_a_raceway_diameter_can_vary() -> None:
    bearing = {"name": "B218", "inner_raceway_diameter_mm": 102.8, "outer_raceway_diameter_mm": 147.7264}
    document = {"bearing": bearing, "operation": {"axial_load_N": 1000.0}}
    diameters = [102.75, 102.8]
    results = sweep(
        Study.of(document, {"inner_raceway_diameter_mm": diameters}, quantities=["ring_displacement_axial"])
    )
    for given, found in zip(diameters, results["ring_displacement_axial"], strict=True):
        alone = qs.solve(scene_of(document | {"bearing": bearing | {"inner_raceway_diameter_mm": given}}, ""))
        assert float(found) == pytest.approx(alone.displacement[0] / qs.um, rel=1e-9)


def _own_value(document: dict, path: tuple[str, ...], name: str) -> float:
    table = document
    *tables, last = ".".join(path).split(".")
    for step in tables:
        table = table.get(step, {}) if isinstance(table.get(step), dict) else {}
    bearing = qs.load_scene("b218").bearing
    known = {
        "ball_count": 14.0,
        "diametral_clearance_mm": 0.48,
        "elastic_modulus_GPa": 208.0,
        "poisson_ratio": 0.3,
        "density_kg_m3": 7800.0,
        "free_contact_angle_deg": 40.0,
        "shaft_temperature_C": 40.0,
        "outer_ring_temperature_C": 45.0,
        "housing_temperature_C": 30.0,
        **CANNOT_STAND_ALONE,
    }
    for each in ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius"):
        known[f"{each}_mm"] = getattr(bearing, each) / qs.mm
    return float(table.get(last, known.get(last, 0.0)))


def _with_tables(document: dict, key: keys.StudyKey) -> dict:
    """A material by its numbers, where one of them varies."""
    changed = copy.deepcopy(document)
    for side in ("ball_material", "ring_material"):
        if side in key.path:
            changed["bearing"][side] = {
                **{"elastic_modulus_GPa": 208.0, "poisson_ratio": 0.3, "density_kg_m3": 7800.0},
                "thermal_expansion_per_K": 12e-6,
            }
    return changed


def test_impossible_and_unsupported_points_stay_with_their_reason() -> None:
    results = sweep(Study.of(B218, {"ball_count": [10, 17, 18, 40], "axial_load_N": [-5, 1000]}))
    assert results["status"].values.tolist() == [[1, 0], [1, 0], [3, 3], [3, 3]]
    reasons = results["reason"].attrs["flag_meanings"].split(" ")
    assert reasons[int(results["reason"][2, 0])].endswith("the_balls_do_not_fit_on_the_pitch_circle")
    assert reasons[int(results["reason"][0, 0])] == "open_side"
    assert np.isnan(results["inner_load"].values[2:]).all()
    assert np.isfinite(results["inner_load"].sel(ball_count=17, axial_load_N=1000)[:17]).all()
    assert np.isnan(results["inner_load"].sel(ball_count=10, axial_load_N=1000)[10:]).all()


def test_each_point_has_its_own_reason() -> None:
    results = sweep(Study.of(B218, {"ball_diameter_mm": [22, 23.3, 25, 5000], "ball_count": [10, 10.5]}))
    why = np.array(results["reason"].attrs["flag_meanings"].split(" "))[results["reason"]]
    assert why[0, 0] == "none"
    assert "not_a_whole_number" in why[0, 1]
    assert "smaller_than_the_ball" in why[1, 0]
    assert "too_large" in why[3, 0]


@pytest.mark.parametrize("order", [1, -1])
def test_the_order_of_values_decides_nothing(order: int) -> None:
    """One of four points is possible, at a corner of the grid that depends on the order."""
    vary = {"ball_count": [15, 23][::order], "groove_radius_coefficient": [0.5, 0.52]}
    results = sweep(Study.of(B218, vary))
    assert (results["status"] != 3).sum() == 1
    assert results["status"].sel(ball_count=15, groove_radius_coefficient=0.52) == 0
    why = np.array(results["reason"].attrs["flag_meanings"].split(" "))[results["reason"]]
    assert {text.partition(":")[2].strip("_")[:20] for text in why.ravel()} == {
        *("", "the_groove_is_smalle", "the_balls_do_not_fit")
    }


def test_a_distribution_is_judged_where_the_axes_leave_a_bearing() -> None:
    """Neither the first nor the middle ball count fits; of the others' diameters nothing is wrong."""
    results = sweep(Study.of(B218, {"ball_count": [25, 23, 15], "ball_diameter_mm": "normal(22.2,0.01)"}, samples=4))
    assert results["status"].values.tolist() == [[3] * 4, [3] * 4, [0] * 4]


@pytest.mark.parametrize(
    ("table", "own", "key", "values"),
    [
        ("readings", {"overrun": {"inner_shoulder_diameter_mm": 115.0}}, "pitch_diameter_mm", [188, 125.26]),
        ("readings", ESTIMATE, "readings.friction_estimate.bore_diameter_mm", [170.0, 90.0]),
        ("effects", {"ball_diameter_deviations_um": [0.1] * 16}, "ball_count", [15, 16]),
        ("effects", WITHOUT_TEMPERATURES, "reference_temperature_C", [25, 20]),
    ],
)
def test_what_only_some_points_have_wrong_stops_no_other(table: str, own: dict, key: str, values: list[float]) -> None:
    results = sweep(Study.of(copy.deepcopy(COMBINED) | {table: own}, {key: values}, quantities=["inner_load_max"]))
    assert results["status"].values.tolist() == [3, 0]


def test_points_none_of_which_is_possible_are_results() -> None:
    results = sweep(Study.of(B218, {"ball_count": [40, 41]}))
    assert results["status"].values.tolist() == [3, 3]
    assert "pitch_circle" in results["reason"].attrs["flag_meanings"]


def test_a_study_that_is_wrong_at_every_point_is_refused() -> None:
    with pytest.raises(qs.SceneError, match="do not fit"):
        sweep(Study.of(B218, {"ball_count": [40], "speed_rpm": [0, 1]}))
    with pytest.raises(qs.SceneError, match="so give its moment or its tilt"):
        sweep(Study.of(B218, {"radial_load_y_N": "0:10:3"}))
    with pytest.raises(qs.SceneError, match="leaves the possible"):
        sweep(Study.of(B218, {"ball_diameter_mm": "normal(22,3)"}))
    with pytest.raises(qs.SceneError, match="Did you mean inner_angle"):
        sweep(Study.of(B218, {"speed_rpm": [0, 1]}, quantities=["iner_angle"]))
    for name, meant in (
        ("outer_max_presure_MPa", "Did you mean outer_max_pressure_MPa"),
        ("inner_load_kN", "It is in N: write inner_load_N"),
    ):
        with pytest.raises(qs.SceneError, match=f"{meant}\\b"):
            sweep(Study.of(B218, {"speed_rpm": [0, 1]}, quantities=[name]))
    with pytest.raises(qs.SceneError, match="not called for"):
        sweep(Study.of(B218, {"speed_rpm": [0, 1]}, quantities=["gyroscopic_moment"]))


MANY = {"speed_rpm": [1000, 9000], "ball_diameter_mm": "normal(22.2,0.01)", "ball_count": [12, 18]}


@pytest.fixture
def small_chunks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(points, "CHUNK", 7)


@pytest.fixture(scope="module")
def whole() -> object:
    return sweep(Study.of(COMBINED, MANY, samples=10))


def test_chunks_and_executors_change_nothing(small_chunks: None, whole: object) -> None:
    study = Study.of(COMBINED, MANY, samples=10)
    with ThreadPoolExecutor(2) as pool:
        for executor in (None, pool):
            # Digits may differ in the last place: a chunk's other points decide how balls of equal loads are shared.
            xarray.testing.assert_allclose(
                sweep(study, executor).drop_vars(["residual", "iterations"]),
                whole.drop_vars(["residual", "iterations"]),  # type: ignore[attr-defined]
                rtol=1e-9,
                atol=1e-9,
            )


@pytest.mark.parametrize("values", ["12000", "12000:12000:1"])
def test_a_single_point_is_a_study(values: str, tmp_path: Path) -> None:
    study = Study.of(COMBINED, {"speed_rpm": values})
    alone = qs.solve(scene_of(document_with(COMBINED, ("operation", "speed_rpm"), 12000.0), ""))
    results = sweep(study)
    np.testing.assert_allclose(results["inner_load"], alone.inner.load, rtol=1e-10)
    assert results["status"].shape == ()
    with sweep(study, out=tmp_path / "r.nc") as found:
        xarray.testing.assert_identical(found.load(), results)


def test_progress_counts_the_points(small_chunks: None) -> None:
    told: list[tuple[int, int]] = []
    sweep(Study.of(B218, {"speed_rpm": "0:9:20"}), progress=lambda *given: told.append(given))
    assert told[0] == (0, 20)
    assert told[-1] == (20, 20)
    assert [done for done, _ in told] == sorted({done for done, _ in told})


def test_a_file_holds_what_memory_holds(tmp_path: Path, whole: object) -> None:
    with sweep(Study.of(COMBINED, MANY, samples=10), out=tmp_path / "r.nc") as results:
        xarray.testing.assert_identical(results.load(), whole)
    assert [file.name for file in tmp_path.iterdir()] == ["r.nc"]


@pytest.mark.parametrize("looked", [FIRST_COMPLETED, ALL_COMPLETED])
def test_an_interrupted_sweep_goes_on_to_the_identical_file(
    small_chunks: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, looked: str
) -> None:
    """Also where other chunks have failed by the time that the finished ones are looked at."""
    monkeypatch.setattr(sweeping, "FIRST_COMPLETED", looked)
    study = Study.of(COMBINED, MANY, samples=10)
    sweep(study, out=tmp_path / "whole.nc").close()
    solve = chunks.solve_points
    left = [5]

    def until_stopped(*given, **named):  # type: ignore[no-untyped-def]
        left[0] -= 1
        if left[0] < 0:
            raise KeyboardInterrupt
        return solve(*given, **named)

    monkeypatch.setattr(chunks, "solve_points", until_stopped)
    with pytest.raises(KeyboardInterrupt):
        sweep(study, out=tmp_path / "r.nc")
    kept = list((tmp_path / "r.nc.parts").glob("*.npz"))
    assert 0 < len(kept) <= 5
    with pytest.raises(qs.SceneError, match="Continue it with --resume"):
        sweep(study, out=tmp_path / "r.nc")
    with pytest.raises(qs.SceneError, match="another study"):
        sweep(study.replaced(seed=1), out=tmp_path / "r.nc", resume=True)
    left[0] = 1000
    sweep(study, out=tmp_path / "r.nc", resume=True).close()
    assert left[0] == 1000 - (len(list_chunks(study)) - len(kept)), "only what was missing is solved"
    assert (tmp_path / "r.nc").read_bytes() == (tmp_path / "whole.nc").read_bytes()


def test_what_a_crash_has_damaged_is_solved_again(
    small_chunks: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    study = Study.of(COMBINED, MANY, samples=10)
    sweep(study, out=tmp_path / "whole.nc").close()
    parts = interrupted(study, tmp_path / "r.nc", monkeypatch)
    for number, left in ((0, 0), (1, 100), (2, 2000)):  # empty, cut at its beginning, cut later
        file = parts / f"{number}.npz"
        file.write_bytes(file.read_bytes()[:left])
    (parts / "3.part").write_bytes(b"half")
    told: list[int] = []
    sweep(study, out=tmp_path / "r.nc", resume=True, progress=lambda done, count: told.append(done)).close()
    assert told[0] == 4 * 10 - (7 + 3 + 7)
    assert (tmp_path / "r.nc").read_bytes() == (tmp_path / "whole.nc").read_bytes()
    parts.mkdir()
    (parts / "plan.json").write_text("{", "utf-8")
    with pytest.raises(qs.SceneError, match="another study"):
        sweep(study, out=tmp_path / "r.nc", resume=True)


@pytest.mark.parametrize("resume", [False, True])
def test_two_runs_do_not_share_a_folder(resume: bool, tmp_path: Path) -> None:
    """The second is refused and harms nothing, while the first is at work; what the first leaves is no lock."""
    study, out = Study.of(B218, {"speed_rpm": [0, 1]}), tmp_path / "r.nc"

    def second(done: int, count: int) -> None:
        with pytest.raises(qs.SceneError, match="another run is using it"):
            sweep(study, out=out, resume=resume)

    sweep(study, out=out, progress=second).close()
    assert [file.name for file in tmp_path.iterdir()] == ["r.nc"]
    sweep(study, out=out).close()


HOLDER = """
import sys
from qsbearing.studies.store import _alone
from functools import partial
from pathlib import Path
with _alone(Path(sys.argv[1])):
    print("locked", flush=True)
    sys.stdin.read()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no such lock")
def test_a_run_that_is_killed_holds_no_lock(tmp_path: Path) -> None:
    study, out = Study.of(B218, {"speed_rpm": [0, 1]}), tmp_path / "r.nc"
    (tmp_path / "r.nc.parts").mkdir()
    command = [sys.executable, "-c", HOLDER, str(tmp_path / "r.nc.parts")]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as holder:
        assert holder.stdout is not None
        assert holder.stdout.readline() == "locked\n"
        with pytest.raises(qs.SceneError, match="another run is using it"):
            sweep(study, out=out)
        holder.kill()
    sweep(study, out=out).close()


def interrupted(study: Study, out: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of a run that has ended before its chunks were joined."""
    with monkeypatch.context() as patch:
        patch.setattr(Store, "join", lambda store: (_ for _ in ()).throw(KeyboardInterrupt))
        with pytest.raises(KeyboardInterrupt):
            sweep(study, out=out)
    return out.with_name(f"{out.name}.parts")


def test_files_that_are_no_parts_of_a_study_are_named(
    small_chunks: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whole files of another shape, strange names, folders: nothing is solved, and none of them is removed."""
    study, out = Study.of(B218, {"speed_rpm": "0:9:20"}), tmp_path / "r.nc"
    parts = interrupted(study, out, monkeypatch)
    with np.load(parts / "0.npz") as file:
        cut = {name: values[:3] for name, values in file.items()}
    good = (parts / "0.npz").read_bytes()
    np.savez(parts / "0.npz", **cut)
    (parts / "notes.txt").write_text("mine")
    (parts / "7.npz").write_bytes(good)
    (parts / "2.part").mkdir()
    with pytest.raises(
        qs.SceneError, match=r"files that do not belong to this study: 0\.npz, 2\.part, 7\.npz, notes\.txt"
    ):
        sweep(study, out=out, resume=True)
    (parts / "2.part").rmdir()
    for name in ("0.npz", "7.npz", "notes.txt"):
        (parts / name).unlink()
    sweep(study, out=out, resume=True).close()
    sweep(study, out=tmp_path / "whole.nc").close()
    assert out.read_bytes() == (tmp_path / "whole.nc").read_bytes()
    parts.mkdir()
    (parts / "notes.txt").write_text("mine")
    with pytest.raises(qs.SceneError, match="do not belong to this study"):
        sweep(study, out=out)
    assert (parts / "notes.txt").read_text() == "mine"


def test_what_a_link_points_at_is_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    study, link, target = Study.of(B218, {"speed_rpm": [0, 1]}), tmp_path / "r.nc", tmp_path / "far" / "x.nc"
    target.parent.mkdir()
    link.symlink_to(target)
    assert not interrupted(study, link, monkeypatch).exists()
    assert (tmp_path / "far" / "x.nc.parts" / "0.npz").exists(), "on the disk that the file is to be on"
    sweep(study, out=link, resume=True).close()
    assert link.is_symlink()
    assert [file.name for file in target.parent.iterdir()] == ["x.nc"]
    link.unlink()
    link.symlink_to("/dev/null")
    with pytest.raises(qs.SceneError, match="is not a file, and cannot be replaced"):
        sweep(study, out=link)


def test_workers_keep_what_they_solve_where_they_reach_the_folder_and_send_it_elsewhere(
    small_chunks: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On the disk that all share the client is told how many points are done; the file is the same either way."""
    study = Study.of(B218, {"speed_rpm": "0:9:20"})
    sweep(study, out=tmp_path / "whole.nc").close()
    sent: list[int] = []
    put = Store.put
    monkeypatch.setattr(Store, "put", lambda store, number, chunk: (sent.append(number), put(store, number, chunk))[1])
    told: list[int] = []
    with ThreadPoolExecutor(2) as pool:
        out = tmp_path / "shared.nc"
        sweep(study, pool, out=out, progress=lambda done, count: told.append(done)).close()
        assert sent == []
        assert told[-1] == 20
        assert out.read_bytes() == (tmp_path / "whole.nc").read_bytes()
        far = tmp_path / "far.nc"
        sweep(study, _Elsewhere(pool), out=far).close()
    assert len(sent) == Points(study).chunk_count
    assert far.read_bytes() == out.read_bytes()


class _Elsewhere(Executor):
    """Workers that find a folder of the same name, but not of this run."""

    def __init__(self, pool: Executor) -> None:
        self.pool = pool

    def submit(self, task: Any, *given: Any, **named: Any) -> Future:  # type: ignore[override]
        here, plan = task.args
        return self.pool.submit(partial(task.func, here._replace(run="another"), plan), *given)


class Deserted(Executor):
    """Of the interface of Dask's, without a worker."""

    _client = SimpleNamespace(nthreads=dict)

    def submit(self, *given: object, **named: object) -> Future:  # type: ignore[override]
        return Future()


def test_a_cluster_without_workers_is_left_after_the_time_that_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(sweeping, "WITHOUT_WORKERS", 0.05)
    monkeypatch.setattr(sweeping, "LOOK", 0.01)
    with pytest.raises(TimeoutError, match=r"no worker for 0\.05 s"):
        sweep(Study.of(B218, {"speed_rpm": [0, 1]}), Deserted(), out=tmp_path / "r.nc")
    assert caplog.messages == ["the cluster has no worker: waiting 0.05 s for one"]
    assert {file.name for file in (tmp_path / "r.nc.parts").iterdir()} == {"plan.json"}


LIMITED = """
import resource, signal, sys
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[1]), resource.RLIM_INFINITY))
from qsbearing.cli import cli
cli(sys.argv[2:])
"""
"""The command where no file can grow beyond a size, as on a disk that is full."""


@pytest.mark.heavy
@pytest.mark.skipif(sys.platform == "win32", reason="no such limit")
def test_a_disk_that_fills_loses_nothing_finished(tmp_path: Path) -> None:
    given = ["sweep", "b218", "--samples", "20000", "--vary", "ball_diameter_mm=normal(22.225,0.001)", "--resume"]

    def run(limit: int, out: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-c", LIMITED, str(limit), *given, "--out", str(tmp_path / out)]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    assert run(1 << 40, "whole.nc").returncode == 0
    for limit, kept in ((1_000_000, {"plan.json", "1.npz"}), (2_000_000, {"plan.json", "0.npz", "1.npz"})):
        done = run(limit, "r.nc")  # first a chunk of 16,384 points is too large, then only the whole file
        assert done.returncode == 2, done.stderr
        assert "cannot be written: File too large" in done.stderr
        assert "then continue with --resume" in done.stderr
        assert "Traceback" not in done.stderr
        assert {file.name for file in (tmp_path / "r.nc.parts").iterdir()} <= kept
        assert {file.name for file in tmp_path.iterdir()} == {"whole.nc", "r.nc.parts"}
    assert (tmp_path / "r.nc.parts" / "0.npz").exists()
    assert run(1 << 40, "r.nc").returncode == 0
    assert (tmp_path / "r.nc").read_bytes() == (tmp_path / "whole.nc").read_bytes()


def list_chunks(study: Study) -> range:
    return range(points.Points(study).chunk_count)


def test_places_that_cannot_be_written_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    study = Study.of(B218, {"speed_rpm": [0, 1]})
    with pytest.raises(qs.SceneError, match="there is no folder"):
        sweep(study, out=tmp_path / "none" / "r.nc")
    with pytest.raises(qs.SceneError, match="is a folder"):
        sweep(study, out=tmp_path)
    monkeypatch.setattr("shutil.disk_usage", lambda place: type("Usage", (), {"free": 100}))
    with pytest.raises(qs.SceneError, match="GB left"):
        sweep(study, out=tmp_path / "r.nc")
    assert not list(tmp_path.iterdir())


def test_files_that_are_no_results_are_refused(tmp_path: Path) -> None:
    with pytest.raises(qs.SceneError, match="no such file"):
        qs.open_results(tmp_path / "r.nc")
    with sweep(Study.of(B218, {"speed_rpm": [0, 1]}), out=tmp_path / "r.nc"):
        pass
    whole = (tmp_path / "r.nc").read_bytes()
    (tmp_path / "cut.nc").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(qs.SceneError, match="damaged"):
        qs.open_results(tmp_path / "cut.nc")
    xarray.Dataset({"x": 1}).to_netcdf(tmp_path / "other.nc", engine="h5netcdf")
    with pytest.raises(qs.SceneError, match="another program"):
        qs.open_results(tmp_path / "other.nc")
    later = xarray.Dataset({"x": 1}, attrs={"qsbearing_format": dataset.FORMAT + 1, "qsbearing_version": "9.0"})
    later.to_netcdf(tmp_path / "later.nc", engine="h5netcdf")
    with pytest.raises(qs.SceneError, match=r"not a results file of this version \(made by 9.0\)"):
        qs.open_results(tmp_path / "later.nc")


def test_a_solution_as_a_labelled_dataset() -> None:
    speed, load = np.array([0.0, 5e3]) * qs.rpm, np.array([[2e3], [8e3], [9e3]])
    scene = scene_of(document_of("b218")[0], "")
    many = qs.solve(qs.Scene(scene.bearing, qs.Operation(speed=speed, axial_load=load)))
    found = many.to_xarray()
    assert found["inner_angle"].dims == ("axial_load_N", "speed_rpm", "ball")
    np.testing.assert_allclose(found["inner_load"].sel(speed_rpm=5e3, axial_load_N=8e3), many.inner.load[1, 1])
    assert found["inner_load"].attrs["units"] == "N"
    assert "gyroscopic_moment" not in found
    assert str(qs.solve(scene).to_xarray()["status"].item()) == "converged"


def test_readings_that_a_scene_asks_for_are_results() -> None:
    document = copy.deepcopy(COMBINED) | {"readings": {"life": {}, "kinematics": {}}}
    kept = ["life_basic_reference_rating_life", "outer_kinematics_spin_to_roll", "outer_kinematics_spin_to_roll_max"]
    results = sweep(Study.of(document, {"speed_rpm": [5000, 9000]}, quantities=kept))
    alone = qs.solve(scene_of(document, ""))
    life = qs.readings.life(alone).basic_reference_rating_life / 1e6
    assert float(results[kept[0]].sel(speed_rpm=9000)) == pytest.approx(float(life), rel=1e-9)
    attrs = {"units": "Mrev", "column": "life_basic_reference_rating_life_Mrev"}
    of_life = {"symbol": "L_{10r}", "source": "ISO/TS 16281, ISO 281, Lundberg & Palmgren"}
    of_life |= dict.fromkeys(("long_name", "label"), "basic reference rating life")
    assert results[kept[0]].attrs == attrs | of_life
    spin = qs.readings.kinematics(alone).outer.spin_to_roll
    np.testing.assert_allclose(results[kept[1]].sel(speed_rpm=9000), spin, rtol=1e-9)
    assert float(results[kept[2]].sel(speed_rpm=9000)) == pytest.approx(spin.max(), rel=1e-9)


def test_effects_that_a_tolerance_chooses_are_the_same_at_every_point() -> None:
    """At 100 rpm alone nothing would be needed; beside 9000 rpm the centrifugal force is, and then everywhere."""
    document = copy.deepcopy(B218) | {"effects": "auto"}
    results = sweep(Study.of(document, {"speed_rpm": [100, 9000]}))
    document["effects"] = {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "outer"}
    named = sweep(Study.of(document, {"speed_rpm": [100, 9000]}))
    for result in ("inner_angle", "outer_load", "ring_displacement_axial"):
        np.testing.assert_allclose(results[result], named[result], rtol=0.01, atol=0.05)
    assert "centrifugal_force" in results
    slow = sweep(Study.of(copy.deepcopy(B218) | {"effects": "auto"}, {"speed_rpm": [100, 101]}))
    assert "centrifugal_force" not in slow


def test_effects_are_chosen_at_a_possible_point(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(chunks, "LOOKED_AT", 2)
    results = sweep(Study.of(copy.deepcopy(B218) | {"effects": "auto"}, {"ball_count": [24, 15, 25]}))
    assert results["status"].values.tolist() == [3, 0, 3]


def test_the_least_loaded_ball_is_named() -> None:
    """Opposite a radial load; on the other side under a moment of the other sign; none under an axial load alone."""
    document = copy.deepcopy(COMBINED)
    found = sweep(Study.of(document, {"moment_y_Nm": [-150, 0, 150]}))["least_loaded_azimuth"]
    assert found.attrs["units"] == "deg"
    low, middle, high = found.values.tolist()
    assert middle == pytest.approx(180.0)
    assert 180.0 < high < 270.0
    assert low == pytest.approx(360.0 - high)
    axial = copy.deepcopy(B218)
    assert np.isnan(sweep(Study.of(axial, {"speed_rpm": [0, 9000]}))["least_loaded_azimuth"]).all()
    results = sweep(Study.of(document, {"radial_load_y_N": "0:16000:17"}))
    load, azimuth = results["inner_load"].values, results["azimuth"].values
    for point in range(1, 17):
        at = np.flatnonzero(np.isclose(azimuth[point], results["least_loaded_azimuth"].values[point]))
        assert load[point, at] == load[point].min()


def with_readings(**tables: dict) -> dict:
    """Every reading, each with what it can take; one table may be another."""
    readings: dict[str, object] = {
        "life": {"viscosity_ratio": 2.0, "contamination_factor": 0.5, "reliability": 0.95},
        "static_safety": {},
        "kinematics": {},
        "frequencies": True,
        "lubricant": {"iso_viscosity_grade": 68.0, "oil_temperature_C": 70.0},
        "film": {"ball_roughness_um": 0.05, "raceway_roughness_um": 0.1},
        "friction": {
            "friction_coefficient": 0.05,
            "hysteresis_loss": 0.01,
            "drag_coefficient": 0.5,
            "fluid_density_kg_m3": 20.0,
        },
        "ball_slip": {
            **{"friction_coefficient": 0.05, "drag_coefficient": 0.5, "least_oil_share": 0.02, "most_oil_share": 0.2},
            **{"oil_density_kg_m3": 900.0, "minimum_load_factor_N": 30.0},
        },
        "friction_estimate": {
            **{"bore_diameter_mm": 90.0, "outside_diameter_mm": 160.0},
            **{"static_load_rating_N": 1e5, "lubrication_factor": 2.0},
        },
        "overrun": {"inner_shoulder_diameter_mm": 115.0, "outer_shoulder_diameter_mm": 136.0},
    }
    return copy.deepcopy(COMBINED) | {"readings": readings | tables}


READING_VALUES = {
    "dynamic_load_rating_N": (1.5e5, 1.6e5),
    "rating_factor": (1.0, 1.3),
    "reliability": (0.9, 0.99),
    "viscosity_ratio": (0.5, 1.5),
    "inner_shoulder_diameter_mm": (115.0, 116.0),
    "outer_shoulder_diameter_mm": (135.0, 136.0),
    "contamination_factor": (0.3, 0.6),
    "fatigue_load_limit_N": (4e3, 5e3),
    "viscosity_index": (95.0, 150.0),
    "viscosity_at_40C_mm2_s": (60.0, 68.0),
    "viscosity_at_100C_mm2_s": (8.0, 8.7),
    "iso_viscosity_grade": (46.0, 68.0),
    "oil_temperature_C": (40.0, 70.0),
    "oil_density_kg_m3": (860.0, 880.0),
    "pressure_viscosity_per_GPa": (15.0, 20.0),
    "drag_coefficient": (0.4, 0.5),
    "lubrication_factor": (1.0, 2.0),
    "inner_open_diameter_mm": (112.0, 113.0),
    "outer_open_diameter_mm": (138.0, 139.0),
    "edge_radius_mm": (0.1, 0.2),
    "pocket_clearance_mm": (0.2, 0.4),
}
TWO_POINTS = {"oil_temperature_C": 70.0, "viscosity_at_40C_mm2_s": 68.0, "viscosity_at_100C_mm2_s": 8.7}


@pytest.mark.parametrize("name", OF_READINGS)
def test_every_key_of_readings_can_vary(name: str) -> None:
    """Of two values of it the second, which is not the scene's own, gives what its file gives, in every number."""
    key = keys.ALL[name]
    document = with_readings(**({"lubricant": TWO_POINTS} if "viscosity_at" in name else {}))
    given = document["readings"].get(key.path[1], {}).get(key.path[2])
    values = READING_VALUES.get(key.path[2]) or ((given, 1.1 * given) if given else (1e5, 1.1e5))
    results = sweep(Study.of(document, {name: list(values)}))
    of_readings = [each for each in results.data_vars if reading_of(each)]
    assert len(of_readings) > 50
    alone = sweep(Study.of(document_with(document, key.path, values[1]), {"speed_rpm": [9000, 9001]}))
    differing = 0
    for each in of_readings:
        np.testing.assert_allclose(results[each].values[1], alone[each].values[0], rtol=1e-9, atol=0.0, err_msg=each)
        differing += not np.array_equal(*results[each].values, equal_nan=True)
    # No ellipse reaches the low shoulder of B218 under these loads.
    assert differing or "_open_" in name, "the key does something"


def test_naming_a_number_of_a_reading_asks_for_it() -> None:
    """By its own name, as it stands in the reading, or with the reading's."""
    names = ["basic_reference_rating_life", "life_inner_life", "outer_spin_to_roll_max", "inner_load_max"]
    study = Study.of(B218, {"groove_radius_coefficient": [0.515, 0.54]}, quantities=names)
    results = sweep(study)
    full = ["life_basic_reference_rating_life", "life_inner_life", "outer_kinematics_spin_to_roll_max"]
    assert set(full) <= set(results.data_vars)
    assert "readings" not in B218, "the caller's tables are left alone"
    life = results["life_basic_reference_rating_life"].values
    assert life[0] > 1.5 * life[1], "wider grooves, shorter life"
    with pytest.raises(qs.SceneError, match=r"Give in \[readings.film\]"):
        oil = {"iso_viscosity_grade": [32, 68], "oil_temperature_C": 70}
        sweep(Study.of(B218, oil, quantities=["outer_film_parameter"]))
    with pytest.raises(qs.SceneError, match="needs an oil"):
        sweep(Study.of(B218, {"speed_rpm": [0, 1]}, quantities=["outer_film_parameter"]))


def test_impossible_arguments_of_readings_are_impossible_points() -> None:
    results = sweep(Study.of(with_readings(), {"reliability": [0.95, 0.5], "speed_rpm": [5000, 9000]}))
    assert results["status"].values.tolist() == [[0, 0], [3, 3]]
    why = results["reason"].attrs["flag_meanings"].split(" ")[int(results["reason"][1, 0])]
    assert why.startswith("readings.life.reliability:")
