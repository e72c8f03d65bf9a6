"""Loads, angles and ellipses on one sheet."""

from __future__ import annotations

from typing import TYPE_CHECKING

from qsbearing.pictures.contact_angles import draw_angles
from qsbearing.pictures.contact_ellipses import draw_ellipses
from qsbearing.pictures.load_distribution import draw_loads
from qsbearing.pictures.style import figure_of_size, legend, write_title
from qsbearing.solution import Index, Solution

if TYPE_CHECKING:
    from matplotlib.figure import Figure


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
