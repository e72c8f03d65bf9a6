"""What commands say of a bearing that is a list of ball sets, of which they solve the best."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from qsbearing.cli.output import note

if TYPE_CHECKING:
    from qsbearing.documents.model import Block
    from qsbearing.model.scene.scene import Scene
    from qsbearing.systems.sets.bearing_set import BearingSet


_STANDARD_INPUT: list[dict[str, Any]] = []
"""Its tables, which can be read once."""


def remember(source: str, document: dict[str, Any]) -> None:
    """Keep the tables of standard input."""
    from copy import deepcopy

    from qsbearing.files.raw import STANDARD_INPUT

    if source in STANDARD_INPUT:
        _STANDARD_INPUT[:] = [deepcopy(document)]


def document_at(source: str) -> dict[str, Any]:
    """The tables of a source that was read already."""
    import warnings

    from qsbearing.files.raw import STANDARD_INPUT
    from qsbearing.files.scene_file import document_of

    if source in STANDARD_INPUT:
        return _STANDARD_INPUT[0] if _STANDARD_INPUT else {}
    with warnings.catch_warnings(action="ignore"):  # which it gave when it was read
        return document_of(source, True)[0]


def blocks_of_lists(document: dict[str, Any], of: Scene | BearingSet | None) -> list[Block]:
    """The range of results over the other ball sets; empty where no bearing is a list.

    Args:
        of: what is solved, of one operating point; None: there is no such.
    """
    from qsbearing.files.ball_lists import listed_in, said_of

    if not (lists := listed_in(document)):
        return []
    from qsbearing.documents.model import Paragraph
    from qsbearing.studies.other_sets import other_sets

    return [Paragraph(each) for each in said_of(lists)] if of is None else other_sets(of, lists)


def note_of_lists(document: dict[str, Any]) -> None:
    """Which set is solved, where standard output holds data alone."""
    from qsbearing.files.ball_lists import listed_in, said_of

    for each in said_of(listed_in(document)):
        note(each)
