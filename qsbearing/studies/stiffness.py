"""The stiffness of a bearing or set at every point of a study, as rotor dynamics takes it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.result_keys import Group, Place, Result
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import ErrorDetail, SceneError
from qsbearing.results.readings_record import all_taken
from qsbearing.studies.chooser.choose import solve
from qsbearing.studies.chooser.choose_set import solve_set
from qsbearing.studies.chunk import STATUSES
from qsbearing.studies.points import Points
from qsbearing.studies.remarked import Look, look, looked_at, may_solve
from qsbearing.studies.scenes import check, scenes_of_points
from qsbearing.studies.study import Study
from qsbearing.systems.rotor_dynamics import stiffness_columns
from qsbearing.systems.rotor_dynamics.over_frequency import LoadFrequency, frequency_columns
from qsbearing.systems.rotor_dynamics.table import matrix_columns
from qsbearing.systems.sets.set_solution import SetSolution

IMPOSSIBLE = STATUSES[-1]


def stiffness_of(
    study: Study,
    *,
    mirrored: bool = False,
    frequencies: Sequence[LoadFrequency] = (),
    looks: list[Look] | None = None,
) -> dict[str, NDArray]:
    """The varied keys and the columns of `rotordynamics.stiffness_columns`, one row per point.

    Of a set the stiffness of its shaft about the reference position, then that of each row's contacts about the plane
    of its balls' centres, each after `row_1_`, ..., in the same axes. A point that describes no bearing has its row,
    with status "impossible" and why; so has one without equilibrium.

    Args:
        frequencies: of loads, at which stiffness is told too, after the other columns.
        looks: where to add what is seen of remarks; None: none are looked for.

    Raises:
        SceneError: the study is wrong whatever the point; every error, at once.
    """
    check(study)
    points = Points(study)
    parts = [_of_chunk(study, points, number, mirrored, frequencies, looks) for number in range(points.chunk_count)]
    names = max(parts, key=len)
    return {
        name: np.concatenate([part.get(name, np.full(len(part["status"]), np.nan)) for part in parts]) for name in names
    }


def _of_chunk(
    study: Study,
    points: Points,
    number: int,
    mirrored: bool,
    frequencies: Sequence[LoadFrequency],
    looks: list[Look] | None,
) -> dict[str, NDArray]:
    values = points.values(points.chunk(number))
    count = points.size(number)
    parts, _, reason, reasons = scenes_of_points(study, values, count, None if looks is None else looked_at(count))
    out = {key: np.broadcast_to(value, count) for key, value in values.items()}
    why = np.array(["", *reasons])[reason]
    labels = {"status": np.full(count, IMPOSSIBLE, object), "reason": why.astype(object)}
    for scene, numbers, is_looked_at in parts:
        solution = solve(scene) if isinstance(scene, Scene) else solve_set(scene)
        if looks is not None and is_looked_at:
            looks.append(look(solution, all_taken(solution), values, numbers, may_solve(points.count)))
        for name, column in _columns(solution, mirrored, frequencies).items():
            out.setdefault(name, labels.get(name, np.full(count, np.nan)))[numbers] = column
    return out if parts else out | labels


OF_ROW = Group(())
"""Of a row's matrix, whose columns are no results of a study."""


def _columns(
    solution: Solution | SetSolution, mirrored: bool, frequencies: Sequence[LoadFrequency]
) -> dict[str, NDArray]:
    if isinstance(solution, Solution):
        more = frequency_columns(solution, frequencies) if frequencies else {}
        return stiffness_columns(solution, mirrored=mirrored) | more
    if frequencies:
        raise SceneError([ErrorDetail("frequency", "is of one bearing: a set has no stiffness over frequency")])
    of_shaft: Any = solution
    columns = stiffness_columns(of_shaft, mirrored=mirrored)
    for number, (row, solved) in enumerate(zip(solution.set.rows, solution.rows, strict=True), 1):
        own = matrix_columns(solved, mirrored=mirrored != (row.sign < 0.0))
        columns |= {Place(OF_ROW, Result(name), number).name: column for name, column in own.items()}
    return columns
