"""Where goals and limits are met: over two variables as lines with their forbidden side, over one as curves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.pictures.study.contours import contour_lines
from qsbearing.pictures.study.labels import head, label_of, with_unit, without_unit
from qsbearing.pictures.style import (
    GREY,
    RED,
    ROW_LINES,
    figure_of_size,
    logarithmic,
    logarithmic_levels,
    of_results,
    plain,
    spans_decades,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

OPTIMUM: dict[str, Any] = {"marker": "*", "markersize": 14, "color": "#e69f00", "markeredgecolor": "black"}
FORBIDDEN = "0.80"
LEVELS = 9


@dataclass(frozen=True)
class Along:
    """A variable along an axis."""

    key: str
    unit: str
    values: NDArray
    best: float
    """Its value at the optimum, or at the nearest point."""
    is_log: bool = False

    @property
    def heading(self) -> str:
        """Of the axis."""
        return with_unit(without_unit(self.key, self.unit), self.unit)


@dataclass(frozen=True)
class Bounded:
    """A result over the picture, with its goals and limits."""

    name: str
    unit: str
    values: NDArray
    """Over the grid (y, x), or along x; NaN where there is no solution."""
    conditions: Sequence[tuple[str, float]] = ()
    """Its goals (=) and limits (<=, >=)."""

    def breaks(self, values: NDArray) -> NDArray:
        """Where values of it do not meet one of its limits."""
        out = np.zeros(values.shape, bool)
        for sense, level in self.conditions:
            out |= (values > level) & (sense == "<=") | (values < level) & (sense == ">=")
        return out

    def crossings(self, x: NDArray) -> Iterator[NDArray]:
        """Where along x it meets a limit just so, by straight lines between its values."""
        for _, level in self.conditions:
            before, after = self.values[:-1] - level, self.values[1:] - level
            at = np.flatnonzero(before * after < 0.0)
            yield x[at] + (x[at + 1] - x[at]) * before[at] / (before[at] - after[at])


def draw_region(x: Along, y: Along | None, shown: Sequence[Bounded], objective: str, title: str, best: str) -> Figure:
    """The feasible region.

    Args:
        y: None: a picture over one variable.
        objective: the name of the result that is minimised or maximised; empty: none.
        title: which numbers are held.
        best: what the star is.
    """
    if y is None:
        return _curves(x, shown, title, best)
    figure = figure_of_size(7.2, 5.6)
    axes = figure.subplots()
    axes.set_title(title, fontsize=9, loc="left")
    axes.set_facecolor("0.93")
    _scales(axes, x, y)
    known = np.isfinite([each.values for each in shown]).all(axis=0)
    outside = np.any([each.breaks(each.values) for each in shown], axis=0)
    if known.any():
        axes.contourf(x.values, y.values, np.ma.masked_array(np.zeros(known.shape), ~known), [-1, 1], colors=["white"])
    _lines(axes, x, y, shown)
    for each in shown:
        values = np.ma.masked_invalid(each.values)
        if each.name == objective and values.count() and values.max() > values.min():
            contour_lines(axes, x.values, y.values, values, _levels(each.unit, values))
            axes.plot([], [], color="black", linewidth=0.5, label=with_unit(label_of(each.name).whole, each.unit))
    axes.plot([x.best], [y.best], linestyle="none", label=best, clip_on=False, zorder=5, **OPTIMUM)
    _patches(axes, bool(outside.any()), not known.all())
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=2, fontsize=8, frameon=False)
    return figure


def _lines(axes: Axes, x: Along, y: Along, shown: Sequence[Bounded]) -> None:
    """Goals as plain lines, limits with ticks on the side that is forbidden."""
    from matplotlib.patheffects import withTickedStroke

    number = 0
    for each in shown:
        for sense, level in each.conditions:
            colour, dashes = ROW_LINES[1:][number % (len(ROW_LINES) - 1)]
            number += 1
            above = (each.values - level) * (-1.0 if sense == ">=" else 1.0)
            label = _said(each, sense, level)
            if sense != "=" and (above > 0.0).any():
                axes.contourf(x.values, y.values, np.ma.masked_invalid(above), [0.0, np.inf], colors=[FORBIDDEN])
            least, most = np.nanmin(above, initial=np.inf), np.nanmax(above, initial=-np.inf)
            if least < 0.0 < most:
                lines = axes.contour(
                    x.values, y.values, np.ma.masked_invalid(above), [0.0], colors=colour, linewidths=1.6,
                    linestyles=[dashes],
                )  # fmt: skip
                if sense != "=":
                    lines.set_path_effects([withTickedStroke(angle=135, length=0.7, spacing=7)])
            else:
                label += ": everywhere" if most <= 0.0 and sense != "=" else ": nowhere"
            axes.plot([], [], color=colour, linewidth=1.6, linestyle=dashes, label=label)


def _levels(unit: str, values: Any) -> list[float]:
    """Of the contours of the result that is made least or largest."""
    from matplotlib.ticker import MaxNLocator

    if spans_decades(unit, values.compressed()):
        return logarithmic_levels(float(values.min()), float(values.max()), LEVELS)
    return list(MaxNLocator(LEVELS).tick_values(values.min(), values.max()))


def _curves(x: Along, shown: Sequence[Bounded], title: str, best: str) -> Figure:
    """One panel for each result; where one of the limits is not met, all are shaded."""
    figure = figure_of_size(6.6, 0.8 + 2.1 * len(shown))
    panels = figure.subplots(len(shown), 1, sharex=True, squeeze=False)[:, 0]
    steps = len(x.values) <= 30
    spans = _forbidden(x, shown, steps)
    for axes, each in zip(panels, shown, strict=True):
        plain(axes)
        axes.plot(x.values, each.values, "o-" if steps else "-", color="black", linewidth=1.2, markersize=3)
        for sense, level in each.conditions:
            axes.axhline(level, color=RED, linestyle="-" if sense == "=" else "--", linewidth=1.2)
            axes.annotate(
                f"{sense} {level:g}".replace("<=", "≤").replace(">=", "≥"), (1.0, level), fontsize=8, ha="right",
                va="bottom", xycoords=("axes fraction", "data"), color=RED,
            )  # fmt: skip
        for begin, end in spans:
            axes.axvspan(begin, end, color=FORBIDDEN, linewidth=0, zorder=0)
        axes.set_ylabel(with_unit(label_of(each.name).whole, each.unit).replace(", ", ",\n"), fontsize=8)
        of_results(axes.yaxis, each.unit, each.values)
        there = np.isfinite(each.values)
        if there.any():
            height = np.interp(x.best, x.values[there], each.values[there])
            axes.plot([x.best], [height], clip_on=False, zorder=5, **OPTIMUM)
        if x.is_log:
            logarithmic(axes.xaxis)
    panels[-1].set_xlabel(x.heading, fontsize=9)
    said = f"Star: {best}" + ("; grey: a limit is not met" if spans else "")
    head(figure, f"{title}\n{said}" if title else said)
    return figure


def _forbidden(x: Along, shown: Sequence[Bounded], steps: bool) -> list[tuple[float, float]]:
    """The stretches along x on which a limit is not met: from where it is just met; of single values, each with half of
    the way to the next ones."""
    if steps:
        ends = np.concatenate([x.values[:1], 0.5 * (x.values[1:] + x.values[:-1]), x.values[-1:]])
        middle = x.values
    else:
        ends = np.unique(np.concatenate([x.values, *(at for each in shown for at in each.crossings(x.values))]))
        middle = 0.5 * (ends[1:] + ends[:-1])
    broken = np.any([each.breaks(np.interp(middle, x.values, each.values)) for each in shown], axis=0)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], broken, [False]])))
    return [(float(ends[begin]), float(ends[end])) for begin, end in edges.reshape(-1, 2)]


def _scales(axes: Axes, x: Along, y: Along) -> None:
    for along, axis in ((x, axes.xaxis), (y, axes.yaxis)):
        axis.set_label_text(along.heading, fontsize=9)
        if along.is_log:
            logarithmic(axis)
    axes.set_xlim(x.values[0], x.values[-1])
    axes.set_ylim(y.values[0], y.values[-1])
    axes.tick_params(labelsize=8)


def _patches(axes: Axes, any_outside: bool, any_unsolved: bool) -> None:
    if any_outside:
        axes.fill_between([], [], color=FORBIDDEN, label="a limit is not met (ticks: that side)")
    if any_unsolved:
        axes.fill_between([], [], facecolor="0.93", edgecolor=GREY, linewidth=0.5, label="no solution")


def _said(each: Bounded, sense: str, level: float) -> str:
    sign = {"<=": "≤", ">=": "≥"}.get(sense, sense)
    return with_unit(f"{label_of(each.name).whole} {sign} {level:g}", each.unit, " ")
