"""Results over the samples: how they are distributed, and which random key each of them follows."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.block_statistics import blocks, histogram, quantiles
from qsbearing.pictures.study.labels import key_words, label_in, with_unit
from qsbearing.pictures.study.selection import BALL, SAMPLE, Selection
from qsbearing.pictures.style import STYLE, figure_of_size, plain

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from xarray import DataArray

CORRELATED = 1 << 20
"""Samples that rank correlations are taken from, the first of a study: they are then known to 0.001."""
LETTERS = 26
"""Of a line of a result's label."""
MARKED = ((0.05, "5 %"), (0.5, "median"), (0.95, "95 %"))


def draw_distributions(chosen: Selection) -> Figure:
    """A histogram for each result, its quantiles marked."""
    from matplotlib.ticker import MaxNLocator

    count = len(chosen.panels)
    columns = min(3, count)
    rows = -(-count // columns)
    figure = figure_of_size(max(4.6, 3.6 * columns), 2.6 * rows + 0.3)
    grid = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes, (name,) in zip(grid, chosen.panels, strict=False):
        numbers = partial(_numbers, chosen.results[name])
        low, *marked, high = quantiles(numbers, [0.001, *(quantile for quantile, _ in MARKED), 0.999])
        label = label_in(chosen.results, name)
        colour = STYLE[label.which]["color"] if label.which in STYLE else "0.35"
        reach = (low, high) if high > low else (low - 0.5, low + 0.5)
        edges = np.linspace(*reach, min(60, 8 + int(chosen.results["status"].size ** 0.5 / 2)))
        axes.stairs(histogram(numbers, edges), edges, fill=True, color=colour, alpha=0.55)
        for at, (_, said) in zip(marked, MARKED, strict=True):
            axes.axvline(at, color="0.1", linewidth=1.0, linestyle="-" if said == "median" else "--")
            axes.annotate(
                f"{at:.5g}", (at, 1.0), xycoords=("data", "axes fraction"), xytext=(0, 2), textcoords="offset points",
                ha="center", va="bottom", fontsize=7,
            )  # fmt: skip
        axes.set_xlabel(with_unit(label.whole, str(chosen.results[name].attrs.get("units", ""))), fontsize=9)
        plain(axes)
        axes.xaxis.set_major_locator(MaxNLocator(4))
        axes.set_yticks([])
        axes.grid(visible=False)
        axes.spines["left"].set_visible(False)
    for axes in grid[count:]:
        axes.remove()
    figure.supxlabel("lines: 5 %, median, 95 %", fontsize=8)
    return figure


def draw_sensitivities(chosen: Selection) -> Figure:
    """Rank correlation of each result with each random key, as a table of shades."""
    keys = [name for name, values in chosen.results.coords.items() if values.dims == ("sample",) and name != "sample"]
    names = [name for (name,) in chosen.panels]
    points = chosen.results[[*names, *keys]].isel({SAMPLE: slice(0, CORRELATED)})
    drawn = {key: points[key].values for key in keys}
    correlation = np.empty((len(names), len(keys)))
    for row, name in enumerate(names):
        sampled = np.concatenate([block.ravel() for block in _numbers(points[name])])
        correlation[row] = [rank_correlation(sampled, drawn[key]) for key in keys]
    figure = figure_of_size(3.2 + 0.85 * len(keys), 1.8 + 0.34 * len(names))
    axes = figure.subplots()
    axes.imshow(np.abs(correlation), cmap="Greys", vmin=0.0, vmax=1.3, aspect="auto")
    for row, column in np.ndindex(*correlation.shape):
        value = correlation[row, column]
        colour = "white" if abs(value) > 0.75 else "black"
        axes.text(column, row, f"{value:+.2f}".replace("-", "−"), ha="center", va="center", fontsize=8, color=colour)
    said = [textwrap.fill(label_in(points, name).whole, LETTERS) for name in names]
    axes.set_yticks(range(len(names)), said, fontsize=8)
    axes.set_xticks(range(len(keys)), [key_words(chosen.results[key]).replace(" ", "\n") for key in keys], fontsize=8)
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.set_xlabel(
        "Rank correlation: near ±1, the result follows this key;\nnear 0, it does not depend on it.", fontsize=8
    )
    return figure


def _numbers(values: DataArray) -> Iterator[NDArray]:
    """One number of each point, in blocks: of what each ball has, the largest."""
    for block in blocks(values):
        yield np.fmax.reduce(block, axis=-1) if BALL in values.dims else block


def rank_correlation(one: NDArray, other: NDArray) -> float:
    """Spearman's coefficient over the pairs of which both are finite, from -1 to +1; NaN where either is constant."""
    from scipy.stats import rankdata

    known = np.isfinite(one) & np.isfinite(other)
    if known.sum() < 3 or np.ptp(one[known]) == 0.0 or np.ptp(other[known]) == 0.0:
        return float("nan")
    return float(np.corrcoef(rankdata(one[known]), rankdata(other[known]))[0, 1])
