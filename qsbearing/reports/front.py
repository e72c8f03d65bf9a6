"""What a report opens with: how the case ended, its key results, all warnings, and what made it."""

from __future__ import annotations

from collections.abc import Sequence

from qsbearing.documents.model import Block, Cell, Facts, Md, Remark, Table
from qsbearing.model.validation import printable
from qsbearing.results import provenance
from qsbearing.results.tables import remarks


def head(message: str, key_results: Table, warnings: Sequence[str], command: str) -> list[Block]:
    """Before the contents.

    Args:
        message: how the case ended; it is solved.
        warnings: all of them, where nobody misses them.
        command: that makes the report.
    """
    said = remarks(warnings) or [Remark("No warnings.")]
    return [Remark(message, "pass"), key_results, *said, Facts(_facts(command))]


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
