"""Results over two keys: a map of contours for each result."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.pictures.study.labels import key_heading, stem, with_unit, words
from qsbearing.pictures.study.selection import BALL, SAMPLE, Selection
from qsbearing.pictures.style import GREY, figure_of_size

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from xarray import DataArray

LEVELS = 9


def draw_maps(chosen: Selection) -> Figure:
    """One map for each result, in rows of at most three."""
    count = len(chosen.panels)
    columns = count if count <= 3 else (2 if count == 4 else 3)
    rows = -(-count // columns)
    figure = figure_of_size(max(4.8, 4.2 * columns), 3.5 * rows + 0.3)
    grid = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes, (name,) in zip(grid, chosen.panels, strict=False):
        _map(figure, axes, chosen, name)
    for axes in grid[count:]:
        axes.remove()
    return figure


def _map(figure: Figure, axes: Axes, chosen: Selection, name: str) -> None:
    from matplotlib.ticker import MaxNLocator

    values, said = _one_each(chosen.results[name], words(stem(name)[0]))
    x, y = chosen.results[chosen.x].values, chosen.results[chosen.other].values
    z = np.asarray(values.transpose(chosen.other, chosen.x), float)
    which = stem(name)[1]
    heading = f"{which.replace('_', ' ')}: {said}" if which else said
    axes.set_title(with_unit(heading, str(values.attrs.get("units", ""))), fontsize=9, loc="left")
    axes.set_xlabel(key_heading(chosen.results[chosen.x]), fontsize=9)
    axes.set_ylabel(key_heading(chosen.results[chosen.other]), fontsize=9)
    axes.tick_params(labelsize=8)
    axes.xaxis.set_major_locator(MaxNLocator(5))
    axes.set_facecolor("0.93")
    masked = np.ma.masked_invalid(z)
    low, high = float(masked.min()), float(masked.max())
    if not high > low:
        axes.text(0.5, 0.5, f"{low:.5g} everywhere", transform=axes.transAxes, ha="center", fontsize=8)
        return
    colours = _colours()
    if np.all(z[np.isfinite(z)] == np.rint(z[np.isfinite(z)])):  # a count: steps, not contours
        drawn = axes.pcolormesh(x, y, masked, cmap=colours, shading="nearest", rasterized=True)
        figure.colorbar(drawn, ax=axes, pad=0.02).ax.tick_params(labelsize=7.5)
    else:
        axes.contourf(x, y, masked, LEVELS, cmap=colours)
        lines = axes.contour(x, y, masked, LEVELS, colors="black", linewidths=0.5)
        axes.clabel(lines, fontsize=7, fmt="%.4g")
    if (chosen.results["status"].values != 0).any():
        axes.text(
            0.99, 0.01, "grey: no solution", transform=axes.transAxes, ha="right", va="bottom", fontsize=7, color=GREY
        )


def _one_each(values: DataArray, said: str) -> tuple[DataArray, str]:
    """One number for each place of a map, and what it is."""
    import xarray

    if SAMPLE in values.dims:
        along = values.dims[0]  # all samples are in memory for one of its values at a time
        with warnings.catch_warnings(action="ignore", category=RuntimeWarning):  # where no sample is solved
            rows = [_of_any_ball(values.isel({along: [at]})).median(SAMPLE) for at in range(values.shape[0])]
        return xarray.concat(rows, along), f"{said}{' of any ball' if BALL in values.dims else ''}, median"
    largest = _of_any_ball(values)
    differ = BALL in values.dims and not np.allclose(largest, values.min(BALL), equal_nan=True)
    return largest, said + (" of any ball" if differ else "")


def _of_any_ball(values: DataArray) -> DataArray:
    return values.max(BALL) if BALL in values.dims else values


def _colours() -> Any:
    """Light to dark in one direction, so that a grey print keeps the order; never so dark that lines vanish."""
    from matplotlib.colors import LinearSegmentedColormap

    return LinearSegmentedColormap.from_list("qsbearing", ["#fdf3d0", "#f0b860", "#c86432"])
