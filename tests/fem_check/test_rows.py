"""No row is judged by a quantity made from itself: twice the one or the other side, and it fails.

On the rows that are kept, whatever they are; and, minutes long, at the sources: Hertz's reference doubled in a copy of
the packages, then what is measured of the finite elements. (`test_solution_contacts.py` does the same to solutions.)
"""

import dataclasses
import json
import math

import pytest

from fem_check.independent.references import HERTZ_SOURCE
from fem_check.mechanics.measuring import Soundness
from fem_check.rows import row_text
from fem_check.rows.agreement import AgreementRow
from fem_check.running import records_store
from tests.fem_check import test_planted_errors as planted

RECORDS = sorted((planted.ROOT / "fem_check/records").glob("*/*.json"))
CHECKS = [path for path in RECORDS if path.parent.name in ("quick", "release")]
FIELDS = [field.name for field in dataclasses.fields(AgreementRow)]

OF_ANOTHER_LENGTH = {"change of axial displacement"}
"""Quantities whose tolerance is a part of another length: of twice the reference it is half as many per cent."""


@pytest.mark.parametrize("path", CHECKS, ids=lambda path: f"{path.parent.name}-{path.stem}")
@pytest.mark.parametrize("side", ["reference", "found"])
def test_twice_one_side_fails(path, side):
    rows = [AgreementRow(**{name: each[name] for name in FIELDS}) for each in json.loads(path.read_text())["rows"]]
    judged = [row for row in rows if row.tolerance_percent is not None]
    assert judged
    # An exact zero has no double; what it judges is planted for in `test_planted_errors.py`.
    for row in (each for each in judged if each.reference != 0.0):
        changes = {side: 2.0 * getattr(row, side)}
        if side == "reference" and row.quantity in OF_ANOTHER_LENGTH:
            changes |= {name: 0.5 * getattr(row, name) for name in ("tolerance_percent", "uncertainty_percent")}
        assert dataclasses.replace(row, **changes).verdict == "fail", row


@pytest.mark.parametrize("number", [math.nan, math.inf])
@pytest.mark.parametrize("name", ["found", "uncertainty_percent"])
def test_what_is_no_number_fails_and_is_recorded_as_none(name, number):
    row = dataclasses.replace(
        AgreementRow("a contact", "max_pressure", "1", 1.0, "exact", 1.0, 0.1, 2.0, "why"), **{name: number}
    )
    entry = json.loads(records_store.text({"rows": [row.as_dict()]}))["rows"][0]
    assert (entry[name], entry["verdict"]) == (None, "fail")
    assert row_text.of_row(entry).reference == "1"


SOURCES = {
    "reference": (
        "fem_check/independent/references.py",
        "return ContactQuantities(delta, a, b, 1.5 * problem.load / (pi * a * b))",
        "return ContactQuantities(2.0 * delta, 2.0 * a, 2.0 * b, 3.0 * problem.load / (pi * a * b))",
    ),
    "found": (
        "fem_check/mechanics/measuring.py",
        "zip(QUANTITIES, (solution.approaches, a, b, p0, shear, depth), strict=True)",
        "zip(QUANTITIES, (2 * each for each in (solution.approaches, a, b, p0, shear, depth)), strict=True)",
    ),
}
EXACT = {field.name for field in dataclasses.fields(Soundness)}
"""Self-checks, against an exact zero."""


@pytest.mark.heavy
@pytest.mark.parametrize("check", ["half_space_contacts", "load_power_law"])
@pytest.mark.parametrize("side", SOURCES)
def test_twice_a_source_fails(side, check, tmp_path, monkeypatch):
    monkeypatch.setitem(planted.PLANTED, side, (*SOURCES[side], check))
    planted.assert_caught(planted.run_planted(tmp_path, side, check), tmp_path, check)
    rows = json.loads((tmp_path / "out" / "quick" / f"{check}.json").read_text())["rows"]
    of_hertz = [row for row in rows if row["reference_source"] == HERTZ_SOURCE or row["quantity"] in EXACT]
    assert {row["quantity"] for row in of_hertz if row["verdict"] == "pass"} <= EXACT
