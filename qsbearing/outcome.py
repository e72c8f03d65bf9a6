"""How a case ended, in sentences: its message, and warnings about what the numbers mean."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from qsbearing.operation import CHANNELS
from qsbearing.raceway_control import INNER
from qsbearing.solution import tangents
from qsbearing.verdict import (
    CONVERGED,
    FRICTION_WITHOUT_LOAD,
    NO_CONSISTENT_CONTROL,
    NO_EQUILIBRIUM,
    OPEN_SIDE,
    OVER_SHOULDER,
    RUNAWAY,
    UNLOADED_RING,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from qsbearing.solution import Solution

FRICTION_IN_DOUBT = 0.06
FRICTION_BEYOND = 0.1
"""Coefficients that lubricated steel contacts typically offer lie between these."""

STATIC_PRESSURE_LIMIT = 4200e6
"""Contact pressure of the static load rating of ball bearings (ISO 76) [Pa]: a permanent dent of 1e-4 D."""

SMALL_TILT = 0.02
"""Tilts are taken as small rotations; at this size [rad] the neglected square is 2 % of the tilt itself."""

IDLE_STIFFNESS = 1e-9
"""A direction this much softer than the stiffest is resisted by rounding only."""


def _flat_index(solution: Solution, index: int | tuple[int, ...]) -> int:
    index = index if isinstance(index, tuple) else (index,)
    return int(np.ravel_multi_index(index, solution.shape)) if solution.shape else 0


def message(solution: Solution, index: int | tuple[int, ...] = ()) -> str:
    """One sentence on how a case ended.

    Args:
        index: the case, along the solution's case axes; nothing for a single case.
    """
    k = _flat_index(solution, index)
    code, notes = int(solution._codes[k]), int(solution._notes[k])
    if code == CONVERGED:
        return (
            f"Balls and ring are in balance: largest imbalance {solution._residual[k]:.1e} of the largest force, "
            f"after {solution._iterations[k]} iterations."
        )
    if code == NO_EQUILIBRIUM:
        return _why_no_equilibrium(solution, k, notes)
    return (
        f"No balance found: the best imbalance was {solution._residual[k]:.1e} of the largest force after "
        f"{solution._iterations[k]} iterations. That does not prove that there is none; a start from a neighbouring "
        "solution (lower speed, more load) may reach it."
    )


def _why_no_equilibrium(solution: Solution, k: int, notes: int) -> str:
    case = solution._maker.make(k, k + 1)[0]
    if notes & RUNAWAY:
        ring = np.where(case["is_held"].astype(bool), 0.0, np.nan_to_num(np.abs(solution._ring[k]), nan=np.inf))
        names = " and ".join(CHANNELS[i].words for i in np.flatnonzero(ring > 0.5 * ring.max()))
        return f"No equilibrium: nothing supports the load in channel {names}; the ring moves without end."
    if notes & FRICTION_WITHOUT_LOAD:
        return (
            "No equilibrium under this raceway control: it wants the gyroscopic moment carried by friction at a "
            "contact that carries too little load or none; the ball slips."
            + (" Outer or per-ball control has no such demand." if case["control"] == INNER else "")
            + _where_it_ends(solution, k)
        )
    if notes & OPEN_SIDE:
        return (
            "No equilibrium: "
            + _unsupported(case)
            + (
                " Balls would have to press on the open side of the groove, at contact angles below zero. (A bearing "
                "with shoulders on both sides: kind = deep_groove.)"
            )
            + _where_it_ends(solution, k)
        )
    if notes & OVER_SHOULDER:
        return (
            "No equilibrium: a loaded inner contact lies at more than 90 degrees, over the shoulder of any groove: the "
            "inner ring cannot hold the balls against what throws or pulls them outward." + _where_it_ends(solution, k)
        )
    return "No equilibrium."


def _where_it_ends(solution: Solution, k: int) -> str:
    """Up to which speed there was a balance, where it was followed up from rest."""
    reached = solution._reached[k]
    return "" if reached >= 1.0 else f" It is so already at {100.0 * reached:.3g} % of the speed."


def _unsupported(case: NDArray) -> str:
    """Which channel the open side leaves unsupported."""
    loads = np.where(case["is_held"].astype(bool), 0.0, case["prescribed"])
    if not case["is_held"][0] and loads[0] < 0.0:
        return "the axial load is reversed and the axial channel has no support in that direction."
    if case["is_held"][0]:
        return "at the held axial displacement the axial channel does not keep the balls seated."
    side = np.abs(loads[1:]) / np.array([1.0, 1.0, 0.5 * case["pitch_diameter"], 0.5 * case["pitch_diameter"]])
    if side.max() == 0.0:
        side = np.abs(case["prescribed"][1:])
    worst = int(side.argmax()) + 1
    return f"channel {CHANNELS[worst].words} carries more than the axial load can keep seated."


def warnings(solution: Solution, index: int | tuple[int, ...] = ()) -> list[str]:
    """Sentences on what to beware of in a case's numbers; empty where there is nothing.

    Args:
        index: the case, along the solution's case axes; nothing for a single case.
    """
    k = _flat_index(solution, index)
    where = (index if isinstance(index, tuple) else (index,)) if solution.shape else ()
    if solution._codes[k] != CONVERGED:
        return []
    notes = int(solution._notes[k])
    found = []
    if notes & UNLOADED_RING:
        found.append("Nothing loads the ring: where it stands is not determined; one possible place is reported.")
    else:
        found += _idle_directions(solution, k)
    if notes & NO_CONSISTENT_CONTROL:
        found.append(
            "No consistent raceway control: with each choice some ball's loads call for the other. The last choice "
            "tried is reported; outer and inner control bound the answer."
        )
    found += _unloaded_balls(solution, where)
    found += _slipping_balls(solution, where)
    pressure = np.nanmax([np.nanmax(side.max_pressure[where]) for side in (solution.inner, solution.outer)])
    if pressure > STATIC_PRESSURE_LIMIT:
        found.append(
            f"Contact pressure reaches {pressure / 1e6:.0f} MPa, above the {STATIC_PRESSURE_LIMIT / 1e6:.0f} MPa of "
            "the static load rating: the contact yields, and the elastic numbers are no longer true."
        )
    tilt = np.abs(solution.displacement[where][3:]).max()
    if tilt > SMALL_TILT:
        found.append(f"The ring tilts by {tilt * 1e3:.0f} mrad: beyond the small rotations that the model assumes.")
    return found


def _ball_list(which: NDArray) -> str:
    numbers = np.flatnonzero(which)
    if numbers.size == which.size > 1:
        return f"all {which.size} balls"
    count = "1 ball" if numbers.size == 1 else f"{numbers.size} balls"
    return f"{count} (no. {', '.join(_runs(numbers))})"


def _runs(numbers: NDArray) -> list[str]:
    """Numbers as runs: 0, 3 to 7, 12."""
    breaks = np.flatnonzero(np.diff(numbers) != 1) + 1
    return [str(run[0]) if run.size == 1 else f"{run[0]} to {run[-1]}" for run in np.split(numbers, breaks)]


def _unloaded_balls(solution: Solution, where: tuple[int, ...]) -> list[str]:
    inner, outer = solution.inner.load[where], solution.outer.load[where]
    out_of_both = (inner == 0.0) & (outer == 0.0)
    out_of_inner = (inner == 0.0) & (outer > 0.0)
    found = []
    if out_of_both.any():
        found.append(f"{_ball_list(out_of_both)} carry no load; at rest such a ball has no defined place.")
    if out_of_inner.any():
        found.append(f"{_ball_list(out_of_inner)} have left the inner raceway and are held by the outer alone.")
    return found


def _slipping_balls(solution: Solution, where: tuple[int, ...]) -> list[str]:
    found = []
    for name, side in (("inner", solution.inner), ("outer", solution.outer)):
        if side.required_friction is None:
            continue
        friction = side.required_friction[where]
        slipping = np.nan_to_num(friction, nan=0.0) > FRICTION_IN_DOUBT
        if slipping.any():
            worst = float(np.nanmax(friction))
            verdict = (
                "more than lubricated contacts offer: expect gyroscopic slip, and take raceway control as broken"
                if worst > FRICTION_BEYOND
                else "in the range where lubricated contacts begin to slip"
            )
            found.append(
                f"The gyroscopic moment demands friction up to {worst:.3f} at the {name} raceway of "
                f"{_ball_list(slipping)}: {verdict} ({FRICTION_IN_DOUBT:g} to {FRICTION_BEYOND:g} is typical)."
            )
    return found


def _idle_directions(solution: Solution, k: int) -> list[str]:
    """Free directions that nothing resists, found as the null space of the stiffness of the free channels."""
    case = solution._maker.make(k, k + 1)
    matrix = tangents(solution, slice(k, k + 1), case)
    lever = 0.5 * case["pitch_diameter"][0] * case["length"][0]
    scale = np.array([1.0, 1.0, 1.0, 1.0 / lever, 1.0 / lever])
    free = np.flatnonzero(case["is_held"][0] == 0)
    if free.size == 0:
        return []
    scaled = (matrix[0] * np.outer(scale, scale))[np.ix_(free, free)]
    values, vectors = np.linalg.eigh(0.5 * (scaled + scaled.T))
    idle = np.abs(values) <= IDLE_STIFFNESS * max(np.abs(values).max(), np.finfo(float).tiny)
    if not idle.any():
        return []
    share = np.abs(vectors[:, idle]).max(axis=1)
    names = ", ".join(CHANNELS[free[i]].words for i in np.flatnonzero(share > 0.1))
    return [f"Nothing resists the ring in: {names}. What is reported there is not determined by the bearing."]
