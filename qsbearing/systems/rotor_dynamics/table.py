"""The stiffness of solved cases as a table of rotor dynamics: one row per case, SI, in the rotor's axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.columns import scene_numbers
from qsbearing.model.solution.groups import RING
from qsbearing.model.solution.result_keys import LOAD, Group, Place
from qsbearing.model.units import mm
from qsbearing.model.validation import check_kind
from qsbearing.systems.rotor_dynamics.axes import NAMES, in_rotor_axes, load_centres

if TYPE_CHECKING:
    import pandas

    from qsbearing.model.solution.solution import Solution

RING_LOAD = Group(LOAD, before=RING, prefix="load")
_ROTATIONS = NAMES[3:]


def stiffness_columns(solution: Solution, *, mirrored: bool = False) -> dict[str, NDArray]:
    """Speed, loads and stiffness of every case, of a set its shaft's; arrays of shape (case,), units in their names.

    Speed of the inner ring [rad/s]; kxx, kxy, ... of the 5 × 5 matrix, row by row [N/m, N/rad, N m/m, N m/rad]; the
    load centres [mm]. Of a case that is not solved, NaN.
    """
    stiffness = in_rotor_axes(solution.stiffness.reshape(-1, 5, 5), mirrored=mirrored)
    of = getattr(solution, "set", None) or solution.scene
    speed = np.broadcast_to(np.asarray(of.operation.speed, float), solution.shape)
    out: dict[str, NDArray] = {
        "speed_rad_s": np.ravel(speed),
        "status": np.ravel(np.asarray(solution.status, str)),
        "reason": np.ravel(np.asarray(solution.reason, str)),
    }
    load = solution.load.reshape(-1, 5)
    out |= {Place(RING_LOAD, each).column: np.asarray(each.of(load)) for each in LOAD}
    out |= _matrix(stiffness)
    centres = load_centres(stiffness) / mm
    return out | {f"load_centre_{axis}_mm": centres[:, number] for number, axis in enumerate(NAMES[:2])}


def matrix_columns(solution: Solution, *, mirrored: bool = False) -> dict[str, NDArray]:
    """Those of its matrix alone."""
    return _matrix(in_rotor_axes(solution.stiffness.reshape(-1, 5, 5), mirrored=mirrored))


def _matrix(stiffness: NDArray) -> dict[str, NDArray]:
    return {_name(NAMES[row], NAMES[column]): stiffness[:, row, column] for row, column in np.ndindex(5, 5)}


def _name(row: str, column: str) -> str:
    force = "Nm" if row in _ROTATIONS else "N"
    return f"k{row}{column}_{force}_per_{'rad' if column in _ROTATIONS else 'm'}"


def stiffness_table(solution: Solution, *, mirrored: bool = False) -> pandas.DataFrame:
    """The stiffness against speed and load as rotor dynamics takes it: one row per case; needs pandas.

    The scene's numbers that vary stand first, under the keys of a scene file; then `stiffness_columns`.

    Args:
        mirrored: the bearing is mounted the other way round: it carries a thrust on the shaft in -z.

    Returns:
        A row for each speed, its entries in SI.

    Examples:
        >>> scene = qs.load_scene("b218")
        >>> speeds = np.array([0.0, 5e3, 10e3]) * qs.rpm
        >>> operation = dataclasses.replace(scene.operation, speed=speeds)
        >>> table = qs.stiffness_table(qs.solve(dataclasses.replace(scene, operation=operation)))
        >>> print(table.shape[0])
        3
    """
    import pandas

    check_kind("stiffness_table", solution, "Solution")
    varied: dict[str, Any] = {
        key: np.ravel(np.broadcast_to(values, solution.shape))
        for key, values in scene_numbers(solution.scene).items()
        if np.size(values) > 1
    }
    return pandas.DataFrame(varied | stiffness_columns(solution, mirrored=mirrored))
