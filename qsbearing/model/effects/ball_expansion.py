"""Expansion of the balls by heat.

Source        linear thermal expansion
Equation      D' = D (1 + alpha dT); clearance, pitch circle and free contact angle follow
Assumes       all balls at one temperature, dimensions given at the reference temperature; masses do not change
When not      a ball as warm as its rings, of the same material: then only their difference counts, and ring expansion
              must be asked for as well
Parameters    ball_temperature, reference_temperature
Indicator     the turn of the free contact angle over the contact angle
Example       BallExpansion(ball_temperature=70 + zero_celsius)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from qsbearing.model.bearing import BallBearing
from qsbearing.model.effects.changed_geometry import change_by, geometry_errors
from qsbearing.model.effects.entry import Entry, Errors, effect, error_in, given
from qsbearing.model.effects.operating_point import OperatingPoint
from qsbearing.model.effects.ring_expansion_errors import temperature_errors
from qsbearing.model.operation import Operation
from qsbearing.model.units import zero_celsius
from qsbearing.model.validation import ErrorDetail, Field, Sentence, raise_if_any


@dataclass(frozen=True)
class BallExpansion:
    """Ask for the thermal expansion of the balls; temperatures in kelvin, which may be arrays.

    Raises:
        SceneError: every error, at once.
    """

    ball_temperature: ArrayLike | None
    """[K]; None: a heat balance will find it."""
    reference_temperature: ArrayLike = 20.0 + zero_celsius
    """At which all dimensions hold [K]."""
    name: ClassVar[str] = "ball_expansion"

    def __post_init__(self) -> None:
        given = self.ball_temperature
        errors = [] if given is None else temperature_errors(f"{self.name}.ball_temperature", given)
        raise_if_any(errors + temperature_errors(f"{self.name}.reference_temperature", self.reference_temperature))

    def errors(self, bearing: BallBearing) -> list[ErrorDetail]:
        """What does not suit this bearing."""
        if bearing.ball_material.thermal_expansion is not None:
            return []
        cause = "12e-6 per kelvin for bearing steel, 3.2e-6 for silicon nitride"
        field = "bearing.ball_material.thermal_expansion"
        detail = Sentence("{given} is given", given=Field("ball_expansion.ball_temperature"))
        return [ErrorDetail(field, "missing", cause=cause, detail=detail)]

    def at_rest(self, fitted: bool) -> None:
        """What of it a bearing has at rest and cold: nothing."""

    def reshape(self, bearing: BallBearing, operation: Operation) -> BallBearing:
        """The bearing with its balls expanded; as it is while their temperature is not found."""
        if self.ball_temperature is None:
            return bearing
        warmer = np.asarray(self.ball_temperature, float) - np.asarray(self.reference_temperature, float)
        strain = np.asarray(bearing.ball_material.thermal_expansion, float) * warmer
        return bearing.with_changed_lengths(ball_diameter=strain * np.asarray(bearing.ball_diameter, float))


def _errors(point: OperatingPoint) -> Errors:
    return geometry_errors(point, change_by(ENTRY, point))


ENTRY = Entry(
    "ball_expansion",
    "the expansion of the balls",
    effect("ring_effects", BallExpansion),
    indicator=error_in("contact_angle", _errors),
    errors=_errors,
    needs=given(BallExpansion, " with the balls' temperature"),
)
