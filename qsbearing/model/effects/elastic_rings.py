"""Rings that deflect under their balls: they grow evenly and bend, each alone, in a housing or on a shaft.

Source        Timoshenko & Goodier (ring_compliance.py has the formulas); found missing by finite elements of a bearing
              sector whose outside diameter is free: 7 to 9 um more axial displacement at 17.8 kN, angles 1.1 degrees
Equation      under the radial loads of the balls on its groove a ring moves by the sum of c_n F cos n(psi - psi_j),
              n = 0 and 2, 3, ...; the grooves part by as much at each ball. Amplitudes are unknowns of the solver
              (kernel/ring_bending.py)
Assumes       small deflections; growth of a rectangle between groove bottom and seat, bending of one as stiff as the
              section with its shoulders (ring_section.py); the load as a line over the ring's width; a seat that keeps
              touching all round. The part n = 1 of the load is carried by the mount
              as it comes: a ring that stands on a spot bends otherwise
When not      a seat with clearance, which must close first; ribbed or split housings (give compliances by harmonic,
              from finite elements); a section that rolls about its circumference, which a face that is held prevents
Parameters    of each ring its width, its diameter away from the groove, its shoulders and what holds it: rigid (it does
              not deflect), free, a housing or shaft of some diameter; or compliances by harmonic in place of all that
Indicator     the turn of the contact angle by the largest deflection under the loads of rigid rings, over the contact
              angle: far too much under radial loads, which bent rings share anew; without parameters it is solved
Example       ElasticRings(outside_diameter=160 * mm, outer_width=30 * mm, housing="free")
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache, partial
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.described import given_in
from qsbearing.model.effects.changed_geometry import GeometryChange, geometry_errors
from qsbearing.model.effects.elastic_ring_errors import Grooves, parameter_errors, section_errors
from qsbearing.model.effects.entry import (
    QUANTITIES,
    Assumed,
    Entry,
    Errors,
    bearings_of,
    effect,
    error_in,
    given,
    with_ring_effect,
)
from qsbearing.model.effects.operating_point import OperatingPoint
from qsbearing.model.effects.ring_compliance import (
    MOST_HARMONICS,
    Annulus,
    PressureCompliance,
    by_load,
    inner_ring_compliance,
    of_section,
    outer_ring_compliance,
)
from qsbearing.model.effects.ring_dimensions import ring_dimensions
from qsbearing.model.effects.ring_section import bending_height
from qsbearing.model.material import STEEL, Material
from qsbearing.model.operation import Operation
from qsbearing.model.validation import ErrorDetail, raise_if_any

OUTER, INNER = ("outer",), ("inner",)
HOUSING, SHAFT = (*OUTER, "housing"), (*INNER, "shaft")
"""The parts that the numbers belong to."""
RIGID, FREE, SOLID = "rigid", "free", "solid"
"""What holds a ring, where that is no body of some diameter: it is rigid; nothing; a solid shaft."""
USUAL_HOUSING = 1.4
"""Outside diameter of a housing over that of the ring in it, where none is given (chosen)."""


def grooves_of(bearing: BallBearing) -> Grooves:
    """Of this bearing."""
    ring = bearing.ring_material
    inner, outer = (np.asarray(each, float) for each in (bearing.inner_groove_radius, bearing.outer_groove_radius))
    bottoms = bearing.inner_groove_centre_radius - inner, bearing.outer_groove_centre_radius + outer
    is_symmetric = bearing.kind == "deep_groove"
    return Grooves(*bottoms, inner, outer, is_symmetric, ring.elastic_modulus, ring.poisson_ratio)


class RingCompliance(NamedTuple):
    """How one ring deflects, by harmonics along the first axis."""

    by_load: NDArray
    """c_n: of the groove, away from the balls, under one radial load [m/N]."""
    seat: NDArray | None
    """Pressure at the seat by one radial load, per harmonic [Pa/N]; None where no seat is described."""


@dataclass(frozen=True)
class ElasticRings:
    """Ask for rings that deflect. SI units; any number but the compliances may be an array.

    Raises:
        SceneError: every error, at once.
    """

    outside_diameter: ArrayLike | None = field(default=None, metadata=given_in("mm", part=OUTER, printed=True))
    """Of the outer ring [m]."""
    outer_width: ArrayLike | None = field(default=None, metadata=given_in("mm", part=OUTER, printed="width"))
    """Of the outer ring, axially [m]."""
    outer_shoulder_diameter: ArrayLike | None = field(default=None, metadata=given_in("mm", part=OUTER, printed=True))
    """Of the shoulder on the side that contact angles above zero lean to [m]; None: no shoulder, which bends up to four
    times as far."""
    outer_open_diameter: ArrayLike | None = field(default=None, metadata=given_in("mm", part=OUTER))
    """Of the other shoulder [m]; None: in a deep-groove bearing as the first, in an angular-contact one no shoulder."""
    housing: str | None = None
    """What holds the outer ring: "rigid" or "free"; None with a housing's outside diameter."""
    housing_outside_diameter: ArrayLike | None = field(default=None, metadata=given_in("mm", part=HOUSING))
    """[m]"""
    housing_elastic_modulus: ArrayLike | None = field(default=None, metadata=given_in("GPa", part=HOUSING))
    """[Pa]; None, as for the rest of the material: as the rings."""
    housing_poisson_ratio: ArrayLike | None = field(default=None, metadata=given_in(part=HOUSING))
    """Of the housing; with its modulus [-]."""
    outer_compliance: tuple[float, ...] | None = field(
        default=None, metadata=given_in("um/N", part=HOUSING, is_list=True)
    )
    """In place of all of that: c_0, c_1, c_2, ... [m/N]; c_1 is that of the mount, 0 where it is rigid."""
    bore_diameter: ArrayLike | None = field(default=None, metadata=given_in("mm", part=INNER, printed=True))
    """Of the inner ring [m]."""
    inner_width: ArrayLike | None = field(default=None, metadata=given_in("mm", part=INNER, printed="width"))
    """[m]"""
    inner_shoulder_diameter: ArrayLike | None = field(default=None, metadata=given_in("mm", part=INNER, printed=True))
    """Of the inner ring's shoulder [m]."""
    inner_open_diameter: ArrayLike | None = field(default=None, metadata=given_in("mm", part=INNER))
    """Of the inner ring, as `outer_open_diameter` of the outer [m]."""
    shaft: str | None = None
    """What the inner ring sits on: "rigid", "free" or "solid"; None with a shaft's bore."""
    shaft_bore_diameter: ArrayLike | None = field(default=None, metadata=given_in("mm", part=SHAFT))
    """[m]"""
    shaft_elastic_modulus: ArrayLike | None = field(default=None, metadata=given_in("GPa", part=SHAFT))
    """Of a hollow shaft; None: as the rings [Pa]."""
    shaft_poisson_ratio: ArrayLike | None = field(default=None, metadata=given_in(part=SHAFT))
    """Likewise [-]."""
    inner_compliance: tuple[float, ...] | None = field(
        default=None, metadata=given_in("um/N", part=SHAFT, is_list=True)
    )
    """Of the inner ring, as `outer_compliance` of the outer."""
    housing_touches: ArrayLike | None = field(default=None, init=False, repr=False)
    """Set by the solver: 0 where a clearance stays open, so that the outer ring is free, else 1."""
    shaft_touches: ArrayLike | None = field(default=None, init=False, repr=False)
    """Set by the solver: 0 where a clearance stays open, so that the ring is free, else 1."""
    name: ClassVar[str] = "elastic_rings"

    def __post_init__(self) -> None:
        for name in ("outer_compliance", "inner_compliance"):
            given = getattr(self, name)
            if given is not None and np.ndim(given) == 1:
                object.__setattr__(self, name, tuple(np.asarray(given).tolist()))
        raise_if_any(parameter_errors(self))

    @property
    def numbers(self) -> dict[str, Any]:
        """Those that may span cases, by name; None where not given."""
        return {name: value for name, value in vars(self).items() if not isinstance(value, str | tuple)}

    def errors(self, bearing: BallBearing) -> list[ErrorDetail]:
        """What does not suit this bearing: diameters that are no rings around its grooves."""
        return section_errors(self, grooves_of(bearing))

    def at_rest(self, fitted: bool) -> ElasticRings:
        """What of it a bearing has at rest and cold, before or after fitting: all."""
        return self

    def reshape(self, bearing: BallBearing, operation: Operation) -> BallBearing:
        """The bearing as it is: before it is loaded nothing deflects."""
        return bearing

    def compliances(self, grooves: Grooves) -> tuple[RingCompliance | None, RingCompliance | None]:
        """Of the inner and the outer ring; None for a rigid one."""
        if any(np.ndim(each) for each in (*self.numbers.values(), *grooves)):
            return self._compliances(grooves)
        return _known_compliances(self, Grooves(*map(float, grooves)))

    def _compliances(self, grooves: Grooves) -> tuple[RingCompliance | None, RingCompliance | None]:
        return self._inner(grooves), self._outer(grooves)

    def _outer(self, at: Grooves) -> RingCompliance | None:
        if self.outer_compliance is not None:
            return _tabled(self.outer_compliance)
        if self.outer_width is None or self.housing == RIGID:
            return None
        outside = _half(self.outside_diameter)
        housing = None
        if self.housing_outside_diameter is not None:
            material = _material(self.housing_elastic_modulus, self.housing_poisson_ratio, at)
            housing = Annulus(outside, _half(self.housing_outside_diameter), *material)
        height = self._bending_height("outer", outside - at.outer_bottom, at)

        def held(seat: Annulus | None) -> RingCompliance:
            def given(bottom: Any) -> RingCompliance:
                compliance = outer_ring_compliance(Annulus(bottom, outside, at.modulus, at.poisson_ratio), seat)
                return _given(compliance, bottom, self.outer_width, at.modulus, None if seat is None else outside)

            return _grown_and_bent(given(at.outer_bottom), None if height is None else given(outside - height))

        return _touching(self.housing_touches, held, housing)

    def _inner(self, at: Grooves) -> RingCompliance | None:
        if self.inner_compliance is not None:
            return _tabled(self.inner_compliance)
        if self.inner_width is None or self.shaft == RIGID:
            return None
        bore, shaft = _half(self.bore_diameter), None
        if self.shaft != FREE:
            material = _material(self.shaft_elastic_modulus, self.shaft_poisson_ratio, at)
            hollow = 0.0 if self.shaft == SOLID else _half(self.shaft_bore_diameter)
            shaft = Annulus(hollow, bore, *material)
        height = self._bending_height("inner", at.inner_bottom - bore, at)

        def held(seat: Annulus | None) -> RingCompliance:
            def given(bottom: Any) -> RingCompliance:
                compliance = inner_ring_compliance(Annulus(bore, bottom, at.modulus, at.poisson_ratio), seat)
                return _given(compliance, bottom, self.inner_width, at.modulus, None if seat is None else bore)

            return _grown_and_bent(given(at.inner_bottom), None if height is None else given(bore + height))

        return _touching(self.shaft_touches, held, shaft)

    def _bending_height(self, side: str, thickness: Any, at: Grooves) -> NDArray | None:
        """Of the section with its shoulders, given as diameters; None where no shoulder is."""
        shoulder, opposite = (getattr(self, f"{side}_{name}_diameter") for name in ("shoulder", "open"))
        if shoulder is None:
            return None
        bottom, groove_radius = getattr(at, f"{side}_bottom"), getattr(at, f"{side}_groove")
        first = np.abs(bottom - _half(shoulder))
        other = first * float(at.is_symmetric) if opposite is None else np.abs(bottom - _half(opposite))
        return bending_height(thickness, getattr(self, f"{side}_width"), groove_radius, (first, other))


@lru_cache(maxsize=32)
def _known_compliances(rings: ElasticRings, grooves: Grooves) -> tuple[RingCompliance | None, RingCompliance | None]:
    """Of a single case: asked for by every solve and reading, and slower to find than to solve the case."""
    return rings._compliances(grooves)


def _half(diameter: Any) -> NDArray:
    return 0.5 * np.asarray(diameter, float)


def _grown_and_bent(grown: RingCompliance, bent: RingCompliance | None) -> RingCompliance:
    """n = 0 and 1 of the one, all else of the other."""
    if bent is None:
        return grown

    def joined(first: NDArray, rest: NDArray) -> NDArray:
        cases = max(first.ndim, rest.ndim) - 1
        first, rest = np.broadcast_arrays(_with_axes(first, cases), _with_axes(rest, cases))
        return np.concatenate([first[:2], rest[2:]])

    seat = None if grown.seat is None or bent.seat is None else joined(grown.seat, bent.seat)
    return RingCompliance(joined(grown.by_load, bent.by_load), seat)


def _touching(touches: Any, held: Callable[[Annulus | None], RingCompliance], seat: Annulus | None) -> RingCompliance:
    """On its seat where it touches it, free elsewhere."""
    on_seat = held(seat)
    if touches is None or on_seat.seat is None:
        return on_seat
    is_free = np.asarray(touches) == 0.0
    free = held(None).by_load
    axes = max(is_free.ndim, free.ndim - 1, on_seat.by_load.ndim - 1)
    by_load, free, pressed = (_with_axes(each, axes) for each in (on_seat.by_load, free, on_seat.seat))
    return RingCompliance(np.where(is_free, free, by_load), np.where(is_free, 0.0, pressed))


def _material(modulus: Any, poisson_ratio: Any, at: Grooves) -> tuple[Any, Any]:
    return (
        at.modulus if modulus is None else modulus,
        at.poisson_ratio if poisson_ratio is None else poisson_ratio,
    )


def _given(
    compliance: PressureCompliance, radius: Any, width: Any, modulus: Any, seat: NDArray | None
) -> RingCompliance:
    cases = np.broadcast_shapes(compliance.groove.shape[1:], np.shape(radius), np.shape(width))
    compliance = PressureCompliance(
        *(np.broadcast_to(_with_axes(each, len(cases)), (len(each), *cases)) for each in compliance)
    )
    moved = by_load(of_section(compliance.groove, radius, modulus), radius, width)
    if seat is None:
        return RingCompliance(moved, None)
    pressed = compliance.seat.copy()
    pressed[1] = np.asarray(radius, float) / seat  # the resultant goes through, by pressure alone
    return RingCompliance(moved, by_load(pressed, radius, width))


def _with_axes(by_harmonic: NDArray, cases: int) -> NDArray:
    """With axes of one case before those it has, so that it has as many."""
    return by_harmonic.reshape(len(by_harmonic), *(1,) * (cases + 1 - by_harmonic.ndim), *by_harmonic.shape[1:])


def _tabled(compliance: tuple[float, ...]) -> RingCompliance:
    by_harmonic = np.zeros(MOST_HARMONICS + 1)
    by_harmonic[: len(compliance)] = compliance
    return RingCompliance(by_harmonic, None)


def aliased(by_harmonic: NDArray, ball_count: NDArray, wave_numbers: int) -> NDArray:
    """c as balls at equal distances feel it, (case, wave): the sum over all n that are a wave but for multiples of Z.

    Args:
        by_harmonic: (harmonic, case); ball_count: (case).
        wave_numbers: how many are kept, from 0 on; of balls more than twice as many, the shorter ones are left out.
    """
    out = np.zeros((ball_count.size, wave_numbers))
    case = np.arange(ball_count.size)
    for n, c in enumerate(by_harmonic):
        rest = n % ball_count
        wave = np.minimum(rest, ball_count - rest)
        kept = wave < wave_numbers
        out[case[kept], wave[kept]] += c[kept]
    return out


def deflections_at_balls(
    compliances: tuple[RingCompliance | None, RingCompliance | None], azimuth: NDArray, inner: NDArray, outer: NDArray
) -> NDArray:
    """By how much the grooves part at each ball under radial loads (*cases, ball) on both rings [m]."""
    apart = np.nan_to_num(azimuth[..., :, None] - azimuth[..., None, :])
    total = np.zeros(azimuth.shape)
    for compliance, load in zip(compliances, (inner, outer), strict=True):
        for n in range(0 if compliance is None else MOST_HARMONICS + 1):
            assert compliance is not None
            moved = np.einsum("...ji,...i->...j", np.cos(n * apart), np.nan_to_num(load))
            total = total + np.asarray(compliance.by_load[n])[..., None] * moved
    return total


def _largest_deflection(point: OperatingPoint) -> NDArray:
    """Under the loads as they are, without the rings' own relief: far too much where radial loads bend them."""
    rings = next(one for one in point.full_scene.ring_effects if isinstance(one, ElasticRings))
    radial = [np.asarray(each.load * each.cosine) for each in (point.solution.inner, point.solution.outer)]
    known = rings.compliances(grooves_of(point.bearing))
    deflections = deflections_at_balls(known, np.asarray(point.solution.azimuth), *radial)
    return np.asarray(np.abs(deflections).max(axis=-1))


def _errors(point: OperatingPoint) -> Errors:
    if not any(isinstance(one, ElasticRings) for one in point.full_scene.ring_effects):
        return {name: np.zeros(point.solution.shape) for name in QUANTITIES}
    return geometry_errors(point, GeometryChange(-_largest_deflection(point), 0.0))


def _usual(of: Any, points: list[OperatingPoint]) -> list[Assumed]:
    """An outer ring in a steel housing, and free; in the housing that ring expansion gives, where it gives one. Inner
    rings sit on shafts, which hold them more stiffly."""
    origins = dict.fromkeys(ring_dimensions(*each).origin for each in bearings_of(of))
    what = f"an elastic outer ring of {' and '.join(origins)}"
    if all(_fitted(there) for _, there in bearings_of(of)):
        return [
            Assumed(
                "",
                f"{what} in the housing of ring_expansion",
                with_ring_effect(of, ElasticRings, partial(_outer, STEEL)),
            )
        ]
    both = f"{what}, in a steel housing {USUAL_HOUSING:g} times as large, then free"
    return [
        Assumed("steel housing", both, with_ring_effect(of, ElasticRings, partial(_outer, STEEL))),
        Assumed("free", both, with_ring_effect(of, ElasticRings, partial(_outer, None))),
    ]


def _fitted(there: tuple[Any, ...]) -> Any:
    """The ring expansion that fits the outer ring in a housing, where one does."""
    return next((one for one in there if getattr(one, "housing_interference", None) is not None), None)


def _outer(usual: Material | None, bearing: BallBearing, there: tuple[Any, ...]) -> ElasticRings:
    """An outer ring of the bearing's dimensions, in the housing known of it, else in a usual one, or free."""
    size, fitted = ring_dimensions(bearing, there), _fitted(there)
    ring = {
        "outside_diameter": size.outside,
        "outer_width": size.width,
        "outer_shoulder_diameter": size.shoulder,
        "outer_open_diameter": size.open_shoulder,
    }
    if fitted is not None:
        body, outside = fitted.housing_material or bearing.ring_material, fitted.housing_outside_diameter
    elif usual is not None:
        body, outside = usual, USUAL_HOUSING * size.outside
    else:
        return ElasticRings(**ring, housing=FREE)
    return ElasticRings(
        **ring,
        housing_outside_diameter=outside,
        housing_elastic_modulus=body.elastic_modulus,
        housing_poisson_ratio=body.poisson_ratio,
    )


ENTRY = Entry(
    "elastic_rings",
    "the deflection of the rings",
    effect("ring_effects", ElasticRings),
    indicator=error_in("contact_angle", _errors),
    errors=_errors,
    needs=given(ElasticRings, " with the rings' widths and diameters and how they are held"),
    needs_beside_size=given(ElasticRings, " with how the rings are held", housing=FREE),
    without_it="rings and their seats are taken as rigid; their deflection",
    assume=_usual,
    goes_with_friction=False,
)
