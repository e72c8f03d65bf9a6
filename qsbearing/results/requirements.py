"""How a solution answers its limits, those that are required and those that hold anyway: as plain data and in words."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from qsbearing.documents.model import Badge, Block, Cell, Paragraph, Table
from qsbearing.documents.numbers import plain
from qsbearing.model.effects import EFFECTS
from qsbearing.model.solution.changes import requested
from qsbearing.model.solution.limit import MET, Answer, Limit, Standing, WhyOpen, answers
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.model.validation import check_kind
from qsbearing.remarks.wording import listed
from qsbearing.results.built_in_limits import WITHOUT_LIMIT, built_in_answers, not_checked
from qsbearing.results.readings_record import all_taken

if TYPE_CHECKING:
    from qsbearing.model.solution.solution import Solution
    from qsbearing.systems.sets.set_solution import SetSolution

SENTENCES = {
    "not_called_for": "the scene does not call for it: name in [effects] what it belongs to",
    "arguments_missing": "give [readings.{reading}] what it is computed from{missing}",
    "not_solved": "there is no solution to read it off",
    "no_number": "it has no number here",
    "estimate": "{what} it would be {found}{unit}{by}",
}
"""Why a limit is open, by `limit.OPEN`."""
COLOURS = {Standing.MET: "pass", Standing.NOT_MET: "fail", Standing.OPEN: "finding"}
DIGITS = range(4, 12)


class Answered(NamedTuple):
    """All answers of a solution."""

    required: list[Answer]
    """To what its scene or set requires."""
    built_in: list[Answer]
    """To the limits that hold anyway."""

    @property
    def not_checked(self) -> dict[str, str]:
        """Limits that nothing answers, and what each needs."""
        return not_checked(self.built_in)


def required_answers(solution: Solution | SetSolution, readings: Any) -> list[Answer]:
    """Those to what its scene or set requires; nothing is loaded where that is nothing.

    Raises:
        SceneError: a requirement on what is no result.
    """
    if not requested(solution).require:
        return []
    from qsbearing.files.require_table import required_limits
    from qsbearing.results.open_by_estimate import with_estimates

    return with_estimates(answers(solution, required_limits(solution), readings), solution, readings)


def requirements(solution: Solution | SetSolution) -> list[Answer]:
    """How a solution answers what its scene or set requires (`Scene.require`): `state` is met, not met or open, `value`
    and `bound` are in the unit of the result, `margin` is how much there is to spare, `worst` whose number decides.

    Of several cases the worst counts. Readings that a requirement names must be asked for, which files do by
    themselves; else it is open.

    Returns:
        An answer for each requirement of the scene, in its order.

    Raises:
        SceneError: a requirement on what is no result.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> print(qs.requirements(solution))
        []
    """
    check_kind("requirements", solution, "Solution", "SetSolution")
    return required_answers(solution, all_taken(solution))


def answered(solution: Solution | SetSolution, readings: Any) -> Answered:
    """All of them.

    Args:
        readings: as `readings_record.all_taken` gives them.
    """
    return Answered(required_answers(solution, readings), built_in_answers(solution, readings))


# In words


SIGNS = {"<=": "≤", ">=": "≥"}


def requested_for(of: Limit) -> str:
    """A requirement as tables have it: "≤ 1700"."""
    return f"{SIGNS[of.sense]} {_short(float(of.value))}"  # type: ignore[arg-type]


def as_badge(answer: Answer) -> Badge:
    """The answer as a word with its colour."""
    return Badge(verdict(answer), COLOURS[answer.state])


def name_of(answer: Answer) -> str:
    """What is limited, as whoever limits it calls it; of what its sign does not count."""
    return f"size of {answer.limit.name}" * answer.limit.is_of_sizes or answer.limit.name


def numbers_of(answer: Answer) -> tuple[str, str]:
    """The number and its limit, in so many digits that they differ where one is beyond the other."""
    for digits in DIGITS:
        value, bound = (_short(each, digits) for each in (answer.value, answer.bound))
        if value != bound or answer.value == answer.bound:
            break
    return value, bound


def whose(answer: Answer) -> str:
    """Whose number decides; empty where there is nothing to tell apart."""
    worst = answer.worst
    at = [f"row {worst.row}"] if worst.row else []
    at += [worst.raceway if worst.row else f"{worst.raceway} raceway"] if worst.raceway else []
    parts = [" ".join(at)] if at else []
    if worst.azimuth_deg is not None:
        parts.append(f"ball {worst.ball} at {plain(worst.azimuth_deg, '.4g')}°")
    parts += [f"point {worst.point}"] if worst.point else []
    return ", ".join(parts)


def verdict(answer: Answer) -> str:
    """The answer, with how much of the limit there is to spare."""
    if answer.state is Standing.OPEN:
        is_met = answer.reason is not None and answer.reason.code == "estimate"
        return f"open, {_spare(answer)} to spare" if is_met else "open"
    if not abs(answer.spare) <= FAR:
        return f"{answer.state}, by far"
    return f"met, {_spare(answer)} to spare" if answer.state is Standing.MET else f"not met, {_spare(answer)} beyond"


def _spare(answer: Answer) -> str:
    return "nothing" if abs(answer.spare) < MET else f"{plain(100.0 * abs(answer.spare), '.2g')} %"


FAR = 1.0
"""Of a limit: what is farther from it needs no number."""


def why_open(answer: Answer, solution: Any) -> str:
    """What is missing, as a sentence without its end; empty where nothing is."""
    reason = answer.reason
    if reason is None:
        return ""
    values = dict(reason.values)
    if reason.code == "arguments_missing":
        values["missing"] = _missing(reason, solution)
    if reason.code == "estimate":
        values = _estimated(answer, values)
    return SENTENCES[reason.code].format_map(values)


def _estimated(answer: Answer, values: dict[str, Any]) -> dict[str, str]:
    """What it would be with an effect that is left out, or by another hypothesis."""
    entry = next(each for each in EFFECTS if each.name == values["effect"])
    is_choice = entry.switch.members is not None
    under = f" ({values['under']})" if values["under"] else ""
    what = f"by another {entry.name.replace('_', ' ')}{under}" if is_choice else ""
    what = what or f"with {entry.what}{under}, which is left out,"
    unit = printed_unit(answer.limit.unit)
    return {
        "what": what,
        "found": numbers_of(answer._replace(value=values["found"]))[0],
        "unit": f" {unit}" if unit else "",
        "by": f" by its change under {values['change_under']} control" if "change_under" in values else "",
    }


def _missing(reason: WhyOpen, solution: Any) -> str:
    """Which arguments a reading lacks, by their keys."""
    from qsbearing.files.file_errors import translate
    from qsbearing.readings.asked import LUBRICANT, requested_errors

    of, name = requested(solution), reason.values["reading"]
    oil = {each: given for each, given in of.readings.items() if each == LUBRICANT}
    scene = of if not hasattr(of, "rows") else of.turning_scene(0)
    path, errors = f"readings.{name}", [translate(each) for each in requested_errors({**oil, name: {}}, scene)]
    lacks = [each.problem if each.key == path else each.key.removeprefix(f"{path}.") for each in errors]
    return f" ({', '.join(lacks)})" if lacks else ""


def headline(required: Sequence[Answer]) -> str:
    """How many are met, in a sentence."""
    count = {state: sum(each.state is state for each in required) for state in Standing}
    met = f"{count[Standing.MET]} of {len(required)} requirements met"
    if count[Standing.MET] == len(required):
        met = {1: "The requirement is met", 2: "Both requirements are met"}.get(
            len(required), f"All {len(required)} requirements are met"
        )
    others = [f"{count[Standing.NOT_MET]} not met"] if count[Standing.NOT_MET] else []
    others += [f"{count[Standing.OPEN]} open"] if count[Standing.OPEN] else []
    return "; ".join([met, *others]) + "."


def blocks(required: Sequence[Answer], solution: Any) -> list[Block]:
    """The answers to what is required, the one table that a designer looks for; nothing where nothing is required."""
    if not required:
        return []
    has_whose = any(whose(each) for each in required)
    has_source = any(each.limit.source for each in required)
    heading = ["required", "found", "asked", "unit", "answer", *["of"] * has_whose, *["source"] * has_source]
    rows = []
    for each in required:
        value, bound = numbers_of(each)
        asked_bound = requested_for(each.limit) if math.isnan(each.bound) else f"{SIGNS[each.limit.sense]} {bound}"
        row: list[Cell] = [name_of(each), value, asked_bound, printed_unit(each.limit.unit), as_badge(each)]
        row += [whose(each)] * has_whose + [each.limit.source] * has_source
        rows.append(row)
    table = Table(heading, rows, f"lrrll{'l' * has_whose}{'l' * has_source}", "Requirements")
    open_ones = [each for each in required if each.reason is not None]
    said = {f"Open: {name_of(each)}: {why_open(each, solution)}.": _closing(each, solution) for each in open_ones}
    told = [Paragraph(text, "Open:", paste=line) for text, line in said.items()]
    return [Paragraph(headline(required)), table, *told]


def _closing(answer: Answer, solution: Any) -> str:
    """What puts into the model what keeps an answer open, to be pasted; empty where no key alone does."""
    effect = answer.reason.values.get("effect") if answer.reason is not None else None
    if effect is None:
        return ""
    from qsbearing.files.file_keys import IN_FILE
    from qsbearing.model.solution.changes import has_size_for
    from qsbearing.remarks.missing_effects import EFFECT_DATA_MISSING

    entry = next(each for each in EFFECTS if each.name == effect)
    values = {"effect": effect, "has_size": has_size_for(entry, solution)}
    return EFFECT_DATA_MISSING.pasted(values, IN_FILE, "design#what-a-design-must-meet")


def unchecked(of: Answered) -> str:
    """What was not checked, by name, in a sentence or two."""
    required = " ".join(each.limit.name for each in of.required)
    others = [each for each in WITHOUT_LIMIT if each.partition(" ")[0] not in required]
    parts = [f"Not checked: {listed(of.not_checked)}." if of.not_checked else ""]
    parts += [f"Not required, and without a limit of its own: {listed(others)}." if others else ""]
    return " ".join(filter(None, parts))


# As plain data


def record(of: Answered, solution: Any) -> dict[str, Any]:
    """As `run --json` has them: what is required first; then what was not checked, and what that needs."""
    every = [_record(each, solution) for each in (*of.required, *of.built_in)]
    return {"requirements": every, "not_checked": [{"name": name, "needs": x} for name, x in of.not_checked.items()]}


def _record(answer: Answer, solution: Any) -> dict[str, Any]:
    limit, worst, place = answer.limit, answer.worst, answer.place
    counted = ("row", "point")
    of = {name: value for name, value in worst._asdict().items() if value not in ("", None)}
    of = {name: value for name, value in of.items() if value or name not in counted}
    bound = answer.bound if math.isfinite(answer.bound) else _number(limit.value)
    return {
        "name": limit.name,
        "result": place.column,
        "sense": limit.sense,
        "limit": bound,
        "unit": place.unit,
        "found": _number(answer.value),
        "answer": str(answer.state),
        "margin": _number(answer.margin),
        "margin_percent": _number(100.0 * answer.spare),
        "size": limit.is_of_sizes,
        "of": of,
        "reason": None if answer.reason is None else _reason(answer.reason),
        "text": why_open(answer, solution) or verdict(answer),
        "source": limit.source,
        "origin": str(limit.origin),
    }


def _reason(of: WhyOpen) -> dict[str, Any]:
    values = {name: each if isinstance(each, str) else _number(each) for name, each in of.values.items()}
    return {"code": of.code, "values": values}


def _number(value: Any) -> float | None:
    return float(value) if _is_scalar(value) and math.isfinite(value) else None


def _is_scalar(value: Any) -> bool:
    return getattr(value, "ndim", 0) == 0


def _short(value: float, digits: int = 4) -> str:
    """A dash where there is no number."""
    if not math.isfinite(value):
        return "-" if math.isnan(value) else "∞"
    whole = digits == DIGITS[0] and abs(value) >= 10.0**digits
    return f"{value:,.0f}" if whole else plain(value, f".{digits}g")
