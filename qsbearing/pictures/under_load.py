"""A bearing or set under its load, at a glance: the section and the loads; the bent shaft and the loads of each row."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from qsbearing.model.solution.case_index import Index, case_place
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import um
from qsbearing.pictures.contact_ellipses import draw_ellipses
from qsbearing.pictures.deformed_shaft import draw_deformed_shaft, length_of, main_plane, scale_of
from qsbearing.pictures.load_distribution import draw_loads, load_span
from qsbearing.pictures.ring_shape import draw_shape
from qsbearing.pictures.section import draw_section
from qsbearing.pictures.style import carry_alike, figure_of_size, legend
from qsbearing.systems.sets.set_solution import SetSolution

if TYPE_CHECKING:
    from matplotlib.figure import Figure

WIDTH = 9.0
"""Of a page's text, at which letters have one size in all pictures of a document [inches]."""
OF_BEARING, OF_SHAFT, OF_ROWS = 2.7, 2.6, 1.5
"""Heights [inches]."""
SHORT = 4.0
"""Length over height of what is drawn of a shaft, below which its rows stand beside it."""
PER_LINE = 6
"""Rows side by side."""


def under_load(solution: Solution | SetSolution, index: Index = None) -> Figure:
    """Of a bearing the section through the ball that carries most, beside it the loads of all balls, or the ellipses
    where all are alike; of a set its shaft as it bends in the plane in which its first point moves, below it the loads
    of each row's balls, all to one scale.

    Args:
        index: the case, along the solution's case axes; nothing for a single case.
    """
    drawn: Figure = (_of_set if isinstance(solution, SetSolution) else _of_bearing)(solution, index)  # type: ignore[arg-type]
    return drawn


def _of_bearing(solution: Solution, index: Index) -> Any:
    place = solution.place(index)
    figure: Any = figure_of_size(WIDTH, OF_BEARING)
    left, right = figure.subfigures(1, 2, width_ratios=(1.45, 1.0))
    draw_section(left.subplots(), solution, place)
    if carry_alike(solution, place):
        draw_ellipses(right.subplots(), solution, place)
        return figure
    is_elastic = solution.scene.elastic_rings is not None
    axes = right.add_subplot(projection="polar")
    (draw_shape if is_elastic else draw_loads)(axes, solution, place)
    legend(right, axes)
    return figure


def _of_set(solution: SetSolution, index: Index) -> Any:
    place = case_place(index, solution.shape)
    scale = scale_of(solution, place)
    is_short = length_of(solution) < SHORT * scale.top
    lines = 1 if is_short else -(-len(solution.rows) // PER_LINE)
    columns = -(-len(solution.rows) // lines)
    below_height = lines * OF_ROWS
    figure: Any = figure_of_size(WIDTH, OF_SHAFT if is_short else OF_SHAFT + below_height)
    if is_short:
        above, below = figure.subfigures(1, 2, width_ratios=(1.0, 0.75 * columns))
    else:
        above, below = figure.subfigures(2, 1, height_ratios=(OF_SHAFT, below_height))
    axes = above.subplots()
    draw_deformed_shaft(axes, solution, place, main_plane(solution, place), scale, are_points_told=False)
    title = _moves(solution, place, scale.factor, "\n" if is_short else ", ")
    axes.set_title(title, fontsize=10 if is_short else 13, fontweight="bold", pad=8)
    panels = below.subplots(lines, columns, squeeze=False, subplot_kw={"projection": "polar"}).ravel()
    span = 0.0, max(load_span(row, place)[1] for row in solution.rows)
    for number, (axes, row) in enumerate(zip(panels, solution.rows, strict=False)):
        draw_loads(axes, row, place, span, is_labelled=number == 0, is_small=True)
        axes.set_title(f"row {number + 1}: {load_span(row, place)[1]:.4g} N", fontsize=10, pad=8)
    for axes in panels[len(solution.rows) :]:
        axes.set_axis_off()
    known = dict(zip(*reversed(panels[0].get_legend_handles_labels()), strict=True))
    below.legend(
        list(known.values()), list(known), loc="outside left center", title="contact loads", fontsize=9, frameon=False
    )
    return figure


def _moves(solution: SetSolution, place: Any, factor: float, between: str) -> str:
    """How far the first point moves across the shaft, and how large that is drawn."""
    name = next(iter(solution.points), "")
    moved = solution.points[name].displacement[place] if name else solution.displacement[place]
    across = float((moved[1] ** 2 + moved[2] ** 2) ** 0.5) / um
    what = name or "shaft"
    return (
        f"{what} moves {across:.3g} µm sideways{between}drawn × {factor:,.0f}" if across else f"{what} keeps its place"
    )
