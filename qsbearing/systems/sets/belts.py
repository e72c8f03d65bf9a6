"""Belts on the shaft: what their strands pull, from the torque that they transmit.

A pulley of radius r has the tensions F1 in its tight and F2 in its slack strand, F1 - F2 = |T| / r. Of the two

    F1 + F2 = 2 F0                                      from the pretension F0 of each strand at rest, or
    F1 + F2 = (F1 - F2) (m + 1) / (m - 1)               from the ratio m = F1 / F2.

Strands that wrap the pulley by the angle phi lie at g = (pi - phi) / 2 to the line between the axes; the shaft gets

    (F1 + F2) cos(g)     towards the other pulley,
    -(T / r) sin(g)      across, in the direction of growing azimuth (the tight strand's side, as T says).

The tension that turns the belt's own mass round does not press the shaft: at speed F1 and F2 are without it.

Source: Budynas & Nisbett, Shigley's Mechanical Engineering Design, chapter 17, flat and round belt drives: the initial
tension is the mean of F1 and F2. Strands at an angle: geometry.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.described import given_in, one_of
from qsbearing.model.units import mm
from qsbearing.model.validation import ANGLE, FORCE, LENGTH, RATIO, ErrorDetail, Field, Sentence, first, within
from qsbearing.systems.sets.gears import WIDEST, carried_to_axis
from qsbearing.systems.sets.torque import torque_errors, torque_on_shaft


@dataclass(frozen=True)
class Belt:
    """A belt or chain around a pulley on the shaft. SI units; numbers but the position may be arrays that span cases.

    Of a chain the slack strand pulls next to nothing: a large `tension_ratio`.
    """

    position: float = field(metadata=given_in("mm"))
    """Of the middle of the pulley along the shaft [m]."""
    azimuth: ArrayLike = field(metadata=given_in("deg"))
    """Of the other pulley, from y towards z [rad]."""
    pitch_diameter: ArrayLike = field(metadata=given_in("mm"))
    """Of the pulley, where the belt pulls [m]."""
    torque: ArrayLike | None = field(default=None, metadata=given_in("N m"))
    """As of a gear [N m]."""
    power: ArrayLike | None = field(default=None, metadata=given_in("kW"))
    """In its place [W]."""
    pretension: ArrayLike | None = field(default=None, metadata=given_in("N"))
    """Of each strand, while nothing is transmitted [N]; or"""
    tension_ratio: ArrayLike | None = field(default=None, metadata=given_in(words="tight strand over slack strand"))
    """the tension of the tight strand over that of the slack one [-]."""
    wrap_angle: ArrayLike | None = field(default=None, metadata=given_in("deg"))
    """Over which the belt touches this pulley [rad]: below 180 degrees on the smaller one. None: strands are assumed to
    be parallel."""
    drives: bool | None = field(default=None, metadata=one_of(bool))
    """Whether this pulley drives the other one. To be given."""

    @property
    def assumed(self) -> dict[str, float]:
        """As of a gear."""
        return {"wrap_angle": np.pi} if self.wrap_angle is None else {}

    def forces(self, speed: ArrayLike) -> BeltForces:
        """Of its strands, under its torque.

        Args:
            speed: of the shaft [rad/s].
        """
        torque = torque_on_shaft(self, speed)
        difference = np.abs(torque) / (0.5 * np.asarray(self.pitch_diameter, float))
        if self.pretension is not None:
            total = 2.0 * np.asarray(self.pretension, float)
        else:
            ratio = np.asarray(self.tension_ratio, float)
            total = difference * (ratio + 1.0) / (ratio - 1.0)
        return BeltForces(torque, 0.5 * (total + difference), 0.5 * (total - difference))

    def load(self, speed: ArrayLike) -> tuple[NDArray, ...]:
        """On the shaft at its position, in the order of the channels: forces [N] and moments [N m]."""
        torque, tight, slack = self.forces(speed)
        wrap = np.pi if self.wrap_angle is None else self.wrap_angle
        lean = 0.5 * (np.pi - np.asarray(wrap, float))
        across = -np.sign(torque) * (tight - slack) * np.sin(lean)
        return carried_to_axis(across, (tight + slack) * np.cos(lean), 0.0, self.azimuth, 0.0)


class BeltForces(NamedTuple):
    """Of a belt's strands; arrays over the cases."""

    torque: NDArray
    """On the shaft, about +x [N m]."""
    tight: NDArray
    """Tension of the strand that transmits the torque [N]."""
    slack: NDArray
    """Of the other one [N]."""


def belt_errors(path: str, of: Belt) -> Iterator[ErrorDetail]:
    """Of one belt alone; of what depends on the speed: `slack_errors`."""
    yield from within(f"{path}.azimuth", of.azimuth, ANGLE, -4.0 * np.pi, 4.0 * np.pi)
    yield from within(f"{path}.pitch_diameter", of.pitch_diameter, LENGTH, 1.0 * mm, WIDEST)
    if of.wrap_angle is not None:
        yield from within(f"{path}.wrap_angle", of.wrap_angle, ANGLE, 0.25 * np.pi, 1.75 * np.pi)
    yield from torque_errors(path, of)
    names = {"pretension": Field("pretension"), "tension_ratio": Field("tension_ratio")}
    if (of.pretension is None) == (of.tension_ratio is None):
        both = of.pretension is not None
        problem = "is given together with the ratio of tensions" if both else "missing"
        cause = Sentence("Give {pretension} of each strand, or {tension_ratio} of tight over slack", **names)
        yield ErrorDetail(f"{path}.pretension", problem, cause=cause)
    if of.pretension is not None:
        yield from within(f"{path}.pretension", of.pretension, FORCE, 0.0, 1e8)
    if of.tension_ratio is not None:
        yield from within(f"{path}.tension_ratio", of.tension_ratio, RATIO, 1.01, 1e6)


def slack_errors(path: str, of: Belt, speed: ArrayLike) -> list[ErrorDetail]:
    """Of a slack strand that would have to push."""
    _, tight, slack = of.forces(speed)
    pushes = np.asarray(slack < 0.0)
    if not pushes.any():
        return []
    (needed,) = first(pushes, 0.5 * (tight - slack))
    (given,) = first(pushes, np.asarray(of.pretension, float))
    cause = f"More than {needed:.4g} N is needed for this torque, of a belt that shall not slip well more"
    return [ErrorDetail(f"{path}.pretension", "leaves the slack strand without tension", given, FORCE, cause=cause)]
