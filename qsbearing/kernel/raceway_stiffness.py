"""The two contacts of a ball as the case has them: stiffness, ellipse and load of a raceway."""

from __future__ import annotations

from numpy import recarray

from qsbearing.compiled import kernel
from qsbearing.contact.hertz import (
    INNER_SIDE,
    OUTER_SIDE,
    ellipse_constants,
    rolling_curvature,
    stiffness_at_angle,
    transverse_curvature,
)
from qsbearing.effects.raceway_control import MINIMUM_DISSIPATION
from qsbearing.kernel.contact_line import contact_load


@kernel
def groove_stiffness(case: recarray, side: float, n1: float, n2: float) -> tuple[float, float]:
    """K of a raceway's contact and d ln K/d alpha: constants of the bearing, or at the contact's own angle."""
    if not case.actual_angle:
        return (case.inner_stiffness if side < 0 else case.outer_stiffness), 0.0
    coefficient = case.inner_coefficient if side < 0 else case.outer_coefficient
    return stiffness_at_angle(case.form, 1.0, case.pitch_diameter, coefficient, 1.0, n1, n2, side)


@kernel
def series_stiffness(case: recarray, n1: float, n2: float) -> tuple[float, float]:
    """K of both contacts in series, K^(-2/3) = Ki^(-2/3) + Ko^(-2/3), and d ln K/d alpha."""
    if not case.actual_angle:
        return case.series_stiffness, 0.0
    ki, ki_slope = groove_stiffness(case, INNER_SIDE, n1, n2)
    ko, ko_slope = groove_stiffness(case, OUTER_SIDE, n1, n2)
    inner, outer = ki ** (-2.0 / 3.0), ko ** (-2.0 / 3.0)
    compliance = inner + outer
    return compliance**-1.5, (inner * ki_slope + outer * ko_slope) / compliance


@kernel
def raceway_ellipse(case: recarray, side: float, cosine: float) -> tuple[float, float, float, float]:
    """(a/Q^(1/3), b/Q^(1/3), Q/approach^1.5, E) of a raceway's contact at an angle of this cosine."""
    coefficient = case.inner_coefficient if side < 0 else case.outer_coefficient
    rolling = rolling_curvature(1.0, case.pitch_diameter, cosine, side)
    return ellipse_constants(case.form, rolling, transverse_curvature(1.0, coefficient), 1.0)


@kernel
def spin_constant(case: recarray, side: float, cosine: float) -> float:
    """a E/Q^(1/3) of a raceway's contact, for Jones's criterion."""
    a, _, _, E = raceway_ellipse(case, side, cosine)
    return a * E


@kernel
def set_spin_constants(case: recarray, work: recarray) -> None:
    """Find what minimum dissipation weighs the raceways with, once for the case; nothing under any other control."""
    if case.control == MINIMUM_DISSIPATION:
        work.inner_spin = spin_constant(case, INNER_SIDE, case.hertz_cosine)
        work.outer_spin = spin_constant(case, OUTER_SIDE, case.hertz_cosine)


@kernel
def contact_loads(case: recarray, ball: recarray) -> tuple[float, float]:
    """(Qi, Qo) of a ball between its two contacts."""
    ki, _ = groove_stiffness(case, INNER_SIDE, ball.inner_sine, ball.inner_cosine)
    ko, _ = groove_stiffness(case, OUTER_SIDE, ball.outer_sine, ball.outer_cosine)
    return contact_load(ki, ball.inner_approach)[0], contact_load(ko, ball.outer_approach)[0]
