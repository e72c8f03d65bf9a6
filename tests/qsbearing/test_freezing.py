"""Balance under forces that stay: one only, at the foot of every line; and the way from there to a balance at speed."""

from __future__ import annotations

import numpy as np
import pytest
from numpy import ndarray, recarray
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.ball import outer_vector, set_speed
from qsbearing.compiled import entry, kernel
from qsbearing.dead_forces import freeze, let_act
from qsbearing.descent import move_along, pass_closed, slope_along_step
from qsbearing.freezing import settle_frozen, thaw
from qsbearing.hard_cases import WORTH
from qsbearing.keeping import FROZEN, LINE, keep
from qsbearing.newton import ball_steps, close_chains, newton, ring_step
from qsbearing.path_following import press
from qsbearing.solver import first_guess, prepare

from .one_case import one_case
from .scenes import BOTH, INNER, OUTER, turning

LITTLE = 1e-4
FRACTIONS = np.array([0.0, 0.1, 0.3 - LITTLE, 0.3, 0.3 + LITTLE, 0.6, 1.0, 1.5, 2.0])
DESCENDED, SETTLED, THAWED, STAYED = 0, 1, 2, 3
STARTS = range(4)


@kernel
def energy(case: recarray, ring: recarray, balls: ndarray) -> float:
    """Pi, of the contacts and of the dead forces."""
    total = 0.0
    for i in range(5):
        total -= case.prescribed[i] * ring.displacement[i]
    for n in range(ring.balls):
        ball = balls[n]
        u1, u2 = outer_vector(case, ball)
        pressed = case.inner_stiffness * max(ball.inner_approach, 0.0) ** 2.5
        pressed += case.outer_stiffness * max(ball.outer_approach, 0.0) ** 2.5
        total += ball.weight * (0.4 * pressed - ball.push[0] * u1 - ball.push[1] * u2)
    return total


@entry
def go_down(
    cases: ndarray,
    rings: ndarray,
    balls: ndarray,
    displacement: ndarray,
    position: ndarray,
    control: ndarray,
    start: int,
    how: int,
    fractions: ndarray,
    slopes: ndarray,
    energies: ndarray,
    found: ndarray,
) -> None:
    """Freeze what acts at the first guess; from a start with all balls pressed go down a line, or on to balance."""
    case, ring = cases[0], rings[0]
    prepare(case, ring, balls, False, displacement, position, control)
    first_guess(case, ring, balls)
    close_chains(case, ring, balls)
    if how == STAYED:
        newton(case, ring, balls, 1e-12)
    freeze(case, ring, balls, 1.0)
    press(case, ring, balls)
    ring.displacement[0] *= 1.0 + start
    if not case.is_held[1]:
        ring.displacement[1] += 0.1 * start * ring.displacement[0]
    close_chains(case, ring, balls)
    if how == THAWED:
        found[0] = thaw(case, ring, balls, 1e-12, WORTH)[0]
    else:
        set_speed(case, 0.0, case.inner_speed, case.outer_speed)
    if how == SETTLED or how == STAYED:
        keep(ring, balls, FROZEN)
        found[0] = settle_frozen(case, ring, balls, WORTH)[0]
    if how == DESCENDED:
        let_act(case, ring, balls, 1.0)
        pass_closed(case, ring, balls)
        ring_step(case, ring, balls)
        ball_steps(case, ring, balls)
        keep(ring, balls, LINE)
        for k in range(fractions.size):
            move_along(case, ring, balls, fractions[k])
            pass_closed(case, ring, balls)
            slopes[k] = slope_along_step(ring, balls)
            energies[k] = energy(case, ring, balls)
    for i in range(5):
        displacement[i] = ring.displacement[i]


def gone_down(scene: qs.Scene, start: int, how: int) -> tuple[NDArray, NDArray, NDArray, bool]:
    """(displacement in the kernel's units, slopes and energies down the line, whether balance was found)."""
    given, found = one_case(scene), np.zeros(1)
    slopes, energies = np.zeros(FRACTIONS.size), np.zeros(FRACTIONS.size)
    go_down(
        *given,
        start,
        how,
        FRACTIONS,
        slopes,
        energies,
        found,
    )
    return given[3], slopes, energies, bool(found[0])


def scene_with(control: qs.RacewayControl, axial: float, aside: float = -0.2) -> qs.Scene:
    """Combined load, free to tilt; inertia is a tenth of it, or a thousand times as much."""
    loads = {"axial_load": axial, "radial_load_y": 0.4 * axial, "radial_load_z": aside * axial}
    return turning(9_000.0, effects=BOTH, control=control, moment_y=0.0, moment_z=0.0, **loads)


SCENES = {
    "heavy": scene_with(OUTER, 5000.0),
    "light": scene_with(OUTER, 5.0),
    "inner": scene_with(INNER, 5000.0),
    "mirrored": scene_with(OUTER, 5000.0, aside=0.0),
}


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
@pytest.mark.parametrize("start", STARTS)
def test_the_slope_of_the_energy_only_rises(scene: qs.Scene, start: int) -> None:
    """Along Newton's step from anywhere: downhill at first, then ever less, as along any line of a convex function."""
    _, slopes, _, _ = gone_down(scene, start, DESCENDED)
    assert slopes[0] < 0.0
    assert (np.diff(slopes) > 0.0).all()


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
def test_the_slope_is_that_of_the_energy(scene: qs.Scene) -> None:
    """Beside a central difference, good to the third derivative times the square of the little."""
    _, slopes, energies, _ = gone_down(scene, 0, DESCENDED)
    at = int(np.flatnonzero(FRACTIONS == 0.3)[0])
    assert slopes[at] == pytest.approx((energies[at + 1] - energies[at - 1]) / (2.0 * LITTLE), rel=1e-6)


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES.keys())
def test_balance_under_frozen_forces_is_one(scene: qs.Scene) -> None:
    """From four starts to the same place, to the rounding of Newton's last step over what little resists."""
    ends = [gone_down(scene, start, SETTLED) for start in STARTS]
    assert all(found for *_, found in ends)
    places = np.array([place for place, *_ in ends])
    size = np.abs(places[0]).max()
    assert size > 0.0
    np.testing.assert_allclose(places, np.broadcast_to(places[0], places.shape), rtol=0.0, atol=1e-9 * size)


@pytest.mark.parametrize("name", ["heavy", "light", "mirrored"])
def test_forces_frozen_in_a_balance_hold_it(name: str) -> None:
    """Frozen where the bearing is in balance at speed, they bring it back there from elsewhere."""
    scene = SCENES[name]
    place, _, _, found = gone_down(scene, 1, STAYED)
    assert found
    diameter = scene.bearing.ball_diameter
    expected = qs.solve(scene).displacement / np.array([diameter, diameter, diameter, 1.0, 1.0])
    np.testing.assert_allclose(place, expected, rtol=0.0, atol=1e-8)


@pytest.mark.parametrize("name", ["heavy", "light"])
@pytest.mark.parametrize("start", STARTS)
def test_thawing_arrives_where_the_direct_way_does(name: str, start: int) -> None:
    """At the balance at speed, to what the tolerance of either leaves open."""
    scene = SCENES[name]
    place, _, _, found = gone_down(scene, start, THAWED)
    assert found
    solution = qs.solve(scene)
    assert solution.converged
    diameter = scene.bearing.ball_diameter
    np.testing.assert_allclose(
        place * np.array([diameter, diameter, diameter, 1.0, 1.0]),
        solution.displacement,
        rtol=0.0,
        atol=1e-8 * diameter,
    )
