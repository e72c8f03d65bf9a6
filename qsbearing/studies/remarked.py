"""Remarks on the points of a study: at how many of them each holds, and where; as plain data, which goes with them.

Of many points some are looked at, spread over all of them, and nothing is solved again for a remark: see `LOOKED_AT`
and `MOST_CASES`. What is counted says so.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypedDict

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.model import Callout, Paragraph
from qsbearing.files.file_keys import IN_FILE
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks.kinds import KINDS, Severity
from qsbearing.remarks.missing_effects import MOST_CASES
from qsbearing.remarks.of_solution import holding
from qsbearing.remarks.remark import Remark, RemarkRecord
from qsbearing.results.remarks import COLOURS
from qsbearing.systems.sets import remarks as _remarks  # noqa: F401 - kinds of remarks in studies that were kept
from qsbearing.systems.sets.set_solution import SetSolution

LOOKED_AT = 1024
"""Points of a chunk at which remarks are looked for (chosen: of 16,384 they take a thirtieth of the chunk's time)."""
MOST_KEYS = 3
"""Varied keys of which a sentence tells where."""

KEPT = ("remarks", "remarks_looked_at", "remarks_of_points")
"""What a dataset keeps of them, as its attributes."""
Numbers = dict[str, float]
"""Of the varied keys."""


class CountedRemark(TypedDict):
    """A remark, and the points at which it holds."""

    record: RemarkRecord
    """With the numbers of the point where it matters most."""
    count: int
    weight: float
    """By how much it holds there."""
    at: Numbers
    """Of that point."""
    first: Numbers
    last: Numbers
    least: Numbers
    most: Numbers


class Look(TypedDict):
    """What was seen."""

    looked_at: int
    solved: int
    """Of these."""
    remarks: dict[str, CountedRemark]
    """By what they are about."""


def looked_at(count: int) -> NDArray:
    """The points of so many that are looked at: all, or one at random of each of `LOOKED_AT` equal stretches, since
    every tenth point may be the same place of an axis."""
    if count <= LOOKED_AT:
        return np.arange(count)
    ends = np.arange(LOOKED_AT + 1) * count // LOOKED_AT
    return np.random.default_rng(count).integers(ends[:-1], ends[1:])


def may_solve(points: int) -> bool:
    """Whether a study of so many points is small enough for remarks that take further solves."""
    return points <= MOST_CASES


def look(
    solution: Solution | SetSolution, readings: Any, values: Mapping[str, NDArray], numbers: NDArray, solves: bool
) -> Look:
    """Which remarks hold of the cases of a solution, each at how many, and where.

    Args:
        readings: those that are taken of it; of a set those of each row.
        values: of each varied key at all points.
        numbers: of the points that are its cases.
        solves: whether a remark may solve them again.
    """
    solved = np.ravel(solution.converged)
    seen: Look = {"looked_at": numbers.size, "solved": int(solved.sum()), "remarks": {}}
    if not solved.any():
        return seen
    varied = {name: array[numbers] for name, array in values.items() if array.ndim}
    for where, make in holding(solution, readings, slice(0, solved.size), solves):
        weight = np.where(solved, np.broadcast_to(np.asarray(where, float).reshape(-1), solved.shape), 0.0)
        held = np.flatnonzero(weight)
        if held.size:
            worst = int(np.argmax(weight))
            said = make if isinstance(make, Remark) else make(worst)
            one = _counted(said, varied, held, worst, float(min(weight[worst], 1e300)))
            # Which effects are missing may differ between points; what one effect needs is one remark for each.
            key = repr((said.code, replace(said.of, balls=None, cases=None), said.values.get("effect")))
            seen["remarks"][key] = _with(seen["remarks"].get(key), one)
    return seen


def _counted(said: Remark, varied: Mapping[str, NDArray], held: NDArray, worst: int, weight: float) -> CountedRemark:
    def values(k: int) -> Numbers:
        return {name: float(array[k]) for name, array in varied.items()}

    return {
        "record": said.record(IN_FILE),
        "count": int(held.size),
        "weight": weight,
        "at": values(worst),
        "first": values(int(held[0])),
        "last": values(int(held[-1])),
        "least": {name: float(array[held].min()) for name, array in varied.items()},
        "most": {name: float(array[held].max()) for name, array in varied.items()},
    }


def _with(before: CountedRemark | None, after: CountedRemark) -> CountedRemark:
    """Two counts of one remark, those of earlier points first; the numbers of the one that matters more."""
    if before is None:
        return after
    return {
        **max(before, after, key=lambda each: each["weight"]),
        "count": before["count"] + after["count"],
        "first": before["first"],
        "last": after["last"],
        "least": {name: min(value, after["least"][name]) for name, value in before["least"].items()},
        "most": {name: max(value, after["most"][name]) for name, value in before["most"].items()},
    }


def together(looks: Iterable[Look]) -> Look:
    """What was seen of all parts of a study, in the order of its points."""
    whole: Look = {"looked_at": 0, "solved": 0, "remarks": {}}
    for each in looks:
        whole["looked_at"] += each["looked_at"]
        whole["solved"] += each["solved"]
        for key, one in each["remarks"].items():
            whole["remarks"][key] = _with(whole["remarks"].get(key), one)
    return whole


def records(seen: Look, points: int) -> list[RemarkRecord]:
    """The remarks as JSON has them, each with `cases`: at how many of the solved points that were looked at it holds,
    where its numbers are found, and the first, last, least and most of the varied keys.

    Args:
        points: all that the study has.
    """
    remarks: list[RemarkRecord] = []
    for one in seen["remarks"].values():
        ends = {"at": one["at"], "first": one["first"], "last": one["last"], "least": one["least"], "most": one["most"]}
        of = one["record"]["of"] | {"cases": {"count": one["count"], "of": seen["solved"], **ends}}
        text = f"{_where(one, seen, points)}: {one['record']['text']}"
        remarks.append({**one["record"], "of": of, "text": text})
    return sorted(remarks, key=lambda each: Severity[each["severity"].upper()])


def _where(one: CountedRemark, seen: Look, points: int) -> str:
    """At how many points, and which; and at which of them its numbers are found."""
    solved = "solved " * (seen["solved"] < seen["looked_at"])
    of = f"the {seen['solved']:,} {solved}points looked at" if seen["looked_at"] < points else ""
    of = of or f"{seen['solved']:,} {solved}points"
    is_all = one["count"] == seen["solved"] > 1
    ends = [(name, low, one["most"][name]) for name, low in one["least"].items()]
    ranges = [f"{name} {low:.6g}" + f" to {high:.6g}" * (low != high) for name, low, high in ends]
    if len(ranges) > MOST_KEYS:
        ranges[MOST_KEYS:] = [f"{len(ranges) - MOST_KEYS} more keys"]
    at = [f"{name} {one['at'][name]:.6g}" for name, low, high in ends if low != high][:MOST_KEYS]
    begun = "At all" if is_all else f"At {one['count']:,} of"
    said = [f"{begun} {of}", *ranges]
    return ", ".join(said) + f" (numbers at {', '.join(at)})" * bool(at)


def attributes(seen: Look, points: int) -> dict[str, Any]:
    """The remarks of a study as a dataset keeps them."""
    return dict(zip(KEPT, (json.dumps(records(seen, points)), seen["looked_at"], points), strict=True))


def blocks(remarks: Sequence[RemarkRecord], looked: int, points: int) -> list[Callout | Paragraph]:
    """For people: a line for each, and how many points were looked at.

    Args:
        remarks: as `records` gives them, or a file that kept them.
        points: all that the study has.
    """
    said: list[Callout | Paragraph] = []
    for number, each in enumerate(remarks):
        kind, severity = KINDS.get(each["code"]), Severity[each["severity"].upper()]
        see = f" (see qsbearing guide {kind.see})" if kind else ""  # of another version: none
        text = f"{severity.words}: {each['text'].removesuffix('.')}{see}."
        paste = each.get("paste", "")  # of another version: none
        said.append(Callout(text, severity.status, f"{severity.words}:", COLOURS.get(severity, ""), number == 0, paste))
    if not may_solve(points):
        some = f"{looked:,} of {points:,} points are looked at, spread over all of them" if looked < points else ""
        told = "nothing is solved again for them: `qsbearing run` tells of one point what takes that"
        said.append(Paragraph(f"Remarks: {some or f'{points:,} points are looked at'}; {told}.", is_apart=True))
    return said


def of_look(seen: Look, points: int) -> list[Callout | Paragraph]:
    """The remarks of a study in words, of what was seen just now."""
    return blocks(records(seen, points), seen["looked_at"], points)


def of_results(kept: Mapping[str, Any]) -> list[Callout | Paragraph]:
    """The remarks of a study in words, of its results' attributes; nothing of results made before they kept any."""
    remarks, looked, points = records_of(kept).values()
    return blocks(remarks, looked, points)


def records_of(kept: Mapping[str, Any]) -> dict[str, Any]:
    """The remarks in the attributes of a study's results, as data."""
    return {KEPT[0]: json.loads(kept.get(KEPT[0], "[]")), **{name: int(kept.get(name, 0)) for name in KEPT[1:]}}
