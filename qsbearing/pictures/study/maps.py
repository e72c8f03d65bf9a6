"""Results over two keys: a map of contours for each result."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.groups import FRICTION
from qsbearing.pictures.study.contours import contour_lines
from qsbearing.pictures.study.labels import key_heading, label_in, place_named, title_panel, with_unit
from qsbearing.pictures.study.selection import BALL, SAMPLE, Selection
from qsbearing.pictures.style import GREY, SLIP, figure_of_size, logarithmic_levels, spans_decades

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from xarray import DataArray

LEVELS = 9
PANEL = 4.2
"""Width of a map [inches]."""


def draw_maps(chosen: Selection) -> Figure:
    """One map for each result, in rows of at most three."""
    count = len(chosen.panels)
    columns = count if count <= 3 else (2 if count == 4 else 3)
    rows = -(-count // columns)
    figure = figure_of_size(max(4.8, PANEL * columns), 3.5 * rows + 0.3)
    grid = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes, (name,) in zip(grid, chosen.panels, strict=False):
        _map(axes, chosen, name)
    for axes in grid[count:]:
        axes.remove()
    return figure


def _map(axes: Axes, chosen: Selection, name: str) -> None:
    label = label_in(chosen.results, name)
    values, said = _one_each(chosen.results[name], label.shared)
    x, y = chosen.results[chosen.x].values, chosen.results[chosen.other].values
    z = np.ma.masked_invalid(values.transpose(chosen.other, chosen.x).values)
    unit = str(values.attrs.get("units", ""))
    _frame(axes, chosen, with_unit(f"{label.which}: {said}".removeprefix(": "), unit))
    if not z.count():
        axes.text(0.5, 0.5, "no solution", transform=axes.transAxes, ha="center", fontsize=8)
    elif not z.max() > z.min():
        axes.text(0.5, 0.5, f"{z.min():.5g} everywhere", transform=axes.transAxes, ha="center", fontsize=8)
    elif name in _STEPPED or np.all(z == np.rint(z)):
        _steps(axes, x, y, z, _least_load(chosen))
    elif _is_friction(name):
        _slip(axes, x, y, z)
    elif spans_decades(unit, z.compressed()):
        levels = logarithmic_levels(float(z.min()), float(z.max()), LEVELS)
        axes.contourf(x, y, z, levels, cmap=_colours(), norm="log", extend="max")
        contour_lines(axes, x, y, z, levels[1:-1])
    else:
        filled = axes.contourf(x, y, z, LEVELS, cmap=_colours())
        contour_lines(axes, x, y, z, list(filled.levels)[1:-1])
    if (chosen.results["status"].values != 0).any():
        axes.text(
            0.99, 0.01, "grey: no solution", transform=axes.transAxes, ha="right", va="bottom", fontsize=7, color=GREY
        )


def _frame(axes: Axes, chosen: Selection, heading: str) -> None:
    from matplotlib.ticker import MaxNLocator

    title_panel(axes, heading, PANEL)
    axes.set_xlabel(key_heading(chosen.results[chosen.x]), fontsize=9)
    axes.set_ylabel(key_heading(chosen.results[chosen.other]), fontsize=9)
    axes.tick_params(labelsize=8)
    axes.xaxis.set_major_locator(MaxNLocator(5))
    axes.set_facecolor("0.93")


_STEPPED = ("balls_off_inner", "least_loaded_azimuth")
"""Results that take some values only: areas, not contours."""
FRICTION_STEP = 0.01


def _is_friction(name: str) -> bool:
    """Of a contact, or the largest of all."""
    place = place_named(name)
    return place is not None and place.result is FRICTION and place.over in ("", "max")


def _slip(axes: Axes, x: NDArray, y: NDArray, z: Any) -> None:
    """Contours of the friction that the gyroscopic moment requires, and where balls begin to slip."""
    levels = np.arange(0.0, max(float(z.max()), SLIP[0]) + FRICTION_STEP, FRICTION_STEP).round(6)
    axes.contourf(x, y, z, levels[:: -(-levels.size // 15)], cmap=_colours(), extend="max")
    between = [level for level in levels if SLIP[0] <= level <= SLIP[1]]
    shown = sorted({*levels[1 :: -(-levels.size // 15)], *between})
    said = {level: f"{level:g}" + (": slip begins" if level in SLIP else "") for level in shown}
    widths = [1.8 if level in SLIP else 1.0 if level in between else 0.5 for level in shown]
    contour_lines(axes, x, y, z, shown, said, widths)


LEAST_AREA = 2.5
"""Half the width, in points of the grid, of an area that a label fits into."""


def _steps(axes: Axes, x: NDArray, y: NDArray, z: Any, least: NDArray | None) -> None:
    """An area for each value, the value written where the area is widest, and the line where a ball unloads."""
    from scipy.ndimage import distance_transform_edt

    values = np.unique(z.compressed())
    number = np.ma.masked_array(np.searchsorted(values, z.filled(values[0])), z.mask)
    axes.pcolormesh(x, y, number, cmap=_colours(), shading="nearest", rasterized=True)
    axes.set_xlim(x.min(), x.max())
    axes.set_ylim(y.min(), y.max())
    loaded = np.ones(z.shape, bool) if least is None else least > 0.0
    for place, value in enumerate(values):
        area = number.filled(-1) == place
        parts = [distance_transform_edt(np.pad(part, 1))[1:-1, 1:-1] for part in (area & loaded, area & ~loaded)]
        width = max(parts, key=np.max)
        at = np.unravel_index(np.argmax(width), width.shape)
        if width[at] > LEAST_AREA:
            axes.text(x[at[1]], y[at[0]], f"{value:g}", fontsize=8, ha="center", va="center")
    if least is not None and loaded.any() and (least == 0.0).any():
        line = extended_below_zero(least)
        contour_lines(axes, x, y, line, [0.0], {0.0: "first ball unloads"}, widths=1.8)


def _least_load(chosen: Selection) -> NDArray | None:
    """The load of the least loaded ball on the inner raceway; None where it is not among the results."""
    results = chosen.results
    values = results["inner_load"].min(BALL) if "inner_load" in results else results.get("inner_load_min")
    if values is None or SAMPLE in values.dims:
        return None
    return np.asarray(values.transpose(chosen.other, chosen.x), float)


def extended_below_zero(values: NDArray) -> NDArray:
    """Numbers that end at zero, continued by one point along straight lines, so that their zero is where it should be.

    Args:
        values: over a grid; a load, which is zero wherever there is none.
    """
    sums, counts = np.zeros(values.shape), np.zeros(values.shape)
    for axis in (0, 1):
        for step in (1, -1):
            one, two = (np.roll(values, step * far, axis) for far in (1, 2))
            edge = np.arange(values.shape[axis]) if step > 0 else np.arange(values.shape[axis])[::-1]
            is_there = np.expand_dims(edge >= 2, 1 - axis)
            known = is_there & (values == 0.0) & (one > 0.0) & (two > one)
            sums += np.where(known, 2.0 * one - two, 0.0)
            counts += known
    # Where there is nothing to continue from, a number that only tells on which side of the line it lies.
    below = np.where(counts > 0, np.minimum(sums, 0.0) / np.maximum(counts, 1), -np.nanmax(values))
    return np.where(values == 0.0, np.minimum(below, -1e-9 * np.nanmax(values)), values)


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
