"""What commands say of a bearing that is a list of ball sets, of which they solve the best."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from qsbearing.cli.output import note

if TYPE_CHECKING:
    from qsbearing.documents.model import Block
    from qsbearing.model.scene.scene import Scene
    from qsbearing.systems.sets.bearing_set import BearingSet


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
