"""Gyroscopic moment under a friction coefficient: contacts carry so much of their load; a ball asked for more slips."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.scene_file import scene_of
from qsbearing.results.json_record import record
from tests.qsbearing.mechanics import ring_load
from tests.qsbearing.scenes import B218, INNER, MINIMUM_DISSIPATION, OUTER, PER_BALL, resting, solved, turning
from tests.verification.campaign.checks import findings

COMBINED = {"axial_load": 8e3, "radial_load_y": 4e3, "moment_z": 0.0}
every_control = pytest.mark.parametrize("control", [OUTER, INNER, PER_BALL, MINIMUM_DISSIPATION])


def bounded(mu: object) -> tuple:
    """Both ball effects, the moment bounded."""
    return (qs.CentrifugalForce(), qs.GyroscopicMoment(friction_coefficient=mu))  # type: ignore[arg-type]


def along(solution: qs.Solution) -> np.ndarray:
    """Friction over load at the two contacts, as each ball's own equilibrium demands: (contact, ball)."""
    i, o = solution.inner, solution.outer
    si, ci, so, co = np.sin(i.angle), np.cos(i.angle), np.sin(o.angle), np.cos(o.angle)
    assert solution.centrifugal_force is not None
    # Qi ni - Qo no + Fc = Ti ti - To to, in axial and radial components.
    left = np.array([i.load * si - o.load * so, i.load * ci - o.load * co + solution.centrifugal_force])
    directions = np.array([[ci, -co], [-si, so]])
    friction = np.linalg.solve(np.moveaxis(directions, -1, 0), left.T[..., None])[..., 0].T
    return np.abs(friction) / np.array([i.load, o.load])


@every_control
def test_the_classical_model_where_no_ball_need_slip(control: qs.RacewayControl) -> None:
    """A coefficient above all that is required changes no digit of it."""
    speed = 3000.0 if control is INNER else 10_000.0
    scene = turning(speed, control=control, axial_load=20e3, radial_load_y=2e3, moment_z=0.0)
    free = solved(scene)
    required = max(np.nanmax(side.required_friction) for side in (free.inner, free.outer))
    held = solved(replace(scene, ball_effects=bounded(1.01 * required)))
    assert required > 0.01
    assert not held.slips.any()
    assert np.array_equal(held.displacement, free.displacement)
    assert np.array_equal(held.outer.load, free.outer.load)


@every_control
def test_from_almost_no_moment_to_the_classical_one(control: qs.RacewayControl) -> None:
    """Coefficients from 0.001 to 1: continuous, the two ends the models without and with the moment."""
    speed = 4000.0 if control is INNER else 10_000.0
    loads = {"axial_load": 12e3, "radial_load_y": 2e3, "moment_z": 0.0}
    mu = np.geomspace(1e-3, 1.0, 241)
    sweep = solved(turning(speed, effects=bounded(mu), control=control, **loads))
    without = solved(turning(speed, effects=(qs.CentrifugalForce(),), control=control, **loads))
    classical = solved(turning(speed, control=control, **loads))
    angle = sweep.outer.angle
    size = np.abs(classical.outer.angle - without.outer.angle).max()
    assert size > 1e-3
    assert np.array_equal(angle[-1], classical.outer.angle)
    assert sweep.slips[0].all() and not sweep.slips[-1].any()
    # Steps of 3 %: what slips moves on in proportion to mu, and no angle by more than a small part of the way.
    assert np.abs(np.diff(angle, axis=0)).max() < 0.05 * size
    assert np.abs(angle[0] - without.outer.angle).max() < 0.15 * size
    if control is not PER_BALL:  # whose balls switch control
        finer = solved(turning(speed, effects=bounded(np.array([1e-4, 2e-4])), control=control, **loads))
        first, second = np.abs(finer.outer.angle - without.outer.angle).max(axis=-1)
        assert second / first == pytest.approx(2.0, abs=0.02)  # first order in mu


@pytest.mark.parametrize("control", [OUTER, INNER, MINIMUM_DISSIPATION])
def test_slipping_contacts_carry_the_coefficient_times_their_load(control: qs.RacewayControl) -> None:
    """Read off the ball's own equilibrium: mu Q where it slips, less elsewhere; and the ring is in balance."""
    mu = 0.02
    solution = solved(turning(6000, effects=bounded(mu), control=control, **COMBINED))
    assert solution.slips.any()
    apart = np.abs(solution.inner.angle - solution.outer.angle) > 0.05
    carried = along(solution)[:, apart].max(axis=0)
    slips = solution.slips[apart]
    # Loads balance to 1e-12 of the largest; lines 0.05 rad apart amplify it twentyfold, loads differ a hundredfold.
    assert carried[slips] == pytest.approx(mu, rel=1e-7)
    assert (carried[~slips] <= mu * (1 + 1e-7)).all()
    required = np.fmax(solution.inner.required_friction, solution.outer.required_friction)
    assert np.array_equal(required > mu, solution.slips)
    if control is OUTER:
        assert ring_load(solution)[:2] == pytest.approx([8e3, 4e3], rel=1e-9)


def test_stiffness_with_slip_is_the_slope_of_the_load() -> None:
    """Exact derivatives where balls slip: central differences of prescribed displacements."""
    scene = turning(9000, effects=bounded(0.04), control=INNER, **COMBINED)
    solution = solved(scene)
    assert solution.slips.any()
    names = ("axial_displacement", "radial_displacement_y", "radial_displacement_z", "tilt_y", "tilt_z")
    steps = np.array([1e-8, 1e-8, 1e-8, 2e-7, 2e-7])
    at = solution.displacement + np.concatenate([np.diag(steps), -np.diag(steps)])
    held = qs.Operation(speed=9000 * qs.rpm, **{name: at[:, k] for k, name in enumerate(names)})
    loads = solved(replace(scene, operation=held)).load
    slopes = ((loads[:5] - loads[5:]) / (2.0 * steps[:, None])).T
    own = np.sqrt(np.abs(np.diag(solution.stiffness)))
    assert np.abs(slopes - solution.stiffness).max(axis=None) > 0.0
    assert np.abs((slopes - solution.stiffness) / np.outer(own, own)).max() < 1e-5


def test_a_case_refused_for_friction_slips() -> None:
    """Inner control of light balls at speed has no balance with all the friction; with a coefficient it has."""
    scene = turning(10_000, control=INNER, axial_load=2000.0)
    assert qs.solve(scene).reason == qs.Reason.FRICTION_WITHOUT_LOAD
    slipping = solved(replace(scene, ball_effects=bounded(0.07)))
    assert slipping.slips.all()


def test_no_random_scene_with_a_balance_without_slip_loses_it() -> None:
    """Random scenes of a family, with coefficients from 0.02 to 1: solved wherever they are without one, and the same
    where no contact asks for more. What slips passes the checks from outside the kernel."""
    rng = np.random.default_rng(21)
    count = 300
    axial = 10 ** rng.uniform(2.5, 4.5, count)
    mu = 10 ** rng.uniform(-1.7, 0.0, count)
    for control in (OUTER, INNER):
        loads = {"axial_load": axial, "radial_load_y": axial * rng.uniform(0.0, 0.8, count), "moment_z": 0.0}
        scene = turning(rng.uniform(500, 12e3, count), control=control, **loads)
        free, held = qs.solve(scene), qs.solve(replace(scene, ball_effects=bounded(mu)))
        required = np.fmax(free.inner.required_friction, free.outer.required_friction).max(axis=-1)
        sticks = free.converged & (required <= mu)
        assert sticks.sum() > 30
        assert np.array_equal(held.displacement[sticks], free.displacement[sticks])
        assert held.converged[free.converged].all()
        assert held.slips.any(axis=-1).sum() > 30
        failed = findings(held.scene, held).failed()
        assert not any((wrong & held.converged).any() for wrong in failed.values())


def test_at_rest_the_coefficient_changes_nothing() -> None:
    still, named = solved(resting(**COMBINED)), solved(turning(0, effects=bounded(0.05), **COMBINED))
    assert np.array_equal(still.displacement, named.displacement)
    assert not named.slips.any()


def test_the_result_says_which_balls_slip() -> None:
    """Field, table, JSON and a sentence; nothing where no coefficient is given."""
    pytest.importorskip("pandas")
    scene = turning(10_000, effects=bounded(0.05), **COMBINED)
    solution, classical = solved(scene), solved(turning(10_000, **COMBINED))
    assert solution.slips.any() and not solution.slips.all()
    assert [ball["slips"] for ball in record(solution, {})["balls"]] == list(solution.slips)
    table = solution.to_dataframe()
    assert list(table["slips"]) == list(solution.slips)
    assert (table["friction_coefficient"] == 0.05).all()
    (sentence,) = [text for text in qs.warnings(solution) if "slip" in text]
    assert f"{solution.slips.sum()} balls" in sentence and "the contacts have 0.05" in sentence
    assert classical.slips is None
    assert record(classical, {})["balls"][0]["slips"] is None
    assert "slips" not in classical.to_dataframe().columns


@pytest.mark.parametrize("wrong", [0.0, -0.1, 1.5, float("nan"), "high", True, [0.1, 3.0]])
def test_coefficients_that_no_contact_has(wrong: object) -> None:
    with pytest.raises(qs.SceneError, match="friction_coefficient"):
        qs.GyroscopicMoment(friction_coefficient=wrong)  # type: ignore[arg-type]


def test_a_file_is_told_all_that_is_wrong_at_once() -> None:
    """A coefficient out of range, one that is no number, one without a moment; choices without an effect."""
    operation = {"speed_rpm": 5000, "axial_load_N": 2000}

    def errors_of(**effects: object) -> str:
        with pytest.raises(qs.SceneFileError) as error:
            scene_of({"bearing": {"name": "B218"}, "operation": operation, "effects": effects}, "a file")
        return str(error.value)

    both = {"ball": ["gyroscopic_moment"], "raceway_control": "outer"}
    found = errors_of(**both, friction_coefficient=2.0, orbit_radius="own")
    assert "effects.friction_coefficient = 2" in found and "effects.orbit_radius" in found
    assert "is not a number" in errors_of(**both, friction_coefficient="0.1")
    found = errors_of(friction_coefficient=0.1, orbit_radius="displaced")
    assert "there is no gyroscopic moment to carry" in found and "effects.orbit_radius" in found
    assert "minimum_dissipation" in errors_of(ball=["centrifugal_force"], raceway_control="minimal")
    assert "minimum_dissipation" in errors_of(ball=["centrifugal_force"])
    scene = scene_of({"bearing": {"name": "B218"}, "operation": operation, "effects": both | {
        "friction_coefficient": 0.08, "orbit_radius": "displaced", "raceway_control": "minimum_dissipation"
    }}, "a file")  # fmt: skip
    assert scene.gyroscopic_moment == qs.GyroscopicMoment(friction_coefficient=0.08)
    assert scene.orbit_radius is qs.OrbitRadius.DISPLACED
    assert scene.raceway_control is MINIMUM_DISSIPATION
    assert B218.ball_count == scene.bearing.ball_count
