"""One ball between two rings: bodies, contacts, deviations from the quasi-static model."""

from __future__ import annotations

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from fem_check.report.figures.style import COLOURS, HERTZ, Entry, load_axis
from fem_check.report.rows import quantity


def bearing_sector(entry: Entry) -> Figure:
    """Deviation from the quasi-static model over the load, with uncertainty."""
    series = entry["pictures"]["bearing_sector"]
    names = (
        ("axial_displacement", "µm"),
        ("inner load", "%"),
        ("inner angle", "degrees"),
        ("inner semi_major_axis", "%"),
        ("inner semi_minor_axis", "%"),
        ("inner max_pressure", "%"),
    )
    loads = sorted({load for states in series.values() for curve in states.values() for load in curve["load_N"]})
    figure, grid = plt.subplots(3, 2, figsize=(8.6, 8.6), layout="constrained")
    figure.get_layout_engine().set(h_pad=0.09, w_pad=0.09)  # type: ignore[union-attr,call-arg]  # no title touches the next
    for axes in grid.ravel():  # limits first: a single load has no range of its own
        axes.set(xscale="log", xlim=(0.7 * loads[0], 1.4 * loads[-1]))
        load_axis(axes, loads)
        axes.set_xlabel("axial load, N")
    for index, (support, states) in enumerate(series.items()):
        for state, curve in states.items():
            for axes, (name, unit) in zip(grid.ravel(), names, strict=True):
                if unit == "µm":
                    found = [micrometres(entry, support, state, load) for load in curve["load_N"]]
                    deviation, uncertainty = [each for each, _ in found], [each for _, each in found]
                else:
                    deviation, uncertainty = curve[name]["deviation"], curve[name]["uncertainty"]
                axes.errorbar(
                    curve["load_N"],
                    deviation,
                    uncertainty,
                    color=COLOURS[index % len(COLOURS)],
                    linestyle="-" if state == "at rest" else "--",
                    marker="o",
                    markersize=3,
                    capsize=3,
                    label=f"{support}, {state}",
                )
                axes.set(title=quantity(name), ylabel=f"elements minus model, {unit}")
    for axes in grid.ravel():
        axes.axhline(0.0, **HERTZ)
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3, fontsize=9, frameon=False)
    return figure


def micrometres(entry: Entry, series: str, state: str, load: float) -> tuple[float, float]:
    """Axial displacement, elements minus model, and its uncertainty [µm]: at speed it passes through zero as the load
    falls, where a per cent of it says nothing.

    Args:
        series: outside diameter, and step.
        state: at rest or at speed.
        load: axial [N].
    """
    (row,) = [
        row
        for row in entry["rows"]
        if row["quantity"] == "axial_displacement"
        and row["case"].startswith(f"Fa = {load:.0f} N, ")
        and row["case"].endswith(f"outside diameter {series}")
        and ("at rest" in row["case"]) == (state == "at rest")
    ]
    return 1e6 * (row["found"] - row["reference"]), 1e4 * row["uncertainty_percent"] * abs(row["reference"])


def displacement(entry: Entry) -> Figure:
    """Axial displacement at speed, elements minus model, over the load."""
    figure, axes = plt.subplots(figsize=(5.0, 2.8), layout="constrained")
    for colour, (support, states) in zip(COLOURS, entry["pictures"]["bearing_sector"].items(), strict=False):
        if "at speed" not in states:
            continue
        loads = states["at speed"]["load_N"]
        found = [micrometres(entry, support, "at speed", load) for load in loads]
        axes.errorbar(
            loads, [each for each, _ in found], [each for _, each in found],
            color=colour, marker="o", markersize=3, capsize=3, label=f"outside diameter {support}",
        )  # fmt: skip
        axes.set_xscale("log")
        load_axis(axes, loads)
    axes.axhline(0.0, **HERTZ)
    axes.set(xlabel="axial load, N", ylabel="elements minus model, µm")
    axes.legend(fontsize=8)
    return figure
