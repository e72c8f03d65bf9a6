"""Records of the book: one JSON file per case, in the folder `book` of a folder of records."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NotRequired, TypedDict, cast

from fem_check.book.case import EVIDENCE, Case, CaseResult, plain
from fem_check.rows.record import RowRecord, entries_of
from fem_check.running import records_store


class RunRecord(TypedDict):
    """What every run changes."""

    provenance: dict[str, Any]
    seconds: float
    cpu_seconds: float
    peak_memory_MB: int


class BookRecord(RunRecord):
    """A published case, as kept and printed."""

    case: str
    title: str
    kind: str
    """M, C or B: see `EvidenceKind`."""
    kind_text: str
    question: str
    verdict: str
    summary: str
    inputs: list[list[Any]]
    missing: list[str]
    sources: list[str]
    fitted: list[str]
    predicted: list[str]
    chosen_after_seeing: list[str]
    does_not_show: list[str]
    counter_example: NotRequired[bool]
    rows: list[RowRecord]
    points: dict[str, Any] | None
    picture: dict[str, Any]


RUN, FIELDS = entries_of(RunRecord), entries_of(BookRecord)
AS_WRITTEN = "inputs", "missing", "sources", "fitted", "predicted", "chosen_after_seeing", "does_not_show"
"""What a record takes from the case's texts as it is."""


def record(case: Case, result: CaseResult, run: RunRecord) -> BookRecord:
    """A case and what its run found, as kept; `run` has the entries RUN."""
    texts = case.texts.model_dump(mode="json")
    picture = {
        "file": f"{case.name}.svg",
        "caption": texts["caption"],
        "alt": texts["alternative"],
        "panels": plain(result.panels),
    }
    entry = {
        "case": case.name,
        "title": texts["title"],
        "kind": str(case.texts.evidence),
        "kind_text": EVIDENCE[case.texts.evidence],
        "question": texts["question"],
        "verdict": result.verdict,
        "summary": result.summary,
        **{name: texts[name] for name in AS_WRITTEN},
        **({"counter_example": True} if texts["counter_example"] else {}),
        "rows": [plain(row.as_dict()) for row in result.rows],
        "points": plain(result.points),
        "picture": picture,
        **run,
    }
    return cast(BookRecord, entry)


def folder_of(records: Path) -> Path:
    """Where the book's records are kept in a folder of records."""
    return records / "book"


def text(entry: Mapping[str, Any]) -> bytes:
    """A record as it stands in its file: rows to read; all points and the picture's numbers, on a line each."""
    long = ("points", "picture")
    read = json.dumps(
        {key: value for key, value in entry.items() if key not in long}, indent=1, allow_nan=False, ensure_ascii=False
    )
    lines = [f' "{key}": {json.dumps(entry[key], allow_nan=False, ensure_ascii=False)}' for key in long]
    return (f"{read[:-2]},\n" + ",\n".join(lines) + "\n}\n").encode()


def write(entry: BookRecord, records: Path) -> Path:
    """Keep a record, whole or not at all."""
    folder = folder_of(records)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{entry['case']}.json"
    records_store.replace(path, text(entry))
    return path


def read_all(records: Path = records_store.FOLDER) -> dict[str, BookRecord]:
    """The records of the book in a folder of records, by case.

    Raises:
        RecordError: a file that is no record.
    """
    by_case = {}
    for path in sorted(folder_of(records).glob("*.json")):
        entry = cast(
            BookRecord, records_store.read(path, FIELDS, "no record of the book", "run `fem-check book` again")
        )
        by_case[entry["case"]] = entry
    return by_case
