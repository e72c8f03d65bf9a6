"""Hertz, half-spaces and true bodies of a bearing's contacts, side by side: what the record of `true_geometry` has."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from fem_check.rows import row_text
from fem_check.rows.record import Record, RowRecord, computed_value, deviation_percent
from qsbearing.documents.numbers import plain

QUANTITIES = {
    "approach": ("approach δ", "µm", 1e6),
    "semi_major_axis": ("semi-axis a", "mm", 1e3),
    "semi_minor_axis": ("semi-axis b", "mm", 1e3),
    "max_pressure": ("pressure p0", "MPa", 1e-6),
}
"""Of each quantity: name, unit, and one of its SI unit in that."""
TRUE, HALF_SPACES = "true contact", "half-spaces"
HEADINGS = ("contact", "quantity", "Hertz", "half-spaces − Hertz, %", "true bodies", "true bodies − Hertz, %")


@dataclass
class ContactAgreement:
    """One contact."""

    bearing: str
    race: str
    load: float
    """[N]"""
    angle: str
    """Contact angle under the load [degrees], as the record has it."""
    true: dict[str, RowRecord] = field(default_factory=dict)
    half_spaces: dict[str, RowRecord] = field(default_factory=dict)
    """Empty where the record has none."""
    pressure: dict[str, Any] | None = None
    """The numbers of its map."""

    @property
    def label(self) -> str:
        """Raceway, load, angle."""
        return f"{self.race}, {self.load:,.0f} N at {self.angle}°"

    def deviation(self, name: str) -> float:
        """True bodies less Hertz [%]."""
        return deviation_percent(self.true[name])


def contacts_of(record: Record) -> list[ContactAgreement]:
    """Every contact of a record of `true_geometry` that was solved, in its order."""
    pressures = {(each["race"], each["load_N"]): each for each in record["pictures"].get("pressures", [])}
    contacts = [
        _contact(record, race, load, pressures.get((race, load)))
        for race, curves in record["pictures"].get("true_geometry", {}).items()
        for load in curves["load_N"]
    ]
    return [contact for contact in contacts if contact.true.keys() == QUANTITIES.keys()]


def _contact(record: Record, race: str, load: float, pressure: dict[str, Any] | None) -> ContactAgreement:
    """One that was solved; bearing and angle stand in the names of its cases alone, around what its data say."""
    of = f" {race}, Q = {load:.0f} N at "
    own = [row for row in record["rows"] if of in row["case"] and row["found"] is not None]
    bearing, _, rest = own[0]["case"].partition(of) if own else ("", "", "")
    angle = rest.partition("°")[0]
    true, half_spaces = (
        {row["quantity"]: row for row in own if row["case"] == f"{bearing}{of}{angle}°: {method}"}
        for method in (TRUE, HALF_SPACES)
    )
    return ContactAgreement(bearing, race, load, angle, true, half_spaces, pressure)


def lines(contacts: Sequence[ContactAgreement]) -> list[list[str]]:
    """The table: a line for each quantity of each contact, which the first of them names."""
    told = []
    for contact in contacts:
        for number, (name, (words, unit, size)) in enumerate(QUANTITIES.items()):
            true, half = contact.true[name], contact.half_spaces.get(name)
            told.append(
                [
                    "" if number else contact.label,
                    f"{words}, {unit}",
                    _five_digits(true["reference"] * size),
                    row_text.deviation(half) if half else "",
                    _five_digits(computed_value(true) * size),
                    row_text.deviation(true),
                ]
            )
    return told


def _five_digits(value: float) -> str:
    return f"{value:#.5g}".rstrip(".")


def solved_right(contacts: Sequence[ContactAgreement]) -> str:
    """How far half-spaces are from Hertz; empty where none were solved."""
    rows = [row for contact in contacts for row in contact.half_spaces.values()]
    if not rows:
        return ""
    worst, doubt = max(rows, key=lambda row: abs(deviation_percent(row))), max(_doubt(row) for row in rows)
    return (
        f"On half-spaces, where Hertz is exact, all {len(contacts)} contacts agree with his formulas within "
        f"{plain(abs(deviation_percent(worst)), '.2g')} % (± {plain(doubt, '.2g')} % at most)."
    )


def errs(contacts: Sequence[ContactAgreement]) -> str:
    """What Hertz leaves out, by quantity, and how it grows with the load."""
    largest = {name: max((each.deviation(name) for each in contacts), key=abs) for name in QUANTITIES}
    said = ", ".join(f"{value:+.1f} % ({_symbol(name)})" for name, value in largest.items()).replace("-", "−")
    race = contacts[0].race
    grown = [each for each in contacts if each.race == race]
    by_load = ", ".join(f"{each.deviation('semi_major_axis'):+.1f}" for each in grown).replace("-", "−")
    loads = ", ".join(f"{each.load:,.0f}" for each in grown)
    return (
        f"Ball and groove are no half-spaces: up to {said}. The length a errs more with load: {by_load} % at {loads} N "
        f"({race})."
    )


def _symbol(name: str) -> str:
    return QUANTITIES[name][0].rpartition(" ")[2]


def _doubt(row: RowRecord) -> float:
    return row["uncertainty_percent"] or 0.0


def made_by(record: Record) -> str:
    """Meshes, time, command."""
    elements = record["mesh"]["elements_per_semi_axis"]
    return (
        f"Ball and ring segment by gmsh, curved tetrahedra, {elements} elements per semi-axis on the finest of three "
        f"meshes; ± expanded uncertainty, 95 %. {record['cpu_seconds']:.0f} s of processor, "
        f"{record['peak_memory_MB'] / 1e3:.1f} GB."
    )
