"""How near every scene of the fifty-digit reference comes: `python -m tests.verification.reference.table` writes
table.json.

Errors are relative: a contact's load over that load, angles over the case's largest, displacements (tilts as motions at
the pitch radius) over its largest, entries of the stiffness over the geometric mean of the two diagonal entries that
they join.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

import qsbearing as qs
from qsbearing.results import provenance
from tests.verification.hard_cases.table import errors
from tests.verification.reference.as_scene import scene_of
from tests.verification.reference.generate import load_reference
from tests.verification.reference.test_against_reference import TOLERANCE

DATA = Path(__file__).with_name("table.json")
WHY = "two digits coarser than the solver's own, which stops at a force imbalance of 1e-12"


def stiffness_error(solution: qs.Solution, result: dict[str, Any], radius: float) -> float:
    """The largest relative error of the tangent; a channel without stiffness counts by the stiffest."""
    unit = np.array([1.0, 1.0, 1.0, radius, radius])
    exact = np.array([[float(value) for value in row] for row in result["stiffness"]])
    own = np.abs(np.diag(exact))
    diagonal = np.maximum(own, (own / unit**2).max() * unit**2 * 1e-6)
    found = qs.stiffness(solution.scene, solution)
    return float(np.max(np.abs(found - exact) / np.sqrt(np.outer(diagonal, diagonal))))


def rows() -> list[dict[str, Any]]:
    """A row for every scene."""
    found = []
    for entry in load_reference():
        case, result = entry["case"], entry["result"]
        solution = qs.solve(scene_of(case))
        off = errors(solution, result)
        off["stiffness"] = stiffness_error(solution, result, 0.5 * float(case["pitch_diameter"]))
        verdict = "pass" if solution.converged and max(off.values()) <= TOLERANCE else "fail"
        short = {name: float(f"{value:.1e}") for name, value in off.items()}
        found.append({"case": case["name"], "what": case["why"], **short, "verdict": verdict})
    return found


def main() -> None:
    """Solve, compare, write."""
    record = {
        "provenance": provenance.of_run("python -m tests.verification.reference.table"),
        "tolerance": TOLERANCE,
        "why_tolerance": WHY,
        "cases": rows(),
    }
    target = Path(sys.argv[1]) if sys.argv[1:] else DATA
    target.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    worst = max(max(row[name] for name in ("loads", "angles", "displacements", "stiffness")) for row in record["cases"])
    print(f"{len(record['cases'])} scenes, largest relative error {worst:.1e}: {target}")


if __name__ == "__main__":
    main()
