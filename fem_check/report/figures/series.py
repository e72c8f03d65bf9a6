"""Deviations from Hertz over load, size of the body, element size, groove radius."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from fem_check.report.figures.style import COLOURS, HERTZ, load_axis
from fem_check.report.rows import quantity
from fem_check.rows.record import Record


def load_series(entry: Record) -> Figure:
    """Deviation from Hertz over the load, one mesh."""
    series = entry["pictures"]["load_series"]
    figure, axes = plt.subplots(figsize=(5.0, 2.8), layout="constrained")
    axes.set_prop_cycle(color=COLOURS)
    for name in ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure", "max_shear_stress"):
        ratio = np.asarray(series[name]) / np.asarray(series[f"hertz_{name}"])
        axes.semilogx(series["load_N"], 100.0 * (ratio - 1.0), marker="o", markersize=3, label=quantity(name))
    axes.axhline(0.0, **HERTZ)
    axes.set(xlabel="load, N", ylabel="deviation from Hertz, %")
    axes.legend(fontsize=8)
    return figure


def body_size(entry: Record) -> Figure:
    """Approach of clamped boxes over their size."""
    series = entry["pictures"]["body_size"]
    figure, axes = plt.subplots(figsize=(5.0, 2.8), layout="constrained")
    inverse = 1.0 / np.asarray(series["size"])
    axes.plot(inverse, 1e6 * np.asarray(series["approach"]), "o", color="#d55e00", label="clamped boxes")
    axes.plot([0.0], [1e6 * series["limit"]], "s", color="#d55e00", label="their limit")
    axes.plot([0.0], [1e6 * series["far_field"]], "x", color="#0072b2", markersize=10, label="exact far field")
    axes.axhline(1e6 * series["hertz"], label="Hertz", **HERTZ)
    axes.set(xlabel="semi-major axis over half-width of the box", ylabel="approach, µm")
    axes.legend()
    return figure


def convergence(entry: Record) -> Figure:
    """Errors over element size."""
    series = entry["pictures"]["convergence"]
    figure, axes = plt.subplots(figsize=(5.0, 2.8), layout="constrained")
    for index, name in enumerate(("approach", "semi_major_axis", "semi_minor_axis", "max_pressure")):
        colour = COLOURS[index]
        label = quantity(name)
        axes.loglog(series["size"], 100.0 * np.asarray(series["rms_error"][name]), "o-", color=colour, label=label)
        axes.loglog(
            series["size"], 100.0 * np.asarray(series["worst_single_position"][name]), ":", color=colour, linewidth=1.6
        )
    axes.set(
        xlabel="element size over semi-axis",
        ylabel="error, %",
    )
    axes.legend(fontsize=8)
    return figure


def true_geometry(entry: Record) -> Figure:
    """The true contact and the gap's shape alone, over Hertz, against the load."""
    series = entry["pictures"]["true_geometry"]
    figure, grid = plt.subplots(2, 2, figsize=(8.4, 4.0), sharex=True, layout="constrained")
    names = ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure")
    for axes in grid.ravel():
        # First: its ends at 0 and 1 warn on a logarithmic axis, and beside the one load of the quick level.
        axes.axhline(0.0, **HERTZ)
    for axes, name in zip(grid.ravel(), names, strict=True):
        for race, part in series.items():
            style = "-" if race == "inner" else "--"
            for key, colour, label in (
                ("gap_shape", "#0072b2", "exact gap"),
                ("true_contact", "#d55e00", "exact gap, pressure along the surface"),
            ):
                values, spread = part[f"{key}_percent"][name], part[f"{key}_uncertainty"][name]
                axes.errorbar(
                    part["load_N"], values, spread, fmt=f"o{style}", color=colour, markersize=3, capsize=3,
                    label=f"{label}, {race}",
                )  # fmt: skip
            values = part["boundary_elements_percent"][name]
            axes.plot(part["load_N"], values, "k+", markersize=9, label=f"boundary elements, {race}")
        axes.set_xscale("log")
        axes.set(title=quantity(name), ylabel="off Hertz by, %")
    for axes in grid[1]:
        load_axis(axes, sorted({load for part in series.values() for load in part["load_N"]}))
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=2, fontsize=8)
    return figure


def conformity(entry: Record) -> Figure:
    """Worst deviation over load for each groove."""
    series = entry["pictures"]["conformity"]
    figure, axes = plt.subplots(figsize=(5.0, 2.8), layout="constrained")
    axes.set_prop_cycle(color=COLOURS)
    for coefficient, curve in series["curves"].items():
        worst = np.max(np.abs(np.asarray(list(curve.values()))), axis=0)
        axes.loglog(series["load_N"], worst, "o-", markersize=3, label=f"f = {coefficient}")
    for limit in (1.0, 5.0):
        axes.axhline(limit, color="black", linewidth=0.8, linestyle=":")
    load_axis(axes, series["load_N"])
    axes.set(
        ylabel="off Hertz by, %",
    )
    axes.legend(fontsize=8)
    return figure
