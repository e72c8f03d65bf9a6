"""Which contacts are solved: raceways, loads and contact angles, from what the command line and the scene say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import degrees, radians
from typing import Any

import numpy as np

import qsbearing
from fem_check.checks.bearing_contacts import operated
from fem_check.independent.contact_problem import ContactProblem
from fem_check.independent.drawing import BearingDrawing
from fem_check.independent.groove import RACES, BallInGroove
from fem_check.product.problems import row_of
from fem_check.product.scenes import SceneProblemError, drawing_of, load_scene
from fem_check.solids.true_contact import loaded_angle

FREE, LOADED, GIVEN = "free", "loaded", "given"
ANGLES = {
    FREE: "free: that of the unloaded bearing",
    LOADED: "loaded: that of the contact line under the load",
    GIVEN: "as given",
}
"""What a contact's angle is."""
BOTH = "both"


@dataclass(frozen=True, eq=False)
class Chosen:
    """One contact to be solved."""

    groove: BallInGroove
    """Ball and raceway at the contact angle."""
    load: float
    """[N]"""
    angle: str
    """What the angle is, one of `ANGLES`."""
    balls: str
    """Which balls of the scene it is, in words; empty where the load was given."""
    bearing: qsbearing.Scene
    """The bearing, with its rings' sections."""
    free_angle: float
    """Of the unloaded bearing [rad]."""
    loaded_angle: float
    """Of the contact line under the load [rad]."""

    @property
    def problem(self) -> ContactProblem:
        """As Hertz sees it."""
        return self.groove.problem(self.load)

    @property
    def label(self) -> str:
        """Raceway, load, angle beside those that it might be, balls."""
        angles = self.groove.contact_angle, self.free_angle, self.loaded_angle
        angle, free, loaded = (f"{degrees(each):.2f}°" for each in angles)
        told = {FREE: f"free; loaded {loaded}", LOADED: f"loaded; free {free}", GIVEN: f"free {free}, loaded {loaded}"}
        balls = f", {self.balls}" if self.balls else ""
        return f"{self.groove.race_name}, Q = {self.load:g} N at {angle} ({told[self.angle]}){balls}"


def raceways(race: str) -> tuple[str, ...]:
    """One raceway or both.

    Raises:
        SceneProblemError: there is no such raceway.
    """
    if race != BOTH and race not in RACES:
        raise SceneProblemError(f"raceway {race!r}: must be one of {', '.join((*RACES, BOTH))}")
    return RACES if race == BOTH else (race,)


def chosen(source: str, race: str, loads: Sequence[float], angle: str | float | None) -> list[Chosen]:
    """The contacts of a scene, those of the inner raceway first.

    Args:
        source: a scene file, or a name of the catalogue.
        race: inner, outer or both.
        loads: normal loads [N]; none: those of the scene's own balls.
        angle: "free", "loaded" or an angle [degrees]; None: free for loads given, loaded for the scene's own.

    Raises:
        SceneProblemError: the scene cannot be read or solved, or no ball presses the raceway.
    """
    races = raceways(race)
    if loads:
        return _with_loads(source, races, loads, FREE if angle is None else angle)
    contacts = _of_scene(source, races, LOADED if angle is None else angle)
    if not contacts:
        raise SceneProblemError(f"scene {source}: no ball presses {'a' if race == BOTH else f'the {race}'} raceway")
    return contacts


def _with_loads(source: str, races: Sequence[str], loads: Sequence[float], angle: str | float) -> list[Chosen]:
    bearing = load_scene(source)
    drawing = drawing_of(bearing, source)
    contacts = []
    for race in races:
        for load in loads:
            free, loaded = drawing.groove(race), _under_thrust(drawing, load)
            groove = _groove(drawing, race, angle, loaded)
            contacts.append(Chosen(groove, load, _kind(angle), "", bearing, free.contact_angle, loaded))
    return contacts


def _under_thrust(drawing: BearingDrawing, load: float) -> float:
    return loaded_angle(drawing.groove("inner"), drawing.groove("outer"), load)


def _of_scene(source: str, races: Sequence[str], angle: str | float) -> list[Chosen]:
    """Every contact that carries load; balls whose contacts are alike stand together."""
    alike: dict[Any, list[int]] = {}
    bearings: dict[str, qsbearing.Scene] = {}
    for point in operated(source):
        where = "" if point.label == "own operation" else f"{point.label}, "
        scene = bearings[where] = point.solution.scene
        drawings = row_of(scene, source).balls
        for race in races:
            contacts = getattr(point.solution, race)
            for ball, (load, own) in enumerate(zip(contacts.load, contacts.angle, strict=True)):
                if load > 0.0:
                    # Rounded: what is alike but for rounding is solved once.
                    loaded = round(float(own), 7)
                    free = drawings[ball].groove(race).contact_angle
                    groove = _groove(drawings[ball], race, angle, loaded)
                    key = race, float(f"{load:.6g}"), groove, where, free, loaded
                    alike.setdefault(key, []).append(ball + 1)
    by_load = sorted(alike.items(), key=lambda each: (each[0][0], each[0][1]))
    return [
        Chosen(groove, load, _kind(angle), where + _numbers(balls), bearings[where], free, loaded)
        for (_, load, groove, where, free, loaded), balls in by_load
    ]


def _groove(drawing: BearingDrawing, race: str, angle: str | float, loaded: float) -> BallInGroove:
    if angle == FREE:
        return drawing.groove(race)
    return replace(drawing.groove(race), contact_angle=loaded if angle == LOADED else radians(float(angle)))


def _kind(angle: str | float) -> str:
    return angle if isinstance(angle, str) else GIVEN


def _numbers(balls: Sequence[int]) -> str:
    """Numbers of balls in words: balls 1 to 4 and 7."""
    runs = np.split(np.array(balls), np.flatnonzero(np.diff(balls) > 1) + 1)
    told = [f"{run[0]} to {run[-1]}" if len(run) > 2 else ", ".join(map(str, run)) for run in runs]
    return f"ball{'s' if len(balls) > 1 else ''} {', '.join(told)}"
