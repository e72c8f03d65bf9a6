"""What is read off a solved case, computed when it is asked for: contacts, ball motion, and the exact stiffness."""

from __future__ import annotations

from math import atan2, nan, pi, sqrt

import numpy as np
from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import entry, kernel
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.contact.hertz import INNER_SIDE, OUTER_SIDE
from qsbearing.model.kernel.admissibility import CONVERGED
from qsbearing.model.kernel.ball import evaluate_ball
from qsbearing.model.kernel.ball_inertia import axis_where_it_is, friction_asked, inertia_of, is_moving, is_rolled
from qsbearing.model.kernel.ball_size import set_sizes
from qsbearing.model.kernel.contact_line import contact_load
from qsbearing.model.kernel.kinematics import orbital_speed, rolling_terms, rotation_per_axis_length
from qsbearing.model.kernel.loop_closure import close_loaded, load_position
from qsbearing.model.kernel.newton import STALLED
from qsbearing.model.kernel.raceway_stiffness import (
    contact_loads,
    groove_stiffness,
    hertz_cosine,
    raceway_ellipse,
    radius_coefficient,
    set_spin_constants,
)
from qsbearing.model.kernel.ring import add_ball, couple_channels, inner_groove_centre, set_azimuths, start_sums
from qsbearing.model.kernel.ring_bending import choose_modes, eliminate_deflections, set_compliances
from qsbearing.model.kernel.workspace import FOUND, GIVEN

# Quantities of a contact, at either raceway, and of a ball.
ANGLE, SINE, COSINE, LOAD, APPROACH, SEMI_MAJOR_AXIS, SEMI_MINOR_AXIS, MAX_PRESSURE, REQUIRED_FRICTION = range(9)
CENTRIFUGAL_FORCE, GYROSCOPIC_MOMENT, SLIPS, ORBITAL_SPEED, ROTATION_SPEED, ATTITUDE_ANGLE = range(9, 15)
AXIAL_ROTATION, RADIAL_ROTATION = range(15, 17)
QUANTITIES = 17
NOT_ASKED = -1
"""In place of the number of the table that a quantity goes to."""
AT_INNER, AT_OUTER, OF_BALL = range(3)
"""Rows of those numbers."""

# Of a contact's stiffness: far below any, it lets a ball out of contact be eliminated.
LEAST_STIFFNESS = 1e-30


@kernel
def set_full_scale(case: recarray, work: recarray, balls: ndarray, own: ndarray) -> None:
    """The case as it was asked for: all loads and speeds, its own bound on friction and balls."""
    work.load_factor, work.speed_factor, work.friction_bound = 1.0, 1.0, case.friction_coefficient
    set_sizes(case, case.ball_count, balls, own)
    set_spin_constants(case, case.ball_count, balls)
    work.regularisation = LEAST_STIFFNESS * case.series_stiffness
    if case.elastic_rings:
        set_compliances(case, work, own)


# Quantities that take more than the others: they are worked out only where one of them is asked for.
ELLIPSE = 1 << SEMI_MAJOR_AXIS | 1 << SEMI_MINOR_AXIS | 1 << MAX_PRESSURE
INERTIA = 1 << CENTRIFUGAL_FORCE | 1 << GYROSCOPIC_MOMENT
SPEEDS = 1 << ORBITAL_SPEED | 1 << ROTATION_SPEED | 1 << ATTITUDE_ANGLE | 1 << AXIAL_ROTATION | 1 << RADIAL_ROTATION


@kernel
def asked_of(tables: ndarray) -> int:
    """Which quantities are asked for, as bits."""
    asked = 0
    for what in range(QUANTITIES):
        if tables[what] != NOT_ASKED:
            asked |= 1 << what
    return asked


@kernel
def put(asked: int, tables: ndarray, what: int, out: ndarray, k: int, j: int, value: float) -> None:
    """Write a quantity of ball j of case k, if it is asked for."""
    if asked & 1 << what:
        out[tables[what], k, j] = value


@kernel
def read_contact(
    case: recarray, ball: recarray, side: float, friction: float, ellipse: tuple[float, ...],
    units: tuple[float, float, float], asked: int, tables: ndarray, out: ndarray, k: int, j: int,
) -> None:  # fmt: skip
    """What is asked for of one contact, SI; side: INNER_SIDE or OUTER_SIDE; ellipse: of `ellipse_at`.

    A ball at rest that touches neither raceway has no determined position, and so no angle.
    """
    length, force, pressure = units
    n1, n2, delta = ball.outer_sine, ball.outer_cosine, ball.outer_approach
    if side < 0:
        n1, n2, delta = ball.inner_sine, ball.inner_cosine, ball.inner_approach
    stiffness, _ = groove_stiffness(case, ball, side, n1, n2)
    load, _ = contact_load(stiffness, delta)
    if load == 0.0 and not is_moving(case):
        n1, n2, delta = nan, nan, nan
    put(asked, tables, LOAD, out, k, j, load * force)
    if asked & 1 << ANGLE:
        out[tables[ANGLE], k, j] = atan2(n1, n2)
    put(asked, tables, SINE, out, k, j, n1)
    put(asked, tables, COSINE, out, k, j, n2)
    put(asked, tables, APPROACH, out, k, j, delta * length)
    if asked & 1 << REQUIRED_FRICTION:
        needed = 0.0
        if friction != 0.0:
            needed = friction / load if load > 0.0 else nan
        out[tables[REQUIRED_FRICTION], k, j] = needed
    root = sqrt(delta) if load > 0.0 else 0.0
    put(asked, tables, SEMI_MAJOR_AXIS, out, k, j, ellipse[0] * root * length)
    put(asked, tables, SEMI_MINOR_AXIS, out, k, j, ellipse[1] * root * length)
    put(asked, tables, MAX_PRESSURE, out, k, j, ellipse[2] * root * pressure)


@kernel
def read_motion(
    case: recarray, work: recarray, ball: recarray, asked: int, tables: ndarray, out: ndarray, k: int, j: int
) -> None:
    """What is asked for of a ball's inertia loads and speeds, SI."""
    if asked & INERTIA:
        fc, mg = inertia_of(case, work, ball)
        put(asked, tables, CENTRIFUGAL_FORCE, out, k, j, fc * case.force)
        put(asked, tables, GYROSCOPIC_MOMENT, out, k, j, mg * (case.force * case.length) if is_rolled(ball) else 0.0)
    if asked & 1 << SLIPS:
        out[tables[SLIPS], k, j] = 1.0 if is_rolled(ball) and slips(case, work, ball) else 0.0
    if not asked & SPEEDS:
        return
    if case.common_motion:
        read_common_motion(case, asked, tables, out, k, j)
        return
    radius, _, si, ci, axis = axis_where_it_is(case, work, ball)
    p, q, _, _, _, _ = axis
    g = 0.5 * ball.diameter / radius
    terms = rolling_terms(g, si, ci, ball.outer_sine, ball.outer_cosine, axis)
    put(
        asked,
        tables,
        ORBITAL_SPEED,
        out,
        k,
        j,
        orbital_speed(terms, case.inner_speed, case.outer_speed)[0] * case.speed,
    )
    rotation = rotation_per_axis_length(terms, g, case.inner_speed, case.outer_speed)[0] * case.speed
    put(asked, tables, AXIAL_ROTATION, out, k, j, rotation * q)
    put(asked, tables, RADIAL_ROTATION, out, k, j, rotation * p)
    if asked & 1 << ROTATION_SPEED:
        out[tables[ROTATION_SPEED], k, j] = rotation * sqrt(p * p + q * q)
    if asked & 1 << ATTITUDE_ANGLE:
        out[tables[ATTITUDE_ANGLE], k, j] = atan2(p, q)


@kernel
def read_common_motion(case: recarray, asked: int, tables: ndarray, out: ndarray, k: int, j: int) -> None:
    """What is asked for of the speeds of balls that all move alike, SI."""
    axial, radial = case.common_axial_rotation * case.speed, case.common_radial_rotation * case.speed
    sign = -1.0 if axial < 0.0 else 1.0
    put(asked, tables, ORBITAL_SPEED, out, k, j, case.common_orbit * case.speed)
    put(asked, tables, AXIAL_ROTATION, out, k, j, axial)
    put(asked, tables, RADIAL_ROTATION, out, k, j, radial)
    put(asked, tables, ROTATION_SPEED, out, k, j, sign * sqrt(axial * axial + radial * radial))
    if asked & 1 << ATTITUDE_ANGLE:
        out[tables[ATTITUDE_ANGLE], k, j] = atan2(sign * radial, sign * axial)


@kernel
def slips(case: recarray, work: recarray, ball: recarray) -> bool:
    """Whether some contact is asked for more friction than the case says that it carries."""
    asked_i, asked_o = friction_asked(case, work, ball)
    inner, outer = contact_loads(case, ball)
    small = STALLED * max(inner, outer)  # what the solver may leave
    bound = case.friction_coefficient
    return bool(asked_i > bound * inner + small or asked_o > bound * outer + small)


@entry(*GIVEN[:3], *FOUND, GIVEN[3], array_of(np.int64, 2), array_of(float, 3), int)
def read_cases(
    cases: ndarray,
    workspaces: ndarray,
    balls: ndarray,
    results: ndarray,
    positions: ndarray,
    controls: ndarray,
    own: ndarray,
    tables: ndarray,
    out: ndarray,
    begin: int,
) -> None:
    """Fill out (table, case, ball), SI, from case `begin` on, with what is asked for.

    NaN stands for cases not solved and for missing balls.

    tables: of each quantity, at the inner raceway, at the outer one and of the ball, the table that it goes to, or
    NOT_ASKED.
    """
    work = workspaces[0]
    inner, outer = (nan, nan, nan, nan, nan, nan, nan, nan), (nan, nan, nan, nan, nan, nan, nan, nan)
    at_inner, at_outer, of_ball = asked_of(tables[AT_INNER]), asked_of(tables[AT_OUTER]), asked_of(tables[OF_BALL])
    for k in range(cases.size):
        case = cases[k]
        if results[k].status != CONVERGED:
            out[:, begin + k] = nan
            continue
        set_azimuths(case, work, balls)
        set_full_scale(case, work, balls, own[k])
        units = case.length, case.force, case.force / (case.length * case.length)
        if case.ball_count < out.shape[2]:
            out[:, begin + k, case.ball_count :] = nan
        for j in range(case.ball_count):
            ball = balls[j]
            restore_ball(case, ball, results[k].displacement, positions[k, j], controls[k, j])
            fi, fo = 0.0, 0.0
            if (at_inner | at_outer) & 1 << REQUIRED_FRICTION and is_rolled(ball):
                fi, fo = friction_asked(case, work, ball)
            if at_inner & ELLIPSE:
                inner = ellipse_at(case, ball, INNER_SIDE, inner)
            if at_outer & ELLIPSE:
                outer = ellipse_at(case, ball, OUTER_SIDE, outer)
            if at_inner:
                read_contact(case, ball, INNER_SIDE, fi, inner, units, at_inner, tables[AT_INNER], out, begin + k, j)
            if at_outer:
                read_contact(case, ball, OUTER_SIDE, fo, outer, units, at_outer, tables[AT_OUTER], out, begin + k, j)
            if of_ball:
                read_motion(case, work, ball, of_ball, tables[OF_BALL], out, begin + k, j)


@kernel
def ellipse_at(
    case: recarray, ball: recarray, side: float, last: tuple[float, ...]
) -> tuple[float, float, float, float, float, float, float, float]:
    """(a, b and p0 over the approach's square root; what they rest on) of a contact.

    Q = K delta^1.5, so that a = (a/Q^(1/3)) K^(1/3) delta^0.5, b likewise, and p0 = 1.5 Q/(pi a b).

    An exact ellipse takes longer than all the rest; most often it is the same for all balls and cases, as the last.
    """
    a, b, pressure, form, cosine, f, pitch, diameter = last
    at = hertz_cosine(case, ball, side)
    coefficient = radius_coefficient(case, ball.diameter, side)
    is_same_ball = cosine == at and diameter == ball.diameter
    if form != case.form or not is_same_ball or f != coefficient or pitch != case.pitch_diameter:
        a, b, stiffness, _ = raceway_ellipse(case, ball.diameter, side, at)
        size = stiffness ** (1.0 / 3.0)
        a, b = a * size, b * size
        pressure = 1.5 * stiffness / (pi * a * b)
    return a, b, pressure, float(case.form), at, coefficient, case.pitch_diameter, ball.diameter


@kernel
def restore_ball(case: recarray, ball: recarray, displacement: ndarray, position: ndarray, control: int) -> None:
    """Put a ball of the bearing where a solution says that it is."""
    load_position(case, ball, position)
    ball.cosine, ball.sine = ball.azimuth_cosine, ball.azimuth_sine
    a1, a2 = inner_groove_centre(case, displacement, ball)
    close_loaded(case, ball, a1, a2)
    ball.control = control


@entry(*GIVEN[:3], *FOUND, GIVEN[3], array_of(float, 3))
def stiffness_of_cases(
    cases: ndarray,
    workspaces: ndarray,
    balls: ndarray,
    results: ndarray,
    positions: ndarray,
    controls: ndarray,
    own: ndarray,
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
        set_full_scale(case, work, balls, own[k])
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
            a1, a2 = inner_groove_centre(case, results[k].displacement, ball)
            evaluate_ball(case, work, ball, a1, a2)
            add_ball(work, ball)
        if case.elastic_rings:
            choose_modes(case, work, True, True)
            eliminate_deflections(case, work, balls)
        for p in range(5):
            for q in range(5):
                size = case.force
                if p < 3:
                    size /= case.length
                if q >= 3:
                    size *= case.length
                out[k, p, q] = work.matrix[p, q] * size
