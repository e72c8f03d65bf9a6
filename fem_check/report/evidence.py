"""All records that the report is made from, each with the name of its file and the command that makes it again."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fem_check.cost import record as cost_record
from fem_check.running import records_store, suite
from fem_check.running.kept_files import OF_REPOSITORY
from qsbearing.documents.model import Callout, Md, Trace

REPOSITORY = Path(__file__).parents[2]
CARRIED = Path(__file__).parents[1] / "repository"
"""Where an installed package has the records that stand elsewhere in the repository."""

TESTS = tuple(map(suite.file_of, suite.COMMANDS))
GATE = ("steps.json", *TESTS, "campaign/*/summary.json")
"""What the release gate leaves in its folder that the report shows."""
RELEASE = "release"


ELSEWHERE = {
    "reference": ("tests/verification/reference/table.json", "python -m tests.verification.reference.table"),
    "relations": ("tests/relations.json", "python -m tests.relations"),
    "errata": ("tests/verification/reference/errata.json", "python -m tests.verification.reference.errata"),
    "hard_cases": ("tests/verification/hard_cases/table.json", "python -m tests.verification.hard_cases.table"),
    "model_cost": ("qsbearing/studies/cost/records/b218_combined.json", "python -m tests.verification.benchmarks.cost"),
    "auto_accuracy": (
        "tests/verification/benchmarks/auto_accuracy.json", "python -m tests.verification.benchmarks.auto_accuracy",
    ),
    "scipy": ("tests/verification/benchmarks/record.json", "python -m tests.verification.benchmarks.record"),
    "mutations": ("tests/verification/mutations.json", "python -m tests.verification.mutations"),
}  # fmt: skip
"""Records of the repository with the commands that make them, by their names here."""


def needs_checkout(command: str) -> bool:
    """Whether a command needs files that an installed package does not have."""
    return not command.startswith(("fem-check ", "qsbearing ")) or "tests/" in command


NOT_RECORDED = "commit, date and machine not recorded"


@dataclass(frozen=True)
class Kept:
    """A record, and where it is kept."""

    name: str
    """Of its file, from the folder of records or the repository."""
    data: dict[str, Any]
    command: str
    digest: str = ""
    """sha256 of the file."""

    @property
    def provenance(self) -> dict[str, Any]:
        """Of the run; empty where nothing was recorded."""
        return dict(self.data.get("provenance") or {})

    @property
    def version(self) -> str:
        """Of qsbearing, as far as the record says it."""
        holders = (self.provenance, self.data.get("versions") or {}, self.data.get("machine") or {})
        versions = [holder["qsbearing"] for holder in holders if "qsbearing" in holder]
        return str(versions[0]) if versions else str(self.data.get("version") or "")

    @property
    def needs_checkout(self) -> bool:
        """Whether its command runs in a checkout of the repository only."""
        return needs_checkout(self.command)

    @property
    def made_with(self) -> str:
        """Version, commit, day in a line."""
        version = f"qsbearing {self.version}" if self.version else "version not recorded"
        if not self.provenance:
            return f"{version}; {NOT_RECORDED}"
        commit = (self.provenance["commit"] or "no commit")[:12]
        changed = " with changes that are not committed" if self.provenance["dirty"] else ""
        return f"{version}, {commit}{changed}, {self.provenance['date'][:10]}"

    @property
    def trace(self) -> Trace:
        """The line below what is shown of it."""
        return Trace(self.name, self.command, self.made_with)


@dataclass(frozen=True)
class Evidence:
    """Everything on record."""

    folder: Path
    checks: dict[str, Kept]
    book: dict[str, Kept] = field(default_factory=dict)
    cost: Kept | None = None
    reference: Kept | None = None
    relations: Kept | None = None
    errata: Kept | None = None
    hard_cases: Kept | None = None
    campaigns: list[Kept] = field(default_factory=list)
    recomputed: list[Kept] = field(default_factory=list)
    """Campaigns of elastic rings, sets, deep-groove rows, spindles and friction, whose solutions are computed a second
    time."""
    model_cost: Kept | None = None
    auto_accuracy: Kept | None = None
    scipy: Kept | None = None
    mutations: Kept | None = None
    """A survey of the tests, not of results: it takes hours, and need not be of the commit of all others."""
    gate: Kept | None = None
    """The steps of the last release run."""
    tests: list[Kept] = field(default_factory=list)
    """What the tests of the release run came to: all but the heavy ones, and these."""

    @property
    def random_scenes(self) -> list[Kept]:
        """All campaigns."""
        return [*self.campaigns, *self.recomputed]

    def all(self) -> Iterator[Kept]:
        """Every record of results."""
        for name, value in vars(self).items():
            yield from (value,) if isinstance(value, Kept) and name != "mutations" else ()
            yield from value if isinstance(value, list) else ()
            yield from value.values() if isinstance(value, dict) else ()


def read(records: Path = records_store.FOLDER, alone: bool = False) -> Evidence:
    """All that a folder of records holds; what only the package or the repository has is taken from there.

    Args:
        records: laid out as those that come with the package.
        alone: take what is compared row by row, the checks and the book, from this folder and from nowhere else.

    Raises:
        records_store.RecordError: a file that is no record, or a folder without any record of a check.
    """
    label = _label(records)
    entries = records_store.read_all(records)
    if not entries:
        raise records_store.RecordError(f"no records in {records}: run `fem-check run --out {records}` first")
    checks = {
        name: _kept(
            f"{label}/{each['level']}/{name}.json",
            records_store.path_of(name, each["level"], records),
            records_store.command_of(name, each["level"], each["scene"]),
            each,
        )
        for name, each in entries.items()
    }
    gate = _gate(records, label, {str(entry["level"]) for entry in entries.values()})
    shipped = _gate(records_store.FOLDER, _label(records_store.FOLDER), {RELEASE})
    campaigns = [each for name, each in (shipped | gate).items() if name.startswith("campaign/")]
    return Evidence(
        records,
        checks,
        published(records) or ({} if alone else published(records_store.FOLDER)),
        cost=_cost(records) or _cost(records_store.FOLDER),
        campaigns=[each for each in campaigns if "envelope" in each.data],
        recomputed=[each for each in campaigns if "campaign" in each.data],
        gate=gate.get("steps"),
        tests=[gate[name] for name in (each.removesuffix(".json") for each in TESTS) if name in gate],
        **{name: _in_repository(records, *each) for name, each in ELSEWHERE.items()},
    )


def _label(folder: Path) -> str:
    """What a folder of records is called in the report."""
    return "fem_check/records" if folder == records_store.FOLDER else folder.resolve().name


def _load(path: Path) -> dict[str, Any]:
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        if not isinstance(record, dict):
            raise ValueError("it is not an object")
    except (ValueError, OSError) as problem:
        raise records_store.RecordError(f"{path} is not a record ({problem})") from problem
    return record


def _kept(name: str, path: Path, command: str, data: Mapping[str, Any] | None = None) -> Kept:
    """A file with its sha256."""
    return Kept(name, dict(data or _load(path)), command, hashlib.sha256(path.read_bytes()).hexdigest())


def _in_repository(records: Path, name: str, command: str) -> Kept | None:
    """A record of the repository: as the gate made it beside these, or where the repository or what an installed
    package carries of it has one."""
    paths = (root / name for root in (records / OF_REPOSITORY, REPOSITORY, CARRIED))
    return next((_kept(name, path, command) for path in paths if path.is_file()), None)


def _again(data: dict[str, Any]) -> str:
    module = "python -m tests.verification.campaign"
    if "campaign" in data:
        return f"{module}.{data['campaign']} {data['count']} {data['seed']}"
    return f"{module} --envelope {data['envelope']} --count {data['count']} --seed {data['seed']}"


def _cost(records: Path) -> Kept | None:
    record = cost_record.read(records)
    if record is None:
        return None
    level = record["level"]
    name = f"cost/{level}.json"
    return _kept(f"{_label(records)}/{name}", records / name, f"fem-check cost --level {level}", record)


def published(records: Path) -> dict[str, Kept]:
    """The records of the book in a folder of records."""
    by_case = {}
    for path in sorted((records / "book").glob("*.json")):
        data = _load(path)
        if {"case", "verdict", "rows"} <= set(data):
            by_case[data["case"]] = _kept(
                f"{_label(records)}/book/{path.name}", path, f"fem-check book {data['case']}", data
            )
    return by_case


def _gate(records: Path, label: str, levels: set[str]) -> dict[str, Kept]:
    """What a release run left in the folder, if it made the checks' records, which are then all of its level."""
    if len(levels) != 1:
        return {}
    (level,) = levels
    folder = records / "gate" / level
    paths = [path for pattern in GATE for path in sorted(folder.glob(pattern))]
    by_name = {}
    for path in paths:
        name, data = path.relative_to(folder).as_posix(), _load(path)
        command = f"fem-check release --level {level}" if name == "steps.json" else data.get("command") or _again(data)
        by_name[name.removesuffix(".json")] = _kept(f"{label}/gate/{level}/{name}", path, command, data)
    return by_name


def missing(what: str, command: str) -> Callout:
    """A sentence that stands in the place of a record; instead of the command the name of one of `ELSEWHERE`."""
    command = ELSEWHERE[command][1] if command in ELSEWHERE else command
    where = ", in a checkout of the repository" if needs_checkout(command) else ""
    return Callout(Md(f"{what} is not on record here. `{command}` makes it{where}."), "missing")
