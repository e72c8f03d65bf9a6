"""All of a solution as the columns of a table: one row per ball of every case."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.result_keys import BALL, CONTACT, DISPLACEMENT, GEOMETRY, LOAD, RING_STATE, STIFFNESS, Shown
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
from qsbearing.units import deg

if TYPE_CHECKING:
    from qsbearing.solution.solution import Solution


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
        for shown in CONTACT:
            values = shown.of(getattr(solution, side))
            if values is not None:
                out[f"{side}_{shown.key}"] = values[exists]
    for shown in BALL:
        values = shown.of(solution)
        if values is not None:
            out[shown.key] = values[exists]
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
    for name, values in _expansion(solution).items():
        out[name] = per_case(np.broadcast_to(values, solution.shape))
    out |= {"status": per_case(solution.status), "reason": per_case(solution.reason)}
    return out | {key: per_case(values) for key, values in scene_numbers(solution.scene).items()}


def _expansion(solution: Solution) -> dict[str, Any]:
    """The operating geometry and the state of the rings; nothing without ring effects."""
    if not solution.scene.is_reshaped:
        return {}
    holders: list[tuple[str, tuple[Shown, ...], Any]] = [("operating_", GEOMETRY, solution.scene.operating_bearing)]
    holders += [(f"{side}_ring_", RING_STATE, getattr(solution, f"{side}_ring")) for side in ("inner", "outer")]
    found = {f"{prefix}{shown.key}": shown.of(holder) for prefix, table, holder in holders for shown in table}
    return {name: values for name, values in found.items() if values is not None}


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
                out[prefix + key.name] = np.vectorize(key.in_file, otypes=[float])(np.asarray(values, float))
    return out
