"""The cost record as tables; they format, and compute nothing."""

from __future__ import annotations

from fem_check.cost.measurement import JUDGED
from fem_check.cost.mesh_choice import choices
from fem_check.cost.record import CostRecord, FormCost, MeshCost, Spread
from fem_check.rows.row_text import scientific
from qsbearing.documents.model import Table
from qsbearing.documents.numbers import duration, plain, unit_of

SHORT_NAMES = dict(zip(JUDGED, ("δ", "a", "b", "p0", "τmax"), strict=True))


def spread(seconds: Spread) -> str:
    """Median, and smallest to largest, in a unit that suits them."""
    unit, size = unit_of(seconds["median"])
    median, low, high = (plain(seconds[name] / size, ".4g") for name in ("median", "low", "high"))
    return f"{median} ({low} to {high}) {unit}"


def measured(record: CostRecord) -> Table:
    """Errors, time and memory of every closed form and every mesh."""
    rows = [_line(form["label"], "", form, "") for form in record["closed_forms"]]
    for mesh in record["meshes"]:
        label = f"{mesh['family']}: {mesh['elements_per_semi_axis']}"
        rows.append(_line(label, str(mesh["dofs"]), mesh, str(mesh["peak_memory_MB"])))
    title = f"One contact ({record['contact']}, a/b = {record['ellipticity']:.2f}); elements: number per semi-axis"
    headings = ("solved by", "unknowns", *(f"{name} %" for name in SHORT_NAMES.values()), "time", "MB")
    return Table(headings, rows, caption=title)


def _line(label: str, dofs: str, cost: FormCost | MeshCost, memory: str) -> tuple[str, ...]:
    errors = (f"{100.0 * cost['error'][name]:+.2g}" if name in cost["error"] else "" for name in JUDGED)
    return label, dofs, *errors, spread(cost["seconds"]), memory


def mesh_choices(record: CostRecord) -> Table:
    """What each accuracy costs, uncertainty included."""
    rows: list[tuple[str, ...]] = [
        (
            scientific(choice.accuracy, 2),
            ", ".join(map(str, choice.sequence)),
            duration(choice.seconds),
            f"{choice.peak_memory_MB:.0f}",
        )
        for choice in choices(record)
    ]
    machine = record["machine"]
    title = (
        "Accuracy reached: deviation and uncertainty from three meshes together, on "
        f"{machine['cores']} cores ({machine['processor']}, solver {record['solver']})"
    )
    return Table(("accuracy", "elements per semi-axis", "time of all three", "MB"), rows, caption=title)


def remark(record: CostRecord) -> str:
    """Where and how it was measured."""
    machine = record["machine"]
    return (
        f"Measured on {machine['processor']}, {machine['cores']} cores, load average {machine['load_average']} at the "
        f"start, linear solver {record['solver']}, by `{record['made_by']}`. Medians of "
        "alternating runs in separate processes (smallest to largest); memory is the process's peak. "
        "The elements' errors are those of the mean over 8 positions of the contact's edge in an element. All meshes "
        "are divided in depth as 20-node hexahedra need it: elements of first order level off."
    )
