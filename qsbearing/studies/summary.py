"""A study's results in a table: how its points ended, and the spread of each quantity over those that are solved.

Read in blocks: ten million points take no more memory than one million.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.documents.model import Block, Paragraph, Table
from qsbearing.files.block_statistics import blocks, blocks_of, quantiles
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.studies.remarked import of_results, records_of

if TYPE_CHECKING:
    from xarray import DataArray, Dataset

QUANTILES = (0.0, 0.05, 0.5, 0.95, 1.0)
HEADS = ("smallest", "5 %", "median", "95 %", "largest")
"""In data."""
HEADINGS = ("minimum", *HEADS[1:-1], "maximum")
"""Over points, signs included."""
QUANTILE_COLUMNS = (2, 4, 3)
"""Of the table, which a narrow terminal leaves out."""
ITSELF = ("status", "reason", "iterations", "residual", "azimuth", "inner_raceway_controls")
"""What is said in words, or means nothing over all points."""
_MANY = 1 << 16
"""More than there are reasons."""


def words(flags: DataArray) -> list[str]:
    """The meaning of each number of a variable that holds flags: a status, a reason, or `key: what is wrong`."""
    meanings = []
    for word in str(flags.attrs["flag_meanings"]).split(" "):
        key, colon, sentence = word.partition(":")
        meanings.append(f"{key}{colon}{sentence.replace('_', ' ')}")
    return meanings


def endings(results: Dataset) -> list[tuple[str, int, str, dict[str, float]]]:
    """How points ended: status, how many, why, and the first point of each by its keys."""
    statuses, reasons = words(results["status"]), words(results["reason"])
    counts: Counter[tuple[int, int]] = Counter()
    first: dict[tuple[int, int], int] = {}
    passed = 0
    for status, reason in zip(blocks(results["status"]), blocks(results["reason"]), strict=True):
        together = status.ravel().astype(int) * _MANY + reason.ravel()
        for number, at, count in zip(*np.unique(together, return_index=True, return_counts=True), strict=True):
            kind = divmod(int(number), _MANY)
            counts[kind] += int(count)
            first.setdefault(kind, passed + int(at))
        passed += together.size
    return [
        (statuses[code], counts[code, why], "" if why == 0 else reasons[why], point(results, first[code, why]))
        for code, why in sorted(counts)
    ]


def any_is_solved(results: Dataset) -> bool:
    """Whether some point has a solution."""
    return any(bool((block == 0).any()) for block in blocks(results["status"]))


def point(results: Dataset, number: int) -> dict[str, float]:
    """The keys of one point, counted along the flattened grid."""
    dims = results["status"].dims
    place = dict(zip(dims, np.unravel_index(number, results["status"].shape), strict=True))
    return {
        str(name): float(values.isel({dim: place[dim] for dim in values.dims}))
        for name, values in results.coords.items()
        if set(values.dims) <= set(dims) and name not in ("sample", "ball")
    }


def spread(results: Dataset) -> Iterator[tuple[str, list[float], str]]:
    """Each result that says something: its name, its `QUANTILES` over the points that are solved, and its unit."""
    for name, values in results.data_vars.items():
        if name in ITSELF:
            continue
        row = quantiles(blocks_of(values), QUANTILES)
        if row and (row[0] != row[-1] or row[0] != 0.0):
            yield str(name), list(map(float, row)), printed_unit(str(values.attrs.get("units", "")))


def record(results: Dataset) -> dict[str, Any]:
    """The results in a few numbers, as data."""
    ends = [
        {"points": count, "status": status, "why": why, "first": keys} for status, count, why, keys in endings(results)
    ]
    spreads = {name: {**dict(zip(HEADS, row, strict=True)), "unit": unit} for name, row, unit in spread(results)}
    return {"points": ends, **records_of(results.attrs), "results": spreads}


def table(results: Dataset) -> list[Block]:
    """The results as tables."""
    ends = []
    for status, count, why, keys in endings(results):
        where = ", ".join(f"{name} {value:.6g}" for name, value in keys.items())
        ends.append((f"{count:,}", status, why, "" if status == "converged" else where))
    spreads = [(name, *(f"{value:.5g}" for value in row), unit) for name, row, unit in spread(results)]
    return [
        Table(("points", "status", "why", "first point"), ends, "rlll"),
        Table(("result", *HEADINGS, "unit"), spreads, f"l{'r' * len(HEADS)}l", spare=QUANTILE_COLUMNS),
        *of_results(results.attrs),
    ]


def table_of_indices(indices: Dataset) -> list[Block]:
    """Sobol indices as a table: for each result the keys that matter, the one that matters most first."""
    shown: list[tuple[str, ...]] = []
    for name in indices["result"].values:
        of_result = indices.sel(result=name)
        total = of_result["total"].values
        if not np.isfinite(total).any():
            shown.append((str(name), _WITHOUT_INDICES, "", ""))
            continue
        order = [int(i) for i in np.argsort(-total) if total[i] >= LEAST_INDEX]
        for place, i in enumerate(order):
            pairs = ((of_result[each].values[i], of_result[f"{each}_error"].values[i]) for each in INDICES)
            cells = (f"{value:.2f} ± {error:.2f}" for value, error in pairs)
            shown.append((str(name) if place == 0 else "", str(indices["key"].values[i]), *cells))
        if rest := total.size - len(order):
            shown.append(("", f"{rest} {'key' if rest == 1 else 'keys'} below {LEAST_INDEX:g}", "", ""))
    said = f"{indices.attrs['points']:,} points, {indices.attrs['base_samples']:,} base samples; ±: 95 % confidence"
    parts: list[Block] = [
        Table(("result", "key", "first order", "total"), shown, "llrr"),
        Paragraph(said, is_apart=True),
    ]
    if indices.attrs["unsolved"]:
        lack = f"{indices.attrs['unsolved']:,} points have no solution: results that they lack have no indices"
        parts.append(Paragraph(lack))
    return [*parts, *of_results(indices.attrs)]


INDICES = ("first_order", "total")
LEAST_INDEX = 0.005
"""What is shown as more than 0.00."""
_WITHOUT_INDICES = "does not vary, or is not known of every point"
