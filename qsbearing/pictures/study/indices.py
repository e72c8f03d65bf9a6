"""Sobol indices: for each result, bars of the part of its variance that each key makes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from qsbearing.pictures.study.labels import label_of, without_unit
from qsbearing.pictures.study.selection import PictureError
from qsbearing.pictures.style import figure_of_size, plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from xarray import Dataset

LEAST = 0.005
"""What is written as more than 0.00."""
MOST = 6
"""Results that are shown unless they are named."""


def draw_indices(indices: Dataset, names: Sequence[str]) -> Figure:
    """A panel for each result, a pair of bars for each key: alone (dark), and with the others (its outline).

    Raises:
        PictureError: a name that has no indices.
    """
    known = [str(name) for name in indices["result"].values if np.isfinite(indices["total"].sel(result=name)).any()]
    for name in names:
        if name not in known:
            raise PictureError(f"{name} has no indices in this file. {', '.join(known) or 'No result has'}")
    if not known:
        raise PictureError("no result in this file has indices: none varies, or none is known of every point")
    shown = list(names) or known[:MOST]
    columns = min(3, len(shown))
    rows = -(-len(shown) // columns)
    keys = [
        without_unit(str(each), str(unit))
        for each, unit in zip(indices["key"].values, indices["unit"].values, strict=True)
    ]
    figure = figure_of_size(2.0 + 2.5 * columns, 0.7 + rows * (0.75 + 0.26 * len(keys)))
    grid = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True).ravel()
    for axes, name in zip(grid, shown, strict=False):
        _panel(axes, indices.sel(result=name), name)
    grid[0].set_yticks(range(len(keys)), keys, fontsize=8)
    grid[0].invert_yaxis()
    for axes in grid[len(shown) :]:
        axes.remove()
    figure.supxlabel(
        "share of the variance; dark: the key alone; light: with its interactions (bars: 95 % confidence)", fontsize=8.5
    )
    return figure


def _panel(axes: Axes, indices: Dataset, name: str) -> None:
    along = np.arange(indices.sizes["key"])
    first, total, error = (indices[each].values for each in ("first_order", "total", "total_error"))
    axes.barh(along, total, height=0.72, color="0.88", edgecolor="0.1", linewidth=0.8)
    axes.barh(along, np.maximum(first, 0.0), height=0.4, color="0.35")
    axes.errorbar(total, along, xerr=error, fmt="none", ecolor="0.1", elinewidth=0.9, capsize=2.0)
    for at, value, half in zip(along, total, error, strict=True):
        if value < LEAST:
            continue  # an empty row says as much as a column of zeros
        axes.annotate(
            f"{value:.2f}", (value + half, at), xytext=(3, 0), textcoords="offset points", va="center", fontsize=7.5
        )
    axes.set_xlim(0.0, 1.25)
    axes.set_xticks([0.0, 0.5, 1.0])
    axes.set_title(label_of(name).whole, fontsize=9, loc="left")
    plain(axes)
