"""What is said where a record is not there."""

from __future__ import annotations

from qsbearing.documents.model import Md, Remark


def missing(what: str, command: str) -> Remark:
    """A sentence that stands in the place of a record."""
    return Remark(Md(f"{what} is not on record here. `{command}` makes it."), "missing")
