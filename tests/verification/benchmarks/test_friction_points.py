"""What the usual points err by, as the product states it, is what was measured; a part is measured again."""

from __future__ import annotations

import json

import numpy as np
import pytest

from qsbearing.model.compiler.compiled import has_fast_code
from qsbearing.model.solution.point_errors import CREEP, CREEPING, HELD, errors_of_points
from tests.verification.benchmarks.friction_points import CASES, RECORD, batch, of_batch, rounded_up, summary

KEPT = json.loads(RECORD.read_text(encoding="utf-8"))


def test_what_is_stated_is_what_was_measured() -> None:
    """Rounded up."""
    for stated, kept in ((CREEP, KEPT["creep"]), (HELD, KEPT["held"])):
        assert stated.cases == kept["cases"]
        measured = {name: {part: rounded_up(x) for part, x in each.items()} for name, each in kept["errors"].items()}
        assert {name: each._asdict() for name, each in stated.errors.items()} == measured
    assert CREEP.cases + HELD.cases == CASES


def test_which_cases_are_alike() -> None:
    assert errors_of_points(0.99 * CREEPING) is CREEP and errors_of_points(np.nan) is CREEP
    assert errors_of_points(CREEPING) is HELD and errors_of_points(np.inf) is HELD


@pytest.mark.skipif(not has_fast_code(), reason="10,240 points of a contact take an hour in plain Python")
def test_a_batch_is_measured_again() -> None:
    """To two digits: medians are near the solver's own tolerance."""
    first = KEPT["first_batch"]
    errors, _ = of_batch(*batch(first["number"]))
    again = summary(errors)
    assert again["cases"] == first["cases"]
    for name, kept in first["errors"].items():
        for part in ("in_95_of_100", "largest"):
            assert again["errors"][name][part] == pytest.approx(kept[part], rel=1e-2)
