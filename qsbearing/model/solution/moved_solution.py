"""A solution whose balls friction moves: under outer control first, then by the balance of friction, and read off it by
the names that all solutions have.

Cases at rest have the static solution, and no motion; one that the balance does not solve has none by a hypothesis.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler.threads import thread_count
from qsbearing.model.effects.entry import with_found
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.effects.traction import Traction
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.flatten import CaseMaker
from qsbearing.model.solution.friction_balance import Unread, balanced, spanned
from qsbearing.model.solution.moved import STRAIGHT, Moved
from qsbearing.model.solution.solution import Solution, preloaded_of
from qsbearing.model.solution.solved_cases import solved_of

ASSUMED = Traction()
"""The law where a scene gives none."""


def solve_moved(
    scene: Scene, solve: Callable[..., Solution], start: Solution | None, threads: int | None, again: Any
) -> Solution:
    """Solve every case of a scene whose balls friction moves.

    Args:
        solve: solves a scene under a hypothesis, from a start.
        start: a solution near this one.
        again: how the solution solves another scene.
    """
    began = time.perf_counter()
    law, workers = scene.traction or ASSUMED, thread_count(threads)
    if scene.bearing.is_arched:
        return _between_arches(scene, law, workers, began, again)
    if start is not None and start.friction is not None:
        start = start.friction.start
    # A scene whose balls friction may move is one under outer control too: it is not checked again.
    under_outer = solve(with_found(scene, {"raceway_control": RacewayControl.OUTER, "traction": None}), start=start)
    before = solved_of(under_outer)
    maker = CaseMaker(scene, before.maker.axial)
    balance = balanced(under_outer, maker, law, law.radial_points, law.points_around, threads=workers)
    which, cases, results = spanned(before.maker.shape, maker.shape), balance.inside.cases, balance.inside.results
    turns = cases["inner_speed"] != cases["outer_speed"]
    if not turns.all():
        results[~turns] = before.results[which][~turns]
    states = cases, results, before.positions[which], before.controls[which]
    moved = Moved(balance, turns, which)
    return Solution(maker, *states, time.perf_counter() - began, workers, preloaded_of(under_outer), again, moved)


def _turns(balance: Unread) -> NDArray:
    """Which cases do; and in all, leave out moments, which are not worked out."""
    cases, results = balance.inside.cases, balance.inside.results
    is_held = np.arange(5) >= STRAIGHT
    results["load"][(cases["displacement_given"] != 0) & is_held] = np.nan
    return np.asarray(cases["inner_speed"] != cases["outer_speed"])


def _between_arches(scene: Scene, law: Traction, workers: int, began: float, again: Any) -> Solution:
    """Of a four-point bearing, of which no hypothesis gives a start."""
    maker = CaseMaker(scene)
    balance = balanced(None, maker, law, law.radial_points, law.points_around, threads=workers)
    turns = _turns(balance)
    balls = maker.count, maker.ball_axis
    states = balance.inside.cases, balance.inside.results, np.full((*balls, 3), np.nan), np.zeros(balls, np.int8)
    moved = Moved(balance, turns, np.arange(maker.count))
    return Solution(maker, *states, time.perf_counter() - began, workers, None, again, moved)
