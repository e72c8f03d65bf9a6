"""The picture of a record, drawn from the numbers in it."""

from __future__ import annotations

import io
from typing import Any

import numpy as np

from fem_check.book.records import BookRecord
from qsbearing.pictures.style import GREY, figure_of_size, legend, plain

# Told apart without colour: by marker, by line, and by lightness.
STYLES: dict[str, dict[str, Any]] = {
    "line": {"color": "#d55e00", "linewidth": 1.4},
    "dashed": {"color": "#0072b2", "linewidth": 1.4, "linestyle": "--"},
    "dots": {"color": "#d55e00", "marker": "o", "linestyle": "none", "markersize": 3.2},
    "circles": {"color": "#0072b2", "marker": "o", "linestyle": "none", "markersize": 6.5, "markerfacecolor": "none"},
    "squares": {"color": "#0072b2", "marker": "s", "linestyle": "none", "markersize": 5.5, "markerfacecolor": "none"},
    "crosses": {"color": "black", "marker": "x", "linestyle": "none", "markersize": 5.5},
}
WIDTH, HEIGHT = 4.6, 3.1


def svg(record: BookRecord) -> bytes:
    """The picture as SVG; the same record gives the same bytes."""
    import matplotlib as mpl

    figure = drawn(record)
    out = io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": record["case"], "svg.fonttype": "path"}):
        figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None})
    return out.getvalue()


def drawn(record: BookRecord) -> Any:
    """The picture as a matplotlib figure, panels side by side."""
    panels = record["picture"]["panels"]
    width = WIDTH if len(panels) > 1 else 1.3 * WIDTH
    height = HEIGHT + (1.2 if any(panel["x_names"] for panel in panels) else 0.3)
    figure = figure_of_size(width * len(panels), height)
    every = figure.subplots(1, len(panels), squeeze=False)[0]
    for axes, panel in zip(every, panels, strict=True):
        _draw(axes, panel)
    labels = [{series["label"] for series in panel["series"]} for panel in panels]
    if all(each == labels[0] for each in labels):
        legend(figure, *every)
    else:  # one marker means different things in different panels
        for axes in every:
            below = -0.55 if any(panel["x_names"] for panel in panels) else -0.17
            axes.legend(loc="upper center", bbox_to_anchor=(0.5, below), ncols=3, fontsize=8, frameon=False)
    return figure


def _draw(axes: Any, panel: dict[str, Any]) -> None:
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    plain(axes)
    axes.set(xscale=panel["x_scale"], yscale=panel["y_scale"], title=panel["title"])
    axes.title.set_fontsize(10)
    axes.set_xlabel(panel["x_label"])
    axes.set_ylabel(panel["y_label"])
    for level in panel["levels"]:
        axes.axhline(level, color=GREY, linewidth=0.8, linestyle=":")
    for series in panel["series"]:
        x, y = (np.array(series[name], float) for name in "xy")
        if series["style"] == "band":
            low, high = (np.array(series[name], float) for name in ("low", "high"))
            axes.fill_between(x, low, high, color="0.85", linewidth=0, label=series["label"])
        elif series["style"] == "bars":
            edges = np.append(x, x[-1] + (x[-1] - x[-2]))
            axes.stairs(y, edges, fill=True, color="0.75", edgecolor="0.3", label=series["label"])
        else:
            axes.plot(x, y, label=series["label"], **STYLES[series["style"]])
    for axis, scale in ((axes.xaxis, panel["x_scale"]), (axes.yaxis, panel["y_scale"])):
        if scale == "log":
            low, high = axis.get_data_interval()
            axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high < 2000.0 * low else (1.0,)))
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
            axis.set_minor_formatter(NullFormatter())
    if panel["x_names"]:
        axes.set_xticks(range(len(panel["x_names"])), panel["x_names"], rotation=60, ha="right", fontsize=7)
