"""Outlines of the contact ellipses, all to one scale."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import MPa, mm
from qsbearing.pictures.style import GREY, STYLE, balls, carry_alike, raceways, round_length

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_ELLIPSES = 20
"""More columns than this leave no room for numbers; a large bearing shows every second ball, or every third."""


def draw_ellipses(axes: Axes, solution: Solution, place: CasePlace) -> None:
    chosen, names, every = _columns(solution, place)
    _, present = balls(solution, place)
    sides = {
        side: [
            getattr(contacts, name)[place][present][chosen] / size
            for name, size in (("semi_major_axis", mm), ("semi_minor_axis", mm), ("max_pressure", MPa))
        ]
        for side, contacts in raceways(solution)
    }
    tallest = float(max(major.max() for major, _, _ in sides.values())) or 1.0
    widest = float(max(minor.max() for _, minor, _ in sides.values())) or 1.0
    # Columns spread over the width of the sheet, and never touch.
    alone = chosen.size == 1
    spacing = 3.0 * tallest if alone else max(2.6 * widest, 19.0 * tallest / max(chosen.size, 3))
    for side, columns in sides.items():
        up = 1.0 if side == "inner" else -1.0
        for column, (a, b, pressure) in enumerate(zip(*columns, strict=True)):
            x, y = column * spacing, up * 1.45 * tallest
            if a == 0.0:
                lost = all(other[0][column] == 0.0 for other in sides.values())
                axes.plot(x, y, "x" if lost else "+", color=GREY, markersize=6)
                continue
            _draw_ellipse(axes, side, x, y, float(a), float(b))
            if alone:
                numbers = f"a = {a:.4g} mm\nb = {b:.4g} mm\np₀ = {pressure:.0f} MPa"
                axes.text(x + 2.0 * widest + 0.5 * tallest, y, numbers, fontsize=10, va="center", linespacing=1.5)
            else:
                anchor: dict[str, Any] = {"va": "bottom" if up > 0.0 else "top", "ha": "center"}
                axes.text(x, y + up * 1.1 * tallest, f"{pressure:.0f}", fontsize=8, **anchor)
    axes.set_aspect("equal")
    edge = 0.8 * spacing + 0.3 * tallest
    axes.set_xlim(-edge, (chosen.size - 1) * spacing + edge + (1.2 * tallest if alone else 0.0))  # room for numbers
    axes.set_ylim(-3.1 * tallest, 3.1 * tallest)
    places = [column * spacing for column in range(chosen.size)]
    axes.set_xticks(places, names, fontsize=8)
    axes.set_yticks([1.45 * tallest, -1.45 * tallest], ["inner\nraceway", "outer\nraceway"], fontsize=9)
    axes.tick_params(length=0)
    title = "Contact ellipses to scale,\nrolling direction to the right"
    if not alone:
        title = title.replace("\n", " ")
        axes.set_xlabel(f"azimuth of the ball, deg{every}", fontsize=9)
        title += "; numbers: maximum pressure, MPa"
    axes.set_title(title, fontsize=10)
    for spine in axes.spines.values():
        spine.set_visible(False)
    _scale_bar(axes, -edge, tallest)


def _draw_ellipse(axes: Axes, side: str, x: float, y: float, a: float, b: float) -> None:
    from matplotlib.patches import Ellipse

    colour, line = STYLE[side]["color"], STYLE[side]["linestyle"]
    axes.add_patch(Ellipse((x, y), 2.0 * b, 2.0 * a, facecolor=colour, alpha=0.22, edgecolor="none"))
    axes.add_patch(Ellipse((x, y), 2.0 * b, 2.0 * a, fill=False, edgecolor=colour, linestyle=line, linewidth=1.1))


def _scale_bar(axes: Axes, left: float, tallest: float) -> None:
    """A length to measure the ellipses by, in the gap between the two rows."""
    length = round_length(0.8 * tallest)
    axes.plot([left, left], [-length / 2.0, length / 2.0], color="black", linewidth=1.5)
    for end in (-length / 2.0, length / 2.0):
        axes.plot([left - 0.06 * tallest, left + 0.06 * tallest], [end, end], color="black", linewidth=1.0)
    axes.text(left + 0.15 * tallest, 0.0, f"{length:g} mm", fontsize=8, va="center")


def _columns(solution: Solution, place: CasePlace) -> tuple[NDArray, list[str], str]:
    """Which balls to draw, their names, and what to add to the axis label where some are left out."""
    azimuth, _ = balls(solution, place)
    if carry_alike(solution, place):
        return np.array([0]), ["all balls"], ""
    turned = np.round(np.degrees(azimuth) % 360.0, 6) % 360.0
    order = np.argsort(turned)
    step = -(-order.size // MOST_ELLIPSES)
    chosen = order[::step]
    every = {1: "", 2: " (every second ball)", 3: " (every third ball)"}.get(step, f" (every {step}th ball)")
    return chosen, [f"{value:.4g}" for value in turned[chosen]], every
