"""A range of scenes: solved in batches, each scene classified and checked, and named if it breaks a promise."""

from __future__ import annotations

import hashlib
import time
from collections import Counter, defaultdict
from collections.abc import Iterator
from typing import Any

import numpy as np

import qsbearing as qs
from tests.verification.campaign.certificates import NONE, NOT_PROVED, Certificate, certify
from tests.verification.campaign.checks import MOST_IMBALANCE, Findings, findings
from tests.verification.campaign.envelope import CHUNK, chunk_groups
from tests.verification.campaign.group import GROUP, Group
from tests.verification.campaign.invariances import SIZES, TWINS, compare, scaled

HUNG, RAISED = "hung", "raised"
"""Classes of scenes that the solver gives no status."""

UNCONVERGED = "not_converged"

MOST_DIFFERENCE = 1e-6
"""Of a twin's loads, angles and displacement: far above what conditions make of rounding (99 % of scenes: 1e-11), far
below what a length of a few nanometres makes."""

Judged = tuple[qs.Solution, Findings, dict[int, Certificate]]


class Tally:
    """What scenes come to; `line` is a line of the campaign's journal."""

    def __init__(self) -> None:
        self.classes: Counter[str] = Counter()
        self.noted: Counter[str] = Counter()
        self.families: defaultdict[str, Counter[str]] = defaultdict(Counter)
        self.reasons: defaultdict[str, Counter[str]] = defaultdict(Counter)
        self.iterations: defaultdict[str, Counter[int]] = defaultdict(Counter)
        self.most_iterations = (-1, -1)
        self.largest = {"residual": 0.0, "imbalance": 0.0, "closure": 0.0, "hertz": 0.0}
        self.listed: list[dict[str, Any]] = []
        self.digest = hashlib.sha256()

    def count(self, group: Group, number: int, status: str, what: str = "") -> None:
        """One scene of this class; listed if there is something to say of it."""
        self.classes[status] += 1
        self.families[group.family][status] += 1
        if what:
            self.listed.append({"scene": number, "what": what, "status": status, "family": group.family})

    def add(self, group: Group, first: int, judged: Judged, of_twins: dict[int, str]) -> None:
        """The scenes of a group, or of a part of it, of which the first has this number, and what their twins show."""
        solution, found, certificates = judged
        for array in (solution.codes, solution.iterations, solution.displacement, solution.load):
            self.digest.update(np.ascontiguousarray(array).tobytes())
        failed, converged = found.failed(), solution.converged
        for k, status in enumerate(map(str, solution.status)):
            what = of_twins.get(k, "")
            if status == qs.Status.CONVERGED:
                broken = [name.replace("_", " ") for name, bad in failed.items() if bad[k]]
                what = f"converged, but fails its check of {', '.join(broken)}" if broken else what
                self.most_iterations = max(self.most_iterations, (int(solution.iterations[k]), first + k))
            elif status == UNCONVERGED:
                what = "not converged"
            else:
                reason = str(solution.reason[k]).replace("_", " ") or "unsaid"
                self.reasons[reason][certificates[k].kind] += 1
                if certificates[k].kind == NONE:
                    what = f"no equilibrium by reason of {reason}, but no certificate of it is found"
            self.iterations["converged" if converged[k] else "rest"][int(solution.iterations[k])] += 1
            self.count(group, first + k, status, what)
        by_rounding = converged & (found.imbalance > MOST_IMBALANCE) & ~failed["imbalance"]
        self.noted["friction above load"] += int((found.friction_above_load & converged).sum())
        self.noted["inconsistent control"] += int((found.control & converged).sum())
        self.noted["held up by the gyroscopic moment"] += int((found.held_up & converged).sum())
        self.noted["above 1e-10 by rounding alone"] += int(by_rounding.sum())
        fine = converged & ~by_rounding & ~np.any(list(failed.values()), axis=0)
        for name in self.largest:
            values = np.where(fine, solution.residual if name == "residual" else getattr(found, name), 0.0)
            self.largest[name] = max(self.largest[name], float(values.max(initial=0.0)))

    def line(self, first: int, stop: int, seconds: float) -> dict[str, Any]:
        """As plain data."""
        return {
            "first": first,
            "stop": stop,
            "classes": self.classes,
            "noted": self.noted,
            "families": self.families,
            "reasons": self.reasons,
            "iterations": {which: {str(n): k for n, k in table.items()} for which, table in self.iterations.items()},
            "most_iterations": list(self.most_iterations),
            "largest": self.largest,
            "listed": self.listed,
            "digest": self.digest.hexdigest()[:16],
            "seconds": round(seconds, 3),
        }


def compile_kernel() -> None:
    """Compile or load the kernel, with the fallback for hard cases: a reversed thrust, which nothing supports."""
    bearing = qs.BallBearing(16, 22.225e-3, 125.26e-3, 11.6281e-3, 11.6281e-3, 0.7)
    effects = (qs.CentrifugalForce(), qs.GyroscopicMoment())
    qs.solve(qs.Scene(bearing, qs.Operation(speed=100.0, axial_load=-1e3), effects, qs.RacewayControl.OUTER))
    solve_range("wild", 0, 0, 1)


def solve_range(envelope: str, seed: int, first: int, stop: int) -> dict[str, Any]:
    """Solve and judge the scenes of these numbers, all of one chunk; a line of the journal."""
    began = time.process_time()
    tally = Tally()
    with np.errstate(all="ignore"):  # what is not a number is found by the checks
        for number, group in groups_of(envelope, seed, first, stop):
            judge_group(tally, number, group)
    return tally.line(first, stop, time.process_time() - began)


def groups_of(envelope: str, seed: int, first: int, stop: int) -> Iterator[tuple[int, Group]]:
    """(number of the first scene, group) of a range within one chunk; groups cut where the range is."""
    chunk = first // CHUNK
    for number, group in enumerate(chunk_groups(seed, chunk, stop - CHUNK * chunk, envelope)):
        begin = CHUNK * chunk + GROUP * number
        skipped = max(0, first - begin)
        if skipped < group.size:
            yield begin + skipped, group.part(slice(skipped, None)) if skipped else group


def judge_group(tally: Tally, number: int, group: Group) -> None:
    """Solve a group at once, or if that raises, scene by scene: a campaign reports every scene, whatever it does."""
    try:
        judged = judge(group)
    except Exception as error:
        if group.size == 1:
            tally.count(group, number, RAISED, f"raises {type(error).__name__}: {error}")
            return
        for k in range(group.size):
            judge_group(tally, number + k, group.part([k]))
        return
    differs = judge_twin(tally, number, group, judged[0]) if group.more else {}
    tally.add(group, number, judged, differs)


def judge_twin(tally: Tally, number: int, group: Group, solution: qs.Solution) -> dict[int, str]:
    """What is wrong with one of a group's twins, by its scenes; which twin is told by the group's number.

    A twin that satisfies its own equations and still differs has found another equilibrium of the same ones, which is
    noted; but where heat makes the twin its equations may be others, so that one counts as such only if a cold bearing
    of some other size has several equilibria, too.
    """
    name = list(TWINS)[number // GROUP % len(TWINS)]
    twin = TWINS[name](group)
    if twin is None:
        return {}
    of = solution if twin.of is group else qs.solve(twin.of.scene(), threads=1)
    scene = twin.group.scene()
    other = qs.solve(scene, threads=1)
    compared = compare(twin, of, other)
    differs = compared.difference > MOST_DIFFERENCE
    wrong = {}
    for check, bad in findings(scene, other).failed().items():
        wrong |= {
            int(k): f"converged, but {name} fails its check of {check}" for k in np.flatnonzero(bad & other.converged)
        }
    if name == "warmed" and differs.any():
        again = [(each, scene) for each in (scaled(twin.of, size) for size in SIZES) if (scene := allowed(each.group))]
        apart = [compare(each, of, qs.solve(scene, threads=1)).difference for each, scene in again]
        is_ambiguous = np.max(apart, axis=0) > MOST_DIFFERENCE
        wrong |= {int(k): "converged, but differs as warm all through" for k in np.flatnonzero(differs & ~is_ambiguous)}
        differs &= is_ambiguous
    tally.noted["twins"] += int(compared.both.sum())
    tally.noted["twin with another equilibrium"] += int(differs.sum())
    tally.noted["twin alone solved or alone not"] += int(compared.either.sum())
    return wrong


def allowed(group: Group) -> qs.Scene | None:
    """The scene of a larger or smaller twin; None where some length is beyond those that may be given."""
    try:
        return group.scene()
    except qs.SceneError:
        return None


def judge(group: Group) -> Judged:
    """The solution of a group, what the checks find, and the certificates of its refusals."""
    scene = group.scene()
    solution = qs.solve(scene, threads=1)
    refused = np.flatnonzero(solution.status == qs.Status.NO_EQUILIBRIUM)
    certificates: list[Certificate] = []
    if refused.size:
        certificates = certify(group, solution, refused)
        if group.more:
            certificates = [Certificate(NOT_PROVED) if each.kind == NONE else each for each in certificates]
    return solution, findings(scene, solution), dict(zip(map(int, refused), certificates, strict=True))


def not_returned(envelope: str, seed: int, number: int, seconds: float) -> dict[str, Any]:
    """The line of a single scene that the solver does not come back from."""
    tally = Tally()
    [(_, group)] = groups_of(envelope, seed, number, number + 1)
    tally.count(group, number, HUNG, "the solver does not come back")
    return tally.line(number, number + 1, seconds)
