"""What is read off a solved case, computed when it is asked for: contacts, ball motion, and the exact stiffness."""

from __future__ import annotations

from math import atan2, nan, pi

from numpy import ndarray, recarray

from qsbearing.compiled import entry, kernel
from qsbearing.kernel.admissibility import CONVERGED
from qsbearing.kernel.ball import evaluate_ball
from qsbearing.kernel.ball_inertia import axis_where_it_is, friction_asked, inertia_of, is_moving, is_rolled
from qsbearing.kernel.contact_line import contact_load
from qsbearing.kernel.kinematics import orbital_speed, rolling_terms, rotation_per_axis_length
from qsbearing.kernel.loop_closure import close_loaded, load_position
from qsbearing.kernel.newton import STALLED
from qsbearing.kernel.raceway_stiffness import (
    contact_loads,
    groove_stiffness,
    raceway_ellipse,
    set_spin_constants,
)
from qsbearing.kernel.ring import add_ball, couple_channels, inner_groove_centre, set_azimuths, start_sums

ANGLE, LOAD, APPROACH, SEMI_MAJOR_AXIS, SEMI_MINOR_AXIS, MAX_PRESSURE, REQUIRED_FRICTION = range(7)
CENTRIFUGAL_FORCE, GYROSCOPIC_MOMENT, ORBITAL_SPEED, ROTATION_SPEED, ATTITUDE_ANGLE, SLIPS = range(7, 13)

# Of a contact's stiffness: far below any, it lets a ball out of contact be eliminated.
LEAST_STIFFNESS = 1e-30


@kernel
def set_full_scale(case: recarray, work: recarray) -> None:
    """The case as it was asked for: all loads and speeds, its own bound on friction."""
    work.load_factor, work.speed_factor, work.friction_bound = 1.0, 1.0, case.friction_coefficient
    set_spin_constants(case, work)
    work.regularisation = LEAST_STIFFNESS * case.series_stiffness


@kernel
def read_ball(case: recarray, work: recarray, ball: recarray, side: float, what: int, a: float, b: float) -> float:
    """One quantity of one ball, in the case's units; side: INNER_SIDE or OUTER_SIDE; a, b: semi-axes at unit load.

    A ball at rest that touches neither raceway has no determined position, and so no angle.
    """
    si, ci, so, co = ball.inner_sine, ball.inner_cosine, ball.outer_sine, ball.outer_cosine
    is_moment = what == GYROSCOPIC_MOMENT or what == REQUIRED_FRICTION or what == SLIPS
    if is_moment and not is_rolled(ball):
        return 0.0
    if what >= CENTRIFUGAL_FORCE:
        return read_motion(case, work, ball, what)
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
        at_inner, at_outer = friction_asked(case, work, ball)
        friction = at_inner if side < 0 else at_outer
        if friction == 0.0:
            return 0.0
        return friction / load if load > 0.0 else nan
    if load <= 0.0:
        return 0.0
    size = load ** (1.0 / 3.0)
    if what == SEMI_MAJOR_AXIS:
        return a * size
    if what == SEMI_MINOR_AXIS:
        return b * size
    return 1.5 * size / (pi * a * b)


@kernel
def hertz_cosine(case: recarray, ball: recarray, side: float) -> float:
    """Cosine of the angle at which a contact's ellipse is taken."""
    if not case.actual_angle:
        return case.hertz_cosine
    return ball.inner_cosine if side < 0 else ball.outer_cosine


@kernel
def read_motion(case: recarray, work: recarray, ball: recarray, what: int) -> float:
    """Inertia loads and speeds of one ball."""
    if what == CENTRIFUGAL_FORCE:
        return inertia_of(case, work, ball)[0]
    if what == GYROSCOPIC_MOMENT:
        return inertia_of(case, work, ball)[1]
    if what == SLIPS:
        return 1.0 if slips(case, work, ball) else 0.0
    radius, _, si, ci, axis = axis_where_it_is(case, work, ball)
    if what == ATTITUDE_ANGLE:
        return atan2(axis[0], axis[1])
    g = 0.5 / radius
    terms = rolling_terms(g, si, ci, ball.outer_sine, ball.outer_cosine, axis)
    if what == ORBITAL_SPEED:
        return orbital_speed(terms, case.inner_speed, case.outer_speed)[0]
    length = (axis[0] * axis[0] + axis[1] * axis[1]) ** 0.5
    return rotation_per_axis_length(terms, g, case.inner_speed, case.outer_speed)[0] * length


@kernel
def slips(case: recarray, work: recarray, ball: recarray) -> bool:
    """Whether some contact is asked for more friction than the case says that it carries."""
    asked_i, asked_o = friction_asked(case, work, ball)
    inner, outer = contact_loads(case, ball)
    small = STALLED * max(inner, outer)  # what the solver may leave
    bound = case.friction_coefficient
    return bool(asked_i > bound * inner + small or asked_o > bound * outer + small)


@entry
def read_cases(
    cases: ndarray,
    workspaces: ndarray,
    balls: ndarray,
    results: ndarray,
    positions: ndarray,
    controls: ndarray,
    side: float,
    what: int,
    out: ndarray,
) -> None:
    """Fill out (case, ball) with a quantity in the case's units; NaN for cases not solved and for missing balls."""
    work = workspaces[0]
    is_ellipse = SEMI_MAJOR_AXIS <= what <= MAX_PRESSURE
    a, b, form, coefficient, pitch, cosine = nan, nan, -1, nan, nan, nan
    for k in range(cases.size):
        case = cases[k]
        set_azimuths(case, work, balls)
        set_full_scale(case, work)
        f = case.inner_coefficient if side < 0 else case.outer_coefficient
        for j in range(positions.shape[1]):
            if results[k].status != CONVERGED or j >= case.ball_count:
                out[k, j] = nan
                continue
            ball = balls[j]
            restore_ball(case, ball, results[k].displacement, positions[k, j], controls[k, j])
            if is_ellipse:
                at = hertz_cosine(case, ball, side)
                # An exact ellipse takes longer than all the rest; most often it is the same for all balls and cases.
                if at != cosine or f != coefficient or case.pitch_diameter != pitch or case.form != form:
                    cosine, coefficient, pitch, form = at, f, case.pitch_diameter, case.form
                    a, b, _, _ = raceway_ellipse(case, side, cosine)
            out[k, j] = read_ball(case, work, ball, side, what, a, b)


@kernel
def restore_ball(case: recarray, ball: recarray, displacement: ndarray, position: ndarray, control: int) -> None:
    """Put a ball of the bearing where a solution says that it is."""
    load_position(case, ball, position)
    a1, a2 = inner_groove_centre(case, displacement, ball.azimuth_cosine, ball.azimuth_sine)
    close_loaded(case, ball, a1, a2)
    ball.control = control


@entry
def stiffness_of_cases(
    cases: ndarray,
    workspaces: ndarray,
    balls: ndarray,
    results: ndarray,
    positions: ndarray,
    controls: ndarray,
    out: ndarray,
) -> None:
    """Fill out (case, 5, 5), SI, with dF/dd: the same elimination that solves the case, over all balls and channels."""
    work = workspaces[0]
    for k in range(cases.size):
        case = cases[k]
        if results[k].status != CONVERGED:
            out[k] = nan
            continue
        set_azimuths(case, work, balls)
        set_full_scale(case, work)
        work.ball_count, work.channel_count = case.ball_count, 5
        for i in range(5):
            work.channel[i] = i
        for j in range(case.ball_count):
            ball = balls[j]
            ball.cosine, ball.sine, ball.weight = ball.azimuth_cosine, ball.azimuth_sine, 1.0
        couple_channels(case, work, balls)
        start_sums(case, work)
        for j in range(case.ball_count):
            ball = balls[j]
            restore_ball(case, ball, results[k].displacement, positions[k, j], controls[k, j])
            a1, a2 = inner_groove_centre(case, results[k].displacement, ball.cosine, ball.sine)
            evaluate_ball(case, work, ball, a1, a2)
            add_ball(work, ball)
        for p in range(5):
            for q in range(5):
                size = case.force
                if p < 3:
                    size /= case.length
                if q >= 3:
                    size *= case.length
                out[k, p, q] = work.matrix[p, q] * size
