"""Contour lines whose labels stay clear of the frame and of each other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.pictures.study.labels import nearest

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.contour import QuadContourSet

HALF_LETTER, HALF_HEIGHT = 0.0085, 0.025
"""Of a label, as parts of a panel of 3 inches: half of what a letter takes, and half its height with some air."""
SHORTEST = 0.2
"""Of the panel, a line that bears a label."""
APART = 0.13
"""Of the panel, between two labels."""
CLEAR = 0.022
"""Of the panel, from a label's centre to the next line: a label nearer than this hides it."""
FARTHEST = 0.08
"""Lines farther away than this no longer count."""


def contour_lines(
    axes: Axes,
    x: NDArray,
    y: NDArray,
    z: Any,
    levels: Sequence[float],
    said: dict[float, str] | str = "%.4g",
    widths: float | Sequence[float] = 0.5,
) -> QuadContourSet:
    """Draw lines at these levels; each long enough to bear a label has one, and none reaches beyond the frame.

    Args:
        said: a level's label, or a format of it.
        widths: of the lines, in points.
    """
    each = np.broadcast_to(widths, len(levels)).tolist()
    lines = axes.contour(x, y, z, levels, colors="black", linewidths=each)
    places = _places(axes, lines, said, each)
    if places:
        axes.clabel(lines, fontsize=7, fmt=said, manual=places, inline_spacing=3)
    return lines


def _places(
    axes: Axes, lines: QuadContourSet, said: dict[float, str] | str, each: list[float]
) -> list[tuple[float, float]]:
    """A place on each line, in data coordinates."""
    to_panel = axes.transData + axes.transAxes.inverted()
    pieces, letters, widths = [], [], []
    for level, segments, width in zip(lines.levels, lines.allsegs, each, strict=True):
        label = said % level if isinstance(said, str) else said[level]
        for piece in segments:
            if len(piece) > 1:
                pieces.append(to_panel.transform(piece))
                letters.append(len(label))
                widths.append(width)
    taken: list[NDArray] = []
    # The widest and longest first: they are what a reader follows.
    for number in sorted(range(len(pieces)), key=lambda i: (-widths[i], -_length(pieces[i]))):
        piece = pieces[number]
        if _length(piece) < max(SHORTEST, 3.0 * HALF_LETTER * letters[number]):
            continue
        others = [other for i, other in enumerate(pieces) if i != number]
        free = nearest(piece, others, FARTHEST)
        apart = nearest(piece, taken, 1.0)
        inside = _inside(piece, letters[number])
        allowed = (inside >= 0.0) & (free >= CLEAR) & (apart >= APART)
        worth = np.where(allowed, free + 0.1 * np.minimum(apart, 0.4) + np.minimum(inside, 0.05), -np.inf)
        best = int(np.argmax(worth))
        if allowed[best]:
            taken.append(piece[best : best + 1])
    back = to_panel.inverted()
    return [tuple(map(float, back.transform(place[0]))) for place in taken]  # type: ignore[misc]


def _inside(piece: NDArray, letters: int) -> NDArray:
    """How far a label of so many letters, turned as the line is, stays off the panel's frame along the line."""
    along = np.abs(np.gradient(piece, axis=0))
    along /= np.maximum(np.hypot(*along.T), 1e-12)[:, None]
    reach = HALF_LETTER * letters * along + HALF_HEIGHT * along[:, ::-1]
    return np.asarray((0.49 - np.abs(piece - 0.5) - reach).min(axis=1))


def _length(piece: NDArray) -> float:
    return float(np.hypot(*np.diff(piece, axis=0).T).sum())
