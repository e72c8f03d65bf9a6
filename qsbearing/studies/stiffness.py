"""The stiffness of a bearing at every point of a study, as rotor dynamics takes it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.file_errors import FileErrorDetail, SceneFileError
from qsbearing.studies.chooser.choose import solve
from qsbearing.studies.chunk import STATUSES
from qsbearing.studies.points import Points
from qsbearing.studies.scenes import check, scene_of_points
from qsbearing.studies.study import Study
from qsbearing.systems.rotor_dynamics import stiffness_columns
from qsbearing.systems.sets.bearing_set import BearingSet

IMPOSSIBLE = STATUSES[-1]


def stiffness_of(study: Study, *, mirrored: bool = False) -> dict[str, NDArray]:
    """The varied keys and the columns of `rotordynamics.stiffness_columns`, one row per point.

    A point that describes no bearing has its row, with status "impossible" and why; one without equilibrium likewise.

    Raises:
        SceneError: the study is wrong whatever the point; every error, at once.
    """
    if isinstance(check(study), BearingSet):
        cause = "qs.solve_set(...).stiffness and qs.to_ross take sets"
        raise SceneFileError(
            study.file, [FileErrorDetail("[[rows]]", "makes a set; here a single bearing is read", cause=cause)]
        )
    points = Points(study)
    parts = [_of_chunk(study, points, number, mirrored) for number in range(points.chunk_count)]
    names = max(parts, key=len)
    return {
        name: np.concatenate([part.get(name, np.full(len(part["status"]), np.nan)) for part in parts]) for name in names
    }


def _of_chunk(study: Study, points: Points, number: int, mirrored: bool) -> dict[str, NDArray]:
    values = points.values(points.chunk(number))
    count = points.size(number)
    scene, possible, reason, reasons = scene_of_points(study, values, count)
    out = {key: np.broadcast_to(value, count) for key, value in values.items()}
    why = np.array(["", *reasons])[reason]
    if scene is None or isinstance(scene, BearingSet):
        return out | {"status": np.full(count, IMPOSSIBLE), "reason": why}
    for name, column in stiffness_columns(solve(scene), mirrored=mirrored).items():
        others = {"status": np.full(count, IMPOSSIBLE, object), "reason": why.astype(object)}
        whole = others.get(name, np.full(count, np.nan))
        whole[possible] = column
        out[name] = whole
    return out
