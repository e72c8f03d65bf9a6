"""All rows of agreement at once, by kind of evidence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from fem_check.report.figures.style import FOUND, HERTZ, Entry

LEAST = 1e-10
"""Per cent: smaller deviations are drawn here."""


def drawable(rows: Sequence[Entry]) -> list[Entry]:
    """Those that have a point on logarithmic axes: something was found, and neither it nor the reference is zero."""
    return [row for row in rows if row["found"] and row["reference"]]


def scatter(groups: Mapping[str, Sequence[Entry]]) -> Figure:
    """Found against reference, and deviation against tolerance, a column for each kind of evidence."""
    figure, grid = plt.subplots(
        2, len(groups), figsize=(2.9 * len(groups), 5.6), layout="constrained", sharey="row", squeeze=False
    )
    for (name, rows), over, under in zip(groups.items(), *grid, strict=True):
        shown = drawable(rows)
        reference, found = (np.abs([row[key] for row in shown]) for key in ("reference", "found"))
        ends = np.array([reference.min() / 3.0, reference.max() * 3.0])
        judged = [row for row in rows if row["tolerance_percent"] and row["found"] is not None]
        over.loglog(ends, ends, **HERTZ)
        over.loglog(reference, found, **FOUND)
        kind, _, what = name.partition(": ")
        over.set_title(f"{kind}{': ' if what else ''}\n{what or ' '}\n{len(rows)} rows", fontsize=9)
        over.set_xlabel("reference")
        under.set_xlabel("tolerance, %")
        if not judged:
            continue
        tolerance = np.array([row["tolerance_percent"] for row in judged])
        reach = np.array([abs(row["deviation_percent"]) + (row["uncertainty_percent"] or 0.0) for row in judged])
        # Half of a tolerance beyond 100 % would be a negative value, which has no logarithm.
        widest = min(tolerance[[row["reference"] != 0.0 for row in judged]].max(initial=0.0), 99.0) / 100.0
        over.fill_between(ends, ends * (1.0 - widest), ends * (1.0 + widest), color="0.85", linewidth=0)
        limits = np.array([tolerance.min() / 3.0, tolerance.max() * 3.0])
        under.loglog(limits, limits, **HERTZ)
        under.fill_between(limits, LEAST / 3.0, limits, color="0.92", linewidth=0)
        under.loglog(tolerance, np.maximum(reach, LEAST), **FOUND)
        under.set_ylim(LEAST / 3.0, None)
    grid[0, 0].set_ylabel("found")
    grid[1, 0].set_ylabel("deviation and uncertainty, %")
    return figure
