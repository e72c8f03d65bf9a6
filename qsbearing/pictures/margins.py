"""How much of each limit is used, as bars, above the loads of the balls."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from qsbearing.model.solution.solution import Solution
from qsbearing.pictures.style import GREY, RED, STYLE, balls, carry_alike, figure_of_size, plain, raceways

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Bar(NamedTuple):
    """How much of a limit is used."""

    name: str
    used: float
    """Part of it."""
    words: str
    """Both numbers."""
    is_open: bool = False
    """Whether it cannot be judged."""


LIGHT = "0.91"
WIDTH, LOADS = 5.6, 1.7
"""Of the picture, which a phone shows whole, and height of the loads [inches]."""
ABOVE = 1.2
"""Height of the axes over what the loads need: the legend stands there."""
MOST = 1.25
"""Part of a limit at which a bar ends: beyond it, the number tells."""


def margins(bars: Sequence[Bar], solution: Solution | None = None) -> Figure:
    """A bar for each limit; below them the loads of all balls, where they differ.

    Args:
        solution: of a single case, where balls carry different loads.
    """
    height = 0.4 + 0.27 * len(bars)
    if solution is None or carry_alike(solution, ()):
        figure = figure_of_size(WIDTH, height)
        _draw_bars(figure.subplots(), bars)
        return figure
    figure = figure_of_size(WIDTH, height + LOADS)
    above, below = figure.subplots(2, 1, height_ratios=(height, LOADS))
    _draw_bars(above, bars)
    _draw_loads(below, solution)
    return figure


def _draw_bars(axes: Any, bars: Sequence[Bar]) -> None:
    places = np.arange(len(bars))[::-1]
    used = np.array([min(each.used, MOST) for each in bars])
    axes.barh(places, MOST, height=0.5, color=LIGHT)
    axes.barh(places, used, height=0.5, color=list(map(_colour, bars)))
    axes.axvline(1.0, color=GREY, linewidth=1.0)
    axes.set_yticks(places, [each.name for each in bars], fontsize=9)
    for place, each in zip(places, bars, strict=True):
        axes.text(MOST + 0.03, place, each.words, fontsize=9, va="center")
    axes.set_xlim(0.0, MOST)
    axes.set_ylim(-0.6, len(bars) - 0.4)
    axes.set_xticks([0.0, 0.5, 1.0], ["0", "50 %", "limit"], fontsize=8)
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _colour(of: Bar) -> str:
    """Red beyond the limit; that of the inner raceway where it is open."""
    return RED if of.used > 1.0 else str(STYLE["inner" if of.is_open else "outer"]["color"])


def _draw_loads(axes: Any, solution: Solution) -> None:
    azimuth, present = balls(solution, ())
    at = np.degrees(azimuth) % 360.0
    width = 0.4 * 360.0 / at.size
    for number, (side, contacts) in enumerate(raceways(solution)):
        shift = (number - 0.5) * width
        axes.bar(at + shift, contacts.load[present], width=width, color=STYLE[side]["color"], label=f"{side} raceway")
    axes.set_title("contact load of each ball, N", fontsize=10)
    axes.set_xticks(range(0, 361, 90), ["0° (y)", "90° (z)", "180°", "270°", "360°"])
    plain(axes)
    axes.set_ylim(0.0, ABOVE * axes.get_ylim()[1])
    axes.legend(loc="upper center", ncols=2, fontsize=8, frameon=False)
