"""Temperatures and preload: over the speed, with the fold where they run away, and over the time of heating up."""

from __future__ import annotations

from itertools import cycle
from typing import TYPE_CHECKING, Any

from qsbearing.pictures.style import (
    GREY,
    RED,
    ROW_LINES,
    STYLE,
    figure_of_size,
    legend,
    logarithmic,
    plain,
    write_above,
)
from qsbearing.systems.heat.state import along_curve, hottest, instant

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NODES = {"inner ring": "inner", "outer ring": "outer"}
"""Nodes that are drawn as their raceways are elsewhere."""


HEIGHT = 4.7
"""Of a picture [inches]."""


def over_speed(
    speeds: dict[str, Any], own: float, title: str = "", whole: dict[str, Any] | None = None, height: float = HEIGHT
) -> Figure:
    """Steady states over speed.

    Args:
        speeds: "speeds" of `qsbearing heat --json`.
        own: the scene's speed [rpm].
        title: names the bearing.
        whole: "whole_bearing" of the same, whose onset of runaway is marked as well.
        height: of the picture [inches].
    """
    fold, at_whole = speeds["fold"], None if whole is None else whole["fold"]
    states, at_fold = along_curve(speeds)
    figure, axes = _two("speed, rpm", title, states, height)
    _draw(axes, states, [each["speed_rpm"] for each in states], at_fold)
    for each in axes:
        each.axvline(own, color=GREY, linewidth=0.8, linestyle=":", label="the scene's speed")
        if fold is not None:
            each.axvline(fold["speed_rpm"], color=RED, linewidth=0.9, linestyle="--", label="runaway begins")
        if at_whole is not None:
            each.axvline(
                at_whole["speed_rpm"], color=RED, linewidth=0.9, linestyle="-.", label="runaway, Palmgren's friction"
            )
        each.set_xlim(left=0.0)
    legend(figure, *axes)
    return figure


def over_time(transient: dict[str, Any], title: str = "") -> Figure:
    """Heating up: "transient" of `qsbearing heat --json`."""
    states = [instant(transient, number) for number in range(1, len(transient["time_s"]))]
    figure, axes = _two("time, s", title, states)
    _draw(axes, states, transient["time_s"][1:], None)
    for each in axes:
        logarithmic(each.xaxis)
    legend(figure, *axes)
    return figure


def _two(along: str, title: str, states: list[dict[str, Any]], height: float = HEIGHT) -> tuple[Figure, Any]:
    figure = figure_of_size(9.0, height)
    if title:
        write_above(figure, title)
    axes = figure.subplots(1, 2)
    of = "the bearing" if len(states[0]["axial_load_N"]) == 1 else "each row"
    for each, name in zip(axes, ("Temperatures, °C", f"Axial load of {of}, N"), strict=True):
        plain(each)
        each.set_title(name, fontsize=10)
        each.set_xlabel(along, fontsize=9)
    return figure, axes


def _draw(axes: Any, states: list[dict[str, Any]], along: list[float], fold: int | None) -> None:
    """The hottest of the rows' nodes, and each row's load; states beyond the fold, in which no bearing stays, pale."""
    temperatures, rows = [hottest(each["temperatures_C"]) for each in states], len(states[0]["axial_load_N"])
    lines = [
        {name: [each[name] for each in temperatures] for name in temperatures[0]},
        {
            "axial load" if rows == 1 else f"row {row + 1}": [each["axial_load_N"][row] for each in states]
            for row in range(rows)
        },
    ]
    end = len(states) if fold is None else fold + 1
    for each, own in zip(axes, lines, strict=True):
        is_node = bool(NODES.keys() & own.keys())
        others = cycle(ROW_LINES[2:] if is_node else ROW_LINES)  # lines unlike the raceways'
        for label, values in own.items():
            raceway = STYLE.get(NODES.get(label, ""))
            colour, style = (raceway["color"], raceway["linestyle"]) if raceway else next(others)
            each.plot(along[:end], values[:end], linestyle=style, color=colour, linewidth=1.4, label=label)
            each.plot(along[end - 1 :], values[end - 1 :], linestyle=style, color=colour, linewidth=0.9, alpha=0.4)
        if fold is not None:
            each.plot([], [], color=GREY, linewidth=0.9, alpha=0.4, label="pale: unstable")
