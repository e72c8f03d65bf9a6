"""Readings of a case as plain data in the field's units: the object `readings` of `run --json`."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from qsbearing.readings.shown import ball_values, case_values
from qsbearing.solution.case_index import Place
from qsbearing.solution.solution import Solution


def readings_record(solution: Solution, readings: Mapping[str, Any], index: Place = ()) -> dict[str, Any]:
    """One case's readings, each under its name: the bearing's numbers, then its balls', then what to beware of.

    None stands for what was not asked for, or has no number.
    """
    balls = np.flatnonzero(np.isfinite(solution.azimuth[index]))
    return {name: _one(name, reading, solution, index, balls) for name, reading in readings.items()}


def _one(name: str, reading: Any, solution: Solution, index: Place, balls: Any) -> dict[str, Any]:
    out: dict[str, Any] = {}
    for key, values in case_values(name, reading):
        out[key] = None if values is None else _number(np.broadcast_to(values, solution.shape)[index])
    rows: list[dict[str, Any]] = [{} for _ in balls]
    for side, key, values in ball_values(name, reading):
        for row, ball in zip(rows, balls, strict=True):
            holder = row.setdefault(side, {}) if side else row
            holder[key] = None if values is None else _number(values[index][ball])
    if any(rows):
        out["balls"] = rows
    if hasattr(reading, "models"):
        out["models"] = [model._asdict() for model in reading.models]
    out["warnings"] = list(getattr(reading, "warnings", ()))
    return out


def _number(value: Any) -> float | None:
    return float(value) if math.isfinite(value) else None
