"""The exact stiffness against differences and against the contacts' springs; work against stored energy."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from tests.qsbearing.mechanics import ball_diameters, contact_stiffness, stored_energy
from tests.qsbearing.scenes import (
    B218,
    CENTRIFUGAL,
    DEEP_GROOVE,
    DISPLACEMENTS,
    INNER,
    OUTER,
    SPINDLE,
    fewer,
    general_scenes,
    grown_scenes,
    held_at,
    lever,
    lobed_scenes,
    resting,
    solved,
    turning,
    unequal_scenes,
)

SCENES = general_scenes() | grown_scenes() | unequal_scenes() | lobed_scenes()
every_scene = pytest.mark.parametrize("name", list(SCENES))


@cache
def solution_of(name: str) -> qs.Solution:
    return solved(SCENES[name])


def units(scene: qs.Scene) -> NDArray:
    """A length for each channel: tilts count by the way that they move the groove centres."""
    radius = lever(scene)
    return np.array([1.0, 1.0, 1.0, 1.0 / radius, 1.0 / radius])


def scaled(matrix: NDArray) -> NDArray:
    """Entries over the geometric mean of the diagonal entries that they join."""
    diagonal = np.sqrt(np.abs(np.diag(matrix)))
    return matrix / np.outer(diagonal, diagonal)


# Central differences of fourth order over a step of h = 1e-8 m: the loads' imbalance of 1e-12 leaves 1e-9 of the
# stiffness; the error of truncation goes with (h/approach)^4 and is below that for approaches above 1e-6 m.
STEP = 2e-8
OFFSETS = np.array([-2.0, -1.0, 1.0, 2.0])
WEIGHTS = np.array([1.0, -8.0, 8.0, -1.0]) / 12.0


def difference(function: NDArray, step: NDArray) -> NDArray:
    """Derivatives from values at OFFSETS of every channel: (channel, offset, value) -> (value, channel)."""
    return np.einsum("cov,o,c->vc", function, WEIGHTS, 1.0 / step)


@every_scene
def test_stiffness_is_the_change_of_load_with_displacement(name: str) -> None:
    """Every channel held and moved a little, both ways: dF/dd to 1e-6."""
    scene, solution = SCENES[name], solution_of(name)
    stiffness = qs.stiffness(scene, solution)
    step = STEP * units(scene)
    moved = solution.displacement + OFFSETS[None, :, None] * np.diag(step)[:, None, :]
    measured = difference(solved(held_at(scene, moved)).load, step)
    diagonal = np.sqrt(np.abs(np.diag(stiffness)))
    assert measured / np.outer(diagonal, diagonal) == pytest.approx(scaled(stiffness), abs=1e-6)


# ------------------------------------------------------------------------------------------------ the contacts' springs


def springs_of_the_balls(solution: qs.Solution) -> NDArray:
    """The ring's stiffness with every inertia force frozen: each ball two springs in series, by its contacts.

    A contact's tangent is dQ/d(delta) along its line and Q over the distance of its centres across it.
    """
    scene, bearing = solution.scene, solution.scene.bearing
    ball = ball_diameters(solution)
    tangents = []
    for race in ("inner", "outer"):
        contacts = getattr(solution, race)
        along = 1.5 * contact_stiffness(solution, race) * np.sqrt(np.maximum(contacts.approach, 0.0))
        distance = float(np.asarray(getattr(bearing, f"{race}_groove_radius"))) - 0.5 * ball + contacts.approach
        n = np.stack([np.sin(contacts.angle), np.cos(contacts.angle)], axis=-1)
        t = np.stack([np.cos(contacts.angle), -np.sin(contacts.angle)], axis=-1)
        across = contacts.load / distance
        tangents.append(
            along[:, None, None] * n[:, :, None] * n[:, None, :] + across[:, None, None] * t[:, :, None] * t[:, None, :]
        )
    inner, outer = tangents
    series = inner - inner @ np.linalg.solve(inner + outer, inner)
    c, s, zero, one = np.cos(solution.azimuth), np.sin(solution.azimuth), 0.0 * solution.azimuth, 1.0
    radius = lever(scene)
    moves = np.stack(
        [np.stack([zero + one, zero, zero, radius * s, -radius * c], -1), np.stack([zero, c, s, zero, zero], -1)], 1
    )
    return np.einsum("bip,bij,bjq->pq", moves, series, moves)


@pytest.mark.parametrize("bearing", [B218, SPINDLE], ids=["B218", "spindle"])
def test_at_rest_the_stiffness_is_the_springs(bearing: qs.BallBearing) -> None:
    """With all balls loaded: symmetric, positive definite, and the sum of springs in series."""
    loads = {"axial_load": 4e3, "radial_load_y": 700.0, "radial_load_z": -300.0, "moment_y": 6.0, "moment_z": -9.0}
    scene = resting(bearing, **loads)
    solution = solved(scene)
    assert (solution.inner.load > 0.0).all()
    stiffness = qs.stiffness(scene, solution)
    expected = springs_of_the_balls(solution)
    assert scaled(stiffness) == pytest.approx(scaled(expected), abs=1e-10)
    assert np.diag(stiffness) == pytest.approx(np.diag(expected), rel=1e-10)
    assert scaled(stiffness) == pytest.approx(scaled(stiffness).T, abs=1e-13)  # rounding
    assert (np.linalg.eigvalsh(scaled(stiffness)) > 0.0).all()


def test_frozen_centrifugal_forces_leave_it_symmetric() -> None:
    """Both rings at one speed: every ball goes round with them, so its centrifugal force is the same at any angle.

    With forces that do not follow the angles the stiffness at speed is symmetric, and the sum of its springs.
    """
    loads = {"axial_load": 9e3, "radial_load_y": 1.5e3, "radial_load_z": -500.0, "moment_y": 20.0, "moment_z": -40.0}
    scene = turning(6000, outer_rpm=6000, **loads)
    solution = solved(scene)
    stiffness = qs.stiffness(scene, solution)
    assert scaled(stiffness) == pytest.approx(scaled(stiffness).T, abs=1e-12)  # rounding
    assert stiffness == pytest.approx(springs_of_the_balls(solution), rel=1e-9, abs=1e-9 * np.abs(stiffness).max())


def test_a_ball_that_hardly_anything_presses_has_a_stiffness_too() -> None:
    """One ball, held where the ring's tilt leaves it room, turning once in days: pressed by less than the rounding of
    its place it resists nothing, which is a number."""
    material = qs.Material(elastic_modulus=1e9, poisson_ratio=0.0, density=100.0)
    bearing = qs.BallBearing(
        ball_count=1,
        ball_diameter=100 * qs.mm,
        pitch_diameter=316.227766016838 * qs.mm,
        inner_groove_radius=100 * qs.mm,
        outer_groove_radius=100 * qs.mm,
        free_contact_angle=1.0,
        ball_material=material,
        ring_material=material,
    )
    held = dict.fromkeys(DISPLACEMENTS, 0.0) | {"tilt_z": 0.01}
    operation = qs.Operation(speed=0.0, outer_speed=np.array([1e-11, 1e-9, 1e-6]) * qs.rpm, **held)
    scene = qs.Scene(bearing, operation, CENTRIFUGAL, OUTER, tilt_lever=qs.TiltLever.GROOVE_CENTRE)
    stiffness = qs.stiffness(scene, solved(scene))
    assert np.isfinite(stiffness).all()
    assert np.abs(stiffness[:, :3, :3]).max() < 1e-9  # N/m: of a contact under one newton, a million


@pytest.mark.parametrize("effects", [CENTRIFUGAL, (qs.GyroscopicMoment(),)], ids=["centrifugal", "gyroscopic"])
def test_inertia_that_follows_the_angles_breaks_the_symmetry(effects: tuple) -> None:
    """The departure from the springs is the inertia forces' derivative: none at rest, growing as speed squared."""
    loads = {"axial_load": 9e3, "radial_load_y": 1.5e3, "radial_load_z": -500.0, "moment_y": 20.0, "moment_z": -40.0}
    rpm = np.array([50.0, 100.0])
    asymmetry = []
    for speed in rpm:
        scene = turning(speed, effects=effects, control=INNER, **loads)
        matrix = scaled(qs.stiffness(scene, solved(scene)))
        asymmetry.append(np.abs(matrix - matrix.T).max())
    assert asymmetry[0] > 1e-9
    # Its own corrections are of the order of the inertia over the contact loads, 1e-4 here.
    assert np.log2(asymmetry[1] / asymmetry[0]) == pytest.approx(2.0, abs=1e-3)


# --------------------------------------------------------------------------------------------------------------- energy


def work_along(scene: qs.Scene, start: NDArray, end: NDArray, points: int) -> float:
    """Integral of load over displacement from start to end, straight, by Gauss's points in sqrt(path).

    Loads rise as path^(3/2), which the root makes a smooth function that Gauss's points integrate to rounding.
    """
    nodes, weights = np.polynomial.legendre.leggauss(points)
    root = 0.5 * (nodes + 1.0)
    path = (root**2)[:, None]
    load = solved(held_at(scene, start + path * (end - start))).load
    return float(0.5 * np.sum(weights * 2.0 * root * (load @ (end - start))))


@pytest.mark.parametrize("bearing", [B218, SPINDLE, DEEP_GROOVE], ids=["B218", "spindle", "deep groove"])
def test_work_is_stored_energy(bearing: qs.BallBearing) -> None:
    """At rest, from the position where all just touch: the load's work is 2/5 K delta^2.5 over all contacts."""
    end = np.array([80e-6, 2e-6, -1e-6, 1e-4, -2e-4])
    if bearing is DEEP_GROOVE:
        end[1:3] = 0.0  # at angle zero a radial shift would part some balls from their rings on the first bit of way
    scene = resting(bearing)
    final = solved(held_at(scene, end))
    assert (final.inner.load > 0.0).all()
    work = work_along(scene, np.zeros(5), end, fewer(64, 24))
    assert work == pytest.approx(stored_energy(final), rel=1e-9)  # imbalance 1e-12, and Gauss


def test_work_against_constant_centrifugal_force() -> None:
    """Both rings at one speed: the load's work is the change of stored energy less the centrifugal forces' work."""
    scene = turning(9000, outer_rpm=9000, axial_load=1e3)
    start, end = np.array([40e-6, 0, 0, 0, 0]), np.array([70e-6, 8e-6, 3e-6, 1e-4, -2e-4])
    states = [solved(held_at(scene, place)) for place in (start, end)]
    energies, outward = [], []
    for state in states:
        energies.append(stored_energy(state))
        reach = float(np.asarray(B218.outer_groove_radius)) - 0.5 * float(np.asarray(B218.ball_diameter))
        outward.append((reach + state.outer.approach) * np.cos(state.outer.angle))
    assert states[0].centrifugal_force is not None
    force = states[0].centrifugal_force
    assert states[1].centrifugal_force == pytest.approx(force, rel=1e-14)
    stored = energies[1] - energies[0] - float((force * (outward[1] - outward[0])).sum())
    assert work_along(scene, start, end, fewer(48, 16)) == pytest.approx(stored, rel=1e-9)
