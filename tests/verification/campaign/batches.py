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
from tests.verification.campaign.certificates import NOT_PROVED, by_strength
from tests.verification.campaign.envelope import ENVELOPES, allowed_of


@dataclass
class Batch:
    """What became of the cases of one batch."""

    ended: Counter[str] = field(default_factory=Counter)
    """How many ended how: "converged", "no equilibrium: reason", "not converged", "refused: reason"."""
    wrong: dict[int, str] = field(default_factory=dict)
    """Converged cases that break a promise, by number."""
    not_converged: list[int] = field(default_factory=list)
    refusals: Counter[str] = field(default_factory=Counter)
    """How many of those without an equilibrium have which certificate, or none: "not proved"."""
    largest: dict[str, float] = field(default_factory=dict)
    """The largest of each error, over converged cases."""


def of_sets(solution: qs.SetSolution, wrong: dict[str, NDArray], is_proved: Callable[[int], bool]) -> Batch:
    """What became of sets of rows, with the cases that break each promise.

    Args:
        is_proved: of a refused case: whether a direction proves that it has no equilibrium. Evidence is not at hand: a
            set is refused where one of its rows is, on the way.
    """
    ended = zip(solution.status, solution.reason, strict=True)
    found = Batch(Counter(f"{status}: {reason}".removesuffix(": ") for status, reason in ended))
    for name, bad in wrong.items():
        found.wrong |= {int(k): name for k in np.flatnonzero(bad)}
    found.not_converged = [int(k) for k in np.flatnonzero(solution.status == "not_converged")]
    refused = np.flatnonzero(solution.status == "no_equilibrium")
    found.refusals = Counter("unsupported direction" if is_proved(int(k)) else NOT_PROVED for k in refused)
    found.largest["residual"] = float(np.max(solution.residual, where=solution.converged, initial=0.0))
    return found


@dataclass(frozen=True)
class Limit:
    """How many cases of a campaign may end as not converged, beside those whose reason is known and counted apart."""

    share: float
    basis: str
    """When it was set, and from what."""

    def of(self, count: int, lost: int) -> dict[str, Any]:
        """Held against what was found."""
        allowed = allowed_of(count, self.share)
        return {"not_converged": lost, "allowed": allowed, "share": self.share, "basis": self.basis}


def per_row(rows: float = 1.0) -> Limit:
    """The limit of cases with so many bearings on average, set after the first runs."""
    # As many as of mounted scenes, the limit that stands in the guide; a set has as many chances as rows.
    by_rows = f" × {rows:g} rows" if rows > 1.0 else ""
    return Limit(ENVELOPES["mounted"].rate * rows, f"2026-11-28: mounted{by_rows}")


def run(
    name: str, draw: Callable[[np.random.Generator], Batch], size: int, limit: Limit, description: str | None
) -> None:
    """The command of a campaign: COUNT cases of a SEED, batch by batch; exit code 1 if some are wrong, or more than
    allowed did not converge."""
    parser = argparse.ArgumentParser(prog=f"python -m tests.verification.campaign.{name}", description=description)
    parser.add_argument("count", type=int)
    parser.add_argument("seed", type=int, nargs="?", default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first batch")
    parser.add_argument("--out", type=Path, help="file for the summary")
    parser.add_argument("--minutes", type=float, default=float("inf"), help="end after so long, whatever the count")
    asked = parser.parse_args()
    began, cpu = time.perf_counter(), time.process_time()
    ended, refusals, largest = Counter[str](), Counter[str](), dict[str, float]()
    listed: dict[str, list[str]] = {"wrong": [], "not_converged": []}
    for number in range(asked.first, asked.first + max(asked.count // size, 1)):
        if time.perf_counter() - began > 60.0 * asked.minutes:
            break
        with np.errstate(all="ignore"):
            found = draw(np.random.default_rng([asked.seed, number]))
        ended.update(found.ended)
        refusals.update(found.refusals)
        listed["wrong"] += [f"{number}/{k}: {what}" for k, what in found.wrong.items()]
        listed["not_converged"] += [f"{number}/{k}" for k in found.not_converged]
        for error, value in found.largest.items():
            largest[error] = max(largest.get(error, 0.0), value)
        for what in found.wrong.values():
            print(f"WRONG {number}: {what}", flush=True)
        if number % 20 == 0:
            print(number, sum(ended.values()), f"{time.perf_counter() - began:.0f} s", dict(ended), flush=True)
    bar = limit.of(sum(ended.values()), len(listed["not_converged"]))
    summary: dict[str, Any] = {
        "campaign": name,
        "seed": asked.seed,
        "count": sum(ended.values()),
        "batch": size,
        "first_batch": asked.first,
        "ended": dict(sorted(ended.items())),
        "bar": bar,
        "no_equilibrium": by_strength(dict(refusals.most_common())),
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
    sys.exit(1 if listed["wrong"] or bar["not_converged"] > bar["allowed"] else 0)
