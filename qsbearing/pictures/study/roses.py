"""Contact loads around the bearing, a rose for each value of a key."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from qsbearing.pictures.study.labels import key_words, value_label
from qsbearing.pictures.study.selection import SAMPLE, Selection
from qsbearing.pictures.style import figure_of_size, label_circles, legend, line_style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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
    top = 1.08 * max(float(results[f"{side}_load"].isel({chosen.x: numbers}).max()) for side in ("inner", "outer"))
    unit = str(results["inner_load"].attrs.get("units", "N"))
    for axes, number in zip(panels, numbers, strict=True):
        point = results.isel({chosen.x: int(number)})
        azimuth = np.radians(point["azimuth"].values)
        known = np.isfinite(azimuth)
        for side in ("inner", "outer"):
            load = point[f"{side}_load"].values[known]
            around = np.append(azimuth[known], azimuth[known][:1])
            axes.plot(around, np.append(load, load[:1]), **line_style(side, load.size) | {"markersize": 3.0})
        axes.set_ylim(0.0, top)
        axes.set_thetagrids(range(0, 360, 90), ["y", "z", "", ""], fontsize=8)
        loads = [point[f"{side}_load"].values[known] for side in ("inner", "outer")]
        label_circles(axes, azimuth[known], loads, top)
        axes.tick_params(labelsize=7)
        axes.grid(color="0.85", linewidth=0.6)
        text = value_label(results[chosen.x], float(results[chosen.x].values[number]))
        text = f"{key_words(results[chosen.x])} {text}"
        axes.set_title(text if (point["status"] == 0) else f"{text}: no solution", fontsize=9)
    figure.supylabel(f"contact load, {unit}", fontsize=9)
    legend(figure, panels[0])
    return figure
