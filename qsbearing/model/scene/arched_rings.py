"""What is not known yet of a four-point bearing, by the scene's fields: nothing is solved as if rings had one arc."""

from __future__ import annotations

from typing import Any

from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.validation import ErrorDetail, raise_if_any

READINGS = ("life", "lubricant")
"""Readings that know contacts of all arcs; the lubricant is none by itself."""
NOTHING_TO_COMPARE = "Nothing can be compared: only friction moves its balls, and no further effect is known"
"""Why there is no comparison of effects and hypotheses."""
IN_RUN = "All of its contacts are in the tables of `qsbearing run`, its JSON, and the solution's arrays"
"""Where what is refused elsewhere can be read."""
NAMED = "is not known to a four-point bearing"


def arched_errors(scene: Any) -> list[ErrorDetail]:
    """Errors of a scene with a four-point bearing."""
    errors = []
    if scene.raceway_control is not RacewayControl.FRICTION:
        given = None if scene.raceway_control is None else str(scene.raceway_control)
        detail = "no hypothesis of raceway control gives the motion of a ball with three or four contacts"
        cause = 'Give raceway_control = "friction", with both ball effects; it holds at rest too'
        problem = 'must be "friction" for a four-point bearing'
        errors.append(ErrorDetail("raceway_control", problem, given, cause=cause, detail=detail))
    for effect in scene.ring_effects:
        name = getattr(effect, "name", "ring_effects")
        cause = "Leave it out, and give the shims and clearance that the mounted bearing has in operation"
        errors.append(ErrorDetail(name, NAMED, cause=cause))
    for name, cause in (
        ("preload", "Give an axial load or displacement, or a negative axial clearance"),
        ("thermal", "Leave it out"),
        ("tolerance", "Name the effects instead of having them chosen"),
    ):
        if getattr(scene, name) is not None:
            errors.append(ErrorDetail(name, NAMED, cause=cause))
    return errors + reading_errors(scene.readings)


def reading_errors(names: Any) -> list[ErrorDetail]:
    """Of readings that know two contacts a ball."""
    cause = f"Leave it out: of readings there is {READINGS[0]}; contacts, heat and margins are in the results"
    return [
        ErrorDetail(f"readings.{name}", "knows one contact with each ring, and this bearing may have two", cause=cause)
        for name in names
        if name not in READINGS
    ]


def refuse_arched(bearing: Any, what: str, cause: str) -> None:
    """Refuse by name what has no four-point bearings.

    Args:
        bearing: of a scene; None of a set, which has none.
        what: is refused, as a subject.

    Raises:
        SceneError: it is one.
    """
    if bearing is not None and bearing.is_arched:
        problem = f"is a kind that {what} does not know: two contacts with one ring"
        raise_if_any([ErrorDetail("bearing.kind", problem, str(bearing.kind), cause=cause)])
