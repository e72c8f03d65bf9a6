"""Texts of a row's numbers: the digits of the uncertainty, and differences from zero in their own unit."""

from __future__ import annotations

from typing import Any

import pytest

from fem_check.rows import row_text
from fem_check.rows.agreement import AgreementRow


def row(
    reference: float, value: float, unit: str, uncertainty: float | None, tolerance: float | None
) -> dict[str, Any]:
    return AgreementRow("case", "quantity", unit, reference, "source", value, uncertainty, tolerance, "why").as_dict()


@pytest.mark.parametrize(
    ("value", "uncertainty", "texts"),
    [
        (32.3093, 0.2115, ("+32.31", "0.21")),
        (1.4691, 0.0157, ("+1.469", "0.016")),
        (-1.4612, 0.134, ("-1.46", "0.13")),
        (123.4, 17.3, ("+123", "17")),
        (0.5, 0.0999, ("+0.50", "0.10")),
        (0.0004, 0.019, ("+0.000", "0.019")),
        (-42.857, None, ("-43", "")),
        (2.5e-7, 1e-9, ("+2.5e-7", "1e-9")),
        (0.25, 0.0, ("+0.25", "0")),
    ],
)
def test_a_deviation_has_the_digits_of_its_uncertainty(
    value: float, uncertainty: float | None, texts: tuple[str, str]
) -> None:
    assert row_text.rounded(value, uncertainty) == texts


def test_of_a_reference_that_is_zero_there_is_no_per_cent() -> None:
    angle = row_text.of_row(row(0.0, 0.0145, "deg", None, 2.0))
    assert angle == ("0", "0.0145", "", "", "0.02°")
    assert row_text.difference(row(0.0, 0.0145, "deg", None, 2.0)) == "0.0145"
    length = row_text.of_row(row(0.0, 3e-9, "m", 1e-7, 5e-7))
    assert length == ("0", "0.003 ± 0.001", "", "", "0.005 µm")


def test_a_deviation_that_is_the_quantity_itself_is_read_in_per_cent() -> None:
    """The mean of relative deviations, kept as a fraction, is to be zero: the page that tells it has a % elsewhere."""
    told = row_text.of_row(row(0.0, -0.00356, "relative", None, 0.57))
    assert told == ("0", "-0.356", "", "", "0.57 %")
    assert row_text.in_unit(row(0.0, 0.0, "relative", None, None))[1] == "%"


def test_powers_of_ten_are_short_and_zero_has_no_digits() -> None:
    assert [row_text.number(value, 2) for value in (1e-6, 2.6e9, 0.0, 0.25)] == ["1e-6", "2.6e9", "0", "0.25"]
    assert row_text.number(0.0, 2, signed=True) == "0"
    assert [row_text.scientific(value, 1) for value in (2.0, 0.0, 9e-16, 3e4)] == ["2", "0", "9e-16", "3e4"]
    assert row_text.short_exponents("within 3.4e-05, case e-01, 1e-10") == "within 3.4e-5, case e-01, 1e-10"


def test_other_rows_have_per_cent() -> None:
    told = row_text.of_row(row(2e-6, 2.02e-6, "m", 0.13, 2.0))
    assert told == ("2", "2.02", "+1.00", "0.13", "2 %")


def test_a_displacement_that_is_a_finding_is_told_by_its_difference() -> None:
    """At some load a displacement at speed is zero: of the same 8.3 µm a per cent could be anything."""
    grown = row(25.72e-6, 34.03e-6, "m", 0.2116, None) | {"quantity": "axial_displacement"}
    assert row_text.of_row(grown)[2:4] == ("+8.310 µm", "0.054 µm")
    assert row_text.difference(grown) == "+8.310 ± 0.054"
    assert row_text.difference_unit(grown) == "µm"
    judged = grown | {"tolerance_percent": 1.0}
    assert row_text.of_row(judged).deviation == "+32.31"
    assert row_text.difference_unit(judged) == "%"
