"""`solve`: all cases of a scene as it stands, in threads; the one place where the parts meet."""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import fields, is_dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler.compiled import is_fast_for
from qsbearing.model.compiler.threads import in_threads, thread_count
from qsbearing.model.effects.ball_expansion import BallExpansion
from qsbearing.model.effects.ball_motion import MotionOfBalls
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.kernel.admissibility import CONVERGED
from qsbearing.model.kernel.case import CASE, RESULT
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.closing_seats import solve_closing, with_touching
from qsbearing.model.solution.common_motion import solve_common
from qsbearing.model.solution.flatten import CaseMaker
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.solve_records import solve_records
from qsbearing.model.solution.solved_cases import KEPT, solved_of
from qsbearing.model.validation import ErrorDetail, check_kind, raise_if_any

TOLERANCE = 1e-12
RESIDUALS = (1e-13, 1e-6)
"""What may be asked of the solver: from just above rounding to an imbalance that leaves all digits of tables right."""
LEAST_BATCH = 100
"""So many cases are solved in lanes, as far as lanes know them: there 32 take 0.7 of the time, 128 0.6, 256 0.5; of
fewer than a hundred that is less than a millisecond."""


def check_residual(residual_tolerance: float) -> None:
    """See that the solver can be asked for it.

    Raises:
        ValueError: it is out of range.
    """
    least, most = RESIDUALS
    if not least <= residual_tolerance <= most:
        raise ValueError(
            f"residual_tolerance = {residual_tolerance:g}: must lie between {least:g} (rounding) and {most:g} (beyond "
            "it, results would be wrong in digits that tables show)"
        )


def solve(
    scene: Scene, *, start: Solution | None = None, threads: int | None = None, tolerance: float = TOLERANCE
) -> Solution:
    """Solve every case of a scene.

    Args:
        scene: what to solve; its array fields broadcast to the case axes.
        start: a solution near this one (same case axes and ball axis, or a single case) to continue from.
        threads: at most this many; None: the environment variable QSBEARING_THREADS, else all cores.
        tolerance: largest imbalance over the largest force at which a case counts as solved. Where rounding forbids
            it, 1e-10 is accepted and `Solution.residual` states it.

    Returns:
        Solution: raises nothing for a physical outcome; `status` and `qs.message` say what happened, case by case.

    Raises:
        SceneError: a temperature that a heat balance should have found.
        ValueError: array fields that do not broadcast, a start of other axes, a tolerance or thread count out of range.
    """
    if not 0.0 < tolerance <= 0.1:
        raise ValueError(f"tolerance = {tolerance}: must lie between 0 and 0.1")
    if scene.tolerance is not None:
        raise ValueError("the scene leaves its effects to be chosen: solve it by `qsbearing.solve`")
    raise_if_any(unfound_errors(scene.ring_effects))
    scene = with_touching(scene, {}) if scene.ring_effects else scene
    if scene.raceway_control is RacewayControl.FRICTION:
        from qsbearing.model.solution.moved_solution import solve_moved  # loaded only where friction moves the balls

        again = partial(solve, threads=threads)
        return solve_moved(scene, partial(again, tolerance=tolerance), start, threads, again)
    if scene.elastic_rings is not None and scene.ring_expansion is not None:
        return solve_closing(scene, partial(_solve, start=start, threads=threads, tolerance=tolerance))
    return _solve(scene, start, threads, tolerance)


def _solve(
    scene: Scene,
    start: Solution | None,
    threads: int | None,
    tolerance: float,
    motion: dict[str, NDArray] | None = None,
) -> Solution:
    """With seats as the scene has them.

    Args:
        motion: of balls that all move alike; empty: each has its own; None: as the scene says.
    """
    if motion is None and scene.ball_motion is MotionOfBalls.COMMON:
        return solve_common(scene, start, lambda of, near, common: _solve(of, near, threads, tolerance, common))
    began = time.perf_counter()
    as_preloaded = scene.as_preloaded
    preloaded = None if as_preloaded is None else solve(as_preloaded, threads=threads)
    maker = CaseMaker(scene, _preloaded(scene, preloaded), motion)
    count = maker.count
    states = _start(start, maker)
    cases = np.empty(count, CASE) if count <= KEPT else None
    workers = thread_count(threads)

    in_lanes = start is None and count >= LEAST_BATCH and are_lanes_fast_for(count)

    def solve_stretch(part: slice) -> None:
        records = maker.make(part.start, part.stop, None if cases is None else cases[part])
        results, positions, controls = (array[part] for array in states)
        own = maker.own_balls(records, part.start)
        into = results, positions, controls
        solve_records(records, maker.ball_axis, own, tolerance, start is not None, into, in_lanes=in_lanes)

    in_threads(solve_stretch, count, workers)
    again = partial(solve, threads=threads)
    return Solution(maker, cases, *states, time.perf_counter() - began, workers, preloaded, again)


def are_lanes_fast_for(count: int) -> bool:
    """Whether lanes are machine code; in plain Python they are slower than one case at a time."""
    from qsbearing.model.kernel.lanes import solve_in_lanes

    return is_fast_for(solve_in_lanes, count)


def _preloaded(scene: Scene, preloaded: Solution | None) -> dict[str, Any]:
    """What the preload makes of the axial channel."""
    if scene.preload is None:
        return {}
    if preloaded is None:
        return {"axial_load": scene.preload.spring}
    held, rings = preloaded.displacement[..., 0], scene.ring_expansion
    # A length of the shaft, which grows as it does.
    return {"axial_displacement": held if rings is None else held * (1.0 + rings.seat_strains(scene.bearing)[0])}


def _start(start: Solution | None, maker: CaseMaker) -> tuple[NDArray, NDArray, NDArray]:
    """Results, ball positions and controls to fill, holding the start where there is one."""
    count, balls = maker.count, maker.ball_axis
    results = np.empty(count, RESULT)
    positions, controls = np.empty((count, balls, maker.position_size)), np.zeros((count, balls), np.int8)
    if start is None:
        return results, positions, controls
    if not isinstance(start, Solution):
        raise TypeError(f"start = {start!r}: must be a Solution")
    before = solved_of(start)
    if before.maker.ball_axis != balls or before.maker.count not in (1, count):
        raise ValueError(
            f"start has case axes {start.shape} and {before.maker.ball_axis} balls; the scene has {maker.shape} and "
            f"{balls}: a start must match, or be a single case with as many balls"
        )
    results[:], controls[:] = before.results, before.controls
    both = min(positions.shape[-1], before.positions.shape[-1])
    positions[..., both:], positions[..., :both] = 0.0, before.positions[..., :both]
    # A start that failed holds no place to continue from; zero is one that every solve leaves by its own means.
    failed = results["status"] != CONVERGED
    results["displacement"][failed], positions[failed], controls[failed] = 0.0, 0.0, 0
    return results, positions, controls


def unfound_errors(effects: Iterable[Any]) -> list[ErrorDetail]:
    """Errors of effects that are to be solved with no temperature of the balls."""
    if not any(isinstance(each, BallExpansion) and each.ball_temperature is None for each in effects):
        return []
    cause = "Give it, or a heat balance that has the balls"
    return [ErrorDetail("ball_expansion.ball_temperature", "missing", cause=cause)]


def stiffness(scene: Scene, solution: Solution) -> NDArray:
    """`solution.stiffness`, after a check that the solution belongs to this scene.

    Returns:
        Stiffness matrix, (*cases, 5, 5) [N/m, N/rad, N m/m, N m/rad].

    Raises:
        ValueError: the solution belongs to another scene.

    Examples:
        >>> scene = qs.load_scene("b218")
        >>> print(f"{qs.stiffness(scene, qs.solve(scene))[0, 0] * qs.um:.1f} N/µm")
        289.2 N/µm
    """
    check_kind("stiffness", scene, "Scene")
    check_kind("stiffness", solution, "Solution")
    if not (scene is solution.scene or _is_equal(scene, solution.scene)):
        raise ValueError(
            "this solution belongs to another scene: solution.stiffness needs none, or solve this one first"
        )
    return solution.stiffness


def _is_equal(one: Any, other: Any) -> bool:
    """Whether two scenes, or parts of scenes, are given the same; their numbers may be arrays."""
    if isinstance(one, tuple) and isinstance(other, tuple):
        return len(one) == len(other) and all(map(_is_equal, one, other))
    if is_dataclass(one) and type(one) is type(other):
        given = [field.name for field in fields(one) if field.init]
        return all(_is_equal(getattr(one, name), getattr(other, name)) for name in given)
    return np.array_equal(one, other)
