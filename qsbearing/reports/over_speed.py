"""Two results over the speed, small: those that are required, or else stiffness, and preload or pressure."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Section
from qsbearing.documents.numbers import plain as in_digits
from qsbearing.documents.numbers import that_matter
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.limit import Answer
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import MPa, rpm, um
from qsbearing.pictures.style import CHANNEL_LINES, GREY, RED, ROW_LINES, figure_of_size, plain
from qsbearing.reports.answers_table import words_of
from qsbearing.systems.sets.set_solution import SetSolution

PANELS = 2
WIDTH, HEIGHT = 9.0, 1.75
"""Of the picture [inches]."""
SAME = 1e-3
"""Of the largest: rows that differ by less share a line."""


class Swept(NamedTuple):
    """A case solved again at other speeds."""

    solution: Any
    """Of all of them."""
    speeds: NDArray
    """[rad/s]"""
    own: float
    """Of the case itself [rad/s]."""


class SmallPicture(NamedTuple):
    """What is drawn over the speed."""

    title: str
    lines: dict[str, NDArray]
    """By their labels; the label is empty where there is only one."""
    styles: Sequence[dict[str, Any]]
    bounds: Sequence[float] = ()
    """What is required."""


def section(swept: Swept | None, required: Sequence[Answer]) -> Section | None:
    """The picture, where page 1 has room for it; None where nothing depends on the speed."""
    if swept is None or not np.asarray(swept.solution.converged).any():
        return None
    panels = _panels(swept, required)
    titles = " and ".join(each.title for each in panels)
    drawn = picture(_figure(swept, panels), f"Curves over the speed: {titles}; the operating point is marked.")
    return Section("Over the speed", [drawn], "over-speed", is_spare=True)


def figure_of(swept: Swept, required: Sequence[Answer]) -> Any:
    """The picture alone."""
    return _figure(swept, _panels(swept, required))


def _panels(swept: Swept, required: Sequence[Answer]) -> list[SmallPicture]:
    return [*_required(swept, required), *_usual(swept.solution)][:PANELS]


def _required(swept: Swept, required: Sequence[Answer]) -> Iterator[SmallPicture]:
    """What is required and no reading: once for each result, with all that is asked of it."""
    by_words: dict[str, list[Answer]] = {}
    for each in required:
        if not each.place.group.reading:
            by_words.setdefault(f"{words_of(each)}, {printed_unit(each.limit.unit)}", []).append(each)
    for title, alike in by_words.items():
        values = _worst(swept.solution, alike[0])
        if values is not None:
            yield SmallPicture(title, {"": values}, [CHANNEL_LINES[""]], [float(np.max(each.bound)) for each in alike])


def _worst(solution: Any, answer: Answer) -> NDArray | None:
    """Of all that the requirement holds for, at each speed."""
    every = [place.of(solution) for place in answer.limit.places]
    if any(each is None or each.ndim != 1 for each in every):
        return None
    worst = np.fmax if answer.limit.sense == "<=" else np.fmin
    return np.asarray(worst.reduce([np.abs(each) if answer.limit.is_of_sizes else each for each in every]))  # type: ignore[arg-type]


def _usual(solution: Any) -> Iterator[SmallPicture]:
    yield _stiffness(solution)
    is_set = isinstance(solution, SetSolution)
    if is_set and solution.preload_in_operation is not None:
        yield SmallPicture("preload in operation, N", *_of_rows(solution.preload_in_operation))
    elif not is_set and solution.scene.preload is not None and solution.preload_loads is not None:
        yield SmallPicture("preload in operation, N", {"": solution.preload_loads.arrays[1]}, [CHANNEL_LINES[""]])
    pressures = [_pressure(row) for row in (solution.rows if is_set else (solution,))]
    yield SmallPicture("maximum contact pressure, MPa", *_of_rows(np.stack(pressures, axis=-1)))


ALIKE = 0.02
"""Part by which both radial directions may differ that share a line."""


def _stiffness(solution: Any) -> SmallPicture:
    """Across the shaft at its first named point; else of ring or shaft along and across it, locked where it is held."""
    if isinstance(solution, SetSolution) and solution.points:
        name, point = next(iter(solution.points.items()))
        y, z = (point.effective_stiffness[:, i] * um for i in (1, 2))
        title = f"stiffness at the {name}, N/µm"
        if np.allclose(y, z, rtol=ALIKE, equal_nan=True):
            return SmallPicture(f"radial {title}", {"": np.fmin(y, z)}, [CHANNEL_LINES[""]])
        values, title, which = point.effective_stiffness, title, (1, 2)
    else:
        are_free = {0, 1} <= set(map(int, solution.free_channels))
        values = solution.effective_stiffness if are_free else solution.locked_stiffness
        title, which = f"{'effective' if are_free else 'locked'} stiffness, N/µm", (0, 1)
    names = [name for name in CHANNEL_LINES if name][: len(CHANNELS)]
    lines = {CHANNELS[i].label: values[:, i] * um for i in which}
    return SmallPicture(title, lines, [CHANNEL_LINES[names[i]] for i in which])


def _pressure(row: Solution) -> NDArray:
    sides = [np.fmax.reduce(side.max_pressure, axis=-1) for side in (row.inner, row.outer)]
    return np.asarray(np.fmax.reduce(sides)) / MPa


def _of_rows(values: NDArray) -> tuple[dict[str, NDArray], list[dict[str, Any]]]:
    """A line for each row; rows that are alike share one."""
    lines: dict[str, NDArray] = {}
    groups: list[list[int]] = []
    for number in range(values.shape[-1]):
        own = values[..., number]
        near = SAME * np.nanmax(np.abs(values))
        alike = next((g for g in groups if np.nanmax(np.abs(values[..., g[0]] - own)) <= near), None)
        if alike is None:
            groups.append([number])
        else:
            alike.append(number)
    for group in groups:
        label = "" if values.shape[-1] == 1 else f"row{'s' * (len(group) > 1)} {', '.join(str(n + 1) for n in group)}"
        lines[label] = values[..., group[0]]
    styles = [dict(zip(("color", "linestyle"), ROW_LINES[g[0] % len(ROW_LINES)], strict=True)) for g in groups]
    return lines, styles


def _figure(swept: Swept, panels: Sequence[SmallPicture]) -> Any:
    figure = figure_of_size(WIDTH, HEIGHT)
    solved = np.asarray(swept.solution.converged)
    along, own = swept.speeds / rpm, swept.own / rpm
    for axes, panel in zip(np.ravel(figure.subplots(1, len(panels))), panels, strict=True):
        for (label, values), style in zip(panel.lines.items(), panel.styles, strict=True):
            shown = np.where(solved, values, np.nan)
            axes.plot(along, shown, label=label, **{k: v for k, v in style.items() if k in ("color", "linestyle")})
            at = float(np.interp(own, *_ascending(along, shown)))
            axes.plot(own, at, "o", color=style["color"], markersize=4.5)
            if not label:
                beyond = float(np.interp(1.05 * own, *_ascending(along, shown)))
                before = beyond > at  # of a curve that rises, on the side where it is below
                axes.annotate(
                    that_matter(at), (own, at), (-5 if before else 5, 5), textcoords="offset points", fontsize=9,
                    ha="right" if before else "left",
                )  # fmt: skip
        for bound in panel.bounds:
            axes.axhline(bound, color=RED, linewidth=1.0, linestyle=(0, (4, 3)))
            axes.annotate(
                f"required {in_digits(bound, '.4g')}", (1.0, bound), (0, 3), xycoords=("axes fraction", "data"),
                textcoords="offset points", ha="right", fontsize=8, color=RED,
            )  # fmt: skip
        axes.axvline(own, color=GREY, linewidth=0.8, linestyle=":")
        axes.set_title(panel.title, fontsize=10, loc="left")
        axes.set_xlabel("rpm", fontsize=9)
        axes.margins(y=0.15)
        axes.locator_params(axis="x", nbins=5)
        if len(panel.lines) > 1:
            axes.legend(fontsize=8, frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5), handlelength=2.4)
        plain(axes)
    return figure


def _ascending(along: NDArray, values: NDArray) -> tuple[NDArray, NDArray]:
    """Where there is a value, by rising speed."""
    known = np.isfinite(values)
    order = np.argsort(along[known])
    return along[known][order], values[known][order]
