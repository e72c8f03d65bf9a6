"""Work-precision pictures of a record: error against time, and memory; machine, versions and solver at the foot."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.cost import answers
from qsbearing.cost.machine import in_a_line
from qsbearing.cost.tolerance import STARTS, summary

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Okabe & Ito's colours, told apart by every kind of colour vision; markers differ as well.
COLOURS = ("#000000", "#0072b2", "#56b4e9", "#009e73", "#e69f00", "#d55e00", "#cc79a7")
MARKERS = ("*", "v", "s", "^", "D", "o", "P")
LINES = ("-", "--", "-.", ":", (0, (6, 1, 1, 1, 1, 1)))
GREY = "0.35"


def speeds(record: dict[str, Any]) -> Figure:
    """When a rung is enough: errors of four groups of answers along the speed."""
    title = f"When a fidelity is enough: {record['bearing']}, {record['scene']}; errors against the top rung"
    figure, axes = _sheet(record, 2, 2, 11.0, 8.0, title, is_timed=False)
    along = record["speeds"]["dm_n_mm_rpm"]
    rungs = record["fidelity"][0]["rungs"]
    for each, group in zip(axes.ravel(), answers.GROUPS, strict=True):
        for k, rung in enumerate(rungs):
            values = record["speeds"]["rungs"].get(rung["rung"], {}).get(group)
            if values is not None:
                heights = [value if value else np.nan for value in values]
                each.plot(along, heights, **_rung(k, rungs) | {"markersize": 4}, linewidth=1.1, markevery=(k, 6))
        each.set(xscale="log", yscale="log", title=group.capitalize(), xlabel="dm n, mm rpm", ylabel="relative error")
        each.axhspan(1.0, max(each.get_ylim()[1], 1.1), color="0.95", zorder=0)
        each.set_xlim(along[0], along[-1])
        _clean(each)
    _legend(figure, axes, 3)
    return figure


def fidelity(record: dict[str, Any]) -> Figure:
    """What each rung costs alone and in a batch, and its memory."""
    title = f"What fidelity costs: {record['bearing']}, {record['scene']}"
    figure, axes = _sheet(record, 1, 3, 14.0, 6.2, title)
    places = record["fidelity"]
    errors = [rung["accuracy"] for place in places for rung in place["rungs"] if rung["accuracy"]]
    floor = 0.3 * min(errors, default=1e-4)
    batch = f"time a case in a batch of {record['settings']['batch']}, µs"
    for each, key, label, size, step in (
        (axes[0, 0], "one_case_s", "time of one call, µs", 1e6, (1.0, 2.0, 5.0)),
        (axes[0, 1], "batch_case_s", batch, 1e6, (1.0, 2.0, 5.0)),
        (axes[0, 2], "memory_MB", "peak memory of the process, MB (libraries nearly all)", 1.0, (1.0, 2.0, 5.0)),
    ):
        _work(each, places, key, size, floor)
        each.set(xscale="log", yscale="log", xlabel=label, ylabel="error of the worst answer")
        if key == "memory_MB":
            each.set_xlim(50.0, 500.0)
        _plain(each, step)
        _clean(each)
    _legend(figure, axes, 4)
    return figure


def _rung(k: int, rungs: list[dict[str, Any]]) -> dict[str, Any]:
    return {
        "color": COLOURS[k % len(COLOURS)],
        "marker": MARKERS[k % len(MARKERS)],
        "markersize": 6,
        "label": rungs[k]["words"],
    }


def _work(axes: Axes, places: list[dict[str, Any]], key: str, size: float, floor: float) -> None:
    """Errors of all rungs in all situations over what they cost."""
    for line, place in zip(LINES, places, strict=False):
        along, heights = [], []
        for k, rung in enumerate(place["rungs"]):
            if rung[key] is None or rung["accuracy"] is None:
                continue
            low, median, high = (size * rung[key][name] for name in ("low", "median", "high"))
            along.append(median)
            heights.append(rung["accuracy"] or floor)
            style = _rung(k, place["rungs"]) | {"linestyle": "none"}
            spread = [[max(median - low, 0.0)], [max(high - median, 0.0)]]
            axes.errorbar(median, heights[-1], xerr=spread, elinewidth=0.7, capsize=1.5, zorder=3, **style)
        axes.plot(along, heights, color=GREY, linestyle=line, linewidth=0.9, zorder=1, label=place["name"])
    axes.axhline(floor, color="0.7", linewidth=0.8)
    note: dict[str, Any] = {"fontsize": 7.5, "color": GREY, "ha": "left", "va": "bottom"}
    axes.text(0.01, floor, "top rung: the measure, error 0", transform=axes.get_yaxis_transform(), **note)


def tolerance(record: dict[str, Any]) -> Figure:
    """What the residual tolerance buys: true error, and error against time from three starts."""
    title = "What the solver's tolerance costs: five scenes of the 50-digit reference"
    figure, axes = _sheet(record, 1, 3, 14.0, 5.4, title)
    scenes = record["tolerance"]
    improved = list(STARTS).index("improved")
    for k, scene in enumerate(scenes):
        steps = scene["starts"][improved]["steps"]
        axes[0, 0].loglog(
            [step["tolerance"] for step in steps],
            [max(step["error"], 1e-16) for step in steps],
            color=COLOURS[k % len(COLOURS)],
            marker=MARKERS[k % len(MARKERS)],
            markersize=4,
            linewidth=1.0,
            label=scene["name"].replace("_", " "),
        )
    axes[0, 0].plot([1e-2, 1e-14], [1e-2, 1e-14], color="0.6", linewidth=0.8, linestyle=":", label="error = tolerance")
    axes[0, 0].set(
        xlabel="residual tolerance", ylabel="error against 50 digits", title="What the tolerance buys (default start)"
    )
    axes[0, 0].invert_xaxis()
    rows = summary(scenes)
    for axis, key, words in (
        (axes[0, 1], "one_case_s", "time of one call, µs"),
        (axes[0, 2], "batch_case_s", f"time a case in a batch of {record['settings']['batch']}, µs"),
    ):
        for k, (start, meaning) in enumerate(STARTS.items()):
            chosen = [row for row in rows if row["start"] == start]
            low, times, high = (
                np.array([1e6 * row[key][name] for row in chosen]) for name in ("low", "median", "high")
            )
            axis.errorbar(
                times,
                [max(row["error"], 1e-16) for row in chosen],
                xerr=np.maximum([times - low, high - times], 0.0),
                color=COLOURS[k + 1],
                marker=MARKERS[k + 1],
                linestyle=LINES[k],
                markersize=4,
                linewidth=1.0,
                elinewidth=0.6,
                label=f"{start}: {meaning}",
            )
        axis.set(
            xscale="log",
            yscale="log",
            xlabel=words,
            ylabel=f"largest error of {len(scenes)} scenes",
            title="Work and precision of three starts",
        )
        _plain(axis, (1.0, 2.0, 5.0) if key == "batch_case_s" else (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0))
    for each in axes.ravel():
        _clean(each)
    axes[0, 0].legend(fontsize=7, frameon=False, loc="upper right")
    _legend(figure, axes[:, 1:], 3)
    return figure


def scaling(record: dict[str, Any]) -> Figure:
    """Time and memory by cases, balls and workers."""
    title = f"How time and memory grow: {record['bearing']}, {record['scene']}"
    figure, axes = _sheet(record, 2, 2, 11.0, 8.2, title)
    found = record["scaling"]
    for k, (what, words) in enumerate((("cases", "cases in one call"), ("balls", "balls in the bearing"))):
        rows = found[what]
        sizes = [row[what] for row in rows]
        _line(axes[0, k], sizes, [row["case_s"] for row in rows], COLOURS[1], size=1e6)
        axes[0, k].set(xscale="log", yscale="log", xlabel=words, ylabel="time a case, µs (one thread)")
        _line(
            axes[1, 0],
            sizes,
            [row["memory_MB"] for row in rows],
            COLOURS[1 + 4 * k],
            marker=MARKERS[k + 1],
            label=words,
        )
    axes[1, 0].set(xscale="log", xlabel="cases, or balls (of 5 000 cases)", ylabel="peak memory of the process, MB")
    axes[1, 0].set_ylim(0.0, 1.12 * max(row["memory_MB"]["high"] for what in ("cases", "balls") for row in found[what]))
    axes[1, 0].legend(fontsize=8.5, frameon=False, loc="upper left")
    most = max(row["count"] for row in found["workers"])
    for k, kind in enumerate(("threads", "processes")):
        rows = [row for row in found["workers"] if row["kind"] == kind]
        _line(
            axes[1, 1],
            [row["count"] for row in rows],
            [row["speed_up"] for row in rows],
            COLOURS[1 + 4 * k],
            marker=MARKERS[k + 1],
            label=kind,
        )
    axes[1, 1].plot([1, most], [1, most], color="0.6", linewidth=0.8, linestyle=":", label="as many times as fast")
    counts = sorted({row["count"] for row in found["workers"]})
    axes[1, 1].set_xticks(counts, [str(count) for count in counts])
    axes[1, 1].set(xlabel=f"workers on {found['workers'][0]['cases']:,} cases", ylabel="speed-up")
    axes[1, 1].set_ylim(bottom=0.0)
    axes[1, 1].legend(fontsize=8.5, frameon=False, loc="upper left")
    for each in axes.ravel():
        _clean(each)
    return figure


PICTURES = {"speeds": speeds, "fidelity": fidelity, "tolerance": tolerance, "scaling": scaling}
"""A picture for each part of a record."""


def _line(
    axes: Axes, sizes: list[int], values: list[dict[str, float]], colour: str, size: float = 1.0, **style: Any
) -> None:
    medians, low, high = (
        np.array([size * value.get(name, value["median"]) for value in values]) for name in ("median", "low", "high")
    )
    spread = np.maximum([medians - low, high - medians], 0.0)
    style = {"marker": "o"} | style
    axes.errorbar(sizes, medians, yerr=spread, color=colour, markersize=5, linewidth=1.0, elinewidth=0.8, **style)


def _sheet(
    record: dict[str, Any], rows: int, columns: int, width: float, height: float, title: str, is_timed: bool = True
) -> tuple[Figure, Any]:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), dpi=110, layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False)
    words = f"{title}\n{in_a_line(record['machine'])}"
    if is_timed:
        settings = record["settings"]
        words += (
            f"\nmedians of {settings['rounds']} interleaved rounds in each of {settings['processes']} processes; bars: "
            "5 % to 95 % of the rounds"
        )
    figure.suptitle(words, fontsize=9)
    return figure, axes


def _legend(figure: Figure, axes: Any, columns: int) -> None:
    """One legend below the sheet; what several axes show is named once."""
    known: dict[str, Any] = {}
    for each in axes.ravel():
        for handle, label in zip(*each.get_legend_handles_labels(), strict=True):
            known.setdefault(label, handle)
    figure.legend(
        list(known.values()), list(known), loc="outside lower center", ncols=columns, fontsize=8.5, frameon=False
    )


def _plain(axes: Axes, steps: tuple[float, ...]) -> None:
    """Plain numbers along a logarithmic x axis."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axes.xaxis.set_major_locator(LogLocator(subs=steps))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())


def _clean(axes: Axes) -> None:
    axes.grid(color="0.9", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.tick_params(labelsize=8)
    axes.title.set_fontsize(10)
    axes.xaxis.label.set_fontsize(9)
    axes.yaxis.label.set_fontsize(9)
    for name in ("top", "right"):
        axes.spines[name].set_visible(False)


def png(figure: Figure) -> bytes:
    """The picture without the date and version that would change the file."""
    from io import BytesIO

    data = BytesIO()
    figure.savefig(data, format="png", metadata={"Software": None})
    return data.getvalue()
