"""The validation book: published cases, each with a record of the run that checks it.

A case is one file of `cases`. A run computes its numbers, compares them with the published ones and keeps a record;
the report's section and picture are formatted from the record alone.
"""

from __future__ import annotations

from fem_check.book.run import UnknownCaseError, run_book, selected

__all__ = ["UnknownCaseError", "run_book", "selected"]
