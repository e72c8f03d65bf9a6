"""How much of its limit each row takes, by quantity."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import fill

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from fem_check.report.figures.style import COMPUTED, HERTZ
from fem_check.report.rows import as_read, quantity, used
from fem_check.rows.record import Record, RowRecord

MOST = 8
"""Quantities shown, those nearest to their limits."""


def drawable(rows: Sequence[RowRecord]) -> dict[str, list[float]]:
    """Shares by quantity; of a row that takes none there is no point."""
    by_quantity: dict[str, list[float]] = {}
    for row in rows:
        if 0.0 < used(row) < float("inf"):
            by_quantity.setdefault(quantity(as_read(row["quantity"])), []).append(used(row))
    return dict(sorted(by_quantity.items(), key=lambda each: max(each[1]))[-MOST:])


def draw(entry: Record) -> Figure:
    """A line of points for each quantity, on a logarithmic axis that ends past the limit."""
    shares = drawable(entry["rows"])
    names = [fill(name, 30) for name in shares]
    height = 0.8 + 0.15 * sum(1.5 + name.count("\n") for name in names)
    figure, axes = plt.subplots(figsize=(5.0, height), layout="constrained")
    for place, values in enumerate(shares.values()):
        axes.plot(values, [place] * len(values), **(COMPUTED | {"markersize": 7}))
    axes.axvline(1.0, **HERTZ)
    axes.set_yticks(range(len(shares)), names, fontsize=8)
    axes.set(xscale="log", xlabel="deviation and uncertainty over the limit", ylim=(-0.6, len(shares) - 0.4))
    axes.set_xlim(None, 2.0)
    axes.grid(axis="y", color="0.9", linewidth=0.6)
    return figure
