"""The cost record as one picture: error against time, with the memory, the closed forms, and the meshes chosen."""

from __future__ import annotations

import io
from collections.abc import Sequence

import matplotlib

from fem_check.cost.record import CostRecord

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fem_check.cost.mesh_choice import choices

MARKS = "os^Dv"
ASIDE = 10.0
"""From a point to the middle of its number [pt]."""


def draw(record: CostRecord) -> Figure:
    """Worst error of a contact over the time it takes, for each element family, and for each mesh choice."""
    figure, axes = plt.subplots(figsize=(8.5, 5.5), layout="constrained")
    for index, family in enumerate(dict.fromkeys(entry["family"] for entry in record["meshes"])):
        entries = [entry for entry in record["meshes"] if entry["family"] == family]
        axes.plot(
            [entry["seconds"]["median"] for entry in entries],
            [100.0 * entry["worst_error"] for entry in entries],
            marker=MARKS[index],
            markersize=5,
            linewidth=2.2 if index == 0 else 1.0,
            label=family,
        )
        if index == 0:
            numbers = [entry["elements_per_semi_axis"] for entry in entries]
    chosen = choices(record)
    axes.plot(
        [choice.seconds for choice in chosen],
        [100.0 * choice.accuracy for choice in chosen],
        "k*--",
        markersize=9,
        linewidth=0.8,
        label="contact --accuracy: error and uncertainty, three meshes",
    )
    for choice in chosen:
        text = f"{choice.sequence[-1]}: {choice.peak_memory_MB:.0f} MB"
        axes.annotate(text, (choice.seconds, 100.0 * choice.accuracy), (6, 4), textcoords="offset points", fontsize=8)
    for form, style in zip(record["closed_forms"][:-1], (":", "-."), strict=True):
        text = f"{form['label']}, {1e6 * form['seconds']['median']:.1f} µs"
        axes.axhline(100.0 * form["worst_error"], color="grey", linewidth=1.0, linestyle=style, label=text)
    axes.set(xscale="log", yscale="log", xmargin=0.15, ymargin=0.1, xlabel="time of the contact, s")
    axes.set_ylabel("worst error of δ, a, b, p0, τmax, %")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter("{x:g}")
    axes.grid(which="major", color="0.88", linewidth=0.6)
    machine = record["machine"]
    axes.set_title(
        f"{record['contact']}, a/b = {record['ellipticity']:.2f}; numbers: elements per semi-axis; "
        f"{machine['processor']}, {machine['cores']} cores, {record['solver']}",
        fontsize=8,
    )
    axes.legend(fontsize=7.5)
    figure.draw_without_rendering()  # before, points have no place in the picture
    _number_points(axes, numbers)
    return figure


def _number_points(axes: Axes, numbers: Sequence[int]) -> None:
    """Write a number beside each point of the first line, on the side where the lines are farthest."""
    lines = []
    for line in axes.lines:
        corners = line.get_transform().transform(np.asarray(line.get_xydata()))
        steps = np.arange(0.0, len(corners) - 0.99, 0.01)
        lines.append(np.column_stack([np.interp(steps, range(len(corners)), part) for part in corners.T]))
    around = ASIDE * axes.figure.dpi / 72.0 * np.exp(1j * np.radians(np.arange(0.0, 360.0, 15.0)))
    offsets = np.column_stack([around.real, around.imag])
    points = np.asarray(axes.lines[0].get_xydata())
    for number, (x, y), place in zip(numbers, points, lines[0][::100], strict=True):
        away = [np.linalg.norm(np.vstack(lines) - place - offset, axis=1).min() for offset in offsets]
        best = offsets[np.argmax(away)] * 72.0 / axes.figure.dpi
        axes.annotate(
            str(number), (x, y), tuple(best), textcoords="offset points", fontsize=8, ha="center", va="center"
        )


def png(record: CostRecord) -> bytes:
    """The picture as a file, without the date and version that would change it."""
    figure = draw(record)
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=110, format="png", metadata={"Software": None})
    plt.close(figure)
    return buffer.getvalue()
