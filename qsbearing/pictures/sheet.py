"""The pictures of one case: each drawing on a sheet of its own, or all on one."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from qsbearing.case_index import Index, Place
from qsbearing.pictures.contact_angles import draw_angles
from qsbearing.pictures.contact_ellipses import draw_ellipses
from qsbearing.pictures.load_distribution import draw_loads
from qsbearing.pictures.style import figure_of_size, legend, write_title
from qsbearing.solution import Solution

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Drawing = Callable[[Any, Solution, Place], None]


def load_distribution(solution: Solution, index: Index = None) -> Figure:
    """Contact loads of all balls around the bearing, as a polar picture.

    Args:
        index: the case, along the solution's case axes; nothing for a single case.
    """
    return _alone(draw_loads, (5.6, 5.6), solution, index, "polar")


def contact_angles(solution: Solution, index: Index = None) -> Figure:
    """Inner and outer contact angles by azimuth."""
    return _alone(draw_angles, (7.0, 4.2), solution, index)


def contact_ellipses(solution: Solution, index: Index = None) -> Figure:
    """Outlines of the contact ellipses, all to one scale, with their maximum pressure."""
    return _alone(draw_ellipses, (10.0, 4.6), solution, index)


def overview(solution: Solution, index: Index = None) -> Figure:
    """Loads, angles and ellipses on one sheet."""
    place = solution._place(index)
    figure = figure_of_size(11.0, 8.2)
    grid = figure.add_gridspec(2, 2, width_ratios=(1.0, 1.25), height_ratios=(1.1, 1.0))
    loads = figure.add_subplot(grid[0, 0], projection="polar")
    angles = figure.add_subplot(grid[0, 1])
    draw_loads(loads, solution, place)
    draw_angles(angles, solution, place)
    draw_ellipses(figure.add_subplot(grid[1, :]), solution, place)
    legend(figure, angles, loads)
    write_title(figure, solution, place)
    return figure


def _alone(
    draw: Drawing, size: tuple[float, float], solution: Solution, index: Index, projection: str | None = None
) -> Figure:
    place = solution._place(index)
    figure = figure_of_size(*size)
    axes = figure.add_subplot(projection=projection)
    draw(axes, solution, place)
    legend(figure, axes)
    write_title(figure, solution, place)
    return figure
