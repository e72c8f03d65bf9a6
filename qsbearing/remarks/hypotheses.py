"""Remark on what rests on a hypothesis of raceway control: from where to where the results go by all that there are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.gyroscopic_moment import ENTRY as GYROSCOPIC_MOMENT
from qsbearing.model.effects.raceway_control import ENTRY as RACEWAY_CONTROL
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.scene.moved_by_friction import friction_instead
from qsbearing.model.solution.changes import Change, alternatives, requested, rows_of
from qsbearing.model.solution.judgement import WORTH_A_WARNING, judge
from qsbearing.model.solution.of_cases import may_solve_alike
from qsbearing.model.solution.ranges import ranges
from qsbearing.remarks.case_range import CaseRange
from qsbearing.remarks.kinds import INCOMPLETE, SEE_HYPOTHESES, Kind
from qsbearing.remarks.remark import Holding, Remark
from qsbearing.remarks.wording import Audience, Words

WORTH_A_SOLVE = 5e-4
"""Of 2 |Mg|/(D Q), whether the scene has the moment or not. Below it no other hypothesis changed a displacement or
stiffness by more than 3.3 % (measured: 3,068 of 12,000 random scenes, each by all seven)."""
MOST_CASES = 16
"""More cases than these (chosen: more points than most load spectra have) are not solved again, six times each."""


_DIFFERING = "Raceway control is a hypothesis. By all hypotheses that have a solution, the"
_LIST = {
    Audience.PYTHON: "To see each: qsbearing explain FILE",
    Audience.FILE: "To see each: qsbearing explain FILE",
    Audience.PAGE: "The table of effects has the range",
}


def _differing(fields: Mapping[str, Any], words: Words) -> str:
    """What displacement and stiffness are by all hypotheses, and how to see each."""
    said = [
        f"{fields[name]} is {fields[f'{name}_least']:.4g} to {fields[f'{name}_most']:.4g} {fields[f'{name}_unit']} "
        f"(here {fields[f'{name}_here']:.4g})"
        for name in ("displacement", "stiffness")
        if name in fields and np.max(fields[f"{name}_most"]) > np.max(fields[f"{name}_least"])
    ]
    return f"{_DIFFERING} {' and the '.join(said)}. {_LIST[words.reader]}"


HYPOTHESES_DIFFER = Kind(
    "hypotheses_differ", INCOMPLETE, SEE_HYPOTHESES,
    f"{_DIFFERING} {{displacement}} is {{displacement_least:.4g}} to {{displacement_most:.4g}} "
    "{displacement_unit} (here {displacement_here:.4g}) and the {stiffness} is {stiffness_least:.4g} to "
    "{stiffness_most:.4g} {stiffness_unit} (here {stiffness_here:.4g}). To see each: qsbearing explain FILE",
    say=_differing,
    setting="effects.raceway_control={alternative}",
)  # fmt: skip


def hypotheses(of: CaseRange) -> Iterator[Holding]:
    """Of a scene or set, where few cases may be solved again; a row of a set has nothing to say of itself."""
    solution, part = of.solution, of.part
    if not of.may_solve or not may_solve_alike(solution) or requested(solution).raceway_control in (None, "friction"):
        return
    if np.prod(solution.shape) > MOST_CASES or not np.any(_inertia(solution) > WORTH_A_SOLVE):
        return
    changes = alternatives(RACEWAY_CONTROL, solution)
    matters = np.any([_matters(each, part) for each in changes], axis=0)

    def differing(i: int) -> Remark:
        values: dict[str, Any] = {"alternative": _another(solution)}
        for name, span in ranges(solution, changes, part.start + i).items():
            values |= {name: span.what, f"{name}_unit": span.unit}
            values |= {f"{name}_{end}": getattr(span, end) for end in ("here", "least", "most")}
        return Remark(HYPOTHESES_DIFFER, values=values)

    yield matters, differing


def _another(solution: Any) -> str:
    """No hypothesis but friction, where a bearing's balls may be moved by it as it stands; else another hypothesis."""
    if not hasattr(solution, "rows") and friction_instead(solution.scene):
        return str(RacewayControl.FRICTION)
    others = (RacewayControl.MINIMUM_DISSIPATION, RacewayControl.OUTER)
    return str(next(each for each in others if each != requested(solution).raceway_control))


def _inertia(solution: Any) -> NDArray:
    """Of the gyroscopic moment, whether the scene has it or not; the most of all rows."""
    return np.max([judge(GYROSCOPIC_MOMENT, row).indicator for row in rows_of(solution)], axis=0)


def _matters(change: Change, part: slice) -> NDArray:
    """Where it changes displacement or stiffness noticeably."""
    errors = [change.errors[name].reshape(-1)[part] for name in ("displacement", "stiffness")]
    is_solved = change.is_solved.reshape(-1)[part]
    return np.asarray(is_solved & (np.nan_to_num(np.max(errors, axis=0), nan=0.0) > WORTH_A_WARNING))
