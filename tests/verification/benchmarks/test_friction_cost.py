"""The kept record of what friction costs: its errors are found again, and what it is to show is there."""

from __future__ import annotations

import json

import pytest

from qsbearing.model.compiler.compiled import has_fast_code
from tests.verification.benchmarks.friction_cost import ERRORS, RECORD, accuracy, table

KEPT = json.loads(RECORD.read_text(encoding="utf-8"))


@pytest.mark.skipif(not has_fast_code(), reason="many points under combined load take minutes in plain Python")
def test_errors_are_found_again() -> None:
    """To three digits; those of stiffness with the finest points are differences of large numbers."""
    for row, kept in zip(accuracy(), KEPT["rows"], strict=True):
        assert [row[key] for key in ("bearing", "load", "way")] == [kept[key] for key in ("bearing", "load", "way")]
        for name in ERRORS if row["way"] != "band" else ():
            expected = None if kept[name] is None else pytest.approx(kept[name], rel=1e-2, abs=1e-7)
            assert row[name] == expected, (row["way"], name)


def test_points_by_default_err_less_than_any_hypothesis() -> None:
    """And less than what is not known of the friction coefficient."""
    for row in KEPT["rows"]:
        if row["way"] == "friction, 10 x 24":
            same = [each for each in KEPT["rows"] if (each["bearing"], each["load"]) == (row["bearing"], row["load"])]
            others = [each for each in same if "control" in each["way"] and each["displacement_um"] is not None]
            (band,) = (each for each in same if each["way"] == "band")
            assert row["displacement_um"] < 0.01
            assert row["displacement_um"] < 0.01 * min(each["displacement_um"] for each in others)
            assert row["displacement_um"] < 0.01 * (max(band["axial_um"]) - min(band["axial_um"]))


def test_the_table_has_a_line_for_each_row() -> None:
    assert len(table(KEPT).splitlines()) == 2 + len(KEPT["rows"])
    assert all("call_ms" in row for row in KEPT["rows"] if row["way"] != "band")
