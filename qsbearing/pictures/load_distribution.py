"""Contact loads of all balls around the bearing."""

from __future__ import annotations

from typing import Any

import numpy as np

from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.solution.solution import Solution
from qsbearing.pictures.style import Span, balls, label_circles, line_style, mark_lost, raceways


def load_span(solution: Solution, place: CasePlace) -> Span:
    """From nothing to the largest contact load [N]."""
    _, present = balls(solution, place)
    return 0.0, max(float(contacts.load[place][present].max()) for _, contacts in raceways(solution))


def draw_loads(axes: Any, solution: Solution, place: CasePlace, span: Span | None = None) -> None:
    """Args:
    span: of the loads that share a scale with these; None: their own.
    """
    azimuth, present = balls(solution, place)
    axes.set_title("Contact load, N", fontsize=10, pad=18)
    loads = {side: contacts.load[place][present] for side, contacts in raceways(solution)}
    for side, load in loads.items():
        axes.plot(np.append(azimuth, azimuth[0]), np.append(load, load[0]), **line_style(side, azimuth.size))
    top = 1.12 * ((span or load_span(solution, place))[1] or 1.0)
    axes.set_ylim(0.0, top)
    mark_lost(axes, solution, place, 0.96 * top)
    axes.set_thetagrids(range(0, 360, 45), ["y  0°", "45°", "z  90°", "135°", "180°", "225°", "270°", "315°"])
    label_circles(axes, azimuth, list(loads.values()), top)
    axes.tick_params(axis="both", labelsize=8)
    axes.grid(color="0.85", linewidth=0.6)
