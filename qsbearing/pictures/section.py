"""The section through one ball: both rings, the lines of action of its contacts, their angles and loads.

Ball, groove radii and groove centres are to scale, as they lie under load; the free contact angle is that in operation,
with all that grows and fits. Of the rings only the grooves are known to
the model: faces, shoulders and seats are sketched, except a bore or an outside diameter that the scene gives.

Texts are plain and the title's height is given: to set formulas and to look for room takes three quarters of the time
in which a picture that follows a slider is drawn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.bearing import BearingKind
from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import MPa, deg, mm
from qsbearing.pictures.style import GREY, STYLE, carry_alike, raceways

if TYPE_CHECKING:
    from matplotlib.axes import Axes

HIGH_SHOULDER, LOW_SHOULDER = 60.0 * deg, 12.0 * deg
"""Half-angles of the sketched groove, on the side that carries and on the other."""

STEEP = 25.0 * deg
"""Free contact angle below which its label stays clear of the ball's centre line only on the far side."""

WIDTH, THICKNESS = 1.35, 0.3
"""Of the sketched rings, as parts of the ball diameter; the thickness below the groove's bottom."""


def most_loaded_ball(solution: Solution, place: CasePlace) -> int:
    """Number of the ball with the largest contact load."""
    loads = [np.nan_to_num(contacts.load[place]) for _, contacts in raceways(solution)]
    return int(np.argmax(np.maximum(*loads)))


def draw_section(axes: Axes, solution: Solution, place: CasePlace, ball: int | None = None) -> None:
    """Args:
    ball: its number from zero; None: the one with the largest contact load.
    """
    number = most_loaded_ball(solution, place) if ball is None else ball
    bearing = solution.scene.operating_bearing
    diameter = _number(bearing.ball_diameter, place, solution) / mm
    free = _number(bearing.free_contact_angle, place, solution)
    _ball(axes, diameter)
    reach = 0.88 * diameter
    end = reach * np.array([np.sin(free), np.cos(free)])
    axes.plot([-end[0], end[0]], [-end[1], end[1]], color=GREY, linewidth=0.8, linestyle=":")
    words = "free, in operation" if solution.scene.is_reshaped else "free"
    beside = "right" if free > STEEP else "left"  # of a steep line, off the centre line
    axes.text(
        0.98 * end[0],
        0.98 * end[1],
        f" {words}: {free / deg:.3g}° ",
        fontsize=9,
        color=GREY,
        ha=beside,
        va="center",
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.6},
        zorder=2.5,
    )
    axes.plot([0.0, 0.0], [-reach, reach], color=GREY, linewidth=0.6, linestyle=(0, (8, 3, 1, 3)))
    seats: list[float] = []
    for side, contacts in raceways(solution):
        up = 1.0 if side == "outer" else -1.0
        radius = _number(getattr(bearing, f"{side}_groove_radius"), place, solution) / mm
        load, approach = float(contacts.load[place][number]), float(contacts.approach[place][number])
        # Without load it touches where it would: at the free angle.
        angle = float(contacts.angle[place][number]) if load > 0.0 else free
        beyond = radius - 0.5 * diameter + (approach / mm if load > 0.0 else 0.0)
        centre = -up * beyond * np.array([np.sin(angle), np.cos(angle)])
        seats.append(_ring(axes, solution, place, side, centre, radius, diameter))
        if load > 0.0:
            half = float(contacts.semi_major_axis[place][number]) / mm
            _line_of_action(axes, side, centre, angle, radius, half)
        _label(axes, side, angle, load, float(contacts.max_pressure[place][number]), diameter)
    span = 0.5 * WIDTH * diameter
    axes.set_xlim(-1.9 * span, 1.9 * span)
    bottom, top = min(-0.9 * diameter, *seats), max(0.9 * diameter, *seats)
    axes.set_ylim(bottom - 0.17 * diameter, top + 0.08 * diameter)
    axes.set_aspect("equal")
    axes.axis("off")
    axes.set_title(_title(solution, place, number), fontsize=10, y=1.0)
    axes.text(0.0, bottom - 0.16 * diameter, "axis of the bearing below; ring outlines are sketched", fontsize=7.5,
              color=GREY, ha="center", va="bottom")  # fmt: skip


def _number(value: Any, place: CasePlace, solution: Solution) -> float:
    return float(np.broadcast_to(np.asarray(value, float), solution.shape)[place])


def _title(solution: Solution, place: CasePlace, number: int) -> str:
    if carry_alike(solution, place):
        return "Section through a ball: all balls carry the same load"
    azimuth = solution.azimuth[place]
    most = ", the most heavily loaded" if number == most_loaded_ball(solution, place) else ""
    return f"Section through the ball at {np.degrees(azimuth[number]) % 360.0:.4g}°{most}"


def _ball(axes: Axes, diameter: float) -> None:
    from matplotlib.patches import Circle

    axes.add_patch(Circle((0.0, 0.0), 0.5 * diameter, facecolor="0.97", edgecolor="black", linewidth=1.0, zorder=1.5))
    axes.plot(0.0, 0.0, "+", color="black", markersize=7, zorder=3)


def _ring(
    axes: Axes, solution: Solution, place: CasePlace, side: str, centre: NDArray, radius: float, diameter: float
) -> float:
    """The section of a ring: the groove between its shoulders, faces and seat; the height of the seat [mm]."""
    from matplotlib.patches import Polygon

    up = 1.0 if side == "outer" else -1.0
    low = HIGH_SHOULDER if solution.scene.bearing.kind is BearingKind.DEEP_GROOVE else LOW_SHOULDER
    turned = np.linspace(-low, HIGH_SHOULDER, 60)
    groove = centre + up * radius * np.stack([np.sin(turned), np.cos(turned)], axis=1)
    face = 0.5 * WIDTH * diameter
    seat = centre[1] + up * (radius + _thickness(solution, place, side, diameter))
    corners = [(up * face, groove[-1, 1]), (up * face, seat), (-up * face, seat), (-up * face, groove[0, 1])]
    axes.add_patch(
        Polygon(
            np.concatenate([groove, corners]), closed=True, facecolor="0.86", edgecolor="0.25", linewidth=0.9, zorder=1
        )
    )
    return float(seat)


def _thickness(solution: Solution, place: CasePlace, side: str, diameter: float) -> float:
    """Of a ring below its groove's bottom [mm]: given by its seat, or sketched."""
    rings, bearing = solution.scene.ring_expansion, solution.scene.operating_bearing
    if rings is None:
        return THICKNESS * diameter
    seat = _number(getattr(rings, "bore_diameter" if side == "inner" else "outside_diameter"), place, solution) / mm
    up = 1.0 if side == "outer" else -1.0
    radius = _number(getattr(bearing, f"{side}_groove_radius"), place, solution) / mm
    angle = _number(bearing.free_contact_angle, place, solution)
    pitch = _number(bearing.pitch_diameter, place, solution) / mm
    bottom = 0.5 * pitch + up * (radius - (radius - 0.5 * diameter) * np.cos(angle))
    return max(up * (0.5 * seat - float(bottom)), 0.02 * diameter)


def _line_of_action(axes: Axes, side: str, centre: NDArray, angle: float, radius: float, half: float) -> None:
    """From the groove's centre through the ball's to the contact, with the contact's length on the raceway."""
    up, colour = (1.0 if side == "outer" else -1.0), STYLE[side]["color"]
    contact = centre + up * radius * np.array([np.sin(angle), np.cos(angle)])
    axes.plot(*np.stack([centre, contact]).T, color=colour, linestyle=STYLE[side]["linestyle"], linewidth=1.6, zorder=3)
    axes.plot(*centre, marker="o", markersize=3, color=colour, zorder=3.1)
    along = angle + np.linspace(-half, half, 30) / radius
    patch = centre + up * radius * np.stack([np.sin(along), np.cos(along)], axis=1)
    axes.plot(*patch.T, color=colour, linewidth=4.5, solid_capstyle="butt", zorder=2.8)


def _label(axes: Axes, side: str, angle: float, load: float, pressure: float, diameter: float) -> None:
    up = 1.0 if side == "outer" else -1.0
    name = "ₒ" if side == "outer" else "ᵢ"
    if load > 0.0:
        text = f"α{name} = {round(angle / deg, 1) + 0.0:.1f}°\nQ{name} = {load:.0f} N\np₀ = {pressure / MPa:.0f} MPa"
    else:
        text = f"{side} contact:\nno load"
    axes.text(
        up * 0.75 * WIDTH * diameter * 0.98, up * 0.66 * diameter, text, color=STYLE[side]["color"], fontsize=10,
        ha="left" if up > 0.0 else "right", va="top" if up > 0.0 else "bottom", linespacing=1.4,
    )  # fmt: skip
