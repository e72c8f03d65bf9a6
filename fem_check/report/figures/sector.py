"""One ball between two rings: bodies, contacts, deviations from the quasi-static model."""

from __future__ import annotations

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from fem_check.report.figures.style import COLOURS, HERTZ, load_axis
from fem_check.rows.record import Record


def micrometres(entry: Record, series: str, state: str, load: float) -> tuple[float, float]:
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


def displacement(entry: Record) -> Figure:
    """Axial displacement at speed, elements minus model, over the load."""
    figure, axes = plt.subplots(figsize=(5.0, 2.8), layout="constrained")
    for colour, (support, states) in zip(COLOURS, entry["pictures"]["bearing_sector"].items(), strict=False):
        if "at speed" not in states:
            continue
        loads = states["at speed"]["load_N"]
        points = [micrometres(entry, support, "at speed", load) for load in loads]
        axes.errorbar(
            loads, [each for each, _ in points], [each for _, each in points],
            color=colour, marker="o", markersize=3, capsize=3, label=f"outside diameter {support}",
        )  # fmt: skip
        axes.set_xscale("log")
        load_axis(axes, loads)
    axes.axhline(0.0, **HERTZ)
    axes.set(xlabel="axial load, N", ylabel="elements minus model, µm")
    axes.legend(fontsize=8)
    return figure
