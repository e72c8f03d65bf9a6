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

QUANTITIES = ("contact_angle", "load", "pressure", "displacement", "stiffness")
"""What people read; how the error of each is counted is said in `qsbearing.studies.chooser.comparison`."""

Errors = dict[str, NDArray]
"""Relative errors (*cases) by quantity; one that is not named does not change."""

Change = Callable[[Any], Any]
"""From a scene to a scene."""


class Switch(NamedTuple):
    """How an effect or choice is put into a scene and taken out."""

    finer: Change
    coarser: Change
    slot: str
    """The scene's field: a tuple of effects, or a choice."""
    effect_type: Any = None
    """The effect's class; None for a choice."""


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
    """Parameters without which it cannot be added; empty for what needs none."""
    without_parameters: str = ""
    """From what indicator and errors are estimated where the scene lacks it, in words that follow "estimated"; empty
    where nothing can be told without parameters."""
    hypothesis: str = ""
    """Set for a choice among hypotheses, of which the model cannot tell which is true: why not."""
    is_bound: bool = False
    """Whether what is estimated without parameters is the most that there can be: no warning to every scene then."""
    saves_time: bool = True
    """Whether a scene is solved faster without it; what saves nothing is never left out."""

    def finer(self, scene: Any) -> Any:
        """The scene with it, as far as it can be added."""
        return self.switch.finer(scene)

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


def _with(scene: Any, slot: str, effects: tuple[Any, ...]) -> Any:
    """Raceway control comes with the first ball effect, as Jones's criterion where the scene states none, and goes with
    the last, as do orbits of the balls' own: nothing else asks for them."""
    changes: dict[str, Any] = {slot: effects}
    if slot == "ball_effects":
        changes["raceway_control"] = (scene.raceway_control or "per_ball") if effects else None
        if not effects:
            changes["orbit_radius"] = "pitch_circle"
    return replace(scene, **changes)


def choice(field: str, coarse: Any, fine: Any, kept: tuple[Any, ...] = (), of_balls: bool = False) -> Switch:
    """Switch of a choice for a field of the scene, from the coarsest member to the finest.

    Args:
        kept: members that are part of the scene's question.
        of_balls: whether only scenes with a ball effect have this choice.
    """

    def towards(member: Any) -> Change:
        def change(scene: Any) -> Any:
            now = getattr(scene, field)
            idle = of_balls and not scene.ball_effects
            return scene if idle or now in (None, member, *kept) else replace(scene, **{field: member})

        return change

    return Switch(towards(fine), towards(coarse), field)


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
    found = copy(effect)
    vars(found).update(values)
    return found


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
