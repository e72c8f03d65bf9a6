"""Pictures of a solved case: one function each; matplotlib is imported inside and its global state left alone.

Inner and outer raceway differ in colour, line and marker, so that a picture survives a black-and-white printer and
colour-blind eyes. A ball without contact is marked as such.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.units import MPa, deg, mm, rpm

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from qsbearing.solution import RacewayContacts, Solution

    Index = int | tuple[int, ...]

# Okabe & Ito's blue and vermilion: told apart by every kind of colour vision, and by their lightness in print.
# The outer's hollow squares are larger than the inner's discs: where the two coincide, both are seen.
STYLE: dict[str, dict[str, Any]] = {
    "inner": {"color": "#d55e00", "marker": "o", "linestyle": "-", "zorder": 2.1},
    "outer": {"color": "#0072b2", "marker": "s", "linestyle": "--", "markerfacecolor": "none", "zorder": 2.2},
}
_MARKER_SIZE = {"inner": 4.0, "outer": 7.0}
GREY = "0.35"
_LOADS = ("axial", "radial y", "radial z", "moment y", "moment z")
MOST_ELLIPSES = 20
"""More columns than this leave no room for numbers; a large bearing shows every second ball, or every third."""


def load_distribution(solution: Solution, index: Index = ()) -> Figure:
    """Contact loads of all balls around the bearing, as a polar picture.

    Args:
        index: the case, along the solution's case axes; nothing for a single case.
    """
    figure = _figure(5.6, 5.6)
    axes = figure.add_subplot(projection="polar")
    _draw_loads(axes, solution, index)
    _legend(figure, axes)
    figure.suptitle(_title(solution, index), fontsize=10)
    return figure


def contact_angles(solution: Solution, index: Index = ()) -> Figure:
    """Inner and outer contact angles by azimuth; arguments as for `load_distribution`."""
    figure = _figure(7.0, 4.2)
    axes = figure.add_subplot()
    _draw_angles(axes, solution, index)
    _legend(figure, axes)
    figure.suptitle(_title(solution, index), fontsize=10)
    return figure


def contact_ellipses(solution: Solution, index: Index = ()) -> Figure:
    """Outlines of the contact ellipses, all to one scale, with their greatest pressure; arguments as for
    `load_distribution`."""
    figure = _figure(10.0, 4.6)
    axes = figure.add_subplot()
    _draw_ellipses(axes, solution, index)
    figure.suptitle(_title(solution, index), fontsize=10)
    return figure


def overview(solution: Solution, index: Index = ()) -> Figure:
    """Loads, angles and ellipses on one sheet; arguments as for `load_distribution`."""
    figure = _figure(11.0, 8.2)
    grid = figure.add_gridspec(2, 2, width_ratios=(1.0, 1.25), height_ratios=(1.1, 1.0))
    loads = figure.add_subplot(grid[0, 0], projection="polar")
    angles = figure.add_subplot(grid[0, 1])
    _draw_loads(loads, solution, index)
    _draw_angles(angles, solution, index)
    _draw_ellipses(figure.add_subplot(grid[1, :]), solution, index)
    _legend(figure, angles, loads)
    figure.suptitle(_title(solution, index), fontsize=11)
    return figure


# Drawing ------------------------------------------------------------------------------------------------------------


def _draw_loads(axes: Any, solution: Solution, index: Index) -> None:
    from matplotlib.ticker import MaxNLocator

    azimuth, present = _balls(solution, index)
    axes.set_title("Contact load, N", fontsize=10, pad=18)
    loads = {side: contacts.load[index][present] for side, contacts in _sides(solution)}
    for side, load in loads.items():
        axes.plot(np.append(azimuth, azimuth[0]), np.append(load, load[0]), **_style(side, azimuth.size))
    top = 1.12 * (max(float(load.max()) for load in loads.values()) or 1.0)
    axes.set_ylim(0.0, top)
    _mark_lost(axes, solution, index, np.full(azimuth.size, 0.96 * top))
    axes.set_thetagrids(range(0, 360, 45), ["y  0°", "45°", "z  90°", "135°", "180°", "225°", "270°", "315°"])
    circles = [value for value in MaxNLocator(4).tick_values(0.0, top) if 0.0 < value <= 0.9 * top]
    labels = axes.set_rgrids(circles, [f"{value:g}" for value in circles])[1]
    for label in labels:
        label.set_bbox({"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.6})
    # The circles are labelled between two balls, where the loads are smallest.
    quiet = int(np.argmin(loads["inner"] + loads["outer"]))
    axes.set_rlabel_position(float(np.degrees(azimuth[quiet]) + 180.0 / azimuth.size))
    axes.tick_params(axis="both", labelsize=8)
    axes.grid(color="0.85", linewidth=0.6)


def _draw_angles(axes: Axes, solution: Solution, index: Index) -> None:
    azimuth, present = _balls(solution, index)
    turned = np.degrees(azimuth) % 360.0
    order = np.argsort(turned)
    # Once round and a little more: the last ball stands before the start, the first after the end.
    order = np.concatenate([order[-1:], order, order[:1]])
    along = turned[order] + np.concatenate([[-360.0], np.zeros(order.size - 2), [360.0]])
    free = float(np.broadcast_to(solution.scene.bearing.free_contact_angle, solution.shape)[index]) / deg
    axes.axhline(free, color=GREY, linewidth=0.9, linestyle=":", label="free contact angle")
    values = [free]
    for side, contacts in _sides(solution):
        loaded = contacts.load[index][present] > 0.0
        angle = np.where(loaded, contacts.angle[index][present] / deg, np.nan)
        values += list(angle[loaded])
        axes.plot(along, angle[order], **_style(side, azimuth.size))
    low, high = min(values), max(values)
    margin = max(0.08 * (high - low), 1.0)
    floor = low - 2.2 * margin
    axes.set_ylim(floor, high + margin)
    _mark_lost(axes, solution, index, np.full(azimuth.size, floor + 0.7 * margin))
    axes.set_xlim(-8.0, 368.0)
    axes.set_xticks(range(0, 361, 45))
    axes.set_xlabel("azimuth from y towards z, deg", fontsize=9)
    axes.set_ylabel("contact angle, deg", fontsize=9)
    axes.set_title("Contact angles", fontsize=10)
    _clean(axes)


def _draw_ellipses(axes: Axes, solution: Solution, index: Index) -> None:
    chosen, names, every = _columns(solution, index)
    _, present = _balls(solution, index)
    sides = {
        side: [
            getattr(contacts, name)[index][present][chosen] / size
            for name, size in (("semi_major_axis", mm), ("semi_minor_axis", mm), ("max_pressure", MPa))
        ]
        for side, contacts in _sides(solution)
    }
    tallest = float(max(major.max() for major, _, _ in sides.values())) or 1.0
    widest = float(max(minor.max() for _, minor, _ in sides.values())) or 1.0
    # Columns spread over the width of the sheet, and never touch.
    spacing = max(2.6 * widest, 19.0 * tallest / max(chosen.size, 3))
    alone = chosen.size == 1
    for side, columns in sides.items():
        up = 1.0 if side == "inner" else -1.0
        for column, (a, b, pressure) in enumerate(zip(*columns, strict=True)):
            x, y = column * spacing, up * 1.45 * tallest
            if a == 0.0:
                lost = all(other[0][column] == 0.0 for other in sides.values())
                axes.plot(x, y, "x" if lost else "+", color=GREY, markersize=6)
                continue
            _draw_ellipse(axes, side, x, y, float(a), float(b))
            if alone:
                words = f"$a$ = {a:.4g} mm\n$b$ = {b:.4g} mm\n$p_0$ = {pressure:.0f} MPa"
                axes.text(x + 2.0 * widest + 0.5 * tallest, y, words, fontsize=10, va="center", linespacing=1.5)
            else:
                place: dict[str, Any] = {"va": "bottom" if up > 0.0 else "top", "ha": "center"}
                axes.text(x, y + up * 1.1 * tallest, f"{pressure:.0f}", fontsize=8, **place)
    axes.set_aspect("equal")
    edge = 0.8 * spacing + 0.3 * tallest
    axes.set_xlim(-edge, (chosen.size - 1) * spacing + edge)
    axes.set_ylim(-3.1 * tallest, 3.1 * tallest)
    places = [column * spacing for column in range(chosen.size)]
    axes.set_xticks(places, names, fontsize=8)
    axes.set_yticks([1.45 * tallest, -1.45 * tallest], ["inner\nraceway", "outer\nraceway"], fontsize=9)
    axes.tick_params(length=0)
    title = "Contact ellipses to scale, rolling direction to the right"
    if not alone:
        axes.set_xlabel(f"azimuth of the ball, deg{every}", fontsize=9)
        title += "; numbers: greatest pressure, MPa"
    axes.set_title(title, fontsize=10)
    for spine in axes.spines.values():
        spine.set_visible(False)
    _scale_bar(axes, -edge, tallest)


def _draw_ellipse(axes: Axes, side: str, x: float, y: float, a: float, b: float) -> None:
    from matplotlib.patches import Ellipse

    colour, line = STYLE[side]["color"], STYLE[side]["linestyle"]
    axes.add_patch(Ellipse((x, y), 2.0 * b, 2.0 * a, facecolor=colour, alpha=0.22, edgecolor="none"))
    axes.add_patch(Ellipse((x, y), 2.0 * b, 2.0 * a, fill=False, edgecolor=colour, linestyle=line, linewidth=1.1))


def _scale_bar(axes: Axes, left: float, tallest: float) -> None:
    """A length to measure the ellipses by, in the gap between the two rows."""
    length = _round_length(0.8 * tallest)
    axes.plot([left, left], [-length / 2.0, length / 2.0], color="black", linewidth=1.5)
    for end in (-length / 2.0, length / 2.0):
        axes.plot([left - 0.06 * tallest, left + 0.06 * tallest], [end, end], color="black", linewidth=1.0)
    axes.text(left + 0.15 * tallest, 0.0, f"{length:g} mm", fontsize=8, va="center")


def _round_length(length: float) -> float:
    """The nearest lower 1, 2 or 5 times a power of ten."""
    power = 10.0 ** np.floor(np.log10(length))
    return float(max(step for step in (1.0, 2.0, 5.0) if step * power <= length * (1.0 + 1e-9)) * power)


def _columns(solution: Solution, index: Index) -> tuple[NDArray, list[str], str]:
    """Which balls to draw, their names, and what to add to the axis label where some are left out."""
    azimuth, present = _balls(solution, index)
    load = np.stack([contacts.load[index][present] for _, contacts in _sides(solution)])
    if np.ptp(load, axis=1).max() <= 1e-9 * load.max():
        return np.array([0]), ["all balls"], ""
    turned = np.round(np.degrees(azimuth) % 360.0, 6) % 360.0
    order = np.argsort(turned)
    step = -(-order.size // MOST_ELLIPSES)
    chosen = order[::step]
    every = {1: "", 2: " (every second ball)", 3: " (every third ball)"}.get(step, f" (every {step}th ball)")
    return chosen, [f"{value:.4g}" for value in turned[chosen]], every


def _mark_lost(axes: Any, solution: Solution, index: Index, place: NDArray) -> None:
    """Crosses where a ball has lost a raceway; what was lost stands in the legend."""
    azimuth, present = _balls(solution, index)
    inner, outer = (contacts.load[index][present] == 0.0 for _, contacts in _sides(solution))
    along = azimuth if axes.name == "polar" else np.degrees(azimuth) % 360.0
    for lost, marker, words in (
        (inner & outer, "x", "no load on either raceway"),
        (inner & ~outer, "+", "inner contact lost"),
    ):
        if lost.any():
            axes.plot(along[lost], place[lost], marker, color=GREY, markersize=6, label=words, clip_on=False)


# Common -------------------------------------------------------------------------------------------------------------


def _figure(width: float, height: float) -> Figure:
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), dpi=150, layout="constrained")


def _legend(figure: Figure, *axes: Any) -> None:
    """One legend below the picture; what several axes show is named once."""
    known: dict[str, Any] = {}
    for each in axes:
        for handle, label in zip(*each.get_legend_handles_labels(), strict=True):
            known.setdefault(label, handle)
    figure.legend(
        list(known.values()), list(known), loc="outside lower center", ncols=len(known), fontsize=9, frameon=False
    )


def _clean(axes: Axes) -> None:
    axes.grid(color="0.88", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.tick_params(labelsize=8)
    for name in ("top", "right"):
        axes.spines[name].set_visible(False)


def _balls(solution: Solution, index: Index) -> tuple[NDArray, NDArray]:
    """Azimuths of the balls that there are [rad], and which they are along the ball axis."""
    azimuth = solution.azimuth[index]
    present = np.isfinite(azimuth)
    return azimuth[present], present


def _sides(solution: Solution) -> tuple[tuple[str, RacewayContacts], ...]:
    return ("inner", solution.inner), ("outer", solution.outer)


def _style(side: str, count: int) -> dict[str, Any]:
    size = _MARKER_SIZE[side] * (1.0 if count <= 24 else 0.6)
    return STYLE[side] | {"linewidth": 1.2, "markersize": size, "label": f"{side} raceway"}


def _title(solution: Solution, index: Index) -> str:
    """What was solved, in a line: the bearing, its speeds, and the loads that the ring carries."""
    operation = solution.scene.operation
    words = [solution.scene.bearing.name or "Ball bearing"]
    for name, speed in (("", operation.speed), ("outer ring ", operation.outer_speed)):
        if speed is not None:
            words.append(f"{name}{float(np.broadcast_to(speed, solution.shape)[index]) / rpm:.6g} rpm")
    load = solution.load[index]
    largest = np.abs(load).max()
    for name, unit, value in zip(_LOADS, ("N", "N", "N", "N m", "N m"), load, strict=True):
        if abs(value) > 1e-6 * largest:
            words.append(f"{name} {value:.5g} {unit}")
    return ", ".join(words)
