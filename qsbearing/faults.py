"""What is wrong with an input, as data: collected first, reported together.

A fault names its field as Python does and holds SI values. Whoever reports it to a reader of another form (a scene
file, with units in its keys) translates names and units and nothing else.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from math import pi
from typing import Any

import numpy as np

MM, RPM, DEG = 1e-3, 2.0 * pi / 60.0, pi / 180.0


@dataclass(frozen=True)
class Quantity:
    """What kind of number a field holds: its SI unit, and the units it is often given in by mistake."""

    unit: str
    slips: tuple[tuple[str, float], ...] = ()
    """(unit's name, its size in SI) of likely mistakes."""


LENGTH = Quantity("m", (("metres", 1.0), ("millimetres", MM), ("micrometres", 1e-6), ("inches", 25.4 * MM)))
ANGLE = Quantity("rad", (("radians", 1.0), ("degrees", DEG), ("milliradians", 1e-3)))
SPEED = Quantity("rad/s", (("radians per second", 1.0), ("revolutions per minute", RPM)))
MODULUS = Quantity("Pa", (("pascals", 1.0), ("megapascals", 1e6), ("gigapascals", 1e9)))
DENSITY = Quantity("kg/m^3", (("kg/m^3", 1.0), ("g/cm^3", 1e3), ("kg/mm^3", 1e9)))
FORCE = Quantity("N", (("newtons", 1.0), ("kilonewtons", 1e3)))
MOMENT = Quantity("N m", (("newton metres", 1.0), ("newton millimetres", 1e-3)))
RATIO = Quantity("-")
COUNT = Quantity("balls")


@dataclass(frozen=True)
class Fault:
    """One thing wrong with one field."""

    field: str
    """The field's name in Python, e.g. `bearing.ball_diameter`."""
    problem: str
    """A sentence."""
    value: Any = None
    """The offending value, SI; the worst one of an array."""
    quantity: Quantity | None = None
    allowed: tuple[float, float] | None = None
    """Inclusive range, SI."""
    cause: str = ""
    """What is likely meant, or what to write instead."""

    def __str__(self) -> str:
        unit = f" {self.quantity.unit}" if self.quantity and self.quantity.unit != "-" else ""
        text = f"{self.field}"
        if self.value is not None:
            text += f" = {_shown(self.value)}{unit}" if isinstance(self.value, float | int) else f" = {self.value!r}"
        text += f": {self.problem}"
        if self.allowed is not None:
            text += f" (allowed: {self.allowed[0]:g} to {self.allowed[1]:g}{unit})"
        return text + (f". {self.cause}" if self.cause else "")


def _shown(value: float) -> str:
    """A number to six digits; an integer that no float holds by its size."""
    try:
        return f"{value:g}"
    except OverflowError:
        return f"<an integer of {int(value).bit_length()} bits>"


class SceneError(ValueError):
    """An input that describes no bearing or no operation; `faults` holds every reason found."""

    def __init__(self, faults: Iterable[Fault]) -> None:
        self.faults = tuple(faults)
        super().__init__("\n".join(str(fault) for fault in self.faults))


def raise_if_any(faults: list[Fault]) -> None:
    """Raise `SceneError` with all faults, if there are any."""
    if faults:
        raise SceneError(faults)


def numeric(field: str, value: Any, quantity: Quantity) -> tuple[np.ndarray | None, list[Fault]]:
    """The value as a float array, or the fault that says why it is none: not a number, NaN, infinite."""
    try:
        if value is None or isinstance(value, str | bytes | bool) or np.iscomplexobj(value):
            raise TypeError
        array = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        return None, [Fault(field, "is not a number", value=value, quantity=quantity)]
    except OverflowError:
        return None, [Fault(field, "is an integer beyond any float", quantity=quantity)]
    if array.size == 0:
        return None, [Fault(field, "is an empty array", quantity=quantity)]
    finite = np.isfinite(array)
    if not finite.all():
        worst = float(array[~finite].flat[0])
        return None, [Fault(field, "is not a finite number", value=worst, quantity=quantity)]
    return array, []


def choose(field: str, value: Any, choices: type[StrEnum]) -> tuple[Any, list[Fault]]:
    """The member that a value names (a member itself, or its word), or the fault that says which there are."""
    try:
        return choices(value), []
    except ValueError:
        names = ", ".join(str(choice) for choice in choices)
        return value, [Fault(field, f"is not one of {names}", value=value)]


def within(field: str, value: Any, quantity: Quantity, low: float, high: float, meaning: str = "") -> list[Fault]:
    """Faults of a value that must be a finite number in [low, high], with the likely slip of unit named."""
    array, faults = numeric(field, value, quantity)
    if array is None:
        return faults
    outside = (array < low) | (array > high)
    if not outside.any():
        return []
    worst = float(array[outside].flat[0])
    problem = meaning or ("is negative" if worst < 0.0 <= low else "is too small" if worst < low else "is too large")
    return [Fault(field, problem, worst, quantity, (low, high), likely_slip(worst, quantity, low, high))]


def likely_slip(value: float, quantity: Quantity, low: float, high: float) -> str:
    """A sentence naming the unit in which an out-of-range SI value would be in range; empty where none would."""
    fitting = [name for name, size in quantity.slips if size != 1.0 and low <= value * size <= high]
    if not fitting:
        return ""
    return f"Given in {fitting[0]}? Python takes SI and radians: multiply by the unit, as in 22.225 * qs.mm"
