"""The design report of a scene: its parts in their order."""

from __future__ import annotations

from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Block, Columns, Document, Section
from qsbearing.model.accuracy import DEFAULT_ACCURACY
from qsbearing.model.scene.arched_rings import IN_RUN, refuse_arched
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.solution import Solution
from qsbearing.pictures import ball_advance, contact_angles, contact_ellipses, ellipse_on_groove, load_distribution
from qsbearing.pictures.style import carry_alike
from qsbearing.remarks.of_solution import message
from qsbearing.remarks.wording import capital
from qsbearing.reports import curves, effects, evidence, heat, inputs
from qsbearing.reports.facts import facts_of
from qsbearing.reports.front import OfAllPoints, front, glance, made_with, remarks
from qsbearing.reports.layout import half, side_by_side
from qsbearing.results import report
from qsbearing.results.readings_record import taken
from qsbearing.results.readings_report import readings_tables
from qsbearing.results.remarks import every_remark
from qsbearing.results.requirements import answered
from qsbearing.studies.chooser.explain import explain


def document(
    solution: Solution, requested: Scene, source: str, command: str, of_all: OfAllPoints | None = None
) -> Document:
    """The whole report of one solved case.

    Args:
        solution: of a single case, converged.
        asked: the scene as it was given.
        source: the text of its file; empty for an example of the catalogue.
        command: that makes this report.
        of_all: where the case is one point of a load spectrum.
    """
    scene = solution.scene
    refuse_arched(scene.bearing, "`report`", IN_RUN)
    report_of, name = inputs.document(source).get("report", {}), scene.bearing.name or "Ball bearing"
    title, bearing = report_of.get("title", name), report.geometry_text(solution)
    bearing = bearing if title == name else f"{name}: {bearing}"
    tolerance = requested.tolerance or DEFAULT_ACCURACY
    readings, checks = taken(solution), evidence.statements([solution])
    _, rows = explain(scene, tolerance)
    point = ". ".join(filter(None, (report.speeds_text(solution), capital(report.loads_text(solution)))))
    said, swept = every_remark(solution, readings), curves.over_speed(solution)
    hot = heat.sections(solution)
    page_one = front(
        report_of, answered(solution, readings), said, heat.glance(solution.thermal) or glance(solution),
        [effects.left_out(rows, tolerance, solution.friction is not None)], None if hot else swept,
        facts_of(solution, readings), evidence.in_short(checks), solution, of_all,
    )  # fmt: skip
    return Document(
        title,
        "Design report",
        [
            remarks(said, of_all),
            _results(solution),
            *hot,
            *([Section("Readings", side_by_side(readings_tables(readings, scene)))] if readings else []),
            curves.section(solution, swept),
            effects.section(solution, requested, rows, tolerance),
            inputs.section(scene, source, requested.thermal),
            evidence.section(checks, "scene"),
            made_with(message(solution), command),
        ],
        f"{capital(bearing)}. {point}.",
        page_one,
        has_front_page=True,
    )


def _results(solution: Solution) -> Section:
    """Tables and pictures; what page 1 shows is not shown again."""
    are_alike, is_hot = carry_alike(solution, ()), solution.thermal is not None
    drawn: list[Block] = [glance(solution).blocks[0]] if is_hot else []
    grooves = half(
        ellipse_on_groove(solution),
        "The contact ellipse of the most loaded ball on each groove, with the edges of its shoulders.",
        "The most loaded ellipse of each ring, seen along its normal; dark: shoulders; dash-dot: the groove's bottom",
    )
    if are_alike:
        drawn.append(Columns([[grooves], []]))
    else:  # else all is the same around the bearing
        angles = half(
            contact_angles(solution),
            "Both contact angles of every ball by its azimuth.",
            "Contact angles by azimuth; the dotted line is the free contact angle",
        )
        drawn.append(Columns([[angles], [grooves]]))
        drawn.append(
            picture(
                contact_ellipses(solution),
                "Outlines of the contact ellipses to one scale, with their maximum pressures.",
                "Contact ellipses of the balls, with their maximum pressures",
            )
        )
    if "ball_advance" in solution.scene.readings and not are_alike:
        drawn.append(
            picture(
                ball_advance(solution),
                "How far a ball is ahead of its mean place in the cage, by its azimuth.",
                "Advance of the balls in the cage over one turn; grey: the clearance of its pockets",
            )
        )
    if solution.scene.elastic_rings is not None and not are_alike:
        drawn.append(
            picture(
                load_distribution(solution),
                "Polar picture of the contact loads of all balls around the bearing.",
                "Contact loads by the azimuth of each ball, 0 deg on the y axis",
            )
        )
    pictures = [Section("Pictures", drawn)] if drawn else []
    return Section("Results", [*side_by_side(report.tables(solution)), *pictures])
