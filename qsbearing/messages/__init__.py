"""What there is to say about solved cases, in sentences: how they ended, and what to beware of in their numbers.

Who says what: `bearing` speaks for the cases of a bearing and `bearing_set` for those of a set, which names the row
before what the row's own bearing has to say. Each other file makes the warnings of one subject, for a stretch of cases:
`balls`, `expansion`, `preload`, `missing_effects`. A reading says itself what there is to say of its own numbers.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from qsbearing.messages import bearing
from qsbearing.model.ranked_warning import RankedWarning
from qsbearing.model.solution.case_index import Index
from qsbearing.model.solution.solution import Solution

if TYPE_CHECKING:
    from qsbearing.systems.sets.set_solution import SetSolution


def message(solution: Solution | SetSolution, index: Index = None) -> str:
    """One sentence on how a case of a bearing or set ended; for several without an index, how many have each status.

    Args:
        index: the case, along the solution's case axes; negative numbers count from the end.

    Raises:
        ValueError: the index does not name one case of this solution.
    """
    if isinstance(solution, Solution):
        return bearing.message(solution, index)
    from qsbearing.messages import bearing_set

    return bearing_set.message(solution, index)


def warnings(solution: Solution | SetSolution, index: Index = None) -> list[RankedWarning]:
    """Warnings about the results of a case of a bearing or set; an empty list if there are none.

    Those that say that the model does not describe the case come first, then those on input data to check, then
    remarks. Each warning is a sentence with a `rank`, and `see` names the page of the guide that explains it.

    For several cases without an index, there is one sentence for each kind of warning: how many cases have it, which
    case is the first, and the warning of that case.

    Args:
        index: the case, along the solution's case axes; negative numbers count from the end.

    Raises:
        ValueError: the index does not name one case of this solution.
    """
    if isinstance(solution, Solution):
        return bearing.warnings(solution, index)
    from qsbearing.messages import bearing_set

    return bearing_set.warnings(solution, index)
