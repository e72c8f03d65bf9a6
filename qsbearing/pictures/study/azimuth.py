"""Results of each ball by its azimuth: a panel for each kind of result, a curve for each value of a key; and
as rose diagrams."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.pictures.study.labels import key_words, label_ends, label_in, title_panel, value_label, with_unit
from qsbearing.pictures.study.selection import SAMPLE, PictureError, Selection
from qsbearing.pictures.style import STYLE, circle_beyond, figure_of_size, legend, line_style, plain, scale_circle

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_CURVES = 8
PANEL = 4.6
"""Width of a panel [inches]."""


def draw_by_azimuth(chosen: Selection) -> Figure:
    """Up to eight curves, spread along the axis; each once round and a little more.

    Raises:
        PictureError: results that no ball has of its own.
    """
    results = chosen.results.isel({SAMPLE: 0}) if SAMPLE in chosen.results.dims else chosen.results
    results = results.isel({chosen.other: 0}) if chosen.other else results
    names = chosen.panels
    if others := [name for panel in names for name in panel if "ball" not in results[name].dims]:
        said = ", ".join(others)
        raise PictureError(f"by azimuth only results of each ball can be shown, such as inner_load; not {said}")
    count = results.sizes.get(chosen.x, 1)
    numbers = np.unique(np.linspace(0, count - 1, min(MOST_CURVES, count)).round().astype(int))
    figure = figure_of_size(PANEL * len(names) + 0.4, 4.2)
    panels = figure.subplots(1, len(names), squeeze=False).ravel()
    for axes, panel in zip(panels, names, strict=True):
        labels: list[Any] = []
        for name in panel:
            side = label_in(results, name).which
            style = STYLE.get(side, STYLE["inner"])
            for number in numbers:
                point = results.isel({chosen.x: int(number)})
                along = np.degrees(np.unwrap(np.radians(point["azimuth"].values[np.isfinite(point["azimuth"].values)])))
                values = point[name].values[: along.size]
                around = np.append(along, along[:1] + 360.0)
                values = np.append(values, values[:1])
                drawing = {"markersize": 3.0, "linewidth": 1.1, "markerfacecolor": style.get("markerfacecolor")}
                drawing |= {key: style[key] for key in ("color", "linestyle", "marker")}
                axes.plot(around, values, label=f"{side} raceway" if side else None, **drawing)
                text = value_label(results[chosen.x], float(results[chosen.x].values[number]))
                labels.append((around, values, text, style["color"]))
        axes.set_xticks(range(0, 361, 60))
        axes.set_xlabel("azimuth from y towards z, deg", fontsize=9)
        heading = with_unit(label_in(results, panel[0]).shared, str(results[panel[0]].attrs.get("units", "")))
        title_panel(axes, heading, PANEL)
        plain(axes)
        label_ends(axes, labels)
    legend(figure, panels[0])
    return figure


MOST = 5


def draw_roses(chosen: Selection) -> Figure:
    """Up to five roses, spread along the axis, to one scale."""
    results = chosen.results.isel({SAMPLE: 0}) if SAMPLE in chosen.results.dims else chosen.results
    if chosen.other:
        results = results.isel({chosen.other: 0})
    count = results.sizes.get(chosen.x, 1)
    numbers = np.unique(np.linspace(0, count - 1, min(MOST, count)).round().astype(int))
    figure = figure_of_size(2.7 * numbers.size + 0.4, 3.9)
    panels = np.atleast_1d(np.array(figure.subplots(1, numbers.size, subplot_kw={"projection": "polar"}), object))
    shown = results.isel({chosen.x: numbers})
    top = circle_beyond(max(float(shown[f"{side}_load"].max()) for side in ("inner", "outer")))
    unit = str(results["inner_load"].attrs.get("units", "N"))
    for axes, number in zip(panels, numbers, strict=True):
        point = results.isel({chosen.x: int(number)})
        azimuth = np.radians(point["azimuth"].values)
        known = np.isfinite(azimuth)
        for side in ("inner", "outer"):
            load = point[f"{side}_load"].values[known]
            around = np.append(azimuth[known], azimuth[known][:1])
            axes.plot(around, np.append(load, load[:1]), **line_style(side, load.size) | {"markersize": 3.0})
        scale_circle(axes, top, unit, is_labelled=number == numbers[0])
        axes.tick_params(labelsize=8, pad=1)
        text = value_label(results[chosen.x], float(results[chosen.x].values[number]))
        text = f"{key_words(results[chosen.x])} {text}"
        axes.set_title(text if (point["status"] == 0) else f"{text}: no solution", fontsize=9)
    figure.supylabel(f"contact load, {unit}", fontsize=9)
    legend(figure, panels[0])
    return figure
