"""Keys and units of the results, and all of a solution as the columns of a table: one row per ball of every case."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.scene.keys import (
    BEARING,
    EFFECT_TABLES,
    EFFECTS,
    MATERIAL,
    MATERIALS,
    OPERATION,
    PRELOAD,
    SEAT_MATERIALS,
)
from qsbearing.scene.operation import CHANNELS
from qsbearing.scene.scene import Scene
from qsbearing.units import MPa, Nmm, deg, mm, mrad, rpm, um

if TYPE_CHECKING:
    from qsbearing.solution import Solution

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
    ("ball_diameter_deviation_um", "ball_diameter_deviation", um),
    ("groove_give_um", "groove_give", um),
)
"""Keys, names of the arrays of a solution, and the size of each key's unit in SI."""

GEOMETRY = (
    ("ball_diameter_mm", "ball_diameter", mm),
    ("pitch_diameter_mm", "pitch_diameter", mm),
    ("inner_groove_radius_mm", "inner_groove_radius", mm),
    ("outer_groove_radius_mm", "outer_groove_radius", mm),
    ("free_contact_angle_deg", "free_contact_angle", deg),
    ("diametral_clearance_um", "diametral_clearance", um),
)
"""Of the bearing that ring effects have changed."""
RING_STATE = (
    ("groove_growth_um", "groove_growth", um),
    ("seat_pressure_MPa", "seat_pressure", MPa),
    ("seat_gap_um", "seat_gap", um),
    ("bore_hoop_stress_MPa", "bore_hoop_stress", MPa),
    ("equivalent_stress_MPa", "equivalent_stress", MPa),
)
"""Keys, names of a `RingState`, and the size of each key's unit in SI."""
RING_SHAPE = (
    ("growth_um", "growth", um),
    ("bending_um", "bending", um),
    ("seat_pressure_MPa", "seat_pressure", MPa),
    ("least_seat_pressure_MPa", "least_seat_pressure", MPa),
    ("largest_seat_pressure_MPa", "largest_seat_pressure", MPa),
)
"""Likewise, of a `RingShape`."""


def columns(solution: Solution) -> dict[str, NDArray]:
    """Everything that there is to say about each ball; arrays of shape (row,), units in their names.

    The case's results, its status and the scene's numbers, under the keys of a scene file, follow on each of its rows.
    Cases not solved have their rows, with NaN for results. What the scene does not call for has no column.
    """
    exists = np.isfinite(solution.azimuth)
    rows = np.nonzero(exists)

    def per_case(values: Any) -> NDArray:
        return np.broadcast_to(np.asarray(values)[..., None], exists.shape)[exists]

    out: dict[str, NDArray] = {f"case_{axis}": number for axis, number in enumerate(rows[:-1])}
    out |= {"ball": rows[-1], "azimuth_deg": solution.azimuth[exists] / deg}
    for side in ("inner", "outer"):
        for key, name, size in CONTACT:
            values = getattr(getattr(solution, side), name)
            if values is not None:
                out[f"{side}_{key}"] = values[exists] / size
    for key, name, size in BALL:
        values = getattr(solution, name)
        if values is not None:
            out[key] = values[exists] / size
    if solution.raceway_control is not None:
        out["raceway_control"] = solution.raceway_control[exists]
    if solution.slips is not None:
        out["slips"] = solution.slips[exists]
    for kind, keys, values in (
        ("displacement", DISPLACEMENT, solution.displacement),
        ("load", LOAD, solution.load),
        ("locked_stiffness", STIFFNESS, solution.locked_stiffness),
        ("effective_stiffness", STIFFNESS, solution.effective_stiffness),
    ):
        out |= {f"ring_{kind}_{key}": per_case(values[..., i] / size) for i, (key, size) in enumerate(keys)}
    names = [channel.label.replace(" ", "_") for channel in CHANNELS]
    for row, column in np.ndindex(5, 5):
        values = solution.stiffness[..., row, column]
        out[f"ring_stiffness_SI_{names[row]}_by_{names[column]}"] = per_case(values)
    if solution.preload_at_rest is not None:
        for state in ("at_rest", "unmounted", "mounted"):
            out[f"preload_{state}_N"] = per_case(getattr(solution, f"preload_{state}"))
    for name, values in (_expansion(solution) | _shapes(solution)).items():
        out[name] = per_case(np.broadcast_to(values, solution.shape))
    out |= {"status": per_case(solution.status), "reason": per_case(solution.reason)}
    return out | {key: per_case(values) for key, values in scene_numbers(solution.scene).items()}


def _expansion(solution: Solution) -> dict[str, Any]:
    """The operating geometry and the state of the rings; nothing without ring effects."""
    if not solution.scene.is_reshaped:
        return {}
    bearing = solution.scene.operating_bearing
    out = {f"operating_{key}": np.asarray(getattr(bearing, name)) / size for key, name, size in GEOMETRY}
    for side in ("inner", "outer"):
        state = getattr(solution, f"{side}_ring")
        for key, name, size in RING_STATE:
            if state is not None and getattr(state, name) is not None:
                out[f"{side}_ring_{key}"] = getattr(state, name) / size
    return out


def _shapes(solution: Solution) -> dict[str, Any]:
    """How elastic rings have given way."""
    shapes = {side: getattr(solution, f"{side}_shape") for side in ("inner", "outer")}
    return {
        f"{side}_elastic_{key}": getattr(shape, name) / size
        for side, shape in shapes.items()
        for key, name, size in RING_SHAPE
        if shape is not None and getattr(shape, name) is not None
    }


def scene_numbers(scene: Scene) -> dict[str, Any]:
    """The scene's numbers, in the units of a scene file and under its keys."""
    holders: list[tuple[str, Any, Any]] = [("", BEARING, scene.bearing), ("", OPERATION, scene.operation)]
    if scene.preload is not None:
        holders.append(("preload_", PRELOAD, scene.preload))
    holders += [(f"{side}_", MATERIAL, getattr(scene.bearing, side)) for side in MATERIALS]
    for effect in scene.ring_effects:
        if effect is scene.ball_diameter_deviations:
            continue  # by ball: a column of its own
        holders.append((f"{effect.name}_", EFFECT_TABLES[effect.name], effect))
        seats = [(side, getattr(effect, side, None)) for side in SEAT_MATERIALS]
        holders += [(f"{side}_", MATERIAL, material) for side, material in seats if material is not None]
    if scene.gyroscopic_moment is not None:
        holders.append(("", EFFECTS, scene.gyroscopic_moment))
    out: dict[str, Any] = {"bearing": scene.bearing.name}
    for prefix, keys, holder in holders:
        for key in keys:
            values = getattr(holder, key.field)
            if values is not None:
                out[prefix + key.name.replace(".", "_")] = np.vectorize(key.in_file, otypes=[float])(
                    np.asarray(values, float)
                )
    return out
