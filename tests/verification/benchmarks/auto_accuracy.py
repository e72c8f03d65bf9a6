"""Does `effects = "auto"` keep its word? `python -m tests.verification.benchmarks.auto_accuracy` measures it and keeps
the record.

Random operating points, which name no effect but the expansion of some, are solved to a tolerance and beside it with
all effects. Counted are
those whose every answer lies within the tolerance of the full one, those that leave something out, and the worst. With
a number, so many scenes are tried and nothing is kept; with a file, the record is kept there.
"""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

import qsbearing as qs
from qsbearing.model.solution.comparison import by_quantity
from qsbearing.results import provenance
from qsbearing.studies.chooser.choose import completed
from tests.verification.benchmarks import random_scenes

RECORD = Path(__file__).with_suffix(".json")
SCENES, SEED, TOLERANCE = 2000, 20_261, 0.01
LISTED = 10
"""Of the worst, so many are kept."""


@dataclass(frozen=True)
class Outcome:
    """One operating point: what was left out, and what that really changes."""

    seed: int
    number: int
    error: float
    quantity: str
    estimated: float
    left_out: tuple[str, ...]
    is_solved: bool
    """Whether the full model has a solution."""
    has_expansion: bool
    solves: int


def operating_point(rng: np.random.Generator, batch: qs.Scene, case: int) -> qs.Scene:
    """One case that names no effect but, for half of them, expansion: what needs fits and temperatures."""
    drawn = random_scenes.case(batch, case)
    if rng.random() < 0.5:
        return qs.Scene(drawn.bearing, drawn.operation)
    warm = {body: replace(getattr(drawn.bearing, body), thermal_expansion=12e-6) for body in BODIES}
    bearing = replace(drawn.bearing, **warm)
    try:
        return qs.Scene(bearing, drawn.operation, ring_effects=expansion(rng, bearing))
    except qs.SceneError:  # a fit that makes the ring yield, or leaves no bearing
        return qs.Scene(drawn.bearing, drawn.operation)


BODIES = ("ball_material", "ring_material")


def expansion(rng: np.random.Generator, bearing: qs.BallBearing) -> tuple[Any, ...]:
    """Rings half as thick again as their grooves are deep, loose to tight on their shaft, cool to hot."""
    bottoms = (
        bearing.inner_groove_centre_radius - np.asarray(bearing.inner_groove_radius),
        bearing.outer_groove_centre_radius + np.asarray(bearing.outer_groove_radius),
    )
    thickness = 0.25 * np.asarray(bearing.ball_diameter)
    bore, outside = 2.0 * float(bottoms[0] - thickness), 2.0 * float(bottoms[1] + thickness)
    inner, outer, balls = 293.15 + rng.uniform(-20.0, 80.0, 3) * (rng.random() < 0.5)
    fit = float(bore * rng.uniform(-0.2e-3, 0.5e-3)) if rng.random() < 0.7 else None
    rings = qs.RingExpansion(
        bore, outside, shaft_interference=fit, inner_ring_temperature=inner, outer_ring_temperature=outer
    )
    return (rings, qs.BallExpansion(balls)) if rng.random() < 0.5 else (rings,)


def outcomes(count: int = SCENES, seed: int = SEED, tolerance: float = TOLERANCE, size: int = 4) -> list[Outcome]:
    """So many operating points, each solved automatically and in full."""
    found = []
    rng = np.random.default_rng(seed + 1)
    for number, batch in enumerate(random_scenes.batches(seed, -(-count // size), size)):
        for case in range(size):
            scene = operating_point(rng, batch, case)
            chosen, full = qs.solve(scene, effects="auto", accuracy=tolerance), qs.solve(completed(scene))
            errors = {name: float(error) for name, error in by_quantity(chosen, full).items()}
            quantity = max(errors, key=lambda name: errors[name])
            choice = chosen.choice
            assert choice is not None
            estimated = float(sum(np.max(one.estimated_error) for one in choice.left_out))
            left_out = tuple(one.effect for one in choice.left_out)
            found.append(
                Outcome(
                    seed,
                    number * size + case,
                    errors[quantity],
                    quantity,
                    estimated,
                    left_out,
                    bool(full.converged),
                    bool(scene.ring_effects),
                    choice.solves,
                )
            )
    return found[:count]


def summary(found: list[Outcome], tolerance: float = TOLERANCE) -> dict[str, Any]:
    """What is kept of it."""
    error = np.array([one.error for one in found])
    names = sorted({name for one in found for name in one.left_out})
    worst = sorted(found, key=lambda one: -one.error)[:LISTED]
    return {
        "made_by": "python -m tests.verification.benchmarks.auto_accuracy",
        "version": qs.__version__,
        "provenance": provenance.of_run("python -m tests.verification.benchmarks.auto_accuracy"),
        "tolerance": tolerance,
        "scenes": len(found),
        "solved_in_full": sum(one.is_solved for one in found),
        "within_tolerance": int((error <= tolerance).sum()),
        "with_expansion": sum(one.has_expansion for one in found),
        "something_left_out": sum(bool(one.left_out) for one in found),
        "left_out": {name: sum(name in one.left_out for one in found) for name in names},
        "solved_once": sum(one.solves == 1 for one in found),
        "solves_mean": float(f"{np.mean([one.solves for one in found]):.3g}"),
        "worst": [vars(one) | {"left_out": list(one.left_out)} for one in worst],
    }


def main() -> None:
    """Try and print; keep the record of a whole trial."""
    asked = sys.argv[1] if sys.argv[1:] else str(RECORD)
    text = json.dumps(summary(outcomes(int(asked) if asked.isdecimal() else SCENES)), indent=1) + "\n"
    print(text, end="")
    if not asked.isdecimal():
        Path(asked).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
