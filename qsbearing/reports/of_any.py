"""The design report of whatever was solved."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from qsbearing.documents.model import Callout, Document
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.solution import Solution
from qsbearing.reports import document, set_document, spectrum
from qsbearing.studies.changed_keys import ChangedKey
from qsbearing.studies.chooser.choose_set import solve_any
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution


def document_of_any(
    solution: Solution | SetSolution,
    requested: Scene | BearingSet,
    source: str,
    command: str,
    changes: Sequence[ChangedKey] = (),
) -> Document:
    """The report of a bearing, of a set, or of either over a spectrum.

    Args:
        solution: converged.
        asked: the scene or set as it was given.
        source: the text of its file; empty for an example of the catalogue.
        command: that makes this report.
        changes: keys that have another value than in the file that was named.
    """
    made = _document(solution, requested, source, command)
    return replace(made, head=[*(Callout(f"Set: {each}.", lead="Set:") for each in changes), *made.head])


def _document(solution: Solution | SetSolution, requested: Scene | BearingSet, source: str, command: str) -> Document:
    if "spectrum" in requested.readings:
        return spectrum.document(solution, requested, solve_any, source, command)
    if isinstance(solution, Solution):
        assert isinstance(requested, Scene)
        return document.document(solution, requested, source, command)
    return set_document.document(solution, source, command)
