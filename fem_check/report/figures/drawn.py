"""Which picture a record has numbers for, with the words for those who do not see it."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from fem_check.report.figures import contact, sector, series
from fem_check.report.figures.style import INCHES, Entry
from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Picture


class Drawing(NamedTuple):
    """What draws a picture, its caption, and what it shows."""

    draw: Callable[[Entry], Figure]
    caption: str
    alt: str


DRAWN = {
    "contact": Drawing(
        contact.pressure_map,
        "Contact pressure over the ellipse: highest in the middle, zero at Hertz's edge (black line); smoothed "
        "between the nodes of the mesh",
        "Map of the contact pressure: elliptic contours, highest in the middle, ending at Hertz's outline.",
    ),
    "contact profiles": Drawing(
        contact.profiles,
        "Pressure along both axes, at the nodes of all positions of the mesh. Near the edge Hertz's pressure falls "
        "without bound in its slope, which a pressure linear between the nodes cannot follow: single values there are "
        "off by up to a tenth of p0. The check compares approach, semi-axes and the pressure in the middle",
        "Pressure along both axes of the ellipse: points of the finite elements on Hertz's half circle.",
    ),
    "contact shear": Drawing(
        contact.shear_map,
        "Largest shear stress below the surface, in the plane of the short axis. The cross is the maximum on the axis "
        "by theory",
        "Map of the shear stress below the contact, with its largest value on the axis where theory has it.",
    ),
    "mesh": Drawing(
        contact.mesh,
        "Mesh of a quarter of the contact, from above and from the side: finest at the contact (red)",
        "Lines of the mesh from above and from the side, finest at the contact, coarser away from it.",
    ),
    "load_series": Drawing(
        series.load_series,
        "Deviation of the finite elements from Hertz against the load, with one mesh for all loads",
        "Deviation of five quantities from Hertz over the load, level: one mesh serves every load.",
    ),
    "body_size": Drawing(
        series.body_size,
        "Approach of clamped boxes against their inverse size: the larger the box, the nearer to Hertz (line)",
        "Approach against the inverse size of the box: a straight line to the value with the exact far field.",
    ),
    "convergence": Drawing(
        series.convergence,
        "Errors against the element size, on logarithmic axes: mean over the positions of the mesh (solid), worst "
        "single position (dotted)",
        "Errors of four quantities falling with the element size, in double logarithms.",
    ),
    "true_geometry": Drawing(
        series.true_geometry,
        "True bodies: deviation of approach, semi-axes and largest pressure from Hertz against the load",
        "Deviation of approach, semi-axes and pressure from Hertz over the load, for the exact gap and true bodies.",
    ),
    "conformity": Drawing(
        series.conformity,
        "Worst deviation from Hertz against the load, a line for each groove radius: the smaller the radius, the "
        "larger. Dotted lines: the two limits of the question",
        "Worst deviation from Hertz over the load, one line for each groove radius: the smaller, the larger.",
    ),
    "sector bodies": Drawing(
        sector.sector_bodies,
        "Half a ball and its segments of both rings, as meshed",
        "The meshed half ball between segments of both rings, and the ball alone with its contact in colour.",
    ),
    "sector contacts": Drawing(
        sector.sector_contacts,
        "Pressure and gap of both contacts of the ball. The maps are smoothed between the corners of the pressure's "
        "cells, four to six a semi-axis; the curves show those corners as computed",
        "Pressure maps of the inner and the outer contact, and pressure and gap across the groove.",
    ),
    "bearing_sector": Drawing(
        sector.bearing_sector,
        "One ball between two elastic rings: deviation from the quasi-static model; displacements in µm, because "
        "at speed the model's displacement passes through zero",
        "Six panels of deviations over the axial load, with the outside diameter rigid and free, at rest and at speed.",
    ),
}


SHOWN_IN = {"contact": "half_space_contacts", "mesh": "half_space_contacts"}
"""Pictures that would look alike in every check of one contact are shown in this one."""


def draw_all(name: str, entry: Entry) -> list[Picture]:
    """Every picture that a record has numbers for."""
    found = []
    for key, drawing in DRAWN.items():
        source = key.split()[0]
        if source in entry["pictures"] and SHOWN_IN.get(source, name) == name:
            figure = drawing.draw(entry)
            width = min(1.0, figure.get_size_inches()[0] / INCHES)
            found.append(picture(figure, drawing.alt, drawing.caption, width))
            plt.close(figure)
    return found
