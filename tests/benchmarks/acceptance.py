"""Does `run --accuracy` keep its word? Random scenes that its table was not built from, each asked for one accuracy.

`python -m tests.benchmarks.acceptance` prints what `tests.benchmarks.advice` keeps in the table: how many stay within
what was asked of them, and how the times compare with those expected.
"""

from __future__ import annotations

import itertools
import json
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.studies.cost import accuracy, results
from tests.benchmarks import random_scenes

SEED = 77
SCENES = 500
ASKED = (1e-5, 1e-1)
"""The range from which the accuracy asked for is drawn, evenly in its logarithm; every second scene asks for 1e-3."""


ROUNDS = 3
"""How often all scenes are gone through: each scene's time is the median, since one solve of a tenth of a millisecond
also measures whatever else the machine does just then."""


@dataclass(frozen=True)
class Outcome:
    """One scene asked for one accuracy."""

    asked: float
    error: float
    is_simplified: bool
    solves: int
    times_over_expected: tuple[float, ...]
    """Of each round."""

    @property
    def is_met(self) -> bool:
        """Whether the error stays within what was asked."""
        return self.error <= self.asked


def requests(count: int, seed: int) -> Iterator[tuple[qs.Scene, float]]:
    """So many scenes and the accuracy asked of each."""
    rng = np.random.default_rng(seed)
    scenes = (
        random_scenes.case(batch, k) for batch in random_scenes.batches(seed, -(-count // 4), 4) for k in range(4)
    )
    for k, scene in enumerate(itertools.islice(scenes, count)):
        yield scene, 1e-3 if k % 2 else float(np.exp(rng.uniform(*np.log(ASKED))))


def outcomes(count: int = SCENES, seed: int = SEED, rounds: int = ROUNDS) -> list[Outcome]:
    """So many scenes, each solved at the level chosen, its time included, once a round, and once in full."""
    asked = list(requests(count, seed))
    taken = [[choose_and_solve(*request) for request in asked] for _ in range(rounds)]
    found = []
    for (scene, accuracy_asked), *turns in zip(asked, *taken, strict=True):
        reached, full, error = turns[0], qs.solve(scene), 0.0
        if full.converged:
            judged = results.errors(results.read(reached.solution), results.read(full))
            error = float(results.accuracy(judged))
        over = tuple(turn.seconds / turn.choice.option.seconds for turn in turns)
        found.append(Outcome(accuracy_asked, error, bool(reached.option.left_out), reached.solves, over))
    return found


def choose_and_solve(scene: qs.Scene, asked: float) -> accuracy.Reached:
    """As `run --accuracy` does it: the time is foretold from how fast the machine is just then."""
    return accuracy.solve_to(accuracy.choose(scene, asked))


def summary(found: list[Outcome]) -> dict[str, Any]:
    """What is kept of it."""
    times = np.array([one.times_over_expected for one in found])
    typical = np.median(times, axis=1)
    return {
        "scenes": len(found),
        "met": sum(one.is_met for one in found),
        "simplified": sum(one.is_simplified for one in found),
        "solved_twice_or_more": sum(one.solves > 1 for one in found),
        "rounds": times.shape[1],
        "time_within_factor_2": within_factor_2(typical),
        "time_within_factor_2_by_round": [within_factor_2(times[:, turn]) for turn in range(times.shape[1])],
        "time_over_expected": {
            name: float(f"{np.quantile(typical, part):.3g}")
            for name, part in (("median", 0.5), ("low", 0.05), ("high", 0.95))
        },
    }


def within_factor_2(times_over_expected: NDArray) -> int:
    """How many of the times lie within a factor 2 of what was expected."""
    return int(((times_over_expected > 0.5) & (times_over_expected < 2.0)).sum())


if __name__ == "__main__":
    print(json.dumps(summary(outcomes()), indent=1))
