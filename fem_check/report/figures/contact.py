"""One contact: pressure, shear below it, mesh."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation

from fem_check.report.figures.style import FOUND, HERTZ, PRESSURE, Entry, map_of


def pressure_map(entry: Entry) -> Figure:
    """Pressure over the ellipse, with Hertz's outline."""
    contact = entry["pictures"]["contact"]
    x, y, p = (np.asarray(contact["ellipse"][name]) for name in "xyp")
    loaded = x**2 + y**2 < 1.15
    figure, axes = plt.subplots(figsize=(7.2, 3.4), layout="constrained")
    # One quarter is solved, of true bodies one half; the picture is mirrored in the planes of symmetry.
    every_x, every_y, every_p = [], [], []
    for sx in (1, -1) if x.min() >= 0.0 else (1,):
        for sy in (1, -1):
            every_x.append(sx * x[loaded])
            every_y.append(sy * y[loaded])
            every_p.append(p[loaded])
    u, v, w = (np.concatenate(parts) for parts in (every_x, every_y, every_p))
    _, first = np.unique(np.round(np.stack([u, v]), 6), axis=1, return_index=True)
    a, b = contact["a_mm"], contact["b_mm"]
    picture = map_of(axes, u[first] * a, v[first] * b, w[first] * contact["p0_MPa"], a, b)
    angle = np.linspace(0.0, 2.0 * np.pi, 361)
    axes.plot(a * np.cos(angle), b * np.sin(angle), color="black", linewidth=1.2, label="Hertz's edge")
    axes.legend(loc="upper right")
    figure.colorbar(picture, ax=axes, label="pressure, MPa", ticks=MaxNLocator(8))
    axes.set(xlabel="across the groove, mm", ylabel="along rolling, mm (stretched)", title=title(contact))
    return figure


def title(contact: dict[str, Any]) -> str:
    """What is shown."""
    return f"{contact['name']}, Q = {contact['load_N']:.0f} N ({contact['label']})"


def profiles(entry: Entry) -> Figure:
    """Pressure along both axes."""
    contact = entry["pictures"]["contact"]
    figure, panels = plt.subplots(1, 2, figsize=(8.4, 3.3), sharey=True, layout="constrained")
    r = np.linspace(0.0, 1.0, 400)
    for axes, key, name in zip(panels, ("x", "y"), ("a", "b"), strict=True):
        axes.plot(r, np.sqrt(1.0 - r**2), label="Hertz", **HERTZ)
        along = contact[f"along_{key}"]
        axes.plot(along[key], along["p"], label="finite elements, all positions", **FOUND)
        axes.set(xlabel=f"{key}/{name}", xlim=(0, 1.25))
    panels[0].set(ylabel="p/p0")
    panels[0].legend(loc="lower left")
    figure.suptitle(title(contact), fontsize=10)
    return figure


def shear_map(entry: Entry) -> Figure:
    """Largest shear below the surface, in the plane across the short axis."""
    contact = entry["pictures"]["contact"]
    y, z, tau = (np.asarray(contact["shear"][name]) for name in ("y", "z", "tau"))
    # The two Gauss points of an element on either side of the plane x = 0 fall on one point of it: their mean.
    positions, where = np.unique(np.round(np.stack([y, z]), 5), axis=1, return_inverse=True)
    tau = np.bincount(where.ravel(), tau) / np.bincount(where.ravel())
    y, z = positions
    seen = (z < 2.2) & (y < 1.35)
    figure, axes = plt.subplots(figsize=(6.0, 4.4), layout="constrained")
    mirrored = Triangulation(np.concatenate([y[seen], -y[seen]]), np.concatenate([z[seen], z[seen]]))
    shown = np.concatenate([tau[seen], tau[seen]])
    picture = axes.tricontourf(mirrored, shown, levels=18, cmap=PRESSURE)
    picture.set(edgecolor="face", linewidth=0.4)  # else the page shows light lines between the levels
    lines = axes.tricontour(mirrored, shown, levels=list(picture.levels)[::4], colors="black", linewidths=0.9)
    figure.colorbar(picture, ax=axes, label="largest shear stress over p0").add_lines(lines)
    axes.plot(0.0, contact["max_shear_depth_over_b"], "k+", markersize=11, label="theory: largest on the axis")
    axes.legend(loc="lower right")
    axes.invert_yaxis()
    axes.set(xlabel="y/b", ylabel="depth z/b", title=title(contact))
    return figure


def mesh(entry: Entry) -> Figure:
    """The block's lines, seen from above and from the side."""
    lines = entry["pictures"]["mesh"]
    figure, panels = plt.subplots(1, 2, figsize=(8.4, 4.0), layout="constrained")
    for axes, (first, second, labels) in zip(
        panels, (("x", "y", ("x/a", "y/b")), ("y", "z", ("y/b", "depth z/b"))), strict=True
    ):
        _grid(axes, lines[first], lines[second])
        axes.set(xlabel=labels[0], ylabel=labels[1], aspect="equal")
    angle = np.linspace(0.0, 0.5 * np.pi, 91)
    panels[0].plot(np.cos(angle), np.sin(angle), color="#d55e00", linewidth=1.8)
    panels[1].plot([0.0, 1.0], [0.0, 0.0], color="#d55e00", linewidth=4)
    panels[1].invert_yaxis()
    figure.suptitle(f"{lines['elements']} hexahedra with 20 nodes; red: the contact", fontsize=10)
    return figure


def _grid(axes: Axes, across: list[float], along: list[float]) -> None:
    axes.vlines(across, along[0], along[-1], color="grey", linewidth=0.6)
    axes.hlines(along, across[0], across[-1], color="grey", linewidth=0.6)
