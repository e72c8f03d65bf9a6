"""What readings add to a batch: `python -m tests.verification.benchmarks.readings_cost`, in a quarter of a minute.

Processor time of one thread, which neighbours on the machine disturb least; the least and the median of several runs,
solve and readings in turn. Two batches of B218 with both ball effects: loads in all five channels, so that no two balls
are alike, and a radial load in one plane, where the solver leaves out the mirror images that readings still tell of.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import replace
from statistics import median
from typing import Any

import numpy as np

import qsbearing as qs
from qsbearing.files.scene_file import scene_of
from qsbearing.readings import asked

CASES, RUNS = 20_000, 9
SCENE: dict[str, Any] = {
    "bearing": {"name": "B218"},
    "operation": {"axial_load_N": 10_000},
    "effects": {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "outer"},
    "readings": {
        "life": {"viscosity_ratio": 1.5, "contamination_factor": 0.5},
        "static_safety": True,
        "kinematics": True,
        "frequencies": True,
        "lubricant": {"iso_viscosity_grade": 68, "oil_temperature_C": 70},
        "film": {"ball_roughness_um": 0.05, "raceway_roughness_um": 0.2},
        "friction": {"friction_coefficient": 0.05, "drag_coefficient": 0.5, "fluid_density_kg_m3": 20},
        "friction_estimate": {
            "bore_diameter_mm": 90, "outside_diameter_mm": 160, "static_load_rating_N": 85e3, "lubrication_factor": 2.0
        },
        "overrun": {"inner_shoulder_diameter_mm": 115, "outer_shoulder_diameter_mm": 139},
        "stress": True,
    },
}  # fmt: skip


def scene(is_symmetric: bool, count: int = CASES) -> qs.Scene:
    """The batch, from a fixed seed."""
    draw = np.random.default_rng(1).uniform
    loads = {"speed": draw(2e3, 10e3, count) * qs.rpm, "axial_load": draw(5e3, 20e3, count)}
    names = ["radial_load_y"] if is_symmetric else ["radial_load_y", "radial_load_z"]
    loads |= {name: draw(-1.5e3, 1.5e3, count) for name in names}
    moments = {"tilt_z": 0.0} if is_symmetric else {name: draw(-50.0, 50.0, count) for name in ("moment_y", "moment_z")}
    return replace(scene_of(SCENE, "the batch"), operation=qs.Operation(**loads, **moments))  # type: ignore[arg-type]


def timed(work: Callable[[], Any]) -> float:
    """Processor time [s]."""
    began = time.process_time()
    work()
    return time.process_time() - began


def measure(batch: qs.Scene) -> dict[str, list[float]]:
    """Times of the solve, of reading arrays off the solution, and of each reading."""
    oil, _ = asked._oil(batch.readings)
    names = [name for name in asked.READINGS if name in batch.readings]
    needs = [asked.READINGS[name].needs for name in names if name != "friction"]
    arrays = [sorted({name for each in needs for name in each[i]}) for i in (0, 1)]
    found: dict[str, list[float]] = {}
    for _ in range(RUNS):
        solved = []
        found.setdefault("solve", []).append(timed(lambda solved=solved: solved.append(qs.solve(batch, threads=1))))
        solution = solved[0]
        found.setdefault("arrays", []).append(timed(lambda solution=solution: solution.read_at_once(*arrays)))
        for name in names:
            take, given = asked.READINGS[name].take, asked.READINGS[name].arguments(batch.readings[name], oil)
            found.setdefault(name, []).append(timed(lambda t=take, s=solution, g=given: t(s, g, {})))
    return found


def main() -> None:
    """Print the tables."""
    os.environ["QSBEARING_THREADS"] = "1"
    qs.readings.take_asked(qs.solve(scene(False, 100)))  # compiled, and the table of friction made
    for title, is_symmetric in (("16 unlike balls", False), ("mirror images in pairs", True)):
        found = measure(scene(is_symmetric))
        least = min(found["solve"])
        print(f"\n{title}: {'us a case':>12}  least, median      % of the solve: least, median")
        for name, times in found.items():
            of_solve = f"{100 * min(times) / least:10.1f} {100 * median(times) / median(found['solve']):8.1f}"
            print(f"{name:>20} {1e6 * min(times) / CASES:12.2f} {1e6 * median(times) / CASES:8.2f} {of_solve:>24}")
        for label, left in (("all but friction", ("solve", "friction")), ("all", ("solve",))):
            parts = [times for name, times in found.items() if name not in left]
            both = [100 * sum(map(f, parts)) / f(found["solve"]) for f in (min, median)]  # type: ignore[operator]
            print(f"{label:>20} {both[0]:46.1f} {both[1]:8.1f}")


if __name__ == "__main__":
    main()
