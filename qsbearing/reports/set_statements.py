"""What was checked of sets, with what result, and in what a set differs from it."""

from __future__ import annotations

import numpy as np

from qsbearing.model.units import deg
from qsbearing.reports.conditions import Difference
from qsbearing.reports.statements import Statement
from qsbearing.systems.sets.bearing_set import BearingSet

ROWS = 4
"""The most that were checked."""
PRINTED = "S 6210"
PRINTED_ANGLES = 15.0, 25.0
"""Free contact angles of the bearings whose pairs are printed [deg]."""


def _too_many(of: BearingSet) -> list[Difference]:
    return [Difference(f"{len(of.rows)} rows, checked up to {ROWS}")] if len(of.rows) > ROWS else []


def _with_effects(of: BearingSet) -> list[Difference]:
    has_effects = of.ball_effects or any(of.effects_of(row) for row in of.rows)
    return [Difference("checked without effects of balls and rings", True)] if has_effects else []


def _not_printed(of: BearingSet) -> list[Difference]:
    differences = _with_effects(of)
    if of.preload is not None and of.preload.spring is not None:
        differences.append(Difference("a spring, checked rigid preload"))
    if float(np.asarray(of.operation.speed)) != 0.0:
        differences.append(Difference("a speed, checked at rest"))
    angles = [float(np.asarray(row.bearing.free_contact_angle)) / deg for row in of.rows]
    if not all(any(abs(angle - printed) < 0.01 for printed in PRINTED_ANGLES) for angle in angles):
        differences.append(Difference("other free contact angles than 15 and 25 deg"))
    if not all((row.bearing.name or "").startswith(PRINTED) for row in of.rows):
        differences.append(Difference(f"another bearing than GMN's {PRINTED}"))
    return differences


OF_SETS: tuple[Statement[BearingSet], ...] = (
    Statement(
        "Statics of sets at rest: the balls of two to four rows as springs between points in three dimensions, under "
        "every load at once.",
        lambda of: "Loads and displacements agree to 1e-8",
        "pytest tests/systems/sets/test_equilibrium.py",
        lambda of: _too_many(of) + _with_effects(of),
    ),
    Statement(
        "Relations of sets at rest and at speed: rows add up to the load, mirror images, stiffness against "
        "differences.",
        lambda of: "Hold to rounding, stiffness to the differences' own error",
        "pytest tests/systems/sets/test_equilibrium.py",
        _too_many,
    ),
    Statement(
        "Axial rigidities of rigidly preloaded pairs at rest, as a maker prints them (GMN S 6210, 15 and 25 degrees).",
        lambda of: "Met to the printed digit",
        "pytest tests/systems/sets/test_preload.py",
        _not_printed,
        lambda of: len(of.rows) == 2 and of.is_opposed,
    ),
)
