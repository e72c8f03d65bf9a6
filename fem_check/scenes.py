"""Contacts of real bearings, and the loads that the quasi-static model gives them; where the checks call
`qsbearing`."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

import qsbearing
from fem_check.contact_problem import ElasticConstants
from fem_check.groove import RACES, BallInGroove


class SceneProblemError(Exception):
    """A scene gives no contact; the message says why."""


@dataclass(frozen=True)
class OperatingPoint:
    """A pure thrust load at a speed: every ball carries the same."""

    axial_load: float
    """[N]"""
    speed: float
    """Of the inner ring [rad/s]."""

    @property
    def label(self) -> str:
        """In the field's units."""
        speed = f"{self.speed / qsbearing.rpm:.0f} rpm" if self.speed else "at rest"
        return f"Fa = {self.axial_load:.0f} N, {speed}"


OPERATING_POINTS = tuple(
    OperatingPoint(load, speed * qsbearing.rpm)
    for load in (500.0, 2000.0, 17800.0, 44500.0)
    for speed in (0.0, 10000.0)
)
"""B218, light to heavy, at rest and at 10 000 rpm."""


def groove_contact(scene: str, race: str) -> BallInGroove:
    """Ball and raceway of a scene, at the free contact angle.

    Raises:
        SceneProblemError: unknown race, or a scene that does not describe one bearing.
    """
    if race not in RACES:
        raise SceneProblemError(f"race {race!r}: must be one of {', '.join(RACES)}")
    try:
        bearing = qsbearing.load_scene(scene).bearing
    except (OSError, ValueError, KeyError) as problem:
        raise SceneProblemError(f"scene {scene}: {problem}") from problem

    def number(value: Any, field: str) -> float:
        array = np.asarray(value, dtype=float)
        if array.size != 1:
            raise SceneProblemError(
                f"scene {scene}: {field} holds {array.size} values; one contact needs a single bearing"
            )
        return float(array.ravel()[0])

    def constants(material: Any, field: str) -> ElasticConstants:
        return ElasticConstants(
            number(material.elastic_modulus, f"{field}.elastic_modulus"),
            number(material.poisson_ratio, f"{field}.poisson_ratio"),
        )

    return BallInGroove(
        name=bearing.name or scene,
        race_name=race,
        ball_diameter=number(bearing.ball_diameter, "ball_diameter"),
        groove_radius=number(getattr(bearing, f"{race}_groove_radius"), f"{race}_groove_radius"),
        pitch_diameter=number(bearing.pitch_diameter, "pitch_diameter"),
        contact_angle=number(bearing.free_contact_angle, "free_contact_angle"),
        ball=constants(bearing.ball_material, "ball_material"),
        race=constants(bearing.ring_material, "ring_material"),
    )


def ball_count(scene: str) -> int:
    """Number of balls of a scene's bearing."""
    return int(np.asarray(qsbearing.load_scene(scene).bearing.ball_count).ravel()[0])


@lru_cache(maxsize=8)
def operating_loads(scene_name: str, race: str) -> tuple[tuple[str, float], ...]:
    """Label and contact load [N] at every operating point, from the quasi-static model with both ball effects."""
    scene = qsbearing.load_scene(scene_name)
    found = []
    for point in OPERATING_POINTS:
        operation = qsbearing.Operation(speed=point.speed, axial_load=point.axial_load)
        solution = qsbearing.solve(dataclasses.replace(scene, operation=operation))
        contacts = solution.inner if race == "inner" else solution.outer
        load = float(np.asarray(contacts.load).ravel()[0])
        if not load > 0.0:
            raise SceneProblemError(f"{scene_name} at {point.label}: the model gives the {race} raceway no load")
        found.append((point.label, load))
    return tuple(found)
