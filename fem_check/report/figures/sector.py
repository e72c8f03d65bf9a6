"""One ball between two rings: bodies, contacts, deviations from the quasi-static model."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]

from fem_check.report.figures.style import COLOURS, HERTZ, PRESSURE, Entry, load_axis, map_of
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


def sector_bodies(entry: Entry) -> Figure:
    """Ball and ring segments as they were meshed, cut at the plane of symmetry; pressure in colour."""
    bodies = entry["pictures"]["sector"]["bodies"]
    most = max(max(body["pressure"]) for body in bodies.values())
    colours, scale = PRESSURE, Normalize(0.0, most)
    figure = plt.figure(figsize=(10.0, 5.6), layout="constrained")
    views = (
        ("all three bodies", "outer ball inner", -62.0, 18.0),
        ("ball alone, from its inner contact", "ball", 150.0, -35.0),
    )
    for column, (name, shown, azimuth, elevation) in enumerate(views):
        axes = figure.add_subplot(1, 2, 1 + column, projection="3d")
        triangles, faces = [], []
        for body, base in (("outer", 0.62), ("ball", 0.86), ("inner", 0.74)):
            if body not in shown:
                continue
            x, y, z = (np.asarray(axis) for axis in bodies[body]["points"])
            corners = np.asarray(bodies[body]["triangles"])
            pressure = np.asarray(bodies[body]["pressure"])[corners].mean(axis=1)
            grey = np.array([base, base, base, 1.0])
            faces.append(np.where(pressure[:, None] > 0.0, colours(scale(pressure)), grey))
            # The picture's axes: bearing axis to the right, away from the plane of symmetry, radius upwards.
            triangles.append(np.stack([x, z, y], axis=-1)[corners])
        every = np.concatenate(triangles)
        axes.add_collection3d(
            Poly3DCollection(
                every, facecolors=np.concatenate(faces), edgecolors="#00000060", linewidths=0.25, rasterized=True
            )
        )
        low, high = every.min(axis=(0, 1)), every.max(axis=(0, 1))
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]), title=name)
        axes.set_box_aspect(high - low)
        axes.view_init(elev=elevation, azim=azimuth)
        axes.set(xlabel="axial, mm", ylabel="along rolling, mm", zlabel="radius, mm")
        axes.tick_params(labelsize=7)
        axes.yaxis.set_major_locator(MaxNLocator(2))
        if shown == "ball":
            axes.set_axis_off()
    figure.colorbar(ScalarMappable(scale, colours), ax=figure.axes, label="contact pressure, MPa", shrink=0.6)
    figure.suptitle(f"{entry['pictures']['sector']['label']}: half a ball and its segments of both rings", fontsize=10)
    return figure


def sector_contacts(entry: Entry) -> Figure:
    """Pressure over both contacts, and the gap of the deformed bodies along their axes."""
    sector = entry["pictures"]["sector"]
    figure, grid = plt.subplots(2, 2, figsize=(9.6, 5.6), layout="constrained")
    for (race, contact), (over, along) in zip(sector["contacts"].items(), grid, strict=True):
        x, y, p, gap = (np.asarray(contact[name]) for name in ("x", "y", "p", "gap"))
        u, v, w = np.concatenate([x, x[y > 0.0]]), np.concatenate([y, -y[y > 0.0]]), np.concatenate([p, p[y > 0.0]])
        pressed = w > 0.0
        a, b = np.abs(u[pressed]).max(), np.abs(v[pressed]).max()
        picture = map_of(over, u, v, w, a, b)
        figure.colorbar(picture, ax=over, label="pressure, MPa", ticks=MaxNLocator(6))
        over.set(
            xlabel="across the groove, mm",
            ylabel="along rolling, mm (stretched)",
            title=f"{race} raceway, {contact['load_N']:.0f} N",
        )
        middle = y < 1e-9
        along.plot(x[middle], p[middle], "o-", color="#d55e00", markersize=3)
        along.set(xlabel="across the groove, mm", ylabel="pressure, MPa", title=f"{race} raceway, plane of symmetry")
        right = along.twinx()
        right.plot(x[middle], np.maximum(gap[middle], 0.0), "s--", color="#0072b2", markersize=3)
        right.set_ylabel("gap, µm")
        along.text(0.0, 0.1 * p.max(), "pressure", color="#d55e00", ha="center")
        right.text(x[middle].max(), 0.9 * gap[middle].max(), "gap", color="#0072b2", ha="right")
    figure.suptitle(sector["label"], fontsize=10)
    return figure
