"""What the pictures share: lines and markers, marks of lost contacts, legend, title.

Inner and outer raceway differ in colour, line and marker, so that a picture survives a black-and-white printer and
colour-blind eyes. A ball without contact is marked as such. matplotlib's global state is left alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.operation import CHANNELS, Operation
from qsbearing.model.scene.arched_rings import IN_RUN, refuse_arched
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.solution.raceway_contacts import RacewayContacts
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import mrad, rpm, um
from qsbearing.remarks.balls import LEAST_TYPICAL, MOST_TYPICAL
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
# Okabe & Ito's blue and vermilion: told apart by every kind of colour vision, and by their lightness in print.
# The outer's hollow squares are larger than the inner's discs: where the two coincide, both are seen.
STYLE: dict[str, dict[str, Any]] = {
    "inner": {"color": "#d55e00", "marker": "o", "linestyle": "-", "zorder": 2.1},
    "outer": {"color": "#0072b2", "marker": "s", "linestyle": "--", "markerfacecolor": "none", "zorder": 2.2},
}
_MARKER_SIZE = {"inner": 4.0, "outer": 7.0}
GREY = "0.35"
Span = tuple[float, float]
"""The least and the largest of what an axis shows."""

ROW_LINES: tuple[tuple[str, Any], ...] = (
    ("#000000", "-"),
    ("#999933", "--"),
    ("#332288", "-."),
    ("#882255", ":"),
    ("#44aa99", (0, (8, 2))),
    ("#88ccee", (0, (5, 1, 1, 1, 1, 1))),
)
"""Colour and line of the rows of a set, in turn: each line differs from all others without its colour (Tol's muted
colours, none of them a raceway's or a channel's)."""

CHANNEL_LINES: dict[str, dict[str, Any]] = {
    "": {"color": "0.1", "linestyle": "-"},
    "axial": {"color": "0.1", "linestyle": "-"},
    "radial y": {"color": "#009e73", "linestyle": "--"},
    "radial z": {"color": "#cc79a7", "linestyle": "-."},
    "tilt y": {"color": "#009e73", "linestyle": ":"},
    "tilt z": {"color": "#cc79a7", "linestyle": (0, (5, 1))},
}
CHANNEL_LINES |= {f"moment {axis}": CHANNEL_LINES[f"tilt {axis}"] for axis in "yz"}
"""Colour and line of each channel of the ring; "": of a result that has none."""

RED = "#b00020"
"""Of limits: where a preload is lost, where temperatures run away, what must not be exceeded."""

SLIP = (LEAST_TYPICAL, MOST_TYPICAL)
"""Coefficients of friction of lubricated contacts: between them, gyroscopic slip begins."""


def figure_of_size(width: float, height: float) -> Figure:
    """An empty figure [inches]."""
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    return Figure(figsize=(width, height), dpi=150, layout=ConstrainedLayoutEngine(h_pad=TITLE_GAP))


LEGEND_LINE, LEGEND_LETTER = 0.55, 0.082
"""Width of a legend's line with its gaps, and of a letter [inches]."""
TITLE_LETTER = 0.088
"""Width of a letter of a title [inches]."""
TITLE_GAP = 0.09
"""Above and below each panel, so that the title of a picture does not touch those of its panels [inches]."""


def legend(figure: Figure, *axes: Any) -> None:
    """One legend below the picture; what several axes show is named once."""
    known: dict[str, Any] = {}
    for each in axes:
        for handle, label in zip(*each.get_legend_handles_labels(), strict=True):
            known.setdefault(label, handle)
    if known:
        widest = LEGEND_LINE + LEGEND_LETTER * max(map(len, known))
        columns = min(len(known), max(int(figure.bbox.width / figure.dpi / widest), 2))
        figure.legend(
            list(known.values()), list(known), loc="outside lower center", ncols=columns, fontsize=9, frameon=False
        )


ROOM = 0.2
"""Of an axis's height: what a legend within it gets above the curves."""


def legend_within(axes: Axes) -> None:
    """A legend at the top of its own axes, in room that is made there: it covers no curve."""
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + ROOM * (high - low))
    white = {"facecolor": "white", "edgecolor": "none", "framealpha": 0.85}
    axes.legend(loc="upper center", ncols=len(axes.lines), fontsize=8, columnspacing=1.2, **white)


def logarithmic(axis: Any) -> None:
    """A logarithmic axis whose ticks are numbers, not powers."""
    axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    axis.set_major_formatter(lambda value, _: f"{value:,.0f}" if value >= 1.0 else f"{value:g}")
    axis.set_minor_formatter("")


DECADE = 10.0
"""Times the least life, from which on the axis of lives is logarithmic."""
OF_LIVES = ("h", "Mrev")
"""Units of lives, and of no other result."""


def spans_decades(unit: str, values: ArrayLike) -> bool:
    """Whether these are lives that differ by more than a decade: lives change by powers of ten."""
    known = np.asarray(values, float)
    known = known[np.isfinite(known)]
    return unit in OF_LIVES and known.size > 0 and bool(0.0 < DECADE * known.min() < known.max())


def of_results(axis: Any, unit: str, values: ArrayLike) -> bool:
    """The scale of an axis of results: of lives that span decades logarithmic; whether it is."""
    is_log = spans_decades(unit, values)
    if is_log:
        logarithmic(axis)
    return is_log


STEPS = (1.0, 2.0, 5.0), (1.0, 3.0), (1.0,)
"""Of a decade, the finest first."""


def logarithmic_levels(low: float, high: float, most: int) -> list[float]:
    """Round numbers from below the lowest to above the highest value, evenly spread over powers of ten; about so many
    between them."""
    decades = np.arange(np.floor(np.log10(low)), np.ceil(np.log10(high)) + 1.0)
    every = [np.array([step * 10.0**power for power in decades for step in steps]) for steps in STEPS]
    fine = next((each for each in every if ((each > low) & (each < high)).sum() <= most), every[-1])
    first = max(int(np.searchsorted(fine, low, "right")) - 1, 0)
    levels = fine[first : int(np.searchsorted(fine, high)) + 1].tolist()
    return levels[:: -(-len(levels) // (most + 2))] if len(levels) > most + 2 else levels


def plain(axes: Axes) -> None:
    """Axes with a light grid and no frame."""
    axes.grid(color="0.88", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.tick_params(labelsize=8)
    for name in ("top", "right"):
        axes.spines[name].set_visible(False)


def balls(solution: Solution, place: CasePlace) -> tuple[NDArray, NDArray]:
    """Azimuths of the balls that there are [rad], and which they are along the ball axis."""
    azimuth = solution.azimuth[place]
    present = np.isfinite(azimuth)
    return azimuth[present], present


def carry_alike(solution: Solution, place: CasePlace) -> bool:
    """Whether all balls carry the same loads, as under pure thrust."""
    _, present = balls(solution, place)
    load = np.stack([contacts.load[place][present] for _, contacts in raceways(solution)])
    return bool(np.ptp(load, axis=1).max() <= 1e-9 * load.max())


def raceways(solution: Solution) -> tuple[tuple[str, RacewayContacts], ...]:
    """Both raceways with their names.

    Raises:
        SceneError: a four-point bearing has two contacts with one ring.
    """
    refuse_arched(solution.scene.bearing, "this picture", IN_RUN)
    return ("inner", solution.inner), ("outer", solution.outer)


def line_style(side: str, count: int) -> dict[str, Any]:
    """How a raceway's line is drawn through so many balls."""
    size = _MARKER_SIZE[side] * (1.0 if count <= 24 else 0.6)
    return STYLE[side] | {"linewidth": 1.2, "markersize": size, "label": f"{side} raceway"}


STEPS_OF_CIRCLES = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
"""Of a decade: the values that a circle may have."""
BEYOND = 1.02
"""The least circle over the largest value: the curve's marks stay within."""


def circle_beyond(largest: float) -> float:
    """A round number beyond the largest value of a polar picture; 1 where there is none."""
    if largest <= 0.0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(largest))
    steps = (step * power for step in (*STEPS_OF_CIRCLES, 12.0))
    return float(f"{next(each for each in steps if each >= BEYOND * largest):.3g}")


AT = 45.0
"""Azimuth of a circle's label, between the names of the axes [deg]."""


def scale_circle(axes: Any, value: float, unit: str = "", is_labelled: bool = True) -> None:
    """The frame of a polar picture: a circle of this value, the scale of all pictures of a sheet, labelled on one of
    them; and a fainter one at half of it."""
    axes.set_ylim(0.0, value)
    axes.set_rgrids([0.5 * value], [""])
    axes.set_thetagrids(range(0, 360, 90), ["y", "z", "", ""])
    axes.grid(color="0.88", linewidth=0.6)
    axes.spines["polar"].set(color="0.5", linewidth=0.9)
    if is_labelled:
        axes.annotate(
            f"{value:g} {unit}".rstrip(), (np.radians(AT), value), (2, 2), textcoords="offset points", fontsize=9,
            ha="left", va="bottom",
        )  # fmt: skip


def round_length(most: float) -> float:
    """The largest of 1, 2 and 5 times a power of ten that is no more, but for rounding; 0 of nothing."""
    if most <= 0.0:
        return 0.0
    power = 10.0 ** np.floor(np.log10(most))
    return float(max(step for step in (1.0, 2.0, 5.0) if step * power <= most * (1.0 + 1e-9)) * power)


def mark_lost(axes: Any, solution: Solution, place: CasePlace, height: float) -> None:
    """Crosses where a ball has lost a raceway; what was lost stands in the legend."""
    azimuth, present = balls(solution, place)
    inner, outer = (contacts.load[place][present] == 0.0 for _, contacts in raceways(solution))
    along = azimuth if axes.name == "polar" else np.degrees(azimuth) % 360.0
    for lost, marker, label in (
        (inner & outer, "x", "no load on either raceway"),
        (inner & ~outer, "+", "inner contact lost"),
    ):
        where = along[lost]
        if where.size:
            axes.plot(where, [height] * where.size, marker, color=GREY, markersize=6, label=label, clip_on=False)


def write_title(figure: Figure, solution: Solution, place: CasePlace) -> None:
    """What was solved, in a line: the bearing, its speeds, and the loads and displacements that are imposed."""
    _write_title(figure, name_of(solution.scene), solution.scene.operation, solution, place)


def write_title_of_set(figure: Figure, solution: SetSolution, place: CasePlace) -> None:
    """What was solved, in a line: the set, its speeds, and the loads on the shaft."""
    _write_title(figure, name_of(solution.set), solution.set.operation, solution, place)


def name_of(of: Scene | BearingSet) -> str:
    """How a picture's title names it: the bearing; the set with its arrangement."""
    return of.bearing.name or "Ball bearing" if isinstance(of, Scene) else f"{of.name or 'Set'}, {of.arrangement}"


def _write_title(
    figure: Figure, what: str, operation: Operation, solution: Solution | SetSolution, place: CasePlace
) -> None:
    parts = [what]
    for name, speed in (("", operation.speed), ("outer ring ", operation.outer_speed)):
        if speed is not None:
            parts.append(f"{name}{float(np.broadcast_to(speed, solution.shape)[place]) / rpm:.6g} rpm")
    for i, channel in enumerate(CHANNELS):
        if i in solution.free_channels:
            value, unit = solution.load[place][i], "N m" if channel.is_rotation else "N"
            if abs(value) > 1e-6 * np.abs(solution.load[place]).max():  # a channel without load is not named
                parts.append(f"{channel.label.replace('tilt', 'moment')} {value:.5g} {unit}")
        else:
            value, unit = solution.displacement[place][i], "mrad" if channel.is_rotation else "µm"
            size = mrad if channel.is_rotation else um
            name = channel.label if channel.is_rotation else f"{channel.label} displacement"
            parts.append(f"{name} {value / size + 0.0:.5g} {unit}")
    write_above(figure, ", ".join(parts))


def write_above(figure: Figure, title: str) -> None:
    """A title of as many lines as the width of the picture asks for; where it can, a line ends after a comma."""
    from textwrap import fill

    letters = int(figure.get_size_inches()[0] / TITLE_LETTER)
    parts = [part if len(part) >= letters else part.replace(" ", "\xa0") for part in title.split(", ")]
    figure.suptitle(fill(", ".join(parts), letters).replace("\xa0", " "), fontsize=10, parse_math=False)
