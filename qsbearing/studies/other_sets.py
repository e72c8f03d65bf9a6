"""What results may be where a bearing is given by its data sheet or its number: the ball set that fits best is solved,
and the range over the others stands beside it."""

from __future__ import annotations

from typing import Any

from qsbearing.documents.model import Block, Paragraph, Table
from qsbearing.files.ball_lists import Listed, said_of
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import SceneError
from qsbearing.results import remarks
from qsbearing.results.tables import digits_of
from qsbearing.studies.chooser.choose_set import solve_any
from qsbearing.studies.inferred import Ranged, ranges
from qsbearing.studies.results import read
from qsbearing.systems.sets.bearing_set import BearingSet

MOST_RESULTS = 24
"""Of a set, which has some hundred; the first in their usual order."""


def other_sets(of: Scene | BearingSet, lists: list[Listed]) -> list[Block]:
    """The range of the main results over all ball sets of each list, the others at their best.

    Args:
        of: of one operating point, with the best sets.
    """
    if "spectrum" in of.readings:
        return [Paragraph(each, is_apart=True) for each in said_of(lists)]
    blocks: list[Block] = []
    best = solve_any(of) if lists else None
    for each in lists:
        said = [warned.remark for warned in each.bearing.inferred.remarks]
        blocks += [Paragraph(f"{each}.", is_apart=True), *remarks.blocks(said), *_ranges(of, best, each)]
    return blocks


def ranges_of(of: Scene | BearingSet, each: Listed) -> list[Ranged]:
    """Those of its results that depend on the ball set; empty where they cannot be solved together."""
    try:
        solution = solve_any(each.in_place_of_one(of))
    except SceneError:  # of numbers for each ball of the best set
        return []
    wide = [ranged for ranged in ranges(solution, each.bearing.inferred) if ranged.is_wide]
    return wide if isinstance(solution, Solution) else wide[:MOST_RESULTS]


def other_sets_record(of: Scene | BearingSet, lists: list[Listed]) -> list[dict[str, Any]]:
    """Likewise as plain data: of each list its bearing, rows, number of sets, ranges, and the sets that make their
    ends."""
    record = []
    for each in lists:
        wide = [] if "spectrum" in of.readings else ranges_of(of, each)
        numbers = each.bearing.inferred.set_number
        record.append(
            {
                "bearing": each.bearing.name,
                "rows": [row + 1 for row in each.rows],
                "ball_sets": each.sets,
                "inferred": {ranged.key: [ranged.range.least, ranged.range.most] for ranged in wide},
                "inferred_ends": {ranged.key: [int(numbers[case]) + 1 for case in ranged.range[2:]] for ranged in wide},
            }
        )
    return record


def _ranges(of: Scene | BearingSet, best: Any, each: Listed) -> list[Block]:
    wide = ranges_of(of, each)
    if not wide:
        return []
    numbers = each.bearing.inferred.set_number
    solved = read(best, [ranged.place for ranged in wide])
    rows = [
        (
            ranged.place.name.replace("_", " "),
            printed_unit(ranged.place.unit),
            digits_of(float(solved[ranged.place.name])),
            *ranged.ends(numbers),
        )
        for ranged in wide
    ]
    over = f"all {each.sets} ball sets" if each.sets > 1 else "one ball set"
    title = f"Range over {over}, groove radii and clearances that {each.bearing.name or 'it'} allows"
    return [Table(("result", "", "solved", "least", "of set", "most", "of set"), rows, "llrrrrr", title)]
