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
from qsbearing.model.effects.hypotheses import under_control
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.effects.traction import Traction
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.flatten import CaseMaker
from qsbearing.model.solution.friction_balance import FrictionMotion, balanced, spanned
from qsbearing.model.solution.moved import STRAIGHT, Moved
from qsbearing.model.solution.solution import Solution


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
    law, workers = scene.traction or Traction(), thread_count(threads)
    if scene.bearing.is_arched:
        return _between_arches(scene, law, workers, began, again)
    if start is not None and start.friction is not None:
        start = start.friction.start
    under_outer = solve(under_control(scene, RacewayControl.OUTER), start=start)
    maker = CaseMaker(scene, under_outer.maker.axial)
    motion = balanced(under_outer, maker, law, law.radial_points, law.points_around, threads=workers)
    which, cases, results = spanned(under_outer.maker.shape, maker.shape), motion.inside.cases, motion.inside.results
    turns = cases["inner_speed"] != cases["outer_speed"]
    results[~turns] = under_outer.results[which][~turns]
    states = cases, results, under_outer.positions[which], under_outer.controls[which]
    moved = Moved(motion, turns, which, scene.operating_bearing)
    return Solution(maker, *states, time.perf_counter() - began, workers, under_outer.preloaded, again, moved)


def _turns(motion: FrictionMotion) -> NDArray:
    """Which cases do; and in all, leave out moments, which are not worked out."""
    cases, results = motion.inside.cases, motion.inside.results
    is_held = np.arange(5) >= STRAIGHT
    results["load"][(cases["displacement_given"] != 0) & is_held] = np.nan
    return np.asarray(cases["inner_speed"] != cases["outer_speed"])


def _between_arches(scene: Scene, law: Traction, workers: int, began: float, again: Any) -> Solution:
    """Of a four-point bearing, of which no hypothesis gives a start."""
    maker = CaseMaker(scene)
    motion = balanced(None, maker, law, law.radial_points, law.points_around, threads=workers)
    turns = _turns(motion)
    balls = maker.count, maker.ball_axis
    states = motion.inside.cases, motion.inside.results, np.full((*balls, 3), np.nan), np.zeros(balls, np.int8)
    moved = Moved(motion, turns, np.arange(maker.count), scene.bearing)
    return Solution(maker, *states, time.perf_counter() - began, workers, None, again, moved)
