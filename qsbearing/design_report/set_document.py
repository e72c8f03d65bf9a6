"""The design report of a set: its parts in their order."""

from __future__ import annotations

import re
from collections.abc import Sequence

from qsbearing import messages
from qsbearing.design_report import effects, evidence, heat, set_curves, set_inputs
from qsbearing.design_report.front import head
from qsbearing.design_report.key_results import key_results_of_set
from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Block, Bullets, Document, Section
from qsbearing.io import report, set_report
from qsbearing.io.readings_record import Readings, taken, warnings_of
from qsbearing.io.readings_report import readings_tables
from qsbearing.io.tables import remarks
from qsbearing.messages.bearing_set import capital, row_name, warnings_of_set
from qsbearing.pictures import contact_angles, contact_ellipses, deformed_shaft, load_distribution
from qsbearing.ranked_warning import Rank, RankedWarning, in_order, ranked, said_of
from qsbearing.sets.preload_limits import Limits, limits, preload_summary
from qsbearing.sets.set_solution import SetSolution


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
    warnings = _warnings(solution, found)
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
        head(solution.message(), key_results_of_set(solution, found), warnings, command),
    )


NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[+-]?\d+)?")


def _warnings(solution: SetSolution, found: Sequence[Readings]) -> list[RankedWarning]:
    """All warnings; what is said of several rows, but for its numbers, stands once, with the rows and their range."""
    of_rows: dict[tuple[str, Rank, str], dict[int, RankedWarning]] = {}
    for number, (row, of_row) in enumerate(zip(solution.rows, found, strict=True)):
        for each in map(ranked, [*messages.warnings(row), *warnings_of(of_row)]):
            of_rows.setdefault((NUMBER.sub("", each), each.rank, each.see), {})[number] = each
    said = warnings_of_set(solution)
    for each_of in of_rows.values():
        rows, sentence = list(each_of), next(iter(each_of.values()))
        which = _name(solution, rows[0]) if len(rows) == 1 else _rows(rows)
        said.append(said_of(which, RankedWarning(_in_ranges(list(each_of.values())), sentence.rank, sentence.see)))
    return in_order(said)


def _in_ranges(sentences: Sequence[str]) -> str:
    """Sentences that differ in their numbers as one: where they do, the smallest and the largest."""
    numbers = iter([sorted(set(each), key=float) for each in zip(*map(NUMBER.findall, sentences), strict=True)])

    def both(_: re.Match[str]) -> str:
        each = next(numbers)
        return each[0] if len(each) == 1 else f"{each[0]} to {each[-1]}"

    return NUMBER.sub(both, sentences[0])


def _rows(rows: Sequence[int]) -> str:
    first, last = ", ".join(str(row + 1) for row in rows[:-1]), rows[-1] + 1
    return f"Rows {first} and {last}"


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
    if solution.set.shaft is not None:
        said = "The shaft's outline as drawn and as it bends, with bearings, loads and named points."
        drawn.insert(
            0,
            picture(
                deformed_shaft(solution),
                said,
                "The shaft as drawn (grey) and as it bends (black), the deflection enlarged by the factor in its title",
            ),
        )
    parts: list[Block] = [
        Section("Preload", [Bullets(preload_summary(solution, changes))]),
        Section("Load distribution", drawn),
    ]
    return Section("Results", [*set_report.tables(solution, found), *parts])


def _row(solution: SetSolution, number: int, found: Readings) -> Section:
    row = solution.rows[number]
    drawn = picture(
        contact_ellipses(row),
        f"Outlines of the contact ellipses of row {number + 1} to one scale, with their maximum pressures.",
        f"Contact ellipses of row {number + 1}; loads are those of the row alone, in the direction that it carries",
    )
    said = remarks(messages.warnings(row))
    return Section(
        _name(solution, number),
        [*said, *report.tables_of_balls(row), drawn, *readings_tables(found)],
        f"row-{number + 1}",
    )
