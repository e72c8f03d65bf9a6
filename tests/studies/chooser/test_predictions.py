"""What indicators predict against what solving with and without finds, where changes are small enough to be alike."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.effects import EFFECTS, OperatingPoint
from qsbearing.model.solution.comparison import by_quantity
from qsbearing.model.solution.judgement import judge
from tests.qsbearing.scenes import B218, lobes, solved, turning, unequal_balls

ENTRY = {entry.name: entry for entry in EFFECTS}
STEEL = replace(qs.STEEL, thermal_expansion=12e-6)
BEARING = replace(B218, ball_material=STEEL, ring_material=STEEL)
THRUST = {"axial_load": 17_800.0}
HELD = {"axial_displacement": 30e-6}
SHARE = 0.01
"""Quantities that change by less than this part of the largest change are not what a verdict rests on."""


def ratios(name: str, full: qs.Scene) -> dict[str, float]:
    """Predicted over found, of what changes; predicted from the solution without the effect."""
    entry = ENTRY[name]
    without, with_it = solved(entry.coarser(full)), solved(full)
    found = {key: float(error) for key, error in by_quantity(without, with_it).items()}
    predicted = judge(entry, without, full).errors
    largest = max(found.values())
    assert largest > 1e-4
    return {key: float(predicted[key]) / error for key, error in found.items() if error > SHARE * largest}


@pytest.mark.parametrize("rpm", [500.0, 3000.0, 9000.0])
def test_the_centrifugal_force_within_a_third(rpm: float) -> None:
    found = ratios("centrifugal_force", turning(rpm, effects=(qs.CentrifugalForce(),), **THRUST))
    assert 0.7 < found["contact_angle"] < 1.4
    assert 0.7 < found["load"] < 1.4
    assert 0.7 < found["pressure"] < 1.4


@pytest.mark.parametrize("rpm", [500.0, 3000.0, 9000.0])
def test_the_gyroscopic_moment_within_a_factor_of_two(rpm: float) -> None:
    found = ratios("gyroscopic_moment", turning(rpm, **THRUST))
    for name in ("contact_angle", "load", "pressure"):
        assert 0.5 < found[name] < 2.0
    if rpm > 1000.0:  # its part in stiffness rests on what the centrifugal force has parted already
        assert 0.5 < found["stiffness"] < 2.0


def test_slip_within_a_factor_of_three() -> None:
    """The excess over the bound, at a fifth more friction than there is."""
    free = turning(9000.0, **THRUST)
    needed = float(solved(free).outer.required_friction.max())  # type: ignore[union-attr]
    slipping = (qs.CentrifugalForce(), qs.GyroscopicMoment(friction_coefficient=needed / 1.2))
    found = ratios("gyroscopic_slip", replace(free, ball_effects=slipping))
    for name in ("contact_angle", "load"):
        assert 1.0 / 3.0 < found[name] < 3.0, name


def test_without_slip_a_bound_changes_nothing() -> None:
    bound = (qs.CentrifugalForce(), qs.GyroscopicMoment(friction_coefficient=0.5))
    assert judge(ENTRY["gyroscopic_slip"], solved(turning(9000.0, effects=bound, **THRUST))).largest == 0.0


def test_own_orbits_within_a_factor_of_three() -> None:
    found = ratios("orbit_radius", replace(turning(12_000.0, **THRUST), orbit_radius=qs.OrbitRadius.DISPLACED))
    for name in ("contact_angle", "load", "stiffness"):
        assert 1.0 / 3.0 < found[name] < 3.0, name


def rings(**how: Any) -> qs.RingExpansion:
    return qs.RingExpansion(90 * qs.mm, 160 * qs.mm, **how)


@pytest.mark.parametrize("operation", [THRUST, HELD], ids=["loaded", "held"])
@pytest.mark.parametrize(
    "effect",
    [
        rings(shaft_interference=10e-6),
        rings(inner_ring_temperature=298.0, outer_ring_temperature=301.0),
        qs.BallExpansion(300.0),
    ],
    ids=["fit", "heat", "balls"],
)
def test_expansion_within_a_factor_of_two(operation: dict[str, float], effect: Any) -> None:
    full = qs.Scene(BEARING, qs.Operation(**operation), ring_effects=(effect,))
    found = ratios(effect.name, full)
    for name in {"load", "displacement", "stiffness"} & set(found):
        assert 0.5 < found[name] < 2.0, name


@pytest.mark.parametrize("rpm", [10_000.0, 20_000.0])
@pytest.mark.parametrize("force", [300.0, 1500.0])
def test_expansion_of_a_preloaded_spindle_at_speed_within_a_factor_of_two(force: float, rpm: float) -> None:
    """Expansion raises a rigid preload; under it the contact angles, parted by the centrifugal force, close again."""
    scene = qs.load_scene("7210c")
    full = replace(
        scene,
        operation=qs.Operation(rpm * qs.rpm),
        preload=qs.Preload(rigid=force),
        ring_effects=(qs.RingExpansion(50 * qs.mm, 90 * qs.mm, shaft_interference=8e-6),),
    )
    found = by_quantity(solved(ENTRY["ring_expansion"].coarser(full)), solved(full))
    predicted = judge(ENTRY["ring_expansion"], solved(full)).errors
    for name in ("contact_angle", "load", "pressure", "stiffness"):
        assert 0.5 < float(predicted[name] / found[name]) < 2.0, name


@pytest.mark.parametrize(
    ("rpm", "operation"),
    [
        (0.0, THRUST),
        (0.0, {"axial_load": 17_800.0, "radial_load_y": 4e3, "moment_z": 0.0}),
        (0.0, HELD | {"radial_displacement_y": 2e-6, "radial_displacement_z": 0.0, "tilt_y": 0.0, "tilt_z": 0.0}),
        (5000.0, {"axial_load": 17_800.0, "radial_load_y": 4e3, "moment_z": 0.0}),
        (10_000.0, THRUST),
    ],
    ids=["thrust at rest", "at rest", "held", "turning", "fast"],
)
@pytest.mark.parametrize("effect", [unequal_balls(spread=0.5e-6), lobes(0.2e-6)], ids=lambda one: one.name)
def test_uneven_balls_within_a_factor_of_three(effect: Any, rpm: float, operation: dict[str, float]) -> None:
    """At rest within a tenth: the prediction is the first order of the equations."""
    full = replace(turning(rpm, BEARING, **operation), ring_effects=(effect,))
    found = ratios(effect.name, full)
    for name in {"load", "pressure"} & set(found):
        assert 1.0 / 3.0 < found[name] < 3.0, name
        assert rpm > 0.0 or found[name] == pytest.approx(1.0, abs=0.1), name


@pytest.mark.parametrize("name", ["unequal_balls", "seats_out_of_round"])
def test_what_is_not_named_predicts_nothing(name: str) -> None:
    errors = ENTRY[name].errors(OperatingPoint(solved(turning(5000.0, **THRUST))))
    assert all(error == 0.0 for error in errors.values())


def test_a_wedged_bearing_is_not_taken_for_an_unchanged_one() -> None:
    """The free contact angle stays zero whatever the balls do; their contacts do not."""
    balls = qs.BallExpansion(330.0)
    tight = rings(inner_ring_temperature=420.0)
    scene = qs.Scene(
        replace(BEARING, free_contact_angle=10 * qs.deg),
        qs.Operation(axial_displacement=0.0),
        ring_effects=(tight, balls),
    )
    assert scene.operating_bearing.free_contact_angle == 0.0
    assert 0.5 < ratios("ball_expansion", scene)["load"] < 2.0


@pytest.mark.parametrize("operation", [THRUST, {"axial_load": 17_800.0, "radial_load_y": 3e3, "moment_z": 0.0}])
def test_the_actual_angle_within_a_factor_of_two(operation: dict[str, float]) -> None:
    found = ratios("hertz_angle", turning(9000.0, hertz_angle="actual", **operation))
    assert 0.5 < found["pressure"] < 2.0


def test_a_lever_and_a_formula_within_a_factor_of_two() -> None:
    scene = turning(3000.0, axial_load=17_800.0, radial_load_y=3e3, moment_z=0.0)
    assert 0.5 < ratios("tilt_lever", scene)["stiffness"] < 2.0
    assert 0.5 < ratios("hertz_form", scene)["pressure"] < 2.0


def test_rotation_of_the_rings_is_told_without_their_sections() -> None:
    """At most what a thin ring grows: rho omega^2 r^3/E; the real section grows by less, and by not much less."""
    scene = turning(15_000.0, BEARING, effects=(qs.CentrifugalForce(),), **THRUST)
    bare = ENTRY["ring_expansion"].errors(OperatingPoint(solved(scene)))
    real = judge(ENTRY["ring_expansion"], solved(scene), replace(scene, ring_effects=(rings(),))).errors
    for name, error in real.items():
        assert 0.0 < float(error) <= float(bare[name]) < 3.0 * float(error), name


def test_what_is_not_there_changes_nothing() -> None:
    """No difference of temperature, no speed: exactly nothing is predicted."""
    full = qs.Scene(BEARING, qs.Operation(**THRUST), ring_effects=(rings(), qs.BallExpansion(293.15)))
    for name in ("ring_expansion", "ball_expansion", "centrifugal_force", "gyroscopic_moment"):
        assert np.all(judge(ENTRY[name], solved(full)).largest == 0.0), name
