"""The pictures of the page, which follow its sliders: those of a report, each alone and without a search for room."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from io import BytesIO
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from qsbearing.documents.drawing import inlined
from qsbearing.model.scene.scene import SPEED_PARAMETER_MAX
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import mm, rpm, um
from qsbearing.pictures.contact_angles import draw_angles
from qsbearing.pictures.contact_ellipses import draw_ellipses
from qsbearing.pictures.ellipse_on_groove import draw_grooves
from qsbearing.pictures.load_distribution import draw_loads
from qsbearing.pictures.section import draw_section
from qsbearing.pictures.style import GREY, of_results
from qsbearing.pictures.under_load import under_load
from qsbearing.readings.asked import take_asked
from qsbearing.readings.rating_life import HOUR
from qsbearing.reports.curves import finish, mark_stiffness
from qsbearing.studies.chooser.choose import solve
from qsbearing.systems.sets.set_solution import SetSolution

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

POINTS = 31
TOP, LOW = 1.5, 0.02
"""Curves go from LOW of their end to TOP times the scene's speed."""
AT_REST = 5e5
"""dm n [mm rpm] at the end of the curves of a bearing that stands still: an ordinary grease-lubricated spindle's."""


class Panel(NamedTuple):
    """One picture."""

    draw: Callable[[Axes, Solution], None]
    size: tuple[float, float]
    """[inches]."""
    alt: str
    projection: str | None = None
    room: tuple[float, float, float, float] = (0.15, 0.15, 0.82, 0.74)
    """Left, bottom, width, height of the axes, as parts of the picture."""


def _of_point(draw: Callable[..., None]) -> Callable[[Axes, Solution], None]:
    return lambda axes, solution: draw(axes, solution, ())


def _over_speed(solution: Solution) -> tuple[Solution, Any, int]:
    """The scene over a range of speeds, its own among them, these in rpm, and the number of its own."""
    scene = solution.scene
    own = abs(float(np.asarray(scene.operation.speed)))
    pitch = float(np.asarray(scene.bearing.pitch_diameter))
    top = min(TOP * own or AT_REST * mm * rpm / pitch, SPEED_PARAMETER_MAX * mm * rpm / pitch)
    speeds = np.unique(np.append(np.linspace(LOW * top, top, POINTS), own))
    sign = -1.0 if float(np.asarray(scene.operation.speed)) < 0.0 else 1.0
    readings = {name: given for name, given in scene.readings.items() if name in ("lubricant", "life")}
    requested = replace(scene, readings={"life": {}, **readings})
    swept = solve(replace(requested, operation=replace(scene.operation, speed=sign * speeds)))
    return swept, sign * speeds / rpm, int(np.searchsorted(speeds, own))


def _stiffness(axes: Axes, solution: Solution) -> None:
    swept, along, own = _over_speed(solution)
    mark_stiffness(axes, along, swept.locked_stiffness, swept.converged)
    _finish(axes, along[own], swept.locked_stiffness[own, :2] * um, "locked stiffness, N/µm", solution)


def _life(axes: Axes, solution: Solution) -> None:
    from matplotlib.ticker import LogLocator

    swept, along, own = _over_speed(solution)
    hours = np.where(swept.converged, take_asked(swept)["life"].duration, np.nan) / HOUR
    hours[~np.isfinite(hours)] = np.nan
    axes.plot(along, hours, color="black")
    if of_results(axes.yaxis, "h", hours):
        axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    _finish(axes, along[own], hours[own : own + 1], "life, h", solution)


def _finish(axes: Axes, speed: float, values: Any, name: str, solution: Solution) -> None:
    held = "" if solution.thermal is None else ", temperatures as here"  # to balance heat again takes seconds
    finish((axes,), (f"{name}{held}",), speed, "inner ring, rpm")
    axes.plot(np.full(np.size(values), speed), values, "o", color=GREY, markersize=7, markerfacecolor="none")


PANELS = {
    "section": Panel(
        _of_point(draw_section), (5.6, 3.8), "Section through the ball that carries most.", room=(0.1, 0.0, 0.8, 0.92)
    ),
    "angles": Panel(_of_point(draw_angles), (4.4, 3.0), "Contact angles of every ball by its azimuth."),
    "loads": Panel(
        _of_point(draw_loads),
        (4.0, 3.7),
        "Contact loads of all balls around the bearing.",
        "polar",
        room=(0.15, 0.08, 0.7, 0.72),
    ),
    "stiffness": Panel(_stiffness, (4.4, 3.0), "Axial and radial stiffness over the speed, this speed marked."),
    "life": Panel(_life, (4.4, 3.0), "Life over the speed, this speed marked."),
    "ellipses": Panel(
        _of_point(draw_ellipses),
        (9.0, 3.6),
        "Contact ellipses to scale with their pressures.",
        room=(0.08, 0.12, 0.9, 0.78),
    ),
    "grooves": Panel(
        _of_point(draw_grooves),
        (5.6, 3.9),
        "The most loaded contact ellipse on each groove, with the edges of its shoulders.",
        room=(0.03, 0.14, 0.94, 0.7),
    ),
}
SHAFT = "shaft"
OF_ROW = ("section", "loads", "angles", "ellipses", "grooves")
"""The pictures of one row of a set; over the speed a row has none, for it does not run alone."""
ALT = {name: panel.alt for name, panel in PANELS.items()} | {
    SHAFT: "The shaft as it bends in the plane in which its first point moves; contact loads of every row's balls."
}


def names(solution: Solution | SetSolution) -> list[str]:
    """The pictures that a solution has."""
    if isinstance(solution, Solution):
        return list(PANELS)
    return [SHAFT, *OF_ROW]


def drawn(name: str, solution: Solution | SetSolution, row: int = 0) -> str:
    """One of `names` as SVG that stands within a page.

    Args:
        row: of a set, which of its rows; from 0.
    """
    from matplotlib import rc_context

    data = BytesIO()
    with rc_context({"svg.fonttype": "none", "svg.hashsalt": name}):
        figure = _figure(name, solution, row)
        figure.savefig(data, format="svg", metadata={"Date": None, "Creator": None})
    return inlined(data.getvalue(), f"{name}-")


def _figure(name: str, of: Solution | SetSolution, row: int) -> Figure:
    from matplotlib.figure import Figure

    if isinstance(of, SetSolution) and name == SHAFT:
        return under_load(of)
    panel, solution = PANELS[name], of.rows[row] if isinstance(of, SetSolution) else of
    figure = Figure(figsize=panel.size)
    axes = figure.add_axes(panel.room, projection=panel.projection)
    panel.draw(axes, solution)
    if name == "angles":
        axes.legend(fontsize=8, frameon=False)
    return figure
