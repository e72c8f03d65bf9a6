"""Curves around the operating point: over the speed, and over all loads in proportion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Block, Callout, Paragraph, Section
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.solver import solve
from qsbearing.model.units import MPa, deg, rpm, um
from qsbearing.pictures.operating_maps import loaded
from qsbearing.pictures.style import CHANNEL_LINES, GREY, STYLE, figure_of_size, legend, legend_within, plain
from qsbearing.reports.over_speed import Swept
from qsbearing.systems.sets.set_solution import SetSolution

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

POINTS = 41
FOLLOWS = {True: "axial displacement, µm", False: "axial load, N"}
"""What the axial channel answers with, where it is free to move and where it is held."""
SPEED_RANGE, LOAD_RANGE = (0.1, 1.5), (0.25, 1.75)
"""Parts of the scene's own speed and loads."""

SIZE = 11.5, 2.3
"""Of four panels side by side [inches]."""
CURVES = "contact angles, maximum pressures, the axial answer, axial and radial stiffness"


def over_speed(solution: Solution) -> Swept | None:
    """The case at other speeds; None where nothing depends on the speed."""
    scene = solution.scene
    operation = scene.operation
    own = float(np.asarray(operation.speed))
    if own == 0.0 or not (scene.ball_effects or scene.ring_effects):
        return None
    speeds = own * np.linspace(*SPEED_RANGE, POINTS)
    return Swept(solve(replace(scene, operation=replace(operation, speed=speeds))), speeds, own)


def section(solution: Solution, swept: Swept | None) -> Section:
    """Both sweeps; what cannot be varied is said.

    Args:
        swept: as `over_speed` has it.
    """
    words = (
        "All other inputs are those of the operating point, temperatures among them. Angles are those of "
        "the ball with the largest inner load. Points without a solution are left out."
    )
    return Section("Around the operating point", [Paragraph(words), *_speed(swept), *_load(solution)], "curves")


def _speed(swept: Swept | None) -> list[Block]:
    if swept is None:
        return [Callout("No curve over the speed: the inner ring stands still, or nothing in the scene depends on it.")]
    figure = _figure(swept.solution, swept.speeds / rpm, swept.own / rpm, "inner ring, rpm")
    return shown(swept.solution, figure, "the speed of the inner ring", CURVES)


def _load(solution: Solution) -> list[Block]:
    scene = solution.scene
    parts = np.linspace(*LOAD_RANGE, POINTS)
    varied = loaded(scene, parts)
    if varied is None:
        return [Callout("No curve over the load: the scene prescribes displacements only.")]
    swept = solve(varied)
    figure = _figure(swept, parts, 1.0, "load factor (1 = this case)")
    return shown(swept, figure, "all loads in proportion", CURVES)


def shown(
    swept: Solution | SetSolution, figure: Figure, along: str, what: str, said: Sequence[str] = ()
) -> list[Block]:
    """The picture of what is swept, sentences, and how many points are left out."""
    lost = int((~np.asarray(swept.converged)).sum())
    alt = f"Curves over {along}: {what}; the operating point is marked."
    blocks: list[Block] = [
        picture(figure, alt, f"Results over {along}; the dotted line is the operating point"),
        *map(Paragraph, said),
    ]
    return [*blocks, Callout(f"{lost} of {POINTS} points have no solution.", "warning")] if lost else blocks


def _figure(swept: Solution, along: NDArray, own: float, label: str) -> Figure:
    figure = figure_of_size(*SIZE)
    angles, pressures, displacement, stiffness = figure.subplots(1, 4)
    solved = swept.converged
    load = np.where(solved[:, None], swept.inner.load, np.nan)
    heaviest = np.where(solved, np.argmax(np.nan_to_num(load, nan=-1.0), axis=-1), 0)[:, None]
    for side in ("inner", "outer"):
        contacts = getattr(swept, side)
        style = {key: STYLE[side][key] for key in ("color", "linestyle")} | {"label": f"{side} raceway"}
        of_ball = np.take_along_axis(contacts.angle, heaviest, axis=-1)[:, 0]
        angles.plot(along, np.where(solved, of_ball, np.nan) / deg, **style)
        pressures.plot(
            along, np.where(solved, np.nan_to_num(contacts.max_pressure).max(axis=-1), np.nan) / MPa, **style
        )
    is_free = 0 in swept.free_channels
    axial = swept.displacement[:, 0] / um if is_free else swept.load[:, 0]
    displacement.plot(along, np.where(solved, axial, np.nan), color=GREY)
    mark_stiffness(stiffness, along, swept.locked_stiffness, solved)
    names = ("contact angle, deg", "max. pressure, MPa", FOLLOWS[is_free], "locked stiffness, N/µm")
    finish((angles, pressures, displacement, stiffness), names, own, label)
    legend(figure, angles)
    return figure


def mark_stiffness(axes: Axes, along: NDArray, stiffness: NDArray, solved: NDArray) -> None:
    """Axial and radial stiffness of the cases that are solved; stiffness of shape (case, 5)."""
    for channel, name in enumerate(("axial", "radial y")):
        values = np.where(solved, stiffness[:, channel], np.nan) * um
        axes.plot(along, values, label=CHANNELS[channel].label, **CHANNEL_LINES[name])
    legend_within(axes)


def finish(panels: Sequence[Axes], names: Sequence[str], own: float, label: str) -> None:
    """What each panel shows, over what, and where along it the operating point is."""
    for axes, name in zip(panels, names, strict=True):
        axes.set_title(name, fontsize=9.5)
        axes.locator_params(axis="x", nbins=4)
        axes.axvline(own, color=GREY, linewidth=0.8, linestyle=":")
        axes.set_xlabel(label, fontsize=9)
        plain(axes)
