"""The torque that a gear or a belt puts on its shaft: given, or as a power at the shaft's speed.

Torques are about +x. What is driven by its mate turns the shaft on, with its speed; what drives it holds the shaft
back. At rest the shaft is taken to turn in the positive direction. A torque or power below zero acts the other way
round, as where a motor brakes.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.validation import MOMENT, POWER, ErrorDetail, Field, Sentence, within

MOST_TORQUE, MOST_POWER = 1e8, 1e9
"""They catch mistakes of unit [N m, W]."""


class Drive(Protocol):
    """What transmits torque between this shaft and another."""

    @property
    def drives(self) -> bool | None:
        """Whether it drives its mate."""

    @property
    def torque(self) -> ArrayLike | None:
        """[N m]"""

    @property
    def power(self) -> ArrayLike | None:
        """[W]"""


def torque_on_shaft(of: Drive, speed: ArrayLike) -> NDArray:
    """About +x [N m]; shape of the cases.

    Args:
        speed: of the shaft [rad/s]; not 0 where the power is given.
    """
    turning = np.asarray(speed, float)
    way = np.where(turning < 0.0, -1.0, 1.0) * (-1.0 if of.drives else 1.0)
    size = of.torque if of.torque is not None else np.asarray(of.power, float) / np.abs(turning)
    return np.asarray(way * np.asarray(size, float))


def torque_errors(path: str, of: Drive) -> Iterator[ErrorDetail]:
    """Of what one states of its torque, whatever the speed."""
    if not isinstance(of.drives, bool):
        problem = "missing" if of.drives is None else "is neither true nor false"
        cause = "True where it drives its mate, as a pinion on a motor shaft does; false where its mate drives it"
        yield ErrorDetail(f"{path}.drives", problem, of.drives, cause=cause)
    names = {"torque": Field("torque"), "power": Field("power")}
    if of.torque is None and of.power is None:
        cause = Sentence("Give {torque}, or {power} at the speed of the shaft", **names)
        yield ErrorDetail(f"{path}.torque", "missing", cause=cause)
    elif of.torque is not None and of.power is not None:
        cause = Sentence("Give one of {torque} and {power}: the other follows from the speed", **names)
        yield ErrorDetail(f"{path}.torque", "is given together with the power", cause=cause)
    if of.torque is not None:
        yield from within(f"{path}.torque", of.torque, MOMENT, -MOST_TORQUE, MOST_TORQUE)
    if of.power is not None:
        yield from within(f"{path}.power", of.power, POWER, -MOST_POWER, MOST_POWER)


def speed_errors(path: str, of: Drive, speed: ArrayLike) -> list[ErrorDetail]:
    """Of a power at rest, from which no torque follows."""
    at_rest = np.asarray(speed, float) == 0.0
    if of.power is None or not at_rest.any():
        return []
    cause = Sentence("Give {torque}, or {speed}", torque=Field("torque"), speed=Field("operation.speed"))
    return [ErrorDetail(f"{path}.power", "gives no torque at the speed 0", cause=cause, where=at_rest)]
