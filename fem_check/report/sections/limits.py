"""What is not claimed."""

from __future__ import annotations

import re

from fem_check.report.evidence import Evidence
from qsbearing.documents.model import Bullets, Md, Section

SECTOR = "bearing_sector"

LIMITS = (
    "Rings are rigid but for their contacts unless the effect elastic_rings describes them. A loose or thin housing "
    "lets the outer ring grow: see [the sector with its outside diameter free](#check-bearing-sector), where that "
    "matters more than all else.",
    "Raceway control is a hypothesis, and so is the friction that carries the gyroscopic moment; each result gives "
    "the friction coefficient that it needs.",
    "No lubricant film, cage force or friction loss acts on the balls; temperatures are given, not computed.",
    "Contacts are elastic: pressures beyond yield are computed and warned of, not refused.",
    "At speed a solution may not be unique, and convergence is not proved; a case that is not solved says so.",
    "Finite elements are no measurement. No published measurement was found that has contact angles at speed together "
    "with load and the whole geometry, groove radii included.",
    "Lives, films and friction are readings by published formulas, with the ranges of their sources.",
)


def section(evidence: Evidence) -> Section:
    """Known limits."""
    limits = LIMITS if SECTOR in evidence.checks else [re.sub(r"\[(.*?)\]\(#.*?\)", r"\1", each) for each in LIMITS]
    return Section("Known limits", [Bullets([Md(each) for each in limits])])
