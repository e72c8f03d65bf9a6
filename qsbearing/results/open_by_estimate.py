"""Requirements that are met as the model stands, but would not be with an effect that it leaves out, or by another
hypothesis: open.

What such an effect changes has been solved for remarks, with usual numbers where its own are not known
(`qsbearing.model.solution.changes`); here the required result is read off these solutions too. Where balls that
friction moves do not know an effect, friction's result is moved by its change under outer control.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from qsbearing.model.effects import EFFECTS
from qsbearing.model.solution.changes import (
    Change,
    beside_friction,
    changes,
    is_unknown_to_friction,
    known_changes,
    requested,
    rows_of,
)
from qsbearing.model.solution.judgement import judge
from qsbearing.model.solution.limit import Answer, Standing, WhyOpen, answers
from qsbearing.remarks.missing_effects import MOST_CASES
from qsbearing.results.readings_record import all_taken
from qsbearing.results.remarks import every_remark

ENTRIES = {entry.name: entry for entry in EFFECTS}


def with_estimates(given: Sequence[Answer], solution: Any, readings: Any) -> list[Answer]:
    """The answers; open where one that is met would not be.

    Args:
        readings: as `readings_record.all_taken` gives them.
    """
    met = [each for each in given if each.state is Standing.MET]
    if not met or not np.all(solution.converged) or np.prod(solution.shape) > MOST_CASES:
        return list(given)
    every_remark(solution, readings)  # which solves what matters most
    _solve_small_ones(solution, min(each.spare for each in met))
    otherwise = list(_otherwise(solution, met))
    return [_judged(each, (of for of in otherwise if of[1].limit is each.limit)) for each in given]


def _solve_small_ones(solution: Any, least: float) -> None:
    """Effects that remarks do not try, since they are predicted to change little: here that may be more than is to
    spare."""
    of = requested(solution)
    if getattr(solution, "choice", None) is not None:
        return
    for entry in EFFECTS:
        is_unknown = not entry.needs and is_unknown_to_friction(entry, solution)
        if entry.hypothesis or not (entry.can_be_added(of) or is_unknown):
            continue
        if max(float(np.max(judge(entry, row).largest)) for row in rows_of(solution)) > least:
            changes(entry, solution)


def _otherwise(solution: Any, met: Sequence[Answer]) -> Iterator[tuple[str, Answer, Change]]:
    """How each is answered with every change that has a solution, by the effect or choice."""
    limits = [each.limit for each in met]
    for name, several in known_changes(solution).items():
        for change in several:
            if change.solution is None or change.solution is solution or not np.all(change.is_solved):
                continue
            with_it = answers(change.solution, limits, all_taken(change.solution))
            if change.against is not None:
                without = answers(change.against, limits, all_taken(change.against))
                with_it = [_beside(*each) for each in zip(met, without, with_it, strict=True)]
            for answer in with_it:
                yield name, answer, change


def _beside(own: Answer, without: Answer, with_it: Answer) -> Answer:
    return own.moved_to(float(beside_friction(own.value, without.value, with_it.value, own.place.result.is_signed)))


def _judged(given: Answer, otherwise: Iterable[tuple[str, Answer, Change]]) -> Answer:
    missed = [each for each in otherwise if each[1].state is Standing.NOT_MET]
    if given.state is not Standing.MET or not missed:
        return given
    name, worst, change = min(missed, key=lambda each: each[1].spare)
    values = {"effect": name, "under": change.under, "found": worst.value}
    if change.against is not None:
        values["change_under"] = str(requested(change.against).raceway_control)
    return given._replace(state=Standing.OPEN, reason=WhyOpen("estimate", values))
