"""The design report of a set: its parts in their order."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Block, Bullets, Document, Section
from qsbearing.files.file_keys import BALL_TABLES, ShownBalls
from qsbearing.model.accuracy import DEFAULT_ACCURACY
from qsbearing.model.units import mm, rpm
from qsbearing.pictures import contact_angles, ellipse_on_groove
from qsbearing.remarks.wording import capital, listed
from qsbearing.reports import effects, evidence, heat, inputs, set_curves, set_inputs
from qsbearing.reports.facts import facts_of_set
from qsbearing.reports.front import OfAllPoints, front, glance, made_with, remarks
from qsbearing.reports.layout import side_by_side, untitled
from qsbearing.reports.set_rows import rows_sections
from qsbearing.reports.yields import what_yields
from qsbearing.results import report, set_report
from qsbearing.results.readings_record import Readings, all_taken
from qsbearing.results.remarks import every_remark
from qsbearing.results.requirements import answered
from qsbearing.results.set_key_results import rows_table
from qsbearing.studies.chooser.explain_set import explain_set
from qsbearing.systems.sets.preload_limits import Limits, limits, preload_summary
from qsbearing.systems.sets.set_solution import SetSolution


def document(solution: SetSolution, source: str, command: str, of_all: OfAllPoints | None = None) -> Document:
    """The whole report of one solved case of a set.

    Args:
        solution: of a single case, converged.
        source: the text of the set's file.
        command: that makes this report.
        of_all: where the case is one point of a load spectrum.
    """
    of, report_of = solution.set, inputs.document(source).get("report", {})
    readings = all_taken(solution)
    changes, checks = limits(of), evidence.statements(solution.rows, of)
    _, effect_rows = explain_set(of, DEFAULT_ACCURACY)
    said, swept = every_remark(solution, readings), set_curves.over_speed(of)
    hot = heat.sections(solution)
    page_one = front(
        report_of, answered(solution, readings), said, heat.glance(solution.thermal) or glance(solution),
        [what_yields(solution), effects.left_out(effect_rows, DEFAULT_ACCURACY)], None if hot else swept,
        facts_of_set(solution, readings), evidence.in_short(checks), solution, of_all,
    )  # fmt: skip
    return Document(
        report_of.get("title", f"{of.name or 'Bearing set'}, {of.arrangement}"),
        "Design report of a set",
        [
            remarks(said, of_all),
            _results(solution, readings, changes),
            *hot,
            *rows_sections(solution, readings, report_of.get(BALL_TABLES) == ShownBalls.EACH),
            set_curves.section(of, changes, swept),
            effects.section_of_set(solution, effect_rows),
            set_inputs.section(of, source, None if solution.thermal is None else solution.thermal.thermal),
            evidence.section(checks, "set"),
            made_with(solution.message(), command),
        ],
        _summary(solution),
        page_one,
        has_front_page=True,
    )


def _summary(solution: SetSolution) -> str:
    """Its rows, speed and loads."""
    of = solution.set
    bearings = listed(dict.fromkeys(row.bearing.name or "bearing" for row in of.rows))
    count = "1 row" if len(of.rows) == 1 else f"{len(of.rows)} rows"
    turning = f"{float(np.asarray(of.operation.speed)) / rpm:.6g} rpm{report.outer_turning(of.operation.outer_speed)}"
    said = [f"{count} of {bearings}", f"Shaft {turning}"]
    said.append(capital(report.loads_text(solution)))
    for load in of.shaft_loads:
        values = report.named_loads(float(np.asarray(value)) for value in load.values)
        said.append(f"At x = {load.position / mm:.6g} mm: {values}")
    return ". ".join(filter(None, said)) + "."


def _results(solution: SetSolution, readings: Sequence[Readings], changes: Limits) -> Section:
    """Tables, and what page 1 does not show."""
    tables = [rows_table(solution, readings), *set_report.tables(solution, readings)]
    drawn = [glance(solution).blocks[0]] if solution.thermal is not None else []
    angles = picture(
        untitled(contact_angles(solution)),
        "Both contact angles of every ball by its azimuth, for each row.",
        "Contact angles of each ball by its azimuth, for each row; the dotted line is the free contact angle",
    )
    # Of more rows than a pair it takes half a page, and `run --picture ellipse_on_groove` draws it.
    grooves = [_grooves(solution)] if len(solution.rows) <= 2 else []
    parts: list[Block] = [
        Section("Preload", [Bullets(preload_summary(solution, changes))]),
        Section("Load distribution", [*drawn, angles, *grooves]),
    ]
    return Section("Results", [*side_by_side(tables), *parts])


def _grooves(solution: SetSolution) -> Block:
    return picture(
        ellipse_on_groove(solution),
        "The contact ellipse of the most loaded ball on each groove of each row, with the edges of its shoulders.",
        "The most loaded ellipse of each ring of each row, seen along its normal; dark: shoulders; dash-dot: the "
        "groove's bottom",
    )
