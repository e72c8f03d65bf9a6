"""What pictures of records share."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes

Entry = dict[str, Any]
HERTZ: dict[str, Any] = {"color": "black", "linewidth": 1.2}
FOUND: dict[str, Any] = {"color": "#c44e52", "marker": ".", "linestyle": "none", "markersize": 3}


def load_axis(axes: Axes, loads: list[float]) -> None:
    """A logarithmic axis that names the loads solved for, and nothing between them."""
    axes.set_xticks(loads, [f"{load:g}" for load in loads], fontsize=8)
    axes.minorticks_off()
    axes.set_xlabel("load, N")
