"""The grooves of elastic rings around the bearing, as they move away from the balls, far larger than they do."""

from __future__ import annotations

from typing import Any

import numpy as np

from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.solution.ring_shape import AROUND, groove_shape
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import um
from qsbearing.pictures.style import balls, line_style, round_length

RADII = {"inner": 0.62, "outer": 1.0}
"""At which the grooves are drawn, and the part of that by which the largest movement shows."""
LARGEST = 0.16


def draw_shape(axes: Any, solution: Solution, place: CasePlace) -> None:
    """Both grooves, unmoved (dashed) and moved, the balls between them; the outer one moves out, the inner one in."""
    azimuth, present = balls(solution, place)
    around = np.append(AROUND, 2.0 * np.pi)
    moved = {side: groove_shape(solution, side, around)[place] for side in RADII}
    largest = max(float(np.abs(each).max()) for each in moved.values())
    scale = LARGEST / largest if largest > 0.0 else 0.0
    for side, radius in RADII.items():
        outward = 1.0 if side == "outer" else -1.0
        axes.plot(around, np.full(around.size, radius), color="0.6", linewidth=0.8, linestyle=(0, (4, 3)))
        style = {key: value for key, value in line_style(side, 1).items() if key in ("color", "label")}
        axes.plot(around, radius + outward * scale * moved[side], linewidth=1.6, **style)
    load = solution.inner.load[place][present]
    size = load / max(float(load.max()), np.finfo(float).tiny)
    axes.scatter(azimuth, np.full(azimuth.size, 0.81), s=20.0 + 130.0 * size, color="0.75", edgecolor="0.4", zorder=2)
    step = round_length(largest / um)
    axes.plot([0.0, 0.0], [1.0, 1.0 + scale * step * um], color="black", linewidth=2.0, solid_capstyle="butt")
    axes.set_title(f"Grooves under load; bar at 0°: {step:g} µm", fontsize=10, pad=18)
    axes.set_ylim(0.0, 1.0 + 1.4 * LARGEST)
    axes.set_yticks([])
    axes.set_thetagrids(range(0, 360, 45), ["y  0°", "45°", "z  90°", "135°", "180°", "225°", "270°", "315°"])
    axes.tick_params(axis="both", labelsize=8)
    axes.grid(color="0.9", linewidth=0.5)
