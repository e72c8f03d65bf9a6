"""What pictures of records share."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.tri import Triangulation
from numpy.typing import NDArray

Entry = dict[str, Any]
HERTZ: dict[str, Any] = {"color": "black", "linewidth": 1.2}
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000")
"""Of series, in turn: told apart by every kind of colour vision."""
FOUND: dict[str, Any] = {"color": "#d55e00", "marker": ".", "linestyle": "none", "markersize": 3}


PRESSURE = LinearSegmentedColormap.from_list("pressure", ["#f2f5f7", "#a9c4d3", "#0072b2", "#d55e00", "#7a1f00"])
"""The colours of the other pictures: none, blue, orange."""


def map_of(axes: Axes, x: NDArray[Any], y: NDArray[Any], values: NDArray[Any], a: float, b: float) -> Any:
    """Contours of a contact pressure over an ellipse of semi-axes a and b, smoothed between the mesh's points.

    The square is smoothed, which for Hertz's pressure is a parabola that crosses zero at the edge; the pressure itself
    has an infinite slope there. The points are those of a circle: an ellipse's own triangles would be slivers.
    """
    from scipy.interpolate import RBFInterpolator

    pressed = values > 0.0
    known, square = np.column_stack([x / a, y / b])[pressed], (values[pressed] / values.max()) ** 2
    smooth = RBFInterpolator(known, square, kernel="thin_plate_spline", degree=2, smoothing=0.02 * len(known))
    u, v = (each.ravel() for each in np.meshgrid(np.linspace(-1.12, 1.12, 121), np.linspace(-1.12, 1.12, 81)))
    shown = values.max() * np.sqrt(np.clip(smooth(np.column_stack([u, v])), 0.0, None))
    levels = np.linspace(0.02, 1.02, 51) * values.max()  # without pressure no colour
    filled = axes.tricontourf(Triangulation(u * a, v * b), shown, levels=levels, cmap=PRESSURE)
    filled.set(edgecolor="face", linewidth=0.4)  # else the page shows light lines between the levels
    return filled


def load_axis(axes: Axes, loads: list[float]) -> None:
    """A logarithmic axis that names the loads solved for, and nothing between them."""
    axes.set_xticks(loads, [f"{load:g}" for load in loads], fontsize=8)
    axes.minorticks_off()
    axes.set_xlabel("load, N")
