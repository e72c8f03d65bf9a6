"""Expansion of the balls by heat.

Source        linear thermal expansion
Equation      D' = D (1 + alpha dT); clearance, pitch circle and free contact angle follow
Assumes       all balls at one temperature, dimensions given at the reference temperature; masses do not change. Between
              rings that are given temperatures, balls without one are as warm as the mean of both (chosen: it leaves a
              bearing that is warm throughout its preload, and no ball is outside its rings' temperatures)
When not      a ball as warm as its rings, of the same material: then only their difference counts, and ring expansion
              must be asked for as well
Parameters    ball_temperature, reference_temperature
Indicator     the turn of the free contact angle over the contact angle
Example       BallExpansion(ball_temperature=70 + zero_celsius)
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from qsbearing.model.bearing import BallBearing
from qsbearing.model.described import given_in
from qsbearing.model.effects.body_temperature import assumed_of_balls
from qsbearing.model.effects.changed_geometry import change_by, geometry_errors
from qsbearing.model.effects.entry import Assumed, Entry, Errors, bearings_of, effect, error_in, given, with_ring_effect
from qsbearing.model.effects.operating_point import OperatingPoint
from qsbearing.model.effects.ring_expansion_errors import temperature_errors
from qsbearing.model.operation import Operation
from qsbearing.model.units import zero_celsius
from qsbearing.model.validation import ErrorDetail, raise_if_any


@dataclass(frozen=True)
class BallExpansion:
    """Ask for the thermal expansion of the balls; temperatures in kelvin, which may be arrays.

    Raises:
        SceneError: every error, at once.
    """

    ball_temperature: ArrayLike | None = field(metadata=given_in("C"))
    """[K]; None: a heat balance will find it."""
    reference_temperature: ArrayLike = field(default=20.0 + zero_celsius, metadata=given_in("C"))
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
        return [ErrorDetail(field, "missing", cause=cause, detail="temperatures are given")]

    def at_rest(self, fitted: bool) -> None:
        """What of it a bearing has at rest and cold: nothing."""

    def reshape(self, bearing: BallBearing, operation: Operation) -> BallBearing:
        """The bearing with its balls expanded; as it is while their temperature is not found."""
        if self.ball_temperature is None:
            return bearing
        warmer = np.asarray(self.ball_temperature, float) - np.asarray(self.reference_temperature, float)
        strain = np.asarray(bearing.ball_material.thermal_expansion, float) * warmer
        return bearing.with_changed_lengths(ball_diameter=strain * np.asarray(bearing.ball_diameter, float))


DOUBT = 10.0
"""By how much balls whose temperature is assumed may be colder or warmer [K] (chosen: 10 K, by which a ball of 12.7 mm
grows 1.5 µm)."""


def _usual(of: Any, points: list[OperatingPoint]) -> list[Assumed]:
    """Colder and warmer than assumed, where something is."""
    if all(assumed_of_balls(there) is None for _, there in bearings_of(of)):
        return []

    def than_assumed(warmer: float) -> Any:
        def made(bearing: BallBearing, there: tuple[Any, ...]) -> BallExpansion | None:
            known = assumed_of_balls(there)
            return None if known is None else BallExpansion(known[0] + warmer, known[1])

        return with_ring_effect(of, BallExpansion, made)

    return [
        Assumed(f"{DOUBT:g} K {word}", f"balls {DOUBT:g} K {word} than assumed", than_assumed(warmer))
        for word, warmer in (("colder", -DOUBT), ("warmer", DOUBT))
    ]


def _errors(point: OperatingPoint) -> Errors:
    return geometry_errors(point, change_by(ENTRY, point))


ENTRY = Entry(
    "ball_expansion",
    "the expansion of the balls",
    effect("ring_effects", BallExpansion),
    indicator=error_in("contact_angle", _errors),
    errors=_errors,
    needs=given(BallExpansion, " with the balls' temperature"),
    without_it=f"The balls are assumed as warm as the mean of their rings; {DOUBT:g} K more or less",
    assume=_usual,
)
