"""Pivot points: Heathcote's lines without spin, rigid-body sliding with it, signs and ends of the ellipse."""

from __future__ import annotations

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.readings.ellipse_sliding import deformed_radius, mean_sliding_speed
from qsbearing.readings.pivot_points import rolling_place, zeros
from tests.qsbearing.scenes import CENTRIFUGAL, DEEP_GROOVE, OUTER, solved, turning


def test_without_spin_they_are_heathcote_s_lines() -> None:
    """At 0.347 of the semi-major axis to either side; nothing where a ball is not loaded."""
    held = {"axial_displacement": 0.0, "radial_load_y": 2e3, "tilt_y": 0.0, "tilt_z": 0.0}
    solution = solved(turning(1000, DEEP_GROOVE, effects=CENTRIFUGAL, **held))
    found = qs.readings.pivot_points(solution)
    for raceway, contacts in ((found.inner, solution.inner), (found.outer, solution.outer)):
        both = np.sort([raceway.near[0], raceway.far[0]]) / contacts.semi_major_axis[0]
        assert both == pytest.approx([-0.347, 0.347], abs=5e-4)
    assert np.isnan(found.inner.near[3])


@pytest.mark.parametrize("speeds", [(900.0, 0.0), (-900.0, 0.0), (300.0, -700.0)])
def test_nothing_slides_there(speeds: tuple[float, float]) -> None:
    """Ball and ring as rigid bodies that meet on the pressed surface: at both points the same speed along rolling.

    That speed is what the traction's balance makes of the ball's rolling; without it the ball would not slide at the
    centre. Axes: along the bearing, radial, and tangential.
    """
    held = {"axial_load": 150.0, "radial_load_y": 4e3, "tilt_y": 0.0, "tilt_z": 0.0}  # small angles: little spin
    operation, bearing = qs.Operation(speed=speeds[0], outer_speed=speeds[1], **held), DEEP_GROOVE
    solution = solved(qs.Scene(bearing, operation, CENTRIFUGAL, OUTER))
    found, motion = qs.readings.pivot_points(solution), qs.readings.kinematics(solution)
    radii = bearing.inner_groove_radius, bearing.outer_groove_radius
    beta, rotation = solution.attitude_angle, solution.rotation_speed
    assert beta is not None
    assert rotation is not None
    zero = np.zeros_like(beta)
    ball = np.stack([rotation * np.cos(beta), -rotation * np.sin(beta), zero], axis=-1)
    compared = 0
    for side, raceway, contacts, speed, radius in (
        (-1.0, found.inner, solution.inner, speeds[0], radii[0]),
        (1.0, found.outer, solution.outer, speeds[1], radii[1]),
    ):
        R = deformed_radius(np.array(bearing.ball_diameter), np.array(radius))
        normal = side * np.stack([np.sin(contacts.angle), np.cos(contacts.angle), zero], axis=-1)
        larger = side * np.stack([np.cos(contacts.angle), -np.sin(contacts.angle), zero], axis=-1)  # contact angle
        relative = ball - np.stack([speed - motion.orbital_speed, zero, zero], axis=-1)

        def sliding(x: np.ndarray, relative=relative, larger=larger, normal=normal, R=R) -> np.ndarray:  # type: ignore[no-untyped-def]
            place = x[:, None] * larger - (x**2 / (2 * R))[:, None] * normal
            return np.cross(relative, place)[:, 2]

        both = np.isfinite(raceway.near) & np.isfinite(raceway.far)
        scale = np.abs(sliding(contacts.semi_major_axis)) + np.abs(sliding(-contacts.semi_major_axis))
        apart = sliding(raceway.near) - sliding(raceway.far)
        assert np.abs(apart[both] / scale[both]).max(initial=0.0) < 1e-9
        compared += both.sum()
        on = contacts.load > 0.0
        assert (np.abs(raceway.near) <= contacts.semi_major_axis)[on].all()
        if side < 0:  # outer control spins inside
            assert (np.abs(raceway.near) < 0.9 * np.abs(raceway.far))[both].all()
    assert compared >= 4


def test_the_table_of_c_is_the_integral() -> None:
    rng = np.random.default_rng(7)
    share, ratio = rng.uniform(0.0, 0.999, 200), np.exp(rng.uniform(np.log(0.002), 0.0, 200))
    exact = mean_sliding_speed(1.0 - share, share, ratio, 24, 24)[1]
    assert rolling_place(1.0 - share, share, ratio) == pytest.approx(exact, abs=1e-4)


def test_zeros_of_sliding() -> None:
    """By numpy's roots; spin alone leaves the centre."""
    t, s, c = np.array([2.0, 2.0, -1.0, 1.0]), np.array([0.5, -0.5, 0.3, 30.0]), np.array([0.1, 0.1, 0.05, 0.01])
    near, far = zeros(t, s, c)
    for i in range(4):
        roots = sorted(np.roots([-t[i], s[i], t[i] * c[i]]), key=abs)
        assert (near[i], far[i]) == pytest.approx(roots, rel=1e-12)
    near, far = zeros(np.zeros(1), np.ones(1), np.full(1, 0.01))
    assert near[0] == 0.0
    assert not np.isfinite(far[0])
