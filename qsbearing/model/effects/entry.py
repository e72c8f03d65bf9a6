"""What the list of effects knows of each: how it is put into a scene and taken out, and how much it matters.

An entry says of its effect or choice

    finer(scene)       the scene with it, at its finest; the very same object where it has it, or where it cannot be
                       added because its parameters are not known
    coarser(scene)     the scene without it, or with its coarsest choice; the very same object where that is so already
    indicator(point)   the dimensionless number that its influence follows, (*cases), from a solution with or without it
    errors(point)      what leaving it out changes, relative to the full result, for each of `QUANTITIES`, (*cases)

The list itself, and how it is added to: `qsbearing.model.effects`.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.operating_point import OperatingPoint
from qsbearing.model.validation import SceneError, Sentence, Setting

QUANTITIES = ("contact_angle", "load", "pressure", "displacement", "stiffness")
"""What people read; how the error of each is counted is said in `qsbearing.model.solution.comparison`."""

Errors = dict[str, NDArray]
"""Relative errors (*cases) by quantity; one that is not named does not change."""

Change = Callable[[Any], Any]
"""From a scene to a scene."""


class Assumed(NamedTuple):
    """A scene or set with an effect whose parameters it does not give, under assumptions about them; or with another
    member of a choice."""

    under: str
    """Which of several assumptions or members, in words that follow a number in brackets; empty for the only one."""
    what: str
    """What is assumed, in words that follow "solved with"."""
    of: Any
    """The scene or set with it; the very same object where it would change nothing."""


class Members(NamedTuple):
    """What a choice is among."""

    others: Callable[[Any], list[Assumed]]
    """The scene or set with every other member, to be judged against; none where the choice does not apply."""
    finest: Any = None
    """By which all are judged; None for a choice among hypotheses, of which the scene's own is."""


class Switch(NamedTuple):
    """How an effect or choice is put into a scene and taken out."""

    finer: Change
    coarser: Change
    slot: str
    """The scene's field: a tuple of effects, or a choice."""
    effect_type: Any = None
    """The effect's class; None for a choice."""
    members: Members | None = None
    """Of a choice."""


def nothing_assumed(of: Any, points: Any) -> list[Assumed]:
    """Of an effect of which nothing usual is known."""
    return []


@dataclass(frozen=True)
class Entry:
    """One effect or choice of the list."""

    name: str
    """Its key in results."""
    what: str
    """What it is, in words that follow "the error of leaving out"."""
    switch: Switch
    """Made by `effect` or `choice`."""
    indicator: Callable[[OperatingPoint], NDArray]
    errors: Callable[[OperatingPoint], Errors]
    needs: str = ""
    """Parameters without which it cannot be added, in words that follow "give"; empty for what needs none."""
    needs_beside_size: str = ""
    """The same in a file whose [bearing] has bore, outside diameter and width; empty where it is no other."""
    without_it: str = ""
    """What the model assumes without it, as a sentence's beginning that "would change ..." follows; empty where that
    goes without saying."""
    assume: Callable[[Any, list[OperatingPoint]], list[Assumed]] = nothing_assumed
    """Of a scene or set that lacks it, and of how its rows run: with usual parameters, those that change least first.

    Raises:
        SceneError: they make no such scene.
    """
    applies: Callable[[Any], bool] = lambda of: True
    """Whether a scene or set can have it at all."""
    tells_without: bool = False
    """Whether indicator and errors are estimates where the scene lacks its parameters: for batches too large to be
    solved again."""
    hypothesis: str = ""
    """Set for a choice among hypotheses, of which the model cannot tell which is true: why not."""
    goes_with_friction: bool = True
    """Whether balls that friction moves know it; of a choice its members tell."""
    saves_time: bool = True
    """Whether a scene is solved faster without it; what saves nothing is never left out."""

    def finer(self, scene: Any) -> Any:
        """The scene with it, as far as it can be added: not to a set of rows at one place, whose balls are shared."""
        return _as_far(self.switch.finer, scene)

    def coarser(self, scene: Any) -> Any:
        """The scene without it."""
        return self.switch.coarser(scene)

    def is_in(self, scene: Any) -> bool:
        """Whether the scene has it, at its finest."""
        return self.finer(scene) is scene and self.coarser(scene) is not scene

    def can_be_added(self, scene: Any) -> bool:
        """Whether the scene lacks it and it needs nothing that the scene does not say."""
        return self.finer(scene) is not scene


def effect(slot: str, effect_type: Any, make: Callable[[], Any] | None = None) -> Switch:
    """Switch of an effect that a scene holds in a tuple, such as `ball_effects`.

    Args:
        slot: the scene's field.
        effect_type: the effect's class.
        make: makes the effect where the scene lacks it; None: it has parameters of its own and cannot be added.
    """

    def finer(scene: Any) -> Any:
        there = getattr(scene, slot)
        if make is None or any(isinstance(one, effect_type) for one in there):
            return scene
        return _with(scene, slot, (*there, make()))

    def coarser(scene: Any) -> Any:
        there = getattr(scene, slot)
        rest = tuple(one for one in there if not isinstance(one, effect_type))
        return scene if len(rest) == len(there) else _with(scene, slot, rest)

    return Switch(finer, coarser, slot, effect_type)


def given(effect_type: Any, what: str, **settings: Any) -> Sentence:
    """What a ring effect needs: the effect, with this of its own, and a setting that is one, as an example."""
    named = [Setting(name, value) for name, value in settings.items()]
    example = ", such as {example}" if named else ""
    return Sentence(
        f"{{effect}}{{what}}{example}", effect=Setting("ring_effects", effect_type), what=what, example=tuple(named)
    )


def _with(scene: Any, slot: str, effects: tuple[Any, ...]) -> Any:
    """Raceway control comes with the first ball effect, as Jones's criterion where the scene states none, and goes with
    the last, as do orbits of the balls' own and a common motion: nothing else asks for them."""
    changes: dict[str, Any] = {slot: effects}
    if slot == "ball_effects":
        changes["raceway_control"] = (scene.raceway_control or "per_ball") if effects else None
        if scene.raceway_control == "friction" and len(effects) < len(scene.ball_effects):
            # Which has all of the balls' inertia, or none.
            changes |= {"raceway_control": "outer" if effects else None, "traction": None}
        if not effects:
            changes |= {"orbit_radius": "pitch_circle", "ball_motion": "own"}
    return replace(scene, **changes)


def bearings_of(of: Any) -> list[tuple[Any, tuple[Any, ...]]]:
    """The bearing of a scene, or of every row of a set, each with its ring effects."""
    if not hasattr(of, "rows"):
        return [(of.bearing, of.ring_effects)]
    return [(row.bearing, of.effects_of(row)) for row in of.rows]


def has_size(of: Any) -> bool:
    """Whether bore, outside diameter and width of every bearing are known."""
    outlines = [bearing.outline for bearing, _ in bearings_of(of)]
    return all(each and None not in (each.bore_diameter, each.outside_diameter, each.width) for each in outlines)


def with_ring_effect(of: Any, effect_type: Any, made: Callable[[Any, tuple[Any, ...]], Any]) -> Any:
    """The scene, or every row of a set, with a ring effect, where it lacks one of this type.

    Args:
        made: the effect, from the bearing and its other ring effects; None where these leave it out.
    """
    known: dict[tuple[int, ...], tuple[Any, ...]] = {}  # rows alike keep the very same, so that they are solved once

    def effects(bearing: Any, there: tuple[Any, ...]) -> tuple[Any, ...]:
        key = (id(bearing), *map(id, there))
        if key not in known:
            has_it = any(isinstance(one, effect_type) for one in there)
            more = None if has_it else made(bearing, there)
            known[key] = there if more is None else (*there, more)
        return known[key]

    of_bearings = [effects(*each) for each in bearings_of(of)]
    if not hasattr(of, "rows"):
        return replace(of, ring_effects=of_bearings[0])
    return replace(
        of, rows=tuple(replace(row, ring_effects=each) for row, each in zip(of.rows, of_bearings, strict=True))
    )


def choice(field: str, coarse: Any, fine: Any, kept: tuple[Any, ...] = (), of_balls: bool = False) -> Switch:
    """Switch of a choice for a field of the scene, from the coarsest member to the finest.

    Args:
        kept: members that are part of the scene's question.
        of_balls: whether only scenes with a ball effect have this choice.
    """

    def towards(member: Any, kept: tuple[Any, ...] = ()) -> Change:
        def change(scene: Any) -> Any:
            now = getattr(scene, field)
            idle = of_balls and not scene.ball_effects
            return scene if idle or now in (None, member, *kept) else replace(scene, **{field: member})

        return change

    def others(scene: Any) -> list[Assumed]:
        return other_than(scene, [(as_setting(field, each), _as_far(towards(each), scene)) for each in type(fine)])

    return Switch(towards(fine, kept), towards(coarse, kept), field, members=Members(others, fine))


def _as_far(change: Change, scene: Any) -> Any:
    """The scene changed; as it is where its other choices do not go with the change."""
    try:
        return change(scene)
    except SceneError:
        return scene


def as_setting(field: str, member: Any) -> str:
    """A member of a choice as files have it."""
    return f'{field} = "{member}"'


def other_than(scene: Any, every: list[tuple[str, Any]]) -> list[Assumed]:
    """Those that are not the scene as it stands."""
    return [Assumed(under, under, each) for under, each in every if each is not scene]


def part_of_effect(slot: str, field: str, coarse: Any, fine: Any = None) -> Switch:
    """Switch of a choice or number within an effect that the scene has; without a finest one it is not added."""

    def towards(member: Any) -> Change:
        def change(scene: Any) -> Any:
            there = getattr(scene, slot)
            changed = [replace(one, **{field: member}) if _differs(one, field, member) else one for one in there]
            is_same = all(one is other for one, other in zip(there, changed, strict=True))
            return scene if is_same else _with(scene, slot, tuple(changed))

        return change

    return Switch((lambda scene: scene) if fine is None else towards(fine), towards(coarse), field)


def _differs(effect: Any, field: str, member: Any) -> bool:
    now = getattr(effect, field, member)
    return (now is None) != (member is None) or (isinstance(member, str) and now != member)


def with_found(effect: Any, values: dict[str, Any]) -> Any:
    """A frozen effect with numbers that the solver has found or taken apart by cases, which nobody gives: unchecked."""
    copied = copy(effect)
    vars(copied).update(values)
    return copied


def largest(of_balls: Callable[[OperatingPoint], NDArray], times: float = 1.0) -> Callable[[OperatingPoint], NDArray]:
    """The indicator that is the largest of a number of each ball (*cases, ball)."""
    return lambda point: np.asarray(times * of_balls(point).max(axis=-1))


def error_in(
    quantity: str, errors: Callable[[OperatingPoint], Errors], times: float = 1.0
) -> Callable[[OperatingPoint], NDArray]:
    """The indicator that is the error of a quantity itself, or a multiple of it."""
    return lambda point: np.asarray(times * errors(point)[quantity])


def for_arrays(function: Any) -> Any:
    """A function of the kernel, stated for numbers, whose formulas hold for arrays as well."""
    return function
