"""What the design report says of evidence, read from the records: `python -m tests.reports.evidence_numbers`.

The report is part of qsbearing, which knows nothing of fem_check and its records; so it has these numbers as a file.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from tests.fem_check.test_references import SHAPES, against_carlson

ROOT = Path(__file__).parents[2]
NUMBERS = ROOT / "qsbearing/reports/evidence.json"
RELEASE = "fem_check/records/release"
LOADS = r"Q = ([\d.]+) to ([\d.]+) N"
BOOK = "fem_check/records/book"


def read(path: str) -> Any:
    """A record of the repository."""
    return json.loads((ROOT / path).read_text(encoding="utf-8"))


def largest(values: Iterable[float]) -> float:
    """By size."""
    return max(map(abs, values))


def span(values: Iterable[float]) -> list[float]:
    """The least and the largest."""
    found = list(values)
    return [min(found), max(found)]


def order(value: float) -> float:
    """The next power of ten: rounding differs from run to run, its size does not."""
    return float(f"1e{math.ceil(math.log10(value))}")


def reference() -> dict[str, Any]:
    record = read("tests/verification/reference/table.json")
    cases = record["cases"]
    worst = largest(case[name] for case in cases for name in ("loads", "angles", "displacements", "stiffness"))
    known = {
        effect: any(word in case["case"] for case in cases)
        for effect, word in (("unequal_balls", "unequal"), ("seats_out_of_round", "seats"))
    }
    return {"scenes": len(cases), "largest": order(worst), **{f"has_{name}": there for name, there in known.items()}}


def hertz_formula() -> dict[str, Any]:
    worst = max(deviation for k in SHAPES for name, deviation in against_carlson(k).items() if "shear" not in name)
    return {"ellipticity": span(SHAPES), "largest_percent": order(100.0 * worst)}


def solution_contacts() -> dict[str, Any]:
    rows = read(f"{RELEASE}/solution_contacts.json")["rows"]
    loads = [float(each) for row in rows for pair in re.findall(LOADS, row["case"]) for each in pair]
    points = {int(found[1]) for row in rows if (found := re.search(r"(\d+) operating points", row["case"]))}
    judged = [row for row in rows if "shear" not in row["quantity"]]
    by = {
        name: largest(row["deviation_percent"] for row in judged if row["case"].endswith(ending))
        for name, ending in (("closed_form_percent", "closed form"), ("finite_elements_percent", "finite elements"))
    }
    by["closed_form_percent"] = order(by["closed_form_percent"])
    return {"operating_points": points.pop(), "load_N": span(loads), **by}


def conformity() -> dict[str, Any]:
    picture = read(f"{RELEASE}/conformity.json")["pictures"]["conformity"]
    at_most = {f: largest(values[-1] for values in curve.values()) for f, curve in picture["curves"].items()}
    return {"f": span(map(float, at_most)), "load_N": span(picture["load_N"]), "largest_percent": at_most}


def true_geometry() -> dict[str, Any]:
    record = read(f"{RELEASE}/true_geometry.json")
    sides = record["pictures"]["true_geometry"].values()
    angles = [float(each) for row in record["rows"] for each in re.findall(r"at ([\d.]+)°", row["case"])]
    names = next(iter(sides))["true_contact_percent"]
    percent = {name: span(x for side in sides for x in side["true_contact_percent"][name]) for name in names}
    loads = [load for side in sides for load in side["load_N"]]
    return {"load_N": span(loads), "angle_deg": span(angles), "percent": percent}


def bearing_sector() -> dict[str, Any]:
    record = read(f"{RELEASE}/bearing_sector.json")
    series = record["pictures"]["bearing_sector"]
    speeds = {float(each) for row in record["rows"] for each in re.findall(r"(\d+) rpm", row["case"])}
    loads = [load for held in series.values() for one in held.values() for load in one["load_N"]]

    def of(held: str, *names: str) -> list[float]:
        own = [name for name in series if name.startswith(held) and "in the model" not in name]
        every = [one for name in own for one in series[name].values()]
        return span(x for one in every for name in names for x in one[name]["deviation"])

    found: dict[str, Any] = {"load_N": span(loads), "speed_rpm": speeds.pop()}
    for held in ("rigid", "free"):
        found[held] = {
            "displacement_percent": of(held, "axial_displacement"),
            "load_percent": of(held, "inner load", "outer load"),
            "angle_deg": of(held, "inner angle", "outer angle"),
            "semi_minor_axis_percent": of(held, "inner semi_minor_axis", "outer semi_minor_axis"),
            "pressure_percent": of(held, "inner max_pressure", "outer max_pressure"),
        }
    return found


def book() -> dict[str, Any]:
    def rows(name: str) -> list[dict[str, Any]]:
        return list(read(f"{BOOK}/{name}.json")["rows"])

    def row(name: str, quantity: str, case: str = "") -> dict[str, Any]:
        return next(each for each in rows(name) if each["quantity"] == quantity and each["case"].startswith(case))

    balls = rows("iso_16281_seven_balls")
    lives = [each["deviation_percent"] for each in balls if "life" in each["quantity"]]
    groups = row("endurance_1956", "measured over computed L10, geometric mean by bearings")
    scatter = row("endurance_1956", "scatter of ln(measured/computed), standard deviation")["found"]
    bearings = re.search(r"(\d+) bearings", groups["case"])
    series = re.search(r"(\d+) bearings, (\d+) values", row("gmn_rigidities", "rms deviation", "series S, 15")["case"])
    assert bearings is not None
    assert series is not None
    slips = [
        each["found"] for each in rows("mfpt_rig") if each["quantity"] == "cage slower than without slip, from BPFI"
    ]
    films = [each["deviation_percent"] for each in rows("hamrock_209_film") if "simple ellipses" in each["quantity"]]
    return {
        "iso_16281_seven_balls": {
            "displacements_percent": largest(
                each["deviation_percent"] for each in balls if "life" not in each["quantity"]
            ),
            "lives_percent": largest(lives),
            "lives": len(lives),
        },
        "endurance_1956": {
            "bearings": int(bearings[1]),
            "measured_over_computed": groups["found"],
            "scatter_factor": math.exp(scatter),
        },
        "motor_bearings": {
            "inside": int(row("motor_bearings", "groups inside the computed range")["found"]),
            "inside_recommended": int(row("motor_bearings", "groups inside")["found"]),
            "groups": int(row("motor_bearings", "groups inside")["reference"]),
        },
        "mfpt_rig": {"slip": span(slips)},
        "gmn_rigidities": {
            "bearings": int(series[1]),
            "values": int(series[2]),
            "rms": row("gmn_rigidities", "rms deviation", "series S, 15")["found"],
            "largest": abs(row("gmn_rigidities", "largest deviation", "series S, 15")["found"]),
        },
        "hamrock_209_film": {"textbook_percent": largest(films)},
    }


def numbers() -> dict[str, Any]:
    """All of them, to six digits."""
    of_checks = (reference, hertz_formula, solution_contacts, conformity, true_geometry, bearing_sector)
    found = {each.__name__: each() for each in of_checks} | book()
    return json.loads(json.dumps(found), parse_float=lambda text: float(f"{float(text):.6g}"))


def main() -> None:
    """Write the file of the report."""
    NUMBERS.write_text(json.dumps(numbers(), indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
