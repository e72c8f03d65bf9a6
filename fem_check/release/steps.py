"""The steps of the gate: what each runs, which records it makes, when these are right, what they are compared with."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fem_check import runner
from fem_check.agreement import Level, Progress
from fem_check.checks import ALL
from fem_check.release import drift, integrity, known

Record = dict[str, Any]

SCENES = {
    Level.QUICK: {"wild": 4_000, "realistic": 10_000, "mounted": 2_000},
    Level.RELEASE: {"wild": 200_000, "realistic": 500_000, "mounted": 100_000},
}
"""Of the campaigns."""
SEED = 1

REPORTS = (".html", ".pdf")
"""Pages that the report must consist of."""

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
    run: Callable[[Place, Progress], None]
    records: tuple[str, ...] = ()
    """That it makes, as paths or patterns below the output folder."""
    wrong: Callable[[Record], list[str]] = lambda record: []
    """What is wrong in one of them."""
    moved: Callable[[Record, Record], list[str]] = lambda new, old: []
    """What moved too far from the previous release's."""
    in_repository: str | None = None
    """Where the previous release has its record, if not in the folder of records."""


def all_steps(level: Level) -> list[Step]:
    """What a release needs, cheap and telling things first."""
    campaigns = [_campaign(level, envelope) for envelope in SCENES[level]]
    checks = [_check(level, name) for name in ALL]
    return [_hard_cases(level), *campaigns, *checks, _benchmarks(level), _book(), _report()]


def _check(level: Level, name: str) -> Step:
    def run(place: Place, progress: Progress) -> None:
        list(runner.run(runner.selected((name,)), place.level, place.out, lambda check: progress))

    command = f"fem-check run {name} --level {level}"
    return Step(f"check {name}", command, run, (f"{level}/{name}.json",), integrity.of_rows, drift.of_check)


def _hard_cases(level: Level) -> Step:
    def run(place: Place, progress: Progress) -> None:
        folder = place.gate / "hard_cases"
        folder.mkdir(parents=True, exist_ok=True)
        _python(place, "hard_cases", "tests.hard_cases.table", str(folder))

    def wrong(record: Record) -> list[str]:
        return [
            f"the hard case {case['case']} is {case['verdict']}"
            for case in record["cases"]
            if case["verdict"] not in ("within 1e-9", "explained by its condition", "as expected")
        ] or ([] if record["cases"] else ["it has no cases"])

    return Step(
        "hard cases",
        "python -m tests.hard_cases.table",
        run,
        (f"gate/{level}/hard_cases/table.json",),
        wrong,
        drift.of_hard_cases,
        "tests/hard_cases/table.json",
    )


def _campaign(level: Level, envelope: str) -> Step:
    count = SCENES[level][envelope]
    asked = ["--envelope", envelope, "--count", str(count), "--seed", str(SEED)]

    def run(place: Place, progress: Progress) -> None:
        folder = place.gate / "campaign" / envelope
        try:  # what an interrupted gate has solved is kept by the campaign itself
            _python(place, f"campaign_{envelope}", "tests.campaign", *asked, "--out", str(folder), "--resume", accept=1)
        except StepError:
            shutil.rmtree(folder, ignore_errors=True)  # another version's, or damaged
            _python(place, f"campaign_{envelope}", "tests.campaign", *asked, "--out", str(folder), accept=1)

    def wrong(record: Record) -> list[str]:
        found = [f"{number} scenes: {what}" for what, number in record["failures"].items()]
        found += known.objections(record)
        if record["bar"]["failures"] != sum(record["failures"].values()):
            found.append(f"{record['bar']['failures']} failures do not add up from {record['failures']}")
        if record["count"] != count or sum(record["classes"].values()) != count:
            found.append(f"{sum(record['classes'].values())} scenes are classified, {count} were asked for")
        return found

    return Step(
        f"campaign {envelope}",
        f"python -m tests.campaign {' '.join(asked)}",
        run,
        (f"gate/{level}/campaign/{envelope}/summary.json",),
        wrong,
        drift.of_campaign,
        f"tests/campaign/records/{envelope}_seed_{SEED}_count_{count}.json",
    )


def _benchmarks(level: Level) -> Step:
    def run(place: Place, progress: Progress) -> None:
        _python(place, "benchmarks", "tests.benchmarks.ratios", "--level", level, str(place.gate / "benchmarks.json"))

    def wrong(record: Record) -> list[str]:
        lost = record["points"] - record["converged"]
        return [f"{lost} of {record['points']} points did not converge"] if lost else []

    command = f"python -m tests.benchmarks.ratios --level {level} FILE"
    return Step("benchmarks", command, run, (f"gate/{level}/benchmarks.json",), wrong, drift.of_benchmarks)


def _book() -> Step:
    def run(place: Place, progress: Progress) -> None:
        shutil.rmtree(place.out / "book", ignore_errors=True)
        _python(place, "book", "fem_check", "book", "--out", str(place.out), accept=1)

    def wrong(record: Record) -> list[str]:
        return integrity.of_rows(record, BOOK_DIGITS)

    return Step("validation book", "fem-check book", run, ("book/*.json",), wrong, drift.of_check)


def _report() -> Step:
    def run(place: Place, progress: Progress) -> None:
        for path in _reports(place.out):
            path.unlink()
        previous = ["--previous", str(place.previous)] if place.previous else []
        _python(place, "report", "fem_check", "report", "--out", str(place.out), *previous)
        missing = set(REPORTS) - {path.suffix for path in _reports(place.out) if path.stat().st_size}
        if missing:
            raise StepError(f"fem-check report left no {' and no '.join(sorted(missing))} in {place.out}")

    return Step("reports", "fem-check report", run)


def _reports(folder: Path) -> list[Path]:
    return [path for path in folder.glob("*") if path.suffix in REPORTS]


def _python(place: Place, log: str, module: str, *arguments: str, accept: int = 0) -> None:
    """Run a module in a process of its own, which may end badly without ending the gate.

    Args:
        log: what its output is kept as.
        accept: the largest exit code with which it has made its records.

    Raises:
        StepError: it ended with another exit code.
    """
    folder = place.gate / "logs"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{log}.log"
    with path.open("w", encoding="utf-8") as file:
        command = [sys.executable, "-m", module, *arguments]
        code = subprocess.run(command, cwd=place.root, stdout=file, stderr=subprocess.STDOUT, check=False).returncode
    said = path.read_text(encoding="utf-8", errors="replace").strip()
    # A traceback ends with exit code 1, too.
    if not 0 <= code <= accept or (code and "Traceback (most recent call last)" in said):
        last = said.splitlines()[-1] if said else "it said nothing"
        raise StepError(f"{module} ended with exit code {code}: {last} (all it said: {path})")
