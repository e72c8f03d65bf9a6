"""Sections of a shaft as drawings dimension them, by where each begins and ends and by one diameter, as the lengths and
outer diameters that the model has."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from qsbearing.files.file_errors import FileErrorDetail
from qsbearing.files.keys import ON_SHAFT, SPAN, named
from qsbearing.files.table_checks import Errors

FROM, TO, DIAMETER = named(SPAN)
LENGTH, OUTER, START = "length_mm", "outer_diameter_mm", "start_mm"
NEAR = 1e-6
"""Ends that are nearer than this meet [mm]: far below any tolerance, far above rounding."""


def with_lengths(shaft: dict[str, Any], errors: Errors) -> dict[str, Any]:
    """A table [shaft] whose sections have lengths, and which begins where its first section does; without sections,
    and what needs some, where they are wrong.

    Args:
        errors: gets sections that leave a gap or overlap, and those that are given in two ways.
    """
    tables = shaft.get("sections")
    if not isinstance(tables, list) or not all(isinstance(each, dict) for each in tables):
        return shaft
    before = len(errors)
    sections = [_with_diameter(each, number, errors) for number, each in enumerate(tables, 1)]
    by_ends = [number for number, each in enumerate(sections, 1) if FROM in each or TO in each]
    if not by_ends:
        return shaft | {"sections": sections}
    if len(by_ends) < len(sections):
        lacking = next(number for number in range(1, len(sections) + 1) if number not in by_ends)
        cause = f"Give {FROM} and {TO} of every section, or {LENGTH} of every one"
        errors.append(
            FileErrorDetail(f"shaft.section {lacking}.{FROM}", "missing", cause=cause, detail="others have it")
        )
    if START in shaft:
        cause = f"Leave {START} out: the shaft begins where its first section does"
        errors.append(
            FileErrorDetail(f"shaft.{START}", f"is given together with {FROM}", shaft[START], "mm", cause=cause)
        )
    for number in by_ends:
        _check(sections[number - 1], f"shaft.section {number}", errors)
    if len(errors) > before:
        return _without_sections(shaft)
    for at, (one, other) in enumerate(pairwise(sections), 2):
        gap = other[FROM] - one[TO]
        if abs(gap) > NEAR:
            problem = f"leaves a gap to section {at - 1}" if gap > 0.0 else f"overlaps section {at - 1}"
            cause = f"Section {at - 1} ends at {one[TO]:.10g} mm: each begins where the one before ends"
            detail = f"{abs(gap):.6g} mm"
            errors.append(
                FileErrorDetail(f"shaft.section {at}.{FROM}", problem, other[FROM], "mm", cause=cause, detail=detail)
            )
    if len(errors) > before:
        return _without_sections(shaft)
    cut = [{key: each[key] for key in each if key not in (FROM, TO)} | {LENGTH: _length(each)} for each in sections]
    return shaft | {"sections": cut, START: sections[0][FROM]}


def _without_sections(shaft: dict[str, Any]) -> dict[str, Any]:
    return {name: each for name, each in shaft.items() if name in ON_SHAFT and name != "sections"}


def _with_diameter(section: dict[str, Any], number: int, errors: Errors) -> dict[str, Any]:
    if DIAMETER not in section:
        return section
    if OUTER in section:
        cause = f"{DIAMETER} is the outer one, the same from end to end"
        path = f"shaft.section {number}.{DIAMETER}"
        errors.append(FileErrorDetail(path, f"is given together with {OUTER}", section[DIAMETER], "mm", cause=cause))
    rest = {key: each for key, each in section.items() if key != DIAMETER}
    return rest | {OUTER: rest.get(OUTER, section[DIAMETER])}


def _check(section: dict[str, Any], path: str, errors: Errors) -> None:
    if LENGTH in section:
        errors.append(FileErrorDetail(f"{path}.{LENGTH}", f"is given together with {FROM} or {TO}"))
    ends = {name: section.get(name) for name in (FROM, TO)}
    for name, end in ends.items():
        if type(end) not in (int, float):
            problem = "missing" if end is None else "is not a number"
            errors.append(FileErrorDetail(f"{path}.{name}", problem, end, "mm"))
    begin, end = ends.values()
    if type(begin) in (int, float) and type(end) in (int, float) and end <= begin:  # type: ignore[operator]
        errors.append(FileErrorDetail(f"{path}.{TO}", "is not beyond where the section begins", end, "mm"))


def _length(section: dict[str, Any]) -> float:
    """Without the rounding of a difference."""
    return float(f"{section[TO] - section[FROM]:.12g}")
