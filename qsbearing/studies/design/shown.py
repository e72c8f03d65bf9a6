"""What a search found, as tables, as plain data and as a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.documents.numbers import duration, plain
from qsbearing.files.scene_tables import input_tables
from qsbearing.model.solution.result_keys import SIZE, printed_unit
from qsbearing.model.version import __version__
from qsbearing.remarks.remark import Remark
from qsbearing.results.remarks import blocks, every_remark, remarks_record
from qsbearing.studies.chooser.choose_set import solve_any
from qsbearing.studies.design.find import Found
from qsbearing.studies.design.problem import Variable

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from qsbearing.documents.model import Block

GRID = 81
"""Points along each axis of the picture."""


def heading(outcome: Found) -> str:
    """How the search ended, in a sentence."""
    if outcome.is_feasible and outcome.feasible_share == 0.0:
        return _at_one_point(outcome)
    share = f"{plain(100.0 * outcome.feasible_share, '.3g')} % of the sampled points meet all goals and limits"
    goals = " (goals within 1 %)" if any(each.sense == "=" for each in outcome.problem.conditions) else ""
    if not outcome.is_feasible:
        nearest = "The nearest point is shown: its largest violation, relative to the limit, is the smallest"
        return f"No point is feasible. {nearest}."
    if outcome.problem.objective:
        kind = "Largest" if outcome.problem.is_maximised else "Smallest"
        return f"{kind} {outcome.problem.objective} found. {share}{goals}."
    return f"All goals and limits are met. {share}{goals}."


def _at_one_point(outcome: Found) -> str:
    """Where no sampled point meets them, but one between."""
    count = len(outcome.problem.conditions)
    goals = all(each.sense == "=" for each in outcome.problem.conditions)
    what, one = ("goal" if goals else "limit" if not _has_goals(outcome) else "goals and limits"), count == 1
    are = f"The {what} is" if one else f"All {what if what.endswith('s') else what + 's'} are"
    best = f", where {outcome.problem.objective} is {'largest' if outcome.problem.is_maximised else 'smallest'}"
    return f"{are} met at one point, between those sampled{best * bool(outcome.problem.objective)}."


def sizes(outcome: Found) -> list[str]:
    """What counts of results whose sign is a direction."""
    return [
        f"{each.name}: the size of {each._replace(over='').name}, of the ball where it is largest"
        for each in dict.fromkeys(outcome.places)
        if each.over == SIZE
    ]


def found_remarks(outcome: Found) -> list[Remark]:
    """On the scene or set with the values found, those of its readings among them: as `run` gives them."""
    return every_remark(solve_any(outcome.scene))


def tables(outcome: Found) -> list[Block]:
    """For the terminal."""
    from qsbearing.documents.model import Paragraph, Table

    variables, results = [], []
    for key, value in outcome.values.items():
        ends = outcome.ranges.get(key)
        shown = ("", "") if ends is None else (f"{ends[0]:.5g}", f"{ends[1]:.5g}")
        variables.append((key, f"{value:.6g}", *shown, printed_unit(outcome.units[key])))
    for name, value in outcome.results.items():
        requested = [f"{each.sense} {each.value:g}" for each in outcome.problem.conditions if each.name == name]
        if name == outcome.problem.objective:
            requested.append("largest" if outcome.problem.is_maximised else "smallest")
        results.append((name, f"{value:.6g}", ", ".join(requested), printed_unit(outcome.units[name])))
    lines = []
    if outcome.ranges:
        within = outcome.problem.objective or ("each goal" if _has_goals(outcome) else "")
        change = f" and {within} stays within 1 %" if within else ""
        lines.append(f"From, to: how far one variable may move, the others fixed, while all limits hold{change}.")
    lines += [f"{each}." for each in sizes(outcome)]
    lines += [f"Binding: {each}" for each in outcome.binding]
    lines += [f"Not met: {each}" for each in outcome.failed]
    more = outcome.evaluations - outcome.sampled
    lines.append(
        f"{outcome.sampled:,} points over all ranges and {more:,} near the best ones, {duration(outcome.seconds)}"
    )
    return [
        Paragraph(heading(outcome)),
        Table(("key", "found", "from", "to", "unit"), variables, "lrrrl", "Variables"),
        Table(("result", "found", "asked for", "unit"), results, "lrll", "Results"),
        *(Paragraph(each, is_apart=number == 0) for number, each in enumerate(lines)),
        *blocks(found_remarks(outcome), is_apart=True),
    ]


def record(outcome: Found) -> dict[str, Any]:
    """What `find --json` prints: "input" is the scene found, which every command reads."""
    return {
        "version": __version__,
        "input": input_tables(outcome.scene),
        "status": "feasible" if outcome.is_feasible else "infeasible",
        "message": heading(outcome),
        "values": outcome.values,
        "results": outcome.results,
        "units": outcome.units,
        "sizes": sizes(outcome),
        "binding": list(outcome.binding),
        "failed": list(outcome.failed),
        **remarks_record(found_remarks(outcome)),
        "ranges": {key: list(ends) for key, ends in outcome.ranges.items()},
        "feasible_share": outcome.feasible_share,
        "sampled": outcome.sampled,
        "evaluations": outcome.evaluations,
        "seconds": outcome.seconds,
    }


def picture(outcome: Found) -> Figure:
    """The feasible region over the first two variables that have a range, or over one; the others as found."""
    from qsbearing.pictures.feasible_region import Along, Bounded, draw_region

    ranged = [each for each in outcome.problem.variables if not each.values]
    over = ranged[:2] or [outcome.problem.variables[0]]
    places = {each.key: _spread(each) for each in over}
    if len(over) == 1:  # the curve meets the star
        places = {key: np.union1d(values, [outcome.values[key]]) for key, values in places.items()}
    axes = [
        Along(each.key, outcome.units[each.key], places[each.key], outcome.values[each.key], each.is_log)
        for each in over
    ]
    grid = dict(zip((each.key for each in over), np.meshgrid(*(each.values for each in axes)), strict=True))
    results = outcome.evaluate({key: np.asarray(value) for key, value in outcome.values.items()} | grid)
    shown = [
        Bounded(
            name, outcome.units[name], values,
            [(each.sense, each.value) for each in outcome.problem.conditions if each.name == name],
        )
        for name, values in results.items()
    ]  # fmt: skip
    held = [f"{key} = {value:.5g}" for key, value in outcome.values.items() if key not in grid]
    best = "optimum" if outcome.problem.objective else "point found"
    name = best if outcome.is_feasible else "nearest point"
    return draw_region(
        axes[0], axes[1] if len(axes) > 1 else None, shown, outcome.problem.objective, ", ".join(held), name
    )


def _spread(variable: Variable) -> Any:
    return np.asarray(variable.values) if variable.values else variable.at(np.linspace(0.0, 1.0, GRID))


def _has_goals(outcome: Found) -> bool:
    return any(each.sense == "=" for each in outcome.problem.conditions)
