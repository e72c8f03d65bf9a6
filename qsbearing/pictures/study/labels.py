"""What a study's keys and results are called on a picture."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from functools import cache
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.file_keys import words_of
from qsbearing.model.solution.result_keys import SAID, Place, place_of, printed_unit
from qsbearing.readings.asked import every_group
from qsbearing.systems.sets.set_groups import OF_SHAFT, SYSTEM, groups_of_row

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from xarray import DataArray, Dataset


class Label(NamedTuple):
    """What a result is called on a picture."""

    shared: str
    """By results on one panel."""
    which: str = ""
    """What tells one from another: row of a set, raceway, direction, or nothing."""
    row: int = 0
    """Of a set, from 1; 0: of the whole."""

    @property
    def whole(self) -> str:
        """Of one that stands alone."""
        return f"{self.which} {self.shared}".strip()


@cache
def place_named(name: str) -> Place | None:
    """The place of a result's full name, without its raceway too, as of either; None of another name, such as a key's
    or of a point of a shaft."""
    groups = every_group()
    unsided = [group._replace(raceway="") for group in groups if group.raceway]
    place = place_of(name, [*groups, *OF_SHAFT, SYSTEM, *unsided], groups_of_row(groups))
    return place if place is not None and place.name == name else None


def label_of(name: str, about: Mapping[Any, Any] = MappingProxyType({})) -> Label:
    """Of a result.

    Args:
        name: in full; tells what it is where nothing else does.
        about: what a dataset says of it.
    """
    if "label" not in about:
        place = place_named(name)
        if place is None:
            return Label(name.replace("_", " "))
        about = place.attributes
    row, over, shared = int(about.get("row", 0)), str(about.get("over", "")), str(about["label"])
    if over and not (over == "max" and shared.startswith(SAID[over])):
        shared = f"{shared}, {SAID[over]}"
    side = str(about.get("raceway") or about.get("direction", ""))
    return Label(f"{side} {shared}".strip(), f"row {row}", row) if row else Label(shared, side)


def label_in(results: Dataset, name: str) -> Label:
    """Of one of these results."""
    return label_of(name, results[name].attrs)


def with_unit(text: str, unit: str, between: str = ", ") -> str:
    """A heading with its unit, where it has one."""
    unit = "" if unit == "balls" else printed_unit(unit)
    return f"{text}{between}{unit}" if unit else text


def key_words(values: DataArray) -> str:
    """A varied key in words, without its unit."""
    return without_unit(str(values.name), str(values.attrs.get("units", "")))


def without_unit(name: str, unit: str) -> str:
    """The name of a key in words, its unit taken off."""
    ending = unit.replace(" ", "").replace("/", "")
    for each in (f"_{ending}", f"_{unit.replace('/', '_')}", "_per_K"):
        if ending and name.endswith(each):
            return words_of(name) or name.removesuffix(each).replace("_", " ")
    return words_of(name) or name.replace("_", " ")


def key_heading(values: DataArray) -> str:
    """A varied key with its unit, as an axis needs it."""
    return with_unit(key_words(values), str(values.attrs.get("units", "")))


def value_label(values: DataArray, number: float) -> str:
    """One value of a key, with its unit."""
    return with_unit(f"{number:.6g}", str(values.attrs.get("units", "")), " ")


LETTERS_PER_INCH = 13.0
"""Of a title's size, counted generously."""


def title_panel(axes: Axes, text: str, width: float) -> None:
    """Write what a panel shows above it, in as many lines as its width [inches] asks for."""
    axes.set_title(textwrap.fill(text, int(LETTERS_PER_INCH * width)), fontsize=9, loc="left")


def head(figure: Figure, text: str) -> None:
    """Write what a picture shows above it, in as many lines as its width asks for."""
    letters = int(LETTERS_PER_INCH * figure.get_size_inches()[0])
    lines = (textwrap.fill(line, letters) for line in text.splitlines())
    figure.suptitle("\n".join(lines), fontsize=10, parse_math=False, x=0.01, ha="left")


WITH_MARKERS = 25
"""Up to so many points a curve shows each of them."""
HALF_LETTER, HALF_HEIGHT = 0.0105, 0.028
"""Of a label, as parts of a panel of 3 inches: half the width of a letter, and half the height of a line."""
ROOM = np.array([0.45, 0.49])
"""Half the width and height of a panel that labels may fill: one at the axis hides the beginning of its curve."""
CLOSEST = 0.75
"""Of half a label: one nearer than this to another curve or label says of neither which it is."""


def label_curves(axes: Axes, labels: list[tuple[NDArray, NDArray, str, str]]) -> None:
    """Write each label on its curve, where the nearest other curve or label is farthest away, and where it hides
    neither a marked point nor the curve's lowest or highest.

    Args:
        labels: abscissae, ordinates, text and colour of each curve.
    """
    axes.get_xlim(), axes.get_ylim()  # limits that are still to be found are found now
    to_panel = axes.transData + axes.transAxes.inverted()
    points = [to_panel.transform(np.column_stack([x, y])) for x, y, _, _ in labels]
    curves = [_dense(each) for each in points]
    taken: list[tuple[NDArray, NDArray]] = []
    for number, (_, _, text, colour) in enumerate(labels):
        curve, half = curves[number], np.array([HALF_LETTER * max(len(text), 3), HALF_HEIGHT])
        if not len(curve):
            continue
        free = nearest(curve / half, [each / half for i, each in enumerate(curves) if i != number])
        for there, extent in taken:
            free = np.minimum(free, CLOSEST * (np.abs(curve - there) / (half + extent)).max(axis=1))  # no overlap
        inside = np.all(np.abs(curve - 0.5) <= ROOM - half, axis=1)
        # Flat stretches are easier to read on than steep ones, and the middle is easier to find.
        slope = np.abs(np.gradient(curve[:, 1]) / np.maximum(np.abs(np.gradient(curve[:, 0])), 1e-9))
        worth = np.minimum(free, 2.0) - 0.15 * np.minimum(slope, 3.0) - 0.4 * np.abs(curve[:, 0] - 0.5)
        shown = points[number] if len(points[number]) <= WITH_MARKERS else _extremes(curve)
        worth -= (np.abs(curve[:, None] - shown) < 1.1 * half).all(axis=2).any(axis=1)
        at = int(np.argmax(np.where(inside, worth, -np.inf)))
        if not inside[at] or free[at] < CLOSEST:
            continue  # what would only hide other curves; the next panel shows it, or a picture of fewer
        taken.append((curve[at], half))
        box = {"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.85}
        axes.text(
            curve[at, 0], curve[at, 1], text, transform=axes.transAxes, fontsize=7.5, color=colour, ha="center",
            va="center", bbox=box, zorder=3,
        )  # fmt: skip


def _extremes(curve: NDArray) -> NDArray:
    """Where a curve turns from falling to rising or back, by more than the eye would miss."""
    height = curve[:, 1]
    ends = [int(height.argmin()), int(height.argmax())]
    return curve[[at for at in ends if min(abs(height[at] - height[0]), abs(height[at] - height[-1])) > 0.01]]


LINE = 0.045
"""Of a panel's height: a line of text, and a little more."""


def label_ends(axes: Axes, labels: list[tuple[NDArray, NDArray, str, str]]) -> None:
    """Write each label to the right of the panel, beside its curve's last point, so that none covers a point.

    Args:
        labels: abscissae, ordinates, text and colour of each curve.
    """
    axes.get_xlim(), axes.get_ylim()
    to_panel = axes.transData + axes.transAxes.inverted()
    ends = [(to_panel.transform((x[-1], y[-1])), text, colour) for x, y, text, colour in labels if np.isfinite(y[-1])]
    ends.sort(key=lambda end: end[0][1])
    heights = np.array([end[0][1] for end in ends])
    rank = LINE * np.arange(heights.size)
    apart = np.maximum.accumulate(heights - rank) + rank  # each at least a line above the one before
    apart -= max(float((apart - heights).mean()), 0.0) if heights.size else 0.0
    for (end, text, colour), height in zip(ends, apart, strict=True):
        point = (float(end[0]), float(end[1]))
        axes.annotate(
            text, point, (1.03, height), "axes fraction", "axes fraction", fontsize=7.5, color=colour, va="center",
            arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.5, "shrinkA": 1.0, "shrinkB": 4.0},
            annotation_clip=False,
        )  # fmt: skip


def _dense(curve: NDArray) -> NDArray:
    """A curve by points close to each other; what is not finite is left out."""
    known = curve[np.isfinite(curve).all(axis=1)]
    if len(known) < 2:
        return known
    length = np.append(0.0, np.cumsum(np.hypot(*np.diff(known, axis=0).T)))
    even = np.linspace(0.0, length[-1], 300)
    return np.column_stack([np.interp(even, length, along) for along in known.T])


def nearest(points: NDArray, others: list[NDArray], most: float = 10.0) -> NDArray:
    """From each point to the nearest of the others, at most this."""
    if not sum(map(len, others)):
        return np.full(len(points), most)
    from scipy.spatial import cKDTree

    return np.minimum(cKDTree(np.concatenate(others)).query(points)[0], most)
