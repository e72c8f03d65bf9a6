"""What is read off a solved case, computed when it is asked for: contacts, ball motion, and the exact stiffness."""

from __future__ import annotations

from math import atan2, nan, pi

from numpy import ndarray, recarray

from qsbearing.ball import (
    UNLIMITED,
    close_told,
    evaluate,
    friction_shares,
    groove_stiffness,
    inertia_of,
    is_moving,
    is_rolled,
    line_to_inner,
    raceway_ellipse,
    take_place,
)
from qsbearing.compiled import entry, kernel
from qsbearing.contact import contact_load
from qsbearing.kinematics import orbital_speed, rolling_terms, rotation_per_axis_length
from qsbearing.raceway_control import rotation_axis
from qsbearing.ring import add_ball, couple, inner_groove_centre, place_balls, start_sums
from qsbearing.verdict import CONVERGED

ANGLE, LOAD, APPROACH, SEMI_MAJOR_AXIS, SEMI_MINOR_AXIS, MAX_PRESSURE, REQUIRED_FRICTION = range(7)
# Of a contact's stiffness: far below any, it lets a ball out of contact be eliminated.
NOTHING = 1e-30
CENTRIFUGAL_FORCE, GYROSCOPIC_MOMENT, ORBITAL_SPEED, ROTATION_SPEED = range(7, 11)


@kernel
def read_ball(case: recarray, ball: recarray, side: float, what: int) -> float:
    """One quantity of one ball, in the case's units; side: INNER_SIDE or OUTER_SIDE.

    A ball at rest that touches neither raceway has no defined place, and so no angle.
    """
    si, ci, so, co = ball.inner_sine, ball.inner_cosine, ball.outer_sine, ball.outer_cosine
    is_moment = what == GYROSCOPIC_MOMENT or what == REQUIRED_FRICTION
    if is_moment and not is_rolled(ball):
        return 0.0
    if what >= CENTRIFUGAL_FORCE:
        return read_motion(case, ball, what)
    n1, n2, delta = (si, ci, ball.inner_approach) if side < 0 else (so, co, ball.outer_approach)
    load, _ = contact_load(groove_stiffness(case, side, n1, n2)[0], delta)
    free = load == 0.0 and not is_moving(case)
    if what == LOAD:
        return load
    if free and (what == ANGLE or what == APPROACH):
        return nan
    if what == ANGLE:
        return atan2(n1, n2)
    if what == APPROACH:
        return delta
    if what == REQUIRED_FRICTION:
        _, mg = inertia_of(case, ball)
        share_i, share_o = friction_shares(case, ball.control)
        friction = abs((share_i if side < 0 else share_o) * mg)
        if friction == 0.0:
            return 0.0
        return friction / load if load > 0.0 else nan
    if load <= 0.0:
        return 0.0
    cosine = n2 if case.actual_angle else case.hertz_cosine
    a, b, _, _ = raceway_ellipse(case, side, cosine)
    size = load ** (1.0 / 3.0)
    if what == SEMI_MAJOR_AXIS:
        return a * size
    if what == SEMI_MINOR_AXIS:
        return b * size
    return 1.5 * size / (pi * a * b)


@kernel
def read_motion(case: recarray, ball: recarray, what: int) -> float:
    """Inertia loads and speeds of one ball."""
    if what == CENTRIFUGAL_FORCE:
        return inertia_of(case, ball)[0]
    if what == GYROSCOPIC_MOMENT:
        return inertia_of(case, ball)[1]
    g = 1.0 / case.pitch_diameter
    so, co = ball.outer_sine, ball.outer_cosine
    si, ci, _, _, _ = line_to_inner(case, ball)
    axis = rotation_axis(ball.control, g, si, ci, so, co)
    terms = rolling_terms(g, si, ci, so, co, axis)
    if what == ORBITAL_SPEED:
        return orbital_speed(terms, case.inner_speed, case.outer_speed)[0]
    length = (axis[0] * axis[0] + axis[1] * axis[1]) ** 0.5
    return rotation_per_axis_length(terms, g, case.inner_speed, case.outer_speed)[0] * length


@entry
def read_cases(
    cases: ndarray,
    rings: ndarray,
    balls: ndarray,
    status: ndarray,
    displacement: ndarray,
    position: ndarray,
    control: ndarray,
    side: float,
    what: int,
    out: ndarray,
) -> None:
    """Fill out (case, ball) with a quantity in the case's units; NaN for cases not solved and for missing balls."""
    ring = rings[0]
    for k in range(cases.size):
        case = cases[k]
        place_balls(case, ring, balls)
        for j in range(position.shape[1]):
            if status[k] != CONVERGED or j >= case.ball_count:
                out[k, j] = nan
                continue
            ball = balls[j]
            put_back(case, ball, displacement[k], position[k, j], control[k, j])
            out[k, j] = read_ball(case, ball, side, what)


@kernel
def put_back(case: recarray, ball: recarray, displacement: ndarray, position: ndarray, control: int) -> None:
    """Put a ball of the bearing where a solution says that it is."""
    take_place(case, ball, position)
    a1, a2 = inner_groove_centre(case, displacement, ball.azimuth_cosine, ball.azimuth_sine)
    close_told(case, ball, a1, a2)
    ball.control = control


@entry
def stiffness_of_cases(
    cases: ndarray,
    rings: ndarray,
    balls: ndarray,
    status: ndarray,
    displacement: ndarray,
    position: ndarray,
    control: ndarray,
    out: ndarray,
) -> None:
    """Fill out (case, 5, 5), SI, with dF/dd: the same elimination that solves the case, over all balls and channels."""
    ring = rings[0]
    for k in range(cases.size):
        case = cases[k]
        if status[k] != CONVERGED:
            out[k] = nan
            continue
        place_balls(case, ring, balls)
        ring.balls, ring.channels = case.ball_count, 5
        for i in range(5):
            ring.channel[i] = i
        for j in range(case.ball_count):
            ball = balls[j]
            ball.cosine, ball.sine, ball.weight = ball.azimuth_cosine, ball.azimuth_sine, 1.0
        couple(case, ring, balls)
        start_sums(case, ring)
        for j in range(case.ball_count):
            ball = balls[j]
            put_back(case, ball, displacement[k], position[k, j], control[k, j])
            a1, a2 = inner_groove_centre(case, displacement[k], ball.cosine, ball.sine)
            evaluate(case, ball, a1, a2, NOTHING * case.series_stiffness, UNLIMITED)
            add_ball(ring, ball)
        for p in range(5):
            for q in range(5):
                size = case.force
                if p < 3:
                    size /= case.length
                if q >= 3:
                    size *= case.length
                out[k, p, q] = ring.matrix[p, q] * size
