"""Expansion of the rings: by their rotation, by their fits on shaft and in housing, and by heat, all together.

Source        Timoshenko & Goodier, Theory of Elasticity (annulus.py has the formulas); Harris & Kotzalas on fits,
              clearance and the free contact angle
Equation      at a seat, one pressure p = overlap/(c of both bodies), overlap = interference/2 and what shaft less
              ring (or ring less housing) grow freely by rotation and heat; where that is negative, p = 0 and the
              bodies stand apart. A groove centre moves by heat as the ring there, radially and axially from the plane
              of the balls' centres, and by p and rotation as the bottom of its groove; groove radii grow by heat.
              Clearance, pitch circle and free contact angle follow. A displacement that a preload holds, and the
              distance of inner rings, grow by the heat of the shaft; the distance of outer rings by the housing's
Assumes       each ring a thick annulus from its seat to the bottom of its groove, shaft and housing annuli (or a solid
              shaft) as long as the ring, plane stress, each body at one temperature; shoulders, ball loads and the
              flattening of rough seats do not count; pressure and rotation move nothing axially
When not      thin-walled housings that are not round, rings held axially; what a shaft grows between this bearing and
              one that is not in the scene (a set has both)
Parameters    bore and outside diameter of the bearing; interference (diametral, negative: a loose fit) at a seat that
              is to be regarded, and there the shaft's bore or the housing's outside diameter; temperatures. A ring
              without a seat grows freely
Indicator     the turn of the free contact angle over the contact angle; without parameters that by rotation of an
              inner ring thin at the bottom of its groove, u = rho omega^2 r^3/E, more than which no other bore gives
              (measured: displacement, angles and loads within a factor of two), of batches too large to be solved
Example       RingExpansion(90 * mm, 160 * mm, shaft_interference=20 * um, inner_ring_temperature=60 + zero_celsius)
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.described import A_MATERIAL, given_in
from qsbearing.model.effects.annulus import Elastic, PlaneStress, displacement, stress_by_pressure, stress_by_rotation
from qsbearing.model.effects.body_temperature import GIVEN, REFERENCE, BodyTemperature
from qsbearing.model.effects.changed_geometry import GeometryChange, change_by, geometry_errors
from qsbearing.model.effects.entry import Assumed, Entry, Errors, bearings_of, effect, error_in, given, with_ring_effect
from qsbearing.model.effects.operating_point import OperatingPoint
from qsbearing.model.effects.ring_dimensions import ring_dimensions
from qsbearing.model.effects.ring_expansion_errors import RANGES, Fit, expansion_errors, section_errors
from qsbearing.model.material import Material
from qsbearing.model.operation import Operation
from qsbearing.model.units import MPa, zero_celsius
from qsbearing.model.validation import LENGTH, ErrorDetail, first, raise_if_any


class Body(NamedTuple):
    """A ring, a shaft or a housing: an annulus a < r < b, how fast it turns, and what heat makes it grow."""

    a: Any
    b: Any
    elastic: Elastic
    speed: Any
    strain: Any
    """By heat, alpha dT."""

    def stress(self, radius: Any, bore_pressure: Any = 0.0, outside_pressure: Any = 0.0) -> PlaneStress:
        """By rotation and pressures. Lengths are cold ones: a warm body keeps its mass, and its rho r^2 falls."""
        pressed = stress_by_pressure(radius, self.a, self.b, bore_pressure, outside_pressure)
        warm = self.elastic._replace(density=self.elastic.density / (1.0 + self.strain))
        turning = stress_by_rotation(radius, self.a, self.b, self.speed, warm)
        return PlaneStress(pressed.radial + turning.radial, pressed.hoop + turning.hoop)

    def free_growth(self, radius: Any) -> Any:
        """By rotation and heat [m]."""
        return displacement(radius, self.stress(radius), self.elastic) + self.strain * radius

    def compliance(self, radius: Any, bore_pressure: float, outside_pressure: float) -> Any:
        """Displacement there by such pressures alone, per pascal [m/Pa]."""
        stress = stress_by_pressure(radius, self.a, self.b, bore_pressure, outside_pressure)
        return displacement(radius, stress, self.elastic)


RING_IN = {"shaft": "inner_ring", "housing": "outer_ring"}
"""The ring on or in a seat, whose temperature the seat has where its own is left out."""


Seat = tuple[NDArray, NDArray]


def fit(inside: Body, outside: Body, radius: Any, interference: Any, touches: Any = None) -> Seat:
    """Pressure at a seat [Pa], and the gap in diameter [m] where there is none.

    Args:
        touches: where the balls close the gap: there the pressure is below zero, what they must make up first.
    """
    overlap = 0.5 * interference + inside.free_growth(radius) - outside.free_growth(radius)
    compliance = outside.compliance(radius, 1.0, 0.0) - inside.compliance(radius, 0.0, 1.0)
    least = 0.0 if touches is None else np.where(np.asarray(touches) > 0.0, -np.inf, 0.0)
    return np.maximum(overlap / compliance, least), np.maximum(-2.0 * overlap, 0.0)


class RingState(NamedTuple):
    """How one ring is found in operation; arrays over the cases that it depends on."""

    seat_pressure: NDArray | None
    """On the shaft or in the housing [Pa]; None where no fit is given. Below zero where elastic rings close a gap: what
    it takes from the balls' pressure there."""
    seat_gap: NDArray | None
    """By how much ring and seat stand apart, in diameter [m]; zero where they press."""
    groove_growth: NDArray
    """Outward displacement of the groove centre [m]."""
    bore_hoop_stress: NDArray
    """At the ring's bore, tension positive [Pa]."""
    equivalent_stress: NDArray
    """There, by Tresca [Pa]."""


@dataclass(frozen=True)
class RingExpansion:
    """Ask for the expansion of the rings. SI units, temperatures in kelvin; any number may be an array.

    Raises:
        SceneError: every error, at once.
    """

    bore_diameter: ArrayLike = field(metadata=given_in("mm", RANGES["bore_diameter"], printed=True))
    """Of the inner ring, which is its seat on the shaft [m]."""
    outside_diameter: ArrayLike = field(metadata=given_in("mm", RANGES["outside_diameter"], printed=True))
    """Of the outer ring, which is its seat in the housing [m]."""
    shaft_interference: ArrayLike | None = field(default=None, metadata=given_in("um"))
    """Shaft diameter less bore, at rest and at the reference temperature [m]; None: no shaft is regarded."""
    shaft_bore_diameter: ArrayLike | None = field(default=None, metadata=given_in("mm", RANGES["shaft_bore_diameter"]))
    """Of a hollow shaft [m]; None: it is solid."""
    shaft_material: Material | None = field(default=None, metadata=A_MATERIAL)
    """None: as the rings."""
    shaft_temperature: ArrayLike | None = field(default=None, metadata=given_in("C", goes_last=True))
    """[K]; None: as the inner ring."""
    inner_ring_temperature: ArrayLike | None = field(default=None, metadata=given_in("C", goes_last=True))
    """[K]; None, as for the outer ring: the reference temperature."""
    outer_ring_temperature: ArrayLike | None = field(default=None, metadata=given_in("C", goes_last=True))
    """None: the reference temperature [K]."""
    housing_interference: ArrayLike | None = field(default=None, metadata=given_in("um"))
    """Outside diameter less housing bore, at rest and the reference temperature [m]; None: no housing is regarded."""
    housing_outside_diameter: ArrayLike | None = field(
        default=None, metadata=given_in("mm", RANGES["housing_outside_diameter"])
    )
    """[m]; needed with a housing."""
    housing_material: Material | None = field(default=None, metadata=A_MATERIAL)
    """None: that of the rings."""
    housing_temperature: ArrayLike | None = field(default=None, metadata=given_in("C", goes_last=True))
    """[K]; None: as the outer ring."""
    reference_temperature: ArrayLike = field(default=20.0 + zero_celsius, metadata=given_in("C", goes_last=True))
    """At which all dimensions hold [K]."""
    yield_strength: float = field(default=1700e6, metadata=given_in("MPa", RANGES["yield_strength"], goes_last=True))
    """Of the rings [Pa]; hardened bearing steel yields at 1700 to 2000 MPa, by the usual handbook values."""
    shaft_fit: Fit | None = field(default=None, compare=False, repr=False)
    """Of which the interference is the mean. No solve looks at it: it tells what the limits of a fit do."""
    housing_fit: Fit | None = field(default=None, compare=False, repr=False)
    """Of which the interference is the mean. No solve looks at them: they tell what the limits of a fit do."""
    shaft_touches: ArrayLike | None = field(default=None, init=False, repr=False)
    """Set by the solver: 1 where the balls close the gap of elastic rings, 0 where they do not."""
    housing_touches: ArrayLike | None = field(default=None, init=False, repr=False)
    """Set by the solver: 1 where the balls close the gap of elastic rings, 0 where they do not."""
    name: ClassVar[str] = "ring_expansion"

    def __post_init__(self) -> None:
        raise_if_any(expansion_errors(self))

    def errors(self, bearing: BallBearing) -> list[ErrorDetail]:
        """What does not suit this bearing: a fit that makes its ring yield at rest and cold among it."""
        errors = section_errors(self, bearing)
        if errors:
            return errors
        for seat, ring, state in zip(("shaft", "housing"), ("inner", "outer"), self._states(bearing), strict=True):
            beyond = state.equivalent_stress > self.yield_strength
            if state.seat_pressure is not None and beyond.any():
                fit_given = np.asarray(getattr(self, f"{seat}_interference"), float)
                interference, pressure, stress = first(beyond, fit_given, state.seat_pressure, state.equivalent_stress)
                detail = (
                    f"a seat pressure of {pressure / MPa:.4g} MPa stresses its bore by {stress / MPa:.5g} MPa, "
                    f"beyond its yield strength of {self.yield_strength / MPa:.5g} MPa"
                )
                field, most = f"{self.name}.{seat}_interference", interference * self.yield_strength / stress
                problem = f"makes the {ring} ring yield"
                errors.append(ErrorDetail(field, problem, interference, LENGTH, (-most, most), "", beyond, detail))
        return errors

    def states(self, bearing: BallBearing, operation: Operation) -> tuple[RingState, RingState]:
        """How the inner and the outer ring are found in operation."""
        outer_speed = 0.0 if operation.outer_speed is None else operation.outer_speed
        speeds = (np.asarray(operation.speed, float), np.asarray(outer_speed, float))
        return self._states(bearing, speeds, self._warmer)

    def at_rest(self, fitted: bool) -> RingExpansion | None:
        """What of it a bearing has at rest and cold: its fits, once it is fitted."""
        return self.without_heat if fitted else None

    def reshape(self, bearing: BallBearing, operation: Operation) -> BallBearing:
        """The bearing with its rings expanded."""
        inner, outer = self.states(bearing, operation)
        inner_strain, outer_strain = self._ring_strains(bearing)
        return bearing.with_changed_lengths(
            inner_groove_centre=inner.groove_growth,
            outer_groove_centre=outer.groove_growth,
            inner_groove_radius=inner_strain * np.asarray(bearing.inner_groove_radius, float),
            outer_groove_radius=outer_strain * np.asarray(bearing.outer_groove_radius, float),
        )

    def axial_growth(self, bearing: BallBearing) -> tuple[NDArray, NDArray]:
        """By how much heat moves the inner and the outer groove centres axially from the balls' centres [m]."""
        inner, outer = bearing.groove_centre_offsets
        strains = self._ring_strains(bearing)
        return strains[0] * inner, strains[1] * outer

    def seat_strains(self, bearing: BallBearing) -> tuple[Any, Any]:
        """alpha dT of shaft and housing, which hold a preload and the distances between bearings."""
        return (
            _strain(self.shaft_material or bearing.ring_material, self._warmer("shaft")),
            _strain(self.housing_material or bearing.ring_material, self._warmer("housing")),
        )

    def _ring_strains(self, bearing: BallBearing) -> tuple[Any, Any]:
        inner, outer = (_strain(bearing.ring_material, self._warmer(f"{side}_ring")) for side in ("inner", "outer"))
        return inner, outer

    @property
    def fits(self) -> dict[str, Fit]:
        """Those that are named, by their seat."""
        by_seat = {"shaft": self.shaft_fit, "housing": self.housing_fit}
        return {seat: fit for seat, fit in by_seat.items() if fit is not None}

    def fit_of(self, name: str) -> Fit | None:
        """The named fit whose mean this field is."""
        seat, _, what = name.partition("_")
        return self.fits.get(seat) if what == "interference" else None

    @property
    def at_limits(self) -> RingExpansion:
        """With the least and the largest interference of each named fit, as two cases."""
        limits: dict[str, Any] = {
            f"{seat}_interference": np.stack([fit.least, fit.most]) for seat, fit in self.fits.items()
        }
        return replace(self, **limits)

    @property
    def without_heat(self) -> RingExpansion:
        """The same rings and seats at the reference temperature."""
        return replace(
            self,
            shaft_temperature=None,
            inner_ring_temperature=None,
            outer_ring_temperature=None,
            housing_temperature=None,
            reference_temperature=RingExpansion.reference_temperature,
        )

    @property
    def is_warm(self) -> bool:
        """Whether any temperature is given."""
        return not all(each.is_assumed for each in self.temperatures.values())

    @property
    def temperatures(self) -> dict[str, BodyTemperature]:
        """Of shaft, inner_ring, outer_ring and housing."""
        return {body: self._temperature(body) for body in ("shaft", "inner_ring", "outer_ring", "housing")}

    def _temperature(self, body: str) -> BodyTemperature:
        own = getattr(self, f"{body}_temperature")
        if own is not None:
            return BodyTemperature(own, GIVEN)
        if body not in RING_IN:
            return BodyTemperature(self.reference_temperature, REFERENCE)
        return BodyTemperature(self._temperature(RING_IN[body]).value, f"as the {RING_IN[body].replace('_', ' ')}")

    def _warmer(self, body: str) -> Any:
        """How much warmer than at the reference temperature [K]."""
        return np.asarray(self._temperature(body).value, float) - np.asarray(self.reference_temperature, float)

    def _states(
        self,
        bearing: BallBearing,
        speeds: tuple[Any, Any] = (0.0, 0.0),
        warmer: Callable[[str], Any] = lambda body: 0.0,
    ) -> tuple[RingState, RingState]:
        bore, outside = 0.5 * np.asarray(self.bore_diameter, float), 0.5 * np.asarray(self.outside_diameter, float)
        centres = bearing.inner_groove_centre_radius, bearing.outer_groove_centre_radius
        inner_bottom = centres[0] - np.asarray(bearing.inner_groove_radius, float)
        outer_bottom = centres[1] + np.asarray(bearing.outer_groove_radius, float)

        def body(name: str, a: Any, b: Any, material: Material, speed: Any) -> Body:
            return Body(a, b, _elastic(material), speed, _strain(material, warmer(name)))

        inner = body("inner_ring", bore, inner_bottom, bearing.ring_material, speeds[0])
        outer = body("outer_ring", outer_bottom, outside, bearing.ring_material, speeds[1])
        on_shaft = in_housing = None
        if self.shaft_interference is not None:
            hollow = 0.0 if self.shaft_bore_diameter is None else 0.5 * np.asarray(self.shaft_bore_diameter, float)
            shaft = body("shaft", hollow, bore, self.shaft_material or bearing.ring_material, speeds[0])
            on_shaft = fit(shaft, inner, bore, np.asarray(self.shaft_interference, float), self.shaft_touches)
        if self.housing_interference is not None:
            end = 0.5 * np.asarray(self.housing_outside_diameter, float)
            housing = body("housing", outside, end, self.housing_material or bearing.ring_material, speeds[1])
            in_housing = fit(
                outer, housing, outside, np.asarray(self.housing_interference, float), self.housing_touches
            )
        return (
            _state(inner, inner_bottom, centres[0], on_shaft, on_shaft[0] if on_shaft else 0.0, 0.0),
            _state(outer, outer_bottom, centres[1], in_housing, 0.0, in_housing[0] if in_housing else 0.0),
        )


def _elastic(material: Material) -> Elastic:
    numbers = (material.elastic_modulus, material.poisson_ratio, material.density)
    return Elastic(*(np.asarray(number, float) for number in numbers))


def _strain(material: Material, warmer: Any) -> Any:
    """alpha dT; a material without a coefficient is at the reference temperature."""
    return 0.0 if material.thermal_expansion is None else np.asarray(material.thermal_expansion, float) * warmer


def _state(
    ring: Body,
    bottom: Any,
    centre: Any,
    seat: tuple[NDArray, NDArray] | None,
    bore_pressure: Any,
    outside_pressure: Any,
) -> RingState:
    """The ring between its seat and the bottom of its groove, under the pressure of its seat."""
    growth = displacement(bottom, ring.stress(bottom, bore_pressure, outside_pressure), ring.elastic)
    radial, hoop = ring.stress(ring.a, np.maximum(bore_pressure, 0.0), np.maximum(outside_pressure, 0.0))
    equivalent = np.maximum(np.abs(hoop - radial), np.maximum(np.abs(hoop), np.abs(radial)))
    pressure, gap = (None, None) if seat is None else seat
    return RingState(pressure, gap, growth * (1.0 + ring.strain) + ring.strain * centre, hoop, equivalent)


def _change(point: OperatingPoint) -> GeometryChange:
    if ENTRY.is_in(point.full_scene):
        return change_by(ENTRY, point)
    bearing, ring, speed = point.bearing, point.bearing.ring_material, point.ring_speeds[0]
    radius = np.asarray(bearing.inner_groove_centre_radius - bearing.inner_groove_radius, float)
    growth = np.asarray(ring.density * (speed * radius) ** 2 / ring.elastic_modulus * radius)
    return GeometryChange(growth, 0.0)


def _errors(point: OperatingPoint) -> Errors:
    return geometry_errors(point, _change(point))


def _usual(of: Any, points: list[OperatingPoint]) -> list[Assumed]:
    """Rings of the bearing's dimensions without fits, which turn, and are as warm as a set's shaft and housing."""
    seats = {name: getattr(of, name, None) for name in RING_IN}
    bodies = {name: body for name, body in seats.items() if body is not None and body.temperature is not None}
    warm: dict[str, Any] = {f"{RING_IN[name]}_temperature": body.temperature for name, body in bodies.items()}
    if bodies:
        warm["reference_temperature"] = next(iter(bodies.values())).reference_temperature

    def made(bearing: BallBearing, there: tuple[Any, ...]) -> RingExpansion:
        size = ring_dimensions(bearing, there)
        return RingExpansion(size.bore, size.outside, **warm)

    origins = dict.fromkeys(ring_dimensions(*each).origin for each in bearings_of(of))
    heat = f"as warm as the {' and the '.join(bodies)}" if bodies else "without heat"
    what = f"rings of {' and '.join(origins)} that turn, without fits and {heat}"
    turns = any(np.any(speed != 0.0) for point in points for speed in point.ring_speeds)
    return [Assumed("", what, with_ring_effect(of, RingExpansion, made) if turns or warm else of)]


ENTRY = Entry(
    "ring_expansion",
    "the expansion of the rings",
    effect("ring_effects", RingExpansion),
    indicator=error_in("contact_angle", _errors),
    errors=_errors,
    needs=given(RingExpansion, " with bore, outside diameter, and fits or temperatures"),
    needs_beside_size=given(RingExpansion, " with fits or temperatures", shaft_fit="k5"),
    assume=_usual,
    tells_without=True,
)
