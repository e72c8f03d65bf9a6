"""Contact loads of all balls around the bearing."""

from __future__ import annotations

from typing import Any

import numpy as np

from qsbearing.case_index import Place
from qsbearing.pictures.style import balls, label_angle, line_style, mark_lost, raceways
from qsbearing.solution import Solution


def draw_loads(axes: Any, solution: Solution, place: Place) -> None:
    from matplotlib.ticker import MaxNLocator

    azimuth, present = balls(solution, place)
    axes.set_title("Contact load, N", fontsize=10, pad=18)
    loads = {side: contacts.load[place][present] for side, contacts in raceways(solution)}
    for side, load in loads.items():
        axes.plot(np.append(azimuth, azimuth[0]), np.append(load, load[0]), **line_style(side, azimuth.size))
    top = 1.12 * (max(float(load.max()) for load in loads.values()) or 1.0)
    axes.set_ylim(0.0, top)
    mark_lost(axes, solution, place, 0.96 * top)
    axes.set_thetagrids(range(0, 360, 45), ["y  0°", "45°", "z  90°", "135°", "180°", "225°", "270°", "315°"])
    circles = [value for value in MaxNLocator(4).tick_values(0.0, top) if 0.0 < value <= 0.9 * top]
    labels = axes.set_rgrids(circles, [f"{value:g}" for value in circles])[1]
    for label in labels:
        label.set_bbox({"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.6})
    axes.set_rlabel_position(label_angle(azimuth, list(loads.values()), circles, top))
    axes.tick_params(axis="both", labelsize=8)
    axes.grid(color="0.85", linewidth=0.6)
