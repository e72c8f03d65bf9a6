"""The two contacts of a ball as the case has them: stiffness, ellipse and load of a raceway."""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import inlined, kernel
from qsbearing.model.contact.hertz import (
    INNER_SIDE,
    OUTER_SIDE,
    ellipse_constants,
    rolling_curvature,
    stiffness_at_angle,
    transverse_curvature,
)
from qsbearing.model.effects.raceway_control import MINIMUM_DISSIPATION
from qsbearing.model.kernel.contact_line import contact_load


@inlined
def groove_stiffness(case: recarray, ball: recarray, side: float, n1: float, n2: float) -> tuple[float, float]:
    """K of a raceway's contact and d ln K/d alpha: constants of bearing or ball, or at the contact's own angle."""
    if case.actual_angle:
        coefficient = radius_coefficient(case, ball.diameter, side)
        return stiffness_at_angle(case.form, ball.diameter, case.pitch_diameter, coefficient, 1.0, n1, n2, side)
    if case.unequal_balls:
        return (ball.inner_stiffness if side < 0 else ball.outer_stiffness), 0.0
    return (case.inner_stiffness if side < 0 else case.outer_stiffness), 0.0


@kernel
def radius_coefficient(case: recarray, diameter: float, side: float) -> float:
    """f = r/D of a raceway's groove and a ball of this diameter."""
    return (case.inner_coefficient if side < 0 else case.outer_coefficient) / diameter


@kernel
def series_stiffness(case: recarray, ball: recarray, n1: float, n2: float) -> tuple[float, float]:
    """K of both contacts in series, K^(-2/3) = Ki^(-2/3) + Ko^(-2/3), and d ln K/d alpha."""
    if not (case.actual_angle or case.unequal_balls):
        return case.series_stiffness, 0.0
    ki, ki_slope = groove_stiffness(case, ball, INNER_SIDE, n1, n2)
    ko, ko_slope = groove_stiffness(case, ball, OUTER_SIDE, n1, n2)
    inner, outer = ki ** (-2.0 / 3.0), ko ** (-2.0 / 3.0)
    compliance = inner + outer
    return compliance**-1.5, (inner * ki_slope + outer * ko_slope) / compliance


@kernel
def raceway_ellipse(case: recarray, diameter: float, side: float, cosine: float) -> tuple[float, float, float, float]:
    """(a/Q^(1/3), b/Q^(1/3), Q/approach^1.5, E) of a raceway's contact with a ball, at an angle of this cosine."""
    coefficient = radius_coefficient(case, diameter, side)
    rolling = rolling_curvature(diameter, case.pitch_diameter, cosine, side)
    return ellipse_constants(case.form, rolling, transverse_curvature(diameter, coefficient), 1.0)


@kernel
def hertz_cosine(case: recarray, ball: recarray, side: float) -> float:
    """Cosine of the angle at which a contact's ellipse is taken."""
    if not case.actual_angle:
        return case.hertz_cosine
    return ball.inner_cosine if side < 0 else ball.outer_cosine


@kernel
def spin_constant(case: recarray, diameter: float, side: float, cosine: float) -> float:
    """a E/Q^(1/3) of a raceway's contact with a ball, for Jones's criterion."""
    a, _, _, E = raceway_ellipse(case, diameter, side, cosine)
    return a * E


@kernel
def set_spin_constants(case: recarray, count: int, balls: ndarray) -> None:
    """Find what minimum dissipation weighs the raceways with, once for equal balls; nothing under any other control."""
    if case.control != MINIMUM_DISSIPATION:
        return
    for n in range(count):
        ball = balls[n]
        if n > 0 and not case.unequal_balls:
            ball.inner_spin, ball.outer_spin = balls[0].inner_spin, balls[0].outer_spin
        else:
            ball.inner_spin = spin_constant(case, ball.diameter, INNER_SIDE, case.hertz_cosine)
            ball.outer_spin = spin_constant(case, ball.diameter, OUTER_SIDE, case.hertz_cosine)


@kernel
def contact_loads(case: recarray, ball: recarray) -> tuple[float, float]:
    """(Qi, Qo) of a ball between its two contacts."""
    ki, _ = groove_stiffness(case, ball, INNER_SIDE, ball.inner_sine, ball.inner_cosine)
    ko, _ = groove_stiffness(case, ball, OUTER_SIDE, ball.outer_sine, ball.outer_cosine)
    inner, _ = contact_load(ki, ball.inner_approach)
    outer, _ = contact_load(ko, ball.outer_approach)
    return inner, outer
