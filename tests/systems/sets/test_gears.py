"""Gears and belts: a printed example, balances of forces as vectors in space, mirror images, and what is refused."""

from __future__ import annotations

import tomllib
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.set_file import set_of
from qsbearing.results.set_record import set_record
from qsbearing.results.shaft_report import shaft_tables
from qsbearing.studies.schema import file_schema
from qsbearing.systems.sets.preload_limits import loaded, set_at_speed
from qsbearing.systems.sets.solve import HotSet
from tests.systems.heat.spindle import pair
from tests.systems.sets.arrangements import S6210C
from tests.systems.sets.test_elastic_shaft import bare

INCH, POUND, HORSEPOWER = 25.4e-3, 4.4482216, 745.7
STIFF = 1e12
RNG = np.random.default_rng(66)
SPEED = 1800 * qs.rpm
HELICAL = qs.Gear(0.08, 0.3, 0.06, torque=40.0, helix_angle=25 * qs.deg, hand="right", drives=False)  # type: ignore[arg-type]
BEVEL = qs.Gear(0.08, 0.3, 0.06, torque=40.0, cone_angle=35 * qs.deg, apex="+x", drives=False)  # type: ignore[arg-type]


def test_the_forces_and_reactions_of_a_textbook_s_motor_shaft() -> None:
    """Shigley, example 13-9: a motor of 1 hp turns clockwise, seen from +x; bearings at 0 and 10 in, pinion at 13."""
    pinion = qs.Gear(
        13 * INCH, 0.0, teeth=18, normal_module=INCH / 12, power=HORSEPOWER, helix_angle=30 * qs.deg, hand="right",
        drives=True,
    )  # type: ignore[call-arg]  # fmt: skip
    forces = pinion.forces(-SPEED)
    printed = (35.0 * POUND * INCH, 40.4 * POUND, 17.0 * POUND, -23.3 * POUND)
    half_digits = (0.5 * POUND * INCH, *[0.05 * POUND] * 3)
    for found, wanted, within in zip(forces, printed, half_digits, strict=True):
        assert float(found) == pytest.approx(wanted, abs=within)
    ends = (
        qs.ShaftSupport(0.0, axial=STIFF, radial_y=STIFF, radial_z=STIFF),
        qs.ShaftSupport(10 * INCH, radial_y=STIFF, radial_z=STIFF),
    )
    solved = bare(qs.Shaft(supports=ends, gears=(pinion,)), speed=-SPEED)
    reactions = -solved.support_loads[:, :3] / POUND
    # To the printed digits, of which the textbook computes on: 0.1 lbf.
    assert reactions == pytest.approx(np.array([[23.3, -3.1, 12.1], [0.0, 20.1, -52.5]]), abs=0.1)


def flank_push(of: qs.Gear, speed: float) -> tuple[NDArray, NDArray]:
    """(place, force) of the mate on a gear as vectors: square to the flank, as large as the torque asks."""
    turn = float(of.azimuth)  # type: ignore[arg-type]
    along, round_, out = (
        np.eye(3)[0],
        np.array([0.0, -np.sin(turn), np.cos(turn)]),
        np.array([0.0, np.cos(turn), np.sin(turn)]),
    )
    assert of.torque is not None and of.pitch_diameter is not None
    torque = float(of.torque) * np.sign(speed) * (-1.0 if of.drives else 1.0)  # type: ignore[arg-type]
    if of.cone_angle is not None:
        tip = 1.0 if of.apex == "+x" else -1.0
        trace = -tip * np.cos(of.cone_angle) * along + np.sin(of.cone_angle) * out
        outwards = tip * np.sin(of.cone_angle) * along + np.cos(of.cone_angle) * out
    else:
        lead = np.tan(of.helix_angle) * (1.0 if of.hand == "right" else -1.0)
        trace, outwards = along + lead * round_, -out if of.internal else out
    assert trace @ outwards == pytest.approx(0.0, abs=1e-12)
    side = np.cross(outwards, trace) / np.linalg.norm(trace)  # square to the trace, in the pitch surface
    side *= np.sign(side @ round_ * torque)
    angle = 20 * qs.deg if of.normal_pressure_angle is None else of.normal_pressure_angle
    push = np.cos(angle) * side - np.sin(angle) * outwards
    place = np.array([of.position, 0.0, 0.0]) + 0.5 * float(of.pitch_diameter) * out  # type: ignore[arg-type]
    about = np.cross(place, push)[0]
    return place, push * torque / about


def random_gear() -> qs.Gear:
    common: dict[str, Any] = {
        "torque": RNG.uniform(5.0, 200.0),
        "normal_pressure_angle": RNG.uniform(14.0, 25.0) * qs.deg if RNG.integers(4) else None,
        "drives": bool(RNG.integers(2)),
    }
    kind = RNG.integers(4)
    if kind == 0:
        common |= {"cone_angle": RNG.uniform(10.0, 80.0) * qs.deg, "apex": RNG.choice(["+x", "-x"])}
    elif kind < 3:
        common |= {"helix_angle": RNG.uniform(1.0, 45.0) * qs.deg, "hand": RNG.choice(["right", "left"])}
        common["internal"] = bool(RNG.integers(2))
    return qs.Gear(RNG.uniform(-0.05, 0.25), RNG.uniform(-3.0, 6.0), RNG.uniform(0.03, 0.2), **common)


@pytest.mark.parametrize("number", range(40))
def test_rows_carry_what_flanks_push_with(number: int) -> None:
    gears, speed = tuple(random_gear() for _ in range(1 + number % 3)), RNG.choice([-1.0, 1.0]) * SPEED
    rows = (qs.Row(S6210C, 0.0, "+x"), qs.Row(S6210C, 0.2, "-x"))  # type: ignore[arg-type]
    of = qs.BearingSet(
        rows, qs.Operation(speed, moment_y=0.0, moment_z=0.0), qs.Preload(rigid=2000.0), shaft=qs.Shaft(gears=gears)
    )
    pushes = [flank_push(each, speed) for each in gears]
    middle = np.array([0.1, 0.0, 0.0])
    force = sum(push for _, push in pushes)
    moment = sum(np.cross(place - middle, push) for place, push in pushes)
    solution = qs.solve_set(of)
    assert solution.converged
    scale = np.abs(force).max()  # type: ignore[arg-type]
    carried = solution.row_loads.sum(axis=0)
    # The equilibrium is found to 1e-10 of the largest force on a row, which the preload may make larger than the push.
    assert carried[:3] == pytest.approx(force, abs=1e-7 * scale)
    assert carried[3:] == pytest.approx(np.asarray(moment)[1:], abs=1e-8 * scale)
    assert float(solution.torque_sum) == pytest.approx(moment[0], rel=1e-9)  # type: ignore[index,arg-type]


@pytest.mark.parametrize("speed", [SPEED, -SPEED])
@pytest.mark.parametrize("larger", [0.05, 0.11, 0.3], ids=["smaller", "alike", "larger"])
@pytest.mark.parametrize("drives", [True, False])
def test_a_belt_pulls_along_its_strands(speed: float, larger: float, drives: bool) -> None:
    """Both strands as tangents of two circles, their tensions at the points where they touch."""
    radius, away, turn, ratio, torque = 0.055, 0.4, 0.7, 3.0, 12.0
    lean = np.arcsin((0.5 * larger - radius) / away)
    belt = qs.Belt(
        0.1, turn, 2 * radius, torque=torque, tension_ratio=ratio, wrap_angle=np.pi - 2 * lean, drives=drives
    )
    out, round_ = np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)])
    about = torque * np.sign(speed) * (-1.0 if drives else 1.0)
    slack = torque / radius / (ratio - 1.0)
    force, moment = np.zeros(2), 0.0
    for side in (1.0, -1.0):
        touch = radius * (side * np.cos(lean) * round_ - np.sin(lean) * out)
        strand = np.cos(lean) * out + side * np.sin(lean) * round_
        assert touch @ strand == pytest.approx(0.0, abs=1e-15)
        pull = strand * (ratio * slack if side * about < 0.0 else slack)
        force, moment = force + pull, moment + touch[0] * pull[1] - touch[1] * pull[0]
    assert moment == pytest.approx(about, rel=1e-12)
    load = np.array(belt.load(speed))
    assert load[1:3] == pytest.approx(force, rel=1e-12)
    assert not load[[0, 3, 4]].any()
    pretensioned = replace(belt, tension_ratio=None, pretension=0.5 * (ratio + 1.0) * slack)
    assert np.array(pretensioned.load(speed)) == pytest.approx(load, rel=1e-12)


def test_a_mirrored_hand_turns_the_axial_force_alone() -> None:
    right, left = (np.array(replace(HELICAL, hand=hand).forces(SPEED)) for hand in ("right", "left"))  # type: ignore[arg-type]
    assert (left == right * [1, 1, 1, -1]).all() and right[3] != 0.0


@pytest.mark.parametrize(("gear", "turned"), [(HELICAL, [-1, -1, 1, -1]), (BEVEL, [-1, -1, 1, 1])])
def test_a_mirrored_torque_turns_what_it_must(gear: qs.Gear, turned: list[int]) -> None:
    forces = np.array(gear.forces(SPEED))
    assert (forces != 0.0).all()
    mirrored = (replace(gear, drives=True), SPEED), (replace(gear, torque=-40.0), SPEED), (gear, -SPEED)
    for each, speed in mirrored:
        assert (np.array(each.forces(speed)) == forces * turned).all()
    assert np.array(replace(gear, torque=None, power=40.0 * SPEED).forces(SPEED)) == pytest.approx(forces, rel=1e-15)


SET = """
[bearing]
name = "7210C"
[[rows]]
position_mm = 0
carries = "+x"
[[rows]]
position_mm = 200
carries = "-x"
[operation]
speed_rpm = 1800
[preload]
rigid_N = 500
[[shaft.gears]]
position_mm = 80
azimuth_deg = 90
teeth = 18
normal_module_mm = 2.5
helix_angle_deg = 30
hand = "right"
kind = "helical"
power_kW = 1
drives = true
[[shaft.gears]]
position_mm = 120
azimuth_deg = -20
pitch_diameter_mm = 60
cone_angle_deg = 40
apex = "-x"
torque_Nm = 3
drives = false
[[shaft.belts]]
position_mm = 250
azimuth_deg = 180
pitch_diameter_mm = 100
torque_Nm = 4
pretension_N = 90
wrap_angle_deg = 170
drives = false
"""


def read(text: str) -> qs.BearingSet:
    return set_of(tomllib.loads(text), "gears.toml", "gears")


def test_a_file_comes_back_as_it_was_read() -> None:
    of = read(SET)
    assert of.shaft is not None
    assert of.shaft.gears[0] == qs.Gear(
        80 * qs.mm, 90 * qs.deg, None, 18, 2.5 * qs.mm, power=1e3, helix_angle=30 * qs.deg, kind="helical",
        hand="right", drives=True,
    )  # type: ignore[arg-type]  # fmt: skip
    written = input_tables(of)
    again = set_of(written, "again.toml", "gears")
    assert again.shaft == of.shaft and input_tables(again) == written
    assert written["shaft"]["gears"][1]["apex"] == "-x" and written["shaft"]["belts"][0]["drives"] is False


def test_the_schema_knows_words_and_numbers() -> None:
    schema = file_schema()
    gears = schema["properties"]["shaft"]["properties"]["gears"]["items"]["properties"]
    assert gears["hand"]["enum"] == ["right", "left"] and gears["drives"]["type"] == "boolean"
    assert gears["power_kW"]["type"] == ["integer", "number"]


def test_results_name_forces_and_the_sum_of_torques() -> None:
    solution = qs.solve_set(read(SET))
    shaft = set_record(solution, [{}, {}])["shaft"]
    first, second = shaft["gears"]
    torque = 1000.0 / SPEED
    assert first["torque_Nm"] == pytest.approx(-torque, rel=1e-9) and second["torque_Nm"] == 3.0
    assert shaft["torque_sum_Nm"] == pytest.approx(7.0 - torque, rel=1e-9)
    assert shaft["belts"][0]["tight_tension_N"] == pytest.approx(90.0 + 40.0, rel=1e-12)
    text = repr(shaft_tables(shaft))
    assert first["assumed"] == {"normal_pressure_angle_deg": 20.0} and shaft["belts"][0]["assumed"] == {}
    assert "Assumed: normal_pressure_angle_deg = 20 of gear 1 and normal_pressure_angle_deg = 20 of gear 2" in text
    assert "gear 2" in text and "belt 1" in text and "Torques on the shaft together: 1.6948 N m" in text
    said = [each for each in qs.warnings(solution) if each.remark.code == "torques_differ"]
    assert [each.remark.values["sum_Nm"] for each in said] == [pytest.approx(7.0 - torque, rel=1e-9)]
    balanced = read(SET.replace("power_kW = 1\n", "torque_Nm = 7\n"))
    assert not [each for each in qs.warnings(qs.solve_set(balanced)) if each.remark.code == "torques_differ"]


def test_torques_span_cases_and_grow_with_the_loads() -> None:
    of = read(SET)
    assert of.shaft is not None
    gear = replace(HELICAL, torque=np.array([20.0, 40.0]))
    several = replace(of, shaft=replace(of.shaft, gears=(gear,), belts=()))
    found = qs.solve_set(several)
    one = qs.solve_set(replace(several, shaft=qs.Shaft(gears=(HELICAL,))))
    assert found.shape == (2,)
    assert found.row_loads[1] == pytest.approx(one.row_loads, rel=1e-9, abs=1e-6)
    twice, single = loaded(of, 2.0), of
    for kind in ("gears", "belts"):
        for large, small in zip(getattr(twice.shaft, kind), getattr(single.shaft, kind), strict=True):
            assert np.array(large.load(SPEED)) == pytest.approx(2.0 * np.array(small.load(SPEED)), rel=1e-12)


def test_what_is_left_of_a_preload_is_that_without_gears_and_belts() -> None:
    of = read(SET)
    without = qs.solve_set(replace(of, shaft=None))
    solution = qs.solve_set(of)
    assert solution.preload_in_operation == pytest.approx(without.axial_loads, rel=1e-9)
    assert np.abs(solution.axial_loads - without.axial_loads).max() > 1.0  # type: ignore[operator]


def test_a_gear_loads_a_bending_shaft_as_its_load_does() -> None:
    sections = (qs.ShaftSection(0.3, 0.045),)
    rows = (qs.Row(S6210C, 0.02, "+x"), qs.Row(S6210C, 0.22, "-x"))  # type: ignore[arg-type]
    operation = qs.Operation(SPEED, moment_y=0.0, moment_z=0.0)
    load = qs.ShaftLoad(HELICAL.position, *HELICAL.load(SPEED))
    by_gear, by_load = (
        qs.solve_set(qs.BearingSet(rows, operation, qs.Preload(rigid=500.0), shaft=qs.Shaft(sections, **shaft)))
        for shaft in ({"gears": (HELICAL,)}, {"loads": (load,)})
    )
    assert (by_gear.deflection([0.0, 0.08, 0.3]) == by_load.deflection([0.0, 0.08, 0.3])).all()
    assert {"gear 1"} == by_gear.line.keys() - by_load.line.keys()


WRONG = {
    "power_kW = 1\n": {
        "": ["shaft.gear 1.torque_Nm: missing", "Give torque_Nm, or power_kW"],
        "power_kW = 1\ntorque_Nm = 3\n": ["is given together with the power"],
        "power_kW = 1e9\n": ["shaft.gear 1.power_kW = 1000000000 kW", "is too large"],
    },
    "speed_rpm = 1800": {
        "speed_rpm = 0": ["shaft.gear 1.power_kW: gives no torque at the speed 0", "operation.speed_rpm"],
    },
    "helix_angle_deg = 30\n": {
        "helix_angle_deg = 65\n": ["is beyond that of a helical gear", "allowed: 0 to 60 deg"],
        "": ["shaft.gear 1.helix_angle_deg: missing"],
    },
    'hand = "right"\n': {
        "": ["shaft.gear 1.hand: missing", "direction of the axial force"],
        'hand = "up"\n': ["is not one of right, left"],
    },
    'kind = "helical"': {
        'kind = "worm"': ["shaft.gear 1.kind = 'worm': is not computed: worm gears: the friction"],
        'kind = "hypoid"': ["hypoid gears: its axes do not meet"],
        'kind = "spiral bevel"': ["spiral gears"],
        'kind = "spur"': ["does not suit its helix angle"],
        'kind = "wheel"': ["is not one of spur, helical, straight_bevel"],
    },
    "drives = true\n": {
        "": ["shaft.gear 1.drives: missing"],
        'drives = "yes"\n': ["is neither true nor false"],
    },
    "teeth = 18\n": {
        "": ["shaft.gear 1.pitch_diameter_mm: missing", "teeth and normal_module_mm"],
        "teeth = 18.5\n": ["is not a whole number"],
        "teeth = 18\npitch_diameter_mm = 50\n": ["is given together with teeth or module"],
    },
    'apex = "-x"\n': {"": ["shaft.gear 2.apex: missing"]},
    "pitch_diameter_mm = 60\n": {"teeth = 30\nnormal_module_mm = 2\n": ["is needed of a bevel gear"]},
    "pretension_N = 90\n": {
        "": ["shaft.belt 1.pretension_N: missing"],
        "pretension_N = 90\ntension_ratio = 3\n": ["is given together with the ratio"],
        "pretension_N = 30\n": ["leaves the slack strand without tension", "More than 40 N"],
        "tension_ratio = 1\n": ["shaft.belt 1.tension_ratio = 1: is too small"],
    },
    "azimuth_deg = 90\n": {
        "": ["shaft.gear 1.azimuth_deg: missing"],
        "azimuth_rad = 1.5\n": ["unknown key", "azimuth_deg = 85.94"],
    },
    "torque_Nm = 4\n": {"torque_kNm = 0.004\n": ["Did you mean torque_Nm = 4?"]},
    "[preload]": {"[shaft]\nsections = [{length_mm = 400, outer_diameter_mm = 70}]\n[preload]": [
        "shaft.gear 1.pitch_diameter_mm", "is less than the diameter of the shaft", "70 mm",
    ]},
}  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [(old, new, told) for old, each in WRONG.items() for new, told in each.items()],
    ids=lambda each: each if isinstance(each, str) else "",
)
def test_what_is_wrong_is_told_by_its_key(old: str, new: str, told: list[str]) -> None:
    with pytest.raises(qs.SceneFileError) as caught:
        read(SET.replace(old, new, 1))
    text = str(caught.value)
    assert [each for each in told if each not in text] == [], text


def test_all_faults_of_a_file_are_told_at_once() -> None:
    broken = SET.replace('hand = "right"\n', "").replace("power_kW = 1\n", "").replace("pretension_N = 90\n", "")
    with pytest.raises(qs.SceneFileError) as caught:
        read(broken)
    assert len(caught.value.errors) == 3
    worse = broken.replace("azimuth_deg = 90\n", "").replace("torque_Nm = 3\n", 'torque_Nm = "3"\n')
    with pytest.raises(qs.SceneFileError) as caught:
        read(worse.replace('apex = "-x"\n', "") + "[shaft]\n")
    assert {each.key for each in caught.value.errors} == {  # type: ignore[attr-defined]
        "shaft.gear 1.azimuth_deg", "shaft.gear 1.hand", "shaft.gear 1.torque_Nm", "shaft.gear 2.torque_Nm",
        "shaft.gear 2.apex", "shaft.belt 1.pretension_N",
    }  # fmt: skip


def test_a_mesh_in_a_plane_pushes_in_that_plane_alone() -> None:
    spur = replace(HELICAL, helix_angle=0.0, azimuth=90 * qs.deg, torque=0.0)
    inwards = replace(spur, torque=40.0)
    assert not np.any(spur.load(SPEED))
    _, y, z, moment_y, moment_z = inwards.load(SPEED)
    assert (
        y == -40.0 / 0.03 and z == pytest.approx(-40.0 / 0.03 * np.tan(20 * qs.deg)) and not moment_y and not moment_z
    )
    flat = replace(HELICAL, azimuth=90 * qs.deg).load(SPEED)
    assert flat[4] == 0.0 and flat[3] == pytest.approx(flat[0] * 0.03)


def test_a_spectrum_has_a_torque_of_each_of_its_points() -> None:
    points = """
[[spectrum]]
share = 0.25
speed_rpm = 1800
"shaft.gears.2.torque_Nm" = 3
[[spectrum]]
share = 0.75
speed_rpm = -900
"shaft.gears.2.torque_Nm" = 6
[readings.life]
"""
    of = read(SET.replace("[operation]\nspeed_rpm = 1800\n", "") + points)
    assert of.shaft is not None
    shares = qs.solve_set(of).torque_sum
    torque = 1000.0 / SPEED
    assert shares == pytest.approx([3.0 + 4.0 - torque, -6.0 - 4.0 + 2.0 * torque], rel=1e-9)


def test_torques_stay_while_the_speed_is_searched_through() -> None:
    """From rest on, where a power gives none."""
    of = read(SET)
    by_torque = read(SET.replace("power_kW = 1\n", f"torque_Nm = {1000.0 / SPEED!r}\n"))
    for highest in (3.0 * SPEED, 8.0 * SPEED):
        one, other = (qs.preload_speeds(each, highest) for each in (of, by_torque))
        assert [each.sentence for each in one] == [each.sentence for each in other]
    for factor in (0.0, 0.5, 2.0):
        turning = [set_at_speed(each, factor * SPEED) for each in (of, by_torque)]
        loads = [np.array([load.values for load in each.shaft_loads]) for each in turning]
        assert loads[0] == pytest.approx(loads[1], rel=1e-12)


def test_torques_stay_while_a_heat_balance_searches_the_speed() -> None:
    gear = {"position_mm": 25, "azimuth_deg": 0, "pitch_diameter_mm": 60, "power_kW": 0.5, "drives": True}
    of = pair(shaft={"gears": [gear]})
    solution = qs.solve_set(of)
    assert solution.thermal is not None
    speed = float(of.operation.speed)  # type: ignore[arg-type]
    temperatures = {name: np.asarray(each) for name, each in solution.thermal.temperatures.items()}
    machine = HotSet(of, (), lambda each: each)  # type: ignore[arg-type,return-value]
    for factor in (0.1, 1.0, 1.5):
        made = machine.solve(temperatures, np.asarray(factor))
        assert float(made.operation.speed) == pytest.approx(factor * speed)  # type: ignore[attr-defined]
        (load,) = made.shaft_loads  # type: ignore[attr-defined]
        assert float(load.radial_z) == pytest.approx(-500.0 / speed / 0.03, rel=1e-12)
