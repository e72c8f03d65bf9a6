"""The units that REXS writes out, such as "N mm / rad": what kind of number each is for, and its size in SI."""

from __future__ import annotations

from typing import NamedTuple

from qsbearing.model.units import GPa, MPa, deg, mm, rpm, um, zero_celsius

NUMBER = "number"


class RexsUnit(NamedTuple):
    """A unit of a file."""

    kind: str
    size: float
    """One of it in SI."""
    zero: float = 0.0
    """Its zero in SI."""

    def si(self, value: float) -> float:
        return value * self.size + self.zero

    def of(self, value: float) -> float:
        """An SI value in this unit."""
        return (value - self.zero) / self.size


_KINDS: dict[str, dict[str, float]] = {
    NUMBER: {"": 1.0, "none": 1.0, "%": 0.01},
    "length": {"m": 1.0, "cm": 0.01, "mm": mm, "mum": um, "um": um, "µm": um},
    "angle": {"rad": 1.0, "mrad": 1e-3, "deg": deg, "degree": deg, "°": deg},
    "speed": {"1/min": rpm, "rpm": rpm, "rad/s": 1.0, "1/s": 60.0 * rpm},
    "force": {"N": 1.0, "kN": 1e3, "MN": 1e6},
    "moment": {"Nm": 1.0, "Nmm": 1e-3, "kNm": 1e3},
    "pressure": {"N/mm^2": MPa, "MPa": MPa, "GPa": GPa, "Pa": 1.0, "N/m^2": 1.0, "kN/mm^2": GPa},
    "density": {"kg/dm^3": 1e3, "g/cm^3": 1e3, "kg/m^3": 1.0},
    "expansion": {"1e-6/C": 1e-6, "1e-6/K": 1e-6, "1/C": 1.0, "1/K": 1.0},
    "viscosity": {"mm^2/s": mm**2, "cSt": mm**2, "m^2/s": 1.0},
    "stiffness": {"N/m": 1.0, "N/mm": 1e3, "N/mum": 1e6},
    "force over angle": {"N/rad": 1.0},
    "moment over angle": {"Nmm/rad": 1e-3, "Nm/rad": 1.0},
    "mass": {"kg": 1.0, "g": 1e-3, "t": 1e3},
    "inertia": {"kgm^2": 1.0, "kgmm^2": 1e-6, "kgcm^2": 1e-4},
    "acceleration": {"m/s^2": 1.0, "mm/s^2": 1e-3},
    "time": {"h": 3600.0, "min": 60.0, "s": 1.0},
}
_UNITS = {text: RexsUnit(kind, size) for kind, texts in _KINDS.items() for text, size in texts.items()} | {
    "C": RexsUnit("temperature", 1.0, zero_celsius),
    "°C": RexsUnit("temperature", 1.0, zero_celsius),
    "K": RexsUnit("temperature", 1.0),
}


def unit_named(text: str) -> RexsUnit | None:
    """The unit of a text, whatever its blanks; None for one that is not known."""
    return _UNITS.get("".join(text.split()))
