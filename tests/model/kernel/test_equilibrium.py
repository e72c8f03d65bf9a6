"""The equations themselves, put together again from a solution's public numbers by vectors in three dimensions."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import qsbearing as qs
from tests.qsbearing.mechanics import ball_diameters, contact_stiffness, lobe, ring_load, vectors
from tests.qsbearing.scenes import general_scenes, grown_scenes, lever, lobed_scenes, solved, unequal_scenes
from tests.verification.hard_cases import scenes as hard
from tests.verification.hard_cases.cases import NO_EQUILIBRIUM

GENERAL = general_scenes() | grown_scenes() | unequal_scenes() | lobed_scenes()
NAMES = [*GENERAL, *(name for name, case in hard.BY_NAME.items() if case["expected"] != NO_EQUILIBRIUM)]
# The solver stops at a force imbalance of 1e-12 of the largest force; sums over twenty balls add a digit.
BALANCED = 1e-11


@cache
def solution_of(name: str) -> qs.Solution:
    return solved(GENERAL[name] if name in GENERAL else hard.scene_of(name))


def largest_load(solution: qs.Solution) -> float:
    return float(max(solution.inner.load.max(), solution.outer.load.max())) or 1.0


every_scene = pytest.mark.parametrize("name", NAMES)


@every_scene
def test_the_ring_and_every_ball_are_in_equilibrium(name: str) -> None:
    """The ring's five loads, applied and reactions alike, are the sum of the forces at its contact points; both
    contacts' forces, friction included, and the centrifugal force add up to nothing on each ball."""
    solution = solution_of(name)
    radius, largest = lever(solution.scene), largest_load(solution)
    unit = np.array([1.0, 1.0, 1.0, radius, radius]) * largest
    assert ring_load(solution) / unit == pytest.approx(solution.load / unit, abs=BALANCED)
    v = vectors(solution)
    thrown = np.zeros(len(v.radial)) if solution.centrifugal_force is None else solution.centrifugal_force
    left = v.inner_pull + v.outer_pull + thrown[:, None] * v.radial
    assert np.abs(left).max() <= BALANCED * largest


@every_scene
def test_contacts_are_hertz_between_the_groove_centres(name: str) -> None:
    """Q = K delta^1.5 = 2/3 pi a b p0 at loaded contacts, none at others; contact lines join the groove centres."""
    solution = solution_of(name)
    bearing, d, psi = solution.scene.operating_bearing, solution.displacement, solution.azimuth
    ball, own = float(np.asarray(bearing.ball_diameter)), ball_diameters(solution)
    reach = np.zeros((2, len(psi)))
    for race in ("inner", "outer"):
        contacts = getattr(solution, race)
        approach = np.nan_to_num(contacts.approach)
        hertz = contact_stiffness(solution, race) * np.maximum(approach, 0.0) ** 1.5
        # Rounding; the curvature across, 2/D - 1/r, loses digits where groove and ball are nearly equal.
        groove = float(np.asarray(getattr(bearing, f"{race}_groove_radius")))
        rounding = max(1e-12, 2.0**-52 / (2.0 * groove / ball - 1.0))
        assert contacts.load == pytest.approx(hertz, rel=rounding, abs=0.0)
        a, b = contacts.semi_major_axis, contacts.semi_minor_axis
        assert 2.0 / 3.0 * np.pi * a * b * contacts.max_pressure == pytest.approx(contacts.load, rel=1e-12)
        assert (b <= a).all()
        length = groove - 0.5 * own + contacts.approach
        reach += length * np.array([np.sin(contacts.angle), np.cos(contacts.angle)])
    # (Lo + do) no + (Li + di) ni leads from the outer to the displaced inner groove centre (19.3, 19.4), which stood
    # BD sin(a0) from it at rest and cold and has moved by heat in its ring; radially they stand apart as grown.
    cold, rings = solution.scene.bearing, solution.scene.ring_expansion
    strain = 0.0 if rings is None else 12e-6 * (float(rings.inner_ring_temperature) - 20.0 - qs.zero_celsius)
    moved = strain * (float(cold.inner_groove_radius) - 0.5 * float(cold.ball_diameter))
    offset = (float(cold.groove_centre_distance) + moved) * np.sin(float(cold.free_contact_angle))
    tilt = lever(solution.scene) * (d[3] * np.sin(psi) - d[4] * np.cos(psi))
    axial = offset + d[0] + tilt
    apart = float(bearing.inner_groove_centre_radius - bearing.outer_groove_centre_radius)
    radial = apart + d[1] * np.cos(psi) + d[2] * np.sin(psi) + lobe(solution)
    # The position of an unloaded ball at rest is undetermined. Lengths of half a ball, differences of rounding.
    placed = ~np.isnan(reach[0])
    assert placed.all() or not solution.scene.ball_effects
    assert reach[:, placed] == pytest.approx(np.array([axial, radial])[:, placed], abs=1e-13 * ball)


@pytest.mark.parametrize("name", [name for name, scene in GENERAL.items() if scene.centrifugal_force])
def test_centrifugal_force_is_that_of_the_orbit(name: str) -> None:
    """Fc = m (dm/2) omega_m^2 with the mass of the sphere."""
    solution = solution_of(name)
    bearing, pitch = solution.scene.bearing, float(np.asarray(solution.scene.operating_bearing.pitch_diameter))
    density, diameter = float(np.asarray(bearing.ball_material.density)), ball_diameters(solution, operating=False)
    assert solution.orbital_speed is not None
    expected = density * np.pi / 6.0 * diameter**3 * 0.5 * pitch * solution.orbital_speed**2
    assert solution.centrifugal_force == pytest.approx(expected, rel=1e-12)
