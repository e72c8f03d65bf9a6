"""What is wrong with the parameters of ring expansion: by themselves, and for a bearing."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from qsbearing.model.bearing import BallBearing
from qsbearing.model.material import Material, material_errors
from qsbearing.model.units import zero_celsius
from qsbearing.model.validation import (
    LENGTH,
    PRESSURE,
    TEMPERATURE,
    ErrorDetail,
    Field,
    Sentence,
    numeric,
    on_side,
    within,
)

LARGEST_FIT = 0.01
"""Of the seat's diameter: ten times any press fit; it catches mistakes of unit."""
HOTTEST = 1300.0
"""[K]; no bearing material is elastic there."""

SHAFT = ("shaft_bore_diameter", "shaft_material", "shaft_temperature")
HOUSING = ("housing_outside_diameter", "housing_material", "housing_temperature")
TEMPERATURES = ("shaft_temperature", "inner_ring_temperature", "outer_ring_temperature", "housing_temperature")


class Fit(NamedTuple):
    """A fit by its name, and the interferences that it allows, negative where loose [m]."""

    name: str
    """Of the seat: k5, JS6."""
    tolerance_class: str
    """Of the bearing: normal, P4."""
    least: Any
    most: Any

    @property
    def mean(self) -> Any:
        return 0.5 * (self.least + self.most)


RANGES = {
    **dict.fromkeys(("bore_diameter", "outside_diameter", "housing_outside_diameter"), (1e-4, 20.0)),
    "shaft_bore_diameter": (0.0, 20.0),
    "yield_strength": (1e7, 5e9),
}
"""Of lengths [m] and of the yield strength [Pa]."""


def temperature_errors(field: str, temperature: Any) -> list[ErrorDetail]:
    """Errors of a temperature [K]."""
    errors = within(field, temperature, TEMPERATURE, 0.0, HOTTEST)
    cold = errors and isinstance(errors[0].value, float) and errors[0].value < 0.0
    if not cold:
        return errors
    return [
        ErrorDetail(
            field, "is below absolute zero", errors[0].value, TEMPERATURE, (0.0, HOTTEST), where=errors[0].where
        )
    ]


def expansion_errors(effect: Any) -> list[ErrorDetail]:
    """Every error of the parameters of a `RingExpansion` by themselves."""
    path = effect.name
    errors = []
    for name in ("bore_diameter", "outside_diameter"):
        errors += within(f"{path}.{name}", getattr(effect, name), LENGTH, *RANGES[name])
    for seat, diameter, others in (("shaft", "bore_diameter", SHAFT), ("housing", "outside_diameter", HOUSING)):
        interference = getattr(effect, f"{seat}_interference")
        if interference is None:
            errors += [_unused(f"{path}.{name}", seat) for name in others if getattr(effect, name) is not None]
        else:
            errors += _interference_errors(f"{path}.{seat}_interference", interference, getattr(effect, diameter))
        material = getattr(effect, f"{seat}_material")
        errors += [] if material is None else material_errors(f"{path}.{seat}_material", material)
        fit = getattr(effect, f"{seat}_fit")
        if fit is not None and not isinstance(fit, Fit):
            errors.append(ErrorDetail(f"{path}.{seat}_fit", "is not a fit", fit, cause="Write a Fit(...), or None"))
    for name in ("shaft_bore_diameter", "housing_outside_diameter"):
        if getattr(effect, name) is not None:
            errors += within(f"{path}.{name}", getattr(effect, name), LENGTH, *RANGES[name])
    if effect.housing_outside_diameter is None and effect.housing_interference is not None:
        cause, detail = "It determines how stiffly the housing holds the ring", "a housing is given"
        errors.append(ErrorDetail(f"{path}.housing_outside_diameter", "missing", cause=cause, detail=detail))
    given = {name: getattr(effect, name) for name in TEMPERATURES if getattr(effect, name) is not None}
    for name, temperature in given.items():
        errors += temperature_errors(f"{path}.{name}", temperature)
    wrong = temperature_errors(f"{path}.reference_temperature", effect.reference_temperature)
    errors += wrong
    if not given and not wrong:
        unused = np.asarray(effect.reference_temperature) != 20.0 + zero_celsius
        if unused.any():
            problem = "is given, but no other temperature is"
            cause = Sentence("Give {temperatures}", temperatures=tuple(map(Field, TEMPERATURES)))
            errors.append(ErrorDetail(f"{path}.reference_temperature", problem, cause=cause, where=unused))
    return errors + within(f"{path}.yield_strength", effect.yield_strength, PRESSURE, *RANGES["yield_strength"])


def _unused(field: str, seat: str) -> ErrorDetail:
    fit = Field(f"{seat}_interference")
    cause = Sentence("Give {fit} (0 for a fit line to line), or leave this out", fit=fit)
    problem = Sentence("is given, but without {fit} the {seat} has no effect", fit=fit, seat=seat)
    return ErrorDetail(field, problem, cause=cause)


def _interference_errors(field: str, interference: ArrayLike, diameter: ArrayLike) -> list[ErrorDetail]:
    array, errors = numeric(field, interference, LENGTH)
    seat, _ = numeric(field, diameter, LENGTH)
    if array is None or seat is None:
        return errors
    limit = LARGEST_FIT * float(np.max(seat))
    return within(field, interference, LENGTH, -limit, limit, f"is more than {LARGEST_FIT:.0%} of the seat's diameter")


def section_errors(effect: Any, bearing: BallBearing) -> list[ErrorDetail]:
    """Diameters that are no rings around this bearing's grooves, and missing coefficients of expansion."""
    bottom_inner = 2.0 * (bearing.inner_groove_centre_radius - np.asarray(bearing.inner_groove_radius))
    bottom_outer = 2.0 * (bearing.outer_groove_centre_radius + np.asarray(bearing.outer_groove_radius))
    errors = []
    for name, limit, outward, what in (
        ("bore_diameter", bottom_inner, -1.0, "within the bottom of the inner groove"),
        ("outside_diameter", bottom_outer, 1.0, "around the bottom of the outer groove"),
        ("shaft_bore_diameter", effect.bore_diameter, -1.0, "within the shaft's seat"),
        ("housing_outside_diameter", effect.outside_diameter, 1.0, "around the housing's seat"),
    ):
        if getattr(effect, name) is not None:
            errors += on_side(f"{effect.name}.{name}", getattr(effect, name), limit, outward, what)
    return errors + _expansion_missing(effect, bearing)


def _expansion_missing(effect: Any, bearing: BallBearing) -> list[ErrorDetail]:
    requested: dict[str, tuple[Material, bool]] = {
        "bearing.ring_material": (
            bearing.ring_material,
            any(getattr(effect, f"{side}_ring_temperature") is not None for side in ("inner", "outer")),
        )
    }
    for seat, ring in (("shaft", "inner_ring"), ("housing", "outer_ring")):
        material = getattr(effect, f"{seat}_material")
        is_warm = any(getattr(effect, f"{body}_temperature") is not None for body in (seat, ring))
        field = "bearing.ring_material" if material is None else f"{effect.name}.{seat}_material"
        known, before = requested.get(field, (material, False))
        requested[field] = (known, before or is_warm)
    detail, cause = "temperatures are given", "12e-6 per kelvin for bearing steel"
    return [
        ErrorDetail(f"{field}.thermal_expansion", "missing", cause=cause, detail=detail)
        for field, (material, is_needed) in requested.items()
        if is_needed and material.thermal_expansion is None
    ]
