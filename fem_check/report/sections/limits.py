"""What is not claimed."""

from __future__ import annotations

from qsbearing.documents.model import Bullets, Section

LIMITS = (
    "Rings are rigid but for their contacts unless the effect elastic_rings describes them. A loose or thin housing "
    "lets the outer ring grow, which then matters more than all else.",
    "Raceway control is a hypothesis, and so is the friction that carries the gyroscopic moment; each result gives "
    "the friction coefficient that it needs.",
    "No lubricant film, cage force or friction loss acts on the balls. Temperatures are computed where a scene has "
    "[thermal], from its own conductances; no measured temperature was compared.",
    "Contacts are elastic: pressures beyond yield are computed and warned of, not refused.",
    "At speed a solution may not be unique, and convergence is not proved; a case that is not solved says so.",
    "Finite elements are no measurement. No published measurement was found that has contact angles at speed together "
    "with load and the whole geometry, groove radii included.",
    "Lives, films and friction are readings by published formulas, with the ranges of their sources.",
)


def section() -> Section:
    """Known limits."""
    return Section("Known limits", [Bullets(LIMITS)])
