"""What there is to beware of at the point that a search found: the remarks that `run` gives of the same scene."""

from __future__ import annotations

from qsbearing import messages
from qsbearing.messages.bearing_set import warnings_by_rows
from qsbearing.model.ranked_warning import RankedWarning, in_order
from qsbearing.model.scene.scene import Scene
from qsbearing.results.readings_record import taken, warnings_of
from qsbearing.studies.chooser.choose import solve
from qsbearing.studies.design.find import Found
from qsbearing.systems.sets.solve import solve_set


def found_remarks(found: Found) -> list[RankedWarning]:
    """Of the scene or set with the values found; with those of its readings."""
    if isinstance(found.scene, Scene):
        solution = solve(found.scene)
        return in_order([*messages.warnings(solution), *warnings_of(taken(solution))])
    of_set = solve_set(found.scene)
    if of_set.shape:  # a load spectrum
        return messages.warnings(of_set)
    return warnings_by_rows(of_set, readings=[warnings_of(taken(row)) for row in of_set.rows])
