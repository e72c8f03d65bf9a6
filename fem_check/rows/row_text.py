"""Numbers of a row of agreement as readers see them: digits down to the uncertainty's, no per cent of a zero."""

from __future__ import annotations

import re
from math import floor, isfinite, log10
from typing import NamedTuple

from fem_check.rows.record import RowRecord, computed_value, deviation_percent

UNITS = {
    "m": (1e6, "µm"), "Pa": (1e-6, "MPa"), "m/N": (1e9, "nm/N"), "1": (1.0, ""), "relative": (100.0, "%"),
    "deg": (1.0, "°"), "degrees": (1.0, "°"), "kg/m3": (1.0, "kg/m³"), "N/mm^1.8": (1.0, "N/mm¹·⁸"),
}  # fmt: skip
"""Of a record's unit: the factor to the unit that readers see, and its name."""


class RowText(NamedTuple):
    """The texts of a row's numbers; empty where there is none."""

    reference: str
    found: str
    deviation: str
    """Per cent; empty where the reference is zero; of a displacement that is a finding in its own unit, which it names.
    """
    uncertainty: str
    """Of the deviation, in its unit."""
    tolerance: str
    """With its sign or unit: per cent, or the limit of a difference from zero in the row's own unit."""


NAMES = {
    "semi_major_axis": "semi-major axis", "semi_minor_axis": "semi-minor axis", "max_pressure": "largest pressure",
    "max_shear_stress": "largest shear stress", "max_shear_depth": "depth of the largest shear stress",
}  # fmt: skip


def in_words(quantity: str) -> str:
    """A quantity of a record in words."""
    return NAMES.get(quantity, quantity.replace("_", " "))


def number(value: float | None, digits: int = 6, signed: bool = False) -> str:
    """A number of a record, shortened."""
    if value is None:
        return ""
    if value == 0.0:
        return "0"
    return short_exponents(f"{value:+.{digits}g}" if signed else f"{value:.{digits}g}")


def scientific(value: float, digits: int) -> str:
    """A small error by its power of ten, with so many digits; zero is 0."""
    if value == 0.0 or 0.1 <= abs(value) < 10.0:
        return number(value, digits)
    return short_exponents(f"{value:.{digits - 1}e}")


def short_exponents(text: str) -> str:
    """Powers of ten without the zeros that a program writes: 1e-7 for 1e-07."""
    return re.sub(r"(?<=\d)e([+-]?)0*(\d+)\b", lambda match: f"e{match[1].strip('+')}{match[2]}", text)


def in_unit(row: RowRecord) -> tuple[float, str]:
    """Factor and name of the unit that readers see."""
    factor, name = UNITS.get(row["unit"], (1.0, row["unit"] or ""))
    return factor, name


def with_unit(text: str, unit: str) -> str:
    """A number with its unit, if it has one."""
    return f"{text}{'' if unit in ('', '°') else ' '}{unit}"


def rounded(value: float, uncertainty: float | None) -> tuple[str, str]:
    """A deviation with its sign, and its uncertainty: two digits of this, and as many decimals of that."""
    if not uncertainty or not isfinite(uncertainty) or not isfinite(value):
        return number(value, 2, signed=True), number(uncertainty, 2)
    decimals = max(0, 1 - floor(log10(float(f"{uncertainty:.1e}"))))
    if decimals > _MOST_DECIMALS:
        return number(value, 2, signed=True), number(uncertainty, 2)
    return f"{value:+.{decimals}f}", f"{uncertainty:.{decimals}f}"


_MOST_DECIMALS = 6
"""Smaller uncertainties are those of rounding, and are written with a power of ten."""


def is_absolute(row: RowRecord) -> bool:
    """Whether a per cent of the reference would mislead: a displacement at speed is zero at some load, and what a ring
    adds to it, 9 µm, is then any per cent; an angle's zero is arbitrary. A displacement that is judged has a tolerance
    in per cent."""
    return row["unit"] == "deg" or (
        row["quantity"].endswith("displacement") and row["unit"] == "m" and row["tolerance_percent"] is None
    )


def own_difference(row: RowRecord) -> tuple[str, str]:
    """The difference from the reference and its uncertainty, in the unit that readers see."""
    factor, _ = in_unit(row)
    uncertainty = row["uncertainty_percent"]
    size = 0.01 * abs(row["reference"]) * factor
    return rounded(
        factor * (computed_value(row) - row["reference"]), None if uncertainty is None else size * uncertainty
    )


def of_row(row: RowRecord) -> RowText:
    """All numbers of a row."""
    factor, unit = in_unit(row)
    reference, computed = (None if each is None else number(each * factor) for each in (row["reference"], row["found"]))
    if computed is None:
        return RowText(reference or "", "", "", "", "")
    deviation, uncertainty = rounded(deviation_percent(row), row["uncertainty_percent"])
    tolerance = row["tolerance_percent"]
    if row["reference"] == 0.0:
        limit = "" if tolerance is None else with_unit(number(tolerance / 100.0 * factor, 2), unit)
        if row["uncertainty_percent"]:
            computed = f"{computed} ± {number(row['uncertainty_percent'] / 100.0 * factor, 2)}"
        return RowText("0", computed or "", "", "", limit)
    limit = "" if tolerance is None else f"{number(tolerance, 2)} %"
    if is_absolute(row):
        deviation, uncertainty = (each and with_unit(each, unit) for each in own_difference(row))
        if tolerance is not None:
            limit = with_unit(number(0.01 * tolerance * abs(row["reference"]) * factor, 2), unit)
    return RowText(reference or "", computed or "", deviation, uncertainty, limit)


def difference_unit(row: RowRecord) -> str:
    """Of `difference`."""
    return in_unit(row)[1] if row["reference"] == 0.0 or is_absolute(row) else "%"


def difference(row: RowRecord) -> str:
    """The difference from the reference in one text, without its unit: see `difference_unit`."""
    told = of_row(row)
    if row["reference"] == 0.0:
        return told.found
    deviation, uncertainty = own_difference(row) if is_absolute(row) else (told.deviation, told.uncertainty)
    return deviation + (f" ± {uncertainty}" if uncertainty else "")


def deviation(row: RowRecord) -> str:
    """Deviation ± its uncertainty: per cent, unless a unit stands behind it; nothing of a reference that is zero."""
    if row["found"] is None or row["reference"] == 0.0:
        return ""
    return difference(row) + (f" {in_unit(row)[1]}" if is_absolute(row) else "")


def span(loads: tuple[float, ...]) -> str:
    """Which loads a row stands for [N]."""
    if len(loads) == 1:
        return f"Q = {loads[0]:.4g} N"
    return f"{len(loads)} loads, Q = {loads[0]:.4g} to {loads[-1]:.4g} N"
