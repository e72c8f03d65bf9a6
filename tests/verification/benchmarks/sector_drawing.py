"""One ball between two rings: the guide's picture of its deviations from the quasi-static model."""

from __future__ import annotations

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from fem_check.report.figures.sector import micrometres
from fem_check.report.figures.style import COLOURS, HERTZ, load_axis
from fem_check.report.rows import quantity
from fem_check.rows.record import Record


def bearing_sector(entry: Record) -> Figure:
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
