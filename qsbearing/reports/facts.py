"""The numbers that most readers look for first, for page 1: each with the digits that matter."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from qsbearing.documents.model import Cell, Facts
from qsbearing.documents.numbers import that_matter
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import mm, rpm
from qsbearing.readings.asked import arguments_of
from qsbearing.reports.key_results import KeyResult, results_of, results_of_shaft
from qsbearing.systems.sets.set_solution import SetSolution

PAGE_ONE = 3
"""Digits of its numbers."""
Readings = Mapping[str, Any]


def facts_of(solution: Solution, readings: Readings) -> Facts:
    """Of a single case of a bearing."""
    return Facts([*_pairs(results_of(solution, readings)), *_of_bearing(solution, readings)])


def facts_of_set(solution: SetSolution, readings: Sequence[Readings]) -> Facts:
    """Of a single case of a set: those of its shaft; of the rows the range of what they were asked to be read off."""
    rows = [list(_of_bearing(row, own)) for row, own in zip(solution.rows, readings, strict=True)]
    names = dict.fromkeys(name for of_row in rows for name, _ in of_row)
    of_rows: list[tuple[str, Cell]] = []
    for name in names:
        texts = list(dict.fromkeys(text for of_row in rows for known, text in of_row if known == name))
        of_rows.append((name, texts[0] if len(texts) == 1 else f"rows: {', '.join(map(str, texts))}"))
    return Facts([*_pairs(results_of_shaft(solution, readings)), *of_rows])


def _pairs(results: Sequence[KeyResult]) -> Iterator[tuple[str, Cell]]:
    """Without under which condition each holds, which the tables of results say."""
    for each in results:
        parts = tuple(part._replace(digits=PAGE_ONE) if part.digits else part for part in each.parts)
        yield each._replace(condition="", parts=parts).line


def _of_bearing(solution: Solution, readings: Readings) -> Iterator[tuple[str, Cell]]:
    """What a rating or a film says of it, where it is asked for; and its speed factor."""
    life, film, static = (readings.get(name) for name in ("life", "film", "static_safety"))
    if life is not None:
        kappa, _ = arguments_of(solution, "life").lubrication(solution)
        if kappa is not None:
            yield "viscosity ratio κ", that_matter(float(np.asarray(kappa)))
    if film is not None:
        sides = {side: getattr(film, side) for side in ("inner", "outer")}
        thin = {side: float(np.nanmin(each.minimum_thickness)) * 1e6 for side, each in sides.items()}
        yield "least film", ", ".join(f"{side} {that_matter(each)} µm" for side, each in thin.items())
        ratios = {side: each.film_parameter for side, each in sides.items() if each.film_parameter is not None}
        if ratios:
            told = (f"{side} {that_matter(float(np.nanmin(each)))}" for side, each in ratios.items())
            yield "film parameter Λ", ", ".join(told)
    if static is not None:
        yield "static safety S0", that_matter(float(np.asarray(static.static_safety)))
    operation, bearing = solution.scene.operation, solution.scene.bearing
    outer = 0.0 if operation.outer_speed is None else float(np.asarray(operation.outer_speed))
    turning = abs(float(np.asarray(operation.speed)) - outer)
    if turning != 0.0:
        factor = turning / rpm * float(np.asarray(bearing.pitch_diameter)) / mm
        yield "speed factor n·dm", f"{that_matter(factor)} mm/min"
