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
from qsbearing.model.effects.traction import Traction
from qsbearing.model.solution.friction_motion import FrictionMotion, friction_motion
from qsbearing.results import provenance
from tests.verification.hard_cases.table import errors
from tests.verification.reference.as_scene import scene_of
from tests.verification.reference.friction import load_reference as load_friction
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
        about = {"case": case["name"], "what": case["why"], "raceway_control": control_of(case)}
        found.append({**about, **short, "verdict": verdict})
    return found


def control_of(case: dict[str, Any]) -> str | None:
    """The hypothesis under which balls turn; None at rest."""
    is_turning = any(float(case[name]) != 0.0 for name in ("inner_speed_rpm", "outer_speed_rpm"))
    return str(case["control"]) if is_turning else None


def found_of(case: dict[str, Any]) -> FrictionMotion:
    """The package's answer to a case of friction."""
    names = ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius")
    angle = float(case["free_contact_angle_deg"]) * qs.deg
    bearing = qs.BallBearing(case["ball_count"], *(float(case[name]) for name in names), angle)
    operation = qs.Operation(speed=float(case["inner_speed_rpm"]) * qs.rpm, axial_load=float(case["axial_load"]))
    law = Traction(float(case["mu"]), float(case["slip_speed"]))
    return friction_motion(qs.Scene(bearing, operation), law, radii=case["radii"], angles=case["angles"])


def friction_errors(entry: dict[str, Any]) -> dict[str, float]:
    """Of every result of the balance of friction, over sizes of its kind."""
    case, found = entry["case"], found_of(entry["case"])
    expected = {name: float(value) for name, value in entry["result"].items()}
    speed, load = float(case["inner_speed_rpm"]) * qs.rpm, expected["outer_load"]
    got = {"d": found.displacement[0], "wm": found.orbital_speed[0], "Mg": found.gyroscopic_moment[0]}
    got |= dict(zip(("wx", "wy", "wz"), found.angular_velocity[0], strict=True))
    got["torque"] = found.torque / case["ball_count"]
    scale = {"d": 1e-5, "Mg": expected["Mg"], "torque": abs(expected["torque"])}
    scale |= dict.fromkeys(("wx", "wy", "wz", "wm"), speed)
    quantities = {"angle": "angle", "load": "load", "approach": "approach", "T": "traction", "Y": "sideways"}
    quantities |= {"Mn": "spin_moment", "Mt": "roll_moment", "My": "turn_moment", "heat": "heat"}
    forces = {"T": load, "Y": load} | dict.fromkeys(("Mn", "Mt", "My"), load * float(case["ball_diameter"]))
    for side in ("inner", "outer"):
        for name, quantity in quantities.items():
            key = f"{side}_{name}"
            got[key] = getattr(getattr(found, side), quantity)[0]
            scale[key] = forces.get(name, abs(expected[key]))
    assert set(expected) - set(got) == {"X1", "X2", "residual"}
    return {name: abs(got[name] - expected[name]) / scale[name] for name in got}


def friction_rows() -> list[dict[str, Any]]:
    """A row for every case of friction, with the largest of its errors."""
    found = []
    for entry in load_friction():
        error = max(friction_errors(entry).values())
        verdict = "pass" if error <= TOLERANCE else "fail"
        about = {"case": entry["case"]["name"], "what": entry["case"]["why"]}
        found.append(about | {"error": float(f"{error:.1e}"), "verdict": verdict})
    return found


def main() -> None:
    """Solve, compare, write."""
    record = {
        "provenance": provenance.of_run("python -m tests.verification.reference.table"),
        "tolerance": TOLERANCE,
        "why_tolerance": WHY,
        "cases": rows(),
        "friction_cases": friction_rows(),
    }
    target = Path(sys.argv[1]) if sys.argv[1:] else DATA
    target.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    worst = max(max(row[name] for name in ("loads", "angles", "displacements", "stiffness")) for row in record["cases"])
    print(f"{len(record['cases'])} scenes, largest relative error {worst:.1e}: {target}")


if __name__ == "__main__":
    main()
