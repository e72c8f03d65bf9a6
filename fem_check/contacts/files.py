"""Chosen contacts as files: record (JSON), table (CSV), a page with pressure maps (HTML), fields for ParaView (VTU)."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from io import StringIO
from pathlib import Path
from typing import Any

from fem_check.contacts import shown
from fem_check.contacts.chosen import Chosen
from fem_check.contacts.half_spaces import Shape
from fem_check.contacts.record import ContactsRecord
from fem_check.contacts.true_bodies import TrueBodies
from fem_check.elements.fields import NodalFields
from fem_check.independent.references import hertz
from fem_check.mechanics import half_space_contact
from fem_check.rows.record import computed_value
from fem_check.running import records_store
from qsbearing.documents.html import html
from qsbearing.documents.model import Block, Document, Facts, Picture, Section, Trace

NAME = "contact"
TRUE_COLUMNS = ("true_bodies", "true_bodies_minus_hertz_percent", "true_bodies_uncertainty_percent")
"""Of contacts solved as half-spaces and as true bodies; the columns before are the half-spaces'."""


def write(
    entry: ContactsRecord, maps: Sequence[dict[str, Any]], solved: Iterable[tuple[str, NodalFields]], out: Path
) -> list[Path]:
    """Write all forms into a folder; returns their paths.

    Args:
        entry: the record.
        maps: numbers of the pressure maps.
        solved: the fields, each with the name of its file.
        out: the folder.

    Raises:
        OSError: the folder cannot be written.
    """
    out.mkdir(parents=True, exist_ok=True)
    paths = []
    for name, field in solved:
        paths.append(out / f"{name}.vtu")
        field.write(paths[-1])
    forms = {
        "csv": csv_of(entry),
        "json": records_store.text(entry),
        "html": html(page(entry, maps, [path.name for path in paths])).encode(),
    }
    tables = {out / f"{NAME}.{form}": content for form, content in forms.items()}
    for path, content in tables.items():
        records_store.replace(path, content)
    return [*tables, *paths]


def csv_of(entry: ContactsRecord) -> bytes:
    """The table, a row for each quantity of each contact."""
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(
        (
            "raceway", "balls", "load_N", "contact_angle_deg", "angle", "quantity", "unit", "hertz", "finite_elements",
            "deviation_percent", "uncertainty_percent", "tolerance_percent", "verdict",
            *(TRUE_COLUMNS if shown.is_both(entry) else ()), "free_angle_deg", "loaded_angle_deg",
        )
    )  # fmt: skip
    by_case = shown.agreement_rows(entry)
    as_true = shown.true_rows(entry)
    for contact in entry["contacts"]:
        of = contact["race"], contact["balls"], contact["load_N"], contact["contact_angle_deg"], contact["angle"]
        for row in by_case[contact["case"]]:
            _, unit, size = shown.SHOWN[row["quantity"]]
            judged = row["deviation_percent"], row["uncertainty_percent"], row["tolerance_percent"]
            values = size * row["reference"], size * computed_value(row), *judged
            beside: list[Any] = []
            if shown.is_both(entry):
                true = as_true[contact["case"]].get(row["quantity"])
                beside = ["", "", ""]
                if true:
                    beside = [size * computed_value(true), true["deviation_percent"], true["uncertainty_percent"]]
            angles = contact["free_angle_deg"], contact["loaded_angle_deg"]
            writer.writerow((*of, row["quantity"], unit, *values, row["verdict"], *beside, *angles))
    return text.getvalue().encode()


def page(entry: ContactsRecord, maps: Sequence[dict[str, Any]], vtu: Sequence[str]) -> Document:
    """The page."""
    below = [each for each in (shown.tolerances(entry), shown.undecided(entry)) if each]
    agreement: list[Block] = [shown.agreement_table(entry), *below]
    pairs = [(name or "Curvatures", told) for name, told in shown.facts(entry)]
    sections = [
        Section("Agreement", agreement),
        Section("Every mesh", [shown.mesh_table(entry)]),
        Section("Contact pressure", [_map(each) for each in maps]),
        Section("What the verdict rests on", shown.rests_on(entry)),
        Section(
            "Files and origin",
            [
                Facts([("For ParaView", ", ".join(vtu)), *versions(entry)]),
                Trace(f"{NAME}.json", entry["provenance"]["command"], f"qsbearing {entry['versions']['qsbearing']}"),
            ],
        ),
    ]
    return Document(
        f"{entry['bearing']['name']}: contacts by finite elements", "Agreement with Hertz", sections,
        head=[shown.heading(entry), Facts(pairs)],
    )  # fmt: skip


def versions(entry: ContactsRecord) -> list[tuple[str, str]]:
    """What the numbers rest on."""
    return [("Made with", ", ".join(f"{name} {version}" for name, version in entry["versions"].items()))]


def _map(pictures: dict[str, Any]) -> Picture:
    import matplotlib.pyplot as plt

    from fem_check.report.figures.contact import pressure_map
    from qsbearing.documents.drawing import picture

    figure = pressure_map({"pictures": pictures})
    contact = pictures["contact"]
    image = picture(
        figure,
        f"Map of the pressure of {contact['name']} at {contact['load_N']:g} N, ending at Hertz's outline.",
        f"{contact['name']} at {contact['load_N']:g} N: pressure of the finite elements, and Hertz's edge (black line)",
        0.7,
    )
    plt.close(figure)
    return image


def fields_of_half_spaces(contacts: Sequence[Chosen], shapes: Iterable[Shape]) -> Iterable[tuple[str, NodalFields]]:
    """The raceway's half-space of each contact: solved once for a shape, and scaled."""
    names = _names(contacts)
    for shape in shapes:
        field, solved = half_space_contact.field(shape.study), hertz(shape.study.problem)
        for each in shape.alike:
            own = hertz(each.problem)
            length = own.semi_minor_axis / solved.semi_minor_axis
            yield f"half_space_{names[id(each)]}", field.scaled(length, own.max_pressure / solved.max_pressure)


def fields_of_true_bodies(contacts: Sequence[TrueBodies]) -> Iterable[tuple[str, NodalFields]]:
    """Ball and ring of each contact, on its finest mesh."""
    names = _names([each.chosen for each in contacts])
    for each in contacts:
        finest = each.solved.finest
        assert finest is not None
        for body, field in finest.contact.fields(finest.pressure(each.chosen.load)).items():
            yield f"true_{body}_{names[id(each.chosen)]}", field


def _names(contacts: Sequence[Chosen]) -> dict[int, str]:
    """Raceway and load of each contact as part of a file's name; its number too where others have both."""
    plain = {id(each): f"{each.groove.race_name}_{each.load:g}N" for each in contacts}
    often = list(plain.values())
    return {
        id(each): plain[id(each)] + (f"_{number}" if often.count(plain[id(each)]) > 1 else "")
        for number, each in enumerate(contacts, 1)
    }
