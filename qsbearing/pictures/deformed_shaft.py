"""The shaft of a set as it is drawn, and as it bends: far further than it does, by a factor that is stated."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.units import mm, um
from qsbearing.pictures.style import GREY, round_length
from qsbearing.systems.sets.set_solution import SetSolution
from qsbearing.systems.sets.weight import mass_loads

SHOWN = 0.3
"""Of the shaft's largest diameter: what the picture makes of the largest deflection."""
LOAD = "#009e73"
"""Colour of the loads."""
FINE = 25
"""Positions along each section."""
PLANES = ((1, 4, 1.0, "y"), (2, 3, -1.0, "z"))
"""Of each plane: channels of deflection and of its slope, the slope's sign, and a name."""
NEGLIGIBLE = 1e-3
"""Of the other plane's deflection: a plane with less is not shown."""


def planes_of(solution: SetSolution, place: CasePlace) -> list[int]:
    """Which planes bend enough to be seen."""
    shaft = solution.set.shaft
    assert shaft is not None
    largest = np.abs(solution.deflection(shaft.ends)[place][:, [1, 2]]).max(axis=0)
    return [i for i in range(2) if largest[i] > NEGLIGIBLE * largest.max()] or [0]


def draw_deformed_shaft(axes: Any, solution: SetSolution, place: CasePlace, plane: int = 0) -> None:
    """Args:
    plane: 0: xy; 1: xz.
    """
    of = solution.set
    shaft = of.shaft
    assert shaft is not None
    channel, slope, sign, name = PLANES[plane]
    ends = shaft.ends
    x = np.concatenate([np.linspace(a, b, FINE) for a, b in pairwise(ends)])
    moved = solution.deflection(x)[place]
    widest = max(max(each.outer_diameters) for each in shaft.sections)
    largest = float(np.abs(moved[:, channel]).max())
    factor = round_length(SHOWN * widest / largest) if largest > 0.0 else 1.0
    for number, section in enumerate(shaft.sections):
        some = slice(number * FINE, (number + 1) * FINE)
        for diameters, line in ((section.outer_diameters, "-"), (section.inner_diameters, "--")):
            radius = 0.5 * np.linspace(*diameters, FINE)
            if radius.any():
                _outline(axes, x[some], np.zeros(FINE), np.zeros(FINE), radius, color="0.8", lw=0.8, ls=line)
                bent = factor * moved[some, channel], factor * sign * moved[some, slope]
                _outline(axes, x[some], *bent, radius, color="0.25", lw=1.1, ls=line)
    for label, colour in (("undeformed shaft (dashed: its bore)", "0.8"), ("deformed shaft", "0.25")):
        axes.plot([], [], color=colour, label=label)
    axes.plot(x / mm, factor * moved[:, channel] / mm, color="0.25", lw=0.8, ls="-.", label="centre line")
    top = (0.5 + 0.5 * SHOWN) * widest
    for number, row in enumerate(of.rows, 1):
        _bearing(axes, solution, place, number, factor, channel)
        top = max(top, 0.5 * float(np.ravel(row.bearing.pitch_diameter)[0]))
    for load in (*of.shaft_loads, *mass_loads(shaft)):
        value = np.broadcast_to(np.asarray(load.values[channel], float), solution.shape)[place]
        if value != 0.0:
            at = float(load.position) / mm
            tail, head = (-1.45, -0.95) if value > 0.0 else (1.45, 0.95)
            arrow = {"arrowstyle": "-|>", "color": LOAD, "lw": 1.5}
            axes.annotate("", (at, head * top / mm), (at, tail * top / mm), arrowprops=arrow)
            beside = {"va": "center", "fontsize": 8, "color": LOAD}
            axes.annotate(f"{abs(value):.4g} N", (at, tail * top / mm), (4, 0), textcoords="offset points", **beside)
    supports = [float(each.position) / mm for each in shaft.supports if each.stiffness[channel, channel] > 0.0]
    if supports:
        below = np.full(len(supports), -1.15 * top / mm)
        axes.plot(supports, below, "^", ms=8, color=GREY, mfc="none", label="elastic support")
    for label, position in shaft.points.items():
        at = solution.deflection(position)[place][0, channel]
        axes.plot(position / mm, factor * at / mm, marker="o", ms=4, color="black", zorder=3)
        text = f"{label}: {at / um:.3g} µm".replace("-", "−")
        axes.annotate(text, (position / mm, 1.65 * top / mm), ha="center", fontsize=8)
        axes.plot(2 * [position / mm], [factor * at / mm, 1.6 * top / mm], color="0.6", lw=0.6, ls=":")
    axes.set_title(f"Shaft in the plane x{name}: deflection × {factor:.0f}", fontsize=10)
    axes.set_xlabel("x, mm", fontsize=9)
    axes.set_ylabel(f"{name}, mm", fontsize=9)
    axes.set_ylim(-1.6 * top / mm, 1.85 * top / mm)
    axes.margins(x=0.12)
    axes.set_aspect("equal")
    axes.tick_params(labelsize=8)


def _outline(axes: Any, x: NDArray, y: NDArray, slope: NDArray, radius: NDArray, **line: Any) -> None:
    """A section's outline, its cross sections square to what the centre line has turned to."""
    for side in (radius, -radius):
        axes.plot((x - np.clip(slope, -0.5, 0.5) * side) / mm, (y + side) / mm, **line)
    for end in (0, -1):
        turn, across = np.clip(slope[end], -0.5, 0.5) * radius[end], np.array([radius[end], -radius[end]])
        axes.plot(np.array([x[end] - turn, x[end] + turn]) / mm, (y[end] + across) / mm, **line)


def _bearing(axes: Any, solution: SetSolution, place: CasePlace, number: int, factor: float, channel: int) -> None:
    """Balls above and below the shaft where it has them, with their lines of action, and the row's number."""
    row = solution.set.rows[number - 1]
    at = float(np.ravel(row.position)[0])
    y = factor * float(solution.deflection(at)[place][0, channel])
    pitch, ball, angle = (
        float(np.ravel(getattr(row.bearing, name))[0])
        for name in ("pitch_diameter", "ball_diameter", "free_contact_angle")
    )
    turn = np.linspace(0.0, 2.0 * np.pi, 40)
    for side in (1.0, -1.0):
        centre = y + side * 0.5 * pitch
        axes.plot(
            (at + 0.5 * ball * np.cos(turn)) / mm, (centre + 0.5 * ball * np.sin(turn)) / mm, color="black", lw=0.9
        )
        angle = 0.0 if solution.set.is_two_sided[number - 1] else angle
        along = 0.75 * ball * np.array([row.sign * np.sin(angle), side * np.cos(angle)])
        ends = np.array([-along, along])
        axes.plot((at + ends[:, 0]) / mm, (centre + ends[:, 1]) / mm, color="black", lw=0.9)
    axes.annotate(str(number), (at / mm, (y - 0.5 * pitch - 1.1 * ball) / mm), ha="center", va="center", fontsize=8)
