"""What there is to say about solved cases, in sentences: how they ended, and what to beware of in their numbers.

Who says what: `bearing` speaks for the cases of a bearing and `bearing_set` for those of a set, which names the row
before what the row's own bearing has to say. Each other file makes the warnings of one subject, for a stretch of cases:
`balls`, `expansion`, `preload`, `missing_effects`. A reading says itself what there is to say of its own numbers.
"""

from __future__ import annotations

from qsbearing.messages import bearing, bearing_set
from qsbearing.messages.bearing_set import SetSolution
from qsbearing.ranked_warning import RankedWarning
from qsbearing.solution.case_index import Index
from qsbearing.solution.solution import Solution


def message(solution: Solution | SetSolution, index: Index = None) -> str:
    """One sentence on how a case of a bearing or set ended; of several cases without an index, how many ended how.

    Args:
        index: the case, along the solution's case axes; negative numbers count from the end.

    Raises:
        ValueError: the index does not name one case of this solution.
    """
    if isinstance(solution, Solution):
        return bearing.message(solution, index)
    return bearing_set.message(solution, index)


def warnings(solution: Solution | SetSolution, index: Index = None) -> list[RankedWarning]:
    """Sentences on what to beware of in the numbers of a case of a bearing or set; empty where there is nothing.

    First what says that the model is wrong for the case, then what to check of the data, then what is good to know;
    each sentence has its `rank`, and in `see` the page of the guide that has more.

    Of several cases without an index, one sentence for each kind of warning: how many cases have it, which is the
    first, and what there is to say about that one.

    Args:
        index: the case, along the solution's case axes; negative numbers count from the end.

    Raises:
        ValueError: the index does not name one case of this solution.
    """
    if isinstance(solution, Solution):
        return bearing.warnings(solution, index)
    return bearing_set.warnings(solution, index)
