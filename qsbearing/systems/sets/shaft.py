"""What is around the rows of a set, as it is drawn: shaft, housing, spacers, sleeves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.described import A_MATERIAL, given_in, made_of
from qsbearing.model.effects.ring_expansion_errors import temperature_errors
from qsbearing.model.material import STEEL, Material, material_errors
from qsbearing.model.scene.preload import Preload
from qsbearing.model.units import zero_celsius
from qsbearing.model.validation import (
    FORCE,
    LENGTH,
    MOMENT,
    ErrorDetail,
    Field,
    Quantity,
    Sentence,
    raise_if_any,
    within,
)
from qsbearing.systems.sets.belts import Belt, belt_errors
from qsbearing.systems.sets.gears import Gear, gear_errors

STIFFNESS, TILT_STIFFNESS = Quantity("N/m"), Quantity("N m/rad")
MASS, INERTIA, ACCELERATION = Quantity("kg"), Quantity("kg m^2"), Quantity("m/s^2")
LOADS = (("axial", FORCE), ("radial_y", FORCE), ("radial_z", FORCE), ("moment_y", MOMENT), ("moment_z", MOMENT))
_SPRINGS = {STIFFNESS: ("axial", "radial_y", "radial_z"), TILT_STIFFNESS: ("tilt_y", "tilt_z")}
SPRINGS = tuple((name, quantity) for quantity, names in _SPRINGS.items() for name in names)
FARTHEST = 10.0
REFERENCE_TEMPERATURE = 20.0 + zero_celsius
"""At which lengths and diameters hold unless another is given [K]."""
STIFFEST = 1e18


@dataclass(frozen=True)
class ShaftSection:
    """A length of shaft between two steps, a cylinder or a cone; SI units, plain numbers."""

    length: float = field(metadata=given_in("mm"))
    """Along the shaft [m]."""
    outer_diameter: float = field(metadata=given_in("mm"))
    """Of a cone, where it begins [m]."""
    inner_diameter: float = field(default=0.0, metadata=given_in("mm"))
    """Of the bore [m]; of a cone, where it begins."""
    material: Material = field(default=STEEL, metadata=A_MATERIAL)
    end_outer_diameter: float | None = field(default=None, metadata=given_in("mm"))
    """Where it ends [m]; None: a cylinder."""
    end_inner_diameter: float | None = field(default=None, metadata=given_in("mm"))
    """Of the bore, where it ends [m]; None: a cylinder."""

    @property
    def is_conical(self) -> bool:
        """Whether a diameter changes along it."""
        return bool(np.ptp(self.outer_diameters) or np.ptp(self.inner_diameters))

    @property
    def outer_diameters(self) -> tuple[float, float]:
        """Where it begins and ends [m]."""
        end = self.end_outer_diameter
        return self.outer_diameter, self.outer_diameter if end is None else end

    @property
    def inner_diameters(self) -> tuple[float, float]:
        """Likewise [m]."""
        end = self.end_inner_diameter
        return self.inner_diameter, self.inner_diameter if end is None else end


@dataclass(frozen=True)
class ShaftLoad:
    """A load on the shaft at a position [m]; forces [N] and moments [N m], which may be arrays that span cases."""

    position: float = field(metadata=given_in("mm"))
    """Along the shaft [m]."""
    axial: ArrayLike = field(default=0.0, metadata=given_in("N"))
    """Along +x [N]."""
    radial_y: ArrayLike = field(default=0.0, metadata=given_in("N"))
    """Along +y [N]."""
    radial_z: ArrayLike = field(default=0.0, metadata=given_in("N"))
    """Along +z [N]."""
    moment_y: ArrayLike = field(default=0.0, metadata=given_in("N m"))
    """About +y [N m]."""
    moment_z: ArrayLike = field(default=0.0, metadata=given_in("N m"))
    """About +z [N m]."""

    @property
    def values(self) -> tuple[ArrayLike, ...]:
        """In the order of the channels [N, N m]."""
        return tuple(getattr(self, name) for name, _ in LOADS)


@dataclass(frozen=True)
class ShaftMass:
    """A body fixed to the shaft, as a point at a position [m]; SI units. Its inertia is that about its own centre."""

    position: float = field(metadata=given_in("mm"))
    """Along the shaft [m]."""
    mass: ArrayLike = field(metadata=given_in("kg"))
    """[kg]; may be an array that spans cases."""
    polar_inertia: float = field(default=0.0, metadata=given_in("kg m2"))
    """About the shaft [kg m^2]; for rotors only."""
    diametral_inertia: float = field(default=0.0, metadata=given_in("kg m2"))
    """About an axis across the shaft [kg m^2]; for rotors only."""


@dataclass(frozen=True)
class ShaftSupport:
    """Linear springs from shaft to ground, unstressed while the shaft is at its zero and straight; plain numbers."""

    position: float = field(metadata=given_in("mm"))
    """Along the shaft [m]."""
    axial: float = field(default=0.0, metadata=given_in("N/um"))
    """Against a displacement along x [N/m]."""
    radial_y: float = field(default=0.0, metadata=given_in("N/um"))
    """Against a displacement along y [N/m]."""
    radial_z: float = field(default=0.0, metadata=given_in("N/um"))
    """Against a displacement along z [N/m]."""
    tilt_y: float = field(default=0.0, metadata=given_in("kN m/rad"))
    """Against a tilt about y [N m/rad]."""
    tilt_z: float = field(default=0.0, metadata=given_in("kN m/rad"))
    """Against a tilt about z [N m/rad]."""

    @property
    def stiffness(self) -> NDArray:
        """Shape (5, 5) [N/m, N m/rad]."""
        return np.diag([float(getattr(self, name)) for name, _ in SPRINGS])


@dataclass(frozen=True)
class HousingStiffness:
    """The elastic support of an outer ring: linear springs about the plane of the balls' centres; None is rigid.

    Raises:
        SceneError: neither a stiffness, nor one that is positive; a matrix with others, or one that is not symmetric
            and positive definite.
    """

    axial: float | None = field(default=None, metadata=given_in("N/um"))
    """[N/m]"""
    radial: float | None = field(default=None, metadata=given_in("N/um"))
    """[N/m]"""
    tilt: float | None = field(default=None, metadata=given_in("kN m/rad"))
    """[N m/rad]"""
    matrix: ArrayLike | None = field(default=None, metadata=given_in("SI", is_list=True))
    """In place of the three, shape (5, 5), in the order x, y, z, tilt y, tilt z of the shaft's axes [SI]."""

    def __post_init__(self) -> None:
        raise_if_any(_housing_errors(self))

    @property
    def compliance(self) -> NDArray:
        """Inverse of the stiffness, 0 where it is rigid; shape (5, 5) [m/N, rad/N, rad/(N m)]."""
        if self.matrix is not None:
            return np.linalg.inv(np.asarray(self.matrix, float))
        each = (self.axial, self.radial, self.radial, self.tilt, self.tilt)
        return np.diag([0.0 if stiffness is None else 1.0 / stiffness for stiffness in each])


def _housing_errors(of: HousingStiffness) -> list[ErrorDetail]:
    springs = (("axial", STIFFNESS), ("radial", STIFFNESS), ("tilt", TILT_STIFFNESS))
    given = [(name, quantity) for name, quantity in springs if getattr(of, name) is not None]
    if (of.matrix is None) == (not given):
        problem = "has a matrix together with single stiffnesses" if given else "has no stiffness"
        names = {name: Field(f"housing_stiffness.{name}") for name, _ in springs}
        either = Sentence("Give {axial}, {radial} and {tilt}, or the whole matrix", **names)
        return [ErrorDetail("housing_stiffness", problem, cause=either)]
    errors = []
    for name, quantity in given:
        errors += within(f"housing_stiffness.{name}", getattr(of, name), quantity, 1.0, STIFFEST)
    if of.matrix is None:
        return errors
    matrix = np.asarray(of.matrix, float)
    is_one = matrix.shape == (5, 5) and np.isfinite(matrix).all() and bool(np.allclose(matrix, matrix.T, 1e-9, 0.0))
    if not is_one or np.linalg.eigvalsh(matrix)[0] <= 0.0:
        cause = "A symmetric, positive definite matrix of shape (5, 5), in N/m, N/rad and N m/rad"
        return [ErrorDetail("housing_stiffness.matrix", "is not a stiffness", cause=cause)]
    return errors


@dataclass(frozen=True)
class Housing:
    """The body around the outer rings, which expands along the shaft; SI units. Its temperature may be an array.

    Raises:
        SceneError: every error, at once.
    """

    temperature: ArrayLike | None = field(default=None, metadata=given_in("C"))
    """[K]; None: the reference temperature."""
    material: Material = field(default=STEEL, metadata=A_MATERIAL)
    reference_temperature: float = field(default=REFERENCE_TEMPERATURE, metadata=given_in("C"))
    """At which its dimensions hold [K]."""

    def __post_init__(self) -> None:
        errors = material_errors("housing.material", self.material) + _temperatures("housing", self)
        if self.temperature is not None and not errors and self.material.thermal_expansion is None:
            errors.append(
                ErrorDetail("housing.material.thermal_expansion", "missing", detail="the housing has a temperature")
            )
        raise_if_any(errors)

    @property
    def strain(self) -> NDArray:
        """alpha dT [-]."""
        if self.temperature is None:
            return np.zeros(())
        warmer = np.asarray(self.temperature, float) - self.reference_temperature
        return np.asarray(np.asarray(self.material.thermal_expansion, float) * warmer)


@dataclass(frozen=True)
class Spacer:
    """Sleeves between two rows, on the shaft and in the housing; SI units, lengths and temperatures may be arrays.

    If both lengths are given, their difference moves the inner rings further apart than the outer ones, and so presses
    or releases the pair. A single length only expands with temperature.

    Raises:
        SceneError: every error, at once.
    """

    rows: tuple[int, int] = field(metadata=made_of(int))
    """The two rows, which count from 1."""
    inner_length: ArrayLike | None = field(default=None, metadata=given_in("mm"))
    """[m]; None: there is none, the shaft parts the rows."""
    outer_length: ArrayLike | None = field(default=None, metadata=given_in("mm"))
    """[m]; None: there is none, the housing parts the rows."""
    inner_material: Material = field(default=STEEL, metadata=A_MATERIAL)
    outer_material: Material = field(default=STEEL, metadata=A_MATERIAL)
    inner_temperature: ArrayLike | None = field(default=None, metadata=given_in("C"))
    """[K]; None: as the shaft."""
    outer_temperature: ArrayLike | None = field(default=None, metadata=given_in("C"))
    """[K]; None: as the housing."""

    def __post_init__(self) -> None:
        errors: list[ErrorDetail] = []
        for side in ("inner", "outer"):
            length, temperature = getattr(self, f"{side}_length"), getattr(self, f"{side}_temperature")
            errors += [] if length is None else within(f"spacer.{side}_length", length, LENGTH, 0.0, FARTHEST)
            errors += material_errors(f"spacer.{side}_material", getattr(self, f"{side}_material"))
            errors += [] if temperature is None else temperature_errors(f"spacer.{side}_temperature", temperature)
        if self.inner_length is None and self.outer_length is None:
            errors.append(ErrorDetail("spacer", "has no length", cause="Give inner_length, outer_length or both"))
        raise_if_any(errors)


@dataclass(frozen=True)
class FloatingGroup:
    """Rows whose outer rings sit in one sleeve that slides along the housing; SI units. The spring may be an array.

    The housing holds the sleeve only radially: the axial loads of its rows add up to the force of the spring.

    Raises:
        SceneError: a force that is no number.
    """

    rows: tuple[int, ...] = field(metadata=made_of(int))
    """They count from 1."""
    spring: ArrayLike = field(default=0.0, metadata=given_in("N"))
    """Force of a spring on the sleeve, in +x [N]; it stays what it is. 0: the group floats."""
    preload: Preload | None = field(default=None, metadata=made_of(Preload))
    """That of its rows against each other; None: the set's."""

    def __post_init__(self) -> None:
        raise_if_any(within("floating.spring", self.spring, FORCE, -1e8, 1e8))


@dataclass(frozen=True)
class Shaft:
    """A shaft of round sections, end to end from `start` in +x; without sections it is rigid, and as long as it takes.
    SI units; its temperature, and the numbers of gears and belts, may be arrays.

    The set's positions are along it. Loads of the set's operation act at its reference position, those here where they
    say. With `gravity`, sections and masses have weight; rings and balls do not.

    Raises:
        SceneError: every error, at once.
    """

    sections: tuple[ShaftSection, ...] = field(default=(), metadata=made_of(ShaftSection))
    start: float = field(default=0.0, metadata=given_in("mm"))
    """Where the first section begins [m]."""
    loads: tuple[ShaftLoad, ...] = field(default=(), metadata=made_of(ShaftLoad))
    supports: tuple[ShaftSupport, ...] = field(default=(), metadata=made_of(ShaftSupport))
    points: Mapping[str, float] = field(default_factory=dict)
    """Positions [m] at which deflection and stiffness are asked, by their names, such as the tool's."""
    temperature: ArrayLike | None = field(default=None, metadata=given_in("C"))
    """[K]; None: the reference temperature."""
    reference_temperature: float = field(default=REFERENCE_TEMPERATURE, metadata=given_in("C"))
    """At which all lengths and diameters hold [K]."""
    masses: tuple[ShaftMass, ...] = field(default=(), metadata=made_of(ShaftMass))
    gravity: tuple[float, float, float] | None = field(default=None, metadata=given_in("m/s2", is_list=True))
    """Its acceleration along x, y, z [m/s^2]; None: nothing has weight."""
    gears: tuple[Gear, ...] = field(default=(), metadata=made_of(Gear))
    """Their forces depend on the set's speed where their power is given."""
    belts: tuple[Belt, ...] = field(default=(), metadata=made_of(Belt))

    def __post_init__(self) -> None:
        raise_if_any(list(_shaft_errors(self)))

    @cached_property
    def ends(self) -> NDArray:
        """Of the sections, from `start`; shape (section + 1,) [m]."""
        return self.start + np.concatenate([[0.0], np.cumsum([each.length for each in self.sections])])

    @property
    def standing(self) -> dict[str, tuple[Any, ...]]:
        """What stands on it at a position of its own, by what one of it is called."""
        return {
            "load": self.loads, "gear": self.gears, "belt": self.belts, "mass": self.masses, "support": self.supports,
        }  # fmt: skip

    @cached_property
    def strains(self) -> NDArray:
        """alpha dT of each section [-]; shape (..., section)."""
        if self.temperature is None:
            return np.zeros(len(self.sections))
        warmer = np.asarray(self.temperature, float) - self.reference_temperature
        return np.stack([warmer * float(each.material.thermal_expansion) for each in self.sections], axis=-1)  # type: ignore[arg-type]


def section_number(of: Shaft, position: ArrayLike) -> int:
    """Which section, from 0, a position is in; the later one of two that meet there."""
    number = int(np.searchsorted(of.ends, float(np.ravel(position)[0]), side="right")) - 1
    return min(max(number, 0), len(of.sections) - 1)


def diameter_at(of: Shaft, position: ArrayLike, side: str) -> float:
    """Its outer diameter, or that of its bore, the inner one [m]."""
    number = section_number(of, position)
    begin, end = getattr(of.sections[number], f"{side}_diameters")
    part = (float(np.ravel(position)[0]) - of.ends[number]) / of.sections[number].length
    return float(begin + part * (end - begin))


def _shaft_errors(of: Shaft) -> Iterator[ErrorDetail]:
    if not isinstance(of.sections, tuple):
        yield ErrorDetail("shaft.sections", "is not a tuple of sections", cause="Write (qs.ShaftSection(...), ...)")
        return
    broken = False
    for number, section in enumerate(of.sections, 1):
        path = f"shaft.section {number}"
        diameters = (("outer", 1e-4), ("inner", 0.0))
        given = [(f"{end}{side}_diameter", low) for end in ("", "end_") for side, low in diameters]
        errors = [
            *within(f"{path}.length", section.length, LENGTH, 1e-5, FARTHEST),
            *(
                error
                for name, low in given
                if getattr(section, name) is not None
                for error in within(f"{path}.{name}", getattr(section, name), LENGTH, low, FARTHEST)
            ),
            *material_errors(f"{path}.material", section.material),
        ]
        sides = zip(("", "end_"), section.inner_diameters, section.outer_diameters, strict=True)
        for end, inner, outer in () if errors else sides:
            if inner >= outer:
                where = end if section.end_inner_diameter is not None else ""
                problem = "is not within the outer diameter"
                errors = [ErrorDetail(f"{path}.{where}inner_diameter", problem, inner, LENGTH)]
        if of.temperature is not None and not errors and section.material.thermal_expansion is None:
            detail = "the shaft has a temperature"
            errors.append(ErrorDetail(f"{path}.material.thermal_expansion", "missing", detail=detail))
        broken |= bool(errors)
        yield from errors
    yield from within("shaft.start", of.start, LENGTH, -FARTHEST, FARTHEST)
    yield from _temperatures("shaft", of)
    yield from _mass_errors(of)
    for number, gear in enumerate(of.gears, 1):
        yield from gear_errors(f"shaft.gear {number}", gear)
    for number, belt in enumerate(of.belts, 1):
        yield from belt_errors(f"shaft.belt {number}", belt)
    numbers: tuple[tuple[str, Any, Any], ...] = (("load", of.loads, LOADS), ("support", of.supports, SPRINGS))
    for kind, each, channels in numbers:
        for number, one in enumerate(each, 1):
            for name, quantity in channels:
                low, high = (-1e9, 1e9) if kind == "load" else (0.0, STIFFEST)
                yield from within(f"shaft.{kind} {number}.{name}", getattr(one, name), quantity, low, high)
    if not broken:
        for kind, all_ in of.standing.items():
            yield from outside(of, [(f"shaft.{kind} {n}", one.position) for n, one in enumerate(all_, 1)])
        yield from outside(of, [(f"shaft.point {name}", position) for name, position in of.points.items()])


def _mass_errors(of: Shaft) -> Iterator[ErrorDetail]:
    """Of masses and weight; and of what a shaft without sections cannot have."""
    for number, one in enumerate(of.masses, 1):
        yield from within(f"shaft.mass {number}.mass", one.mass, MASS, 0.0, 1e6)
        for name in ("polar_inertia", "diametral_inertia"):
            yield from within(f"shaft.mass {number}.{name}", getattr(one, name), INERTIA, 0.0, 1e6)
    if of.gravity is not None:
        if np.shape(of.gravity) != (3,):
            cause = "Write three numbers, along x, y and z: (0.0, -9.81, 0.0)"
            yield ErrorDetail("shaft.gravity", "is not an acceleration", of.gravity, cause=cause)
        else:
            for value in of.gravity:
                yield from within("shaft.gravity", value, ACCELERATION, -1e4, 1e4)
        if not of.sections and not of.masses:
            yield ErrorDetail("shaft.gravity", "acts on nothing", cause="Give the shaft sections or masses")
    if of.temperature is not None and not of.sections:
        yield ErrorDetail("shaft.temperature", "is given, but the shaft has no sections", cause="They say its material")


def outside(of: Shaft, positions: list[tuple[str, Any]]) -> list[ErrorDetail]:
    """Errors of what does not stand on the shaft."""
    low, high = (float(of.ends[0]), float(of.ends[-1])) if of.sections else (-FARTHEST, FARTHEST)
    slack = 1e-9 * (high - low)
    problem = "is beyond the sections of the shaft, whose lengths add up from its start"
    return [
        error
        for path, position in positions
        for error in within(f"{path}.position", position, LENGTH, low - slack, high + slack, problem)
    ]


def _temperatures(path: str, of: Shaft | Housing) -> list[ErrorDetail]:
    given = [name for name in ("temperature", "reference_temperature") if getattr(of, name) is not None]
    return [error for name in given for error in temperature_errors(f"{path}.{name}", getattr(of, name))]


def with_loads(of: Shaft | None, factors: ArrayLike) -> Shaft | None:
    """A shaft under these multiples of its loads, torques of gears and belts among them."""
    if of is None:
        return None
    names = {"loads": [name for name, _ in LOADS], "gears": ["torque", "power"]}
    names["belts"] = [*names["gears"], "pretension"]
    scaled: Any = {kind: tuple(_times(each, own, factors) for each in getattr(of, kind)) for kind, own in names.items()}
    return replace(of, **scaled)


def _times(of: Any, names: list[str], factors: ArrayLike) -> Any:
    """With multiples of these numbers, where it has them."""
    given = {name: getattr(of, name) for name in names}
    return replace(
        of, **{name: np.asarray(value, float) * factors for name, value in given.items() if value is not None}
    )
