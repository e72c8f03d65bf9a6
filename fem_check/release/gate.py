"""The gate: runs the steps, keeps what they make, judges everything from what is kept."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from fem_check.agreement import Progress
from fem_check.records_store import RecordError
from fem_check.release import integrity, manifest, previous, tree
from fem_check.release.journal import Journal, path_of
from fem_check.release.previous import Previous
from fem_check.release.steps import Place, Step
from qsbearing.provenance import NOT_RECORDED


@dataclass(frozen=True)
class Verdict:
    """What a step came to."""

    step: str
    reasons: list[str]
    """Why it fails; empty where it passes."""
    said: str = ""
    """What there is to say where it passes."""
    command: str = ""
    """Which runs it alone."""

    @property
    def passes(self) -> bool:
        """Whether nothing speaks against it."""
        return not self.reasons

    def as_dict(self) -> dict[str, Any]:
        """As it is kept and printed."""
        return asdict(self) | {"passes": self.passes}


def expected(step: Step, place: Place, before: Previous) -> float | None:
    """Seconds that a step took in the previous release; None where that is not on record."""
    journal = before.read(path_of(Path(), place.level).as_posix())
    if journal and step.name in journal["steps"]:
        return float(journal["steps"][step.name]["seconds"])
    names = [name for pattern in step.records for name in before.names(pattern) or [pattern]]
    records = [before.read(name, step.in_repository) or {} for name in names]
    if not records or any("seconds" not in record for record in records):
        return None
    return sum(float(record["seconds"]) for record in records)


def run(steps: list[Step], journal: Journal, progress: Callable[[Step], Progress]) -> Iterator[tuple[Step, str | None]]:
    """Run what the journal lacks; yields each step with the error it ended with, once it is entered."""
    out = journal.place.out
    for step in steps:
        if step.name in journal.steps:
            continue
        for name in manifest.sums(out, step.records):  # no earlier record shall pass for this one
            (out / name).unlink()
        began, error = time.perf_counter(), None
        try:
            step.run(journal.place, progress(step))
        except Exception as problem:  # whatever it is: the step has failed, and the others are still to be run
            error = f"{type(problem).__name__}: {problem}"
        journal.keep(step, time.perf_counter() - began, error)
        yield step, error


def verdicts(steps: list[Step], journal: Journal, before: Previous) -> list[Verdict]:
    """All verdicts, from the records as they stand now."""
    place = journal.place
    found = [clean_tree(place), previous_release(steps, place, before)]
    found += [judged(step, journal, before) for step in steps]
    return [*found, Verdict("records", journal.problems(), "as their steps made them", "fem-check release")]


def clean_tree(place: Place) -> Verdict:
    """That the tree is its commit, and still the commit that the gate began with."""
    reasons = [f"dirty tree: {name} is not committed" for name in tree.changes(place.root)]
    now = tree.head(place.root)
    if now != place.commit:
        reasons.append(f"commit {now[:12]} is checked out, the gate began with {place.commit[:12]}")
    return Verdict("clean tree", reasons, f"commit {place.commit[:12]}", "git status")


def previous_release(steps: list[Step], place: Place, before: Previous) -> Verdict:
    """That the previous release's records are as they were kept, and that each is made again."""
    reasons = list(before.problems)
    made = {name for step in steps for pattern in step.records for name in (*before.names(pattern), pattern)}
    kept = [*before.names(f"{place.level}/*.json"), *before.names("book/*.json")]
    reasons += [f"{name} is on record, and no step makes it any more" for name in kept if name not in made]
    origins = [(before.read(name) or {}).get("provenance") for name in kept]
    commits = {str(made["commit"])[:12] for made in origins if made}
    said = f"{before.label}, as they were kept"
    if commits:
        said += f"; made from {', '.join(sorted(commits))}"
    if None in origins:
        said += f"; {origins.count(None)} of {len(kept)} do not say from what ({NOT_RECORDED}): values only"
    return Verdict("previous release", reasons, said, "git log -- fem_check/records")


def judged(step: Step, journal: Journal, before: Previous) -> Verdict:
    """A step's verdict, from its records, the previous release's, and the journal."""
    place, done = journal.place, journal.steps.get(step.name)
    if done is None:
        return Verdict(step.name, ["it was not run"], command=step.command)
    if done.error:
        return Verdict(step.name, [done.error], command=step.command)
    reasons, compared = [], 0
    for name in sorted({*done.records, *(name for pattern in step.records for name in before.names(pattern))}):
        if name not in done.records:
            reasons.append(f"{name} of the previous release is not made any more")
            continue
        try:
            record = previous.read(place.out / name)
            old = before.read(name, step.in_repository)
            compared += old is not None
            problems = integrity.of_provenance(record, place.commit) + step.wrong(record)
            problems += step.moved(record, old) if old else []
        except (RecordError, LookupError, TypeError, ValueError) as problem:
            problems = [f"it cannot be judged: {type(problem).__name__}: {problem}"]
        reasons += [f"{name}: {each}" for each in problems]
    if step.records and not done.records:
        reasons.append(f"it left no record {' or '.join(step.records)}")
    said = f"{done.seconds:.0f} s"
    if step.records:
        said += "; " if compared == len(done.records) else f"; {compared} of {len(done.records)} "
        said += "compared with the previous release"
    return Verdict(step.name, reasons, said, step.command)
