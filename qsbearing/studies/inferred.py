"""What a data sheet makes of a scene: results as ranges over its ball sets, and what one more number would remove."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.model import Block, Paragraph, Table
from qsbearing.inference.ball_sets import INCH_SIZES, fills_of
from qsbearing.inference.infer import InferredBearing
from qsbearing.inference.narrowing import Range
from qsbearing.inference.practice import RatingPractice
from qsbearing.inference.ratings_fit import BALLS_GIVEN
from qsbearing.model.solution.result_keys import Place, printed_unit
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import mm
from qsbearing.remarks.kinds import CHECK, Kind
from qsbearing.remarks.remark import Remark, in_order, remark
from qsbearing.results.remarks import blocks, every_remark
from qsbearing.results.tables import digits_of
from qsbearing.studies.design.compare import main_results
from qsbearing.studies.results import known_results, read
from qsbearing.systems.sets.set_solution import SetSolution

OTHER_NUMBERS = {"pair_rigidity": "rigidity", "ball_count": "Z", "ball_diameter": "D", "diametral_clearance": "Pd"}
"""By which one more number is called in a heading."""
OTHER_WORDS = {
    "pair_rigidity": "the axial rigidity of a pair at its preload",
    "ball_count": "the ball count Z",
    "ball_diameter": "the ball diameter D",
    "diametral_clearance": "the diametral clearance Pd",
}
OPERATING_CLEARANCE = "operating_diametral_clearance"
SAME = 1e-9
"""Part of a value below which a range is rounding."""

SHEET_NOT_SOLVED = Kind(
    "sheet_not_solved", CHECK, "data_sheet",
    "{unsolved} of the {bearings} bearings that the data sheet allows are not solved, and in no range",
)  # fmt: skip


class Ranged(NamedTuple):
    """A result, over all bearings."""

    place: Place
    range: Range
    removed: dict[str, float]
    """Part of the range that one more number would remove, by its name."""

    @property
    def key(self) -> str:
        """With its unit."""
        return self.place.column

    @property
    def words(self) -> str:
        """As people read it."""
        return self.place._replace(group=self.place.group._replace(before="")).name.replace("_", " ")

    def ends(self, numbers: NDArray) -> tuple[str, str, str, str]:
        """The least and the ball set that makes it, the most and that set, of the sets' numbers from 0."""
        least, most = map(digits_of, self.range[:2])
        return least, str(numbers[self.range.least_case] + 1), most, str(numbers[self.range.most_case] + 1)

    @property
    def is_wide(self) -> bool:
        """Whether there is more than rounding."""
        return self.range.width > SAME * max(abs(self.range.least), abs(self.range.most))


def ranges(solution: Solution | SetSolution, inferred: InferredBearing) -> list[Ranged]:
    """The main results and every number of the readings, of a solution over the bearings of a data sheet."""
    kept = _of_clearance(solution, inferred) | main_results(solution)
    solved = np.asarray(solution.converged)
    out = []
    for name, values in read(solution, kept.values()).items():
        values = np.where(solved, np.broadcast_to(values, solved.shape), np.nan)
        if np.isfinite(values).any() and np.nanmax(np.abs(values)) > 0.0:
            each = Ranged(kept[name], inferred.range_of(values), inferred.shares_removed(values))
            out.append(each)
    return out


def _of_clearance(solution: Solution | SetSolution, inferred: InferredBearing) -> dict[str, Place]:
    """The clearance in operation of a bearing whose clearance is given, where fits or heat change it."""
    is_changed = isinstance(solution, Solution) and bool(solution.scene.ring_effects)
    every = known_results(solution) if is_changed and inferred.sheet.clearances else {}
    return {name: place for name, place in every.items() if name == OPERATING_CLEARANCE}


def said(solution: Solution) -> list[Remark]:
    """What to beware of, in the list itself and in the results of its bearings."""
    bearings, unsolved = solution.converged.size, int((~solution.converged).sum())
    lost = [remark(SHEET_NOT_SOLVED, unsolved=unsolved, bearings=bearings)] if unsolved else []
    of_list = [each.remark for each in solution.scene.bearing.inferred.remarks]
    return in_order([*of_list, *lost, *map(_of_bearings, every_remark(solution))])


def _of_bearings(each: Remark) -> Remark:
    """The cases are the bearings of the list."""
    cases = each.of.cases and replace(each.of.cases, what="bearings of the list")
    return replace(each, of=replace(each.of, cases=cases))


def inferred_record(solution: Solution) -> dict[str, Any]:
    """The ranges as plain data: `inferred`, and beside it the sets, which of them make the ends, and the shares."""
    inferred: InferredBearing = solution.scene.bearing.inferred
    every = ranges(solution, inferred)
    numbers = inferred.set_number
    return {
        "inferred": {each.key: [each.range.least, each.range.most] for each in every},
        "inferred_ends": {each.key: [int(numbers[case]) + 1 for case in each.range[2:]] for each in every},
        "inferred_share_removed": {each.key: each.removed for each in every},
        "ball_sets": [
            {
                "number": int(numbers[case]) + 1,
                "ball_count": int(count),
                "ball_diameter_mm": float(f"{diameter / mm:.10g}"),
                "groove_radius_coefficient": [float(f"{f:.6g}") for f in (least, most)],
                "misfit": float(inferred.misfit[case]),
                "rating_practice": str(inferred.practice[case]),
            }
            for case, count, diameter, least, most in _sets(inferred)
        ],
    }


def _sets(inferred: InferredBearing) -> list[tuple[int, float, float, float, float]]:
    """First case, ball count, ball diameter and f of each set."""
    bearing: Any = inferred.bearing
    f: NDArray = bearing.inner_groove_radius / bearing.ball_diameter
    cases = [np.flatnonzero(inferred.set_number == number) for number in np.unique(inferred.set_number)]
    return [(c[0], bearing.ball_count[c[0]], bearing.ball_diameter[c[0]], f[c].min(), f[c].max()) for c in cases]


def _only_one(inferred: InferredBearing) -> str:
    """What bounds the list of one set."""
    sheet = inferred.sheet
    diameter = float(np.ravel(inferred.bearing.ball_diameter)[0])
    if inferred.practice[0] == BALLS_GIVEN:
        return "The balls are given."
    if sheet.ball_count is not None and sheet.ball_diameter is not None:
        return "The balls are given; the ratings agree with them."
    if inferred.practice[0] == RatingPractice.PROPORTIONS:
        return "Only one set is usual in this series."
    least, most = fills_of(sheet)
    sizes = f", {'inch' if np.isclose(INCH_SIZES, diameter).any() else 'mm'} sizes" * (sheet.ball_diameter is None)
    return f"Only one set fits within these bounds: fill {100.0 * least:.0f} to {100.0 * most:.0f} %{sizes}."


def inferred_tables(solution: Solution) -> list[Block]:
    """The ranges and the sets for people."""
    inferred: InferredBearing = solution.scene.bearing.inferred
    every, numbers = ranges(solution, inferred), inferred.set_number
    others = [name for name in OTHER_NUMBERS if any(name in each.removed for each in every)]
    heading = ("inferred", "", "least", "of set", "most", "of set", *(f"{OTHER_NUMBERS[name]}\n%" for name in others))
    rows = []
    for each in (each for each in every if each.is_wide):
        removed = [f"{100.0 * each.removed[name]:.0f}" for name in others]
        rows.append((each.words, printed_unit(each.place.unit), *each.ends(numbers), *removed))
    sets = [
        (
            str(number),
            f"{count:.0f}",
            f"{diameter / mm:.4g}",
            f"{least:.4f} to {most:.4f}",
            f"{inferred.misfit[case]:.2g}",
            inferred.practice[case].replace("_", " "),
        )
        for number, (case, count, diameter, least, most) in enumerate(_sets(inferred), 1)
    ]
    title = (
        f"{inferred.bearing.name or 'Bearing'} from its data sheet: {len(sets)} ball set{'s' if len(sets) > 1 else ''}"
    )
    columns = ("set", "Z", "D\nmm", "f", "misfit", "ratings read as")
    numbers_known = ", ".join(OTHER_WORDS[name] for name in others)
    several = "The list holds every set that the ratings allow; the first, which fits best, often is not the true one."
    note = (
        several if len(sets) > 1 else _only_one(inferred)
    ) + f" In %: what part of a range goes, on average, if one more number is known: {numbers_known}." * bool(others)
    result = "Results: least and most over all sets and their groove radii"
    return [
        Table(columns, sets, "rrrrrl", title),
        Table(heading, rows, "llrrrr" + "r" * len(others), result),
        Paragraph(note, is_apart=True),
        *blocks(said(solution), is_apart=True),
    ]
