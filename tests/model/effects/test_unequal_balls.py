"""Balls of unequal diameters: against bearings of other balls, by symmetry, by rates, and what is refused."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from tests.model.effects.uneven import contacts, turned
from tests.qsbearing.scenes import (
    B218,
    BOTH,
    DEEP_GROOVE,
    INNER,
    LOADS,
    MINIMUM_DISSIPATION,
    OUTER,
    held_at,
    loaded_as,
    resting,
    solved,
    turning,
    unequal_balls,
    with_operation,
)

FIVE = {"axial_load": 12e3, "radial_load_y": 3e3, "radial_load_z": -1.5e3, "moment_y": 40.0, "moment_z": -60.0}
PLAIN = {"axial_load": 12e3, "radial_load_y": 3e3, "moment_z": 0.0}


def of(scene: qs.Scene, deviations: Any) -> qs.Scene:
    """The scene with balls that deviate so, beside its other ring effects."""
    return replace(scene, ring_effects=(*scene.ring_effects, qs.BallDiameterDeviations(deviations)))


# ------------------------------------------------------------------------------------------------ all balls alike


@pytest.mark.parametrize("orbit", list(qs.OrbitRadius))
@pytest.mark.parametrize("control", [OUTER, INNER])
@pytest.mark.parametrize("deviation", [3e-6, -2e-6])
def test_balls_that_all_deviate_alike_are_a_bearing_of_that_ball_diameter(
    deviation: float, control: qs.RacewayControl, orbit: qs.OrbitRadius
) -> None:
    """To rounding, with curvatures at each contact's own angle: nothing else of the nominal bearing is left then, as
    grooves of equal radius keep the pitch circle. The datum of the axial displacement stays the nominal one."""
    scene = replace(turning(5000, hertz_angle="actual", control=control, **FIVE), orbit_radius=orbit)
    other = B218.with_changed_lengths(ball_diameter=deviation)
    assert other.pitch_diameter == pytest.approx(B218.pitch_diameter, rel=1e-15)
    one, same = solved(of(scene, np.full(16, deviation))), solved(replace(scene, bearing=other))
    datum = float(other.touching_offset - B218.touching_offset)
    assert one.displacement - [datum, 0, 0, 0, 0] == pytest.approx(same.displacement, rel=1e-10, abs=1e-15)
    for name, array in contacts(one).items():
        assert array == pytest.approx(contacts(same)[name], rel=1e-10), name
    size = np.sqrt(np.diag(same.stiffness))
    assert one.stiffness / np.outer(size, size) == pytest.approx(same.stiffness / np.outer(size, size), abs=1e-10)
    assert np.abs(one.inner.load / solved(scene).inner.load - 1.0).max() > 1e-3


@pytest.mark.parametrize("control", [OUTER, MINIMUM_DISSIPATION])
def test_what_stays_nominal_hardly_counts(control: qs.RacewayControl) -> None:
    """Curvatures, and weights of minimum dissipation, at the free angle stay at the nominal one, which turns by 2
    mrad: a hundredth of what the balls change."""
    scene = turning(8000, control=control, **FIVE)
    other = replace(scene, bearing=B218.with_changed_lengths(ball_diameter=2e-6))
    one, same, nominal = solved(of(scene, np.full(16, 2e-6))), solved(other), solved(scene)
    change = np.abs(same.inner.load - nominal.inner.load).max()
    assert 0.0 < np.abs(one.inner.load - same.inner.load).max() < 0.01 * change


def test_hot_balls_deviate_in_proportion() -> None:
    """Larger balls that grow are those of a bearing with larger balls that grow; masses stay cold."""
    hot = (qs.BallExpansion(90.0 + qs.zero_celsius),)
    bearing = replace(B218, ball_material=replace(qs.STEEL, thermal_expansion=12e-6))
    scene = replace(turning(8000, bearing, hertz_angle="actual", **FIVE), ring_effects=hot)
    other = replace(scene, bearing=bearing.with_changed_lengths(ball_diameter=5e-6))
    one, same = solved(of(scene, np.full(16, 5e-6))), solved(other)
    for name, array in contacts(one).items():
        assert array == pytest.approx(contacts(same)[name], rel=1e-10), name


@pytest.mark.parametrize(
    "loads", [{"radial_load_y": 40.0, "axial_displacement": 0.0, "tilt_y": 0.0, "tilt_z": 0.0}, {"axial_load": 300.0}]
)
def test_balls_too_large_for_their_grooves_are_wedged(loads: dict[str, float]) -> None:
    """Without clearance, as in a bearing whose balls are as large; a free angle of zero stays there. That bearing's
    pitch circle has moved by 2 um, 5e-5 of it, which curvatures follow."""
    scene = resting(DEEP_GROOVE, **loads)
    other = DEEP_GROOVE.with_changed_lengths(ball_diameter=2e-6)
    assert other.radial_interference == pytest.approx(2e-6)
    one, same = solved(of(scene, np.full(7, 2e-6))), solved(replace(scene, bearing=other))
    assert (same.inner.load > 0.0).all()
    assert one.inner.load == pytest.approx(same.inner.load, rel=1e-5)
    assert one.displacement == pytest.approx(same.displacement, rel=1e-5, abs=1e-15)


def test_wedged_balls_press_each_other_without_any_load() -> None:
    """One ball 2 um larger than six others that fill their grooves: its load is what the others return, Q cos psi."""
    solution = solved(of(resting(DEEP_GROOVE, axial_load=0.0), [4e-6] + 6 * [2e-6]))
    load = solution.inner.load
    assert load.min() > 0.0
    assert load[0] > 1.05 * load[2:6].max()
    assert load @ np.cos(solution.azimuth) == pytest.approx(0.0, abs=1e-9 * load.max())
    assert load @ np.sin(solution.azimuth) == pytest.approx(0.0, abs=1e-9 * load.max())


# ------------------------------------------------------------------------------------------------ none, and symmetry


@pytest.mark.parametrize(
    "scene",
    [
        turning(8000, axial_load=12e3),
        turning(8000, **PLAIN),
        turning(8000, **FIVE),
        replace(turning(9000, control=MINIMUM_DISSIPATION, **PLAIN), orbit_radius="displaced"),
        replace(resting(radial_load_y=2e3, tilt_y=0.0, tilt_z=0.0), preload=qs.Preload(rigid=2e3)),
    ],
    ids=["thrust", "one plane", "five loads", "minimum dissipation, own orbits", "preload"],
)
def test_no_deviation_is_none_to_the_last_bit(scene: qs.Scene) -> None:
    one, absent = solved(of(scene, np.zeros(16))), solved(scene)
    for name in ("displacement", "load", "iterations", "residual", "stiffness"):
        assert np.array_equal(getattr(one, name), getattr(absent, name)), name
    for name, array in contacts(one).items():
        assert np.array_equal(array, contacts(absent)[name], equal_nan=True), name


def test_deviations_and_loads_that_go_round_turn_the_answer() -> None:
    """By three balls of sixteen: another order of sums, so to rounding."""
    turns, given = 3, unequal_balls().array
    angle = 2.0 * np.pi * turns / 16
    load = np.array([FIVE[name] for name in LOADS])

    scene = turning(8000, **FIVE)
    one, other = solved(of(scene, given)), solved(of(loaded_as(scene, turned(load, angle)), np.roll(given, turns)))
    size = np.array([1e-5, 1e-5, 1e-5, 1e-4, 1e-4])
    assert other.displacement / size == pytest.approx(turned(one.displacement, angle) / size, abs=1e-9)
    for name, array in contacts(one).items():
        assert contacts(other)[name] == pytest.approx(np.roll(array, turns), rel=1e-9), name


def test_mirror_images_are_solved_each_on_its_own() -> None:
    """Loads of one plane, unequal balls: nothing is symmetric, and the ring leaves the plane."""
    deviations = np.zeros(16)
    deviations[3] = 2e-6
    solution = solved(of(turning(8000, **PLAIN), deviations))
    assert solution.displacement[2] < -1e-9
    assert solution.inner.load[3] - solution.inner.load[13] > 10.0
    mirrored = solved(of(turning(8000, **PLAIN), np.roll(deviations[::-1], 1)))
    assert mirrored.displacement[2] == pytest.approx(-solution.displacement[2], rel=1e-9)
    assert mirrored.inner.load[13] == pytest.approx(solution.inner.load[3], rel=1e-10)


# ------------------------------------------------------------------------------------------------ rates


def series_stiffness(diameter: float) -> float:
    """K of a ball of this diameter between B218's grooves at its free angle, both contacts in series."""
    compliance = 0.0
    for side in (-1.0, 1.0):
        rolling = 2.0 / (diameter * (1.0 + side * diameter / 0.12526 * np.cos(40 * qs.deg)))
        across = 2.0 / diameter - 1.0 / 11.6281e-3
        modulus = float(B218.effective_modulus)
        compliance += qs.point_contact(1.0, rolling, across, modulus).stiffness_constant ** (-2.0 / 3.0)
    return compliance**-1.5


def test_one_large_ball_between_fixed_rings_carries_more_by_its_spring() -> None:
    """At rest Q = K (delta + deviation)^1.5 with its own K: to first order k times the deviation, k = 1.5 Q/delta, and
    Q dK/K, which is 0.6 % of that; what is left falls with the deviation. Other balls feel nothing."""
    start = solved(resting(axial_load=17_800.0, tilt_y=0.0, tilt_z=0.0))
    sizes = np.array([1e-8, 2e-8, 4e-8])
    deviations = np.zeros((3, 16))
    deviations[:, 0] = sizes
    solution = solved(of(held_at(start.scene, start.displacement), deviations))
    approach = start.inner.approach[0] + start.outer.approach[0]
    own = np.array([series_stiffness(22.225e-3 + size) for size in sizes])
    assert solution.inner.load[:, 0] == pytest.approx(own * (approach + sizes) ** 1.5, rel=1e-10)
    rate = (solution.inner.load[:, 0] - start.inner.load[0]) / sizes
    assert rate / (1.5 * start.inner.load[0] / approach) == pytest.approx(np.ones(3), rel=0.01)
    assert np.diff(rate)[1] / np.diff(rate)[0] == pytest.approx(2.0, rel=0.01)
    assert np.allclose(solution.inner.load[:, 1:], start.inner.load[1:], rtol=1e-10, atol=0.0)


def test_a_free_ring_shares_what_one_ball_carries_more() -> None:
    """At rest under thrust, tilts held: to first order the ring moves axially and aside by what balances, which leaves
    the ball 1 - 3/Z of its deviation (the part beyond its mean and first harmonic)."""
    deviations = np.zeros(16)
    deviations[0] = 1e-8
    scene = resting(axial_load=17_800.0, tilt_y=0.0, tilt_z=0.0)
    start, solution = solved(scene), solved(of(scene, deviations))
    spring = 1.5 * start.inner.load[0] / (start.inner.approach[0] + start.outer.approach[0])
    more = (solution.inner.load[0] - start.inner.load[0]) / (spring * 1e-8)
    # Turning contact lines hold the ring a little too: Q/BD beside k, 2 %.
    assert more == pytest.approx(1.0 - 3.0 / 16.0, rel=0.02)
    assert (solution.inner.load - start.inner.load).sum() == pytest.approx(0.0, abs=0.02 * spring * 1e-8)


def test_stiffness_is_the_slope_of_the_load() -> None:
    """Exact derivatives, by central differences of prescribed displacements."""
    scene = replace(turning(5000, effects=BOTH, **FIVE), orbit_radius="displaced", ring_effects=(unequal_balls(),))
    solution = solved(scene)
    steps = np.array([1e-7, 1e-7, 1e-7, 2e-6, 2e-6])
    at = solution.displacement + np.concatenate([np.diag(steps), -np.diag(steps)])
    loads = solved(held_at(scene, at)).load
    slopes = ((loads[:5] - loads[5:]) / (2.0 * steps[:, None])).T
    own = np.sqrt(np.abs(np.diag(solution.stiffness)))
    assert np.abs((slopes - solution.stiffness) / np.outer(own, own)).max() < 1e-5


# ------------------------------------------------------------------------------------------------ cases and results


def test_deviations_of_cases_by_balls_are_those_of_each_case_alone() -> None:
    """A thousand sets of balls at once; some of them equal, and two speeds across."""
    rng = np.random.default_rng(3)
    deviations = rng.normal(0.0, 1e-6, (1000, 1, 16))
    deviations[::7] = 0.0
    scene = turning(np.array([4000.0, 9000.0]), **FIVE)
    many = solved(of(scene, deviations))
    assert many.shape == (1000, 2)
    assert many.ball_diameter_deviation.shape == (1000, 2, 16)  # type: ignore[union-attr]
    for k in (0, 1, 500, 999):
        for speed, rpm in enumerate((4000.0, 9000.0)):
            one = solved(of(turning(rpm, **FIVE), deviations[k, 0]))
            assert np.array_equal(many.displacement[k, speed], one.displacement)
            for name, array in contacts(one).items():
                assert np.array_equal(contacts(many)[name][k, speed], array), name
            assert np.array_equal(many.stiffness[k, speed], one.stiffness)


def test_a_solution_starts_from_a_neighbour() -> None:
    """Warm starts know balls by their number."""
    scene = of(turning(8000, **FIVE), unequal_balls().array)
    start = solved(scene)
    near = with_operation(scene, axial_load=12.1e3)
    warm, cold = solved(near, start=start), solved(near)
    assert warm.iterations <= cold.iterations
    assert warm.inner.load == pytest.approx(cold.inner.load, rel=1e-10)


def test_the_bearing_as_mounted_has_its_balls() -> None:
    """The preload is what it is with these balls, at rest and cold."""
    scene = replace(
        turning(6000, radial_load_y=2e3, tilt_y=0.0, tilt_z=0.0), preload=qs.Preload(axial_displacement=10e-6)
    )
    equal, unequal = solved(scene), solved(of(scene, np.full(16, 4e-6)))
    straight = resting(
        axial_displacement=10e-6, **dict.fromkeys(("radial_displacement_y", "radial_displacement_z"), 0.0)
    )
    held = with_operation(straight, tilt_y=0.0, tilt_z=0.0)
    assert unequal.preload_at_rest == pytest.approx(solved(of(held, np.full(16, 4e-6))).load[0], rel=1e-12)
    assert unequal.preload_at_rest > 1.2 * equal.preload_at_rest


SCENE = """[bearing]
name = "B218"
[operation]
axial_load_N = 5000
[effects]
ball_diameter_deviations_um = {}
"""
BALLS = [1.0, 0, -0.5, *([0] * 13)]


def test_files_name_them_and_results_repeat_them(tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    file, table = tmp_path / "scene.toml", tmp_path / "balls.csv"
    file.write_text(SCENE.format(BALLS), encoding="utf-8")
    scene = qs.load_scene(file)
    solution = solved(scene)
    assert scene.ball_diameter_deviations.array == pytest.approx(np.array(BALLS) * 1e-6, rel=1e-15)  # type: ignore[union-attr]
    shown = CliRunner().invoke(cli, ["run", str(file), "--csv", str(table)])
    assert "D - D0" in shown.stdout
    assert "Geometry before loading" not in shown.stdout, "the bearing's own lengths are what they were"
    found = json.loads(CliRunner().invoke(cli, ["run", str(file), "--json"]).stdout)
    assert found["effects"] == ["unequal_balls"]
    assert found["operating_geometry"] is None
    for values in (
        [ball["ball_diameter_deviation_um"] for ball in found["balls"]],
        pandas.read_csv(table)["ball_diameter_deviation_um"],
        solution.to_dataframe()["ball_diameter_deviation_um"],
        solution.to_xarray()["ball_diameter_deviation"],
    ):
        assert np.asarray(values, float) == pytest.approx(BALLS, rel=1e-12)
    assert solution.to_xarray()["ball_diameter_deviation"].units == "um"


def test_without_them_nothing_is_said_of_them() -> None:
    pytest.importorskip("pandas")
    solution = solved(resting(axial_load=5e3))
    assert solution.ball_diameter_deviation is None
    assert solution.scene.ball_diameter_deviations is None
    assert "ball_diameter_deviation_um" not in solution.to_dataframe().columns


# ------------------------------------------------------------------------------------------------ what is refused


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("[1.0, 2.0]", "has 2 numbers; the bearing has 16 balls"),
        ("3.0", "is not a list of finite numbers"),
        ("[]", "is an empty array"),
        ('["a", 1.0]', "'a': is not a list of finite numbers"),
        (f"[{', '.join(['inf'] + ['0'] * 15)}]", "inf: is not a list of finite numbers"),
        (f"[{', '.join(['300'] + ['0'] * 15)}]", "300 µm: is more than 1% of the ball diameter"),
        (f"[{', '.join(['-400'] + ['0'] * 15)}]", "-400 µm: is more than 1% of the ball diameter"),
    ],
)
def test_files_that_are_refused(tmp_path: Path, given: str, words: str) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(SCENE.format(given), encoding="utf-8")
    done = CliRunner().invoke(cli, ["run", str(file)])
    assert done.exit_code == 2
    assert words in done.stderr
    assert "effects.ball_diameter_deviations_um" in done.stderr


def test_every_fault_is_said_at_once(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(SCENE.format("[1.0, true]") + 'orbit_radius = "own"\n', encoding="utf-8")
    with pytest.raises(qs.SceneFileError) as raised:
        qs.load_scene(file)
    keys = {error.key for error in raised.value.errors}
    assert keys == {"effects.ball_diameter_deviations_um", "effects.orbit_radius"}


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (1e-6, "is a single number"),
        ("much", "is not a number"),
        ([1e-6, float("nan")], "is not a finite number"),
    ],
)
def test_python_is_refused_alike(given: Any, words: str) -> None:
    with pytest.raises(qs.SceneError, match=words):
        qs.BallDiameterDeviations(given)


def test_python_names_the_unit_that_is_meant() -> None:
    with pytest.raises(qs.SceneError, match="micrometres"):
        of(resting(axial_load=1e3), [0.5] + 15 * [0.0])


def test_bearings_that_do_not_suit_are_refused() -> None:
    narrow = replace(B218, inner_groove_radius=0.5005 * 22.225e-3)
    varying = resting(replace(B218, ball_count=np.array([15, 16])), axial_load=1e3)
    for scene, given, words in (
        (resting(narrow, axial_load=1e3), [30e-6] + 15 * [0.0], "as wide as a groove"),
        (varying, 16 * [0.0], "15 or 16 balls"),
        (resting(axial_load=np.zeros(3)), np.zeros((2, 16)), "do not broadcast"),
    ):
        with pytest.raises(qs.SceneError, match=words):
            of(scene, given)


def test_of_many_sets_the_impossible_are_told() -> None:
    deviations = np.zeros((4, 16))
    deviations[2, 5] = 1e-3
    with pytest.raises(qs.SceneError) as raised:
        of(resting(axial_load=1e3), deviations)
    assert np.array_equal(raised.value.errors[0].where, [False, False, True, False])
