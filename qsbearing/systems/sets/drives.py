"""Gears and belts of a shaft at its speed: the loads that they make, and what is wrong with them there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.validation import LENGTH, ErrorDetail
from qsbearing.systems.sets.belts import slack_errors
from qsbearing.systems.sets.shaft import Shaft, ShaftLoad, diameter_at, outside
from qsbearing.systems.sets.torque import speed_errors, torque_on_shaft

if TYPE_CHECKING:
    from qsbearing.systems.sets.belts import Belt
    from qsbearing.systems.sets.gears import Gear

SOLID = 1.25
"""Diameter of the shaft over a gear's pitch diameter at most: of a pinion cut from the solid, the tips of its teeth, of
eight or more (1 + 2 / 8)."""


def drives_of(of: Shaft) -> Iterator[tuple[str, Gear | Belt]]:
    """Gears, then belts, each with what it is called."""
    for kind in ("gear", "belt"):
        yield from ((f"{kind} {number}", each) for number, each in enumerate(of.standing[kind], 1))


def drive_loads(of: Shaft, speed: ArrayLike) -> list[ShaftLoad]:
    """On the shaft, in the same order.

    Args:
        speed: of the shaft [rad/s].
    """
    return [ShaftLoad(each.position, *each.load(speed)) for _, each in drives_of(of)]


def torque_sum(of: Shaft, speed: ArrayLike) -> NDArray | None:
    """Of gears and belts, about +x [N m]: what a motor, a coupling or the like must take up. None: there are none."""
    torques = [torque_on_shaft(each, speed) for _, each in drives_of(of)]
    return np.asarray(sum(torques)) if torques else None


def torque_scale(of: Shaft, speed: ArrayLike) -> NDArray:
    """The largest of them [N m]."""
    sizes: list[Any] = [np.abs(torque_on_shaft(each, speed)) for _, each in drives_of(of)]
    return np.asarray(np.max(np.broadcast_arrays(*sizes), axis=0)) if sizes else np.zeros(())


def with_torques(of: Shaft | None, speed: ArrayLike) -> Shaft | None:
    """A shaft whose gears and belts have the torques that their powers make at this speed: loads that stay while the
    speed changes."""
    if of is None:
        return None
    torques: dict[str, Any] = {"gears": [], "belts": []}
    for name, each in drives_of(of):
        power = each.power
        given: dict[str, Any] = (
            {} if power is None else {"torque": np.asarray(power, float) / np.abs(speed), "power": None}
        )
        torques[f"{name.partition(' ')[0]}s"].append(replace(each, **given))
    return replace(of, gears=tuple(torques["gears"]), belts=tuple(torques["belts"]))


def drive_errors(of: Shaft, speed: ArrayLike) -> list[ErrorDetail]:
    """What the set's speed, or the shaft's thickness, does not suit."""
    errors = []
    for name, each in drives_of(of):
        path = f"shaft.{name}"
        at_rest = speed_errors(path, each, speed)
        errors += at_rest
        if name.startswith("belt") and not at_rest and each.pretension is not None:  # type: ignore[union-attr]
            errors += slack_errors(path, each, speed)  # type: ignore[arg-type]
    for number, gear in enumerate(of.gears, 1):
        if not of.sections or gear.internal or outside(of, [("", gear.position)]):
            continue
        thick = diameter_at(of, gear.position, "outer")
        small = np.asarray(gear.diameter * SOLID < thick)
        if small.any():
            diameter = float(np.min(gear.diameter))
            detail = f"the shaft has {thick * 1e3:.4g} mm there"
            problem = "is less than the diameter of the shaft"
            field = f"shaft.gear {number}.pitch_diameter"
            errors.append(ErrorDetail(field, problem, diameter, LENGTH, where=small, detail=detail))
    return errors
