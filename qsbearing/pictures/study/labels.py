"""What a study's keys and results are called on a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from xarray import DataArray

_NAMES = {
    "angle": "contact angle",
    "load": "contact load",
    "approach": "elastic approach",
    "max_pressure": "greatest contact pressure",
    "required_friction": "friction that Mg requires",
    "life_basic_reference_rating_life": "basic reference rating life",
    "life_modified_reference_rating_life": "modified reference rating life",
    "life_basic_rating_life": "basic rating life",
    "film_film_parameter": "film parameter",
    "balls_off_inner": "balls off the inner raceway",
    "least_loaded_azimuth": "azimuth of the least loaded ball",
    "speed": "speed of the inner ring",
    "free_contact_angle": "free contact angle",
    "groove_radius_coefficient": "groove radius coefficient $f$",
    "inner_groove_radius_coefficient": "groove radius coefficient $f_i$",
    "outer_groove_radius_coefficient": "groove radius coefficient $f_o$",
}
_CHANNELS = ("axial", "radial_y", "radial_z", "tilt_y", "tilt_z", "moment_y", "moment_z")


def stem(name: str) -> tuple[str, str]:
    """What results on one panel share, and what tells one from another: raceway, channel, or nothing."""
    for side in ("inner", "outer"):
        if name.startswith(f"{side}_") and "ring" not in name and name != "inner_raceway_controls":
            return name.removeprefix(f"{side}_"), side
    for channel in _CHANNELS:
        if name.startswith("ring_") and name.endswith(f"_{channel}"):
            return name.removeprefix("ring_").removesuffix(f"_{channel}"), channel
    return name, ""


def words(name: str) -> str:
    """A stem in words."""
    for ending, said in (("_max", ", largest"), ("_min", ", smallest")):
        if name.endswith(ending):
            found = words(name.removesuffix(ending))
            return found if found.startswith("greatest") else found + said
    return _NAMES.get(name, name.replace("_", " "))


def with_unit(text: str, unit: str) -> str:
    """A heading with its unit, where it has one."""
    return text if unit in ("", "1", "balls") else f"{text}, {_printed(unit)}"


def key_words(values: DataArray) -> str:
    """A varied key in words, without its unit."""
    return without_unit(str(values.name), str(values.attrs.get("units", "")))


def without_unit(name: str, unit: str) -> str:
    """The name of a key in words, its unit taken off."""
    ending = unit.replace(" ", "").replace("/", "")
    for each in (f"_{ending}", f"_{unit.replace('/', '_')}", "_per_K"):
        if ending and name.endswith(each):
            name = name.removesuffix(each)
    return words(name)


def key_heading(values: DataArray) -> str:
    """A varied key with its unit, as an axis needs it."""
    return with_unit(key_words(values), str(values.attrs.get("units", "")))


def value_label(values: DataArray, number: float) -> str:
    """One value of a key, with its unit."""
    unit = str(values.attrs.get("units", ""))
    return f"{number:.6g}" if unit in ("", "1", "balls") else f"{number:.6g} {_printed(unit)}"


def _printed(unit: str) -> str:
    return unit.replace("um", "µm")


CLOSEST = 0.025
"""Of a panel's height: a label nearer than this to another curve says of neither which it is."""


def label_curves(axes: Axes, labels: list[tuple[NDArray, NDArray, str, str]]) -> None:
    """Write each label on its curve, where the nearest other curve or label is farthest away.

    Args:
        labels: abscissae, ordinates, text and colour of each curve; all share their abscissae.
    """
    if not labels:
        return
    low, high = axes.get_ylim()
    heights = (np.array([y for _, y, _, _ in labels]) - low) / (high - low)
    x = labels[0][0]
    along = np.linspace(0.0, 1.0, x.size) if np.ptp(x) == 0.0 else (x - x.min()) / np.ptp(x)
    inside = (along > 0.12) & (along < 0.88)
    taken: list[tuple[float, float]] = []
    for number, (_, y, text, colour) in enumerate(labels):
        others = np.abs(np.delete(heights, number, axis=0) - heights[number])
        free = np.fmin.reduce(np.vstack([others, np.full((1, x.size), 1.0)]), axis=0)
        for there, height in taken:  # a label is about five times as wide as high
            free = np.minimum(free, np.hypot((along - there) / 3.0, heights[number] - height))
        # Flat stretches are easier to read on than steep ones, and the middle is easier to find.
        slope = np.abs(np.gradient(heights[number], along)) if x.size > 1 else np.zeros(1)
        worth = np.minimum(free, 0.12) - 0.02 * slope - 0.02 * np.abs(along - 0.5)
        known = inside & np.isfinite(y)
        if not known.any():
            known = np.isfinite(y)
        if not known.any():
            continue
        at = int(np.argmax(np.where(known, worth, -np.inf)))
        if free[at] < CLOSEST:
            continue  # what would only hide other curves; the next panel shows it, or a picture of fewer
        taken.append((float(along[at]), float(heights[number, at])))
        box = {"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.85}
        axes.text(x[at], y[at], text, fontsize=7.5, color=colour, ha="center", va="center", bbox=box, zorder=3)
