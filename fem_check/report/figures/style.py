"""What pictures of records share."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.tri import Triangulation
from numpy.polynomial.polynomial import polyval2d, polyvander2d
from numpy.typing import NDArray

INCHES = 11.0
"""Width of a figure that would fill the page."""
HERTZ: dict[str, Any] = {"color": "black", "linewidth": 1.2}
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9")
"""Of series, in turn: told apart by every kind of colour vision."""
COMPUTED: dict[str, Any] = {"color": "#d55e00", "marker": ".", "linestyle": "none", "markersize": 3}


PRESSURE = LinearSegmentedColormap.from_list("pressure", ["#f2f5f7", "#a9c4d3", "#0072b2", "#d55e00", "#7a1f00"])
"""The colours of the other pictures: none, blue, orange."""


def smoothed(
    x: NDArray[Any], y: NDArray[Any], values: NDArray[Any], a: float, b: float, points: tuple[int, int] = (121, 81)
) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Square of a contact pressure over its largest on a grid over an ellipse of semi-axes a and b, and x/a, y/b there.

    A polynomial smooths the square, which for Hertz's pressure is a parabola that crosses zero at the edge; the
    pressure itself has an infinite slope there.
    """
    pressed = values > 0.0
    u, v, square = x[pressed] / a, y[pressed] / b, (values[pressed] / values.max()) ** 2
    degree = 4 if len(square) > 200 else 2  # more needs a finer mesh
    smooth, *_ = np.linalg.lstsq(polyvander2d(u, v, [degree, degree]), square, rcond=None)
    u, v = np.meshgrid(*(np.linspace(-1.12, 1.12, count) for count in points))
    square = polyval2d(u, v, smooth.reshape(degree + 1, -1))
    square[u**2 + v**2 > 1.25] = 0.0  # away from all that was fitted a polynomial says nothing
    return u, v, square


def map_of(axes: Axes, x: NDArray[Any], y: NDArray[Any], values: NDArray[Any], a: float, b: float) -> Any:
    """Contours of a contact pressure over an ellipse of semi-axes a and b, smoothed between the mesh's points.

    The points are those of a circle: an ellipse's own triangles would be slivers.
    """
    u, v, square = (each.ravel() for each in smoothed(x, y, values, a, b))
    shown = values.max() * np.sqrt(np.clip(square, 0.0, None))
    levels = np.linspace(0.02, 1.02, 51) * values.max()  # without pressure no colour
    filled = axes.tricontourf(Triangulation(u * a, v * b), shown, levels=levels, cmap=PRESSURE)
    filled.set(edgecolor="face", linewidth=0.4)  # else the page shows light lines between the levels
    return filled


def load_axis(axes: Axes, loads: list[float]) -> None:
    """A logarithmic axis that names the loads solved for, and nothing between them."""
    axes.set_xticks(loads, [f"{load:g}" for load in loads], fontsize=8)
    axes.minorticks_off()
    axes.set_xlabel("load, N")
