"""A solved case as plain data in the field's units: the object that `run --json` prints, and the rows of `--csv`."""

from __future__ import annotations

import csv
import math
from typing import TYPE_CHECKING, Any, TextIO

import numpy as np

from qsbearing import __version__, outcome
from qsbearing.solution import stiffness
from qsbearing.units import MPa, Nmm, deg, mm, mrad, rpm, um

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from qsbearing.scene import Scene
    from qsbearing.solution import RacewayContacts, Solution

DISPLACEMENT = (
    ("axial_um", um),
    ("radial_y_um", um),
    ("radial_z_um", um),
    ("tilt_y_mrad", mrad),
    ("tilt_z_mrad", mrad),
)
LOAD = (("axial_N", 1.0), ("radial_y_N", 1.0), ("radial_z_N", 1.0), ("moment_y_Nm", 1.0), ("moment_z_Nm", 1.0))
STIFFNESS = (
    ("axial_N_per_um", 1.0 / um),
    ("radial_y_N_per_um", 1.0 / um),
    ("radial_z_N_per_um", 1.0 / um),
    ("tilt_y_Nm_per_mrad", 1.0 / mrad),
    ("tilt_z_Nm_per_mrad", 1.0 / mrad),
)
"""Keys of the five channels, and the size of each key's unit in SI."""

CONTACT = (
    ("load_N", "load", 1.0),
    ("angle_deg", "angle", deg),
    ("approach_um", "approach", um),
    ("semi_major_axis_mm", "semi_major_axis", mm),
    ("semi_minor_axis_mm", "semi_minor_axis", mm),
    ("max_pressure_MPa", "max_pressure", MPa),
    ("required_friction", "required_friction", 1.0),
)
BALL = (
    ("centrifugal_force_N", "centrifugal_force", 1.0),
    ("gyroscopic_moment_Nmm", "gyroscopic_moment", Nmm),
    ("orbital_speed_rpm", "orbital_speed", rpm),
    ("rotation_speed_rpm", "rotation_speed", rpm),
)
"""Keys, names of the arrays of a solution, and the size of each key's unit in SI."""

Index = int | tuple[int, ...]


def record(solution: Solution, index: Index = ()) -> dict[str, Any]:
    """One case as the object that `run --json` prints.

    Args:
        index: the case, along the solution's case axes; nothing for a single case.

    Returns:
        None stands for a number that there is not: not called for by the scene, not solved, or not defined.
    """
    scene = solution.scene
    solved = bool(np.asarray(solution.converged)[index])
    return {
        "version": __version__,
        "status": str(np.asarray(solution.status)[index]),
        "message": outcome.message(solution, index),
        "residual": number(np.asarray(solution.residual)[index]),
        "iterations": int(np.asarray(solution.iterations)[index]),
        "seconds": solution.seconds,
        "bearing": scene.bearing.name,
        "effects": [effect.name for effect in scene.ball_effects],
        "choices": choices(scene),
        "warnings": outcome.warnings(solution, index),
        "displacement": _channels(DISPLACEMENT, solution.displacement[index]),
        "load": _channels(LOAD, solution.load[index]),
        "stiffness_SI": stiffness(scene, solution)[index].tolist() if solved else None,
        "balls": balls(solution, index) if solved else [],
    }


def choices(scene: Scene) -> dict[str, str | None]:
    """What the scene takes for granted, in the words of its file; None where nothing asks."""
    gyroscopic = scene.gyroscopic_moment
    return {
        "raceway_control": None if scene.raceway_control is None else str(scene.raceway_control),
        "moment_shares": None if gyroscopic is None else str(gyroscopic.moment_shares),
        "hertz_angle": str(scene.hertz_angle),
        "hertz_form": str(scene.hertz_form),
        "tilt_lever": str(scene.tilt_lever),
    }


def balls(solution: Solution, index: Index = ()) -> list[dict[str, Any]]:
    """What there is to say about each ball of one case, under the keys of `run --json`."""
    azimuth = solution.azimuth[index]
    sides = {"inner": _contacts(solution.inner, index), "outer": _contacts(solution.outer, index)}
    own = {key: _scaled(getattr(solution, name), index, size) for key, name, size in BALL}
    control = None if solution.raceway_control is None else solution.raceway_control[index]
    return [
        {
            "azimuth_deg": number(azimuth[ball] / deg),
            **{side: {key: _at(array, ball) for key, array in arrays.items()} for side, arrays in sides.items()},
            **{key: _at(array, ball) for key, array in own.items()},
            "raceway_control": None if control is None else str(control[ball]),
        }
        for ball in map(int, np.flatnonzero(np.isfinite(azimuth)))
    ]


def write_csv(solution: Solution, file: TextIO) -> None:
    """One row a ball, units in the headings; the ring's values follow on every row, so that files can be stacked.

    A column that the scene does not call for is left out; a cell without a number is empty.
    """
    found = record(solution)
    ring: dict[str, Any] = {}
    for key, value in found["displacement"].items():
        ring[f"ring_displacement_{key}"] = value
    for key, value in found["load"].items():
        ring[f"ring_load_{key}"] = value
    for i, (key, size) in enumerate(STIFFNESS):
        ring[f"ring_stiffness_{key}"] = found["stiffness_SI"][i][i] / size
    rows = []
    for position, ball in enumerate(found["balls"]):
        row = {"ball": position, "azimuth_deg": ball["azimuth_deg"]}
        for side in ("inner", "outer"):
            row |= {f"{side}_{key}": value for key, value in ball[side].items()}
        row |= {key: ball[key] for key, _, _ in BALL}
        rows.append(row | {"raceway_control": ball["raceway_control"]} | ring)
    uncalled = _uncalled(solution)
    heading = [name for name in rows[0] if name not in uncalled]
    writer = csv.DictWriter(file, heading, extrasaction="ignore", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)


def _uncalled(solution: Solution) -> set[str]:
    names = {key for key, name, _ in BALL if getattr(solution, name) is None}
    if solution.raceway_control is None:
        names.add("raceway_control")
    if solution.inner.required_friction is None:
        names |= {"inner_required_friction", "outer_required_friction"}
    return names


def number(value: Any) -> float | None:
    """The value as a float; None for NaN and infinity, which JSON has not."""
    return float(value) if math.isfinite(value) else None


def _channels(units: tuple[tuple[str, float], ...], values: NDArray) -> dict[str, float | None]:
    return {key: number(value / size) for (key, size), value in zip(units, values, strict=True)}


def _contacts(contacts: RacewayContacts, index: Index) -> dict[str, NDArray | None]:
    return {key: _scaled(getattr(contacts, name), index, size) for key, name, size in CONTACT}


def _scaled(array: NDArray | None, index: Index, size: float) -> NDArray | None:
    return None if array is None else array[index] / size


def _at(array: NDArray | None, ball: int) -> float | None:
    return None if array is None else number(array[ball])
