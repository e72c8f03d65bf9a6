"""The design report of a set: its parts in their order."""

from __future__ import annotations

from collections.abc import Sequence

from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Block, Bullets, Document, Section
from qsbearing.pictures import contact_angles, contact_ellipses, deformed_shaft, load_distribution
from qsbearing.remarks.remark import row_name
from qsbearing.remarks.wording import capital
from qsbearing.reports import effects, evidence, heat, set_curves, set_inputs
from qsbearing.reports.front import head
from qsbearing.reports.key_results import key_results_of_set
from qsbearing.results import report, set_report
from qsbearing.results.readings_record import Readings, taken
from qsbearing.results.readings_report import readings_tables
from qsbearing.results.remarks import every_remark
from qsbearing.systems.sets.preload_limits import Limits, limits, preload_summary
from qsbearing.systems.sets.set_solution import SetSolution


def document(solution: SetSolution, source: str, command: str) -> Document:
    """The whole report of one solved case of a set.

    Args:
        solution: of a single case, converged.
        source: the text of the set's file.
        command: that makes this report.
    """
    of = solution.set
    found = [taken(row) for row in solution.rows]
    changes = limits(of)
    return Document(
        f"{of.name or 'Bearing set'}, {of.arrangement}",
        "Design report of a set",
        [
            set_inputs.section(of, source, None if solution.thermal is None else solution.thermal.thermal),
            effects.section_of_set(solution),
            _results(solution, found, changes),
            *heat.sections(solution.thermal),
            *(_row(solution, number, of_row) for number, of_row in enumerate(found)),
            set_curves.section(of, changes),
            evidence.section(solution.rows, of),
        ],
        "Loads, angles, contacts and stiffness of rows of balls on one shaft, at one operating point, "
        "by the quasi-static model of Jones and Harris.",
        head(solution.message(), key_results_of_set(solution, found), every_remark(solution, found), command),
    )


def _name(solution: SetSolution, number: int) -> str:
    return capital(row_name(solution.set.rows[number], number))


def _results(solution: SetSolution, found: Sequence[Readings], changes: Limits) -> Section:
    drawn: list[Block] = [
        picture(
            load_distribution(solution),
            "Polar pictures of the contact loads of all balls around the bearing, one for each row.",
            "Contact load of each ball around the bearing, for each row, all to one scale",
        ),
        picture(
            contact_angles(solution),
            "Both contact angles of every ball by its azimuth, for each row.",
            "Contact angles of each ball by its azimuth, for each row; the dotted line is the free contact angle",
        ),
    ]
    shaft: list[Block] = []
    if solution.set.shaft is not None and solution.set.shaft.sections:
        said = "The shaft's outline as drawn and as it bends, with bearings, loads and named points."
        shaft.append(
            picture(
                deformed_shaft(solution),
                said,
                "The shaft as drawn (grey) and as it bends (black), the deflection enlarged by the factor in its title",
            )
        )
    tables = set_report.tables(solution, found, shaft)
    parts: list[Block] = [
        Section("Preload", [Bullets(preload_summary(solution, changes))]),
        Section("Load distribution", drawn),
    ]
    return Section("Results", [*tables, *parts])


def _row(solution: SetSolution, number: int, found: Readings) -> Section:
    row = solution.rows[number]
    heat = None if solution.thermal is None else solution.thermal.thermal
    drawn = picture(
        contact_ellipses(row),
        f"Outlines of the contact ellipses of row {number + 1} to one scale, with their maximum pressures.",
        f"Contact ellipses of row {number + 1}; loads are those of the row alone, in the direction that it carries",
    )
    return Section(
        _name(solution, number),
        [*report.tables_of_balls(row, heat), drawn, *readings_tables(found, row.scene)],
        f"row-{number + 1}",
    )
