"""A record's pictures: errors along the speed, error against time of the model levels."""

from __future__ import annotations

from collections.abc import Iterable
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.model.solution.judgement import WORDS
from qsbearing.studies.cost.measuring import in_a_line
from qsbearing.studies.cost.record import Level
from qsbearing.studies.cost.speeds import OWN
from qsbearing.studies.cost.tables import levels_of, select

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

# Okabe & Ito's colours, told apart by every kind of colour vision; markers differ as well.
COLOURS = ("#0072b2", "#56b4e9", "#009e73", "#e69f00", "#d55e00", "#000000", "#cc79a7")
MARKERS = ("v", "s", "^", "D", "o", "*", "P")


def speeds(record: dict[str, Any]) -> Figure:
    """When a model level is enough: errors of the reported results along the speed."""
    figure, axes = _sheet(record, 2, 3, (11.0, 6.2), "When a model level is enough: errors against the finest level")
    measured = levels_of(record)
    for each, (group, words) in zip(axes.ravel(), WORDS.items(), strict=False):
        each.set(title=words.capitalize(), xlabel="dm n, mm rpm", ylabel="relative error")
        listed = [row for row in record["errors"] if row["dm_n_mm_rpm"] and row["speed"] != OWN]
        _error_axis(each, (row[group] for row in listed if row["level"] != measured[-1].name))
        for k, level in enumerate(measured[:-1]):
            rows = select(listed, level=level.name)
            along = [row["dm_n_mm_rpm"] for row in rows]
            style = _style(k, level) | {"markersize": 4, "linewidth": 1.1, "markevery": (k, 6)}
            each.plot(along, np.array([row[group] for row in rows], float), **style)
        each.set_xscale("log")
        each.set_xlim(along[0], along[-1])
    axes[-1, -1].set_axis_off()  # five quantities in six places: the legend has the last
    axes[-1, -1].legend(*axes[0, 0].get_legend_handles_labels(), loc="center", fontsize=8, frameon=False)
    return figure


def levels(record: dict[str, Any]) -> Figure:
    """What each model level costs alone and in a batch, with its error."""
    figure, axes = _sheet(record, 1, 2, (11.0, 5.4), "What model levels cost; bars: 5 % to 95 % of the rounds")
    batch, measured = record["settings"]["batch"], levels_of(record)
    labels = {1: "processor time of one call, µs", batch: f"processor time a case in a batch of {batch}, µs"}
    for each, (cases, label) in zip(axes[0], labels.items(), strict=True):
        rows = select(record["measured"], part="levels", cases=cases)
        _error_axis(each, (row["error"] for row in rows))
        for k, row in enumerate(rows):
            low, median, high = (1e6 * row["case_s"][name] for name in ("low", "median", "high"))
            error, bars = np.array([row["error"]], float), [[median - low], [high - median]]
            each.errorbar(
                [median], error, xerr=bars, elinewidth=0.7, capsize=1.5, linewidth=0, **_style(k, measured[k])
            )
        each.set(xscale="log", xlabel=label, ylabel="error of the worst result (shaded: linear, down to 0)")
        _plain(each.xaxis)
    _legend(figure, axes[0, 0])
    return figure


def accuracy(record: dict[str, Any]) -> Figure:
    """One scene's levels: error against the time of a case, alone and among the most that were measured."""
    figure, axes = _sheet(record, 1, 1, (11.0, 6.2), "What accuracy costs")
    place, listed = axes[0, 0], record["levels"]
    worst = [None if None in (known := list(row["errors"].values())) else max(known) for row in listed]
    elements = record["elements"]
    _error_axis(place, [*worst, elements["error"] if elements else None])
    for k, (row, error) in enumerate(zip(listed, worst, strict=True)):
        times = [1e6 * cost["seconds"] / cost["cases"] for cost in row["costs"]]
        look = {"color": COLOURS[k % len(COLOURS)], "marker": MARKERS[k % len(MARKERS)]}
        words = row["text"] + (" (this scene)" if row["is_asked"] else "")
        height = np.array([error] * 2, float)
        place.plot([min(times), max(times)], height, color=look["color"], linewidth=0.8)
        place.plot([max(times)], height[:1], linewidth=0, label=words, **look)
        place.plot([min(times)], height[:1], linewidth=0, fillstyle="none", **look)
    if elements:
        words = f"one contact by finite elements ({elements['contact']}), against Hertz"
        place.plot([1e6 * elements["seconds"]], [elements["error"]], "kX", markersize=8, linewidth=0, label=words)
    place.set(
        xscale="log",
        xlabel="processor time of a case, µs: filled alone, open in a large batch",
        ylabel="error of the worst result",
    )
    figure.legend(*place.get_legend_handles_labels(), loc="outside lower center", ncols=2, fontsize=8, frameon=False)
    return figure


OF_ONE_SCENE = {"accuracy": accuracy}
PICTURES = {"speeds": speeds, "levels": levels}


def png(figure: Figure) -> bytes:
    """The picture without the date and version that would change the file."""
    data = BytesIO()
    figure.savefig(data, format="png", metadata={"Software": None})
    return data.getvalue()


def _error_axis(axes: Axes, values: Iterable[float | None]) -> None:
    """Logarithmic from the decade of the smallest error, linear from there to 0, which has no place on a logarithmic
    axis; shown only where some error is exactly 0."""
    listed = np.array(list(values), float)
    known = listed[listed > 0.0]
    lowest, highest = 10.0 ** np.floor(np.log10(known.min(initial=1.0))), 3.0 * known.max(initial=1.0)
    axes.set_yscale("symlog", linthresh=lowest)
    axes.set_ylim(-0.25 * lowest if (listed == 0.0).any() else lowest, highest)
    axes.axhspan(-0.25 * lowest, lowest, color="0.93", zorder=0)


def _style(k: int, level: Level) -> dict[str, Any]:
    return {"color": COLOURS[k % len(COLOURS)], "marker": MARKERS[k % len(MARKERS)], "label": level.text}


def _sheet(
    record: dict[str, Any], rows: int, columns: int, size: tuple[float, float], title: str
) -> tuple[Figure, Any]:
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, dpi=110, layout="constrained")
    figure.get_layout_engine().set(h_pad=0.09)  # type: ignore[union-attr,call-arg]  # no title touches the next
    axes = figure.subplots(rows, columns, squeeze=False)
    what = f"{record['bearing']}, {record['scene']}"
    figure.suptitle(f"{title}\n{what}\n{in_a_line(record['machine'])}", fontsize=9)
    for each in axes.ravel():
        each.grid(color="0.9", linewidth=0.6)
        each.set_axisbelow(True)
        each.tick_params(labelsize=8)
        each.spines[["top", "right"]].set_visible(False)
    return figure, axes


def _legend(figure: Figure, axes: Axes) -> None:
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3, fontsize=8.5, frameon=False)


def _plain(axis: Axis) -> None:
    """Plain numbers along a logarithmic axis."""
    from matplotlib.ticker import LogLocator, NullLocator

    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_locator(NullLocator())
