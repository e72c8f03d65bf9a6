"""Why a scene needs each effect and choice or does not: what leaving it out changes, cost in time, verdict."""

from __future__ import annotations

import statistics
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from qsbearing.documents.numbers import plain
from qsbearing.files.file_keys import IN_FILE, line
from qsbearing.model.compiler.compiled import is_compiled
from qsbearing.model.effects import EFFECTS, QUANTITIES, Entry
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.kernel.solve_case import solve_cases
from qsbearing.model.scene.arched_rings import NOTHING_TO_COMPARE, refuse_arched
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.changes import (
    Change,
    alternatives,
    changes,
    has_size_for,
    is_unknown_to_friction,
    requested,
)
from qsbearing.model.solution.comparison import by_quantity, moved
from qsbearing.model.solution.judgement import (
    WORTH_A_WARNING,
    changed,
    judge,
    percent,
    settings_to_add,
    shifted,
    unit_of,
)
from qsbearing.model.solution.ranges import KEYS, ranges
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.solver import solve
from qsbearing.model.units import um
from qsbearing.model.validation import Setting
from qsbearing.remarks.missing_effects import needed
from qsbearing.remarks.wording import Words
from qsbearing.studies.chooser import choose
from qsbearing.studies.chooser.by_friction import by_friction

NEEDED, NOT_NEEDED, NOT_ASSESSED = "needed", "not needed", "not assessed"
DATA_MISSING = "likely needed, data missing"

FEWEST, REPEATS = 3, 5
"""Solves, at least and at most, of which the median is the time."""
ENOUGH = 0.1
"""Seconds, after which a scene that takes long is not solved more often than it must be."""


@dataclass(frozen=True)
class Assessment:
    """What there is to say about one effect or choice at one case; null for what there is not."""

    effect: str
    what: str
    in_scene: bool
    indicator: float | None
    predicted: dict[str, float | None] | None
    """Relative change of the reported results if it is left out, or was, as its indicator estimates it; null where its
    parameters are not known."""
    actual: dict[str, float | None] | None
    """The same, found by solving with and without it; null where its parameters are not known."""
    time_with_over_without: float | None
    """Where the kernel runs compiled."""
    verdict: str
    why: str
    add: list[str]
    """Lines for a scene file that lacks it, under [effects]."""
    assumed: list[dict[str, Any]]
    """What solving with usual parameters finds where its own are not known: `actual` and `displacement_um` under each
    assumption, with words for it; empty else."""
    alternatives: list[dict[str, Any]]
    """What solving finds of a choice, by each other member that the scene's is judged against, all displacements and
    stiffnesses; `actual` of the row is the largest of them. Empty for an effect."""
    range: dict[str, dict[str, Any]]
    """From where to where displacement and locked stiffness go by all that was solved, and by which; see
    `qsbearing.model.solution.ranges`."""
    displacement_um: float | None = None
    """By how much `actual` changes displacements; of others see `assumed`."""
    needs: str = ""
    """What to give to add it: of what the scene and the catalogue do not have."""
    by_friction: dict[str, Any] | None = None
    """`ByFriction`: of raceway control, what friction itself gives; null else."""
    under_control: str = ""
    """"outer" where friction moves the balls and does not know it: all changes are then those under outer control, and
    displacements and stiffnesses friction's with these changes."""

    @property
    def solved(self) -> list[dict[str, float | None]]:
        """What it changes: in all, or else under each assumption."""
        errors = [self.actual, *(each["actual"] for each in self.assumed)]
        return [each for each in errors if each is not None]

    def size(self, quantity: str) -> float:
        """The largest change of one of `QUANTITIES`."""
        return max((each[quantity] or 0.0 for each in self.solved), default=0.0)

    @property
    def largest(self) -> str:
        """The one of `QUANTITIES` that it changes most; empty where nothing was solved."""
        return max(QUANTITIES, key=self.size) if self.solved else ""

    @property
    def is_large(self) -> bool:
        """Whether it changes some result by so much that a scene without it is warned of."""
        is_told = all(value is not None for each in self.solved for value in each.values())
        return not is_told or any(self.size(name) > WORTH_A_WARNING for name in QUANTITIES)

    def change(self, quantity: str) -> str:
        """What leaving it out changes of one of `QUANTITIES`, in its unit; after ≈ where its parameters are assumed,
        from the first assumption to the last."""
        is_own = self.actual is not None
        own = {"actual": self.actual, "displacement_um": self.displacement_um}
        with_solution = [each for each in ([own] if is_own else self.assumed) if each["actual"] is not None]
        shown = list(dict.fromkeys(_change(each, quantity, is_own) for each in with_solution)) or ["-"]
        return shown[0] if is_own or shown in (["0"], ["-"]) else "≈ " + "\nto ".join(shown)

    def change_in(self, quantity: str) -> str:
        """The change of a quantity with its unit, on one line."""
        return f"{self.change(quantity)} {unit_of(quantity)}".replace("\n", " ")


def _change(compared: dict[str, Any], quantity: str, is_own: bool) -> str:
    """Of one of the quantities, as a solve with and one without found it, with the scene's own parameters or not."""
    part = compared["actual"][quantity] if unit_of(quantity) == "%" else compared["displacement_um"]
    if part is None:
        return "-"
    return shifted(part) if unit_of(quantity) != "%" else percent(part, "") if is_own else changed(part, "")


def two_digits(value: float | None) -> str:
    """A number in so many; a dash where there is none."""
    return "-" if value is None else plain(value, ".2g")


def explain(scene: Scene, tolerance: float, words: Words = IN_FILE) -> tuple[Solution, list[Assessment]]:
    """The scene's solution, and a row for every effect and choice, named by the scene or not.

    Each is solved with and without; with usual parameters where it takes some that the scene does not give.

    Args:
        scene: a single case, with its effects as it names them.
        tolerance: the relative error below which an effect is not needed.
        words: of whoever reads it.

    Raises:
        ValueError: the scene has array fields.
    """
    refuse_arched(scene.bearing, "`explain`", NOTHING_TO_COMPARE)
    solution = choose.solve(scene)
    if solution.shape:
        raise ValueError(f"the scene has cases {solution.shape}: effects are explained for one case at a time")
    return solution, [_row(entry, solution, tolerance, words) for entry in EFFECTS]


def _row(entry: Entry, solution: Solution, tolerance: float, words: Words) -> Assessment:
    scene = solution.scene
    finer, coarser = entry.finer(scene), entry.coarser(scene)
    ratio, change = None, SolvedChange()
    if solution.converged:
        change = against_others(entry, solution)
        is_timed = bool(change.alternatives) and is_compiled(solve_cases)
        if finer is not coarser and (entry.switch.members is None or is_timed):
            actual, by, ratio = _solved(finer, coarser)
            change = change if is_timed else SolvedChange(actual, by)
    row = row_of(entry, solution, entry.is_in(scene), change, tolerance, words)
    moved_by = by_friction(entry, solution)
    if moved_by is not None:
        row = replace(row, by_friction=vars(moved_by), why="; ".join(filter(None, (row.why, moved_by.text))))
    if change.actual is None:
        return row
    judged = judge(entry, solution)
    (indicator,) = (as_floats({"": judged.indicator}) or {}).values()
    return replace(row, indicator=indicator, predicted=as_floats(judged.errors), time_with_over_without=ratio)


@dataclass(frozen=True)
class SolvedChange:
    """What solving finds of one effect or choice."""

    actual: dict[str, Any] | None = None
    """The largest change of each quantity; None where its parameters are not known, or nothing is compared."""
    moved: Any = None
    """The largest change of a displacement [m]; None where its parameters are not known, or nothing is compared."""
    assumed: list[Change] = field(default_factory=list)
    alternatives: list[Change] = field(default_factory=list)
    beyond: str = ""
    """Why a change has no number."""


def against_others(entry: Entry, solution: Any) -> SolvedChange:
    """A choice against its other members, an effect that there is no solution with under assumptions about it."""
    if entry.switch.members is None:
        return SolvedChange(assumed=changes(entry, solution))
    others = alternatives(entry, solution)
    counted = [each for each in others if each.is_solved or not entry.hypothesis]
    actual = {name: np.max([each.errors[name] for each in counted], axis=0) for name in QUANTITIES} if counted else None
    by = max((float(moved(solution, each.displacement)) for each in counted), default=None)
    without = [each.under for each in others if not each.is_solved]
    return SolvedChange(
        actual, by, alternatives=others, beyond=f"without a solution: {'; '.join(without)}" if without else ""
    )


def row_of(
    entry: Entry, solution: Any, is_in: bool, change: SolvedChange, tolerance: float, words: Words = IN_FILE
) -> Assessment:
    """The row of what was found of one effect or choice of a scene or set, without predictions and times."""
    error = largest_of(change.assumed) if change.actual is None else float(max(change.actual.values()))
    is_unknown = is_unknown_to_friction(entry, solution)
    lacks_data = entry.needs and not is_in and entry.applies(requested(solution)) and not is_unknown
    needs = needed(entry, has_size_for(entry, solution), words) if lacks_data else ""
    judged, why = verdict(entry, solution, needs, error, tolerance, change.assumed)
    if is_unknown and error is not None:
        judged = DATA_MISSING if judged == NEEDED and entry.needs else judged
        whats = "".join(f" of {each}" for each in dict.fromkeys(each.what for each in change.assumed) if each)
        why = f"balls that friction moves do not know it; the numbers are those{whats} under outer control"
    several = change.alternatives or change.assumed
    spans = ranges(solution, several)
    is_open = len(several) > 1 and judged in (NOT_ASSESSED, DATA_MISSING)
    said = [each.text for each in spans.values() if is_open and each.moves]
    told = _told(solution, change.alternatives)
    others = [one | _channels(each) for one, each in zip(told, change.alternatives, strict=True)]
    return Assessment(
        effect=entry.name,
        what=entry.what,
        in_scene=is_in,
        indicator=None,
        predicted=None,
        actual=as_floats(change.actual),
        time_with_over_without=None,
        verdict=judged,
        why="; ".join(filter(None, (why, ", ".join(said), change.beyond))),
        add=[] if is_unknown else lines_to_add(requested(solution), entry),
        assumed=_told(solution, change.assumed),
        alternatives=others,
        range={name: each.record for name, each in spans.items()},
        displacement_um=in_um(change.moved),
        needs=needs,
        under_control=str(RacewayControl.OUTER) if is_unknown else "",
    )


def _channels(of: Change) -> dict[str, dict[str, float | None] | None]:
    """Displacements and stiffnesses by their keys; null without a solution."""
    if not of.is_solved:
        return dict.fromkeys(KEYS)
    return {
        name: as_floats({each.key: each.of(getattr(of, name)) for each in results}) for name, results in KEYS.items()
    }


def lines_to_add(of: Any, entry: Entry) -> list[str]:
    """What the file of a scene or set says under [effects] to ask for it besides, or for the finest of a choice."""
    members = entry.switch.members
    if members is not None and members.finest is not None and members.others(of):
        now = getattr(of, entry.switch.slot)
        return [] if now == members.finest else [line(Setting(entry.switch.slot, members.finest))]
    return [line(each) for each in settings_to_add(of, [entry])]


def largest_of(assumed: list[Change]) -> float | None:
    """The largest change under any assumption that has a solution; None where none has."""
    solved = [float(each.largest) for each in assumed if each.is_solved]
    return max(solved) if solved else None


def _told(solution: Any, compared: list[Change]) -> list[dict[str, Any]]:
    """As a row has them."""
    return [
        {
            "under": each.under,
            "what": each.what,
            "actual": as_floats(each.errors) if each.is_solved else None,
            "displacement_um": in_um(moved(solution, each.displacement)) if each.is_solved else None,
        }
        for each in compared
    ]


def in_um(length: Any) -> float | None:
    """A plain number; null for what is none."""
    return float(length / um) if length is not None and np.isfinite(length) else None


def as_floats(errors: dict[str, Any] | None) -> dict[str, float | None] | None:
    """Plain numbers; null for what is none."""
    return None if errors is None else {name: float(x) if np.isfinite(x) else None for name, x in errors.items()}


def verdict(
    entry: Entry,
    solution: Any,
    needs: str,
    error: float | None,
    tolerance: float,
    assumed: list[Change],
) -> tuple[str, str]:
    """Whether it is needed, and why not so where that cannot be judged.

    Args:
        solution: of the scene or set that has it or not.
        needs: what to give to add it; empty where it is there or needs nothing.
        error: the largest change of all reported results; None where there is none.
        assumed: from which it is, where the parameters are not known.
    """
    of = "set" if hasattr(solution, "set") else "scene"
    if not solution.converged:
        return NOT_ASSESSED, f"the {of} has no solution to judge by"
    if needs:
        whats = " and ".join(dict.fromkeys(each.what for each in assumed))
        if error is None:
            unsolved = f"; solved with {whats}, the {of} has no solution" if assumed else ""
            return NOT_ASSESSED, f"needs {needs}{unsolved}"
        why = f"needs {needs}; the numbers are those of {whats}"
        return (DATA_MISSING if error > tolerance else NOT_ASSESSED), why
    if error is None:
        return NOT_ASSESSED, "does not apply here"
    if error > tolerance and entry.hypothesis:
        is_solved_for = getattr(solution, "friction", None) is not None
        return NOT_ASSESSED, "friction is solved for: hypotheses would say this" if is_solved_for else entry.hypothesis
    return (NEEDED if error > tolerance else NOT_NEEDED), ""


def _solved(finer: Scene, coarser: Scene) -> tuple[dict[str, Any], Any, float | None]:
    """What a solve with it and one without differ by, of a displacement [m] too, and the time of the first over that of
    the other: medians of solves in turn, of the compiled kernel; None where it runs as plain Python."""
    scenes = finer, coarser
    solutions = [solve(each, threads=1) for each in scenes]
    times = [[each.seconds] for each in solutions]
    with_it, without = solutions
    if not is_compiled(solve_cases):
        return by_quantity(without, with_it), moved(without, with_it.displacement), None
    while len(times[0]) < FEWEST or (len(times[0]) < REPEATS and sum(map(sum, times)) < ENOUGH):
        solutions = [solve(each, threads=1) for each in scenes]
        for taken, each in zip(times, solutions, strict=True):
            taken.append(each.seconds)
    ratio = statistics.median(times[0]) / statistics.median(times[1])
    return by_quantity(without, with_it), moved(without, with_it.displacement), ratio
