"""Runs cases of the book and keeps their records."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from pathlib import Path

from fem_check.book import records
from fem_check.book.case import Case
from fem_check.book.cases import ALL
from fem_check.running import memory
from qsbearing.results import provenance


class UnknownCaseError(ValueError):
    """A name that no case of the book has; the message says which there are."""


def selected(names: Iterable[str] = ()) -> list[Case]:
    """The cases of these names, all by default, in the order of the book.

    Raises:
        UnknownCaseError: a name that no case has.
    """
    names = list(names)
    unknown = [name for name in names if name not in ALL]
    if unknown:
        raise UnknownCaseError(f"no case named {', '.join(unknown)}; there are: {', '.join(ALL)}")
    return [case for case in ALL.values() if not names or case.name in names]


def run_book(
    names: Iterable[str] = (), out: Path | None = None, progress: Callable[[str, float], None] | None = None
) -> list[records.BookRecord]:
    """Run cases of the book, all by default, one after another.

    Args:
        names: of cases.
        out: folder that gets `book/NAME.json` of each case; None writes nothing.
        progress: called with the name of each case before it runs, and the part that is done.

    Returns:
        The records, in the order of the book; `verdict` is "pass" or "fail".

    Raises:
        UnknownCaseError: a name that no case has; nothing was run.
        OSError: the folder cannot be written.
    """
    chosen, entries = selected(names), []
    for index, case in enumerate(chosen):
        if progress is not None:
            progress(case.name, index / len(chosen))
        memory.restart_peak()
        start, cpu = time.perf_counter(), time.process_time()
        result = case.run()
        run: records.RunRecord = {
            "provenance": provenance.of_run(f"fem-check book {case.name}", packages=("matplotlib",)),
            "seconds": round(time.perf_counter() - start, 2),
            "cpu_seconds": round(time.process_time() - cpu, 2),
            "peak_memory_MB": round(memory.peak_MB()),
        }
        entries.append(records.record(case, result, run))
        if out is not None:
            records.write(entries[-1], out)
    return entries
