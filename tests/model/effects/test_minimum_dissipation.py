"""Raceway control by minimum dissipation: the axis that makes the friction power least, found here by trying axes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from qsbearing.model.compiler.compiled import entry
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.effects.raceway_control import INNER as INNER_CODE
from qsbearing.model.effects.raceway_control import OUTER as OUTER_CODE
from qsbearing.model.effects.raceway_control import inner_weight, rotation_axis, weighted_axis
from tests.qsbearing.scenes import B218, BOTH, BOTH_HARRIS, INNER, MINIMUM_DISSIPATION, OUTER, PER_BALL, solved, turning

FIVE = {"axial_load": 14e3, "radial_load_y": 2.5e3, "radial_load_z": 1e3, "moment_y": 25.0, "moment_z": -80.0}
G = float(B218.ball_diameter) / float(B218.pitch_diameter)


@entry(*[float] * 4, array_of(float))
def fill_axes(weight: float, g: float, inner_angle: float, outer_angle: float, out: NDArray) -> None:
    """tan(beta) of inner control, of outer control, and between them."""
    si, ci, so, co = np.sin(inner_angle), np.cos(inner_angle), np.sin(outer_angle), np.cos(outer_angle)
    for k in range(3):
        axis = rotation_axis(INNER_CODE if k == 0 else OUTER_CODE, g, si, ci, so, co)
        if k == 2:
            axis = weighted_axis(weight, g, si, ci, so, co)
        out[k] = axis[0] / axis[1]


@entry(*[float] * 5, array_of(float))
def fill_weight(g: float, inner_angle: float, outer_angle: float, qi: float, qo: float, out: NDArray) -> None:
    """The inner raceway's weight, both contacts' a E/Q^(1/3) being equal."""
    out[0] = inner_weight(g, np.cos(inner_angle), np.cos(outer_angle), qi, qo, 1.0, 1.0)


def between(weight: float, inner_angle: float, outer_angle: float) -> NDArray:
    out = np.empty(3)
    fill_axes(weight, G, inner_angle, outer_angle, out)
    return out


def weight_of(inner_angle: float, outer_angle: float, qi: float, qo: float) -> float:
    out = np.empty(1)
    fill_weight(G, inner_angle, outer_angle, qi, qo, out)
    return float(out[0])


def spin_speeds(beta: NDArray, ai: float, ao: float) -> tuple[NDArray, NDArray]:
    """Of a ball whose axis lies at beta, against each ring along the contact's normal: rolling in vectors, no slip at
    both contact points, the inner ring turning at 1."""
    si, ci, so, co = np.sin(ai), np.cos(ai), np.sin(ao), np.cos(ao)
    axial, radial = np.cos(beta), -np.sin(beta)  # of a rotation of 1; unknown: its size w and the orbit m
    # Outer: -m (1 + g co) = g w (axial co - radial so); inner: (1 - m)(1 - g ci) = -g w (axial ci - radial si).
    outer, inner = G * (axial * co - radial * so), G * (axial * ci - radial * si)
    w = -1.0 / (inner / (1.0 - G * ci) + outer / (1.0 + G * co))
    m = -w * outer / (1.0 + G * co)
    at_inner = w * (axial * si + radial * ci) - (1.0 - m) * si
    at_outer = w * (axial * so + radial * co) + m * so
    return at_inner, at_outer


@pytest.mark.parametrize(("qi", "qo"), [(1.0, 1.0), (1.0, 3.0), (0.05, 1.0), (4.0, 1.0)])
@pytest.mark.parametrize(("ai", "ao"), [(0.9, 0.5), (0.7, 0.7), (0.2, -0.1), (1.2, 0.05)])
def test_the_axis_makes_the_friction_power_least(ai: float, ao: float, qi: float, qo: float) -> None:
    """Against a fine search over all axes of ci wsi^2 + co wso^2, c = Q^(4/3) here; and the moments balance there."""
    ci, co = qi ** (4.0 / 3.0), qo ** (4.0 / 3.0)

    def power(beta: NDArray) -> NDArray:
        at_inner, at_outer = spin_speeds(beta, ai, ao)
        return ci * at_inner**2 + co * at_outer**2

    found = np.arctan(between(weight_of(ai, ao, qi, qo), ai, ao)[2])
    around = found + np.linspace(-0.5, 0.5, 100_001)
    # The least of a parabola over a grid of 1e-5: within a step of it.
    assert around[power(around).argmin()] == pytest.approx(found, abs=1.1e-5)
    at_inner, at_outer = spin_speeds(np.array([found]), ai, ao)
    assert ci * at_inner == pytest.approx(-co * at_outer, abs=1e-13)


def test_limits() -> None:
    """One weight alone is one raceway's control; equal angles and loads give tan(a)/(1 - g^2)."""
    inner, outer, last = between(1.0, 0.9, 0.5)
    assert last == inner
    inner, outer, last = between(0.0, 0.9, 0.5)
    assert last == outer
    middle = between(weight_of(0.6, 0.6, 2.0, 2.0), 0.6, 0.6)[2]
    assert middle == pytest.approx(np.tan(0.6) / (1.0 - G * G), rel=1e-14)
    assert weight_of(0.9, 0.5, 0.0, 1.0) == 0.0
    assert weight_of(0.9, 0.5, 1.0, 0.0) == 1.0


@pytest.mark.parametrize("effects", [BOTH, BOTH_HARRIS])
@pytest.mark.parametrize("hertz_angle", ["free", "actual"])
def test_it_lies_between_the_two_controls(effects: tuple, hertz_angle: str) -> None:
    """Attitude and friction, ball by ball; and it says what it is."""
    scene = turning(5000, effects=effects, control=MINIMUM_DISSIPATION, hertz_angle=hertz_angle, **FIVE)
    middle, *ends = (solved(replace(scene, raceway_control=control)) for control in (MINIMUM_DISSIPATION, OUTER, INNER))
    assert (middle.raceway_control == "minimum_dissipation").all()
    for name in ("orbital_speed", "centrifugal_force"):
        values = [getattr(end, name) for end in ends]
        assert (getattr(middle, name) > np.minimum(*values) * (1 - 2e-3)).all()
        assert (getattr(middle, name) < np.maximum(*values) * (1 + 2e-3)).all()
    assert (middle.inner.required_friction > 0.0).all() and (middle.outer.required_friction > 0.0).all()
    worst = [max(side.required_friction.max() for side in (end.inner, end.outer)) for end in (middle, *ends)]
    assert worst[0] < max(worst[1:])  # both raceways carry


def test_it_needs_no_choice_by_ball_and_so_makes_no_jump() -> None:
    """Where per-ball control switches ball by ball, this one moves on smoothly: with half the step half the change."""
    loads = np.linspace(4e3, 12e3, 161)
    changes = []
    for step in (2, 1):
        sweep = solved(
            turning(2300, control=MINIMUM_DISSIPATION, axial_load=20e3, radial_load_y=loads[::step], moment_z=0.0)
        )
        changes.append(np.abs(np.diff(sweep.gyroscopic_moment, axis=0)).max())
    assert changes[1] < 0.52 * changes[0]
    switching = solved(turning(2300, control=PER_BALL, axial_load=20e3, radial_load_y=loads, moment_z=0.0))
    assert (switching.raceway_control == "inner").any() and (switching.raceway_control == "outer").any()


def test_a_lost_inner_raceway_has_no_say() -> None:
    """Balls off the inner raceway: as under outer control, and no friction is asked of a raceway that is not there."""
    loads = {"axial_load": 2e3, "radial_load_y": 4e3, "tilt_y": 0.0, "tilt_z": 0.0}
    scene = turning(8000, control=MINIMUM_DISSIPATION, **loads)
    solution = solved(scene)
    lost = solution.inner.load == 0.0
    assert lost.sum() >= 8
    assert solution.outer.angle[lost] == pytest.approx(0.0, abs=1e-9)
    assert (solution.inner.required_friction[lost] == 0.0).all()
