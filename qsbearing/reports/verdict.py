"""The answer that a report opens with: whether limits hold, which is the closest, and what to read first."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from qsbearing.documents.model import Callout
from qsbearing.model.solution.limit import Answer, Standing
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.remarks.kinds import Severity
from qsbearing.remarks.remark import Remark, row_name
from qsbearing.remarks.wording import capital, listed
from qsbearing.results.requirements import headline, numbers_of

THEN = {
    Severity.WRONG_MODEL: "Read the warnings before using any number.",
    Severity.INCOMPLETE_MODEL: "The model is incomplete for this case: see the warnings.",
    Severity.CHECK_DATA: "Check the data: see the warnings.",
    Severity.GOOD_TO_KNOW: "",
}


def verdict(
    every: Sequence[Answer], said: Iterable[Remark], required: Sequence[Answer] = (), rows: Sequence[object] = ()
) -> Callout:
    """Whether what is required is met, whether all other limits hold, and which of these is the closest.

    Args:
        every: answers to the limits that hold anyway.
        said: all remarks.
        required: answers to what is required.
        rows: of a set, to name them.
    """
    worst = min((each.kind.severity for each in said), default=Severity.GOOD_TO_KNOW)
    beyond = [each for each in every if each.state is Standing.NOT_MET]
    doubts = [each.limit.doubt for each in every if each.limit.doubt]
    closest = ""
    if beyond:
        first = " ".join(
            f"{capital(listed(_of_limit(one, rows) for one in each))}: "
            f"beyond the limit{f', unless {unless}' if unless else ''}."
            for unless, each in _by_unless(beyond).items()
        )
    elif worst is Severity.WRONG_MODEL:
        first = "The model does not describe this case."
    else:
        nearest = max(every, key=lambda each: np.nan_to_num(each.used, nan=-1.0))
        first, closest = "Within every limit that was checked.", f"The closest is {_of_limit(nearest, rows)}."
    sentences = list(filter(None, (headline(required) if required else "", first, closest, *doubts, THEN[worst])))
    states = {each.state for each in required}
    is_bad = any(each.unless is None for each in beyond) or worst is Severity.WRONG_MODEL or Standing.NOT_MET in states
    is_good = not beyond and not doubts and worst is Severity.GOOD_TO_KNOW and states <= {Standing.MET}
    status = "fail" if is_bad else "pass" if is_good else "warning"
    return Callout(" ".join(sentences), status, sentences[0])


def of_requirements(required: Sequence[Answer]) -> Callout:
    """How many of what is required are met."""
    states = {each.state for each in required}
    status = "fail" if Standing.NOT_MET in states else "warning" if Standing.OPEN in states else "pass"
    return Callout(headline(required), status, headline(required))


def unless(answer: Answer) -> str:
    """Beyond the limit, but not beyond another estimate of it: what that one needs; else empty."""
    other = answer.unless
    if other is None:
        return ""
    value = numbers_of(answer._replace(bound=other.value))[1]
    return f"{other.needs} (the limit is then {value} {printed_unit(answer.limit.unit)}".rstrip() + ")"


def _by_unless(beyond: Iterable[Answer]) -> dict[str, list[Answer]]:
    groups: dict[str, list[Answer]] = {}
    for each in beyond:
        groups.setdefault(unless(each), []).append(each)
    return groups


def text_of(answer: Answer) -> str:
    """The number and its limit."""
    value, bound = numbers_of(answer)
    link = "of" if answer.limit.sense == "<=" else "for at least"
    return f"{value} {link} {bound} {printed_unit(answer.limit.unit)}".rstrip()


def _of_limit(answer: Answer, rows: Sequence[object]) -> str:
    number = answer.worst.row
    row = f" of {row_name(rows[number - 1], number - 1)}" if number and rows else ""
    part = f" ({100.0 * answer.used:.0f} %)" if np.isfinite(answer.used) else ""
    return f"{answer.limit.name}{row}, {text_of(answer)}{part}"
