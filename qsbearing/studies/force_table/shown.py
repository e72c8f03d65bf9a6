"""A table of forces in a few words, and as columns."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.model import Block, Paragraph, Table
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.studies.force_table.force_table import LOADS, STIFFNESS

if TYPE_CHECKING:
    from xarray import Dataset

SHORT = ("x", "y", "z", "tilt_y", "tilt_z")
"""Of the directions, in the names of columns."""


def blocks_of(table: Dataset) -> list[Block]:
    """Its axes, the errors of interpolation, and how its points ended."""
    told = table.attrs
    axes = [
        (str(name), f"{float(each[0]):.6g}", f"{float(each[-1]):.6g}", f"{each.size}", str(each.attrs["range"]))
        for name, each in table.coords.items()
    ]
    errors = [_errors(table, key.name, key.unit) for key in LOADS.values()]
    met = "as wished" if told["wish_is_met"] else f"not the {told['wished_error_percent']:g} % that is wished"
    beside = f"; {told['unjudged_points']:,} of them not judged, beside points without equilibrium"
    unread = beside if told["unjudged_points"] else ""
    text = (
        f"Interpolation: {told['interpolation']}. Errors at {told['checked_points']:,} points at random, which are "
        f"none of the table{unread}: {met}. Percent are of {told['percent_of_N']:.6g} N, "
        f"{told['percent_is_of']}; of moments, times half the pitch diameter."
    )
    points = f"{told['points']:,} points"
    counts = {
        "without equilibrium, which hold no number": told["unsolved_points"],
        "where no ball presses on the inner raceway": told["points_without_loaded_balls"],
        "where some balls do not": told["points_with_some_unloaded_balls"],
    }
    parts = [f"{count:,} {what}" for what, count in counts.items() if count]
    blocks: list[Block] = [
        Table(("axis", "from", "to", "places", "range"), axes, "lrrrl"),
        Table(("load", "largest error", "%", "95 %", "%", "unit"), errors, "lrrrrl"),
        Paragraph(text, is_apart=True),
        Paragraph(f"{points}{': ' if parts else ''}{', '.join(parts)}."),
    ]
    if told["interpolation"] != told["interpolation_requested"]:
        why = "Cubic splines need every point of the table solved: it is made for linear interpolation."
        blocks.append(Paragraph(why))
    return blocks


def _errors(table: Dataset, name: str, unit: str) -> tuple[str, ...]:
    told = table[name].attrs
    cells = [
        "not known" if np.isnan(told[each]) else f"{told[each]:.3g}"
        for each in ("error_largest", "error_largest_percent", "error_95", "error_95_percent")
    ]
    return name, *cells, printed_unit(unit)


def columns_of(table: Dataset) -> dict[str, NDArray]:
    """One row per point: axes, status, loads, the stiffness row by row."""
    places = np.meshgrid(*(each.values for each in table.coords.values()), indexing="ij")
    columns: dict[str, Any] = {str(name): each.ravel() for name, each in zip(table.coords, places, strict=True)}
    words = np.array(str(table["status"].attrs["flag_meanings"]).split(" "), object)
    columns["status"] = words[table["status"].values.ravel()]
    columns["loaded_balls"] = table["loaded_balls"].values.ravel()
    columns |= {key.name: table[key.name].values.ravel() for key in LOADS.values()}
    stiffness = table[STIFFNESS].values.reshape(-1, len(CHANNELS), len(CHANNELS))
    for load, by in np.ndindex(len(SHORT), len(SHORT)):
        columns[f"k_{SHORT[load]}_{SHORT[by]}_SI"] = stiffness[:, load, by]
    return columns
