"""Results against one key: a panel for each kind of result, a curve for each value of another key."""

from __future__ import annotations

import textwrap
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.block_statistics import MOST
from qsbearing.model.solution.groups import ANGLE, CONTACT_LOAD, CONTACTS
from qsbearing.model.solution.result_keys import spelled
from qsbearing.pictures.study.jumps import WORDS, Cause, jumps
from qsbearing.pictures.study.labels import (
    WITH_MARKERS,
    key_heading,
    key_words,
    label_curves,
    label_in,
    place_named,
    title_panel,
    value_label,
    with_unit,
)
from qsbearing.pictures.study.selection import BALL, SAMPLE, Selection
from qsbearing.pictures.style import (
    CHANNEL_LINES,
    GREY,
    ROW_LINES,
    STYLE,
    figure_of_size,
    logarithmic,
    of_results,
    plain,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from xarray import DataArray, Dataset

PANEL = 3.7
"""Width of a panel [inches]."""
BAND = (0.05, 0.95)
"""Quantiles of the samples between which a band is drawn."""
_ALL_BALLS = "all balls (line: the most loaded one)"
_MARKS = {
    Cause.CONTROL_SWITCHES: "o",
    Cause.CONTACT_IS_LOST: "v",
    Cause.BRANCH_ENDS: "x",
    Cause.UNKNOWN: "*",
}
MOST_MARKS = 30
"""On a curve; more would hide it."""
ROUNDING = 1e-6
"""Of the printed unit: a result that is nowhere larger is zero but for rounding, and drawn as such."""


def draw_lines(chosen: Selection) -> Figure:
    """One panel for each kind of result, side by side; beyond four, in rows of three."""
    count = len(chosen.panels)
    columns = count if count <= 4 else 3
    rows = -(-count // columns)
    figure = figure_of_size(max(4.6, PANEL * columns), 3.3 * rows + 0.4)
    grid = figure.subplots(rows, columns, squeeze=False).ravel()
    handles: dict[str, Any] = {}
    for axes, names in zip(grid, chosen.panels, strict=False):
        handles |= _panel(axes, chosen, names)
    for axes in grid[count:]:
        axes.remove()
    if handles:
        figure.legend(
            list(handles.values()), list(handles), loc="outside lower center", ncols=4, fontsize=8.5, frameon=False
        )
    return figure


def _panel(axes: Axes, chosen: Selection, names: tuple[str, ...]) -> dict[str, Any]:
    """Draw one panel; what its curves are, for the legend."""
    from matplotlib.patches import Patch
    from matplotlib.ticker import MaxNLocator

    results, x = chosen.results, chosen.results[chosen.x].values
    handles: dict[str, Any] = {}
    labels: list[tuple[NDArray, NDArray, str, str]] = []
    numbers = range(results.sizes[chosen.other]) if chosen.other else range(1)
    for name in names:
        which = label_in(results, name).which
        style = _style(results, name)
        for number in numbers:
            point = results.isel({chosen.other: number}) if chosen.other else results
            line, low, high = _curve(point, name, chosen.x)
            marker = {"marker": style["marker"], "markersize": 3.5} if x.size <= WITH_MARKERS else {}
            face = {"markerfacecolor": "none"} if which == "outer" else {}
            drawing: dict[str, Any] = {key: style[key] for key in ("color", "linestyle")} | marker | face
            (drawn,) = axes.plot(x, line, linewidth=1.3, clip_on=not marker, **drawing)
            if low is not None and high is not None and not np.allclose(low, high, equal_nan=True):
                band = axes.fill_between(x, low, high, color=style["color"], alpha=0.13, linewidth=0.0)
                is_sampled = SAMPLE in results[name].dims
                patch = Patch(facecolor="0.35", alpha=band.get_alpha())  # of either raceway's colour in the panels
                handles.setdefault("5 % to 95 % of the samples" if is_sampled else _ALL_BALLS, patch)
            handles |= _mark_jumps(axes, point, x, line, chosen.x)
            if chosen.other:
                text = value_label(results[chosen.other], float(results[chosen.other].values[number]))
                labels.append((x, line, text, style["color"]))
            if which in STYLE or len(names) > 1:
                said = f"{which} raceway" if which in STYLE else which
                handles.setdefault(said, drawn)
    axes.set_xlim(float(x.min()), float(x.max()))
    if np.all(x > 0.0) and np.allclose(np.diff(np.log(x)), np.diff(np.log(x))[0]) and x.size > 2 and x[-1] > 20 * x[0]:
        logarithmic(axes.xaxis)
    else:
        axes.xaxis.set_major_locator(MaxNLocator(5, integer=bool(np.all(x == np.rint(x)))))
    unit = str(results[names[0]].attrs.get("units", ""))
    _limits(axes, unit)
    axes.set_xlabel(key_heading(results[chosen.x]), fontsize=9)
    label = label_in(results, names[0])
    said = f"{label.shared} ({label.which})" if len(names) == 1 and label.which else label.shared
    heading = with_unit(said, unit)
    title_panel(axes, heading, PANEL)
    plain(axes)
    _say_unsolved(axes, chosen)
    label_curves(axes, labels)
    return handles


def _mark_jumps(axes: Axes, results: Dataset, x: NDArray, line: NDArray, along: str) -> dict[str, Any]:
    """Marks where a curve jumps, and where its branch ends; what they mean, for the legend."""
    if SAMPLE in results.dims:
        return {}
    causes = jumps(results, along).values
    handles = {}
    for cause, marker in _MARKS.items():
        at = np.flatnonzero(causes == cause)
        if cause is Cause.BRANCH_ENDS:
            at = np.where(np.isfinite(line[at]), at, at + 1)
        if 0 < at.size <= MOST_MARKS:
            (drawn,) = axes.plot(x[at], line[at], marker, color="0.1", markersize=4.5, markerfacecolor="none")
            handles[WORDS[cause]] = drawn
    return handles


def _style(results: Dataset, name: str) -> dict[str, Any]:
    label = label_in(results, name)
    if label.row:
        line = ROW_LINES[(label.row - 1) % len(ROW_LINES)]
        return {"marker": "D", **dict(zip(("color", "linestyle"), line, strict=True))}
    which = label.which
    return STYLE[which] if which in STYLE else {"marker": "D", **CHANNEL_LINES.get(which, CHANNEL_LINES[""])}


def _limits(axes: Axes, unit: str) -> None:
    """Of lives and of all others; neither has a power above the axis."""
    low, high = axes.get_ylim()
    if of_results(axes.yaxis, unit, np.concatenate([np.asarray(line.get_ydata(), float) for line in axes.lines])):
        return
    axes.ticklabel_format(axis="y", useOffset=False, scilimits=(-5, 7))
    if max(-low, high) < ROUNDING:
        axes.set_ylim(-1.0, 1.0)
    elif 0.0 < low < 0.4 * high:
        axes.set_ylim(bottom=0.0)


def _curve(results: Dataset, name: str, x: str) -> tuple[NDArray, NDArray | None, NDArray | None]:
    """A curve and the band about it: the most loaded ball among all, or the median among the samples."""
    if SAMPLE not in results[name].dims:
        return _curve_over_balls(results, name, x)
    width = max(1, MOST * results.sizes[x] // results[name].size)  # of the axis, what fits into memory
    starts = range(0, results.sizes[x], width)
    return _joined([_curve_over_samples(results.isel({x: slice(at, at + width)}), name, x) for at in starts])


def _joined(parts: list[tuple[NDArray, NDArray, NDArray]]) -> tuple[NDArray, NDArray, NDArray]:
    line, low, high = (np.concatenate(each) for each in zip(*parts, strict=True))
    return line, low, high


def _curve_over_samples(results: Dataset, name: str, x: str) -> tuple[NDArray, NDArray, NDArray]:
    values = _loaded_contacts(results, name)
    if BALL in values.dims:
        values = _most_loaded(results, values)
    levels = [BAND[0], 0.5, BAND[1]]
    with warnings.catch_warnings(action="ignore", category=RuntimeWarning):  # where no sample is solved
        low, middle, high = values.quantile(levels, SAMPLE).transpose("quantile", x).values
    return middle, low, high


def _curve_over_balls(results: Dataset, name: str, x: str) -> tuple[NDArray, NDArray | None, NDArray | None]:
    values = _loaded_contacts(results, name)
    low = high = None
    if BALL in values.dims:
        low, high = np.asarray(values.min(BALL)), np.asarray(values.max(BALL))
        values = _most_loaded(results, values)
    return np.asarray(values.transpose(x)), low, high


def _loaded_contacts(results: Dataset, name: str) -> DataArray:
    """A result; of contact angles only those of loaded contacts, as others show nothing."""
    values, place = results[name], place_named(name)
    if place is None or place.group not in CONTACTS or place.result is not ANGLE:
        return values
    carried = results.get(spelled(place._replace(result=CONTACT_LOAD)))
    return values if carried is None or carried.dims != values.dims else values.where(carried > 0.0)


def _most_loaded(results: Dataset, values: DataArray) -> DataArray:
    """At the ball that carries most on the outer raceway, which is one that carries on both."""
    load = results.get("outer_load")
    if load is None or BALL not in load.dims:
        return values.max(BALL)
    ball = load.fillna(-1.0).argmax(BALL)
    return values.isel({BALL: ball})


def _say_unsolved(axes: Axes, chosen: Selection) -> None:
    """Shade where no curve has a solution, and write why."""
    status, reason = chosen.results["status"], chosen.results["reason"]
    others = [dim for dim in status.dims if dim != chosen.x]
    unsolved = (status != 0).all(others).values
    if not unsolved.any():
        return
    x = chosen.results[chosen.x].values
    edges = np.concatenate([x[:1], 0.5 * (x[1:] + x[:-1]), x[-1:]])
    meanings = str(reason.attrs.get("flag_meanings", "")).split(" ")
    first = reason.isel(dict.fromkeys(others, 0)).values
    for start in np.flatnonzero(unsolved & ~np.roll(unsolved, 1) | (unsolved & (np.arange(x.size) == 0))):
        stop = start
        while stop + 1 < x.size and unsolved[stop + 1]:
            stop += 1
        axes.axvspan(edges[start], edges[stop + 1], color="0.93", zorder=0)
        why = meanings[int(first[start])].rpartition(":")[2].replace("_", " ").strip()
        middle = 0.5 * (edges[start] + edges[stop + 1])
        said = textwrap.fill("not converged" if why == "none" else why, 22)
        axes.text(
            middle, 0.5, said, rotation=90, transform=axes.get_xaxis_transform(), fontsize=7, ha="center", va="center",
            color=GREY,
        )  # fmt: skip


def curves_of(chosen: Selection) -> str:
    """What the curves differ in, for the title."""
    return f"curves: {key_words(chosen.results[chosen.other])}" if chosen.other else ""
