"""Which picture a record has numbers for, with the words for those who do not see it."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from fem_check.report.figures import contact, sector, series, shares
from fem_check.report.figures.style import INCHES
from fem_check.rows.record import Record
from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Picture


class RecordFigure(NamedTuple):
    """What draws a picture, its caption, and what it shows."""

    draw: Callable[[Record], Figure]
    caption: str
    alt: str


DRAWN = {
    "bearing_sector": RecordFigure(
        sector.displacement,
        "One ball between two elastic rings, at speed: axial displacement of the elements minus the model's",
        "Difference of the axial displacement over the axial load: large with the outside diameter free, small with it "
        "rigid or with elastic rings in the model.",
    ),
    "true_geometry": RecordFigure(
        series.true_geometry,
        "True bodies, their own compliance left out: deviation from Hertz against the load",
        "Deviation of approach, semi-axes and pressure from Hertz over the load, for the exact gap and true bodies.",
    ),
    "conformity": RecordFigure(
        series.conformity,
        "Worst deviation of approach, a, b and p0 from Hertz, a line for each groove radius. Dotted lines: 1 and 5 %",
        "Worst deviation from Hertz over the load, one line for each groove radius: the smaller, the larger.",
    ),
    "convergence": RecordFigure(
        series.convergence,
        "Errors against the element size: mean over the positions of the mesh (solid), worst single position (dotted)",
        "Errors of four quantities falling with the element size, in double logarithms.",
    ),
    "body_size": RecordFigure(
        series.body_size,
        "Approach of clamped boxes against their inverse size",
        "Approach against the inverse size of the box: a straight line to the value with the exact far field.",
    ),
    "load_series": RecordFigure(
        series.load_series,
        "Deviation of the finite elements from Hertz against the load, with one mesh for all loads",
        "Deviation of five quantities from Hertz over the load, level: one mesh serves every load.",
    ),
    "contact": RecordFigure(
        contact.pressure_map,
        "Contact pressure over the ellipse, smoothed between the nodes of the mesh; Hertz's edge (black line)",
        "Map of the contact pressure: elliptic contours, highest in the middle, ending at Hertz's outline.",
    ),
}
SHARES = RecordFigure(
    shares.draw,
    "Deviation and uncertainty together, over the limit of the row: points left of the line pass",
    "For each quantity a point for each row: which part of its limit deviation and uncertainty take.",
)
"""Of a record that has numbers for none of these pictures."""


def drawing_of(entry: Record) -> RecordFigure:
    """What the record has numbers for."""
    return next((drawing for key, drawing in DRAWN.items() if key in entry["pictures"]), SHARES)


def one(entry: Record) -> list[Picture]:
    """The picture of a record's card; none where it has neither numbers for one nor a limit."""
    drawing = drawing_of(entry)
    if drawing is SHARES and not shares.drawable(entry["rows"]):
        return []
    figure = drawing.draw(entry)
    image = picture(figure, drawing.alt, drawing.caption, min(1.0, figure.get_size_inches()[0] / INCHES))
    plt.close(figure)
    return [image]
