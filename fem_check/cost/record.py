"""The cost record: what is in it, what is fitted to it; tables, figures and advice are made from it.

Order of convergence. The pressure ends like a square root at the contact's edge, so bilinear basis functions carry it
to the power 3/2 of the element size h in the norm of the energy, and the contact's energy to h^3. Approach and
semi-axes are that energy's derivatives: the approach by the load, the second moments of the pressure (a and b) by the
two curvatures. Its error is periodic in the edge's position in an element, and a derivative of what has the period h
loses one power: h^2 for the contact's edge at one position; in the mean over all positions in an element the periodic
part cancels, which leaves h^3. The shear below the surface is no such derivative: for it this is a comparison only.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from fem_check import records_store
from fem_check.agreement import Level
from fem_check.cost import configurations, fits, shapes
from fem_check.cost.configurations import JUDGED
from fem_check.records_store import RecordError

FOLDER = records_store.FOLDER / "cost"
SOLVERS = {
    "cholmod": "CHOLMOD (scikit-sparse)",
    "rslab": "rslab",
    "pardiso": "PARDISO (pypardiso)",
    "scipy": "SuperLU (scipy)",
}
REFERENCE = 4
"""Elements per semi-axis of the mesh to whose time the others are compared."""
MEASURED, NOT_INSTALLED = "measured", "not installed"
THEORY = {"one_position": 2.0, "mean_of_positions": 3.0}
"""Orders, see above."""
LARGE = 1e4
"""Unknowns from which on times and memory are fitted: below, start-up takes most of the time."""
TIMED = ("seconds", "contact_seconds", "cpu_seconds", "peak_memory_MB", "base_memory_MB")
GIVEN = ("dofs", "element_size", "error", "worst_error", "worst_single_position", *TIMED, "seconds_over_reference")
"""Fields of a measured configuration; None in one that was not measured."""
FIELDS = (
    "level",
    "machine",
    "contact",
    "solvers",
    "configurations",
    "shapes",
    "closed_forms",
    "orders",
    "scaling",
    "holdout_contacts",
)


def selected(entries: list[dict[str, Any]], **wanted: Any) -> list[dict[str, Any]]:
    """The measured configurations with the given properties, coarse to fine; far fields in the order of the record."""
    chosen = [
        entry
        for entry in entries
        if entry["status"] == MEASURED and all(entry[name] == value for name, value in wanted.items())
    ]
    far_fields = list(dict.fromkeys(entry["far_field"] for entry in entries))
    return sorted(chosen, key=lambda entry: (far_fields.index(entry["far_field"]), entry["dofs"]))


def mesh_refinement(entries: list[dict[str, Any]], solver: str) -> list[dict[str, Any]]:
    """The mesh refinement that all checks use: 20-node hexahedra, exact far field."""
    return selected(entries, family=configurations.SERENDIPITY.name, far_field="exact", solver=solver)


def orders(shaped: list[dict[str, Any]], entries: list[dict[str, Any]]) -> dict[str, Any]:
    """Observed orders of convergence of the worst over all shapes, for one position of the edge and for the mean of
    8."""
    sizes = {entry["elements_per_semi_axis"]: entry["element_size"] for entry in entries if entry["element_size"]}
    counts = sorted({entry["elements_per_semi_axis"] for entry in shaped} & set(sizes))
    series: dict[str, Any] = {"element_size": [sizes[count] for count in counts], "theory": THEORY}
    for key, count_of_positions in (("one_position", "1"), ("mean_of_positions", str(max(shapes.COUNTS)))):
        series[key] = {}
        for name in JUDGED:
            worst = [envelope(shaped, count, count_of_positions, (name,)) for count in counts]
            series[key][name] = {"error": worst, **fits.power_law(series["element_size"], worst)}
    return series


def envelope(shaped: list[dict[str, Any]], elements: int, positions: str, names: tuple[str, ...] = JUDGED) -> float:
    """Largest error of a mesh over all shapes and the named quantities, with so many positions of the edge."""
    return max(
        entry["worst_error"][positions][name]
        for entry in shaped
        if entry["elements_per_semi_axis"] == elements
        for name in names
    )


def scaling(entries: list[dict[str, Any]]) -> dict[str, Any]:
    """Time and memory against unknowns, a power law for each linear solver.

    Memory is what the contact adds to the process that solves it.
    """
    found = {}
    for solver in dict.fromkeys(entry["solver"] for entry in entries):
        refinement = mesh_refinement(entries, solver)
        large = [entry for entry in refinement if entry["dofs"] >= LARGE]
        used = large if len(large) >= 3 else refinement
        dofs = [entry["dofs"] for entry in used]
        found[solver] = {
            "from_dofs": min(dofs, default=None),
            "to_dofs": max(dofs, default=None),
            "time": fits.power_law(dofs, [entry["seconds"]["median"] for entry in used]),
            "memory": fits.power_law(dofs, [added_memory(entry) for entry in used]),
        }
    return found


def added_memory(entry: dict[str, Any]) -> float:
    """Peak memory above the process's own at the start [MB]."""
    return float(entry["peak_memory_MB"]["median"] - entry["base_memory_MB"]["median"])


def read(folder: Path = FOLDER) -> dict[str, Any] | None:
    """The release level's record where there is one, else the quick level's; None for neither.

    Raises:
        RecordError: a file that is no cost record.
    """
    for level in (Level.RELEASE, Level.QUICK):
        path = folder / f"{level}.json"
        if not path.is_file():
            continue
        try:
            found = json.loads(path.read_text(encoding="utf-8"))
            missing = [field for field in FIELDS if field not in found]
        except (ValueError, OSError, TypeError) as problem:
            raise RecordError(f"{path} is no cost record ({problem}); run `fem-check cost` again") from problem
        if missing:
            raise RecordError(f"{path} lacks {', '.join(missing)}; run `fem-check cost` again")
        return dict(found)
    return None
