"""Contact loads of all balls around the bearing."""

from __future__ import annotations

from typing import Any

import numpy as np

from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.solution.solution import Solution
from qsbearing.pictures.style import Span, balls, circle_beyond, line_style, mark_lost, raceways, scale_circle


def load_span(solution: Solution, place: CasePlace) -> Span:
    """From nothing to the largest contact load [N]."""
    _, present = balls(solution, place)
    return 0.0, max(float(contacts.load[place][present].max()) for _, contacts in raceways(solution))


def draw_loads(
    axes: Any,
    solution: Solution,
    place: CasePlace,
    span: Span | None = None,
    is_labelled: bool = True,
    is_small: bool = False,
) -> None:
    """Args:
    span: of the loads that share a scale with these; None: their own.
    is_labelled: whether the circle that is the scale says its value here.
    is_small: whether marks of single balls would touch each other.
    """
    azimuth, present = balls(solution, place)
    axes.set_title("Contact load", fontsize=10, pad=14)
    marks = {"marker": ""} if is_small else {}
    loads = {side: contacts.load[place][present] for side, contacts in raceways(solution)}
    for side, load in loads.items():
        axes.plot(
            np.append(azimuth, azimuth[0]),
            np.append(load, load[0]),
            **line_style(side, azimuth.size) | marks,
        )
    circle = circle_beyond((span or load_span(solution, place))[1])
    mark_lost(axes, solution, place, 0.96 * circle)
    scale_circle(axes, circle, "N", is_labelled)
    axes.tick_params(axis="both", labelsize=9, pad=1)
