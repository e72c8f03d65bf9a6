"""Balls that go round at their own radius."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from tests.qsbearing.scenes import B218, BOTH, CENTRIFUGAL, INNER, MINIMUM_DISSIPATION, OUTER, resting, solved, turning

LOADS = {"axial_load": 12e3, "radial_load_y": 3e3, "moment_z": 0.0}
OWN = qs.OrbitRadius.DISPLACED


def radius_of(solution: qs.Solution) -> np.ndarray:
    """Of each ball's centre from the bearing axis: the outer groove's centre lies at dm/2 - Lo cos a0."""
    length = float(B218.outer_groove_radius) - 0.5 * float(B218.ball_diameter)
    centre = 0.5 * float(B218.pitch_diameter) - length * np.cos(float(B218.free_contact_angle))
    return centre + (length + solution.outer.approach) * np.cos(solution.outer.angle)


@pytest.mark.parametrize("control", [OUTER, INNER, MINIMUM_DISSIPATION])
def test_force_and_speeds_are_those_at_each_ball_s_radius(control: qs.RacewayControl) -> None:
    """Fc = m R w^2; and the orbit is that of the same angles with D/(2R) for D/dm: between rings at equal angles
    w (1 - g cos a)/2, tested on balls that have lost the inner raceway; elsewhere the reference tells."""
    scene = replace(turning(5000, control=control, axial_load=12e3, radial_load_y=1e3, moment_z=0.0), orbit_radius=OWN)
    solution, radius = solved(scene), radius_of(solved(scene))
    assert np.ptp(radius) > 1e-6
    assert solution.centrifugal_force == pytest.approx(
        float(B218.ball_mass) * radius * solution.orbital_speed**2, rel=1e-12
    )
    idle = solved(replace(turning(8000, axial_load=2e3, radial_load_y=4e3, tilt_y=0.0, tilt_z=0.0), orbit_radius=OWN))
    lost = idle.inner.approach < -1e-5
    assert lost.sum() >= 8
    g = 0.5 * float(B218.ball_diameter) / radius_of(idle)[lost]
    assert idle.orbital_speed[lost] == pytest.approx(0.5 * 8000 * qs.rpm * (1.0 - g), rel=1e-12)


def test_the_shift_is_of_the_size_of_the_radius_s() -> None:
    """The orbit's radius differs by some 0.1 % and so does the centrifugal force: neither more nor nothing."""
    scene = turning(10_000, effects=CENTRIFUGAL, **LOADS)
    circle, own = solved(scene), solved(replace(scene, orbit_radius=OWN))
    change = own.centrifugal_force / circle.centrifugal_force - 1.0
    shift = radius_of(own) / (0.5 * float(B218.pitch_diameter)) - 1.0
    assert np.abs(shift).max() == pytest.approx(2e-3, rel=0.5)
    assert np.abs(change).max() < 5.0 * np.abs(shift).max()
    assert np.abs(change).max() > 0.2 * np.abs(shift).max()


def test_at_rest_it_changes_nothing_and_at_a_crawl_as_the_square_of_speed() -> None:
    still = solved(resting(**LOADS))
    assert np.array_equal(solved(replace(turning(0, **LOADS), orbit_radius=OWN)).displacement, still.displacement)
    rpm = np.array([100.0, 200.0])
    scene = turning(rpm, **LOADS)
    change = np.abs(solved(replace(scene, orbit_radius=OWN)).outer.angle - solved(scene).outer.angle).max(axis=-1)
    # Angles are known to 1e-12 and change by 1e-9: a few per mille of the ratio.
    assert change[1] / change[0] == pytest.approx(4.0, rel=0.01)


@pytest.mark.parametrize("control", [OUTER, INNER, MINIMUM_DISSIPATION])
def test_stiffness_is_the_slope_of_the_load(control: qs.RacewayControl) -> None:
    """Exact derivatives with all of it, by central differences of prescribed displacements."""
    scene = replace(
        turning(5000, effects=BOTH, control=control, axial_load=12e3, radial_load_y=2e3, moment_z=0.0), orbit_radius=OWN
    )
    solution = solved(scene)
    names = ("axial_displacement", "radial_displacement_y", "radial_displacement_z", "tilt_y", "tilt_z")
    steps = np.array([1e-7, 1e-7, 1e-7, 2e-6, 2e-6])
    at = solution.displacement + np.concatenate([np.diag(steps), -np.diag(steps)])
    held = qs.Operation(speed=5000 * qs.rpm, **{name: at[:, k] for k, name in enumerate(names)})
    loads = solved(replace(scene, operation=held)).load
    slopes = ((loads[:5] - loads[5:]) / (2.0 * steps[:, None])).T
    own = np.sqrt(np.abs(np.diag(solution.stiffness)))
    assert np.abs((slopes - solution.stiffness) / np.outer(own, own)).max() < 1e-5


def test_it_asks_for_a_ball_effect() -> None:
    with pytest.raises(qs.SceneError, match="orbit_radius"):
        replace(resting(**LOADS), orbit_radius=OWN)
    with pytest.raises(qs.SceneError, match="orbit_radius"):
        replace(turning(100, **LOADS), orbit_radius="own")  # type: ignore[arg-type]
