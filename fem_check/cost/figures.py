"""The cost record as work-precision diagrams: error against time and memory, both logarithmic."""

from __future__ import annotations

import io
import textwrap
from collections.abc import Callable
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure

from fem_check.cost import machine
from fem_check.cost.configurations import JUDGED
from fem_check.cost.record import MEASURED, added_memory, mesh_refinement, selected

Record = dict[str, Any]
DPI = 110
MARKS = "osD^vP"


def png(figure: Figure) -> bytes:
    """As a file without the date and version that would change it."""
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=DPI, format="png", metadata={"Software": None})
    plt.close(figure)
    return buffer.getvalue()


def _panels(record: Record, title: str, height: float = 4.6, sharey: bool = True) -> tuple[Figure, list[Axes]]:
    figure, axes = plt.subplots(1, 2, figsize=(10.0, height), sharey=sharey, layout="constrained")
    if title:
        figure.suptitle(title, fontsize=11)
    contact = record["contact"]
    foot = f"{contact['name']}, Q = {contact['load_N']:g} N, a/b = {contact['ellipticity']:.2f}; " + machine.in_a_line(
        record["machine"], record["solvers"][record["main_solver"]]["label"]
    )
    figure.supxlabel(textwrap.fill(foot, 150), fontsize=6.5, color="grey")
    return figure, list(axes)


def _legend(figure: Figure, axes: Axes, title: str) -> None:
    """Above the panels, under the title: the points reach into every corner of them."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(
        handles,
        labels,
        loc="outside upper center",
        ncols=3,
        fontsize=7.5,
        title=title,
        title_fontsize=11,
        frameon=False,
    )


def _grid(axes: Axes) -> None:
    axes.grid(which="major", color="0.88", linewidth=0.6)
    axes.set_axisbelow(True)


def _bars(spreads: list[dict[str, Any]]) -> np.ndarray:
    """Distances from the medians to the smallest and the largest, shape (2, point)."""
    return np.array([[s["median"] - s["low"] for s in spreads], [s["high"] - s["median"] for s in spreads]])


def _against_cost(
    panels: list[Axes], entries: list[dict[str, Any]], errors: list[float], label: str, style: dict[str, Any]
) -> None:
    """One series in both panels: error over time and over memory, with the spread of the repeats."""
    for axes, name in zip(panels, ("seconds", "peak_memory_MB"), strict=True):
        spreads = [entry[name] for entry in entries]
        axes.errorbar([s["median"] for s in spreads], errors, xerr=_bars(spreads), label=label, **style)


def _number(axes: Axes, entries: list[dict[str, Any]], x: list[float], y: list[float], apart: float) -> None:
    """Elements per semi-axis below the points, where the labels stand far enough apart (a factor along x)."""
    last = 0.0
    for entry, where_x, where_y in zip(entries, x, y, strict=True):
        if where_x > apart * last:
            label = str(entry["elements_per_semi_axis"])
            axes.annotate(label, (where_x, where_y), (-3, -11), textcoords="offset points", fontsize=7.5)
            last = where_x


def _label_cost(panels: list[Axes]) -> None:
    for axes in panels:
        axes.set(xscale="log", yscale="log", ymargin=0.1)  # room for the number below the lowest point
        _grid(axes)
    panels[0].set(xlabel="time of the contact, s", ylabel="worst error of δ, a, b, p0, τmax, %")
    panels[1].set(xlabel="peak memory of the process, MB")
    for axis in (panels[0].xaxis, panels[1].xaxis, panels[0].yaxis):
        _plain_ticks(axis)


def _plain_ticks(axis: Axis) -> None:
    """1, 2 and 5 of each decade where there are few, else 1, written out: one tick alone would not tell the scale."""
    low, high = axis.get_view_interval()
    mantissas = (1.0, 2.0, 5.0) if high < 200.0 * low else (1.0,)
    decades = range(int(np.floor(np.log10(low))), int(np.ceil(np.log10(high))) + 1)
    ticks = [m * 10.0**decade for decade in decades for m in mantissas if low <= m * 10.0**decade <= high]
    axis.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    axis.set_ticks([], minor=True)


def families(record: Record) -> Figure:
    """Element families: error against time and memory."""
    figure, panels = _panels(record, "")
    for index, (name, label) in enumerate(record["families"].items()):
        entries = selected(record["configurations"], family=name, far_field="exact", solver=record["main_solver"])
        if not entries:
            continue
        errors = [100.0 * entry["worst_error"] for entry in entries]
        style = {
            "marker": MARKS[index],
            "color": f"C{index}",
            "linewidth": 2.2 if index == 0 else 1.0,
            "markersize": 6 if index == 0 else 4.5,
            "elinewidth": 0.8,
            "zorder": 3 if index == 0 else 2,
        }
        _against_cost(panels, entries, errors, label, style)
        if index == 0:
            _number(panels[0], entries, [entry["seconds"]["median"] for entry in entries], errors, 1.2)
    _label_cost(panels)
    _legend(figure, panels[0], "Element families, exact far field; numbers: elements per semi-axis")
    return figure


def far_field(record: Record) -> Figure:
    """Far field and positions of the edge: error against time and memory."""
    figure, panels = _panels(record, "")
    refinement = mesh_refinement(record["configurations"], record["main_solver"])
    x = [entry["seconds"]["median"] for entry in refinement]
    mean = [100.0 * entry["worst_error"] for entry in refinement]
    single = [100.0 * entry["worst_single_position"] for entry in refinement]
    common: dict[str, Any] = {"elinewidth": 0.8, "markersize": 5}
    _against_cost(
        panels,
        refinement,
        single,
        "exact far field, one position of the edge, worst of 8",
        common | {"marker": "o", "color": "C0", "linestyle": ":", "markerfacecolor": "white"},
    )
    _against_cost(
        panels,
        refinement,
        mean,
        "exact far field, mean of 8 positions",
        common | {"marker": "o", "color": "C0", "linewidth": 2.2},
    )
    _number(panels[0], refinement, x, mean, 1.2)
    clamped = [e for e in selected(record["configurations"], solver=record["main_solver"]) if e["far_field"] != "exact"]
    names = list(dict.fromkeys(entry["far_field"] for entry in clamped))
    names.sort(key=lambda name: -max(e["worst_error"] for e in clamped if e["far_field"] == name))
    for index, name in enumerate(names):
        entries = [entry for entry in clamped if entry["far_field"] == name]
        errors = [100.0 * entry["worst_error"] for entry in entries]
        _against_cost(panels, entries, errors, name, common | {"marker": MARKS[index + 1], "color": f"C{index + 1}"})
    _label_cost(panels)
    _legend(figure, panels[0], "Far field and positions of the contact's edge, 20-node hexahedra")
    return figure


def convergence(record: Record) -> Figure:
    """Errors over the element's size, worst over all shapes, with the slopes of theory."""
    found = record["orders"]
    figure, panels = _panels(record, "Convergence: worst error over all shapes of contact")
    size = np.asarray(found["element_size"])
    for axes, key, label in zip(
        panels,
        ("one_position", "mean_of_positions"),
        ("one position of the edge", "mean of 8 positions"),
        strict=True,
    ):
        for index, name in enumerate(JUDGED):
            fit = found[key][name]
            interval = "" if fit["uncertainty"] is None else f" ± {fit['uncertainty']:.1f}"
            axes.loglog(
                size,
                100.0 * np.asarray(fit["error"]),
                marker=MARKS[index],
                markersize=4.5,
                linewidth=1.0,
                color=f"C{index}",
                label=f"{name.replace('_', ' ')}: order {fit['exponent']:.1f}{interval}",
            )
        order = found["theory"][key]
        top = 100.0 * max(found[key][name]["error"][0] for name in JUDGED)
        axes.loglog(size, 1.6 * top * (size / size[0]) ** order, "k--", linewidth=1.4, label=f"theory: order {order:g}")
        axes.set(xlabel="element size over semi-axis", title=label)
        axes.title.set_fontsize(9)
        _plain_ticks(axes.xaxis)
        axes.legend(fontsize=7.5, loc="lower right")
        _grid(axes)
    low, high = panels[0].get_ylim()
    panels[0].set_ylim(low / 12.0, high)  # room for the legends
    panels[0].set_ylabel("error, %")
    return figure


def scaling(record: Record) -> Figure:
    """Time and memory over unknowns for each linear solver, with the fitted power laws."""
    figure, panels = _panels(record, "Linear solvers: the same contact on the same meshes", sharey=False)
    missing = [about["label"] for about in record["solvers"].values() if about["status"] != MEASURED]
    for index, (name, about) in enumerate(record["solvers"].items()):
        entries = mesh_refinement(record["configurations"], name)
        if not entries:
            continue
        dofs = np.array([entry["dofs"] for entry in entries])
        spreads = [entry["seconds"] for entry in entries]
        fits = record["scaling"][name]
        series = (
            ([s["median"] for s in spreads], _bars(spreads), fits["time"]),
            ([added_memory(entry) for entry in entries], None, fits["memory"]),
        )
        for axes, (y, bars, fit) in zip(panels, series, strict=True):
            interval = "" if fit["uncertainty"] is None else f" ± {fit['uncertainty']:.2f}"
            exponent = "" if fit["exponent"] is None else f": unknowns^({fit['exponent']:.2f}{interval})"
            style: dict[str, Any] = {
                "color": f"C{index}",
                "marker": MARKS[index],
                "markersize": 4.5,
                "linestyle": "none",
            }
            axes.errorbar(dofs, y, yerr=bars, elinewidth=0.8, label=f"{about['label']}{exponent}", **style)
            if fit["exponent"] is not None:
                line = np.array([fits["from_dofs"], fits["to_dofs"]])
                axes.plot(line, fit["factor"] * line ** fit["exponent"], color=f"C{index}", linewidth=1.0)
    for axes in panels:
        axes.set(xscale="log", yscale="log", xlabel="unknowns")
        title = f"not installed: {', '.join(missing)}" if missing else None
        axes.legend(fontsize=7.5, title=title, title_fontsize=7, loc="upper left")
        axes.set_ylim(top=3.0 * axes.get_ylim()[1])  # room for the legend
        _plain_ticks(axes.xaxis)
        _plain_ticks(axes.yaxis)
        _grid(axes)
    panels[0].set_ylabel("time of the contact, s")
    panels[1].set_ylabel("memory added to the process, MB")
    return figure


def combined(record: Record) -> Figure:
    """Closed forms and finite elements on the same axes: approach, and the ellipse."""
    figure, panels = _panels(
        record, "One contact, from a closed form to finite elements: error against time", height=5.0
    )
    refinement = mesh_refinement(record["configurations"], record["main_solver"])
    x = [entry["seconds"]["median"] for entry in refinement]
    bars = _bars([entry["seconds"] for entry in refinement])
    for axes, names, label in zip(
        panels,
        (("approach",), ("semi_major_axis", "semi_minor_axis")),
        ("approach δ", "ellipse: the worse of a and b"),
        strict=True,
    ):
        for index, form in enumerate(record["closed_forms"]):
            error = 100.0 * max(abs(form["error"][name]) for name in names)
            if error == 0.0:  # has no place on a logarithmic axis
                axes.plot([], [], " ", label=f"{form['label']}: error 0, not shown")
                continue
            for key, face, called in (
                ("compiled_seconds", f"C{index + 1}", "compiled"),
                ("python_seconds", "white", "from Python"),
            ):
                spread = form[key]
                if spread is None:
                    continue
                axes.errorbar(
                    [spread["median"]],
                    [error],
                    xerr=_bars([spread]),
                    marker=MARKS[index + 1],
                    color=f"C{index + 1}",
                    markerfacecolor=face,
                    linestyle="none",
                    elinewidth=0.8,
                    label=f"{form['label']}, {called}",
                )
        single = [100.0 * max(entry["single_position"]["worst"][name] for name in names) for entry in refinement]
        mean = [100.0 * max(abs(entry["error"][name]) for name in names) for entry in refinement]
        axes.errorbar(
            x,
            single,
            xerr=bars,
            marker="o",
            color="C0",
            markerfacecolor="white",
            linestyle=":",
            markersize=4.5,
            elinewidth=0.8,
            label="finite elements, one position, worst of 8",
        )
        axes.errorbar(
            x,
            mean,
            xerr=bars,
            marker="o",
            color="C0",
            markersize=4.5,
            elinewidth=0.8,
            label="finite elements, mean of 8 positions",
        )
        _number(axes, refinement, x, mean, 1.8)
        axes.set(xscale="log", yscale="log", xlabel="time of a contact, s", title=label)
        axes.title.set_fontsize(9)
        axes.set_xticks(10.0 ** np.arange(-8, 3))
        axes.minorticks_off()
        _grid(axes)
    panels[0].set_ylabel("error, %")
    panels[0].legend(fontsize=7.5, loc="lower right")
    return figure


FIGURES: dict[str, tuple[Callable[[Record], Figure], str]] = {
    "combined": (combined, "Closed forms and finite elements: error against time, for the approach and the ellipse"),
    "far-field": (
        far_field,
        "Error against time and memory: far field exact and clamped, one position of the edge and the mean",
    ),
    "families": (families, "Error against time and memory: element families"),
    "convergence": (convergence, "Errors over element size, with the slopes of theory"),
    "scaling": (scaling, "Time and memory over unknowns, linear solvers, fitted exponents"),
}
"""Every figure by name, with its caption, in the order of the report."""
