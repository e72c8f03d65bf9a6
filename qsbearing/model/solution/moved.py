"""What a solution whose balls friction moves has in place of what the kernel reads off a hypothesis."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.kernel import results as kernel
from qsbearing.model.solution.friction_balance import ContactFriction, FrictionMotion, Unread, read
from qsbearing.model.solution.motion_stiffness import motion_stiffness
from qsbearing.model.solution.raceway_contacts import CODES
from qsbearing.model.solution.ring_stiffness import inverse
from qsbearing.model.solution.solved_cases import solved_of

MEAN_OVER_MAX = 2.0 / 3.0
"""Of Hertz's pressure."""
STRAIGHT = 3
"""So many channels come first that are no tilts."""


class Moved:
    """Arrays and stiffness of a solution.

    Args:
        balance: of friction.
        turns: which of the flattened cases do; the others have the static solution.
        which: of the flattened cases of the solution under outer control each is.
    """

    def __init__(self, balance: Unread, turns: NDArray, which: NDArray) -> None:
        self._balance = balance
        self._still, self._which = ~turns, which
        self.is_at_rest = not turns.any()

    @cached_property
    def motion(self) -> FrictionMotion:
        """What the balance says."""
        return read(self._balance)

    def known(self) -> dict[tuple[int, int], NDArray]:
        """Arrays (*cases, ball) by the kernel's row and number."""
        arrays = _read_off(self.motion)
        if self.motion.start is None:
            still = self._still.reshape(*self.motion.status.shape, 1) & (self.motion.status == "converged")[..., None]
            for name in _OF_MOTION:
                values = arrays[kernel.OF_BALL, CODES[name]]
                arrays[kernel.OF_BALL, CODES[name]] = np.where(still & there(self.motion), 0.0, values)
        elif self._still.any():
            solved = solved_of(self.motion.start)
            solved.read_all(arrays)
            arrays = {place: self._with_static(values, solved.read(*place), 1) for place, values in arrays.items()}
        return arrays

    @cached_property
    def _arches(self) -> tuple[dict[int, NDArray], tuple[Named | None, ...] | None]:
        return _of_arches(self.motion, self._balance.bearing)

    @property
    def apex(self) -> dict[int, NDArray]:
        """Of arched rings: apex margins by the kernel's row."""
        return self._arches[0]

    @property
    def opposite(self) -> tuple[Named | None, ...] | None:
        """Of arched rings: arrays of the contacts of the inner and the outer ring's other arcs by name, None for a ring
        with one arc."""
        return self._arches[1]

    def stiffness(self) -> NDArray:
        """dF/dd (*cases, 5, 5), SI: of x, y and z, tilts held. NaN for tilts: a ring that tilts turns about another
        axis, whose slip, the ring's speed times the tilt, is no part of the balls' equations."""
        out = np.full((*self.motion.status.shape, 5, 5), np.nan)
        out[..., :3, :3] = motion_stiffness(self.motion)
        return self._with_static(out, self.motion.start.stiffness, 2) if self._has_static else out

    def compliance(self, stiffness: NDArray, free: NDArray) -> NDArray:
        """Inverse of it over the free channels (*cases, 5, 5); NaN elsewhere, and for those that tilts without a number
        couple with: y and z where the ring is free to tilt, which is under thrust alone."""
        out = np.full(stiffness.shape, np.nan)
        among = free if free.max(initial=0) < STRAIGHT else free[free < 1]
        if among.size:
            rows = among[:, None]
            out[..., rows, among] = inverse(stiffness[..., rows, among])
        return self._with_static(out, self.motion.start.compliance, 2) if self._has_static else out

    @property
    def _has_static(self) -> bool:
        """Whether some cases are those of a solution without friction."""
        return bool(self._still.any()) and self.motion.start is not None

    def _with_static(self, out: NDArray, of_start: NDArray, axes: int) -> NDArray:
        """With what the static solution has in cases at rest; arrays (*cases, ...) of so many axes beyond."""
        flat = out.reshape(-1, *out.shape[out.ndim - axes :]).copy()
        of_start = of_start.reshape(-1, *of_start.shape[of_start.ndim - axes :])
        flat[self._still] = of_start[self._which][self._still]
        return flat.reshape(out.shape)


_OF_MOTION = (
    *("centrifugal_force", "gyroscopic_moment", "orbital_speed", "rotation_speed", "axial_rotation"),
    *("radial_rotation", "attitude_angle"),
)
"""Of a ball; nothing of it at rest."""


def there(motion: FrictionMotion) -> NDArray:
    """Which balls a case has."""
    counts = motion.inside.cases["ball_count"].reshape(*motion.status.shape, 1)
    return np.asarray(np.arange(motion.weight.shape[-1]) < counts)


Named = dict[str, NDArray]
"""Arrays (*cases, ball)."""


def _of_arches(
    motion: FrictionMotion, bearing: BallBearing
) -> tuple[dict[int, NDArray], tuple[Named | None, ...] | None]:
    """(apex margins of the arcs for angles above zero, contacts of the others); nothing of rings with one arc."""
    if motion.opposite is None:
        return {}, None
    of_first = ("inner", kernel.AT_INNER, motion.inner), ("outer", kernel.AT_OUTER, motion.outer)
    first = {row: each for side, row, of in of_first if (each := _apex_margin(bearing, side, 1.0, of)) is not None}
    others: list[Named | None] = []
    for side, of in zip(("inner", "outer"), motion.opposite, strict=True):
        margin = None if of is None else _apex_margin(bearing, side, -1.0, of)
        others.append(None if of is None or margin is None else _of_contacts(of) | {"apex_margin": margin})
    return first, tuple(others)


def _apex_margin(bearing: BallBearing, side: str, sign: float, of: ContactFriction) -> NDArray | None:
    """r (|alpha| - asin(g/(2 r))) - a of the arc that carries angles of this sign; None where the ring has one arc."""
    apex = bearing.apex_angle(side)
    if apex is None:
        return None
    radius = np.asarray(getattr(bearing, f"{side}_groove_radius"), float)[..., None]
    return np.where(of.load > 0.0, radius * (sign * of.angle - apex[..., None]) - of.semi_major_axis, np.nan)


def _read_off(motion: FrictionMotion) -> dict[tuple[int, int], NDArray]:
    arrays = {(kernel.OF_BALL, name): values for name, values in _of_balls(motion).items()}
    for row, of_side in ((kernel.AT_INNER, motion.inner), (kernel.AT_OUTER, motion.outer)):
        arrays |= {(row, name): values for name, values in _of_contacts(of_side).items()}
    return {(row, CODES[name]): values for (row, name), values in arrays.items()}


def _of_balls(motion: FrictionMotion) -> dict[str, NDArray]:
    w, sense = motion.angular_velocity, motion.sense[..., None]
    return {
        "centrifugal_force": motion.centrifugal_force,
        "gyroscopic_moment": -motion.gyroscopic_moment,
        "orbital_speed": motion.orbital_speed,
        "rotation_speed": sense * np.sqrt((w * w).sum(axis=-1)),
        "attitude_angle": motion.attitude_angle,
        "axial_rotation": w[..., 0],
        "radial_rotation": -w[..., 2],
    }


def _of_contacts(of: ContactFriction) -> dict[str, NDArray]:
    names = "angle", "load", "approach", "semi_major_axis", "semi_minor_axis"
    area = np.pi * of.semi_major_axis * of.semi_minor_axis
    with np.errstate(divide="ignore", invalid="ignore"):
        pressure = np.where(of.load == 0.0, 0.0, of.load / (MEAN_OVER_MAX * area))
        required = np.where(of.load == 0.0, 0.0, np.abs(of.traction) / of.load)
    more = {"sine": np.sin(of.angle), "cosine": np.cos(of.angle), "max_pressure": pressure}
    return {name: getattr(of, name) for name in names} | more | {"required_friction": required}
