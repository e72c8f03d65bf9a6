"""The design report of a load spectrum: its life and its points, then the report of the point that does most damage."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from qsbearing.documents.model import Callout, Document, Paragraph, Table
from qsbearing.documents.numbers import plain
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.spectrum_table import at_point, point_in_file
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.solution import Solution
from qsbearing.reports import document as of_scene
from qsbearing.reports import set_document
from qsbearing.reports.answers_table import required_first
from qsbearing.reports.front import OfAllPoints
from qsbearing.results.readings_record import all_taken, taken
from qsbearing.results.requirements import required_answers
from qsbearing.results.set_spectrum_report import set_spectrum_result
from qsbearing.results.spectrum_report import spectrum_result
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution


def document(
    solution: Solution | SetSolution,
    requested: Scene | BearingSet,
    solve: Callable[[Scene | BearingSet], Any],
    source: str,
    command: str,
) -> Document:
    """The whole report.

    Args:
        solution: of all operating points, converged.
        asked: the scene or set as it was given.
        solve: solves a scene or set of one operating point.
        source: the text of its file.
        command: that makes this report.
    """
    if isinstance(solution, SetSolution):
        readings = all_taken(solution)
        blocks, required = set_spectrum_result(solution, readings), required_answers(solution, readings)
    else:
        readings = [taken(solution)]
        blocks, required = spectrum_result(solution, readings[0]), required_answers(solution, readings[0])
    damage = np.max([np.nan_to_num(each["spectrum"].damage_share) for each in readings], axis=0)
    worst = int(np.argmax(damage))
    point = point_of(replace(requested, require=()), worst)  # what is required holds of all points
    solved = solve(point)
    part = f"{plain(100.0 * damage[worst], '.3g')} % of the damage" + (" of a row" if len(readings) > 1 else "")
    which = f"All that follows is of point {worst + 1}, which does {part}, more than any other point."
    lives = [Callout(each.text) for each in blocks if isinstance(each, Paragraph) and each.is_apart]
    points = [replace(each, stack=True) for each in blocks if isinstance(each, Table)]
    warned = [each for each in blocks if isinstance(each, Callout)]
    of_all = OfAllPoints(required_first(required, solution), [*lives, *points, Paragraph(which)], warned)
    whole = (
        of_scene.document(solved, point, source, command, of_all)
        if isinstance(point, Scene)
        else set_document.document(solved, source, command, of_all)
    )
    return replace(
        whole,
        summary=f"Life under a spectrum of {damage.size} operating points; loads, angles, contacts and stiffness at "
        "the point that does most damage, by the quasi-static model of Jones and Harris.",
    )


def point_of(requested: Scene | BearingSet, number: int) -> Any:
    """One operating point as a scene or set of its own, without a spectrum."""
    tables = input_tables(requested)
    label = requested.name if isinstance(requested, BearingSet) else requested.bearing.name
    return scene_or_set_of(at_point(tables, point_in_file(tables["spectrum"][number])), label, label)
