"""Scenes under test: the drawing of a bearing, and what `qsbearing` says of it at its operating points."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from contextvars import ContextVar
from dataclasses import dataclass
from functools import lru_cache
from math import asin, pi, sin
from typing import Any, TypeVar

import numpy as np

import qsbearing
from fem_check.independent.contact_problem import ElasticConstants
from fem_check.independent.drawing import BearingDrawing
from fem_check.independent.groove import RACES, BallInGroove
from fem_check.independent.ring_growth import LameRing, elastic_growth
from fem_check.independent.ring_sections import DIMENSIONS, RingSections, SectionError
from fem_check.rows.agreement import EXAMPLE
from qsbearing.files import catalogue
from qsbearing.files.bearing_table import MODIFIED
from qsbearing.files.scene_or_set import load_scene_or_set
from qsbearing.model.contact.hertz import STATIC_PRESSURE

AnySolution = TypeVar("AnySolution", qsbearing.Solution, qsbearing.SetSolution)


ROW = "row "
"""The label of a set's row begins so."""

RING_OPTIONS: ContextVar[dict[str, float | None]] = ContextVar("RING_OPTIONS", default={})  # noqa: B039 - never changed
"""Ring dimensions that the command line gives, by the names of `ring_sections.DIMENSIONS` [m]."""


class SceneProblemError(Exception):
    """A scene gives no contact; the message says why."""


@dataclass(frozen=True)
class SolvedPoint:
    """A scene at one operating point, solved by the quasi-static model."""

    label: str
    solution: qsbearing.Solution


def load(source: str) -> qsbearing.Scene | qsbearing.BearingSet:
    """What a file or a catalogue entry describes: a bearing, or a set of rows on one shaft.

    Raises:
        SceneProblemError: it cannot be read; the message has every error.
    """
    try:
        return load_scene_or_set(source)
    except (OSError, ValueError, KeyError) as problem:
        raise SceneProblemError(f"scene {source}: {problem}") from problem


def load_scene(source: str) -> qsbearing.Scene:
    """The scene of a file or of a catalogue entry; of a set, its first row where the set's equilibrium has it.

    Raises:
        SceneProblemError: it cannot be read; the message has every error.
    """
    scene_or_set = load(source)
    return scene_or_set if isinstance(scene_or_set, qsbearing.Scene) else solved(source)[0].solution.scene


def drawing_of(scene: qsbearing.Scene, name: str) -> BearingDrawing:
    """The dimensions and materials of a scene's bearing in operation: as drawn, grown as its ring effects say.

    Raises:
        SceneProblemError: a field holds several values; a contact needs a single bearing.
    """
    drawing = drawing_at_rest(scene, name)
    growth: dict[str, float] = {}
    for effect in scene.ring_effects:
        if isinstance(effect, qsbearing.RingExpansion):
            growth |= _ring_growth(effect, scene, drawing, name)
    if ball := heat_strains(scene, name)["ball"]:
        growth["ball"] = ball * drawing.ball_diameter
    return drawing.grown(**growth) if growth else drawing


def drawing_at_rest(scene: qsbearing.Scene, name: str) -> BearingDrawing:
    """The same at rest and cold, without fits."""
    bearing = scene.bearing

    def constants(material: Any, field: str) -> ElasticConstants:
        return ElasticConstants(
            _number(material.elastic_modulus, name, f"{field}.elastic_modulus"),
            _number(material.poisson_ratio, name, f"{field}.poisson_ratio"),
        )

    lengths = ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius", "free_contact_angle")
    return BearingDrawing(
        name=bearing.name or name,
        **{field: _number(getattr(bearing, field), name, field) for field in lengths},
        ball=constants(bearing.ball_material, "ball_material"),
        ring=constants(bearing.ring_material, "ring_material"),
        ball_density=_number(bearing.ball_material.density, name, "ball_material.density"),
        interference=_number(bearing.radial_interference, name, "radial_interference"),
    )


def axial_growth(scene: qsbearing.Scene, name: str) -> tuple[float, float]:
    """By how much heat moves the inner and the outer groove's centre axially from the plane of the balls' centres [m].

    Each keeps its distance from there, but for the heat of its own ring.
    """
    drawing, strains = drawing_at_rest(scene, name), heat_strains(scene, name)
    inner, outer = (
        strains[f"{race}_ring"]
        * (getattr(drawing, f"{race}_groove_radius") - 0.5 * drawing.ball_diameter)
        * sin(drawing.free_contact_angle)
        for race in ("inner", "outer")
    )
    return inner, outer


def heat_strains(scene: qsbearing.Scene, name: str) -> dict[str, float]:
    """alpha dT of inner_ring, outer_ring, shaft, housing and ball.

    A ring whose temperature is left out is at the reference temperature, shaft and housing are as warm as their rings,
    balls as warm as the mean of both rings.
    """
    ring = scene.bearing.ring_material
    materials = {"inner_ring": ring, "outer_ring": ring, "shaft": ring, "housing": ring}
    materials["ball"] = scene.bearing.ball_material
    warmer: dict[str, float] = {}
    for effect in scene.ring_effects:
        if isinstance(effect, qsbearing.RingExpansion):
            materials |= {"shaft": effect.shaft_material or ring, "housing": effect.housing_material or ring}
            for body, on in (
                ("inner_ring", ""),
                ("outer_ring", ""),
                ("shaft", "inner_ring"),
                ("housing", "outer_ring"),
            ):
                given = getattr(effect, f"{body}_temperature")
                reference = _number(effect.reference_temperature, name)
                warmer[body] = warmer.get(on, 0.0) if given is None else _number(given, name) - reference
    warmer["ball"] = 0.5 * (warmer.get("inner_ring", 0.0) + warmer.get("outer_ring", 0.0))
    for effect in scene.ring_effects:
        if isinstance(effect, qsbearing.BallExpansion):
            warmer["ball"] = _number(effect.ball_temperature, name) - _number(effect.reference_temperature, name)
    return {body: _strain(material, warmer.get(body, 0.0), name) for body, material in materials.items()}


def _number(value: Any, name: str, field: str = "a number") -> float:
    array = np.asarray(value, dtype=float)
    if array.size != 1:
        raise SceneProblemError(f"scene {name}: {field} holds {array.size} values; one contact needs a single bearing")
    return float(array.ravel()[0])


def _strain(material: Any, warmer: float, name: str) -> float:
    return 0.0 if material.thermal_expansion is None else _number(material.thermal_expansion, name) * warmer


def _ring_growth(
    effect: qsbearing.RingExpansion, scene: qsbearing.Scene, drawing: BearingDrawing, name: str
) -> dict[str, float]:
    """Of both groove radii and both circles of groove centres [m]."""
    operation, ring_material, strains = scene.operation, scene.bearing.ring_material, heat_strains(scene, name)
    speeds = {"inner": _number(operation.speed, name), "outer": _number(operation.outer_speed or 0.0, name)}

    def body(what: str, material: Any, bore: float, outside: float, speed: float) -> LameRing:
        return LameRing(
            bore, outside, _number(material.elastic_modulus, name), _number(material.poisson_ratio, name),
            _number(material.density, name), speed, strains[what],
        )  # fmt: skip

    bore, outside = 0.5 * _number(effect.bore_diameter, name), 0.5 * _number(effect.outside_diameter, name)
    centres = {"inner": drawing.inner_groove_centre_radius, "outer": drawing.outer_groove_centre_radius}
    bottoms = {
        "inner": centres["inner"] - drawing.inner_groove_radius,
        "outer": centres["outer"] + drawing.outer_groove_radius,
    }
    seats: dict[str, tuple[LameRing | None, float]] = {"inner": (None, 0.0), "outer": (None, 0.0)}
    if effect.shaft_interference is not None:
        hollow = 0.0 if effect.shaft_bore_diameter is None else 0.5 * _number(effect.shaft_bore_diameter, name)
        shaft = body("shaft", effect.shaft_material or ring_material, hollow, bore, speeds["inner"])
        seats["inner"] = shaft, _number(effect.shaft_interference, name)
    if effect.housing_interference is not None:
        end = 0.5 * _number(effect.housing_outside_diameter, name)
        housing = body("housing", effect.housing_material or ring_material, outside, end, speeds["outer"])
        seats["outer"] = housing, _number(effect.housing_interference, name)
    growth = {}
    for race, ends in (("inner", (bore, bottoms["inner"])), ("outer", (bottoms["outer"], outside))):
        ring = body(f"{race}_ring", ring_material, *ends, speeds[race])
        # Pressure and rotation strain a ring that heat has grown.
        elastic = elastic_growth(ring, bottoms[race], *seats[race]) * (1.0 + ring.strain)
        growth[f"{race}_centre"] = elastic + ring.strain * centres[race]
        growth[f"{race}_radius"] = ring.strain * getattr(drawing, f"{race}_groove_radius")
    return growth


def ring_sections(scene: qsbearing.Scene, name: str) -> RingSections:
    """The bearing's ring sections as far as they are known: by option, by the scene's own tables, by the catalogue,
    by a data sheet or designation.

    Raises:
        SceneProblemError: they make no rings of this bearing.
    """
    own: dict[str, float | None] = {}
    tables: list[Mapping[str, Any]] = [
        vars(each) for each in scene.ring_effects if isinstance(each, qsbearing.RingExpansion)
    ]
    tables += [scene.readings.get(each, {}) for each in ("friction_estimate", "overrun")]
    for table in tables:
        for dimension in DIMENSIONS:
            if own.get(dimension) is None and table.get(dimension) is not None:
                own[dimension] = _number(table[dimension], name, dimension)
    drawing = drawing_at_rest(scene, name)
    is_symmetric = scene.bearing.kind is qsbearing.BearingKind.DEEP_GROOVE
    of_catalogue = _of_catalogue(drawing)
    sections = RingSections.of(
        ("option", RING_OPTIONS.get()), ("scene", own), ("catalogue", of_catalogue),
        ("data sheet or designation", _of_outline(scene)), is_symmetric=is_symmetric,
    )  # fmt: skip
    try:
        return sections.checked(drawing)
    except SectionError as problem:
        raise SceneProblemError(f"scene {name}: {problem}") from problem


def _of_catalogue(drawing: BearingDrawing) -> dict[str, float]:
    """Of the entry that a bearing is, whatever its materials and grooves."""
    entry = catalogue.find(drawing.name.removesuffix(MODIFIED))
    if entry is None:
        return {}
    same = all(
        abs(entry.bearing[f"{field}_mm"] * qsbearing.mm - getattr(drawing, field)) < 1e-9
        for field in ("ball_diameter", "pitch_diameter")
    )
    known = {name: entry.dimensions.get(f"{name}_mm") for name in DIMENSIONS}
    return {name: value * qsbearing.mm for name, value in known.items() if value is not None} if same else {}


def _of_outline(scene: qsbearing.Scene) -> dict[str, float]:
    """Of a bearing that is not the catalogue's, whose outline it would keep when changed."""
    outline = scene.bearing.outline
    if outline is None or catalogue.find((scene.bearing.name or "").removesuffix(MODIFIED)) is not None:
        return {}
    return {name: float(np.ravel(value)[0]) for name, value in vars(outline).items() if value is not None}


def beyond_thrust(solution: qsbearing.Solution) -> list[str]:
    """What a bearing carries beside its thrust, and a sector of one ball, the same all round, leaves out."""
    channels = (("radial load y", "N"), ("radial load z", "N"), ("moment y", "N m"), ("moment z", "N m"))
    load = np.asarray(solution.load, float).reshape(-1)
    largest = float(max(solution.inner.load.max(), solution.outer.load.max()))
    lever = float(np.asarray(solution.scene.bearing.pitch_diameter))
    carried = [
        f"{name} {value:.4g} {unit}"
        for (name, unit), value, scale in zip(channels, load[1:], (1.0, 1.0, lever, lever), strict=True)
        if abs(value) > 1e-6 * largest * scale
    ]
    operation = solution.scene.operation
    if operation.outer_speed is not None and float(np.asarray(operation.outer_speed)) != 0.0:
        carried.append(f"outer ring's speed {float(np.asarray(operation.outer_speed)) / qsbearing.rpm:.4g} rpm")
    if solution.scene.ball_diameter_deviations is not None:
        carried.append("unequal balls")
    if solution.scene.seats_out_of_round is not None:
        carried.append("seats out of round")
    return carried


def groove_contact(scene: str, race: str) -> BallInGroove:
    """Ball and raceway of a scene, at the free contact angle.

    Raises:
        SceneProblemError: unknown race, or a scene that does not describe one bearing.
    """
    if race not in RACES:
        raise SceneProblemError(f"raceway {race!r}: must be one of {', '.join(RACES)}")
    return drawing_of(load_scene(scene), scene).groove(race)


def operating_points(source: str) -> dict[str, qsbearing.Scene]:
    """What a scene is solved at, by label: a scene's own operation; the example's also at other loads and speeds."""
    scene = load(source)
    assert isinstance(scene, qsbearing.Scene)
    if source != EXAMPLE:
        return {"own operation": scene}
    rest, fast = 0.0, 10_000.0 * qsbearing.rpm
    points: dict[str, dict[str, float]] = {
        "Fa = 500 N, at rest": {"speed": rest, "axial_load": 500.0},
        "Fa = 44500 N, at rest": {"speed": rest, "axial_load": 44500.0},
        "Fa = 2000 N, Fr = 8000 N, no tilt, at rest": {
            "speed": rest, "axial_load": 2000.0, "radial_load_y": 8000.0, "tilt_z": 0.0,
        },
        "Fa = 2000 N, 10000 rpm": {"speed": fast, "axial_load": 2000.0},
        "Fa = 17800 N, 10000 rpm": {"speed": fast, "axial_load": 17800.0},
        "Fa = 44500 N, 10000 rpm": {"speed": fast, "axial_load": 44500.0},
        "Fa = 8000 N, Fr = 4000 N, no tilt, 10000 rpm": {
            "speed": fast, "axial_load": 8000.0, "radial_load_y": 4000.0, "tilt_z": 0.0,
        },
        "Fa = 17800 N, Fr = 8000 N, free to tilt, 10000 rpm": {
            "speed": fast, "axial_load": 17800.0, "radial_load_y": 8000.0, "moment_z": 0.0,
        },
    }  # fmt: skip
    return {
        label: dataclasses.replace(scene, operation=qsbearing.Operation(**fields)) for label, fields in points.items()
    }


def ball_count(scene: qsbearing.Scene) -> int:
    """Number of balls of a scene's bearing, of several cases the first's."""
    return round(float(np.ravel(scene.bearing.ball_count)[0]))


@lru_cache(maxsize=8)
def solved(source: str) -> tuple[SolvedPoint, ...]:
    """A scene, solved at its operating points.

    Raises:
        SceneProblemError: no equilibrium, or a contact that is beyond elastic half-spaces: pressed past yield, or over
            the edge of its groove.
    """
    of = load(source)
    if isinstance(of, qsbearing.BearingSet):
        rows = enumerate(solve_set(source, of).rows, 1)
        points = tuple(SolvedPoint(f"{ROW}{number}", solution) for number, solution in rows)
    else:
        points = tuple(
            SolvedPoint(label, solve(source, label, scene)) for label, scene in operating_points(source).items()
        )
    for point in points:
        _refuse_beyond_elastic_contact(source, point)
    return points


def solve_set(source: str, of: qsbearing.BearingSet) -> qsbearing.SetSolution:
    """The solution of a set's single case.

    Raises:
        SceneProblemError: several cases, or no equilibrium.
    """
    return _single(source, "", qsbearing.solve_set(of))


def solve(source: str, label: str, scene: qsbearing.Scene) -> qsbearing.Solution:
    """The solution of a single case.

    Raises:
        SceneProblemError: several cases, or no equilibrium.
    """
    return _single(source, f", {label}", qsbearing.solve(scene))


def _single(source: str, label: str, solution: AnySolution) -> AnySolution:
    if solution.shape:
        raise SceneProblemError(f"scene {source} holds {solution.shape} cases; a check takes a single one")
    if not solution.converged:
        raise SceneProblemError(f"scene {source}{label}: {qsbearing.message(solution)}")
    return solution


def _refuse_beyond_elastic_contact(source: str, point: SolvedPoint) -> None:
    bearing = point.solution.scene.bearing
    for race in RACES:
        contacts = getattr(point.solution, race)
        pressure = float(contacts.max_pressure.max())
        if pressure > STATIC_PRESSURE:
            raise SceneProblemError(
                f"scene {source}, {point.label}: the {race} raceway's pressure reaches "
                f"{pressure / qsbearing.MPa:.0f} MPa; beyond {STATIC_PRESSURE / qsbearing.MPa:.0f} MPa (ISO 76) "
                "permanent dents exceed about 1e-4 of the ball's diameter, and the contact is not elastic: reduce the "
                "load"
            )
        radius = float(np.asarray(getattr(bearing, f"{race}_groove_radius")))
        for angle, a in zip(contacts.angle, contacts.semi_major_axis, strict=True):
            if a > 0.0 and (a >= radius or abs(angle) + asin(a / radius) >= 0.5 * pi):
                raise SceneProblemError(
                    f"scene {source}, {point.label}: the {race} contact, {a / qsbearing.mm:.2f} mm to either side of "
                    f"{angle / qsbearing.deg:.1f} degrees, leaves its groove: reduce the load"
                )


def operating_loads(source: str, race: str) -> tuple[float, ...]:
    """All loads that the contacts of a race carry at the operating points, in rising order [N].

    Of a set, those of the rows with the first one's bearing.
    """
    points = [point.solution for point in solved(source)]
    alike = [each for each in points if each.scene.bearing == points[0].scene.bearing]
    loads = np.concatenate([np.asarray(getattr(each, race).load) for each in alike])
    return tuple(float(load) for load in np.unique(loads[loads > 0.0]))
