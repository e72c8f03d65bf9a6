"""Inertia loads of a ball and the friction that carries its gyroscopic moment, as far as the case names them."""

from __future__ import annotations

from numpy import recarray

from qsbearing.compiled import kernel
from qsbearing.effects.centrifugal_force import centrifugal_force
from qsbearing.effects.gyroscopic_moment import gyroscopic_moment, moment_shares
from qsbearing.effects.raceway_control import INNER, rotation_axis
from qsbearing.kernel.case import BALL_INERTIA, BALL_MASS
from qsbearing.kernel.kinematics import inner_line, orbital_speed, rolling_terms, rotation_per_axis_length

# No bound on the friction that a contact carries: the equations as they stand.
NO_BOUND = 0.0
# An approach, in ball diameters, that is none: the sum of the roundings of ring, grooves and both contact lines.
POSITION_ROUNDING = 4.0 * 2.0**-52


@kernel
def is_moving(case: recarray) -> bool:
    """Whether a named effect has some speed to act at."""
    return (case.centrifugal or case.gyroscopic) and (case.inner_speed != 0.0 or case.outer_speed != 0.0)


@kernel
def inertia(
    case: recarray, work: recarray, control: int, si: float, ci: float, so: float, co: float
) -> tuple[float, float, float, float, float, float]:
    """(Fc, Mg) of the effects that the case names, each with its derivatives by ai and ao, as rolling sees them."""
    g = 1.0 / case.pitch_diameter
    inner_speed, outer_speed = work.speed_factor * case.inner_speed, work.speed_factor * case.outer_speed
    axis = rotation_axis(control, g, si, ci, so, co)
    terms = rolling_terms(g, si, ci, so, co, axis)
    orbit = orbital_speed(terms, inner_speed, outer_speed)
    fc, fc_i, fc_o = 0.0, 0.0, 0.0
    if case.centrifugal:
        fc, fc_i, fc_o = centrifugal_force(BALL_MASS, case.pitch_diameter, orbit)
    mg, mg_i, mg_o = 0.0, 0.0, 0.0
    if case.gyroscopic:
        rotation = rotation_per_axis_length(terms, g, inner_speed, outer_speed)
        mg, mg_i, mg_o = gyroscopic_moment(BALL_INERTIA, orbit, rotation, axis)
    return fc, fc_i, fc_o, mg, mg_i, mg_o


@kernel
def rolling_line(case: recarray, ball: recarray) -> tuple[float, float, float, float, float]:
    """The ball's inner contact line as rolling sees it, with its derivatives."""
    length = case.inner_coefficient - 0.5
    si, ci, so, co = ball.inner_sine, ball.inner_cosine, ball.outer_sine, ball.outer_cosine
    return inner_line(si, ci, so, co, ball.inner_approach, length)


@kernel
def inertia_of(case: recarray, work: recarray, ball: recarray) -> tuple[float, float]:
    """(Fc, Mg) of a ball where it is."""
    s, c, _, _, _ = rolling_line(case, ball)
    fc, _, _, mg, _, _ = inertia(case, work, ball.control, s, c, ball.outer_sine, ball.outer_cosine)
    return fc, mg


@kernel
def is_rolled(ball: recarray) -> bool:
    """Whether some raceway rolls the ball: it must be pressed by more than the rounding of its position."""
    return bool(max(ball.inner_approach, ball.outer_approach) > POSITION_ROUNDING)


@kernel
def friction_shares(case: recarray, control: int) -> tuple[float, float]:
    """(lambda_i, lambda_o) of a ball; none where no gyroscopic moment is asked for."""
    if not case.gyroscopic:
        return 0.0, 0.0
    return moment_shares(case.shares, control == INNER)


@kernel
def carried_friction(share: float, mg: float, load: float, friction_bound: float) -> tuple[float, float, float]:
    """T, the friction at a contact that carries its share of the gyroscopic moment, and dT/dMg, dT/dQ."""
    friction = share * mg
    if friction_bound == NO_BOUND or abs(friction) <= friction_bound * load:
        return friction, share, 0.0
    slope = friction_bound if friction > 0.0 else -friction_bound
    return slope * load, 0.0, slope
