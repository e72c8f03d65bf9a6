"""The steps of the gate: what each runs, which records it makes, when these are right, what they are compared with."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from fem_check.checks import usual
from fem_check.release import drift, integrity
from fem_check.rows.agreement import MeshLevel
from fem_check.rows.record import Record
from fem_check.running import known, runner, suite
from fem_check.running.kept_files import OF_REPOSITORY

SCENES = {
    MeshLevel.QUICK: {"wild": 1_500, "realistic": 4_000, "mounted": 800},
    MeshLevel.RELEASE: {"wild": 100_000, "realistic": 100_000, "mounted": 100_000},
}
"""Of the campaigns of single bearings: solved, classified, refusals certified."""
RECOMPUTED = {
    MeshLevel.QUICK: {
        "elastic_rings": 1_000,
        "sets": 200,
        "deep_groove": 200,
        "spindles": 100,
        "friction": 1_040,
        "arched": 208,
    },
    MeshLevel.RELEASE: {
        "elastic_rings": 100_000,
        "sets": 20_000,
        "deep_groove": 20_000,
        "spindles": 20_000,
        "friction": 10_400,
        "arched": 9_984,
    },
}
"""Cases of the campaigns that compute what is solved a second time."""
SEED = 1
HARD_CASE_VERDICTS = ("within 1e-9", "explained by its condition", "as expected")
BOOK_DIGITS = 10
"""To which the book's records are rounded."""


class StepError(Exception):
    """A step could not make its records; the message says why."""


@dataclass(frozen=True)
class GateFolders:
    """Where the gate runs and keeps what it makes."""

    root: Path
    level: MeshLevel
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
    run: Callable[[GateFolders], None]
    records: tuple[str, ...] = ()
    """That it makes, as paths or patterns below the output folder."""
    wrong: Callable[[Record], list[str]] = lambda record: []
    """What is wrong in one of them."""
    moved: Callable[[Record, Record], list[str]] = lambda new, old: []
    """What moved too far from the previous release's."""
    is_alone: bool = True
    """Whether it needs the machine for itself: it measures times, or takes all cores."""
    is_first: bool = False
    """Whether it is run before all records."""

    def made(self, out: Path) -> list[str]:
        """The records that are there."""
        return sorted(path.relative_to(out).as_posix() for each in self.records for path in out.glob(each))


def all_steps(level: MeshLevel) -> list[Step]:
    """What a release needs, cheap and telling things first."""
    is_release = level is MeshLevel.RELEASE
    return [
        *(map(_suite, suite.COMMANDS) if is_release else ()),
        _elsewhere(
            "hard cases", "verification.hard_cases.table", _wrong_hard_cases, moved=drift.of_hard_cases, is_alone=False
        ),
        *_of_level(level),
        *(_of_release() if is_release else ()),
        Step(
            "validation book",
            "fem-check book",
            lambda place: _python(place, "book", "fem_check", "book", "--out", str(place.out), accept=1),
            ("book/*.json",),
            partial(integrity.of_rows, digits=BOOK_DIGITS),
            drift.of_check,
            is_alone=False,
        ),
        Step("reports", "fem-check report", _report),
    ]


def _suite(name: str) -> Step:
    made = f"gate/{MeshLevel.RELEASE}/{suite.file_of(name)}"

    def run(place: GateFolders) -> None:
        log = place.gate / "logs" / f"{name.replace(' ', '_')}.log"
        suite.run(name, place.root, place.out / made, log)

    return Step(name, suite.command_of(name), run, (made,), suite.wrong, is_first=True)


def _of_level(level: MeshLevel) -> list[Step]:
    """What each level makes records of its own of."""
    ratios = f"python -m tests.verification.benchmarks.ratios --level {level} FILE"
    return [
        *(_campaign(level, envelope, count) for envelope, count in SCENES[level].items()),
        *(_recomputed(level, name, count) for name, count in RECOMPUTED[level].items()),
        *(_check(level, name) for name in usual(level)),
        Step("benchmarks", ratios, _benchmarks, (f"gate/{level}/benchmarks.json",), _wrong_points, drift.of_benchmarks),
    ]


def _quick_too(step: Step) -> Step:
    """A step of the quick level within a release, so that its record is never that of an older commit."""
    return replace(
        step, name=f"{step.name}, quick level", run=lambda place: step.run(replace(place, level=MeshLevel.QUICK))
    )


def _check(level: MeshLevel, name: str) -> Step:
    def run(place: GateFolders) -> None:
        list(runner.run(runner.selected((name,)), place.level, place.out, lambda check: lambda stage, part: None))

    command = f"fem-check run {name} --level {level}"
    made = (f"{level}/{name}.json",)
    return Step(f"check {name}", command, run, made, integrity.of_rows, drift.of_check, is_alone=False)


def _of_release() -> list[Step]:
    """What the release level makes besides: those of the quick level, records that stand elsewhere in the repository,
    and times."""
    elements = "fem-check cost --level release"
    return [
        *map(_quick_too, _of_level(MeshLevel.QUICK)),
        _elsewhere(
            "fifty digits", "verification.reference.table", _failed("case", "cases", "friction_cases"), is_alone=False
        ),
        _elsewhere("relations", "relations", _failed("file", "files"), is_alone=False),
        _elsewhere("errata", "verification.reference.errata", is_alone=False),
        _elsewhere("automatic effects", "verification.benchmarks.auto_accuracy", is_alone=False),
        _elsewhere("times", "verification.benchmarks.record"),
        _elsewhere("times against the release before", "verification.benchmarks.before"),
        _elsewhere(
            "cost of the model",
            "verification.benchmarks.cost",
            made="qsbearing/studies/cost/records/b218_combined.json",
        ),
        Step(
            "cost of the elements",
            elements,
            lambda place: _python(place, "cost", "fem_check", *elements.split()[1:], "--out", str(place.out)),
            ("cost/release.json",),
        ),
    ]


def _elsewhere(
    name: str,
    module: str,
    wrong: Callable[[Record], list[str]] = lambda record: [],
    made: str = "",
    moved: Callable[[Record, Record], list[str]] = lambda new, old: [],
    is_alone: bool = True,
) -> Step:
    """A record that a module of the tests writes to the path that it is given, and that is kept beside the module.

    Args:
        made: its path in the repository, if not the module's with another ending.
    """
    path = made or f"tests/{module.replace('.', '/')}.json"

    def run(place: GateFolders) -> None:
        target = place.out / OF_REPOSITORY / path
        target.parent.mkdir(parents=True, exist_ok=True)
        _python(place, name.replace(" ", "_"), f"tests.{module}", str(target))

    return Step(name, f"python -m tests.{module}", run, (f"{OF_REPOSITORY}/{path}",), wrong, moved, is_alone)


def _failed(name: str, *lists: str) -> Callable[[Record], list[str]]:
    return lambda record: [
        f"{each[name]} fails" for rows in lists for each in record[rows] if each["verdict"] != "pass"
    ]


def _wrong_hard_cases(record: Record) -> list[str]:
    bad = [case for case in record["cases"] if case["verdict"] not in HARD_CASE_VERDICTS]
    return [f"the hard case {case['case']} is {case['verdict']}" for case in bad]


def _campaign(level: MeshLevel, envelope: str, count: int) -> Step:
    options = ["--envelope", envelope, "--count", str(count), "--seed", str(SEED)]

    def run(place: GateFolders) -> None:
        folder = place.gate / "campaign" / envelope
        call = partial(
            _python, place, f"campaign_{envelope}", "tests.verification.campaign", *options, "--out", str(folder)
        )
        try:  # what an interrupted gate has solved is kept by the campaign itself
            call("--resume", accept=1)
        except StepError:
            shutil.rmtree(folder, ignore_errors=True)  # another version's, or damaged
            call(accept=1)

    def wrong(record: Record) -> list[str]:
        faults = [f"{number} scenes: {what}" for what, number in record["failures"].items()] + known.objections(record)
        if record["count"] != count or sum(record["classes"].values()) != count:
            faults.append(f"{sum(record['classes'].values())} scenes are classified, {count} were asked for")
        return faults

    made = (f"gate/{level}/campaign/{envelope}/summary.json",)
    command = f"python -m tests.verification.campaign {' '.join(options)}"
    return Step(f"campaign {envelope}", command, run, made, wrong, drift.of_campaign)


def _recomputed(level: MeshLevel, name: str, count: int) -> Step:
    made, module = f"gate/{level}/campaign/{name}/summary.json", f"tests.verification.campaign.{name}"

    def run(place: GateFolders) -> None:
        target = place.out / made
        target.parent.mkdir(parents=True, exist_ok=True)
        _python(place, f"campaign_{name}", module, str(count), str(SEED), "--out", str(target), accept=1)

    def wrong(record: Record) -> list[str]:
        few = [f"{record['count']} cases are counted, {count} were asked for"] if record["count"] != count else []
        return [*record["wrong"], *few, *known.above(record), *known.unsaid(record)]

    command = f"python -m {module} {count} {SEED}"
    return Step(f"campaign {name}", command, run, (made,), wrong, drift.of_recomputed, is_alone=False)


def _benchmarks(place: GateFolders) -> None:
    target = str(place.gate / "benchmarks.json")
    _python(place, "benchmarks", "tests.verification.benchmarks.ratios", "--level", place.level, target)


def _wrong_points(record: Record) -> list[str]:
    lost = record["points"] - record["converged"]
    return [f"{lost} of {record['points']} points did not converge"] if lost else []


def _report(place: GateFolders) -> None:
    previous = ["--previous", str(place.previous)] if place.previous else []
    _python(place, "report", "fem_check", "report", "--out", str(place.out), *previous)


def write_tables(place: GateFolders) -> None:
    """Write the guide's tables and what else follows from the records of the repository."""
    _python(place, "tables", "tests.verification.benchmarks.tables")


def _python(place: GateFolders, log: str, module: str, *arguments: str, accept: int = 0) -> None:
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
