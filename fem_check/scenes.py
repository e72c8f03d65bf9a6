"""Scenes under test: the drawing of a bearing, and what `qsbearing` says of it at its operating points."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from functools import lru_cache
from math import asin, pi
from typing import Any

import numpy as np

import qsbearing
from fem_check.agreement import EXAMPLE
from fem_check.contact_problem import ElasticConstants
from fem_check.drawing import Drawing
from fem_check.groove import RACES, BallInGroove
from qsbearing.messages import STATIC_PRESSURE_LIMIT


class SceneProblemError(Exception):
    """A scene gives no contact; the message says why."""


@dataclass(frozen=True)
class Solved:
    """A scene at one operating point, solved by the quasi-static model."""

    label: str
    solution: qsbearing.Solution


def load_scene(source: str) -> qsbearing.Scene:
    """The scene of a file or of a catalogue entry.

    Raises:
        SceneProblemError: it cannot be read (the message has every error), or its rings or balls grow.
    """
    try:
        scene = qsbearing.load_scene(source)
    except (OSError, ValueError, KeyError) as problem:
        raise SceneProblemError(f"scene {source}: {problem}") from problem
    if scene.ring_effects:
        names = " and ".join(effect.name for effect in scene.ring_effects)
        raise SceneProblemError(f"scene {source}: names {names}; contacts are judged from the drawing as it is, cold")
    return scene


def drawing_of(scene: qsbearing.Scene, name: str) -> Drawing:
    """The dimensions and materials of a scene's bearing.

    Raises:
        SceneProblemError: a field holds several values; a contact needs a single bearing.
    """

    def number(value: Any, field: str) -> float:
        array = np.asarray(value, dtype=float)
        if array.size != 1:
            raise SceneProblemError(
                f"scene {name}: {field} holds {array.size} values; one contact needs a single bearing"
            )
        return float(array.ravel()[0])

    def constants(material: Any, field: str) -> ElasticConstants:
        return ElasticConstants(
            number(material.elastic_modulus, f"{field}.elastic_modulus"),
            number(material.poisson_ratio, f"{field}.poisson_ratio"),
        )

    moment, control = scene.gyroscopic_moment, qsbearing.RacewayControl.MINIMUM_DISSIPATION
    beyond = {
        "friction_coefficient": moment is not None and moment.friction_coefficient is not None,
        "orbit_radius": scene.orbit_radius is qsbearing.OrbitRadius.DISPLACED,
        f"raceway_control {control}": scene.raceway_control is control,
    }
    if any(beyond.values()):
        names = " and ".join(what for what, is_named in beyond.items() if is_named)
        raise SceneProblemError(f"scene {name}: names {names}; the equilibrium is judged for the classical model alone")
    bearing = scene.bearing
    lengths = ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius", "free_contact_angle")
    return Drawing(
        name=bearing.name or name,
        **{field: number(getattr(bearing, field), field) for field in lengths},
        ball=constants(bearing.ball_material, "ball_material"),
        ring=constants(bearing.ring_material, "ring_material"),
        ball_density=number(bearing.ball_material.density, "ball_material.density"),
    )


def groove_contact(scene: str, race: str) -> BallInGroove:
    """Ball and raceway of a scene, at the free contact angle.

    Raises:
        SceneProblemError: unknown race, or a scene that does not describe one bearing.
    """
    if race not in RACES:
        raise SceneProblemError(f"race {race!r}: must be one of {', '.join(RACES)}")
    return drawing_of(load_scene(scene), scene).groove(race)


def operating_points(source: str) -> dict[str, qsbearing.Scene]:
    """What a scene is solved at, by label: a scene's own operation; the example's also at other loads and speeds."""
    scene = load_scene(source)
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


def ball_count(scene: str) -> int:
    """Number of balls of a scene's bearing."""
    return int(np.asarray(qsbearing.load_scene(scene).bearing.ball_count).ravel()[0])


@lru_cache(maxsize=8)
def solved(source: str) -> tuple[Solved, ...]:
    """A scene, solved at its operating points.

    Raises:
        SceneProblemError: no equilibrium, or a contact that is beyond elastic half-spaces: pressed past yield, or over
            the edge of its groove.
    """
    found = tuple(Solved(label, solve(source, label, scene)) for label, scene in operating_points(source).items())
    for point in found:
        _refuse_beyond_elastic_contact(source, point)
    return found


def solve(source: str, label: str, scene: qsbearing.Scene) -> qsbearing.Solution:
    """The solution of a single case.

    Raises:
        SceneProblemError: several cases, or no equilibrium.
    """
    solution = qsbearing.solve(scene)
    if solution.shape:
        raise SceneProblemError(f"scene {source} holds {solution.shape} cases; a check takes a single one")
    if not solution.converged:
        raise SceneProblemError(f"scene {source}, {label}: {qsbearing.message(solution)}")
    return solution


def _refuse_beyond_elastic_contact(source: str, point: Solved) -> None:
    bearing = point.solution.scene.bearing
    for race in RACES:
        contacts = getattr(point.solution, race)
        pressure = float(contacts.max_pressure.max())
        if pressure > STATIC_PRESSURE_LIMIT:
            raise SceneProblemError(
                f"scene {source}, {point.label}: the {race} raceway's pressure reaches "
                f"{pressure / qsbearing.MPa:.0f} MPa; beyond {STATIC_PRESSURE_LIMIT / qsbearing.MPa:.0f} MPa (ISO 76) "
                "permanent dents exceed about 1e-4 of the ball's diameter, and no elastic contact describes it: take "
                "less load"
            )
        radius = float(np.asarray(getattr(bearing, f"{race}_groove_radius")))
        for angle, a in zip(contacts.angle, contacts.semi_major_axis, strict=True):
            if a > 0.0 and (a >= radius or abs(angle) + asin(a / radius) >= 0.5 * pi):
                raise SceneProblemError(
                    f"scene {source}, {point.label}: the {race} contact, {a / qsbearing.mm:.2f} mm to either side of "
                    f"{angle / qsbearing.deg:.1f} degrees, leaves its groove: take less load"
                )


def operating_loads(source: str, race: str) -> tuple[float, ...]:
    """All loads that the contacts of a race carry at the operating points, in rising order [N]."""
    loads = np.concatenate([np.asarray(getattr(point.solution, race).load) for point in solved(source)])
    return tuple(float(load) for load in np.unique(loads[loads > 0.0]))
