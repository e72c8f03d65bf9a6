"""What is said where a record is not there."""

from __future__ import annotations

from fem_check.report.evidence import needs_checkout
from qsbearing.documents.model import Md, Remark


def missing(what: str, command: str) -> Remark:
    """A sentence that stands in the place of a record."""
    where = ", in a checkout of the repository" if needs_checkout(command) else ""
    return Remark(Md(f"{what} is not on record here. `{command}` makes it{where}."), "missing")
