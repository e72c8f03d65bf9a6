"""Raceway control: which raceway a ball rolls on without spinning, and so how its axis lies.

A hypothesis (Jones 1960; Harris & Kotzalas). It closes the kinematics in place of a friction calculation: good
where gyroscopic moments are carried by dry or thin-film friction at moderate speed, doubtful at light load and very
high speed, where balls slip on both raceways.
"""

from __future__ import annotations

from enum import StrEnum

from qsbearing.compiled import kernel


class RacewayControl(StrEnum):
    """The raceway without spin."""

    OUTER = "outer"
    """Every ball rolls purely on the outer raceway: tan(beta) = sin(ao)/(cos(ao) + g)."""
    INNER = "inner"
    """Every ball rolls purely on the inner raceway: tan(beta) = sin(ai)/(cos(ai) - g)."""
    PER_BALL = "per_ball"
    """Jones's criterion, ball by ball: outer where Qo ao Eo cos(ai - ao) > Qi ai Ei."""


CONTROL_CODES = {control: code for code, control in enumerate(RacewayControl)}
OUTER, INNER, PER_BALL = 0, 1, 2


@kernel
def rotation_axis(control: int, g: float, si: float, ci: float, so: float, co: float) -> tuple[float, ...]:
    """A vector (p, q) along the ball's axis, tan(beta) = p/q, and its derivatives: (p, q, p_i, q_i, p_o, q_o)."""
    if control == OUTER:
        return so, co + g, 0.0, 0.0, co, -so
    return si, ci - g, ci, -si, 0.0, 0.0


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
