"""Raceway control: which raceway a ball rolls on without spinning, and so how its axis lies.

A hypothesis (Jones 1960; Harris & Kotzalas). It closes the kinematics in place of a friction calculation: good
where gyroscopic moments are carried by dry or thin-film friction at moderate speed, doubtful at light load and very
high speed, where balls slip on both raceways.
"""

from __future__ import annotations

from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from qsbearing.compiled import kernel
from qsbearing.effects.entry import Entry, Errors, choice
from qsbearing.effects.operating_point import OperatingPoint


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

CLEARLY_OUTER = 1.2
"""Above this ratio of the two sides of Jones's criterion, spin constants taken as equal, the outer raceway controls
(measured: 98 % of random scenes)."""


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


def _indicator(point: OperatingPoint) -> NDArray:
    """y = 2 |Mg|/(D Q) of balls whose contacts Jones's criterion may call inner-controlled: the friction that one
    raceway carries or the other. Zero without the gyroscopic moment, whose friction it is."""
    inner, outer = point.solution.inner, point.solution.outer
    if inner.required_friction is None or outer.required_friction is None:
        return np.zeros(point.solution.shape)
    with np.errstate(divide="ignore", invalid="ignore"):
        favours = (outer.load / inner.load) ** (4.0 / 3.0) * np.cos(inner.angle - outer.angle)
    friction = np.maximum(inner.required_friction, outer.required_friction)
    return np.where(point.is_heavy & (favours < CLEARLY_OUTER), friction, 0.0).max(axis=-1)


def _errors(point: OperatingPoint) -> Errors:
    """Fitted to random scenes: medians of errors over the indicator."""
    x = _indicator(point)
    angle = np.maximum(np.abs(point.angle), np.radians(1.0))
    return {
        "contact_angle": x / angle,
        "load": x / 4.0,
        "pressure": x / 8.0,
        "displacement": x / 5.0,
        "stiffness": x / 2.0,
    }


ENTRY = Entry(
    "raceway_control",
    "raceway control by each ball (the outer raceway for all instead)",
    choice("raceway_control", RacewayControl.OUTER, RacewayControl.PER_BALL, kept=(RacewayControl.INNER,)),
    indicator=_indicator,
    errors=_errors,
    hypothesis="which raceway a ball follows rests on a hypothesis; the model has nothing to decide it by",
    saves_time=False,
)
