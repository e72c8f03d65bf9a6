"""How a case of a bearing ended, in a sentence, and what there is to beware of in its numbers, as remarks."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.numbers import plain
from qsbearing.model.contact.hertz import STATIC_PRESSURE, first_yield_pressure
from qsbearing.model.effects import EFFECTS
from qsbearing.model.effects.raceway_control import INNER
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.case_index import Index
from qsbearing.model.solution.groups import CONTACTS, MAX_PRESSURE
from qsbearing.model.solution.judgement import estimated, settings_to_add
from qsbearing.model.solution.limit import Limit, spare
from qsbearing.model.solution.result_keys import MAX, Place
from qsbearing.model.solution.solution import Solution, preloaded_of
from qsbearing.model.solution.solved_cases import solved_of
from qsbearing.model.solution.status import Reason, Status
from qsbearing.model.units import MPa, mm
from qsbearing.remarks.balls import BALLS
from qsbearing.remarks.case_range import CaseRange, Subject
from qsbearing.remarks.expansion import EXPANSION
from qsbearing.remarks.hypotheses import hypotheses
from qsbearing.remarks.kinds import CHECK, NOTE, SEE_AXIS, WRONG, Kind
from qsbearing.remarks.missing_effects import missing_effects, to_add
from qsbearing.remarks.preload import preloads
from qsbearing.remarks.remark import Holding, Remark, remark
from qsbearing.remarks.ring import RING
from qsbearing.remarks.wording import Words, not_capital


def message(solution: Solution, index: Index = None) -> str:
    """One sentence on how a case ended; of several cases without an index, how many ended how."""
    if index is None and solution.shape:
        return f"{len(solution.codes)} cases: {solution.counts()}."
    k = solution.flat_index(index)
    status, residual, iterations = (
        np.ravel(each)[k] for each in (solution.status, solution.residual, solution.iterations)
    )
    if status == Status.CONVERGED:
        return (
            f"Balls and ring are in equilibrium: largest imbalance {residual:.1e} of the largest force, "
            f"after {iterations} iterations."
        )
    preloaded = preloaded_of(solution)
    if preloaded is not None:
        numbers = np.arange(len(preloaded.codes)).reshape(preloaded.shape)
        number = int(np.broadcast_to(numbers, solution.shape).reshape(-1)[k])
        if not np.ravel(preloaded.converged)[number]:
            place = tuple(map(int, np.unravel_index(number, preloaded.shape))) if preloaded.shape else None
            return f"At rest and cold, under its preload alone: {message(preloaded, place)}"
    if solution.friction is not None and np.ravel(solution.friction.skids)[k]:
        return (
            "Not converged: balls skid. Drag against their orbits is larger than the friction that drives them, "
            "mu Qi (1 + cos(ai - ao)): give a larger load, or less drag."
        )
    if status == Status.NO_EQUILIBRIUM:
        return _why_no_equilibrium(solution, k)
    if not iterations:
        return "Not solved: this row was not tried, since the set has no solution."
    return (
        f"Not converged: the last imbalance was {residual:.1e} of the largest force after {iterations} iterations. "
        "This does not prove that there is no equilibrium: continuing from a solution nearby (at a lower speed or a "
        "larger load) may find one."
    )


def _why_no_equilibrium(solution: Solution, k: int) -> str:
    solved = solved_of(solution)
    case = solved.maker.make(k, k + 1)[0]
    reason = np.ravel(solution.reason)[k]
    if reason == Reason.UNSUPPORTED:
        free = solution.free_channels
        if not free.size:
            return "No equilibrium: at the prescribed displacements, nothing supports the balls."
        ring = np.nan_to_num(np.abs(solved.results["displacement"][k][free]), nan=np.inf)
        names = " and ".join(CHANNELS[i].label for i in free[ring > 0.5 * ring.max()])
        return f"No equilibrium: nothing supports the load in channel {names}, and the ring moves away without limit."
    if reason == Reason.FRICTION_WITHOUT_LOAD:
        why = (
            " under this raceway control: friction would have to carry the gyroscopic moment at a contact with too "
            "little load or none, so that the ball slips."
        )
        if case["control"] == INNER:
            why += " Outer or per_ball control does not require this."
    elif reason == Reason.NO_ORBIT:
        why = (
            " under this raceway control: the two contact angles of a ball differ by so much that rolling would leave "
            "the ball standing, or carry it backwards. Outer control does not lead to this."
        )
        if case["inner_speed"] * case["outer_speed"] < 0.0:
            why = (
                ": between rings that turn against each other some ball would stand, or be carried backwards, and so "
                "press no raceway. Other ring speeds, or more load, do not lead to this."
            )
    elif reason == Reason.OPEN_SIDE:
        why = (
            f": {_unsupported(case)} Balls would have to press on the open side of the groove, at contact angles below "
            'zero. For a bearing with shoulders on both sides, write kind = "deep_groove".'
        )
    elif reason == Reason.OVER_SHOULDER:
        why = (
            ": the angle of a loaded inner contact is more than 90 degrees, where no groove has a shoulder: the inner "
            "ring cannot hold the balls against the forces that push them outward."
        )
    else:
        return "No equilibrium."
    return f"No equilibrium{why}" + _where(float(np.ravel(solution.speed_reached)[k]))


def _where(part: float) -> str:
    """At which part of the speed that shows, if not at the whole."""
    if part == 1.0:
        return ""
    return (
        f" This is already so at {plain(100.0 * part, '.3g')} % of the speed."
        if part > 0.0
        else " This is already so at rest."
    )


def _unsupported(case: NDArray) -> str:
    """Which channel the open side leaves unsupported."""
    held = case["displacement_given"].astype(bool)
    loads = np.where(held, 0.0, case["prescribed"])
    if held[0]:
        return "the prescribed axial displacement does not keep the balls in contact."
    if loads[0] < 0.0:
        return "the axial load acts in -x, and the bearing has no support in that direction."
    side = np.abs(loads[1:]) / np.array([1.0, 1.0, 0.5 * case["pitch_diameter"], 0.5 * case["pitch_diameter"]])
    causes = [f"the load in channel {CHANNELS[int(side.argmax()) + 1].label}"] if side.max() > 0.0 else []
    moved = [CHANNELS[i] for i in np.flatnonzero(held & (case["prescribed"] != 0.0))]
    causes += [f"the prescribed {each.label}{'' if each.is_rotation else ' displacement'}" for each in moved]
    if not causes:
        return "the axial load is too small to keep the balls in contact."
    return f"{' or '.join(causes)} is too large for the axial load to keep the balls in contact."


def chosen(solution: Any, named: Any, words: Words) -> list[str]:
    """What was chosen for a single case, beside the scene that was given: left out, with errors; and added."""
    choice = solution.choice
    if choice is None:
        return []
    what = {entry.name: entry.what for entry in EFFECTS}
    out = [f"{what[one.effect]}: {estimated(float(np.max(one.estimated_error)))}" for one in choice.left_out]
    left = f"left out, with the expected error: {'; '.join(out)}." if out else "nothing is left out."
    said = [f"Tolerance {choice.tolerance:g}: {left}"]
    if choice.added:
        added = [entry for entry in EFFECTS if entry.name in choice.added]
        what_added = ", ".join(entry.what for entry in added)
        how = not_capital(to_add(settings_to_add(named, added), words))
        said.append(
            f"Needed, and so simulated though the scene does not name it: {what_added}. "
            f"To have it whatever the tolerance, {how}"
        )
    return said


def _of_model(of: CaseRange) -> Iterator[Holding]:
    """Of effects and hypotheses; a four-point bearing knows no further ones."""
    if of.solution.opposite is None:
        yield from missing_effects(of)
        yield from hypotheses(of)


SUBJECTS = Subject(preloads, RING, BALLS, _of_model, EXPANSION)
"""All that there is to say of a bearing."""

APEX_PASSED = Kind(
    "apex_passed", WRONG, SEE_AXIS,
    "Ellipses on {raceways:the} raceway would pass the apex of its groove by {beyond_mm:.2g} mm: loads and pressures "
    "are not those of the bearing. A larger shim keeps them apart.",
)  # fmt: skip


@SUBJECTS.tells
def _apex(of: CaseRange) -> Iterator[Holding]:
    """Ellipses that would pass the apex between the arcs of a groove."""
    for name, arcs in of.solution.arcs_of_rings:
        margins = [each.apex_margin for each in arcs]
        known = [each.reshape(-1, each.shape[-1])[of.part] for each in margins if each is not None]
        if not known:
            continue
        least = np.fmin.reduce(np.fmin.reduce(known), axis=-1)

        def passed(i: int, name: str = name, least: NDArray = least) -> Remark:
            return remark(APEX_PASSED, name, beyond_mm=-least[i] / mm)

        yield least < 0.0, passed


STATIC_LIMIT = Limit(
    tuple(Place(group, MAX_PRESSURE, over=MAX) for group in CONTACTS), "<=", STATIC_PRESSURE / MPa,
    "ISO 76; beyond it permanent dents",
)  # fmt: skip
"""Of contact pressures; reports answer it, and remarks tell where it is not met."""
_YIELDING = (
    " Steel with a yield strength of {yield_strength_MPa:.5g} MPa begins to yield below the surface near "
    "{first_yield_MPa:g} MPa."
)
PRESSURE_DENTS = Kind(
    "pressure_dents", WRONG, "limits",
    "The contact pressure reaches {pressure_MPa:.0f} MPa, above ISO 76's static limit of {limit_MPa:.0f} MPa: "
    "expect permanent dents.",
    _YIELDING,
)  # fmt: skip
PRESSURE_YIELDS = Kind(
    "pressure_yields", NOTE, "limits",
    "The contact pressure reaches {pressure_MPa:.0f} MPa, below ISO 76's static limit of {limit_MPa:.0f} MPa.",
    _YIELDING,
)  # fmt: skip


@SUBJECTS.tells
def _pressure(of: CaseRange) -> Iterator[Holding]:
    """Dents, and first yield where the scene gives a yield strength."""
    solution = of.solution
    pressure = np.max([of.rows(side.max_pressure).max(axis=-1) for side in solution.arcs], axis=0)
    rings = solution.scene.ring_expansion
    strength = of.cases(inf if rings is None else rings.yield_strength)
    first_yield = strength * first_yield_pressure(1.0)

    def reached(kind: Kind, i: int) -> Remark:
        yielding: dict[str, Any] = {}
        if rings is not None:
            near = float(f"{first_yield[i] / MPa:.2g}")
            yielding = {"yield_strength_MPa": strength[i] / MPa, "first_yield_MPa": near}
        return remark(kind, pressure_MPa=pressure[i] / MPa, limit_MPa=STATIC_LIMIT.value, **yielding)

    dents = of.cases(spare(solution, [STATIC_LIMIT])) < 0.0
    yield dents, lambda i: reached(PRESSURE_DENTS, i)
    yield (pressure > first_yield) & ~dents, lambda i: reached(PRESSURE_YIELDS, i)


SPARSE = 0.25
"""Z D/(pi dm) below which some number is likely mistaken (chosen: less than half of what the catalogue's bearings have,
0.59 to 0.90; the 145 of the validation book's table of spindle bearings have 0.62 to 0.89)."""
BALLS_SPARSE = Kind(
    "balls_sparse", CHECK, "ten_minutes#2-write-your-own",
    "The balls fill {filled_percent:.2g} % of the pitch circle; 59 to 90 % is usual. Are ball count, ball "
    "diameter and pitch diameter right?",
)  # fmt: skip


@SUBJECTS.tells
def _sparse(of: CaseRange) -> Iterator[Holding]:
    bearing = of.solution.scene.bearing
    share = np.asarray(bearing.ball_count) * bearing.ball_diameter / (np.pi * np.asarray(bearing.pitch_diameter, float))
    filled = of.cases(share)
    yield filled < SPARSE, lambda i: remark(BALLS_SPARSE, filled_percent=100.0 * filled[i])
