"""What the pictures share: lines and markers, marks of lost contacts, legend, title.

Inner and outer raceway differ in colour, line and marker, so that a picture survives a black-and-white printer and
colour-blind eyes. A ball without contact is marked as such. matplotlib's global state is left alone.
"""

from __future__ import annotations

from collections.abc import Sequence
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
        columns = min(len(known), max(int(figure.get_size_inches()[0] / widest), 2))
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


def label_circles(axes: Any, azimuth: NDArray, loads: Sequence[NDArray], top: float) -> None:
    """Draw the circles of a polar picture and label them away from its curves; the arguments are `label_places`'s."""
    from matplotlib.ticker import MaxNLocator

    circles: list[float] = []
    most = FEWEST_CIRCLES
    while len(circles) < FEWEST_CIRCLES:
        most += 1
        circles = [value for value in MaxNLocator(most).tick_values(0.0, top) if 0.0 < value <= 0.9 * top]
    axes.set_rgrids(circles, [""] * len(circles))
    if not np.isfinite(loads).all() or not azimuth.size:
        return
    extent = axes.get_window_extent()
    radius = 0.5 * min(extent.width, extent.height) / axes.figure.dpi
    angle, labelled = label_places(azimuth, loads, circles, top, max(1.0, RADIUS / radius))
    box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.4}
    for value in labelled:
        axes.text(np.radians(angle), value, f"{value:g}", fontsize=7.5, ha="center", va="center", bbox=box, zorder=2.0)


FEWEST_CIRCLES = 3
"""Of a polar picture: fewer show no scale."""
LABEL = (0.11, 0.05)
"""Half the width and height of a circle's label, as parts of the radius of a picture of 2.5 inches."""
RADIUS = 1.9
"""Of such a picture, as its axes are before it is laid out [inches]: letters are larger parts of a smaller one."""
CLEAR = 1.2
"""How far from a curve's points a label's centre is, in `LABEL`: the points are drawn as marks."""


def label_places(
    azimuth: NDArray, loads: Sequence[NDArray], circles: Sequence[float], top: float, size: float = 1.0
) -> tuple[float, list[float]]:
    """The azimuth [deg] at which most circles of a polar picture have room for a label, and these circles.

    A circle close to a curve all round has no label: the others show the scale. If none has room, all are labelled.

    Args:
        azimuth: of the curves' points, once round [rad].
        loads: curves, with one value per azimuth.
        circles: values that are labelled.
        top: the largest value that the picture holds.
        size: of a label, as a multiple of `LABEL`.
    """
    tried = np.arange(15.0, 360.0, 5.0)
    tried = tried[np.abs((tried + 45.0) % 90.0 - 45.0) >= 15.0]  # beside the names of the axes
    around = np.radians(np.arange(0.0, 360.0))
    at = np.exp(1j * np.radians(tried))[:, None, None] * (np.asarray(circles) / top)[:, None]
    curves = np.concatenate([np.interp(around, azimuth, load, period=2.0 * np.pi) / top for load in loads])
    between = at - curves * np.tile(np.exp(1j * around), len(loads))
    away = np.maximum(np.abs(between.real) / LABEL[0], np.abs(between.imag) / LABEL[1]).min(axis=2) / size
    is_clear = away >= CLEAR
    nearest = np.where(is_clear, away, 3.0).min(axis=1, initial=3.0)
    if not is_clear.any():
        nearest = away.min(axis=1, initial=3.0)
    best = np.argmax(is_clear.sum(axis=1) + nearest / 4.0)
    return float(tried[best]), [
        value for value, clear in zip(circles, is_clear[best], strict=True) if clear or not is_clear.any()
    ]


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
