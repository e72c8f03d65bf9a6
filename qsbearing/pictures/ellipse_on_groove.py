"""The contact ellipse of the most loaded ball on each groove, seen along the contact's normal, with the groove's edges.

The groove is developed: a point at the angle phi from its bottom lies r phi beside it. The ellipse's ends along the
groove are at r (alpha -+ arcsin(a/r)), as `readings.shoulder_overrun` has them; across, its semi-axis is b. Edges are
at arccos(1 - h/r) of shoulders that are h high: of those that the scene or its catalogue states, or else of usual
proportions, which the picture says.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from qsbearing.files.printed_numbers import catalogue_numbers
from qsbearing.model.bearing import BearingKind
from qsbearing.model.effects.ring_dimensions import BEYOND_CONTACT, OPEN_SHOULDER, SHOULDER
from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.solution.judgement import percent
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import deg, mm
from qsbearing.pictures.style import GREY, RED, STYLE, carry_alike, raceways
from qsbearing.readings.bearing_numbers import INNER, OUTER
from qsbearing.readings.shoulder_overrun import edge_angles

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BAND = 0.1
"""Half of a groove's height in the picture, over its width; more where an ellipse is wider."""
BEYOND = 0.07
"""Of a groove's width: what is shown of each shoulder."""
ABOVE, SMALL_ABOVE = 0.75, 0.95
"""Room for a line of words above a band, in halves of its height; likewise where there is little room."""
LINES, SMALL_LINES = 2, 3
"""Of words, and where there is little room."""
RINGS = "[effects.elastic_rings]"
TITLE = "Contact ellipses on their grooves, rolling up and down"


class Edges(NamedTuple):
    """Of a groove, by their angles from its bottom [rad]."""

    low: float
    """On the side that contact angles above zero lean away from; below zero."""
    high: float
    source: str
    """Who states the shoulder on the high side; empty where it is assumed."""


class OnGroove(NamedTuple):
    """A contact on its groove."""

    edges: Edges
    radius: float
    """[m]"""
    ball: int
    angle: float
    """[rad]"""
    a: float
    b: float

    @property
    def distance(self) -> float:
        """From the ellipse's tip to the nearer edge; negative: so much of it is beyond [m]."""
        near = self.edges.high - self.angle, self.angle - self.edges.low
        return self.radius * float(np.sin(min(near))) - self.a

    @property
    def ends(self) -> tuple[float, float]:
        """Of the ellipse along the groove [rad]."""
        half = float(np.arcsin(min(self.a / self.radius, 1.0)))
        return self.angle - half, self.angle + half


def _number(value: Any, solution: Solution, place: CasePlace) -> float:
    return float(np.broadcast_to(np.asarray(value, float), solution.shape)[place])


def edges_of(solution: Solution, place: CasePlace, side: str) -> Edges:
    """Of the groove as it is drawn, at rest and cold: shoulders move with it."""
    bearing, which = solution.scene.bearing, INNER if side == "inner" else OUTER
    radius = _number(getattr(bearing, f"{side}_groove_radius"), solution, place)
    ball = _number(bearing.ball_diameter, solution, place)

    def edge(height: float) -> float:
        return float(np.arccos(np.clip(1.0 - height / radius, -1.0, 1.0)))

    is_symmetric = bearing.kind is BearingKind.DEEP_GROOVE
    free, usual = _number(bearing.free_contact_angle, solution, place), edge(OPEN_SHOULDER * ball)
    for source, stated in _stated(solution):
        shoulder, other = (stated.get(f"{side}_{name}_diameter") for name in ("shoulder", "open"))
        if shoulder is not None:
            ends = edge_angles(bearing, shoulder, other, which)
            high, low = (_number(each, solution, place) for each in ends)
            if source == RINGS and other is None and not is_symmetric:  # there this is a ring without the other one
                low = usual
            return Edges(-low, high, source)
    high = max(edge(SHOULDER * ball), min(free + BEYOND_CONTACT, 0.5 * np.pi))
    return Edges(-high if is_symmetric else -usual, high, "")


def _stated(solution: Solution) -> list[tuple[str, dict[str, Any]]]:
    """Who states shoulders, the closest to the question first."""
    scene = solution.scene
    return [
        ("[readings.overrun]", dict(scene.readings.get("overrun", {}))),
        (RINGS, vars(scene.elastic_rings) if scene.elastic_rings is not None else {}),
        ("the catalogue", catalogue_numbers(scene.bearing)),
    ]


def on_grooves(solution: Solution, place: CasePlace) -> dict[str, OnGroove | None]:
    """By raceways; None where no ball carries on one."""
    on_rings: dict[str, OnGroove | None] = {}
    for side, contacts in raceways(solution):
        loads = np.nan_to_num(contacts.load[place])
        ball = int(np.argmax(loads))
        radius = _number(getattr(solution.scene.operating_bearing, f"{side}_groove_radius"), solution, place)
        numbers = (contacts.angle, contacts.semi_major_axis, contacts.semi_minor_axis)
        own = (float(each[place][ball]) for each in numbers)
        on_rings[side] = OnGroove(edges_of(solution, place, side), radius, ball, *own) if loads[ball] > 0.0 else None
    return on_rings


def draw_grooves(axes: Axes, solution: Solution, place: CasePlace, is_small: bool = False) -> None:
    """Both grooves, one above the other.

    Args:
        is_small: whether there is only room for short words, as beside other rows.
    """
    on_rings = on_grooves(solution, place)
    drawn = {side: each for side, each in on_rings.items() if each is not None}
    spans = {side: _span(each) for side, each in drawn.items()}
    width = max((high - low for low, high in spans.values()), default=1.0)
    half = max([BAND * width, *(1.4 * each.b / mm for each in drawn.values())])
    above = SMALL_LINES * SMALL_ABOVE if is_small else LINES * ABOVE
    step = (2.0 + above) * half
    for number, side in enumerate(on_rings):
        y, each = -number * step, on_rings[side]
        if each is None:
            axes.text(0.0, y, f"{side} raceway: no load", fontsize=9, color=STYLE[side]["color"], ha="center")
            continue
        _band(axes, each, y, half)
        _ellipse(axes, side, each, y, half)
        words = _words(side, each, solution, place, is_small)
        axes.annotate(
            "\n".join(words),
            (spans[side][0], y + half), (0, 3), textcoords="offset points", fontsize=8 if is_small else 9,
            color=RED if each.distance < 0.0 else STYLE[side]["color"], va="bottom", linespacing=1.25,
        )  # fmt: skip
    low, high = (
        min((each for each, _ in spans.values()), default=-1.0),
        max((b for _, b in spans.values()), default=1.0),
    )
    axes.set_xlim(low - 0.03 * width, high + 0.03 * width)
    axes.set_ylim(-step - 1.25 * half, (1.0 + above) * half)
    axes.set_aspect("equal")
    axes.set_yticks([])
    axes.set_xlabel(
        "mm from the bottom" if is_small else "mm along the groove, from its bottom", fontsize=8 if is_small else 9
    )
    axes.tick_params(labelsize=8)
    for name in ("left", "top", "right"):
        axes.spines[name].set_visible(False)
    if not is_small:
        axes.set_title("\n".join(filter(None, (TITLE, edges_told(on_rings.items(), ";\n")))), fontsize=10, y=1.0)


def edges_told(grooves: Iterable[tuple[str, OnGroove | None]], between: str = "; ") -> str:
    """Whose edges grooves have, in words: of each raceway where they differ."""
    by = {
        side: f"by {each.edges.source}" if each.edges.source else "assumed, of usual proportions"
        for side, each in grooves
        if each is not None
    }
    if len(set(by.values())) == 1:
        return f"shoulders {next(iter(by.values()))}"
    return f"shoulders: {between.join(f'{side} {source}' for side, source in by.items())}" if by else ""


def _span(each: OnGroove) -> tuple[float, float]:
    """What is shown of the groove [mm]."""
    low, high = (each.radius * angle / mm for angle in each.edges[:2])
    beyond = BEYOND * (high - low)
    first, last = (each.radius * angle / mm for angle in each.ends)
    return min(low - beyond, first), max(high + beyond, last)


def _band(axes: Axes, each: OnGroove, y: float, half: float) -> None:
    """The groove between its edges, and the shoulders beyond."""
    from matplotlib.patches import Rectangle

    low, high = (each.radius * angle / mm for angle in each.edges[:2])
    first, last = _span(each)
    axes.add_patch(Rectangle((first, y - half), last - first, 2.0 * half, facecolor="0.72", edgecolor="none", zorder=1))
    axes.add_patch(Rectangle((low, y - half), high - low, 2.0 * half, facecolor="0.93", edgecolor="none", zorder=1.1))
    line = "-" if each.edges.source else (0, (4, 2))
    axes.plot([high, high], [y - half, y + half], color="black", linewidth=1.4, linestyle=line, zorder=2)
    axes.plot([low, low], [y - half, y + half], color="black", linewidth=1.0, linestyle=line, zorder=2)
    axes.plot([0.0, 0.0], [y - half, y + half], color=GREY, linewidth=0.8, linestyle=(0, (8, 3, 1, 3)), zorder=1.5)


def _ellipse(axes: Axes, side: str, each: OnGroove, y: float, half: float) -> None:
    from matplotlib.patches import Ellipse

    colour = STYLE[side]["color"]
    first, last = (each.radius * angle / mm for angle in each.ends)
    middle, width = 0.5 * (first + last), last - first
    size = (width, 2.0 * each.b / mm)
    axes.add_patch(Ellipse((middle, y), *size, facecolor=colour, alpha=0.35, edgecolor="none", zorder=3))
    axes.add_patch(Ellipse((middle, y), *size, fill=False, edgecolor=colour, linewidth=1.2, zorder=3.1))


def _words(side: str, each: OnGroove, solution: Solution, place: CasePlace, is_small: bool) -> list[str]:
    where = ""
    if not carry_alike(solution, place):
        where = f", ball at {np.degrees(solution.azimuth[place][each.ball]) % 360.0:.4g}°"
    about = "" if each.edges.source else "≈ "
    edge = f"{about}{each.distance / mm:.2g} mm to the edge"
    if each.distance < 0.0:
        beyond = percent(min(-0.5 * each.distance / each.a, 1.0))
        edge = f"{about}{beyond} is beyond the edge"
    size = f"{2.0 * each.a / mm:.3g} × {2.0 * each.b / mm:.2g} mm"
    angle = f"{round(each.angle / deg, 1) + 0.0:.1f}°"
    if is_small:
        return [f"{side}{where}", f"{angle}, {size}", edge]
    return [f"{side} raceway{where}, contact angle {angle}", f"{size}, {edge}"]
