"""The steps of the gate: what each runs, which records it makes, when these are right, what they are compared with."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from fem_check.checks import ALL
from fem_check.release import drift, integrity
from fem_check.rows.agreement import Level
from fem_check.running import known, runner

Record = dict[str, Any]

SCENES = {
    Level.QUICK: {"wild": 1_500, "realistic": 4_000, "mounted": 800},
    Level.RELEASE: {"wild": 200_000, "realistic": 500_000, "mounted": 100_000},
}
"""Of the campaigns."""
SEED = 1
HARD_CASE_VERDICTS = ("within 1e-9", "explained by its condition", "as expected")
BOOK_DIGITS = 10
"""To which the book's records are rounded."""


class StepError(Exception):
    """A step could not make its records; the message says why."""


@dataclass(frozen=True)
class Place:
    """Where the gate runs and keeps what it makes."""

    root: Path
    level: Level
    out: Path
    commit: str
    previous: Path | None = None
    """Folder of the previous release's records."""

    @property
    def gate(self) -> Path:
        """Folder of all that is not a check's record."""
        return self.out / "gate" / self.level


@dataclass(frozen=True)
class Step:
    """One step."""

    name: str
    command: str
    """Which runs it alone."""
    run: Callable[[Place], None]
    records: tuple[str, ...] = ()
    """That it makes, as paths or patterns below the output folder."""
    wrong: Callable[[Record], list[str]] = lambda record: []
    """What is wrong in one of them."""
    moved: Callable[[Record, Record], list[str]] = lambda new, old: []
    """What moved too far from the previous release's."""
    in_repository: str | None = None
    """Where the previous release has its record, if not in the folder of records."""

    def made(self, out: Path) -> list[str]:
        """The records that are there."""
        return sorted(path.relative_to(out).as_posix() for each in self.records for path in out.glob(each))


def all_steps(level: Level) -> list[Step]:
    """What a release needs, cheap and telling things first."""
    ratios = f"python -m tests.verification.benchmarks.ratios --level {level} FILE"
    return [
        Step(
            "hard cases",
            "python -m tests.verification.hard_cases.table",
            _hard_cases,
            (f"gate/{level}/hard_cases/table.json",),
            _wrong_hard_cases,
            drift.of_hard_cases,
            "tests/verification/hard_cases/table.json",
        ),
        *(_campaign(level, envelope, count) for envelope, count in SCENES[level].items()),
        *(_check(level, name) for name in ALL),
        Step("benchmarks", ratios, _benchmarks, (f"gate/{level}/benchmarks.json",), _wrong_points, drift.of_benchmarks),
        Step(
            "validation book",
            "fem-check book",
            lambda place: _python(place, "book", "fem_check", "book", "--out", str(place.out), accept=1),
            ("book/*.json",),
            partial(integrity.of_rows, digits=BOOK_DIGITS),
            drift.of_check,
        ),
        Step("reports", "fem-check report", _report),
    ]


def _check(level: Level, name: str) -> Step:
    def run(place: Place) -> None:
        list(runner.run(runner.selected((name,)), place.level, place.out, lambda check: lambda stage, part: None))

    command = f"fem-check run {name} --level {level}"
    return Step(f"check {name}", command, run, (f"{level}/{name}.json",), integrity.of_rows, drift.of_check)


def _hard_cases(place: Place) -> None:
    folder = place.gate / "hard_cases"
    folder.mkdir(parents=True, exist_ok=True)
    _python(place, "hard_cases", "tests.verification.hard_cases.table", str(folder))


def _wrong_hard_cases(record: Record) -> list[str]:
    bad = [case for case in record["cases"] if case["verdict"] not in HARD_CASE_VERDICTS]
    return [f"the hard case {case['case']} is {case['verdict']}" for case in bad]


def _campaign(level: Level, envelope: str, count: int) -> Step:
    asked = ["--envelope", envelope, "--count", str(count), "--seed", str(SEED)]

    def run(place: Place) -> None:
        folder = place.gate / "campaign" / envelope
        call = partial(
            _python, place, f"campaign_{envelope}", "tests.verification.campaign", *asked, "--out", str(folder)
        )
        try:  # what an interrupted gate has solved is kept by the campaign itself
            call("--resume", accept=1)
        except StepError:
            shutil.rmtree(folder, ignore_errors=True)  # another version's, or damaged
            call(accept=1)

    def wrong(record: Record) -> list[str]:
        found = [f"{number} scenes: {what}" for what, number in record["failures"].items()] + known.objections(record)
        if record["count"] != count or sum(record["classes"].values()) != count:
            found.append(f"{sum(record['classes'].values())} scenes are classified, {count} were asked for")
        return found

    made = (f"gate/{level}/campaign/{envelope}/summary.json",)
    before = f"tests/verification/campaign/records/{envelope}_seed_{SEED}_count_{count}.json"
    command = f"python -m tests.verification.campaign {' '.join(asked)}"
    return Step(f"campaign {envelope}", command, run, made, wrong, drift.of_campaign, before)


def _benchmarks(place: Place) -> None:
    target = str(place.gate / "benchmarks.json")
    _python(place, "benchmarks", "tests.verification.benchmarks.ratios", "--level", place.level, target)


def _wrong_points(record: Record) -> list[str]:
    lost = record["points"] - record["converged"]
    return [f"{lost} of {record['points']} points did not converge"] if lost else []


def _report(place: Place) -> None:
    previous = ["--previous", str(place.previous)] if place.previous else []
    _python(place, "report", "fem_check", "report", "--out", str(place.out), *previous)


def _python(place: Place, log: str, module: str, *arguments: str, accept: int = 0) -> None:
    """Run a module in a process of its own, which may end badly without ending the gate.

    Args:
        log: what its output is kept as.
        accept: the largest exit code with which it has made its records.

    Raises:
        StepError: it ended with another exit code.
    """
    path = place.gate / "logs" / f"{log}.log"
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", encoding="utf-8") as file:
        command = [sys.executable, "-m", module, *arguments]
        code = subprocess.run(command, cwd=place.root, stdout=file, stderr=subprocess.STDOUT, check=False).returncode
    said = path.read_text(encoding="utf-8", errors="replace").strip()
    # A traceback ends with exit code 1, too.
    if not 0 <= code <= accept or (code and "Traceback (most recent call last)" in said):
        last = said.splitlines()[-1] if said else "it said nothing"
        raise StepError(f"{module} ended with exit code {code}: {last} (all it said: {path})")
