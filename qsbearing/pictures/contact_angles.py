"""Inner and outer contact angles by azimuth."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import deg
from qsbearing.pictures.style import GREY, Span, balls, line_style, mark_lost, plain, raceways

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def angle_span(solution: Solution, place: CasePlace) -> Span:
    """Of the loaded contact angles and the free one [deg]."""
    _, present = balls(solution, place)
    angles = [_free(solution, place)]
    for _, contacts in raceways(solution):
        loaded = contacts.load[place][present] > 0.0
        angles += list(contacts.angle[place][present][loaded] / deg)
    return min(angles), max(angles)


def draw_angles(
    axes: Axes, solution: Solution, place: CasePlace, span: Span | None = None, is_small: bool = False
) -> None:
    """Args:
    span: of the angles that share a scale with these; None: their own.
    is_small: whether there is room for few words.
    """
    azimuth, present = balls(solution, place)
    turned = np.degrees(azimuth) % 360.0
    order = np.argsort(turned)
    along = np.concatenate([[0.0], turned[order], [360.0]])
    axes.axhline(_free(solution, place), color=GREY, linewidth=0.9, linestyle=":", label="free contact angle")
    for side, contacts in raceways(solution):
        loaded = contacts.load[place][present] > 0.0
        angle = np.where(loaded, contacts.angle[place][present] / deg, np.nan)
        # Once round: between the last ball and the first the line crosses the picture's two edges at one height.
        last, first = turned[order[-1]] - 360.0, turned[order[0]]
        edge = angle[order[0]] if first == 0.0 else np.interp(0.0, [last, first], angle[order[[-1, 0]]])
        curve = np.concatenate([[edge], angle[order], [edge]])
        # A ball at 0° is also the ball at 360°: without its mark there the line would end in nothing.
        marked = slice(1, None if first == 0.0 else -1)
        axes.plot(along, curve, markevery=marked, clip_on=False, **line_style(side, azimuth.size))
    low, high = span or angle_span(solution, place)
    margin = max(0.08 * (high - low), 1.0)
    has_lost = any((contacts.load[place][present] == 0.0).any() for _, contacts in raceways(solution))
    bottom = low - (2.2 if has_lost or span else 1.0) * margin  # room for the marks; rows of a set share a scale
    axes.set_ylim(bottom, high + margin)
    mark_lost(axes, solution, place, bottom + 0.7 * margin)
    axes.set_xlim(0.0, 360.0)
    axes.set_xticks(range(0, 361, 90 if is_small else 45))
    axes.set_xlabel("azimuth, deg" if is_small else "azimuth from y towards z, deg", fontsize=9)
    axes.set_ylabel("contact angle, deg", fontsize=9)
    axes.set_title("Contact angles", fontsize=10)
    plain(axes)


def _free(solution: Solution, place: CasePlace) -> float:
    return float(np.broadcast_to(solution.scene.bearing.free_contact_angle, solution.shape)[place]) / deg
