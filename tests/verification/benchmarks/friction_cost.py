"""What the balance of friction costs, and what hypotheses and few points err by: `python -m
tests.verification.benchmarks.friction_cost [FILE]` measures and keeps the record; `--table` prints it.

Three bearings, each under thrust and under combined load, by each hypothesis and by friction with more and more points.
Errors are those against friction with `FINE` points at the same coefficient: of the displacement, of the stiffness
along x and across, of the largest load and of the mean orbital speed. Beside them stands what the coefficient alone
moves, from mu = 0.03 to 0.1. Times are processor times of one call, and of a case among `BATCH`, in turn.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import qsbearing as qs
from qsbearing.model.effects.traction import Traction
from qsbearing.model.solution.friction_motion import FrictionMotion, friction_motion
from qsbearing.model.solution.motion_stiffness import motion_stiffness
from qsbearing.results import provenance
from qsbearing.studies.cost import measuring

RECORD = Path(__file__).with_suffix(".json")
FINE, BATCH, ROUNDS, PROCESSES = (64, 160), 20, 5, 3
BAND = (0.03, 0.07, 0.1)
HELD: dict[str, Any] = {"tilt_y": 0.0, "tilt_z": 0.0}
BOTH = (qs.CentrifugalForce(), qs.GyroscopicMoment())


def bearing(balls: int, ball: float, pitch: float, inner: float, outer: float, angle: float) -> qs.BallBearing:
    """Of lengths in mm and groove radii over the ball's diameter."""
    size = ball * qs.mm
    return qs.BallBearing(balls, size, pitch * qs.mm, inner * size, outer * size, angle * qs.deg)


BEARINGS = {
    "B218": (bearing(16, 22.225, 125.26, 11.6281 / 22.225, 11.6281 / 22.225, 40.0), 10_000, 17_800.0, 3_000.0),
    "7014C": (bearing(20, 11.1125, 90.0, 0.53, 0.52, 15.0), 18_000, 600.0, 300.0),
    "120 mm turbine": (bearing(15, 20.64, 154.5, 0.54, 0.52, 24.0), 12_000, 13_345.0, 4_000.0),
}
"""Bearing, speed [rpm], thrust and radial load [N]. 7014C: a spindle bearing of its size, from no catalogue."""

HYPOTHESES = {
    "outer control": {},
    "inner control": {"raceway_control": "inner"},
    "minimum dissipation": {"raceway_control": "minimum_dissipation"},
    "outer control, common motion": {"ball_motion": "common"},
}
POINTS = {f"friction, {radii} x {angles}": (radii, angles) for radii, angles in ((4, 12), (6, 16), (10, 24), (32, 80))}
ERRORS = ("displacement_um", "stiffness", "largest_load", "orbit")
AT_AZIMUTHS = "friction, 10 x 24, each azimuth for itself"


def scenes() -> dict[tuple[str, str], qs.Scene]:
    """Of each bearing, under thrust and combined load."""
    found = {}
    for name, (of, speed, thrust, radial) in BEARINGS.items():
        for load, across in (("thrust", 0.0), ("combined", radial)):
            operation = qs.Operation(speed=speed * qs.rpm, axial_load=thrust, radial_load_y=across, **HELD)
            found[name, load] = qs.Scene(of, operation, BOTH, "outer")  # type: ignore[arg-type]
    return found


def batch(scene: qs.Scene) -> qs.Scene:
    """The same at loads within 10 %."""
    parts = np.linspace(0.95, 1.05, BATCH)
    operation = scene.operation
    loads = {name: getattr(operation, name) * parts for name in ("axial_load", "radial_load_y")}
    return replace(scene, operation=replace(operation, **loads))


def ways(scene: qs.Scene, traction: Traction) -> dict[str, Callable[[], Any]]:
    """Each way of solving it."""
    found: dict[str, Callable[[], Any]] = {
        name: partial(qs.solve, replace(scene, **changes), threads=1) for name, changes in HYPOTHESES.items()
    }
    found |= {
        name: partial(friction_motion, scene, traction, radii=radii, angles=angles)
        for name, (radii, angles) in POINTS.items()
    }
    return found | {AT_AZIMUTHS: partial(friction_motion, scene, traction, carried=False)}


def numbers(solved: qs.Solution | FrictionMotion) -> dict[str, float] | None:
    """What designers read; None without a solution."""
    if solved.status != "converged":
        return None
    scene = solved.start.scene if isinstance(solved, FrictionMotion) else solved.scene
    matrix = motion_stiffness(solved) if isinstance(solved, FrictionMotion) else solved.stiffness
    along, across = np.diag(matrix)[:2]
    orbit, speed = solved.orbital_speed, scene.operation.speed
    assert orbit is not None
    return {
        "axial_um": solved.displacement[0] * 1e6,
        "radial_um": solved.displacement[1] * 1e6,
        "axial_stiffness": along / 1e6,
        "radial_stiffness": across / 1e6,
        "largest_load_N": np.nanmax(solved.inner.load),
        "orbit": np.nanmean(orbit) / float(speed),  # type: ignore[arg-type]
    }


def errors(found: dict[str, float] | None, exact: dict[str, float]) -> dict[str, float | None]:
    """Of a displacement [um], the larger; of the others relative ones."""
    if found is None:
        return dict.fromkeys(ERRORS)
    moved = max(abs(found[name] - exact[name]) for name in ("axial_um", "radial_um"))

    def relative(*names: str) -> float:
        return max(abs(found[name] / exact[name] - 1.0) for name in names)

    return {
        "displacement_um": moved,
        "stiffness": relative("axial_stiffness", "radial_stiffness"),
        "largest_load": relative("largest_load_N"),
        "orbit": relative("orbit"),
    }


def accuracy() -> list[dict[str, Any]]:
    """A row for each bearing, load and way."""
    rows = []
    for (name, load), scene in scenes().items():
        fine = numbers(friction_motion(scene, Traction(), radii=FINE[0], angles=FINE[1]))
        assert fine is not None
        for way, call in ways(scene, Traction()).items():
            rows.append({"bearing": name, "load": load, "way": way, **rounded(errors(numbers(call()), fine))})
        band = [numbers(friction_motion(scene, Traction(mu))) for mu in BAND]
        moved: dict[str, list[float]] = {key: [each[key] for each in band if each] for key in fine}
        rows.append({"bearing": name, "load": load, "way": "band", "mu": BAND, **rounded(moved)})
    return rows


def rounded(of: dict[str, Any]) -> dict[str, Any]:
    """To four digits."""
    return {
        name: each if each is None else [float(f"{x:.4g}") for x in each] if isinstance(each, list)
        else float(f"{each:.4g}")
        for name, each in of.items()
    }  # fmt: skip


def times(rounds: int) -> measuring.Times:
    """Seconds of a call by bearing, load, way and number of cases."""
    calls: dict[Any, Callable[[], Any]] = {}
    for (name, load), scene in scenes().items():
        calls |= {(name, load, way, 1): call for way, call in ways(scene, Traction()).items()}
        many = ways(batch(scene), Traction())
        calls |= {(name, load, way, BATCH): many[way] for way in ("outer control", "friction, 10 x 24")}
    return measuring.interleaved(calls, rounds)


def measure(rounds: int = ROUNDS, processes: int = PROCESSES) -> dict[str, Any]:
    """The record."""
    rows = accuracy()
    pooled: measuring.Times = {}
    for _ in range(processes):
        for key, values in measuring.in_fresh_process(times, rounds).items():
            pooled.setdefault(key, []).extend(values)
    for row in rows:
        for cases in (1, BATCH):
            key = row["bearing"], row["load"], row["way"], cases
            if key in pooled:
                row["call_ms" if cases == 1 else "case_ms"] = measuring.spread([1e3 * t / cases for t in pooled[key]])
    settings = {"fine": FINE, "batch": BATCH, "rounds": rounds, "processes": processes}
    made = provenance.of_run("python -m tests.verification.benchmarks.friction_cost")
    return {"provenance": made, "settings": settings, "rows": rows}


def table(record: dict[str, Any]) -> str:
    """Of all rows, in Markdown."""
    head = ["bearing, load", "balls' motion", "displacement, um", "stiffness, %", "load, %", "orbit, %", "a call, ms"]
    lines = [f"| {' | '.join(head)} |", "|" + "---|" * len(head)]
    for row in record["rows"]:
        where = f"{row['bearing']}, {row['load']}"
        if row["way"] == "band":
            spans = {k: f"{min(v):.4g} to {max(v):.4g}" for k, v in row.items() if isinstance(v, list) and k != "mu"}
            moved = spans["axial_um"] if row["load"] == "thrust" else f"{spans['axial_um']}; {spans['radial_um']}"
            stiff = f"{spans['axial_stiffness']}; {spans['radial_stiffness']} N/um"
            cells = [moved, stiff, f"{spans['largest_load_N']} N", f"{spans['orbit']} of the shaft", ""]
            lines.append(f"| {' | '.join([where, 'friction, mu 0.03 to 0.1: values', *cells])} |")
            continue
        found = [row[key] for key in ERRORS]
        cells = [
            "no solution" if v is None else f"{v:.2g}" if k == 0 else f"{100 * v:.2g}" for k, v in enumerate(found)
        ]
        cells.append(f"{row['call_ms']['median']:.3g}" if "call_ms" in row else "")
        lines.append(f"| {' | '.join([where, row['way'], *cells])} |")
    return "\n".join(lines)


def main() -> None:
    """Measure and keep, or print what is kept."""
    if sys.argv[1:] == ["--table"]:
        print(table(json.loads(RECORD.read_text(encoding="utf-8"))))
        return
    record = measure()
    rows = ",\n  ".join(map(json.dumps, record.pop("rows")))
    parts = [f" {json.dumps(key)}: {json.dumps(value)}" for key, value in record.items()]
    target = Path(sys.argv[1]) if sys.argv[1:] else RECORD
    target.write_text("{\n" + ",\n".join([*parts, f' "rows": [\n  {rows}\n ]']) + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
