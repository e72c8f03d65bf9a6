"""The tolerance ladder: what the solver's residual tolerance buys, in true error and in time, from three starts.

The truth is that of the 50-digit reference, packed in `truth.json`. The error is the worst of displacements (tilts
times dm/2, over the largest), contact loads (over the largest of the raceway) and contact angles (over the largest).
Newton's steps square the error, so tolerances between two steps give the very same answer, and the last digits are
rounding's.
"""

from __future__ import annotations

import json
import statistics
from dataclasses import replace
from functools import cache, partial
from importlib import resources
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.bearing import BallBearing
from qsbearing.cost import measuring
from qsbearing.cost.situations import many
from qsbearing.effects import CentrifugalForce, GyroscopicMoment
from qsbearing.material import Material
from qsbearing.operation import CHANNELS, Operation
from qsbearing.raceway_control import RacewayControl
from qsbearing.scene import HertzAngle, Scene
from qsbearing.solving import TOLERANCE, solve
from qsbearing.units import deg, rpm

if TYPE_CHECKING:
    from collections.abc import Callable

    from qsbearing.cost.settings import Settings
    from qsbearing.solution import Solution

    Progress = Callable[[str], None]

TOLERANCES = tuple(float(f"1e-{power}") for power in range(2, 15))
STARTS = {
    "cold": "from pure thrust at rest",
    "improved": "from the closed-form thrust balance at speed (the default)",
    "continuation": "from a solution at 2 % less load and speed",
}
NEIGHBOUR = 0.98


@cache
def truth() -> dict[str, Any]:
    """The reference's answers; `python -m tests.benchmarks.truth` packs them."""
    text = resources.files("qsbearing.cost").joinpath("truth.json").read_text(encoding="utf-8")
    return dict(json.loads(text))


def scene_of(entry: dict[str, Any]) -> Scene:
    """A scene of `truth.json`."""
    bearing: dict[str, Any] = {key: float(value) for key, value in entry["bearing"].items() if not key.endswith("_deg")}
    for name in ("ball_material", "ring_material"):
        numbers: dict[str, Any] = {key: float(value) for key, value in entry[name].items()}
        bearing[name] = Material(**numbers)
    return Scene(
        BallBearing(
            **bearing,
            free_contact_angle=float(entry["bearing"]["free_contact_angle_deg"]) * deg,
        ),
        Operation(
            speed=float(entry["speed_rpm"]) * rpm, **{key: float(value) for key, value in entry["operation"].items()}
        ),
        (CentrifugalForce(), GyroscopicMoment()),
        RacewayControl.OUTER,
        hertz_angle=HertzAngle(entry["hertz_angle"]),
    )


def starts(scene: Scene) -> dict[str, Solution | None]:
    """The three starts, for one case or many; None: the solver's own."""
    operation = scene.operation
    rest = replace(scene, operation=Operation(axial_load=operation.axial_load), ball_effects=(), raceway_control=None)
    loads = {channel.load: getattr(operation, channel.load) for channel in CHANNELS} | {"speed": operation.speed}
    less: dict[str, Any] = {
        name: NEIGHBOUR * np.asarray(value) if np.ndim(value) else NEIGHBOUR * value
        for name, value in loads.items()
        if value is not None
    }
    neighbour = replace(scene, operation=replace(operation, **less))
    return {"cold": solve(rest), "improved": None, "continuation": solve(neighbour)}


def error(solution: Solution, entry: dict[str, Any]) -> float:
    """The worst relative error against 50 digits."""
    lever = np.array([1.0, 1.0, 1.0, *[0.5 * float(entry["bearing"]["pitch_diameter"])] * 2])
    exact = np.array([float(value) for value in entry["displacement"]]) * lever
    worst = [np.abs(solution.displacement * lever - exact).max() / np.abs(exact).max()]
    for side, contacts in (("inner", solution.inner), ("outer", solution.outer)):
        for what, found in (("load", contacts.load), ("angle", contacts.angle)):
            exact = np.array([float(value) for value in entry[f"{side}_{what}"]])
            worst.append(np.abs(found - exact).max() / np.abs(exact).max())
    return float(max(worst))


def measure(settings: Settings, progress: Progress) -> list[dict[str, Any]]:
    """One entry a scene, with one a start, with one a tolerance."""
    progress("tolerances: errors")
    found = [_errors(entry) for entry in truth()["scenes"]]
    runs = []
    for turn in range(settings.processes):
        progress(f"tolerances: times, process {turn + 1} of {settings.processes}")
        runs += measuring.in_fresh_processes(times, settings.rounds, settings.batch, processes=1)
    seconds = measuring.pooled(runs)
    usual = "improved", TOLERANCE
    for scene in found:
        for start in scene["starts"]:
            for step in start["steps"]:
                for name in ("one_case", "batch_case"):
                    key = scene["name"], name, start["start"], step["tolerance"]
                    step[f"{name}_s"] = measuring.spread(seconds[key])
                    step[f"{name}_over_default"] = measuring.ratio(seconds, key, (*key[:2], *usual))
    return found


def _errors(entry: dict[str, Any]) -> dict[str, Any]:
    scene = scene_of(entry)
    listed = []
    for name, start in starts(scene).items():
        steps = []
        for tolerance in TOLERANCES:
            solution = solve(scene, start=start, tolerance=tolerance)
            steps.append(
                {
                    "tolerance": tolerance,
                    "converged": bool(solution.converged),
                    "residual": float(f"{solution.residual:.3g}"),
                    "iterations": int(solution.iterations),
                    "error": float(f"{error(solution, entry):.3g}"),
                }
            )
        listed.append({"start": name, "words": STARTS[name], "steps": steps})
    return {"name": entry["name"], "starts": listed}


def times(rounds: int, batch: int) -> measuring.Times:
    """Seconds a case of every solve, alone and in a batch around it, taken in turn."""
    tasks: dict[Any, Any] = {}
    for entry in truth()["scenes"]:
        one = scene_of(entry)
        for what, scene in (("one_case", one), ("batch_case", many(one, batch))):
            for name, start in starts(scene).items():
                for tolerance in TOLERANCES:
                    key = entry["name"], what, name, tolerance
                    tasks[key] = partial(solve, scene, start=start, tolerance=tolerance, threads=1)
    found = measuring.interleaved(tasks, rounds)
    return {key: [value / batch for value in row] if key[1] == "batch_case" else row for key, row in found.items()}


def summary(scenes: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Over all scenes, for each start and tolerance: the largest error, mean iterations, and medians of the times."""
    rows = []
    for place, start in enumerate(STARTS):
        for step, tolerance in enumerate(TOLERANCES):
            chosen = [scene["starts"][place]["steps"][step] for scene in scenes]
            row: dict[str, Any] = {
                "start": start,
                "tolerance": tolerance,
                "error": max(one["error"] for one in chosen),
                "iterations": statistics.mean(one["iterations"] for one in chosen),
            }
            for name in ("one_case_s", "batch_case_s", "one_case_over_default", "batch_case_over_default"):
                row[name] = {
                    part: statistics.median(one[name][part] for one in chosen) for part in ("median", "low", "high")
                }
            rows.append(row)
    return rows
