"""Raceway control: which raceway a ball rolls on without spinning, and so how its axis lies; or friction itself.

A hypothesis (Jones 1960; Harris & Kotzalas). It closes the kinematics in place of a friction calculation: good
where gyroscopic moments are carried by dry or thin-film friction at moderate speed, doubtful at light load and very
high speed, where balls slip on both raceways.

Outer, inner and per-ball control let one contact spin with all the friction that it has, and the other not at all.
Minimum dissipation lies between, for balls that spin on both: friction moments c ws, whose weights c are Coulomb's.
Friction is none of them: axis and orbit follow from the friction in both contacts (`effects/traction.py`).

Source        derived here, below; weights Q a E from the friction moment of a spinning ellipse (Jones 1959; Harris &
              Kotzalas), M = 3/8 mu Q a E. Ding, Zhang, Zhu & Chai (Chinese J. Mech. Eng. 37(2), 2001) balance both
              raceways' moments with the same weights; their text was not at hand, and theirs may differ
Equation      of all axes (p, q), tan(beta) = p/q, that of least ci wsi^2 + co wso^2, with c = Q a E. No slip at the
              centres leaves, with k = (omega_o - omega_i)/g, the spin speeds (ball less ring, along the normals)
                  wsi = k A Li/S,  Li = (cos ai - g) p - q sin ai,      A = 1 + g cos ao,
                  wso = k B Lo/S,  Lo = (cos ao + g) p - q sin ao,      B = 1 - g cos ai,
              and S (`kernel/kinematics.py`) is in proportion to A Li - B Lo, as its values at Li = 0 and at Lo = 0
              show. So wsi - wso is given, and the sum is least where ci wsi + co wso = 0: the raceways' moments are in
              balance. That is linear in (p, q):
                  (p, q) = w (sin ai, cos ai - g) + (1 - w) (sin ao, cos ao + g),    w = ci A/(ci A + co B)
Limits        w = 1 is inner control, w = 0 outer control; equal angles and weights: tan(beta) = tan(a)/(1 - g^2).
              A ball that has lost the inner raceway has w = 0
Assumes       no law of friction gives it: Coulomb's weights with moments that grow with the spin, where friction in
              proportion to slip has the weights Q (a^2 + b^2) and divides the gyroscopic moment as Qi to Qo. E and
              a/Q^(1/3) at the angle of the scene's constant Hertz stiffness (the free one under hertz_angle =
              "actual"), Q as it is
Shares        of the gyroscopic moment go with the weights: full w on the inner raceway, 2 - full w on the outer one;
              full is what inner control puts there, 2 ("controlling") or 1 ("harris")
When not      balls that slip grossly, dry contacts
Indicator     y = 2 |Mg|/(D Q): the friction that the other raceway may carry instead
"""

from __future__ import annotations

from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler.compiled import inlined, kernel
from qsbearing.model.effects.angle_difference import by_friction
from qsbearing.model.effects.entry import Entry, Members, choice, largest
from qsbearing.model.effects.hypotheses import other_controls
from qsbearing.model.effects.operating_point import OperatingPoint


class RacewayControl(StrEnum):
    """How the rotation axis of each ball is determined: by a raceway without spin, or by the least friction power."""

    OUTER = "outer"
    """Every ball rolls purely on the outer raceway: tan(beta) = sin(ao)/(cos(ao) + g)."""
    INNER = "inner"
    """Every ball rolls purely on the inner raceway: tan(beta) = sin(ai)/(cos(ai) - g)."""
    PER_BALL = "per_ball"
    """Jones's criterion, ball by ball: outer where Qo ao Eo cos(ai - ao) > Qi ai Ei."""
    MINIMUM_DISSIPATION = "minimum_dissipation"
    """Every ball spins on both raceways, with the least sum of Q a E ws^2: Coulomb's weights on squared spin speeds."""
    FRICTION = "friction"
    """No hypothesis: friction in both contacts, loads and inertia of every ball are in balance."""


HYPOTHESES = tuple(control for control in RacewayControl if control is not RacewayControl.FRICTION)
CONTROL_CODES = {control: code for code, control in enumerate(HYPOTHESES)} | {RacewayControl.FRICTION: 0}
"""Of the kernel's records. The balance of friction starts from a solution under outer control."""
OUTER, INNER, PER_BALL, MINIMUM_DISSIPATION = 0, 1, 2, 3


@inlined
def rotation_axis(control: int, g: float, si: float, ci: float, so: float, co: float) -> tuple[float, ...]:
    """A vector (p, q) along the ball's axis, tan(beta) = p/q, and its derivatives: (p, q, p_i, q_i, p_o, q_o)."""
    if control == INNER:
        return si, ci - g, ci, -si, 0.0, 0.0
    return so, co + g, 0.0, 0.0, co, -so


@kernel
def weighted_axis(weight: float, g: float, si: float, ci: float, so: float, co: float) -> tuple[float, ...]:
    """The same between both: the axis of inner control times the weight, that of outer control times the rest."""
    rest = 1.0 - weight
    return (
        weight * si + rest * so,
        weight * (ci - g) + rest * (co + g),
        weight * ci,
        -weight * si,
        rest * co,
        -rest * so,
    )


@kernel
def inner_weight(
    g: float, ci: float, co: float, inner_load: float, outer_load: float, inner_constant: float, outer_constant: float
) -> float:
    """w of minimum dissipation; a constant is a E/Q^(1/3)."""
    if inner_load <= 0.0:
        return 0.0
    inner = inner_load ** (4.0 / 3.0) * inner_constant * (1.0 + g * co)
    return inner / (inner + max(outer_load, 0.0) ** (4.0 / 3.0) * outer_constant * (1.0 - g * ci))


@kernel
def weight_slopes(
    weight: float,
    g: float,
    si: float,
    ci: float,
    so: float,
    co: float,
    inner_load: float,
    inner_slope: float,
    outer_load: float,
    outer_slope: float,
) -> tuple[float, float, float, float, float]:
    """dw by ai and ao (through a and b), by both approaches (slopes: of the loads), and by g."""
    product = weight * (1.0 - weight)
    if product <= 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    a, b = 1.0 + g * co, 1.0 - g * ci
    return (
        -product * g * si / b,
        -product * g * so / a,
        product * 4.0 / 3.0 * inner_slope / inner_load,
        -product * 4.0 / 3.0 * outer_slope / outer_load,
        product * (co / a + ci / b),
    )


@kernel
def outer_controls(
    inner_load: float, outer_load: float, inner_spin_constant: float, outer_spin_constant: float, cos_difference: float
) -> bool:
    """Jones's criterion; a spin constant is a E/Q^(1/3), with a the semi-major axis and E its elliptic integral.

    The outer raceway controls a ball that has left the inner one, from whatever side that is then seen.
    """
    if inner_load <= 0.0:
        return True
    inner = inner_load ** (4.0 / 3.0) * inner_spin_constant
    return outer_load ** (4.0 / 3.0) * outer_spin_constant * cos_difference > inner


def _friction(point: OperatingPoint) -> NDArray:
    """y of each ball (*cases, ball), which one raceway carries or the other; zero without the moment, whose friction it
    is."""
    of_sides = [side.required_friction for side in (point.solution.inner, point.solution.outer)]
    needed = [np.nan_to_num(each) for each in of_sides if each is not None]
    return np.where(point.is_heavy, np.max(needed, axis=0), 0.0) if needed else np.zeros_like(point.load)


_SWITCH = choice(
    "raceway_control",
    RacewayControl.OUTER,
    RacewayControl.PER_BALL,
    kept=(RacewayControl.INNER, RacewayControl.MINIMUM_DISSIPATION, RacewayControl.FRICTION),
)

ENTRY = Entry(
    "raceway_control",
    "the hypothesis of raceway control and moment shares (any other instead)",
    _SWITCH._replace(members=Members(other_controls)),
    indicator=largest(_friction),
    errors=by_friction(_friction),
    hypothesis="which raceway controls a ball is a hypothesis, which the model cannot test",
    saves_time=False,
)
