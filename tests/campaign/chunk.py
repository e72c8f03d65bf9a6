"""One chunk: its scenes solved in batches, each classified, checked and, if it fails, written down."""

from __future__ import annotations

import hashlib
import tempfile
import time
from collections import Counter, defaultdict
from collections.abc import Callable, Collection
from pathlib import Path
from typing import Any

import numpy as np

import qsbearing as qs
from tests.campaign.certificates import NONE, certify
from tests.campaign.checks import BALANCE, findings
from tests.campaign.envelope import GROUP, Group, chunk_groups

HUNG, RAISED = "hung", "raised"

Beat = Callable[[int, int], None]
"""Told which group, and which scene of it (-1: all at once), is about to be solved."""


class Tally:
    """What a chunk comes to; `summary` is a line of the campaign's journal."""

    def __init__(self, seed: int, chunk: int) -> None:
        self.seed, self.chunk = seed, chunk
        self.classes: Counter[str] = Counter()
        self.families: dict[str, Counter[str]] = defaultdict(Counter)
        self.reasons: dict[str, Counter[str]] = defaultdict(Counter)
        self.iterations: Counter[int] = Counter()
        self.iterations_without: Counter[int] = Counter()
        self.noted: Counter[str] = Counter()
        self.worst: dict[str, Any] = {"iterations": -1}
        self.largest = {"residual": 0.0, "imbalance": 0.0, "closure": 0.0, "hertz": 0.0}
        self.failures: list[dict[str, Any]] = []
        self._digest = hashlib.sha256()

    def name(self, index: int) -> str:
        """By which a scene is found again."""
        return f"{self.seed}/{self.chunk}/{index}"

    def count(self, group: Group, status: str) -> None:
        """One scene of this class."""
        self.classes[status] += 1
        self.families[group.family][status] += 1

    def fail(self, group: Group, k: int, index: int, what: str, status: str) -> None:
        """One scene that breaks a promise, as a file that reproduces it."""
        sentence = f"Campaign scene {self.name(index)}: {what} (status {status})."
        self.failures.append(
            {"index": index, "what": what, "status": status, "family": group.family, "toml": group.toml(k, sentence)}
        )

    def add(self, group: Group, first: int, solution: qs.Solution) -> None:
        """The scenes of a group, or of a part of it, that begin at this index of the chunk."""
        scene = solution.scene
        for array in (solution._codes, solution.iterations, solution.displacement, solution.load):
            self._digest.update(np.ascontiguousarray(array).tobytes())
        found = findings(scene, solution)
        failed, converged = found.failed(), solution.converged
        for k in range(group.size):
            index, status = first + k, str(solution.status[k])
            self.count(group, status)
            iterations = int(solution.iterations[k])
            if status == "converged":
                self.iterations[iterations] += 1
                broken = [name.replace("_", " ") for name, bad in failed.items() if bad[k]]
                if broken:
                    self.fail(group, k, index, f"converged, but fails its check of {', '.join(broken)}", status)
            else:
                self.iterations_without[iterations] += 1
                if status == "not_converged":
                    self.fail(group, k, index, "not converged", status)
            if iterations > self.worst["iterations"] and status == "converged":
                text = f"Campaign scene {self.name(index)}: {iterations} iterations, the most of its chunk."
                self.worst = {"iterations": iterations, "index": index, "toml": group.toml(k, text)}
        self.noted["friction above load"] += int((found.friction_above_load & converged).sum())
        self.noted["inconsistent control"] += int((found.control & converged).sum())
        excused = converged & (found.imbalance > BALANCE) & ~failed["imbalance"]
        self.noted["above 1e-10 by rounding alone"] += int(excused.sum())
        fine = converged & ~excused & ~np.any(list(failed.values()), axis=0)
        for name in self.largest:
            values = np.where(fine, solution.residual if name == "residual" else getattr(found, name), 0.0)
            self.largest[name] = max(self.largest[name], float(values.max(initial=0.0)))
        refused = np.flatnonzero(solution.status == "no_equilibrium")
        if refused.size:
            for k, certificate in zip(refused, certify(group, solution, refused), strict=True):
                reason = str(solution.reason[k]).replace("_", " ") or "unsaid"
                self.reasons[reason][certificate.kind] += 1
                if certificate.kind == NONE:
                    what = f"no equilibrium by reason of {reason}, but no certificate of it is found"
                    self.fail(group, int(k), first + int(k), what, "no_equilibrium")

    def summary(self, seconds: float) -> dict[str, Any]:
        """As plain data."""
        return {
            "chunk": self.chunk,
            "scenes": sum(self.classes.values()),
            "classes": dict(self.classes),
            "families": {family: dict(classes) for family, classes in sorted(self.families.items())},
            "reasons": {reason: dict(kinds) for reason, kinds in sorted(self.reasons.items())},
            "iterations": {str(key): value for key, value in sorted(self.iterations.items())},
            "iterations_without": {str(key): value for key, value in sorted(self.iterations_without.items())},
            "worst": self.worst,
            "largest": self.largest,
            "noted": dict(self.noted),
            "failures": self.failures,
            "digest": self._digest.hexdigest()[:16],
            "seconds": round(seconds, 3),
        }


def compile_detours() -> None:
    """Solve what the direct way cannot, a reversed thrust, so that what hard cases need is compiled or loaded."""
    bearing = qs.BallBearing(16, 22.225e-3, 125.26e-3, 11.6281e-3, 11.6281e-3, 0.7)
    qs.solve(qs.Scene(bearing, qs.Operation(axial_load=-1e3)))


def run_chunk(
    seed: int,
    chunk: int,
    count: int,
    *,
    isolated: Collection[int] = (),
    hung: Collection[int] = (),
    beat: Beat = lambda group, scene: None,
) -> dict[str, Any]:
    """Solve and judge the first `count` scenes of a chunk.

    Args:
        isolated: groups to solve scene by scene, because as a whole they do not come back.
        hung: scenes, by index, that do not come back; they are not solved again.
    """
    began = time.perf_counter()
    tally = Tally(seed, chunk)
    for number, group in enumerate(chunk_groups(seed, chunk, count)):
        first = GROUP * number
        if number not in isolated:
            beat(number, -1)
            try:
                tally.add(group, first, qs.solve(group.scene(), threads=1))
                continue
            except Exception:  # which of its scenes raises is found below
                pass
        for k in range(group.size):
            if first + k in hung:
                tally.count(group, HUNG)
                tally.fail(group, k, first + k, "the solver does not come back", HUNG)
                continue
            beat(number, k)
            one = group.part([k])
            try:
                tally.add(one, first + k, qs.solve(one.scene(), threads=1))
            except Exception as error:  # a campaign reports every scene, whatever it does
                tally.count(group, RAISED)
                tally.fail(group, k, first + k, f"raises {type(error).__name__}: {error}", RAISED)
    for failure in tally.failures:
        failure["reproduced"] = reproduces(failure)
    return tally.summary(time.perf_counter() - began)


def reproduces(failure: dict[str, Any]) -> bool | None:
    """Whether a failure's file, read back and solved alone, ends the same way; None where that cannot be tried."""
    if failure["status"] in (HUNG, RAISED):
        return None
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(failure["toml"], encoding="utf-8")
        return str(qs.solve(qs.load_scene(path), threads=1).status) == failure["status"]
