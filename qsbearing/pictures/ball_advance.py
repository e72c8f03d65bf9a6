"""How far balls run ahead of and behind the cage over one turn, against the clearance of its pockets."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import mm
from qsbearing.pictures.style import GREY, balls, plain
from qsbearing.readings.ball_advance import POINTS, advance_over_a_turn
from qsbearing.readings.ball_motion import orbital_speed

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def draw_advance(axes: Axes, solution: Solution, place: CasePlace) -> None:
    """The advance by azimuth, the balls where they are, and what the pockets leave free."""
    azimuth, present = balls(solution, place)
    radius = 0.5 * float(np.broadcast_to(solution.scene.operating_bearing.pitch_diameter, solution.shape)[place]) / mm
    turn = 2.0 * np.pi * np.arange(POINTS + 1) / POINTS
    speeds = np.broadcast_to(orbital_speed(solution), solution.azimuth.shape)[place][present]
    _, along, at_balls = (radius * each for each in advance_over_a_turn(speeds, turn[:-1]))
    turned = np.degrees(turn[:-1] + azimuth[0]) % 360.0
    order = np.argsort(turned)
    axes.plot(turned[order], along[order], color="black", lw=1.3, label="advance of a ball over its turn")
    axes.plot(np.degrees(azimuth) % 360.0, at_balls, "o", ms=4, color="black", label="balls")
    middle = 0.5 * (along.min() + along.max())
    clearance = solution.scene.readings.get("ball_advance", {}).get("pocket_clearance")
    if clearance is not None:
        half = 0.5 * float(np.broadcast_to(clearance, solution.shape)[place]) / mm
        axes.axhspan(middle - half, middle + half, color="0.9", label="clearance of the pockets")
    axes.axhline(0.0, color=GREY, lw=0.8, ls=":")
    axes.set_xlim(0.0, 360.0)
    axes.set_xticks(range(0, 361, 45))
    axes.set_xlabel("azimuth from y towards z, deg", fontsize=9)
    axes.set_ylabel("advance on the pitch circle, mm", fontsize=9)
    axes.set_title("Balls in the cage", fontsize=10)
    plain(axes)
