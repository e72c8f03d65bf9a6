"""Curves of a set around its operating point: over speed, loads and preload, with where a row loses its preload."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.model import Block, Callout, Paragraph, Section
from qsbearing.model.operation import CHANNELS
from qsbearing.model.units import MPa, rpm, um
from qsbearing.pictures.style import CHANNEL_LINES, RED, ROW_LINES, figure_of_size, legend, legend_within
from qsbearing.reports.curves import LOAD_RANGE, POINTS, SIZE, SPEED_RANGE, finish, mark_stiffness, shown
from qsbearing.reports.over_speed import Swept
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.preload_limits import (
    MOST,
    Limits,
    depends_on_speed,
    load_sentences,
    loaded,
    loads_of,
    set_at_speed,
    speed_sentences,
)
from qsbearing.systems.sets.preload_search import StateChange
from qsbearing.systems.sets.set_solution import SetSolution
from qsbearing.systems.sets.solve import solve_set

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BEYOND = 1.15
"""Times the load at which a row loses its preload: so far loads are shown, if that is not too far."""
Mark = tuple[float, str]
"""Where a row no longer keeps its preload, along the curve, and what happens there."""

NOTHING = "The shaft does not move,\nand no load holds it."
"""In the place of curves."""

CURVES = "axial load and maximum pressure of each row, displacement and stiffness of the shaft"


def over_speed(of: BearingSet) -> Swept | None:
    """The set at other speeds; None where nothing depends on the speed."""
    own = float(np.asarray(of.operation.speed))
    if own == 0.0 or not depends_on_speed(of):
        return None
    speeds = own * np.linspace(*SPEED_RANGE, POINTS)
    return Swept(solve_set(set_at_speed(of, speeds)), speeds, own)


def section(of: BearingSet, limits: Limits, swept: Swept | None) -> Section:
    """The sweeps that there are; what cannot be varied is said.

    Args:
        swept: as `over_speed` has it.
        limits: of the set's preload, to be marked.
    """
    speeds, loads = limits
    words = (
        "All other inputs are those of the operating point, temperatures among them. Dashed red lines mark "
        "where a row loses its preload, has too much of it or regains it. Points without a solution are left out."
    )
    blocks = [Paragraph(words), *_speed(of, swept, speeds), *_load(of, loads), *_preload(of)]
    return Section("Around the operating point", blocks, "curves")


def _speed(of: BearingSet, swept: Swept | None, changes: Sequence[StateChange]) -> list[Block]:
    if swept is None:
        return [Callout("No curve over the speed: the shaft stands still, or nothing in the set depends on it.")]
    marks = [(np.sign(swept.own) * each.value / rpm, _what(each)) for each in changes]
    figure = _figure(swept.solution, swept.speeds / rpm, swept.own / rpm, "shaft, rpm", marks)
    return shown(swept.solution, figure, "the speed of the shaft", CURVES, speed_sentences(of, changes))


def _load(of: BearingSet, changes: Sequence[StateChange]) -> list[Block]:
    if not loads_of(of):
        return [Callout("No curve over the loads: no load or moment acts on the shaft.")]
    marks = [(each.value, _what(each)) for each in changes]
    top = max([LOAD_RANGE[1], *(min(BEYOND * factor, MOST) for factor, _ in marks[:1])])
    factors = np.linspace(0.0, top, POINTS)
    swept = solve_set(loaded(of, factors))
    figure = _figure(swept, factors, 1.0, "load factor (1 = this case)", marks)
    said = load_sentences(of, changes)
    return shown(swept, figure, "all loads in proportion, the preload as it is", CURVES, said)


def _preload(of: BearingSet) -> list[Block]:
    if of.preload is None:
        return []
    kind = of.preload.kind
    own = float(np.asarray(getattr(of.preload, kind)))
    if own == 0.0:
        return []
    name, size = ("spring force, N", 1.0) if kind == "spring" else (f"preload {of.preload.state}, N", 1.0)
    if kind == "axial_displacement":
        name, size = "preload before fitting, µm", um
    values = own * np.linspace(*LOAD_RANGE, POINTS)
    swept = solve_set(replace(of, preload=replace(of.preload, **{kind: values}), readings={}))
    figure = _figure(swept, values / size, own / size, name, [])
    return shown(swept, figure, "the preload, the loads as they are", CURVES)


def _what(change: StateChange) -> str:
    name = f"row {change.row + 1}" if change.row >= 0 else "set"
    ends = {
        "maintained": "preload back",
        "lost": "preload lost",
        "excessive": "preload excessive",
        "no_equilibrium": "no equilibrium",
    }
    return f"{name}: {ends.get(change.after, 'not solved')}"


def _figure(swept: SetSolution, along: NDArray, own: float, label: str, marks: Sequence[Mark]) -> Figure:
    figure = figure_of_size(*SIZE)
    panels = list(figure.subplots(1, 4))
    loads, pressures, displacement, stiffness = panels
    solved = np.asarray(swept.converged)
    for number, (row, (colour, line)) in enumerate(zip(swept.rows, _lines(len(swept.rows)), strict=True)):
        carries = swept.set.rows[number].carries
        style: dict[str, Any] = {"color": colour, "linestyle": line, "label": f"row {number + 1} ({carries})"}
        loads.plot(along, swept.axial_loads[:, number], **style)
        greatest = np.fmax.reduce([np.fmax.reduce(side.max_pressure, axis=-1) for side in (row.inner, row.outer)])
        pressures.plot(along, np.where(solved, greatest, np.nan) / MPa, **style)
    answer = _answer(displacement, along, swept)
    mark_stiffness(stiffness, along, swept.locked_stiffness, solved)
    names = ("axial load of rows, N", "max. pressure of rows, MPa", answer)
    finish(panels, (*names, "locked stiffness, N/µm"), own, label)
    if not displacement.lines[:-1]:  # all but the line of the operating point
        displacement.clear()
        displacement.set_axis_off()
        displacement.text(0.5, 0.5, NOTHING, ha="center", va="center", fontsize=9, transform=displacement.transAxes)
    inside = [(place, what) for place, what in marks if along.min() <= place <= along.max()]
    for place, what in inside:
        for axes in panels:
            axes.axvline(place, color=RED, linewidth=1.0, linestyle=(0, (4, 3)))
        words: dict[str, Any] = {"rotation": 90, "fontsize": 7, "ha": "right", "va": "top", "color": RED}
        paper = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.8}
        panels[0].text(place, panels[0].get_ylim()[1], f"{what} ", **words, bbox=paper)
    legend(figure, loads)
    return figure


def _answer(axes: Axes, along: NDArray, swept: SetSolution) -> str:
    """Draw what the shaft answers with, and say what it is: where no free channel moves, the load that holds it."""
    free = [i for i in range(3) if i in swept.free_channels]
    moves = bool(np.any(np.abs(swept.displacement[:, free]) > 0.0))
    values = swept.displacement / um if moves else swept.load
    for i, line in enumerate(list(CHANNEL_LINES.values())[1:4]):
        if (i in free) == moves and np.any(np.abs(values[:, i]) > 0.0):
            axes.plot(along, values[:, i], label=CHANNELS[i].label, **line)
    if axes.lines:
        legend_within(axes)
    return "displacement of the shaft, µm" if moves else "load on the shaft, N"


def _lines(count: int) -> list[tuple[str, Any]]:
    return [ROW_LINES[number % len(ROW_LINES)] for number in range(count)]
