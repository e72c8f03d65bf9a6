"""Rating life against what a designer varies: groove radii, ball count, load, speed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from qsbearing.pictures.style import GREY, STYLE, figure_of_size, legend, plain
from qsbearing.readings.rating_life import MILLION, Life

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class LifePanel(NamedTuple):
    """One panel: a life along one case axis."""

    label: str
    """What varies, with its unit."""
    values: ArrayLike
    """Its values, as many as the life's cases."""
    life: Life
    is_count: bool = False
    """Whole numbers, between which there is nothing."""


def life_against(panels: Sequence[LifePanel]) -> Figure:
    """Reference life of the bearing and of each of its raceways, a panel for each thing that varies.

    Raises:
        ValueError: a life without exactly one case axis, or not as many values as cases.
    """
    figure = figure_of_size(4.5 * len(panels), 3.6)
    all_axes = np.atleast_1d(figure.subplots(1, len(panels), sharey=True))
    for axes, panel in zip(all_axes, panels, strict=True):
        values = np.asarray(panel.values, float)
        shape = panel.life.basic_reference_rating_life.shape
        if values.ndim != 1 or values.shape != shape:
            raise ValueError(f"{panel.label}: {values.shape} values for lives of shape {shape}; needs one case axis")
        for name, lives in (("inner", panel.life.inner_life), ("outer", panel.life.outer_life)):
            style = {key: STYLE[name][key] for key in ("color", "linestyle")}
            marker = {key: STYLE[name][key] for key in ("marker", "markerfacecolor") if key in STYLE[name]}
            dots = marker if panel.is_count else {}
            axes.plot(values, lives / MILLION, linewidth=1.4, label=f"{name} raceway alone", **style, **dots)
        both = panel.life.basic_reference_rating_life / MILLION
        axes.plot(values, both, color=GREY, linewidth=2.0, marker="." if panel.is_count else None, label="bearing")
        axes.set_xlabel(panel.label, fontsize=9)
        axes.set_ylim(bottom=0.0)
        plain(axes)
    all_axes[0].set_ylabel("reference rating life, million revolutions", fontsize=9)
    legend(figure, all_axes[0])
    return figure
