"""What a report opens with: how the case ended, how many warnings there are, and what made it; and the warnings."""

from __future__ import annotations

from collections.abc import Sequence

from qsbearing import provenance
from qsbearing.documents.model import Block, Cell, Facts, Md, Paragraph, Remark, Section


def head(message: str, residual: float, warnings: Sequence[str], command: str) -> list[Block]:
    """Before the contents.

    Args:
        message: how the case ended; it is solved.
        residual: the largest imbalance over the largest force.
        command: that makes the report.
    """
    return [Remark(message, "pass"), *_count(warnings), Facts(_facts(command, residual))]


def _count(warnings: Sequence[str]) -> list[Block]:
    if not warnings:
        return []
    what = "One warning" if len(warnings) == 1 else f"{len(warnings)} warnings"
    return [Remark(Md(f"{what}, see [below](#warnings)."), "warning")]


def _facts(command: str, residual: float) -> list[tuple[str, Cell]]:
    made = provenance.of_run(command)
    machine = made["machine"]
    commit = made["commit"] or "none: an installed package"
    return [
        ("Date", made["date"]),
        ("qsbearing", made["qsbearing"]),
        ("Commit", commit + (", with changes that are not committed" if made["dirty"] else "")),
        ("Machine", f"{machine['processor']}, {machine['system']}, Python {machine['python']}"),
        ("Packages", ", ".join(f"{package} {version}" for package, version in made["packages"].items())),
        ("Command", Md(f"`{command}`")),
        ("Largest imbalance", f"{residual:.1e} of the largest force"),
    ]


def warnings_section(warnings: Sequence[str]) -> Section:
    """All of them."""
    blocks: list[Block] = [Remark(each, "warning") for each in warnings]
    return Section("Warnings", blocks or [Paragraph("None.")])
