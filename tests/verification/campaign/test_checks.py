"""The checks of a solution pass what is sound and turn red for every way in which a solution can be wrong."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.effects.raceway_control import HYPOTHESES
from tests.qsbearing.scenes import B218, DEEP_GROOVE, INNER, OUTER, PER_BALL, resting, solved, turning
from tests.verification.campaign.checks import MOST_IMBALANCE, Findings, findings
from tests.verification.campaign.chunk import groups_of
from tests.verification.campaign.envelope import scene_file


def failing(solution: qs.Solution) -> set[str]:
    """Which checks a solution of one case fails."""
    return {name for name, bad in findings(solution.scene, solution).failed().items() if bad[0]}


def sample(control: qs.RacewayControl = OUTER, **changes: Any) -> qs.Solution:
    loads = {"axial_load": 12e3, "radial_load_y": 3e3, "radial_load_z": -1.5e3, "moment_y": 40.0, "moment_z": -60.0}
    return solved(turning(np.array([6000.0]), control=control, **(loads | changes)))


@pytest.mark.parametrize("control", [OUTER, INNER, PER_BALL])
def test_sound_solutions_pass(control: qs.RacewayControl) -> None:
    assert failing(sample(control)) == set()
    assert failing(sample(control, axial_load=None, axial_displacement=20e-6)) == set()
    assert (
        failing(solved(resting(DEEP_GROOVE, axial_load=np.array([300.0]), radial_load_y=900.0, moment_z=1.0))) == set()
    )


def change(of: Any, value: Any = None, *, factor: float = 1.0, more: float = 0.0, at: int = 3) -> None:
    """One number of the only case."""
    of[0, at] = of[0, at] * factor + more if value is None else value


def lose_inner_contact(solution: qs.Solution) -> None:
    change(solution.inner.load, 0.0)
    change(solution.inner.approach, -1e-6)


def stand(solution: qs.Solution, ball: int = 3) -> None:
    """Turn a ball's inner line to where inner control has u = cos(ai - ao) - g cos ao = 0: no orbit and no inertia."""
    bearing, outer_angle = solution.scene.bearing, float(solution.outer.angle[0, ball])
    ratio = float(np.asarray(bearing.ball_diameter)) / float(np.asarray(bearing.pitch_diameter))
    change(solution.inner.angle, outer_angle + np.arccos(ratio * np.cos(outer_angle)), at=ball)


SPOILT = {
    "load": (lambda s: change(s.inner.load, factor=1.0 + 1e-8), {"imbalance", "hertz"}),
    "pull": (lambda s: change(s.inner.load, factor=-1.0), {"imbalance", "tension"}),
    "nan": (lambda s: change(s.inner.load, np.nan), {"imbalance", "not_finite", "tension"}),
    "lost": (lambda s: change(s.inner.load, 0.0), {"imbalance", "tension"}),
    "angle": (lambda s: change(s.outer.angle, more=1e-8), {"imbalance", "closure"}),
    "displacement": (lambda s: change(s.displacement, more=1e-12, at=1), {"closure"}),
    "held displacement": (lambda s: change(s.displacement, factor=1.0 + 1e-12, at=0), {"misplaced"}),
    "reaction": (lambda s: change(s.load, factor=1.0 + 1e-9, at=2), {"imbalance"}),
    "residual": (lambda s: s._solved.results["residual"].__setitem__(0, np.nan), {"misreported"}),
    "ellipse": (lambda s: change(s.inner.semi_major_axis, 1e-3), {"hertz"}),
    "infinite": (lambda s: change(s.displacement, np.inf, at=0), {"closure", "not_finite"}),
    "friction without load": (lose_inner_contact, {"friction_without_load", "imbalance", "unpressed"}),
    "standing ball": (stand, {"no_orbit"}),
    "over the shoulder": (lambda s: change(s.inner.angle, 1.6), {"over_shoulder", "closure"}),
    "open side": (lambda s: change(s.inner.angle, -0.1), {"open_side", "closure"}),
    "control": (lambda s: s._solved.controls.__ixor__(1), {"control_unsaid"}),
}


@pytest.mark.parametrize("name", SPOILT)
def test_each_check_turns_red(name: str) -> None:
    """A number changed by a hundred-millionth, or by a picometre, is found out."""
    spoil, red = SPOILT[name]
    held = {"axial_load": None, "axial_displacement": 20e-6}
    inner = name in ("friction without load", "standing ball")
    control = INNER if inner else PER_BALL if name == "control" else OUTER
    solution = sample(control, **(held if name == "held displacement" else {}))
    for side in (solution.inner, solution.outer):
        assert side.load.size
        assert side.angle.size
    spoil(solution)
    assert red <= failing(solution)


@pytest.mark.parametrize(("envelope", "number", "is_held_up"), [("wild", 90_025, True), ("wild", 17_703, False)])
def test_rings_against_each_other_and_lines_at_right_angles(
    envelope: str, number: int, is_held_up: bool, tmp_path: Path
) -> None:
    """A ball that the gyroscopic moment holds up beyond the gap is noted; on the same side with the rings turning one
    way it would be wrong. One that goes round with the inner ring, its lines a right angle apart, goes round."""
    path = tmp_path / "scene.toml"
    path.write_text(scene_file(envelope, 1, number))
    scene = qs.load_scene(path)
    operation = replace(scene.operation, speed=np.atleast_1d(scene.operation.speed))
    solution = qs.solve(replace(scene, operation=operation))
    assert failing(solution) == set()
    assert findings(solution.scene, solution).held_up == [is_held_up]
    if is_held_up:
        turned = replace(scene, operation=replace(operation, outer_speed=-np.asarray(operation.outer_speed)))
        assert findings(turned, solution).unpressed == [True]


def test_every_check_is_seen_to_turn_red() -> None:
    """Of those that fail a campaign, none without a case above."""
    checks = {field.name for field in fields(Findings)} - {"expressible", *Findings.NOTED}
    assert set().union(*(red for _, red in SPOILT.values())) == checks


def test_friction_without_load_is_the_controlling_raceway_s() -> None:
    """Under outer control the inner contact carries none of the moment, loaded or not."""
    solution = sample(OUTER)
    lose_inner_contact(solution)
    assert "friction_without_load" not in failing(solution)


@pytest.mark.parametrize(("rpm", "is_above"), [(3000.0, False), (6000.0, True)])
def test_friction_above_the_load(rpm: float, is_above: bool) -> None:
    """Gyroscopic moment alone, on the inner raceway: noted where it asks for more than the load, and then no
    equilibrium of balls whose friction keeps to the load."""
    scene = turning(np.array([rpm]), control=INNER, effects=(qs.GyroscopicMoment(),), axial_load=200.0)
    solution = solved(scene)
    assert solution.inner.required_friction is not None
    assert bool((solution.inner.required_friction > 1.0).any()) == is_above
    assert findings(scene, solution).friction_above_load == [is_above]
    assert failing(solution) == set()
    limited = findings(scene, solution, friction_limit=1.0)
    assert limited.friction_above_load == [is_above]
    assert limited.failed()["imbalance"] == [is_above]


def test_a_planted_standing_ball_is_found_out_by_its_motion_alone() -> None:
    """Neither orbit nor inertia nor load: its balance, Hertz and friction are in order, wherever it lies."""
    bearing = qs.BallBearing(13, 7.21 * qs.mm, 38.3 * qs.mm, 3.7492 * qs.mm, 3.7492 * qs.mm, 35 * qs.deg)
    loads = {"axial_load": 120.0, "radial_load_y": 550.0, "radial_load_z": 21.0}
    solution = solved(turning(np.array([33e3]), bearing, control=INNER, **loads, tilt_y=0.0, tilt_z=0.0))
    assert failing(solution) == set()
    assert (solution.inner.load[0, 6], solution.raceway_control[0, 6]) == (0.0, "outer")
    for array, value in ((solution.outer.load, 0.0), (solution.inner.approach, 0.0), (solution.outer.approach, 0.0)):
        change(array, value, at=6)
    change(solution.raceway_control, "inner", at=6)
    stand(solution, 6)
    assert failing(solution) == {"no_orbit", "unpressed", "closure"}


def test_a_ball_that_has_left_the_inner_raceway_lies_at_the_bottom_of_the_outer_one() -> None:
    solution = solved(turning(np.array([8000.0]), axial_load=2e3, radial_load_y=4e3, tilt_y=0.0, tilt_z=0.0))
    assert solution.inner.load[0, 8] == 0.0
    assert failing(solution) == set()
    change(solution.outer.angle, more=1e-6, at=8)
    assert "unpressed" in failing(solution)


def test_only_an_open_side_is_an_open_side() -> None:
    solution = solved(turning(np.array([2000.0]), replace(B218, kind=qs.BearingKind.DEEP_GROOVE), axial_load=-5e3))
    assert failing(solution) == set()
    object.__setattr__(solution.scene.bearing, "kind", qs.BearingKind.ANGULAR_CONTACT)
    assert failing(solution) == {"open_side"}


def test_control_that_contradicts_jones_is_noted() -> None:
    """And a failure only if the solution does not say so."""
    solution = sample(PER_BALL)
    assert not findings(solution.scene, solution).control[0]
    solution = sample(PER_BALL)
    solution._solved.controls[:] = 1 - solution._solved.controls
    assert findings(solution.scene, solution).control[0]


def test_a_pressed_inner_line_is_where_it_is() -> None:
    """Inner control near an orbit at rest: no converged state may rest on an inner line seen mirrored, more than a
    right angle from the outer one as it lies."""
    bearing = qs.BallBearing(24, 23.334 * qs.mm, 254.717 * qs.mm, 13.0459 * qs.mm, 12.9221 * qs.mm, 56.16155 * qs.deg)
    rpm = np.array([3300.0, 3354.557, 3600.0])
    effects = (qs.CentrifugalForce(), qs.GyroscopicMoment(qs.MomentShares.HARRIS))
    scene = turning(rpm, bearing, control=INNER, effects=effects, axial_load=181.7515, tilt_y=0.0, tilt_z=0.0)
    solution = qs.solve(scene)
    failed = np.any(list(findings(scene, solution).failed().values()), axis=0)
    assert not (solution.converged & failed).any()


def all_effects(control: qs.RacewayControl, orbit: qs.OrbitRadius, friction: float | None) -> qs.Solution:
    """Everything that changes lengths, masses and motion at once."""
    hot = 60.0 + qs.zero_celsius
    balls = qs.BallDiameterDeviations(2e-6 * np.sin(np.arange(16.0)))
    rings = qs.RingExpansion(90 * qs.mm, 160 * qs.mm, shaft_interference=20e-6, inner_ring_temperature=hot)
    scene = turning(
        np.array([9000.0]), control=control, effects=(qs.CentrifugalForce(), qs.GyroscopicMoment("harris", friction)),
        axial_load=9e3, radial_load_y=2e3, moment_y=10.0, moment_z=-20.0,
    )  # fmt: skip
    return solved(replace(scene, ring_effects=(rings, qs.BallExpansion(hot - 10.0), balls), orbit_radius=orbit))


@pytest.mark.parametrize("control", HYPOTHESES)
@pytest.mark.parametrize("orbit", qs.OrbitRadius)
@pytest.mark.parametrize("friction", [None, 0.04])
def test_every_effect_is_recomputed(control: qs.RacewayControl, orbit: qs.OrbitRadius, friction: float | None) -> None:
    assert failing(all_effects(control, orbit, friction)) == set()


def test_a_moment_of_an_axis_that_all_but_cancels_is_known_to_rounding() -> None:
    """Minimum dissipation without centrifugal force: of a moment of tonnes a ball finds the axis that leaves it a
    millinewton, p being 1e-8 of sines of a tenth; a load that is off by a hundred-thousandth is still seen."""
    [(_, group)] = groups_of("mounted", 1, 24522, 24523)
    scene = group.scene()
    solution = solved(scene)
    found = findings(scene, solution)
    assert found.imbalance > MOST_IMBALANCE
    assert failing(solution) == set()
    change(solution.inner.load, factor=1.0 + 1e-5, at=4)
    assert "imbalance" in failing(solution)


@pytest.mark.parametrize(
    ("spoil", "red"),
    [
        (lambda s: replace(s, orbit_radius=qs.OrbitRadius.PITCH_CIRCLE), "imbalance"),
        (lambda s: replace(s, raceway_control=qs.RacewayControl.OUTER), "imbalance"),
        (lambda s: replace(s, ball_effects=(s.ball_effects[0], qs.GyroscopicMoment("harris", 0.05))), "imbalance"),
        (lambda s: replace(s, ring_effects=s.ring_effects[1:]), "closure"),
        (lambda s: replace(s, ring_effects=s.ring_effects[:1] + s.ring_effects[2:]), "closure"),
        (lambda s: replace(s, bearing=replace(s.bearing, ball_material=qs.SILICON_NITRIDE)), "hertz"),
    ],
)
def test_another_effect_turns_red(spoil: Any, red: str) -> None:
    """A solution judged by equations that are not its own."""
    solution = all_effects(qs.RacewayControl.MINIMUM_DISSIPATION, qs.OrbitRadius.DISPLACED, 0.04)
    assert findings(spoil(solution.scene), solution).failed()[red] == [True]
