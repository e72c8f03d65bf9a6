"""Pictures, drawn from the numbers in the records, each with the words for those who do not see it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.tri import Triangulation
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]

from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Picture

Entry = dict[str, Any]
HERTZ: dict[str, Any] = {"color": "black", "linewidth": 1.2}
FOUND: dict[str, Any] = {"color": "#c44e52", "marker": ".", "linestyle": "none", "markersize": 3}


def load_axis(axes: Axes, loads: list[float]) -> None:
    """A logarithmic axis that names the loads solved for, and nothing between them."""
    axes.set_xticks(loads, [f"{load:g}" for load in loads], fontsize=8)
    axes.minorticks_off()
    axes.set_xlabel("load, N")


def pressure_map(entry: Entry) -> Figure:
    """Pressure over the ellipse, with Hertz's outline."""
    contact = entry["pictures"]["contact"]
    x, y, p = (np.asarray(contact["ellipse"][name]) for name in "xyp")
    loaded = x**2 + y**2 < 1.15
    figure, axes = plt.subplots(figsize=(7.2, 3.4), layout="constrained")
    # One quarter is solved; the picture is mirrored in both planes of symmetry.
    every_x, every_y, every_p = [], [], []
    for sx in (1, -1):
        for sy in (1, -1):
            every_x.append(sx * x[loaded])
            every_y.append(sy * y[loaded])
            every_p.append(p[loaded])
    u, v, w = (np.concatenate(parts) for parts in (every_x, every_y, every_p))
    _, first = np.unique(np.round(np.stack([u, v]), 6), axis=1, return_index=True)
    a, b = contact["a_mm"], contact["b_mm"]
    picture = axes.tricontourf(
        Triangulation(u[first] * a, v[first] * b), w[first] * contact["p0_MPa"], levels=16, cmap="viridis"
    )
    angle = np.linspace(0.0, 2.0 * np.pi, 361)
    axes.plot(a * np.cos(angle), b * np.sin(angle), color="white", linewidth=1.5, label="Hertz")
    axes.legend(loc="upper right", facecolor="grey", labelcolor="white")
    figure.colorbar(picture, ax=axes, label="pressure, MPa")
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
    picture = axes.tricontourf(mirrored, np.concatenate([tau[seen], tau[seen]]), levels=18, cmap="magma")
    figure.colorbar(picture, ax=axes, label="largest shear stress over p0")
    axes.plot(0.0, contact["max_shear_depth_over_b"], "wx", markersize=9, label="theory: largest on the axis")
    axes.legend(loc="lower right", facecolor="grey", labelcolor="white")
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
    panels[0].plot(np.cos(angle), np.sin(angle), color="#c44e52", linewidth=1.8)
    panels[1].plot([0.0, 1.0], [0.0, 0.0], color="#c44e52", linewidth=4)
    panels[1].invert_yaxis()
    figure.suptitle(f"{lines['elements']} hexahedra with 20 nodes; red: the contact", fontsize=10)
    return figure


def _grid(axes: Axes, across: list[float], along: list[float]) -> None:
    axes.vlines(across, along[0], along[-1], color="grey", linewidth=0.6)
    axes.hlines(along, across[0], across[-1], color="grey", linewidth=0.6)


def load_series(entry: Entry) -> Figure:
    """Deviation from Hertz over the load, one mesh."""
    series = entry["pictures"]["load_series"]
    figure, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
    for name in ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure", "max_shear_stress"):
        ratio = np.asarray(series[name]) / np.asarray(series[f"hertz_{name}"])
        axes.semilogx(series["load_N"], 100.0 * (ratio - 1.0), marker="o", markersize=3, label=name.replace("_", " "))
    axes.axhline(0.0, **HERTZ)
    axes.set(xlabel="load, N", ylabel="finite elements over Hertz, minus 1, %", title="one mesh, two decades of load")
    axes.legend(fontsize=8)
    return figure


def body_size(entry: Entry) -> Figure:
    """Approach of clamped boxes over their size."""
    series = entry["pictures"]["body_size"]
    figure, axes = plt.subplots(figsize=(6.0, 3.4), layout="constrained")
    inverse = 1.0 / np.asarray(series["size"])
    axes.plot(inverse, 1e6 * np.asarray(series["approach"]), "o", color="#c44e52", label="clamped boxes")
    axes.plot([0.0], [1e6 * series["limit"]], "s", color="#c44e52", label="their limit")
    axes.plot([0.0], [1e6 * series["far_field"]], "x", color="#4c72b0", markersize=10, label="exact far field")
    axes.axhline(1e6 * series["hertz"], label="Hertz", **HERTZ)
    axes.set(xlabel="semi-major axis over half-width of the box", ylabel="approach, µm")
    axes.legend()
    return figure


def convergence(entry: Entry) -> Figure:
    """Errors over element size."""
    series = entry["pictures"]["convergence"]
    figure, axes = plt.subplots(figsize=(6.4, 4.0), layout="constrained")
    for index, name in enumerate(("approach", "semi_major_axis", "semi_minor_axis", "max_pressure")):
        colour = f"C{index}"
        label = name.replace("_", " ")
        axes.loglog(series["size"], 100.0 * np.asarray(series["rms_error"][name]), "o-", color=colour, label=label)
        axes.loglog(
            series["size"], 100.0 * np.asarray(series["worst_single_position"][name]), ":", color=colour, linewidth=1
        )
    axes.set(
        xlabel="element size over semi-axis",
        ylabel="error, %",
        title="solid: mean over positions; dotted: worst single position",
    )
    axes.legend(fontsize=8)
    return figure


def true_geometry(entry: Entry) -> Figure:
    """The true contact and the gap's shape alone, over Hertz, against the load."""
    series = entry["pictures"]["true_geometry"]
    figure, grid = plt.subplots(2, 2, figsize=(8.4, 6.0), sharex=True, layout="constrained")
    names = ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure")
    for axes, name in zip(grid.ravel(), names, strict=True):
        for race, part in series.items():
            style = "-" if race == "inner" else "--"
            for key, colour, label in (
                ("gap_shape", "#4c72b0", "exact gap"),
                ("true_contact", "#c44e52", "exact gap, pressure along the surface"),
            ):
                values, spread = part[f"{key}_percent"][name], part[f"{key}_uncertainty"][name]
                axes.errorbar(
                    part["load_N"], values, spread, fmt=f"o{style}", color=colour, markersize=3, capsize=3,
                    label=f"{label}, {race}",
                )  # fmt: skip
            values = part["boundary_elements_percent"][name]
            axes.plot(part["load_N"], values, "k+", markersize=9, label=f"boundary elements, {race}")
        axes.set_xscale("log")
        axes.axhline(0.0, **HERTZ)
        axes.set(title=name.replace("_", " "), ylabel="deviation from Hertz, %")
    for axes in grid[1]:
        load_axis(axes, sorted({load for part in series.values() for load in part["load_N"]}))
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=2, fontsize=8)
    figure.suptitle("On true bodies; their own compliance, which moves the approach alone, left out", fontsize=10)
    return figure


def conformity(entry: Entry) -> Figure:
    """Worst deviation over load for each groove."""
    series = entry["pictures"]["conformity"]
    figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    for coefficient, curve in series["curves"].items():
        worst = np.max(np.abs(np.asarray(list(curve.values()))), axis=0)
        axes.loglog(series["load_N"], worst, "o-", markersize=3, label=f"f = {coefficient}")
    for limit in (1.0, 5.0):
        axes.axhline(limit, color="black", linewidth=0.8, linestyle=":")
    load_axis(axes, series["load_N"])
    axes.set(
        ylabel="worst of approach, a, b, p0: off Hertz by, %",
        title="B218 inner, groove radius varied",
    )
    axes.legend(fontsize=8)
    return figure


def bearing_sector(entry: Entry) -> Figure:
    """Deviation from the quasi-static model over the load, with uncertainty."""
    series = entry["pictures"]["bearing_sector"]
    names = (
        ("axial_displacement", "%"),
        ("inner load", "%"),
        ("inner angle", "degrees"),
        ("inner semi_major_axis", "%"),
        ("inner semi_minor_axis", "%"),
        ("inner max_pressure", "%"),
    )
    loads = sorted({load for states in series.values() for curve in states.values() for load in curve["load_N"]})
    figure, grid = plt.subplots(2, 3, figsize=(11.0, 6.0), layout="constrained")
    for axes in grid.ravel():  # limits first: a single load has no range of its own
        axes.set(xscale="log", xlim=(0.7 * loads[0], 1.4 * loads[-1]))
        load_axis(axes, loads)
        axes.set_xlabel("axial load, N")
    for index, (support, states) in enumerate(series.items()):
        for state, curve in states.items():
            for axes, (name, unit) in zip(grid.ravel(), names, strict=True):
                axes.errorbar(
                    curve["load_N"],
                    curve[name]["deviation"],
                    curve[name]["uncertainty"],
                    color=f"C{index}",
                    linestyle="-" if state == "at rest" else "--",
                    marker="o",
                    markersize=3,
                    capsize=3,
                    label=f"{support}, {state}",
                )
                axes.set(title=name.replace("_", " "), ylabel=f"elements less model, {unit}")
    for axes in grid.ravel():
        axes.axhline(0.0, **HERTZ)
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3, fontsize=8)
    return figure


def sector_bodies(entry: Entry) -> Figure:
    """Ball and ring segments as they were meshed, cut at the plane of symmetry; pressure in colour."""
    bodies = entry["pictures"]["sector"]["bodies"]
    most = max(max(body["pressure"]) for body in bodies.values())
    colours, scale = plt.get_cmap("plasma"), Normalize(0.0, most)
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
        mirrored = Triangulation(np.concatenate([x, x[y > 0.0]]), np.concatenate([y, -y[y > 0.0]]))
        picture = over.tricontourf(mirrored, np.concatenate([p, p[y > 0.0]]), levels=16, cmap="plasma")
        figure.colorbar(picture, ax=over, label="pressure, MPa")
        over.set(
            xlabel="across the groove, mm",
            ylabel="along rolling, mm (stretched)",
            title=f"{race} raceway, {contact['load_N']:.0f} N",
        )
        middle = y < 1e-9
        along.plot(x[middle], p[middle], "o-", color="#c44e52", markersize=3)
        along.set(xlabel="across the groove, mm", ylabel="pressure, MPa", title="in the plane of symmetry")
        right = along.twinx()
        right.plot(x[middle], np.maximum(gap[middle], 0.0), "s--", color="#4c72b0", markersize=3)
        right.set_ylabel("gap, µm")
        along.text(0.0, 0.1 * p.max(), "pressure", color="#c44e52", ha="center")
        right.text(x[middle].max(), 0.9 * gap[middle].max(), "gap", color="#4c72b0", ha="right")
    figure.suptitle(sector["label"], fontsize=10)
    return figure


class Drawing(NamedTuple):
    """What draws a picture, its caption, and what it shows."""

    draw: Callable[[Entry], Figure]
    caption: str
    alt: str


DRAWN = {
    "contact": Drawing(
        pressure_map,
        "Pressure over the ellipse, Hertz's outline in white",
        "Map of the contact pressure: elliptic contours, highest in the middle, ending at Hertz's outline.",
    ),
    "contact profiles": Drawing(
        profiles,
        "Pressure along both axes",
        "Pressure along both axes of the ellipse: points of the finite elements on Hertz's half circle.",
    ),
    "contact shear": Drawing(
        shear_map,
        "Largest shear stress below the surface",
        "Map of the shear stress below the contact, with its largest value on the axis where theory has it.",
    ),
    "mesh": Drawing(
        mesh, "Mesh", "Lines of the mesh from above and from the side, finest at the contact, coarser away from it."
    ),
    "load_series": Drawing(
        load_series,
        "Deviation over the load",
        "Deviation of five quantities from Hertz over the load, level: one mesh serves every load.",
    ),
    "body_size": Drawing(
        body_size,
        "Approach of clamped boxes",
        "Approach against the inverse size of the box: a straight line to the value with the exact far field.",
    ),
    "convergence": Drawing(
        convergence, "Convergence", "Errors of four quantities falling with the element size, in double logarithms."
    ),
    "true_geometry": Drawing(
        true_geometry,
        "True bodies against Hertz",
        "Deviation of approach, semi-axes and pressure from Hertz over the load, for the exact gap and true bodies.",
    ),
    "conformity": Drawing(
        conformity,
        "Closing grooves",
        "Worst deviation from Hertz over the load, one line for each groove radius: the closer the groove, the larger.",
    ),
    "sector bodies": Drawing(
        sector_bodies,
        "What was solved: half a ball and its segments of both rings, as meshed",
        "The meshed half ball between segments of both rings, and the ball alone with its contact in colour.",
    ),
    "sector contacts": Drawing(
        sector_contacts,
        "Pressure and gap of both contacts of the ball",
        "Pressure maps of the inner and the outer contact, and pressure and gap across the groove.",
    ),
    "bearing_sector": Drawing(
        bearing_sector,
        "One ball between two elastic rings: deviation from the quasi-static model",
        "Six panels of deviations over the axial load, with the outside diameter rigid and free, at rest and at speed.",
    ),
}


def draw_all(entry: Entry) -> list[Picture]:
    """Every picture that a record has numbers for."""
    found = []
    for key, drawing in DRAWN.items():
        if key.split()[0] in entry["pictures"]:
            figure = drawing.draw(entry)
            found.append(picture(figure, drawing.alt, drawing.caption, min(1.0, figure.get_size_inches()[0] / 9.0)))
            plt.close(figure)
    return found
