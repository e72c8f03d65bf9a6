"""What a report opens with: how the case ended, its key results, all warnings, and what made it."""

from __future__ import annotations

from collections.abc import Sequence

from qsbearing.documents.model import Block, Cell, Facts, Md, Table
from qsbearing.documents.model import Remark as Shown
from qsbearing.model.validation import printable
from qsbearing.remarks.remark import Remark
from qsbearing.results import provenance
from qsbearing.results.remarks import blocks


def head(message: str, key_results: Table, said: Sequence[Remark], command: str) -> list[Block]:
    """Before the contents.

    Args:
        message: how the case ended; it is solved.
        said: all remarks, where nobody misses them.
        command: that makes the report.
    """
    shown = blocks(said) or [Shown("No warnings.")]
    return [Shown(message, "pass"), key_results, *shown, Facts(_facts(command))]


def _facts(command: str) -> list[tuple[str, Cell]]:
    made = provenance.of_run(command)
    machine = made["machine"]
    commit = made["commit"] or "none: an installed package"
    return [
        ("Date", made["date"]),
        ("qsbearing", made["qsbearing"]),
        ("Commit", commit + (", with changes that are not committed" if made["dirty"] else "")),
        ("Machine", f"{machine['processor']}, {machine['system']}, Python {machine['python']}"),
        ("Packages", ", ".join(f"{package} {version}" for package, version in made["packages"].items())),
        ("Command", Md(f"`{printable(command)}`")),
    ]
