"""How near each hard case comes to fifty digits: `python -m tests.verification.hard_cases.table [FILE]` writes
table.json, here or elsewhere; the guide's tables are written with TABLE.md, which shows it.

Errors are relative: a contact's load over that load, angles over the case's largest, displacements (tilts as motions at
the pitch radius) over its largest. A case is within 1e-9, or what it loses is explained by the condition number of its
full system times 2^-52; or it is neither, a failure.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.results import provenance
from tests.verification.hard_cases.cases import CASES, CONVERGED
from tests.verification.hard_cases.generate import load_reference
from tests.verification.hard_cases.scenes import scene_of

HERE = Path(__file__).parent
DATA, TABLE = HERE / "table.json", HERE / "TABLE.md"
WITHIN = 1e-9
LOST = 1e-12
"""A contact that carries less than this of the largest load is as good as lost: that is the solver's tolerance."""
ROUNDING = 2.0**-52

HEADING = (
    *("case", "what", "outcome", "iterations", "residual", "loads", "angles", "displacements", "condition", "x 2^-52"),
    "verdict",
)

Row = dict[str, Any]


def errors(solution: qs.Solution, result: dict[str, Any], index: Any = ()) -> dict[str, float]:
    """The largest relative error of loads, angles and displacements; infinite where a contact is lost on one side only
    or a number is missing."""
    found = {"loads": 0.0, "angles": 0.0, "displacements": 0.0}
    least = LOST * max(_largest(numbers(result, race, "load")) for race in ("inner", "outer"))
    steepest = max(np.nanmax(np.abs(numbers(result, race, "angle"))) for race in ("inner", "outer"))
    for race in ("inner", "outer"):
        contacts = getattr(solution, race)
        load, angle = (numbers(result, race, key) for key in ("load", "angle"))
        got, turned = contacts.load[index], contacts.angle[index]
        loaded = load > least
        if not np.array_equal(got > least, loaded):
            return dict.fromkeys(found, float("inf"))
        found["loads"] = max(found["loads"], _largest(np.abs(got - load)[loaded] / load[loaded]))
        placed = np.isfinite(angle) & (np.isfinite(turned) | loaded)
        found["angles"] = max(found["angles"], _largest(np.abs(turned - angle)[placed]) / (steepest or 1.0))
    radius = 0.5 * float(np.asarray(solution.scene.bearing.pitch_diameter))
    unit = np.array([1.0, 1.0, 1.0, radius, radius])
    displacement = np.array([float(value) for value in result["displacement"]]) * unit
    off = np.abs(solution.displacement[index] * unit - displacement)
    found["displacements"] = _largest(off) / (_largest(np.abs(displacement)) or 1.0)
    return {name: value if np.isfinite(value) else float("inf") for name, value in found.items()}


def numbers(result: dict[str, Any], race: str, key: str) -> NDArray:
    """One quantity of all contacts of a race; NaN where there is none."""
    values = [ball[race][key] for ball in result["balls"]]
    return np.array([np.nan if value is None else float(value) for value in values])


def _largest(values: NDArray) -> float:
    return float(np.max(values, initial=0.0))


def verdict(error: float, condition: float) -> str:
    """Within 1e-9, explained by the condition, or unexplained."""
    if error <= WITHIN:
        return "within 1e-9"
    return "explained by its condition" if error <= condition * ROUNDING else "UNEXPLAINED"


def rows() -> list[Row]:
    """All cases: outcome, and where there is a reference the errors against it."""
    reference = {entry["case"]["name"]: entry["result"] for entry in load_reference()}
    found = []
    for case in CASES:
        solution = qs.solve(scene_of(case["name"]))
        row: Row = {
            "case": case["name"],
            "what": case["why"],
            "expected": case["expected"],
            "status": str(solution.status),
            "iterations": int(solution.iterations),
            "residual": float(f"{solution.residual:.1e}"),
        }
        if case["expected"] == CONVERGED:
            result = reference[case["name"]]
            if solution.converged:
                row |= {name: float(f"{value:.1e}") for name, value in errors(solution, result).items()}
                worst = max(row[name] for name in ("loads", "angles", "displacements"))
                row["verdict"] = verdict(worst, result["condition"])
            else:
                row["verdict"] = "NOT SOLVED"
            row |= {"condition": result["condition"], "unavoidable": float(f"{result['condition'] * ROUNDING:.1e}")}
        else:
            agrees = row["status"] == ("converged" if case["expected"] == "closed form" else case["expected"])
            row["verdict"] = "as expected" if agrees else "NOT AS EXPECTED"
        found.append(row)
    return found


def markdown(table: list[Row]) -> str:
    """The table as it is read."""
    lines = [
        "# Hard cases against fifty digits",
        "",
        "Made by `python -m tests.verification.hard_cases.table` from `table.json`. Cases and what is expected of",
        "them: `cases.py`; the fifty-digit solutions and how the condition numbers are made: `generate.py`. Errors",
        "are relative: loads each by itself, angles and displacements over the case's largest. Condition numbers come",
        "with what they make of 2^-52.",
        "",
        f"| {' | '.join(HEADING)} |",
        "|" + "---|" * len(HEADING),
    ]
    for row in table:
        cells = [row["case"], row["what"], row["status"].replace("_", " "), row["iterations"], f"{row['residual']:.0e}"]
        for key in ("loads", "angles", "displacements", "condition", "unavoidable"):
            cells.append(f"{row[key]:.0e}" if key in row else "")
        lines.append("| " + " | ".join(map(str, [*cells, row["verdict"]])) + " |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Solve, compare, write."""
    table = rows()
    record = {"provenance": provenance.of_run("python -m tests.verification.hard_cases.table"), "cases": table}
    target = Path(sys.argv[1]) if sys.argv[1:] else DATA
    target.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    print(markdown(table))


if __name__ == "__main__":
    main()
