"""Does `effects = "auto"` keep its word? `python -m tests.benchmarks.auto_accuracy` measures it and keeps the record.

Random operating points, which name no effect, are solved to a tolerance and beside it with all effects. Counted are
those whose every answer lies within the tolerance of the full one, those that leave something out, and the worst. With
a number, so many scenes are tried and nothing is kept.
"""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import qsbearing as qs
from qsbearing.chooser.choose import completed
from qsbearing.chooser.comparison import by_quantity
from tests.benchmarks import random_scenes

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
    solves: int


def operating_point(batch: qs.Scene, case: int) -> qs.Scene:
    """One case without effects and choices."""
    return qs.Scene(*(getattr(random_scenes.case(batch, case), name) for name in ("bearing", "operation")))


def outcomes(count: int = SCENES, seed: int = SEED, tolerance: float = TOLERANCE, size: int = 4) -> list[Outcome]:
    """So many operating points, each solved automatically and in full."""
    found = []
    for number, batch in enumerate(random_scenes.batches(seed, -(-count // size), size)):
        for case in range(size):
            scene = operating_point(batch, case)
            chosen, full = qs.solve(scene, effects="auto", tolerance=tolerance), qs.solve(completed(scene))
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
        "made_by": "python -m tests.benchmarks.auto_accuracy",
        "version": qs.__version__,
        "tolerance": tolerance,
        "scenes": len(found),
        "solved_in_full": sum(one.is_solved for one in found),
        "within_tolerance": int((error <= tolerance).sum()),
        "something_left_out": sum(bool(one.left_out) for one in found),
        "left_out": {name: sum(name in one.left_out for one in found) for name in names},
        "solved_once": sum(one.solves == 1 for one in found),
        "solves_mean": float(f"{np.mean([one.solves for one in found]):.3g}"),
        "worst": [vars(one) | {"left_out": list(one.left_out)} for one in worst],
    }


def main() -> None:
    """Try and print; keep the record of a whole trial."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else SCENES
    text = json.dumps(summary(outcomes(count)), indent=1) + "\n"
    print(text, end="")
    if count == SCENES:
        RECORD.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
