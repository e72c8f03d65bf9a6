"""The equations themselves, put together again from a solution's public numbers by vectors in three dimensions."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import qsbearing as qs

from .mechanics import contact_stiffness, ring_load, vectors
from .scenes import general_scenes, lever, solved

SCENES = general_scenes()
# The solver stops at a force imbalance of 1e-12 of the largest force; sums over twenty balls add a digit.
BALANCED = 1e-11


@cache
def solution_of(name: str) -> qs.Solution:
    return solved(SCENES[name])


def largest_load(solution: qs.Solution) -> float:
    return float(max(solution.inner.load.max(), solution.outer.load.max()))


every_scene = pytest.mark.parametrize("name", list(SCENES))


@every_scene
def test_the_ring_is_in_equilibrium(name: str) -> None:
    """All five loads on the ring, applied and reactions alike, are the sum of the forces at its contact points."""
    solution = solution_of(name)
    radius = lever(solution.scene)
    unit = np.array([1.0, 1.0, 1.0, radius, radius]) * largest_load(solution)
    assert ring_load(solution) / unit == pytest.approx(solution.load / unit, abs=BALANCED)


@every_scene
def test_every_ball_is_in_equilibrium(name: str) -> None:
    """Both contacts' forces, friction included, and the centrifugal force add up to nothing on each ball."""
    solution = solution_of(name)
    v = vectors(solution)
    thrown = np.zeros(len(v.radial)) if solution.centrifugal_force is None else solution.centrifugal_force
    left = v.inner_pull + v.outer_pull + thrown[:, None] * v.radial
    assert np.abs(left).max() <= BALANCED * largest_load(solution)


@every_scene
def test_loads_are_hertz_of_the_approaches(name: str) -> None:
    """Q = K delta^1.5 at every loaded contact, K from the Hertz contact itself; no load without approach."""
    solution = solution_of(name)
    for race in ("inner", "outer"):
        contacts = getattr(solution, race)
        approach = np.nan_to_num(contacts.approach)
        expected = contact_stiffness(solution, race) * np.maximum(approach, 0.0) ** 1.5
        assert contacts.load == pytest.approx(expected, rel=1e-12, abs=0.0)  # rounding


@every_scene
def test_contact_lines_span_the_groove_centres(name: str) -> None:
    """(Lo + do) no + (Li + di) ni leads from the outer to the displaced inner groove centre (19.3, 19.4)."""
    solution = solution_of(name)
    bearing, d = solution.scene.bearing, solution.displacement
    ball = float(np.asarray(bearing.ball_diameter))
    psi = solution.azimuth
    free, distance = float(np.asarray(bearing.free_contact_angle)), float(bearing.groove_centre_distance)
    tilt = lever(solution.scene) * (d[3] * np.sin(psi) - d[4] * np.cos(psi))
    axial = distance * np.sin(free) + d[0] + tilt
    radial = distance * np.cos(free) + d[1] * np.cos(psi) + d[2] * np.sin(psi)
    reach_axial, reach_radial = np.zeros(len(psi)), np.zeros(len(psi))
    for race in ("inner", "outer"):
        contacts = getattr(solution, race)
        length = float(np.asarray(getattr(bearing, f"{race}_groove_radius"))) - 0.5 * ball + contacts.approach
        reach_axial += length * np.sin(contacts.angle)
        reach_radial += length * np.cos(contacts.angle)
    placed = ~np.isnan(reach_axial)
    assert placed.sum() >= len(psi) / 3
    # Lengths of half a millimetre, differences of rounding.
    assert reach_axial[placed] == pytest.approx(axial[placed], abs=1e-13 * ball)
    assert reach_radial[placed] == pytest.approx(radial[placed], abs=1e-13 * ball)


@every_scene
def test_ellipses_carry_their_load(name: str) -> None:
    """The pressure over the ellipse integrates to the load: Q = 2/3 pi a b p0; b never exceeds a."""
    solution = solution_of(name)
    for race in ("inner", "outer"):
        contacts = getattr(solution, race)
        a, b = contacts.semi_major_axis, contacts.semi_minor_axis
        assert 2.0 / 3.0 * np.pi * a * b * contacts.max_pressure == pytest.approx(contacts.load, rel=1e-12)
        assert (b <= a).all()


@every_scene
def test_centrifugal_force_is_that_of_the_orbit(name: str) -> None:
    """Fc = m (dm/2) omega_m^2 with the mass of the sphere."""
    solution = solution_of(name)
    if solution.centrifugal_force is None:
        assert solution.scene.centrifugal_force is None
        return
    bearing = solution.scene.bearing
    density = float(np.asarray(bearing.ball_material.density))
    mass = density * np.pi / 6.0 * float(np.asarray(bearing.ball_diameter)) ** 3
    assert solution.orbital_speed is not None
    expected = mass * 0.5 * float(np.asarray(bearing.pitch_diameter)) * solution.orbital_speed**2
    assert solution.centrifugal_force == pytest.approx(expected, rel=1e-12)
