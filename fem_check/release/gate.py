"""The gate: runs the steps, enters them in a journal, judges everything from the records that are there."""

from __future__ import annotations

import json
import multiprocessing
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import asdict, dataclass
from math import inf
from pathlib import Path
from typing import Any, TypedDict

from fem_check.release import integrity, manifest, previous, tree
from fem_check.release.previous import Previous
from fem_check.release.steps import GateFolders, Step, write_tables
from fem_check.rows.agreement import MeshLevel
from fem_check.running import kept_files, records_store
from fem_check.running.records_store import RecordError
from qsbearing.results import provenance


class StepRun(TypedDict):
    """A step that was run."""

    seconds: float
    error: str | None
    """With which it ended; None where it ended well."""


Journal = dict[str, StepRun]


@dataclass(frozen=True)
class StepVerdict:
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
        """As it is printed."""
        return asdict(self) | {"passes": self.passes}


def resumed(place: GateFolders, steps: list[Step]) -> Journal:
    """What an interrupted gate of the same commit has done, but for steps that ended with an error."""
    try:
        kept = json.loads((place.gate / "steps.json").read_text(encoding="utf-8"))
        if (kept["commit"], kept["level"]) != (place.commit, place.level):
            return {}
        done = {step.name: kept["steps"][step.name] for step in steps if step.name in kept["steps"]}
        return {name: entry for name, entry in done.items() if entry["error"] is None}
    except (OSError, ValueError, KeyError, TypeError):  # none, cut off or damaged
        return {}


def run(
    steps: list[Step], place: GateFolders, journal: Journal, ended: Callable[[str], None], workers: int = 1
) -> None:
    """Run what the journal lacks, and enter it there; `ended` is told how each step ended.

    Args:
        workers: how many processes share the steps that need one core; the others follow, one after another. Before
            all of them come the steps that are first.
    """
    waiting = [step for step in steps if step.name not in journal]
    for step in waiting:
        for name in step.made(place.out):  # no earlier record shall pass for this one
            (place.out / name).unlink()
    for step in (each for each in waiting if each.is_first):
        _end(step, _run(step, place), place, journal, ended)
    waiting = [step for step in waiting if not step.is_first]
    shared = [step for step in waiting if workers > 1 and not step.is_alone]
    for step, entry in _side_by_side(shared, place, workers):
        _end(step, entry, place, journal, ended)
    for step in waiting:
        if step not in shared:
            _end(step, _run(step, place), place, journal, ended)


def seconds_before(place: GateFolders) -> dict[str, float]:
    """That each step took in the previous gate; none where its journal is not on record, or damaged."""
    if place.previous is None:
        return {}
    try:
        journal = json.loads((place.previous / "gate" / place.level / "steps.json").read_text(encoding="utf-8"))
        return {name: float(done["seconds"]) for name, done in journal["steps"].items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return {}


def _end(step: Step, entry: StepRun, place: GateFolders, journal: Journal, ended: Callable[[str], None]) -> None:
    journal[step.name] = entry
    _enter(place, journal)
    ended(f"{step.name}: {entry['error'] or 'done'}")


def _run(step: Step, place: GateFolders) -> StepRun:
    began, error = time.perf_counter(), None
    try:
        step.run(place)
    except Exception as problem:  # whatever it is: the step has failed, and the others are still to be run
        error = f"{type(problem).__name__}: {problem}"
    return {"seconds": round(time.perf_counter() - began, 1), "error": error}


_shared: list[Step] = []
"""Of `_side_by_side`: processes that are forked find it, since a step cannot be sent to them."""


def _run_shared(number: int, place: GateFolders) -> StepRun:
    return _run(_shared[number], place)


def _side_by_side(steps: list[Step], place: GateFolders, workers: int) -> Iterator[tuple[Step, StepRun]]:
    """Run steps in processes, the longest of the gate before first, and hand out each as it ends: else all cores but
    one wait at the end for a long one. Steps that it did not have may be long."""
    before = seconds_before(place)
    _shared[:] = sorted(steps, key=lambda step: -before.get(step.name, inf))
    pool = ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("fork"))
    try:
        submitted = {pool.submit(_run_shared, number, place): step for number, step in enumerate(_shared)}
        for each in as_completed(submitted):
            try:
                entry = each.result()
            except BrokenProcessPool as problem:  # a process was killed, for want of memory as a rule
                entry = {"seconds": 0.0, "error": f"{type(problem).__name__}: {problem}"}
            yield submitted[each], entry
    finally:
        pool.shutdown(cancel_futures=True)


def _enter(place: GateFolders, journal: Journal, verdicts: Iterable[StepVerdict] = ()) -> None:
    """Write the journal; once all is judged, with the verdicts, by which a report knows a release."""
    made = provenance.of_run(f"fem-check release --level {place.level}", str(place.level))
    content: dict[str, Any] = {"commit": place.commit, "level": str(place.level), "provenance": made, "steps": journal}
    content |= {"verdicts": {each.step: each.reasons for each in verdicts}} if verdicts else {}
    place.gate.mkdir(parents=True, exist_ok=True)
    records_store.replace(place.gate / "steps.json", (json.dumps(content, indent=1) + "\n").encode())


def all_judged(steps: list[Step], place: GateFolders, journal: Journal, before: Previous) -> list[StepVerdict]:
    """The verdicts of a gate that has run, of what holds before all too; they are entered beside the journal."""
    verdicts = before_all(steps, place, before)
    verdicts += [judged(step, place, journal, before) for step in steps]
    _enter(place, journal, verdicts)
    return verdicts


def before_all(steps: list[Step], place: GateFolders, before: Previous) -> list[StepVerdict]:
    """That the tree is the commit the gate began with; that the previous release's records are as they were kept, and
    that each is made again. Without this there is no use in running anything."""
    dirty = [f"dirty tree: {name} is not committed" for name in tree.changes(place.root)]
    now = tree.head(place.root)
    if now != place.commit:
        dirty.append(f"commit {now[:12]} is checked out, the gate began with {place.commit[:12]}")
    levels = MeshLevel if place.level == MeshLevel.RELEASE else (place.level,)
    kept = [name for level in levels for name in before.names(f"{level}/*.json")] + before.names("book/*.json")
    made = {name for step in steps for pattern in step.records for name in (*before.names(pattern), pattern)}
    gone = [f"{name} is on record, and no step makes it any more" for name in kept if name not in made]
    said = f"{before.label}, as they were kept"
    unknown = sum((before.read(name) or {}).get("provenance") is None for name in kept)
    if unknown:
        said += f"; {unknown} of {len(kept)} do not say from what: values only"
    return [
        StepVerdict("clean tree", dirty, f"commit {place.commit[:12]}", "git status"),
        StepVerdict("previous release", before.problems + gone, said, "git log -- fem_check/records"),
    ]


def judged(step: Step, place: GateFolders, journal: Journal, before: Previous) -> StepVerdict:
    """A step's verdict, from its records, the previous release's, and the journal."""
    done = journal[step.name]
    if done["error"]:
        return StepVerdict(step.name, [done["error"]], command=step.command)
    made = step.made(place.out)
    gone = {name for pattern in step.records for name in before.names(pattern)} - set(made)
    reasons = [f"{name} of the previous release is not made any more" for name in sorted(gone)]
    if step.records and not made:
        reasons.append(f"it left no record {' or '.join(step.records)}")
    for name in made:
        try:
            record = previous.read(place.out / name)
            old = before.read(name)
            objections = integrity.of_provenance(record, place.commit) + step.wrong(record)
            objections += step.moved(record, old) if old else []
        except (RecordError, LookupError, TypeError, ValueError) as problem:
            objections = [f"it cannot be judged: {type(problem).__name__}: {problem}"]
        reasons += [f"{name}: {each}" for each in objections]
    return StepVerdict(step.name, reasons, f"{done['seconds']:.0f} s", step.command)


def keep(steps: list[Step], place: GateFolders) -> list[Path]:
    """Make a gate's records those of the repository, with what is written from them and their manifest; returns the
    records, to be committed with the rest."""
    names = [name for step in steps for name in step.made(place.out)]
    written = []
    for name in [*names, f"gate/{place.level}/steps.json"]:
        written.append(kept_files.place_of(name, place.root, place.root / previous.RECORDS))
        written[-1].parent.mkdir(parents=True, exist_ok=True)
        records_store.replace(written[-1], (place.out / name).read_bytes())
    if place.level == MeshLevel.RELEASE:  # the journal of a quick gate, of another commit than the records beside it
        kept_files.place_of(f"gate/{MeshLevel.QUICK}/steps.json", place.root, place.root / previous.RECORDS).unlink(
            missing_ok=True
        )
    write_tables(place)
    return [*written, manifest.write(place.root)]
