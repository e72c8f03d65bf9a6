"""From a scene to case records: every array field broadcast over the case axes, dimensions taken out."""

from __future__ import annotations

from functools import lru_cache
from math import prod, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.bearing import BearingKind, ball_mass, groove_centre_radius
from qsbearing.model.compiler.compiled import entry
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.contact.hertz import FORM_CODES, INNER_SIDE, OUTER_SIDE, effective_modulus, stiffness_at_angle
from qsbearing.model.effects.elastic_ring_errors import Grooves
from qsbearing.model.effects.elastic_rings import ElasticRings, aliased
from qsbearing.model.effects.entry import with_found
from qsbearing.model.effects.gyroscopic_moment import NO_BOUND, SHARES_CODES
from qsbearing.model.effects.hertz_angle import HertzAngle
from qsbearing.model.effects.orbit_radius import OrbitRadius
from qsbearing.model.effects.raceway_control import CONTROL_CODES
from qsbearing.model.effects.seats_out_of_round import SeatsOutOfRound
from qsbearing.model.effects.tilt_lever import TiltLever
from qsbearing.model.kernel.case import CASE, OWN_BALL
from qsbearing.model.kernel.workspace import MOST_WAVES
from qsbearing.model.material import Material
from qsbearing.model.operation import CHANNELS, Channel
from qsbearing.model.scene.scene import Scene


@entry(int, *[array_of(float)] * 6)
def _groove_stiffness(
    form: int, pitch: NDArray, inner_f: NDArray, outer_f: NDArray, cosine: NDArray, inner: NDArray, outer: NDArray
) -> None:
    for i in range(pitch.size):
        sine = np.sqrt(max(0.0, 1.0 - cosine[i] * cosine[i]))
        inner[i] = stiffness_at_angle(form, 1.0, pitch[i], inner_f[i], 1.0, sine, cosine[i], INNER_SIDE)[0]
        outer[i] = stiffness_at_angle(form, 1.0, pitch[i], outer_f[i], 1.0, sine, cosine[i], OUTER_SIDE)[0]


@entry(int, array_of(CASE), array_of(OWN_BALL, 2))
def _own_stiffness(form: int, cases: NDArray, own: NDArray) -> None:
    """The same for balls of their own diameters, in the case's unit, where they are unequal."""
    for k in range(cases.size):
        case = cases[k]
        if not case.unequal_balls:
            continue
        cosine = case.hertz_cosine
        sine = np.sqrt(max(0.0, 1.0 - cosine * cosine))
        for j in range(case.ball_count):
            ball = own[k, j]
            d, inner_f, outer_f = (
                ball.diameter,
                case.inner_coefficient / ball.diameter,
                case.outer_coefficient / ball.diameter,
            )
            pitch = case.pitch_diameter
            ball.inner_stiffness = stiffness_at_angle(form, d, pitch, inner_f, 1.0, sine, cosine, INNER_SIDE)[0]
            ball.outer_stiffness = stiffness_at_angle(form, d, pitch, outer_f, 1.0, sine, cosine, OUTER_SIDE)[0]


_PLAIN = (float, int, type(None))
_CHANGED = (
    *("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius"),
    *("free_contact_angle", "radial_interference"),
)
"""What ring effects change of a bearing."""


def case_arrays(scene: Scene) -> dict[str, Any]:
    """Every number of a scene that may span cases, by its field's name; None where the scene does not give it."""
    values = vars(scene.bearing) | vars(scene.operation)
    for effect in scene.ring_effects:
        if effect is scene.ball_diameter_deviations:
            continue  # by ball, which is no case axis
        numbers = {name: value for name, value in vars(effect).items() if not isinstance(value, Material | str | tuple)}
        values |= {f"{effect.name}.{name}": value for name, value in numbers.items()}
    del values["kind"], values["name"], values["outline"], values["inferred"]
    for body in ("ball", "ring"):
        material = values.pop(f"{body}_material")
        values[f"{body}_elastic_modulus"] = material.elastic_modulus
        values[f"{body}_poisson_ratio"] = material.poisson_ratio
        values[f"{body}_density"] = material.density
    gyroscopic = scene.gyroscopic_moment
    values["friction_coefficient"] = None if gyroscopic is None else gyroscopic.friction_coefficient
    if scene.traction is not None:
        values |= {f"traction.{each}": getattr(scene.traction, each) for each in ("friction_coefficient", "slip_speed")}
    return values


def _varying(values: dict[str, Any]) -> dict[str, NDArray]:
    """The values that vary over cases; numbers of other kinds (a fraction, a decimal) become floats in place."""
    arrays = {}
    for name, value in values.items():
        if isinstance(value, _PLAIN):
            continue  # at once, for most values are plain numbers
        if np.shape(value):
            arrays[name] = np.asarray(value, float)
        else:
            values[name] = float(value)
    return arrays


def _root(value: Any) -> Any:
    return sqrt(value) if isinstance(value, float) else np.sqrt(value)


@lru_cache(64)
def _sine_and_cosine_of(angle: float) -> tuple[float, float]:
    return float(np.sin(angle)), float(np.cos(angle))  # numpy's, as of arrays: the same digits


def _sine_and_cosine(angle: Any) -> tuple[Any, Any]:
    return _sine_and_cosine_of(angle) if isinstance(angle, float) else (np.sin(angle), np.cos(angle))


def _prescribed(channel: Channel, v: dict[str, Any], force: Any, diameter: Any) -> Any:
    """A channel's load or displacement in the case's units."""
    load, displacement = v[channel.load], v[channel.displacement]
    if displacement is not None:
        if channel is CHANNELS[0]:
            displacement = displacement - v["axial_datum_shift"]
        return displacement if channel.is_rotation else displacement / diameter
    if load is None:
        return 0.0
    return load / (force * diameter) if channel.is_rotation else load / force


@lru_cache(64)
def _stiffness_of_one(form: int, *geometry: float) -> tuple[float, ...]:
    return tuple(each.item() for each in _stiffness_of_many(form, geometry))


def _stiffness_of_many(form: int, geometry: tuple[Any, ...]) -> tuple[NDArray, NDArray, NDArray]:
    parts = np.array([np.atleast_1d(part) for part in np.broadcast_arrays(*geometry)], float)
    inner, outer = np.empty_like(parts[0]), np.empty_like(parts[0])
    _groove_stiffness(form, parts[0], parts[1], parts[2], parts[3], inner, outer)
    return inner, outer, (inner ** (-2.0 / 3.0) + outer ** (-2.0 / 3.0)) ** -1.5


def _stiffness(form: int, *geometry: Any) -> tuple[Any, ...]:
    """K of the inner contact, of the outer one and of both in series, of pitch, groove radii and the angle's cosine.

    One evaluation, kept, where the bearing does not vary, which is most often.
    """
    if all(isinstance(part, float) for part in geometry):
        return _stiffness_of_one(form, *geometry)
    return _stiffness_of_many(form, geometry)


COMMON_MOTION = ("common_orbit", "common_axial_rotation", "common_radial_rotation")


class CaseMaker:
    """Flattens a scene to case records, any stretch of its cases at a time (a million need not exist at once).

    Args:
        scene: what to flatten.
        axial: the axial load or displacement that the scene's preload makes, under the name of its field.
        motion: of balls that all move alike, `COMMON_MOTION` [rad/s].

    Raises:
        ValueError: the scene's array fields do not broadcast to common case axes.
    """

    def __init__(
        self, scene: Scene, axial: dict[str, Any] | None = None, motion: dict[str, NDArray] | None = None
    ) -> None:
        self.scene, self.axial = scene, axial or {}
        self.motion = motion or {}
        """Of balls that all move alike; empty where each has its own."""
        self._values = case_arrays(scene) | self.axial | self.motion
        self._values["axial_datum_shift"] = 0.0
        self._values["cold_ball_diameter"] = scene.bearing.ball_diameter
        if scene.is_reshaped:
            self._values |= {name: getattr(scene.operating_bearing, name) for name in _CHANGED}
            self._values["axial_datum_shift"] = scene.axial_datum_shift
        deviations = scene.ball_diameter_deviations if scene.ring_effects else None
        self._deviations = None if deviations is None else deviations.array
        self._rings = scene.elastic_rings if scene.ring_effects else None
        self._seats = scene.seats_out_of_round if scene.ring_effects else None
        self._arrays = _varying(self._values)
        self.shape = self._common_shape()
        """The leading case axes: all array fields broadcast together."""
        self.count = prod(self.shape)
        counts = self._arrays.get("ball_count")
        self.ball_axis = int(self._values["ball_count"] if counts is None else counts.max())
        """Length of the ball axis: the largest ball count."""

    def _common_shape(self) -> tuple[int, ...]:
        named = {name: array.shape for name, array in self._arrays.items()}
        if self._deviations is not None:
            named["ball_diameter_deviations"] = self._deviations.shape[:-1]
        if not named:
            return ()
        try:
            return np.broadcast_shapes(*named.values())
        except ValueError:
            raise ValueError(f"the scene's array fields do not broadcast to common case axes: {named}") from None

    def _stretch(self, start: int, stop: int) -> dict[str, Any]:
        """All fields over these cases: plain numbers where they do not vary."""
        if not self._arrays:
            return self._values
        values = dict(self._values)
        index = np.unravel_index(np.arange(start, stop), self.shape)
        for name, array in self._arrays.items():
            values[name] = np.broadcast_to(array, self.shape)[index]
        return values

    @property
    def with_own_motion(self) -> CaseMaker:
        """The same with each ball's own motion."""
        return CaseMaker(self.scene, self.axial)

    @property
    def free_channels(self) -> NDArray:
        """Numbers of the channels whose load is prescribed."""
        return np.array([i for i, each in enumerate(CHANNELS) if self._values[each.displacement] is None], int)

    @property
    def position_size(self) -> int:
        """How many numbers the kernel keeps of a ball's position: with elastic rings, how far they deflect there."""
        return 3 if self._rings is None else 4

    def shims(self) -> NDArray:
        """Of arched rings, inner and outer (case, 2), over the ball diameter; -1 for one arc. Empty without any."""
        if not self.scene.bearing.is_arched:
            return np.empty((self.count, 0))
        v = self._stretch(0, self.count)
        parts = [-1.0 if v[name] is None else v[name] / v["ball_diameter"] for name in ("inner_shim", "outer_shim")]
        return np.stack([np.broadcast_to(each, self.count) for each in parts], axis=-1).astype(float)

    def axial_datum_shift(self) -> NDArray | float:
        """By how much further the ring touches than at rest and cold [m], of each flattened case; see `Scene`."""
        shift = self._values["axial_datum_shift"]
        return shift if np.ndim(shift) == 0 else np.broadcast_to(shift, self.shape).reshape(-1)

    def make(self, start: int = 0, stop: int | None = None, into: NDArray | None = None) -> NDArray:
        """Case records of the flattened cases [start, stop), in an array of their own or in this one."""
        stop = self.count if stop is None else stop
        v = self._stretch(start, stop)
        numbers = self._numbers(v, self.has_unequal_balls(start, stop), self._is_out_of_round(v))
        cases = np.empty(stop - start, CASE) if into is None else into
        if not self.shape and self._deviations is None:
            cases[0] = numbers  # at once: a third of the time that the fields take one by one
            return cases
        for name, number in zip(CASE.fields or (), numbers, strict=True):
            if isinstance(number, tuple):
                for i, each in enumerate(number):
                    cases[name][:, i] = each
            else:
                cases[name] = number
        return cases

    def _numbers(
        self, v: dict[str, Any], unequal_balls: NDArray | bool, out_of_round: NDArray | bool
    ) -> tuple[Any, ...]:
        """A case's fields in their order, numbers or arrays over these cases, from the scene's fields."""
        scene = self.scene
        diameter = v["ball_diameter"]
        modulus = effective_modulus(
            v["ball_elastic_modulus"], v["ball_poisson_ratio"], v["ring_elastic_modulus"], v["ring_poisson_ratio"]
        )
        force = modulus * diameter * diameter
        mass = ball_mass(v["ball_density"], v["cold_ball_diameter"])
        speed = _root(force / (mass * diameter))
        pitch = v["pitch_diameter"] / diameter
        inner_f = v["inner_groove_radius"] / diameter
        outer_f = v["outer_groove_radius"] / diameter
        sin_free, cos_free = _sine_and_cosine(v["free_contact_angle"])
        interference = v["radial_interference"] / diameter
        is_exact = scene.tilt_lever is TiltLever.GROOVE_CENTRE
        hertz_cosine = 1.0 if scene.hertz_angle is HertzAngle.ZERO else cos_free
        gyroscopic = scene.gyroscopic_moment
        coefficient = v["friction_coefficient"]
        return (
            v["ball_count"],
            pitch,
            inner_f,
            outer_f,
            sin_free,
            cos_free,
            unequal_balls,
            self._rings is not None,
            out_of_round,
            interference,
            groove_centre_radius(pitch, inner_f, 1.0, cos_free, interference) if is_exact else 0.5 * pitch,
            hertz_cosine,
            *_stiffness(FORM_CODES[scene.hertz_form], pitch, inner_f, outer_f, hertz_cosine),
            v["first_ball_azimuth"],
            v["speed"] / speed,
            0.0 if v["outer_speed"] is None else v["outer_speed"] / speed,
            tuple([_prescribed(channel, v, force, diameter) for channel in CHANNELS]),
            tuple([v[channel.displacement] is not None for channel in CHANNELS]),
            scene.centrifugal_force is not None,
            gyroscopic is not None,
            NO_BOUND if coefficient is None else coefficient,
            scene.orbit_radius is OrbitRadius.DISPLACED,
            "common_orbit" in v,
            *(v.get(name, 0.0) / speed for name in COMMON_MOTION),
            scene.hertz_angle is HertzAngle.ACTUAL,
            scene.bearing.kind is BearingKind.ANGULAR_CONTACT,
            0 if scene.raceway_control is None else CONTROL_CODES[scene.raceway_control],
            0 if gyroscopic is None else SHARES_CODES[gyroscopic.moment_shares],
            FORM_CODES[scene.hertz_form],
            diameter,
            force,
            speed,
        )

    def has_unequal_balls(self, start: int, stop: int) -> NDArray | bool:
        """Which of the flattened cases [start, stop) do; False where the scene names no unequal balls."""
        return False if self._deviations is None else (self._deviations_of(start, stop) != 0.0).any(axis=-1)

    def _is_out_of_round(self, v: dict[str, Any]) -> NDArray | bool:
        """Which of the cases with these fields are; False where the scene names no seats out of round."""
        return False if self._seats is None else self._lobes(v).is_out_of_round

    def _lobes(self, v: dict[str, Any]) -> SeatsOutOfRound:
        """The seats of the cases with these fields."""
        assert self._seats is not None
        if not self._arrays:
            return self._seats
        given = {name: v[f"{self._seats.name}.{name}"] for name in vars(self._seats)}
        lobes: SeatsOutOfRound = with_found(self._seats, given)
        return lobes

    def has_uneven_balls(self, start: int, stop: int) -> NDArray | bool:
        """Which of the flattened cases [start, stop) have balls that make nothing symmetric."""
        unequal = self.has_unequal_balls(start, stop)
        return unequal if self._seats is None else unequal | self._is_out_of_round(self._stretch(start, stop))

    def _deviations_of(self, start: int, stop: int) -> NDArray:
        """Of the balls' diameters (case, ball) [m]."""
        assert self._deviations is not None
        array = np.broadcast_to(self._deviations, (*self.shape, self.ball_axis))
        if not self.shape:
            return array[None]
        return array[np.unravel_index(np.arange(start, stop), self.shape)]

    def own_balls(self, cases: NDArray, start: int = 0) -> NDArray:
        """Records (case, ball) of the balls of these case records, the first of which is this flattened case.

        Empty but for its first axis where the scene names neither unequal balls nor elastic rings nor seats out of
        round.
        """
        is_empty = self._deviations is None and self._rings is None and self._seats is None
        own = np.empty((cases.size, 0 if is_empty else self.ball_axis), OWN_BALL)
        stop = start + cases.size
        if self._rings is not None:
            self._fill_compliances(cases, own, self._rings, self._stretch(start, stop))
        if self._deviations is not None:
            nominal = np.asarray(self._stretch(start, stop)["cold_ball_diameter"], float)
            # Balls that have grown by heat differ by as much more: the ratio to the bearing's diameter stays.
            own["diameter"] = 1.0 + self._deviations_of(start, stop) / nominal[..., None]
            _own_stiffness(FORM_CODES[self.scene.hertz_form], cases, own)
        if self._seats is not None:
            count, first = cases["ball_count"][:, None], cases["first_azimuth"][:, None]
            azimuth = first + 2.0 * np.pi * np.arange(self.ball_axis) / count
            own["lobe"] = self._lobes(self._stretch(start, stop)).apart(azimuth) / cases["length"][:, None]
        return own

    def _fill_compliances(self, cases: NDArray, own: NDArray, rings: ElasticRings, v: dict[str, Any]) -> None:
        """Compliances of elastic rings, by wave number, where the records of as many balls stand."""
        inner = groove_centre_radius(
            v["pitch_diameter"], v["inner_groove_radius"], v["ball_diameter"], np.cos(v["free_contact_angle"]),
            v["radial_interference"],
        )  # fmt: skip
        distance = v["inner_groove_radius"] + v["outer_groove_radius"] - v["ball_diameter"]
        outer = inner - distance * np.cos(v["free_contact_angle"]) - v["radial_interference"]
        bottoms = inner - v["inner_groove_radius"], outer + v["outer_groove_radius"]
        radii = v["inner_groove_radius"], v["outer_groove_radius"]
        is_symmetric = self.scene.bearing.kind is BearingKind.DEEP_GROOVE
        grooves = Grooves(*bottoms, *radii, is_symmetric, v["ring_elastic_modulus"], v["ring_poisson_ratio"])
        given = {name: v[f"{rings.name}.{name}"] for name in rings.numbers}
        wave_numbers = min(MOST_WAVES + 1, self.ball_axis)
        for side, compliance in zip(("inner", "outer"), with_found(rings, given).compliances(grooves), strict=True):
            own[f"{side}_compliance"] = 0.0
            if compliance is not None:
                by_harmonic = np.broadcast_to(
                    compliance.by_load.reshape(len(compliance.by_load), -1), (len(compliance.by_load), cases.size)
                )
                by_wave = aliased(by_harmonic * cases["force"] / cases["length"], cases["ball_count"], wave_numbers)
                own[f"{side}_compliance"][:, :wave_numbers] = by_wave
