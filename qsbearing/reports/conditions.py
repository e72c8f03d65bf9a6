"""Whether a scene lies within what a check covered: each condition by itself, with the reason where it does not."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.scene_file import load_scene
from qsbearing.model.contact.hertz import HertzForm
from qsbearing.model.effects.ball_motion import MotionOfBalls
from qsbearing.model.effects.hertz_angle import HertzAngle
from qsbearing.model.effects.orbit_radius import OrbitRadius
from qsbearing.model.effects.tilt_lever import TiltLever
from qsbearing.model.material import Material
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import deg, mm, rpm

Span = tuple[float, float]
"""The least and the largest."""
LENGTHS = (
    "ball_count", "ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius", "free_contact_angle",
)  # fmt: skip
SIDES = ("inner", "outer")
ALONE = "checked thrust alone"
SAME = 1e-6
"""Relative difference up to which lengths are those of a published bearing."""
NOTHING = 1e-9
"""Part of the largest load, and radians or metres, up to which something is none."""


class Difference(NamedTuple):
    """One thing in which a scene is not as what was checked."""

    reason: str
    in_kind: bool = False
    """An effect or choice that the check did not have, not just another number."""


class SceneFacts(NamedTuple):
    """What the conditions ask."""

    scene: Scene
    ellipticity: Span
    """a/b of the loaded contacts."""
    loads: dict[str, Span]
    """Of the loaded contacts of each raceway [N]."""
    angles: dict[str, Span]
    """Likewise their contact angles, without sign [deg]."""
    pressure: float
    """The greatest [Pa]."""
    ring: NDArray
    """Load of the ring in its five channels, moments over dm/2 [N]."""
    moved: NDArray
    """Tilts of the ring [rad]."""


def facts_of(solution: Solution) -> SceneFacts:
    """Those of a single case."""

    def loaded(side: str, name: str) -> NDArray:
        contacts = getattr(solution, side)
        return np.asarray(getattr(contacts, name)[contacts.load > 0.0])

    def span(values: NDArray) -> Span:
        return (float(values.min()), float(values.max())) if values.size else (0.0, 0.0)

    ratios = [span(loaded(side, "semi_major_axis") / loaded(side, "semi_minor_axis")) for side in SIDES]
    ring = np.array(solution.load, float)
    ring[3:] /= 0.5 * float(np.asarray(solution.scene.bearing.pitch_diameter))
    return SceneFacts(
        solution.scene,
        (min(each[0] for each in ratios), max(each[1] for each in ratios)),
        {side: span(loaded(side, "load")) for side in SIDES},
        {side: span(np.abs(loaded(side, "angle")) / deg) for side in SIDES},
        max(span(loaded(side, "max_pressure"))[1] for side in SIDES),
        ring,
        np.asarray(solution.displacement[3:], float),
    )


def beyond(what: str, span: Span, checked: Span, unit: str = "") -> list[Difference]:
    """Numbers that reach outside of those that were checked."""
    if span[0] >= checked[0] and span[1] <= checked[1]:
        return []
    return [Difference(f"{what} {_span(span)}{unit}, checked {_span(checked)}{unit}")]


def _span(span: Span) -> str:
    low, high = map(_number, span)
    return high if low == high else f"up to {high}" if span[0] == 0.0 else f"{low} to {high}"


def other_effects(facts: SceneFacts, checked: Collection[str]) -> list[Difference]:
    """Effects of the scene that the check did not have."""
    named = [effect.name for effect in (*facts.scene.ring_effects, *facts.scene.ball_effects)]
    *others, last = [name.replace("_", " ") for name in named if name not in checked] or [""]
    words = f"{', '.join(others)} or {last}" if others else last
    return [Difference(f"no {words} in the check", True)] if last else []


def other_choices(facts: SceneFacts, control: Collection[str] = ()) -> list[Difference]:
    """Choices of the scene that are not the usual ones, and raceway control beside those that were checked."""
    scene, reasons = facts.scene, []
    if scene.raceway_control is not None and control and scene.raceway_control not in control:
        reasons.append(f"raceway control: {scene.raceway_control.replace('_', ' ')}, checked {' and '.join(control)}")
    if scene.hertz_angle is not HertzAngle.FREE:
        reasons.append("Hertz's constants at each contact's own angle, checked at the free angle")
    if scene.orbit_radius is not OrbitRadius.PITCH_CIRCLE:
        reasons.append("no balls on orbits of their own in the check")
    if scene.ball_motion is not MotionOfBalls.OWN:
        reasons.append("no balls that all move alike in the check")
    if scene.gyroscopic_moment is not None and scene.gyroscopic_moment.friction_coefficient is not None:
        reasons.append("no limit of friction in the check")
    return [Difference(each, True) for each in reasons] + other_formulas(facts)


def other_formulas(facts: SceneFacts) -> list[Difference]:
    """Approximations in place of the exact forms."""
    differences = []
    if facts.scene.hertz_form is not HertzForm.EXACT:
        differences.append(Difference(f"Hertz by the {facts.scene.hertz_form} fit, checked the exact form", True))
    if facts.scene.tilt_lever is not TiltLever.GROOVE_CENTRE:
        differences.append(Difference("tilts about the pitch circle, checked those about the groove centres", True))
    return differences


def other_bearing(
    facts: SceneFacts, name: str, lengths: Collection[str] = LENGTHS, balls: Collection[Material] = ()
) -> list[Difference]:
    """Another bearing than one of the catalogue, which was checked.

    Args:
        lengths: what has to be the same; all but these and the materials may differ.
        balls: materials of balls that were checked besides its own.
    """
    checked, own = load_scene(name).bearing, facts.scene.bearing
    if not all(_close(getattr(own, each), getattr(checked, each)) for each in lengths):
        return [Difference(f"another bearing than {checked.name}")]
    differences = []
    if not any(_is_alike(own.ball_material, each) for each in (checked.ball_material, *balls)):
        differences.append(Difference("another ball material"))
    if not _is_alike(own.ring_material, checked.ring_material):
        differences.append(Difference("another ring material"))
    return differences


def _is_alike(one: Material, other: Material) -> bool:
    return _close(one.elastic_modulus, other.elastic_modulus) and _close(one.poisson_ratio, other.poisson_ratio)


def faster(facts: SceneFacts, limit: float) -> list[Difference]:
    """A speed beyond what was checked, of the inner ring; or an outer ring that turns.

    Args:
        limit: largest speed checked, in either direction [rpm].
    """
    operation, differences = facts.scene.operation, []
    speed = abs(float(np.asarray(operation.speed))) / rpm
    if speed > limit * (1.0 + SAME):
        differences.append(Difference(f"{_number(speed)} rpm, checked up to {_number(limit)} rpm"))
    if operation.outer_speed is not None and float(np.asarray(operation.outer_speed)) != 0.0:
        differences.append(Difference("the outer ring turns, checked the inner alone"))
    return differences


def not_thrust(facts: SceneFacts, checked: Span) -> list[Difference]:
    """Loads beside an axial one, tilts, or an axial load beyond what was checked [N]."""
    axial = abs(float(facts.ring[0]))
    differences = beyond("axial load", (axial, axial), checked, " N")
    nothing = NOTHING * float(np.abs(facts.ring).max())
    if np.abs(facts.ring[1:3]).max() > nothing:
        differences.append(Difference(f"radial load {_number(float(np.hypot(*facts.ring[1:3])))} N, {ALONE}"))
    if np.abs(facts.ring[3:]).max() > nothing or np.abs(facts.moved).max() > NOTHING:
        differences.append(Difference(f"moment or tilt, {ALONE}"))
    return differences


def groove(facts: SceneFacts, side: str) -> float:
    """Groove radius over the ball's diameter, as the ring effects leave it."""
    bearing: Any = facts.scene.operating_bearing
    return float(np.asarray(getattr(bearing, f"{side}_groove_radius")) / np.asarray(bearing.ball_diameter))


def per_area(facts: SceneFacts, side: str) -> Span:
    """Contact loads over the square of the ball's diameter [N/mm2]: of equal ratios, contacts are similar."""
    area = float((np.asarray(facts.scene.bearing.ball_diameter) / mm) ** 2)
    low, high = facts.loads[side]
    return low / area, high / area


def _close(one: Any, other: Any) -> bool:
    return bool(np.isclose(float(np.asarray(one)), float(np.asarray(other)), rtol=SAME, atol=0.0))


def _number(value: float) -> str:
    return f"{value:.0f}" if abs(value) >= 1000.0 else f"{value:.4g}"
