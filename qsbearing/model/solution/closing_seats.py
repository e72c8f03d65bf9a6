"""Clearances that the balls close: which elastic rings touch what holds them, found by solving until nothing changes.

A ring that stands off its seat is free; its seat closes where its mean growth by the balls exceeds the clearance: where
the seat of ring and housing as one body would press. Mean growth alone is asked: a ring that touches its seat on some
of its circumference is solved as one that touches all of it, or nowhere, and a warning says so.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects import ElasticRings, RingExpansion
from qsbearing.model.effects.entry import with_found
from qsbearing.model.scene.elastic_seats import clearances
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.ring_shape import mean_seat_pressure
from qsbearing.model.solution.solution import Solution

RINGS = {"housing": "outer", "shaft": "inner"}


def with_touching(scene: Scene, touching: dict[str, Any]) -> Scene:
    """The scene with some seats touching or not, case by case; others as their fit says, whatever an earlier solve of
    its effects has found."""
    flags: dict[str, Any] = {f"{seat}_touches": touching.get(seat) for seat in RINGS}
    effects = tuple(_flagged(each, flags) for each in scene.ring_effects)
    is_same = all(one is other for one, other in zip(effects, scene.ring_effects, strict=True))
    return scene if is_same else replace(scene, ring_effects=effects)


def _flagged(effect: Any, flags: dict[str, Any]) -> Any:
    """An effect that knows seats with what is found of them, no input; the same object where nothing changes."""
    if not isinstance(effect, ElasticRings | RingExpansion) or all(
        getattr(effect, name) is flag for name, flag in flags.items()
    ):
        return effect
    return with_found(effect, flags)


def solve_closing(scene: Scene, solve: Callable[[Scene], Solution]) -> Solution:
    """Solve with seats that close as far as the balls close them; `solve` takes them as the scene has them."""
    gaps = clearances(scene.elastic_rings, scene.ring_expansion, scene.bearing, scene.operation)
    if not gaps:
        return solve(scene)
    touching = {seat: (gap <= 0.0).astype(float)[()] for seat, gap in gaps.items()}
    solution = solve(with_touching(scene, touching))
    for _ in gaps:
        changed = False
        for seat, before in touching.items():
            with np.errstate(invalid="ignore"):
                after = np.where(_pressure(scene, solution, seat) > 0.0, 1.0, before)
            changed |= bool((after > before).any())
            touching[seat] = after[()]
        if not changed:
            break
        solution = solve(with_touching(scene, touching))
    return solution


def _pressure(scene: Scene, solution: Solution, seat: str) -> NDArray:
    """Mean pressure at a seat if it touched, under the balls' loads as they are [Pa]."""
    touching = with_touching(scene, {seat: 1.0})
    rings, expansion = touching.elastic_rings, touching.ring_expansion
    assert rings is not None and expansion is not None
    side = RINGS[seat]
    fitted = expansion.states(scene.bearing, scene.operation)[("inner", "outer").index(side)].seat_pressure
    assert fitted is not None
    return np.asarray(mean_seat_pressure(solution, rings, side) + fitted)
