"""Inertia loads of a ball and the friction that carries its gyroscopic moment, as far as the case names them."""

from __future__ import annotations

from numpy import recarray

from qsbearing.model.compiler.compiled import inlined, kernel
from qsbearing.model.effects.centrifugal_force import centrifugal_force
from qsbearing.model.effects.gyroscopic_moment import gyroscopic_moment, moment_shares
from qsbearing.model.effects.orbit_radius import displaced_radius
from qsbearing.model.effects.raceway_control import (
    INNER,
    MINIMUM_DISSIPATION,
    OUTER,
    inner_weight,
    rotation_axis,
    weighted_axis,
)
from qsbearing.model.kernel.ball_size import ball_inertia, ball_mass
from qsbearing.model.kernel.kinematics import inner_line, orbital_speed, rolling_terms, rotation_per_axis_length
from qsbearing.model.kernel.loop_closure import inner_length, outer_length
from qsbearing.model.kernel.raceway_stiffness import contact_loads

# An approach, in ball diameters, that is none: the sum of the roundings of ring, grooves and both contact lines.
POSITION_ROUNDING = 4.0 * 2.0**-52
# Of S: u and v are clearly positive above this part. A choice: what stands has zero but for rounding.
LEAST_PART = 1e-3
# Where the outer ring stands, b u/S is the orbit over the inner ring's speed: a ball that is carried round has more. A
# choice: of friction below the loads none is lost.
LEAST_ORBIT = 0.02


@inlined
def is_moving(case: recarray) -> bool:
    """Whether a named effect has some speed to act at."""
    return (case.centrifugal or case.gyroscopic) and (case.inner_speed != 0.0 or case.outer_speed != 0.0)


@inlined
def motion_loads(
    case: recarray,
    work: recarray,
    axis: tuple[float, ...],
    diameter: float,
    radius: float,
    si: float,
    ci: float,
    so: float,
    co: float,
) -> tuple[float, float, float, float, float, float]:
    """(Fc, Mg/D) of the effects that the case names, each with its derivatives by ai and ao, as rolling sees them."""
    if case.common_motion:
        return common_loads(case, work, diameter, radius)
    g = 0.5 * diameter / radius
    inner_speed, outer_speed = work.speed_factor * case.inner_speed, work.speed_factor * case.outer_speed
    terms = rolling_terms(g, si, ci, so, co, axis)
    orbit = orbital_speed(terms, inner_speed, outer_speed)
    fc, fc_i, fc_o = 0.0, 0.0, 0.0
    if case.centrifugal:
        fc, fc_i, fc_o = centrifugal_force(ball_mass(diameter), 2.0 * radius, orbit)
    mg, mg_i, mg_o = 0.0, 0.0, 0.0
    if case.gyroscopic:
        rotation = rotation_per_axis_length(terms, g, inner_speed, outer_speed)
        mg, mg_i, mg_o = gyroscopic_moment(ball_inertia(diameter) / diameter, orbit, rotation, axis)
    return fc, fc_i, fc_o, mg, mg_i, mg_o


@inlined
def common_loads(
    case: recarray, work: recarray, diameter: float, radius: float
) -> tuple[float, float, float, float, float, float]:
    """The same where all balls move alike, whatever their contact lines."""
    orbit, fc, mg = work.speed_factor * case.common_orbit, 0.0, 0.0
    if case.centrifugal:
        fc = ball_mass(diameter) * radius * orbit * orbit
    if case.gyroscopic:
        mg = ball_inertia(diameter) / diameter * orbit * work.speed_factor * case.common_radial_rotation
    return fc, 0.0, 0.0, mg, 0.0, 0.0


@kernel
def inertia(
    case: recarray, work: recarray, control: int, si: float, ci: float, so: float, co: float
) -> tuple[float, float, float, float, float, float]:
    """The same of a ball of the bearing's diameter on the pitch circle, before loads are known: minimum dissipation
    counts as outer control."""
    axis = rotation_axis(control, 1.0 / case.pitch_diameter, si, ci, so, co)
    return motion_loads(case, work, axis, 1.0, 0.5 * case.pitch_diameter, si, ci, so, co)


@inlined
def rolling_line(case: recarray, ball: recarray) -> tuple[float, float, float, float, float]:
    """The ball's inner contact line as rolling sees it, with its derivatives."""
    length = inner_length(case, ball)
    si, ci, so, co = ball.inner_sine, ball.inner_cosine, ball.outer_sine, ball.outer_cosine
    return inner_line(si, ci, so, co, ball.inner_approach, length)


@inlined
def orbit_radius(case: recarray, ball: recarray) -> float:
    """The radius at which the ball's centre goes round: the pitch circle's, or its own."""
    if not case.displaced_orbit:
        return 0.5 * case.pitch_diameter
    # The circle on which this ball would touch at the free angle: the outer groove stays where it is.
    touching = case.pitch_diameter - (ball.diameter - 1.0) * case.cos_free
    return displaced_radius(touching, outer_length(case, ball), case.cos_free, ball.outer_cosine, ball.outer_approach)


@inlined
def control_of(case: recarray, ball: recarray) -> int:
    """The control that the ball's motion follows: a raceway that does not press a ball has no friction to control it.

    Without a gyroscopic moment no friction acts, and the orbit goes over within the gap of LOSING.
    """
    is_lost = ball.control == INNER and ball.inner_approach <= 0.0 and case.gyroscopic
    return OUTER if is_lost else ball.control


@inlined
def control_weight(ball: recarray, radius: float, ci: float, co: float, inner_load: float, outer_load: float) -> float:
    """The inner raceway's weight in the ball's axis under minimum dissipation; 0 under any other control."""
    if ball.control != MINIMUM_DISSIPATION:
        return 0.0
    return inner_weight(0.5 * ball.diameter / radius, ci, co, inner_load, outer_load, ball.inner_spin, ball.outer_spin)


@inlined
def ball_axis(
    case: recarray, ball: recarray, weight: float, radius: float, si: float, ci: float, so: float, co: float
) -> tuple[float, ...]:
    """The ball's axis and its derivatives by ai and ao, weight and radius fixed."""
    g = 0.5 * ball.diameter / radius
    if ball.control == MINIMUM_DISSIPATION:
        return weighted_axis(weight, g, si, ci, so, co)
    return rotation_axis(control_of(case, ball), g, si, ci, so, co)


@kernel
def axis_where_it_is(
    case: recarray, work: recarray, ball: recarray
) -> tuple[float, float, float, float, tuple[float, ...]]:
    """(radius of the orbit, weight of the inner raceway, sine and cosine of the inner line as seen, axis) of a ball."""
    s, c, _, _, _ = rolling_line(case, ball)
    so, co = ball.outer_sine, ball.outer_cosine
    radius, weight = orbit_radius(case, ball), 0.0
    if ball.control == MINIMUM_DISSIPATION:
        qi, qo = contact_loads(case, ball)
        weight = control_weight(ball, radius, c, co, qi, qo)
    return radius, weight, s, c, ball_axis(case, ball, weight, radius, s, c, so, co)


@kernel
def is_carried_round(case: recarray, work: recarray, ball: recarray) -> bool:
    """Whether rolling carries a ball round: at a speed between those of both rings, as it does where u and v are
    positive.

    Under outer control they are. Under inner control u = cos(ai - ao) - g cos ao vanishes where the contact lines are
    nearly a right angle apart: a ball without orbit has no inertia either, and any such place is an equilibrium. So it
    is, under any control, of a ball that the inner raceway does not press between rings that turn against each other,
    at the angle of the outer groove where its orbit vanishes; at the groove's bottom it would be carried round. Where
    all balls move alike, none stands.
    """
    if case.common_motion:
        return True
    may_hover = case.centrifugal and case.inner_speed * case.outer_speed < 0.0
    may_hover = may_hover and ball.inner_approach <= POSITION_ROUNDING
    is_outer = control_of(case, ball) == OUTER
    if is_outer and not may_hover:
        return True
    radius, _, s, c, axis = axis_where_it_is(case, work, ball)
    g = 0.5 * ball.diameter / radius
    terms = rolling_terms(g, s, c, ball.outer_sine, ball.outer_cosine, axis)
    if may_hover:
        orbit, _, _ = orbital_speed(terms, case.inner_speed, case.outer_speed)
        at_bottom = 0.5 * ((1.0 - g) * case.inner_speed + (1.0 + g) * case.outer_speed)
        if abs(orbit) < LEAST_PART * abs(at_bottom):
            return False
    if is_outer:
        return True
    by_outer, by_inner, total = terms[0], terms[3], terms[0] + terms[3]
    least = LEAST_ORBIT if case.outer_speed == 0.0 else LEAST_PART
    return bool(by_inner > least * total and by_outer > LEAST_PART * total)


@kernel
def friction_asked(case: recarray, work: recarray, ball: recarray) -> tuple[float, float]:
    """|lambda Mg|/D at the inner and at the outer contact, whatever they can carry."""
    radius, weight, s, c, axis = axis_where_it_is(case, work, ball)
    _, _, _, mg, _, _ = motion_loads(case, work, axis, ball.diameter, radius, s, c, ball.outer_sine, ball.outer_cosine)
    share_i, share_o = friction_shares(case, control_of(case, ball), weight)
    return abs(share_i * mg), abs(share_o * mg)


@kernel
def inertia_of(case: recarray, work: recarray, ball: recarray) -> tuple[float, float]:
    """(Fc, Mg) of a ball where it is."""
    radius, _, s, c, axis = axis_where_it_is(case, work, ball)
    fc, _, _, mg, _, _ = motion_loads(case, work, axis, ball.diameter, radius, s, c, ball.outer_sine, ball.outer_cosine)
    return fc, mg * ball.diameter


@inlined
def is_rolled(ball: recarray) -> bool:
    """Whether some raceway rolls the ball: it must be pressed by more than the rounding of its position."""
    return bool(max(ball.inner_approach, ball.outer_approach) > POSITION_ROUNDING)


@inlined
def friction_shares(case: recarray, control: int, weight: float) -> tuple[float, float]:
    """(lambda_i, lambda_o) of a ball; none where no gyroscopic moment is asked for."""
    if not case.gyroscopic:
        return 0.0, 0.0
    if control == MINIMUM_DISSIPATION:
        whole, _ = moment_shares(case.shares, True)
        return whole * weight, 2.0 - whole * weight
    return moment_shares(case.shares, control == INNER)
