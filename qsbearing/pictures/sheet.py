"""The pictures of one case: each drawing on a sheet of its own, or all on one; of a set, a panel for each row."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from qsbearing.model.solution.case_index import CasePlace, Index, case_place
from qsbearing.model.solution.solution import Solution
from qsbearing.pictures.ball_advance import draw_advance
from qsbearing.pictures.contact_angles import angle_span, draw_angles
from qsbearing.pictures.contact_ellipses import draw_ellipses
from qsbearing.pictures.deformed_shaft import draw_deformed_shaft, planes_of, scale_of
from qsbearing.pictures.ellipse_on_groove import draw_grooves, edges_told, on_grooves
from qsbearing.pictures.load_distribution import draw_loads, load_span
from qsbearing.pictures.ring_shape import draw_shape
from qsbearing.pictures.section import draw_section
from qsbearing.pictures.style import (
    Span,
    carry_alike,
    figure_of_size,
    legend,
    write_above,
    write_title,
    write_title_of_set,
)
from qsbearing.systems.sets.set_solution import SetSolution

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Drawing(NamedTuple):
    """A drawing of one bearing, which the rows of a set repeat to one scale."""

    draw: Callable[..., None]
    """Takes axes, solution, place and the span to show."""
    span: Callable[[Solution, CasePlace], Span]
    size: tuple[float, float]
    """Alone on a sheet [inches]."""
    panel: tuple[float, float]
    """For a row of a set, on a sheet of everything [inches]."""
    small: tuple[float, float]
    """For a row of a set, on a sheet of nothing else [inches]."""
    projection: str | None = None


LOADS = Drawing(draw_loads, load_span, (5.0, 5.0), (3.6, 3.8), (3.0, 3.2), "polar")
ANGLES = Drawing(draw_angles, angle_span, (6.2, 3.6), (3.6, 2.9), (3.4, 2.5))
GROOVES, OF_ROW = (5.8, 4.0), (2.25, 2.75)
"""Of both grooves of a bearing, and of each row of a set [inches]."""
FLAT = 2.4
"""Width and height of the angles of rows where there are many, so that four have room side by side [inches]."""
SHAFT_HEIGHT, SHAFT_WIDTH = 3.4, 6.6
"""Of a shaft in one plane [inches]."""
ABOVE, FLATTER = 4.2, 0.72
"""Height of a shaft above its rows [inches], and theirs over what they have alone."""
PER_LINE = 3
"""Rows of a set side by side: more would be too small to read on a page."""
PER_SHEET = 4
"""Rows of a set side by side on a sheet of everything, for a screen."""
HIGHEST = 9.2
"""Of a sheet of everything: 1400 dots on a screen, with its title [inches]."""


def load_distribution(solution: Solution | SetSolution, index: Index = None) -> Figure:
    """Contact loads of all balls around the bearing, as a polar picture; of a set, one for each row.

    Args:
        index: the case, along the solution's case axes; nothing for a single case.
    """
    if isinstance(solution, SetSolution):
        return _rows([LOADS], solution, index)
    return _alone(LOADS.draw, LOADS.size, solution, index, LOADS.projection)


def contact_angles(solution: Solution | SetSolution, index: Index = None) -> Figure:
    """Inner and outer contact angles by azimuth; of a set, of each row."""
    if isinstance(solution, SetSolution):
        return _rows([ANGLES], solution, index)
    return _alone(ANGLES.draw, ANGLES.size, solution, index)


def contact_ellipses(solution: Solution, index: Index = None) -> Figure:
    """Outlines of the contact ellipses, all to one scale, with their maximum pressure."""
    size = (5.6, 4.6) if carry_alike(solution, solution.place(index)) else (10.0, 3.8)
    return _alone(draw_ellipses, size, solution, index)


def section(solution: Solution, index: Index = None, ball: int | None = None) -> Figure:
    """The section through one ball with the lines of action, angles and loads of its contacts.

    Args:
        ball: its number, from zero; None: the one with the largest contact load.
    """
    return _alone(partial(draw_section, ball=ball), (6.4, 5.4), solution, index)


def ellipse_on_groove(solution: Solution | SetSolution, index: Index = None) -> Figure:
    """The contact ellipse of the most loaded ball on each groove, along the contact's normal, and how far its tip is
    from the groove's edge; of a set, of each row. Shoulders that nobody states are assumed, and said to be."""
    if isinstance(solution, Solution):
        return _alone(draw_grooves, GROOVES, solution, index)
    place = case_place(index, solution.shape)
    count = len(solution.rows)
    columns = min(count, PER_SHEET)
    lines = -(-count // columns)
    figure = figure_of_size(max(columns * OF_ROW[0], 5.0), lines * OF_ROW[1] + 0.6)
    panels = figure.subplots(lines, columns, squeeze=False).ravel()
    grooves = []
    for number, (axes, row) in enumerate(zip(panels, solution.rows, strict=False)):
        draw_grooves(axes, row, place, is_small=True)
        axes.set_title(f"Row {number + 1}, {solution.set.rows[number].carries}", fontsize=10, loc="left")
        grooves += [(f"row {number + 1} {side}", each) for side, each in on_grooves(row, place).items()]
    for axes in panels[count:]:
        axes.set_axis_off()
    write_above(figure, f"Contact ellipses on their grooves, rolling up and down, {edges_told(grooves)}")
    return figure


def ball_advance(solution: Solution, index: Index = None) -> Figure:
    """How far balls run ahead of and behind the cage over a turn; with its pockets' clearance where that is read."""
    return _alone(draw_advance, (6.2, 3.6), solution, index)


def ring_shape(solution: Solution, index: Index = None) -> Figure:
    """The grooves of elastic rings around the bearing, as they move away from the balls, far larger than they do."""
    return _alone(draw_shape, (4.8, 4.8), solution, index, "polar")


def deformed_shaft(solution: SetSolution, index: Index = None) -> Figure:
    """The shaft of a set as drawn and as it bends, with bearings, loads and points, in each plane in which it bends.

    Raises:
        ValueError: the set has no shaft of its own.
    """
    if solution.set.shaft is None or not solution.set.shaft.sections:
        raise ValueError("this set's shaft is rigid: qs.BearingSet(..., shaft=qs.Shaft(...))")
    place = case_place(index, solution.shape)
    planes = planes_of(solution, place)
    figure = figure_of_size(9.0, SHAFT_HEIGHT * len(planes) + 0.8)
    panels = figure.subplots(len(planes), 1, squeeze=False)[:, 0]
    scale = scale_of(solution, place)
    for axes, plane in zip(panels, planes, strict=True):
        draw_deformed_shaft(axes, solution, place, plane, scale)
    legend(figure, *panels)
    write_title_of_set(figure, solution, place)
    return figure


def overview(solution: Solution | SetSolution, index: Index = None) -> Figure:
    """On one sheet loads, angles, ellipses and elastic grooves, or, where all balls carry alike, the section and the
    ellipses; of a set, its shaft as it bends, if it does, then loads and angles of each row."""
    if isinstance(solution, SetSolution):
        return _rows([LOADS, ANGLES], solution, index)
    place = solution.place(index)
    if carry_alike(solution, place):
        figure = figure_of_size(10.4, 5.0)
        left, right = figure.subplots(1, 2, width_ratios=(1.9, 1.0))
        draw_section(left, solution, place)
        draw_ellipses(right, solution, place)
        write_title(figure, solution, place)
        return figure
    is_elastic = solution.scene.elastic_rings is not None
    heights = (4.3, 3.4, 3.9) if is_elastic else (4.3, 3.9)
    figure = figure_of_size(9.6 if is_elastic else 10.4, sum(heights))
    grid = figure.add_gridspec(len(heights), 2, width_ratios=(1.0, 1.0 if is_elastic else 1.25), height_ratios=heights)
    loads = figure.add_subplot(grid[0, 0], projection="polar")
    angles = figure.add_subplot(grid[1, :] if is_elastic else grid[0, 1])
    draw_loads(loads, solution, place)
    draw_angles(angles, solution, place)
    if is_elastic:
        draw_shape(figure.add_subplot(grid[0, 1], projection="polar"), solution, place)
    draw_ellipses(figure.add_subplot(grid[-1, :]), solution, place)
    legend(figure, angles, loads)
    write_title(figure, solution, place)
    return figure


def _alone(
    draw: Callable[..., None],
    size: tuple[float, float],
    solution: Solution,
    index: Index,
    projection: str | None = None,
) -> Figure:
    place = solution.place(index)
    figure = figure_of_size(*size)
    axes = figure.add_subplot(projection=projection)
    draw(axes, solution, place)
    legend(figure, axes)
    write_title(figure, solution, place)
    return figure


def _rows(drawings: Sequence[Drawing], solution: SetSolution, index: Index) -> Figure:
    """A column for each row, below each other where there are many; one scale for all rows."""
    place = case_place(index, solution.shape)
    count, is_sheet = len(solution.rows), len(drawings) > 1
    lines = -(-count // (PER_SHEET if is_sheet else PER_LINE))
    columns = -(-count // lines)
    panels = [drawing.panel if is_sheet else drawing.small for drawing in drawings]
    is_flat = drawings == [ANGLES] and lines > 1
    if is_flat:
        columns = min(count, PER_SHEET)
        lines = -(-count // columns)
        panels = [(FLAT, FLAT)]
    shaft = solution.set.shaft
    planes = planes_of(solution, place) if shaft is not None and shaft.sections and is_sheet else []
    above = int(bool(planes))
    # Beside a shaft, rows get less of the height.
    heights = [ABOVE] * above + [(FLATTER if above else 1.0) * height for _, height in panels] * lines
    height = min(sum(heights) + 0.7, HIGHEST) if is_sheet else sum(heights) + 0.7
    figure = figure_of_size(max(columns * panels[0][0], 6.0, SHAFT_WIDTH * len(planes)), height)
    grid = figure.add_gridspec(len(heights), columns, height_ratios=heights)
    drawn: list[Any] = []
    if planes:
        drawn.extend(figure.add_subfigure(grid[0, :]).subplots(1, len(planes), squeeze=False)[0])
        for axes, plane in zip(drawn, planes, strict=True):
            draw_deformed_shaft(axes, solution, place, plane, scale_of(solution, place))
    for k, drawing in enumerate(drawings):
        spans = [drawing.span(row, place) for row in solution.rows]
        span = min(low for low, _ in spans), max(high for _, high in spans)
        for number, row in enumerate(solution.rows):
            line, column = divmod(number, columns)
            place_of_panel = above + line * len(drawings) + k, column
            axes = figure.add_subplot(grid[place_of_panel], projection=drawing.projection)
            how = {"is_labelled": number == 0} if drawing is LOADS else {"is_small": is_flat}
            drawing.draw(axes, row, place, span, **how)
            own = solution.set.rows[number]
            name = ", ".join(filter(None, (own.bearing.name, f"carries {own.carries}")))
            title = f"Row {number + 1}, {own.carries}" if is_flat else f"Row {number + 1} ({name})\n{axes.get_title()}"
            axes.set_title(title, fontsize=10, pad=18 if k == 0 and not is_flat else 6)
            drawn.append(axes)
    legend(figure, *reversed(drawn))
    write_title_of_set(figure, solution, place)
    return figure
