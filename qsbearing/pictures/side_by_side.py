"""Results of several bearings side by side: a panel for each result, a bar for each bearing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from qsbearing.pictures.study.labels import head, label_of, title_panel, with_unit
from qsbearing.pictures.style import figure_of_size

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIRST, OTHER = "0.55", "#0072b2"
"""Of the bearing that the others are compared with, and theirs."""
PANEL = 4.6
"""Width of a panel [inches]."""
MARKED = 0.01
"""Relative difference from the first bearing that is shown (chosen: below it two bearings are alike)."""


def side_by_side(labels: Sequence[str], panels: Sequence[tuple[str, str, Sequence[float]]], title: str) -> Figure:
    """Bars from zero, each with its value and its difference from the first bearing.

    Args:
        labels: of the bearings.
        panels: name, unit and values of each result; NaN has no bar.
    """
    columns = min(2, len(panels))
    rows = -(-len(panels) // columns)
    figure = figure_of_size(PANEL * columns, rows * (0.75 + 0.28 * len(labels)) + 0.4)
    grid = figure.subplots(rows, columns, squeeze=False, sharey=True).ravel()
    places = np.arange(len(labels))
    for axes, (name, unit, values) in zip(grid, panels, strict=False):
        shown = np.nan_to_num(np.asarray(values, float))
        axes.barh(places, shown, color=[FIRST, *[OTHER] * (len(labels) - 1)], height=0.7)
        title_panel(axes, with_unit(label_of(name).whole, unit), PANEL)
        axes.axvline(0.0, color="black", linewidth=0.8)
        low, high = min(0.0, shown.min()), max(0.0, shown.max())
        axes.set_xlim(low - 0.45 * (high - low) * (low < 0.0), high + 0.45 * (high - low) * (high > 0.0))
        for place, value in zip(places, values, strict=True):
            text = "no solution" if not np.isfinite(value) else _said(value)
            known = np.isfinite(value) and np.isfinite(values[0]) and value * values[0] > 0.0  # of one sign
            if known and abs(value / values[0] - 1.0) > MARKED:
                text += f" ({100.0 * (value / values[0] - 1.0):+.0f} %)"
            left = np.isfinite(value) and value < 0.0
            at = value if np.isfinite(value) else 0.0
            axes.annotate(
                text, (at, place), xytext=(-4 if left else 4, 0), textcoords="offset points", fontsize=8, va="center",
                ha="right" if left else "left",
            )  # fmt: skip
        axes.set_yticks(places, labels, fontsize=8, parse_math=False)
        axes.set_xticks([])
        for side in ("top", "right", "bottom", "left"):
            axes.spines[side].set_visible(False)
        axes.tick_params(length=0)
    grid[0].invert_yaxis()
    for axes in grid[len(panels) :]:
        axes.remove()
    head(figure, title)
    return figure


def _said(value: float) -> str:
    return f"{value:,.0f}" if 1e4 <= abs(value) < 1e12 else f"{value:.4g}"
