"""A bearing or a set solved at its steady temperatures, and what there is to say of them."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.kernel.admissibility import NO_EQUILIBRIUM, NOT_CONVERGED
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution import solver
from qsbearing.model.solution.flatten import CaseMaker
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import SceneError
from qsbearing.systems.heat.hot import HotBearing, HotSystem
from qsbearing.systems.heat.speeds import follow_speeds
from qsbearing.systems.heat.state import SpeedCurve, ThermalState, ThermalVerdict, WholeBearing
from qsbearing.systems.heat.steady import Heated, Steady, feedback, find_steady
from qsbearing.systems.heat.transient import heat_up
from qsbearing.systems.heat.whole_bearing import with_whole_friction

FARTHEST = 1.5
"""Times the scene's speed: how far steady states are followed in speed."""


def solve(scene: Scene, *, threads: int | None = None, tolerance: float = solver.TOLERANCE) -> Solution:
    """Solve every case of a scene at its steady temperatures.

    Returns:
        Solution: of the scene at these temperatures, `thermal` with them; a case without a steady state counts as one
        without an equilibrium, or not converged where none was found.
    """
    shape = CaseMaker(scene).shape
    system = HotBearing(scene, shape, partial(solver.solve, threads=threads, tolerance=tolerance))
    solution: Solution = at_steady_temperatures(system)
    return solution


def at_steady_temperatures(system: HotSystem) -> Any:
    """The system's solution at its steady temperatures, with its `ThermalState`."""
    heated = Heated(system)
    steady = find_steady(heated)
    good = _is_stable(steady)
    verdict, curve = np.where(good, ThermalVerdict.STABLE, ThermalVerdict.UNDECIDED), None
    if not system.shape and not good:
        curve = follow_speeds(heated, FARTHEST)
        if curve.crossing is not None:
            steady = find_steady(heated, curve.crossing.powers)
            good = _is_stable(steady)
        verdict = np.asarray(ThermalVerdict.STABLE if good else _verdict_of(curve))
    solution, balance, without_steady_state = steady.solution, heated.balance, ~good
    if not good.all():
        cold = balance.temperatures(np.where(good, steady.x, 0.0))
        solution, _ = heated.at(cold)
        code = NOT_CONVERGED if (verdict == ThermalVerdict.UNDECIDED).any() else NO_EQUILIBRIUM
        without_steady_state = ~good & np.asarray(solution.converged)
        solution.mark_unsolved(without_steady_state, code)
    temperatures = balance.temperatures(np.where(good, steady.x, np.nan))
    made = np.where(good, steady.powers, np.nan)
    named = balance.named(temperatures)
    solution.thermal = ThermalState(
        temperatures=named,
        powers=dict(zip(balance.source_names, made, strict=True)),
        flows=balance.flows(named),
        imbalance=np.abs(balance.net_heat(temperatures, made)).max(axis=0, initial=0.0),
        feedback=np.where(good, feedback(steady.slopes), np.nan),
        free=balance.free,
        verdict=verdict,
        without_steady_state=without_steady_state,
        solves=heated.solved,
        thermal=system.thermal,
        speed=_speed(system),
        heat_up=partial(heat_up, system),
        follow=partial(_followed, curve, system),
        with_whole_friction=partial(_whole_bearing, system),
    )
    return solution


def _whole_bearing(system: HotSystem) -> WholeBearing:
    try:
        whole, assumed = with_whole_friction(system.of)
        return WholeBearing(at_steady_temperatures(system.alike(whole)).thermal, assumed, ())
    except SceneError as error:
        return WholeBearing(None, [], tuple(error.errors))


def _followed(known: SpeedCurve | None, system: HotSystem) -> SpeedCurve:
    """Not a closure: with a result, it is pickled."""
    return known or follow_speeds(Heated(system), FARTHEST)


def _speed(system: HotSystem) -> NDArray:
    """The larger one of both rings; shape (*cases)."""
    rings = system.operation.speed, system.operation.outer_speed
    speeds = np.broadcast_arrays(*(np.abs(0.0 if each is None else each) for each in rings))
    return np.broadcast_to(np.maximum(*speeds), system.shape)


def _is_stable(steady: Steady) -> NDArray:
    with np.errstate(invalid="ignore"):
        return np.asarray(steady.found & (feedback(steady.slopes) < 1.0))


def _verdict_of(curve: SpeedCurve) -> ThermalVerdict:
    """What the curve proves where it does not come to the scene's speed."""
    if curve.at_limit is None or curve.crossing is not None:
        return ThermalVerdict.UNDECIDED
    return ThermalVerdict.TOO_HOT if curve.fold is None else ThermalVerdict.RUNAWAY
