"""The record of chosen contacts as blocks of a document: what was solved, one table of agreement, what it rests on."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from fem_check.contacts.record import ContactRecord, ContactsRecord, MaterialRecord
from fem_check.report.agreement import QUANTITIES
from fem_check.rows import row_text
from fem_check.rows.record import RowRecord, computed_value
from qsbearing.documents.model import Badge, Block, Callout, Paragraph, RowGroup, Table
from qsbearing.documents.numbers import plain
from qsbearing.documents.terminal import STYLES

SHOWN = QUANTITIES | {
    "max_shear_stress": ("shear τmax", "MPa", 1e-6),
    "max_shear_depth": ("depth of τmax", "mm", 1e3),
}
"""Of each quantity of the table: name, unit, and one of its SI unit in that."""
HEADINGS = ("", "Hertz", "finite\nelements", "deviation\n%", "±\n%", "verdict")
MODELS = {
    "parabolic": "Half-spaces with Hertz's parabolic gap, where Hertz is exact: deviations are errors.",
    "true": "Ball and ring with their real shapes, where Hertz is an approximation: deviations are findings.",
    "both": "Half-spaces with Hertz's parabolic gap, where Hertz is exact: their deviations are errors. Ball and ring "
    "with their real shapes, where Hertz is an approximation: true bodies − Hertz is a finding.",
}
BOTH_HEADINGS = ("", "Hertz", "half-spaces\n− Hertz, %", "true\nbodies", "true bodies\n− Hertz, %", "half-\nspaces")


def agreement_rows(entry: ContactsRecord) -> dict[str, list[RowRecord]]:
    """The rows of each contact against Hertz, by the case that the contact names."""
    by_case: dict[str, list[RowRecord]] = {contact["case"]: [] for contact in entry["contacts"]}
    for row in entry["rows"]:
        if row["case"] in by_case:
            by_case[row["case"]].append(row)
    return by_case


def is_both(entry: ContactsRecord) -> bool:
    """Whether the contacts were solved as half-spaces and as true bodies."""
    return any("true_case" in contact for contact in entry["contacts"])


def true_rows(entry: ContactsRecord) -> dict[str, dict[str, RowRecord]]:
    """Of contacts solved both ways, those as true bodies: by the case of their half-spaces, then by quantity."""
    cases = {contact["true_case"]: contact["case"] for contact in entry["contacts"] if "true_case" in contact}
    rows_of: dict[str, dict[str, RowRecord]] = {case: {} for case in cases.values()}
    for row in entry["rows"]:
        if row["case"] in cases:
            rows_of[cases[row["case"]]][row["quantity"]] = row
    return rows_of


def heading(entry: ContactsRecord) -> Callout:
    """The verdict on all contacts, and what it took."""
    lead = f"{entry['check']} ({entry['level']}): {entry['verdict']}"
    took = f"{entry['seconds']:.1f} s, {entry['cpu_seconds']:.1f} s of processor, {entry['peak_memory_MB']} MB"
    return Callout(f"{lead}   {took}", entry["verdict"], lead, STYLES[entry["verdict"]])


def facts(entry: ContactsRecord) -> list[tuple[str, str]]:
    """What the contacts are of: name and text."""
    bearing, mesh = entry["bearing"], entry["mesh"]
    materials = [_material(each) for each in (bearing["ball_material"], bearing["ring_material"])]
    elements = ", ".join(map(str, entry["elements"][:-1]))
    pairs = [
        (
            "Bearing",
            f"{bearing['name']}: {bearing['ball_count']} balls of {bearing['ball_diameter_mm']:.6g} mm on "
            f"{bearing['pitch_diameter_mm']:.6g} mm; groove radii {bearing['inner_groove_radius_mm']:.6g} mm (inner) "
            f"and {bearing['outer_groove_radius_mm']:.6g} mm (outer); free contact angle "
            f"{bearing['free_contact_angle_deg']:.4g}°",
        ),
        ("Materials", f"balls {materials[0]}; rings {materials[1]}"),
        *(("Curvatures" if first else "", told) for first, told in _curvatures(entry["contacts"])),
        ("Contact angle", "; ".join(dict.fromkeys(contact["angle_is"] for contact in entry["contacts"]))),
        ("Model", MODELS[mesh["geometry"]]),
        (
            "Mesh",
            f"{mesh['elements_per_semi_axis']} elements per semi-axis ({elements} for the uncertainty), "
            f"{mesh['dofs']} unknowns; {mesh['file']}, {mesh['origin']}; solver {entry['solver']}",
        ),
    ]
    if "true_elements" in entry:
        coarser = ", ".join(map(str, entry["true_elements"][:-1]))
        told = f"{entry['true_elements'][-1]} elements per semi-axis ({coarser}), {mesh.get('true_dofs')} unknowns"
        pairs.append(("True bodies", f"{told}; made by gmsh"))
    told = _similar(entry["contacts"])
    return [*pairs, ("Solved", told)] if told else pairs


def _material(material: MaterialRecord) -> str:
    return f"{material['name']}, E {material['elastic_modulus_GPa']:.4g} GPa, ν {material['poisson_ratio']:.3g}"


def _curvatures(contacts: Iterable[ContactRecord]) -> Iterable[tuple[bool, str]]:
    """Of each raceway, from the least to the largest of its contacts: sums of ball and raceway."""
    by_race: dict[str, list[ContactRecord]] = {}
    for contact in contacts:
        by_race.setdefault(contact["race"], []).append(contact)
    for number, (race, own) in enumerate(by_race.items()):
        across, along, ratio = (
            _span([contact[name] for contact in own], 5)
            for name in ("curvature_sum_across_per_mm", "curvature_sum_along_per_mm", "ellipticity")
        )
        yield number == 0, f"{race}: {across} /mm across the groove, {along} /mm along it; a/b = {ratio}"


def _span(values: list[float], digits: int) -> str:
    least, most = (f"{value:.{digits}g}" for value in (min(values), max(values)))
    return least if least == most else f"{least} to {most}"


def _similar(contacts: list[ContactRecord]) -> str:
    """Which contacts were solved for which others; empty where each was solved for itself."""
    solved: dict[tuple[str, float], int] = {}
    for contact in contacts:
        if "similar_to_load_N" in contact:
            key = contact["race"], contact["similar_to_load_N"]
            solved[key] = solved.get(key, 0) + 1
    if not solved:
        return ""
    each = ", ".join(f"{race} {load:g} N for {count} contacts" for (race, load), count in solved.items())
    return (
        f"once for each shape ({each}): half-spaces are similar at every load, lengths and stresses as Q^(1/3), the "
        "approach as Q^(2/3), so the deviations are the same"
    )


def agreement_table(entry: ContactsRecord) -> Table:
    """Every contact against Hertz."""
    lines: list[Any] = []
    by_case = agreement_rows(entry)
    if is_both(entry):
        return _both_table(entry, by_case)
    for contact in entry["contacts"]:
        lines.append(RowGroup(contact["label"]))
        for row in by_case[contact["case"]]:
            name, unit, size = SHOWN[row["quantity"]]
            told = row_text.of_row(row)
            numbers = (row_text.number(row["reference"] * size), row_text.number(computed_value(row) * size))
            lines.append((f"{name}, {unit}", *numbers, told.deviation, told.uncertainty, Badge(row["verdict"])))
    return Table(HEADINGS, lines, "lrrrrl", f"{entry['bearing']['name']}: Hertz and finite elements")


def _both_table(entry: ContactsRecord, by_case: dict[str, list[RowRecord]]) -> Table:
    lines: list[Any] = []
    as_true = true_rows(entry)
    for contact in entry["contacts"]:
        lines.append(RowGroup(contact["label"]))
        for row in by_case[contact["case"]]:
            name, unit, size = SHOWN[row["quantity"]]
            cells = [f"{name}, {unit}", row_text.number(row["reference"] * size), row_text.deviation(row), "", ""]
            true = as_true[contact["case"]].get(row["quantity"])
            if true:
                cells[3:] = row_text.number(computed_value(true) * size), row_text.deviation(true)
            lines.append((*cells, Badge(row["verdict"])))
    title = f"{entry['bearing']['name']}: Hertz, finite elements of half-spaces and of the true bodies"
    return Table(BOTH_HEADINGS, lines, "lrrrrl", title)


def mesh_table(entry: ContactsRecord) -> Table:
    """The quantities on every mesh; of similar half-spaces those that were solved."""
    lines: list[Any] = []
    names = [name for name in SHOWN if name in entry["contacts"][0].get("on_each_mesh", [{}])[0]]
    for contact in entry["contacts"]:
        solved = contact.get("similar_to_load_N", contact["load_N"]) == contact["load_N"]
        parts = [("", contact.get("on_each_mesh", []) if solved else [])]
        if "true_on_each_mesh" in contact:
            parts = [("half-spaces, ", parts[0][1]), ("true bodies, ", contact["true_on_each_mesh"])]
        rows = [
            (f"{what}{each['elements']} elements", *(f"{each[name] * SHOWN[name][2]:.6g}" for name in names))
            for what, meshes in parts
            for each in meshes
        ]
        lines += [RowGroup(contact["label"]), *rows] if rows else []
    headings = ("", *(f"{SHOWN[name][0]}\n{SHOWN[name][1]}" for name in names))
    return Table(headings, lines, "l" + "r" * len(names), "On every mesh, elements per semi-axis")


def tolerances(entry: ContactsRecord) -> Paragraph | None:
    """The tolerances of the table and their reason; None where all are findings."""
    told: dict[tuple[float, str], list[str]] = {}
    for row in (row for rows in agreement_rows(entry).values() for row in rows):
        if row["tolerance_percent"] is not None:
            names = told.setdefault((row["tolerance_percent"], row["why_tolerance"]), [])
            names += [SHOWN[row["quantity"]][0]] if SHOWN[row["quantity"]][0] not in names else []
    if not told:
        return None
    limits = "; ".join(f"{plain(limit, '.3g')} % of {', '.join(names)}" for (limit, _), names in told.items())
    reasons = "; ".join(dict.fromkeys(why for _, why in told))
    return Paragraph(
        f"Tolerance: {limits}; {reasons}. A row passes if its deviation and its uncertainty together are within it.",
        "Tolerance:",
        is_apart=True,
    )


def undecided(entry: ContactsRecord) -> Paragraph | None:
    """Which rows are not judged because the meshes are too coarse, and the remedy."""
    if not entry.get("undecided"):
        return None
    said = "; ".join(entry["undecided"])
    return Paragraph(
        f"Not judged: {said}. It agrees within its uncertainty or the tolerance, but on these meshes both "
        f"together exceed the tolerance: more --elements than {entry['mesh']['elements_per_semi_axis']} judge it.",
        "Not judged:",
        is_apart=True,
    )


def rests_on(entry: ContactsRecord) -> list[Block]:
    """Tables of all other rows: self-checks, and what true bodies are compared with beside Hertz."""
    own = {contact["case"] for contact in entry["contacts"]}
    own |= {contact["true_case"] for contact in entry["contacts"] if "true_case" in contact}
    by_case: dict[str, list[RowRecord]] = {}
    for row in entry["rows"]:
        if row["case"] not in own:
            by_case.setdefault(row["case"], []).append(row)
    lines: list[Any] = []
    for case, rows in by_case.items():
        lines.append(RowGroup(case))
        for row in rows:
            told, unit = row_text.of_row(row), row_text.in_unit(row)[1]
            name = row_text.in_words(row["quantity"]) + (f", {unit}" if unit else "")
            numbers = (told.reference, told.found, row_text.deviation(row), told.tolerance)
            lines.append((name, *numbers, Badge(row["verdict"])))
    table = Table(
        ("", "reference", "found", "deviation %", "tolerance", ""), lines, "lrrrrl", "What the verdict rests on"
    )
    return [table] if lines else []


def for_terminal(entry: ContactsRecord) -> list[Block]:
    """All of it, for a terminal."""
    paragraphs = []
    lead = ""
    for name, told in facts(entry):
        lead = f"{name}:" if name else " " * len(lead)
        paragraphs.append(Paragraph(f"{lead} {told}", lead))
    below = [each for each in (tolerances(entry), undecided(entry)) if each]
    return [heading(entry), *paragraphs, agreement_table(entry), mesh_table(entry), *rests_on(entry), *below]
