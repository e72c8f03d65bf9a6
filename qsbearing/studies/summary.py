"""A study's results in a table: how its points ended, and the spread of each quantity over those that are solved."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from rich.console import Group
    from xarray import DataArray, Dataset

QUANTILES = (0.0, 0.05, 0.5, 0.95, 1.0)
HEADS = ("smallest", "5 %", "median", "95 %", "largest")
ITSELF = ("status", "reason", "iterations", "residual", "azimuth", "inner_raceway_controls")
"""What is said in words, or means nothing over all points."""


def words(flags: DataArray) -> list[str]:
    """The meaning of each number of a variable that holds flags: a status, a reason, or `key: what is wrong`."""
    found = []
    for word in str(flags.attrs["flag_meanings"]).split(" "):
        key, colon, sentence = word.partition(":")
        found.append(f"{key}{colon}{sentence.replace('_', ' ')}")
    return found


def endings(results: Dataset) -> list[tuple[str, int, str, dict[str, float]]]:
    """How points ended: status, how many, why, and the first of them by its keys."""
    found = []
    statuses, reasons = words(results["status"]), words(results["reason"])
    pairs = np.stack([results["status"].values.ravel(), results["reason"].values.ravel()])
    for (code, why), at, count in zip(*_unique(pairs), strict=True):
        found.append((statuses[code], int(count), "" if why == 0 else reasons[why], point(results, int(at))))
    return found


def _unique(pairs: NDArray) -> tuple[NDArray, NDArray, NDArray]:
    """The different columns, the first place of each, and how many there are."""
    numbers, first, counts = np.unique(pairs[0].astype(int) * 100_000 + pairs[1], return_index=True, return_counts=True)
    return np.stack(np.divmod(numbers, 100_000), axis=1), first, counts


def point(results: Dataset, number: int) -> dict[str, float]:
    """The keys of one point, counted along the flattened grid."""
    dims = results["status"].dims
    place = dict(zip(dims, np.unravel_index(number, results["status"].shape), strict=True))
    return {
        str(name): float(values.isel({dim: place[dim] for dim in values.dims}))
        for name, values in results.coords.items()
        if set(values.dims) <= set(dims) and name not in ("sample", "ball")
    }


def table(results: Dataset) -> Group:
    """The results as tables of rich."""
    from rich.console import Group
    from rich.table import Table

    ends = Table(box=None, padding=(0, 2, 0, 0), title_justify="left")
    for head in ("points", "status", "why", "the first of them"):
        ends.add_column(head, justify="right" if head == "points" else "left")
    for status, count, why, keys in endings(results):
        where = ", ".join(f"{name} {value:.6g}" for name, value in keys.items())
        ends.add_row(f"{count:,}", status, why, "" if status == "converged" else where)
    spread = Table(box=None, padding=(0, 2, 0, 0))
    spread.add_column("result")
    for head in HEADS:
        spread.add_column(head, justify="right")
    spread.add_column("unit")
    for name, values in results.data_vars.items():
        if name not in ITSELF and np.isfinite(values).any():
            row = _spread(values)
            if row[0] != row[-1] or row[0] != 0.0:
                unit = str(values.attrs.get("units", ""))
                spread.add_row(str(name), *(f"{value:.5g}" for value in row), "" if unit == "1" else unit)
    return Group(ends, "", spread)


def _spread(values: Any) -> list[float]:
    finite = values.values[np.isfinite(values.values)]
    return [float(value) for value in np.quantile(finite, QUANTILES)]
