"""Does `run --accuracy` keep its word? Random scenes that its table was not built from, each asked for one accuracy.

`python -m tests.benchmarks.acceptance` prints what `tests.benchmarks.cost` keeps in the table: how many stay within
what was asked of them, and how the times compare with those expected.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

import numpy as np

import qsbearing as qs
from qsbearing.cost import accuracy, answers
from tests.benchmarks import random_scenes

SEED = 77
SCENES = 500
ASKED = (1e-5, 1e-1)
"""The range from which the accuracy asked for is drawn, evenly in its logarithm; every second scene asks for 1e-3."""


@dataclass(frozen=True)
class Outcome:
    """One scene asked for one accuracy."""

    asked: float
    error: float
    is_simplified: bool
    solves: int
    time_over_expected: float

    @property
    def is_met(self) -> bool:
        """Whether the error stays within what was asked."""
        return self.error <= self.asked


def outcomes(count: int = SCENES, seed: int = SEED) -> list[Outcome]:
    """So many scenes, each solved once at the fidelity chosen, its time included, and once in full."""
    rng = np.random.default_rng(seed)
    found = []
    for scene in random_scenes.batches(seed, -(-count // 4), 4):
        for k in range(4):
            one = random_scenes.case(scene, k)
            asked = 1e-3 if k % 2 else float(np.exp(rng.uniform(*np.log(ASKED))))
            choice = accuracy.choose(one, asked)
            reached = accuracy.solve_to(choice)
            full = qs.solve(one)
            error = 0.0
            if full.converged:
                judged = answers.errors(answers.read(reached.way.scene, reached.solution), answers.read(one, full))
                error = float(answers.accuracy(judged))
            over = reached.seconds / choice.way.seconds
            found.append(Outcome(asked, error, bool(reached.way.left_out), reached.solves, over))
    return found[:count]


def summary(found: list[Outcome]) -> dict[str, Any]:
    """What is kept of it."""
    times = np.array([one.time_over_expected for one in found])
    return {
        "scenes": len(found),
        "met": sum(one.is_met for one in found),
        "simplified": sum(one.is_simplified for one in found),
        "solved_twice_or_more": sum(one.solves > 1 for one in found),
        "time_within_factor_2": int(((times > 0.5) & (times < 2.0)).sum()),
        "time_over_expected": {
            name: float(f"{np.quantile(times, part):.3g}")
            for name, part in (("median", 0.5), ("low", 0.05), ("high", 0.95))
        },
    }


if __name__ == "__main__":
    print(json.dumps(summary(outcomes()), indent=1))
