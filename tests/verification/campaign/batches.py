"""Random cases in batches, each of a generator of its own, counted and kept: campaigns of rings, sets and spindles."""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.results import provenance


@dataclass
class Batch:
    """What became of the cases of one batch."""

    ended: Counter[str] = field(default_factory=Counter)
    """How many ended how: "converged", "no equilibrium: reason", "not converged", "refused: reason"."""
    wrong: dict[int, str] = field(default_factory=dict)
    """Converged cases that break a promise, by number."""
    not_converged: list[int] = field(default_factory=list)
    largest: dict[str, float] = field(default_factory=dict)
    """The largest of each error, over converged cases."""


def of_sets(solution: qs.SetSolution, wrong: dict[str, NDArray]) -> Batch:
    """What became of sets of rows, with the cases that break each promise."""
    ended = zip(solution.status, solution.reason, strict=True)
    found = Batch(Counter(f"{status}: {reason}".removesuffix(": ") for status, reason in ended))
    for name, bad in wrong.items():
        found.wrong |= {int(k): name for k in np.flatnonzero(bad)}
    found.not_converged = [int(k) for k in np.flatnonzero(solution.status == "not_converged")]
    found.largest["residual"] = float(np.max(solution.residual, where=solution.converged, initial=0.0))
    return found


def run(name: str, draw: Callable[[np.random.Generator], Batch], size: int, description: str | None) -> None:
    """The command of a campaign: COUNT cases of a SEED, batch by batch; exit code 1 if some are wrong."""
    parser = argparse.ArgumentParser(prog=f"python -m tests.verification.campaign.{name}", description=description)
    parser.add_argument("count", type=int)
    parser.add_argument("seed", type=int, nargs="?", default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first batch")
    parser.add_argument("--out", type=Path, help="file for the summary")
    parser.add_argument("--minutes", type=float, default=float("inf"), help="end after so long, whatever the count")
    asked = parser.parse_args()
    began, cpu = time.perf_counter(), time.process_time()
    ended, largest = Counter[str](), dict[str, float]()
    listed: dict[str, list[str]] = {"wrong": [], "not_converged": []}
    for number in range(asked.first, asked.first + max(asked.count // size, 1)):
        if time.perf_counter() - began > 60.0 * asked.minutes:
            break
        with np.errstate(all="ignore"):
            found = draw(np.random.default_rng([asked.seed, number]))
        ended.update(found.ended)
        listed["wrong"] += [f"{number}/{k}: {what}" for k, what in found.wrong.items()]
        listed["not_converged"] += [f"{number}/{k}" for k in found.not_converged]
        for error, value in found.largest.items():
            largest[error] = max(largest.get(error, 0.0), value)
        for what in found.wrong.values():
            print(f"WRONG {number}: {what}", flush=True)
        if number % 20 == 0:
            print(number, sum(ended.values()), f"{time.perf_counter() - began:.0f} s", dict(ended), flush=True)
    summary: dict[str, Any] = {
        "campaign": name,
        "seed": asked.seed,
        "count": sum(ended.values()),
        "batch": size,
        "first_batch": asked.first,
        "ended": dict(sorted(ended.items())),
        "wrong": listed["wrong"],
        "not_converged": listed["not_converged"],
        "largest": {error: float(f"{value:.3g}") for error, value in largest.items()},
        "processor_seconds": round(time.process_time() - cpu, 1),
        "provenance": provenance.of_run(f"python -m tests.verification.campaign.{name} {asked.count} {asked.seed}"),
    }
    text = json.dumps(summary, indent=1) + "\n"
    print(text, end="")
    if asked.out:
        asked.out.write_text(text, encoding="utf-8")
    sys.exit(1 if listed["wrong"] else 0)
