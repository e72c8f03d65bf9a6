"""Steady temperatures: by other equations and another root-finder, the balance of heat, runaway at the fold."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from numpy.typing import NDArray
from scipy.optimize import fsolve

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files.scene_file import scene_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.results.json_record import record
from qsbearing.results.set_record import set_record
from qsbearing.results.thermal_report import speeds_record, thermal_tables
from qsbearing.systems.heat.state import NetworkPart, ThermalState, along_curve
from tests.systems.heat.spindle import AMBIENT, BEARING, BETWEEN, EFFECTS, pair, paths, scene, tables

KELVIN = 1e-8 * (AMBIENT + qs.zero_celsius)
"""By how much temperatures may differ: the relative 1e-8 that is asked of two root-finders on the same equations."""


def state_of(solution: Any) -> ThermalState:
    assert solution.thermal is not None
    return solution.thermal


def heat_at(of: qs.Scene, inner_ring: float, balls: float, outer_ring: float) -> tuple[float, float]:
    """Of inner and outer contacts, of the bearing at given temperatures, without any heat balance [W]."""
    ring = replace(of.ring_effects[0], inner_ring_temperature=inner_ring, outer_ring_temperature=outer_ring)
    ball = replace(of.ring_effects[1], ball_temperature=balls)
    solution = qs.solve(replace(of, thermal=None, ring_effects=(ring, ball)))
    found = qs.readings.friction(solution, **of.readings["friction"])
    return float(found.inner.power.sum()), float(found.outer.power.sum())


def surplus(temperatures: NDArray, of: qs.Scene) -> NDArray:
    """What the three nodes take in and do not give off, written out by hand [W]."""
    inner_ring, balls, outer_ring = temperatures
    at_inner, at_outer = heat_at(of, *temperatures)
    to_balls = BETWEEN["inner_ring", "balls"] * (inner_ring - balls)
    to_outer = BETWEEN["outer_ring", "balls"] * (balls - outer_ring)
    away = BETWEEN["outer_ring", "ambient"] * (outer_ring - AMBIENT - qs.zero_celsius)
    half = 0.5 * (at_inner + at_outer)
    return np.array([0.5 * at_inner - to_balls, half + to_balls - to_outer, 0.5 * at_outer + to_outer - away])


def steady_by_hand(of: qs.Scene, start: NDArray) -> NDArray | None:
    found, _, ended, _ = fsolve(surplus, start, args=(of,), xtol=1e-12, full_output=True)
    return found if ended == 1 else None


def cold() -> NDArray:
    return np.full(3, AMBIENT + qs.zero_celsius)


def nodes(solution: qs.Solution) -> NDArray:
    return np.array([state_of(solution).temperatures[name] for name in ("inner_ring", "balls", "outer_ring")])


def test_temperatures_meet_another_root_finder_on_equations_written_by_hand() -> None:
    of = scene()
    solution = qs.solve(of)
    found = steady_by_hand(of, cold())
    assert found is not None
    assert np.abs(nodes(solution) - found).max() < KELVIN
    assert found[0] - cold()[0] > 5.0
    assert state_of(solution).solves <= 20
    assert state_of(solution).imbalance < 1e-10 * sum(state_of(solution).powers.values())
    rings = solution.scene.ring_expansion
    assert rings is not None and rings.inner_ring_temperature == nodes(solution)[0]
    assert solution.load[0] > 1.5 * float(solution.preload_at_rest)


def test_what_is_to_be_found_is_none_until_then() -> None:
    grade, thermal = {"iso_viscosity_grade": 32}, tables()["thermal"] | {"viscosity_at": "outer_ring"}
    of = scene(thermal=thermal, readings=tables()["readings"] | {"lubricant": grade})
    balls = next(each for each in of.ring_effects if isinstance(each, qs.BallExpansion))
    assert balls.ball_temperature is None and balls.reshape(of.bearing, of.operation) is of.bearing
    assert "oil_temperature" not in of.readings["lubricant"]
    with pytest.raises(qs.SceneError, match="ball_temperature: missing"):
        qs.solve(replace(of, thermal=None))
    row = qs.Row(of.bearing, ring_effects=(balls,))
    with pytest.raises(qs.SceneError, match="ball_temperature: missing"):
        qs.solve_set(qs.BearingSet((row,), qs.Operation(axial_load=1e3)))


def test_all_cases_of_an_array_are_those_alone() -> None:
    speeds = np.array([2000.0, 8000.0, 30_000.0]) * qs.rpm
    one = scene()
    together = qs.solve(replace(one, operation=replace(one.operation, speed=speeds)))
    assert state_of(together).verdict.tolist() == ["stable", "stable", "undecided"]
    assert together.status.tolist() == ["converged", "converged", "not_converged"]
    table = together.to_dataframe().drop_duplicates("case_0")
    assert np.allclose(table["steady_inner_ring_temperature_C"][:2], nodes(together)[0, :2] - qs.zero_celsius)
    assert np.isnan(table["steady_friction_W"].to_numpy()[2])
    assert np.isnan(nodes(together)[:, 2]).all() and np.isnan(together.load[2]).all()
    for number in (0, 1):
        alone = qs.solve(replace(one, operation=replace(one.operation, speed=speeds[number])))
        assert np.abs(nodes(together)[:, number] - nodes(alone)).max() < KELVIN


def test_heat_in_is_heat_out(tmp_path: Path) -> None:
    """From the printed result: of the whole, and of every node."""
    oil = {"flow_cm3_min": 100, "inlet_temperature_C": 40, "density_kg_m3": 870, "specific_heat_J_kgK": 2000}
    between = BETWEEN | {("balls", "oil"): 1.5, ("inner_ring", "shaft"): 1.0}
    thermal = tables()["thermal"] | {"oil": oil, "conductances": paths(between), "heats": {"shaft_W": 7.0}}
    friction = {"friction_coefficient": 0.06, "drag_coefficient": 1.0, "fluid_density_kg_m3": 20.0}
    document = tables(thermal=thermal, readings={"friction": friction})
    document_file = tmp_path / "result.json"
    document_file.write_text(json.dumps({"version": qs.__version__, "input": document}))
    run = CliRunner().invoke(cli, ["run", str(document_file), "--json"])
    assert run.exit_code == 0, run.output
    found = json.loads(run.stdout)["thermal"]
    made = sum(found["powers_W"].values()) + 7.0
    assert found["powers_W"]["drag"] > 0.1
    net = dict.fromkeys(("inner_ring", "balls", "outer_ring", "oil", "shaft", "ambient", "oil inlet"), 0.0)
    for path in found["flows_W"]:
        net[path["from"]] -= path["heat_W"]
        net[path["to"]] += path["heat_W"]
    assert net["ambient"] + net["oil inlet"] == pytest.approx(made, rel=1e-9)
    at_inner, at_outer = found["powers_W"]["inner contacts"], found["powers_W"]["outer contacts"]
    halves = {"inner_ring": at_inner, "balls": at_inner + at_outer, "outer_ring": at_outer}
    for node, heat in halves.items():
        assert -net[node] == pytest.approx(0.5 * heat, rel=1e-8)
    assert -net["oil"] == pytest.approx(found["powers_W"]["drag"], rel=1e-8)
    assert -net["shaft"] == pytest.approx(7.0, rel=1e-8)
    taken = 100e-6 / 60 * 870 * 2000 * (found["temperatures_C"]["oil"] - 40.0)
    assert net["oil inlet"] == pytest.approx(taken, rel=1e-8)


def test_the_preload_runs_away_where_states_followed_from_below_end() -> None:
    """The speed is raised from state to state, each by the other root-finder, until none is found; then halved."""
    of = scene(operation={"speed_rpm": 30_000})
    runaway = qs.solve(of)
    curve = state_of(runaway).speeds
    assert curve.fold is not None and curve.at_limit is not None
    assert str(runaway.status) == "no_equilibrium" and str(state_of(runaway).verdict) == "runaway"
    assert "Thermal runaway of the preload" in qs.message(runaway)
    assert np.isnan(runaway.load).all() and np.isnan(nodes(runaway)).all()

    def at(speed: float, start: NDArray) -> NDArray | None:
        return steady_by_hand(replace(of, operation=replace(of.operation, speed=speed)), start)

    state, low, high = cold(), 0.0, float(of.operation.speed)  # type: ignore[arg-type]
    speed = 0.2 * high
    while high - low > 1e-4 * high:
        found = at(speed, state)
        if found is None or found[0] > curve.fold.temperatures[0] + 1.0:  # of the states beyond the fold, unstable ones
            high = speed
        else:
            state, low = found, speed
        speed = min(0.5 * (low + high), 1.1 * low if high > 0.9 * 30_000 * qs.rpm else np.inf)
    assert low <= curve.fold.factor * 30_000 * qs.rpm * (1.0 + 1e-6)
    assert high >= curve.fold.factor * 30_000 * qs.rpm * (1.0 - 1e-6)
    assert curve.at_limit.temperatures.max() == pytest.approx(200.0 + qs.zero_celsius, abs=1e-4)
    assert max(each.factor for each in curve.states) < 1.0
    below = qs.solve(replace(of, operation=replace(of.operation, speed=0.999 * low)))
    assert 0.9 < float(state_of(below).feedback) < 1.0


def test_the_curve_over_speed_has_no_kink_and_the_fold_in_its_place() -> None:
    """Drawn over the whole of its speeds and temperatures, it turns in short steps only; heat grows along it."""
    found = speeds_record(state_of(qs.solve(scene(operation={"speed_rpm": 9_000}))))
    states, fold = along_curve(found)
    assert states[fold] == found["fold"]
    assert np.diff([each["power_W"] for each in states]).min() > 0.0
    at = np.array([(each["speed_rpm"], max(each["temperatures_C"].values())) for each in states])
    chords = np.diff((at - at.min(axis=0)) / np.ptp(at, axis=0), axis=0)
    length, heading = np.hypot(*chords.T), np.unwrap(np.arctan2(chords[:, 1], chords[:, 0]))
    bend = np.abs(np.diff(heading))
    assert bend.sum() > 0.5 * np.pi
    assert np.maximum(length[1:], length[:-1])[bend > 0.2].max(initial=0.0) < 0.03


def test_heat_is_shown_from_where_it_comes() -> None:
    """A flow against the order of its path's ends from the other end; nodes of a set with their row."""
    found = {
        "friction": "skf", "message": "Stable.", "temperatures_C": {NetworkPart("balls", 0): 40.0},
        "powers_W": {NetworkPart("friction", 0): 5.0},
        "flows_W": [{"from": NetworkPart("inner_ring", 0), "to": NetworkPart("balls", 0), "heat_W": -2.0}],
    }  # fmt: skip
    nodes, heat, _ = thermal_tables(found)
    assert [list(row) for row in nodes.rows] == [["balls of row 1", "40"]]  # type: ignore[union-attr]
    assert [list(row) for row in heat.rows] == [  # type: ignore[union-attr]
        ["friction of row 1 (skf)", "", "5"],
        ["balls of row 1", "inner ring of row 1", "2"],
    ]


def test_a_bearing_that_only_gets_hot_does_not_run_away() -> None:
    """Under a constant force no heat changes the load."""
    of = scene(operation={"speed_rpm": 60_000}, preload={"spring_N": 400})
    hot = qs.solve(replace(of, thermal=replace(of.thermal, limit_temperature=60.0 + qs.zero_celsius)))
    assert str(state_of(hot).verdict) == "too_hot"
    assert "Too hot" in qs.message(hot)
    cooler = qs.solve(of)
    assert str(state_of(cooler).verdict) == "stable"
    assert abs(state_of(cooler).feedback) < 0.1


def test_uniform_temperature_is_a_similarity() -> None:
    """Without friction everything is as warm as its surroundings: lengths grow by 1 + e, forces by its square."""
    warm = 80.0
    thermal = tables()["thermal"] | {"fixed": {"ambient_C": warm}}
    no_friction = {"friction": {"friction_coefficient": 0.0}}
    of = scene(thermal=thermal, readings=no_friction, operation={"speed_rpm": 0.0}, preload={"rigid_N": 400})
    rings, balls = of.ring_effects
    balls = replace(balls, ball_temperature=20.0 + qs.zero_celsius)  # type: ignore[call-arg]
    hot, cool = qs.solve(of), qs.solve(replace(of, thermal=None, ring_effects=(rings, balls)))
    assert np.allclose(nodes(hot), warm + qs.zero_celsius, rtol=1e-12)
    strain = float(qs.STEEL.thermal_expansion) * (warm - 20.0)  # type: ignore[arg-type]
    assert np.allclose(hot.inner.angle, cool.inner.angle, rtol=1e-9)
    assert np.allclose(hot.inner.load, cool.inner.load * (1.0 + strain) ** 2, rtol=1e-9)


def test_a_set_has_its_rows_own_temperatures_and_a_shared_shaft() -> None:
    """SKF's friction at each row's outer ring, taken again from the rows; heat of the paths by hand."""
    of = pair()
    solution = qs.solve_set(of)
    state = state_of(solution)
    assert solution.converged and state.solves <= 20
    T = {name: float(value) for name, value in state.temperatures.items()}
    made = 0.0
    assert T["inner_ring 1"] - T["inner_ring 2"] > 0.1  # the axial load presses the first row
    for number, row in enumerate(solution.rows, 1):
        oil = qs.readings.Lubricant.from_grade(32).kinematic_viscosity(T[f"outer_ring {number}"])
        power = qs.readings.skf_torque(
            row, bore_diameter=35 * qs.mm, outside_diameter=62 * qs.mm, kinematic_viscosity=oil
        ).power
        assert power == pytest.approx(float(state.powers[f"friction {number}"]), rel=1e-8)
        made += float(power)
        from_inner = 2.0 * (T[f"inner_ring {number}"] - T[f"balls {number}"])
        to_shaft = 5.0 * (T[f"inner_ring {number}"] - T["shaft"])
        assert 0.25 * float(power) == pytest.approx(from_inner + to_shaft, rel=1e-7)
        rings = row.scene.ring_expansion
        assert rings is not None and rings.shaft_temperature == T["shaft"]
    ambient = AMBIENT + qs.zero_celsius
    away = (T["shaft"] - ambient) + sum(3.0 * (T[f"outer_ring {n}"] - ambient) for n in (1, 2))
    assert away + 6.0 * (T["housing"] - ambient) == pytest.approx(made + 5.0, rel=1e-9)


def origins(temperatures: dict[str, Any]) -> dict[str, str]:
    return {body: each["from"] for body, each in temperatures.items()}


def test_temperatures_of_the_heat_balance_are_not_called_given() -> None:
    """Those of a set's rows neither. Those of [thermal.fixed] are, and bodies that only conduct are as their rings."""
    found = set_record(qs.solve_set(pair()), [{}, {}])
    for row in found["rows"]:
        of = origins(row["temperatures"])
        assert of == dict.fromkeys(("inner_ring", "outer_ring", "shaft", "balls"), "heat balance") | {
            "housing": "as the outer ring"
        }
    thermal = tables()["thermal"]
    fixed = thermal["fixed"] | {"outer_ring_C": 40.0}
    single = record(qs.solve(scene(thermal=thermal | {"fixed": fixed})), {})
    assert origins(single["temperatures"])["inner_ring"] == "heat balance"
    assert origins(single["temperatures"])["outer_ring"] == "given"


def test_nothing_is_loaded_or_given_unless_named(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [name for name in sys.modules if name.startswith("qsbearing.systems.heat.")]:
        monkeypatch.delitem(sys.modules, name)
    solution = qs.solve(
        scene_of(tables(thermal=None, effects=EFFECTS | {"ball_expansion": {"ball_temperature_C": 30}}), "")
    )
    assert solution.thermal is None
    loaded = {name for name in sys.modules if name.startswith("qsbearing.systems.heat.")}
    assert loaded <= {"qsbearing.systems.heat.network"}


def test_a_result_gives_its_input_again() -> None:
    for of in (scene(), pair()):
        again = input_tables(of)
        assert "ball_temperature_C" not in str(again) and "oil_temperature_C" not in str(again)
    assert input_tables(scene_of(input_tables(scene()), "file")) == input_tables(scene())


WRONG = [
    (
        {"limit_temperature_C": 9000},
        "thermal.limit_temperature_C = 9000 °C: is not a plausible temperature of a bearing",
    ),
    ({"limit_temp_C": 9000}, "Did you mean limit_temperature_C?"),
    ({"fixed": {"ambient_K": 300}}, "thermal.fixed.ambient_K: unknown key"),
    ({"fixed": {}}, "let no heat out of inner_ring, balls, outer_ring, ambient"),
    ({"friction": "skv"}, "thermal.friction = 'skv': is not a friction model"),
    ({"friction": "skf"}, "Give [readings.friction_estimate]"),
    ({"oil": {"flow_cm3_min": 10}}, "thermal.oil.density_kg_m3: missing"),
    (
        {"fixed": dict.fromkeys(("inner_ring_C", "balls_C", "outer_ring_C", "ambient_C"), 30)},
        "so that none is left to find",
    ),
    ({"conductances": None}, "[[thermal.conductances]]: missing"),
    ({"conductances": [{"between": ["inner_ring", "bals"], "W_per_K": 1}]}, "'bals': is not a node"),
    ({"conductances": [{"between": ["inner_ring", "balls"], "W_per_K": -1}]}, "conductances 1.W_per_K = -1 W/K: is"),
    (
        {"conductances": [{"between": ["inner_ring", "balls"], "W_per_K": 1, "row": 3}]},
        "is not a row of the set (1 to 1)",
    ),
]


@pytest.mark.parametrize(("changed", "said"), WRONG, ids=[said for _, said in WRONG])
def test_errors_help(changed: dict[str, Any], said: str) -> None:
    thermal = tables()["thermal"] | changed
    if "row of the set" in said:
        thermal["conductances"] += paths(BETWEEN)
    with pytest.raises(qs.SceneFileError) as raised:
        scene(thermal=thermal)
    assert said in str(raised.value)


def test_a_number_for_each_case_is_refused() -> None:
    thermal = scene().thermal
    with pytest.raises(qs.SceneError, match=r"thermal\.fixed\.ambient: is an array\. All cases share one network"):
        replace(thermal, fixed={"ambient": np.array([300.0, 310.0])})


def test_what_no_steady_state_could_change_is_said_as_it_is() -> None:
    with pytest.raises(qs.SceneError, match="reached through the given temperatures and heats, without friction"):
        qs.solve(scene(thermal=tables()["thermal"] | {"heats": {"inner_ring_W": 5000}}))
    reversed_load = qs.solve(scene(preload=None, operation={"speed_rpm": 8000, "axial_load_N": -400}))
    assert str(reversed_load.reason) == "open_side" and "open side of the groove" in qs.message(reversed_load)


def test_a_temperature_that_the_balance_finds_is_refused() -> None:
    with pytest.raises(qs.SceneFileError, match="inner_ring_temperature_C = 60 °C: is found by the heat balance"):
        scene(effects=EFFECTS | {"ring_expansion": {"inner_ring_temperature_C": 60}})
    assert BEARING["bore_diameter_mm"] == 35


def test_effects_of_a_scene_with_heat_are_not_chosen_and_that_is_said(tmp_path: Path) -> None:
    file = tmp_path / "result.json"
    file.write_text(json.dumps({"version": qs.__version__, "input": tables()}))
    run = CliRunner().invoke(cli, ["run", str(file), "--accuracy", "1e-3"])
    assert run.exit_code == 2 and "heat balance" in run.output, run.exception


def test_effects_are_not_chosen_beside_a_heat_balance() -> None:
    of, of_set = scene(), pair()
    for solve, given in ((qs.solve, of), (qs.solve_set, of_set)):
        with pytest.raises(ValueError, match=r"accuracy = 0\.01 is the error"):
            solve(given, accuracy=0.01)
        with pytest.raises(ValueError, match=r"not chosen for a .* with a heat balance"):
            solve(given, effects="auto", accuracy=0.01)
