"""The design report of a load spectrum: its life and its points, then the report of the point that does most damage."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from qsbearing.documents.model import Block, Callout, Document, Paragraph, Table
from qsbearing.documents.numbers import plain
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.spectrum_table import at_point, point_in_file
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.solution import Solution
from qsbearing.reports import document as of_scene
from qsbearing.reports import set_document
from qsbearing.results.readings_record import all_taken, taken
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
        blocks = set_spectrum_result(solution, readings)
    else:
        readings = [taken(solution)]
        blocks = spectrum_result(solution, readings[0])
    damage = np.max([np.nan_to_num(each["spectrum"].damage_share) for each in readings], axis=0)
    worst = int(np.argmax(damage))
    point = point_of(requested, worst)
    solved = solve(point)
    whole = (
        of_scene.document(solved, point, source, command)
        if isinstance(point, Scene)
        else set_document.document(solved, source, command)
    )
    part = f"{plain(100.0 * damage[worst], '.3g')} % of the damage" + (" of a row" if len(readings) > 1 else "")
    which = f"All results below are those of point {worst + 1}, which does {part}, more than any other point."
    lives = [Callout(each.text) for each in blocks if isinstance(each, Paragraph) and each.is_apart]
    points, warned = ([each for each in blocks if isinstance(each, kind)] for kind in (Table, Callout))
    first, second, *_ = (number for number, each in enumerate(whole.head) if isinstance(each, Callout))
    # Warnings of all points in the place of those of one.
    rest: list[Block] = [each for each in whole.head[second:] if not isinstance(each, Callout)]
    return replace(
        whole,
        summary=f"Life under a spectrum of {damage.size} operating points; loads, angles, contacts and stiffness at "
        "the point that does most damage, by the quasi-static model of Jones and Harris.",
        head=[*whole.head[:first], *lives, *points, Paragraph(which), *whole.head[first:second], *warned, *rest],
    )


def point_of(requested: Scene | BearingSet, number: int) -> Any:
    """One operating point as a scene or set of its own, without a spectrum."""
    tables = input_tables(requested)
    label = requested.name if isinstance(requested, BearingSet) else requested.bearing.name
    return scene_or_set_of(at_point(tables, point_in_file(tables["spectrum"][number])), label, label)
