"""Under which keys and in which units each reading's numbers are shown, and they as the columns of a table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import reduce
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.solution.solution import Solution
from qsbearing.units import MPa, Nmm, deg, mm, rpm, um

MILLION = 1e6
HOUR = 3600.0


class Shown(NamedTuple):
    """One number of a reading."""

    key: str
    """Unit included."""
    path: str
    """Of the attribute; of one raceway's for contacts."""
    size: float = 1.0
    """One of the key's unit in SI."""


def _plain(*names: str) -> tuple[Shown, ...]:
    return tuple(Shown(name, name) for name in names)


CASE: dict[str, tuple[Shown, ...]] = {
    "life": (
        Shown("dynamic_load_rating_N", "dynamic_load_rating"),
        Shown("basic_reference_rating_life_Mrev", "basic_reference_rating_life", MILLION),
        Shown("basic_duration_h", "basic_duration", HOUR),
        Shown("inner_life_Mrev", "inner_life", MILLION),
        Shown("outer_life_Mrev", "outer_life", MILLION),
        Shown("reference_load_N", "reference_load"),
        Shown("reliability_factor", "reliability_factor"),
        Shown("life_modification_factor", "life_modification_factor"),
        Shown("fatigue_load_limit_N", "fatigue_load_limit"),
        Shown("modified_reference_rating_life_Mrev", "modified_reference_rating_life", MILLION),
        Shown("duration_h", "duration", HOUR),
        Shown("equivalent_load_N", "equivalent_load"),
        Shown("basic_rating_life_Mrev", "basic_rating_life", MILLION),
    ),
    "spectrum": (
        Shown("life_Mrev", "life", MILLION),
        Shown("duration_h", "duration", HOUR),
        *_plain("damage_share"),
    ),
    "static_safety": (
        Shown("static_load_rating_N", "static_load_rating"),
        Shown("static_equivalent_load_N", "static_equivalent_load"),
        *_plain("static_safety", "contact_safety"),
    ),
    "frequencies": tuple(
        Shown(f"{prefix}{name}_Hz", f"{of}.{name}")
        for of, prefix in (("solved", ""), ("nominal", "nominal_"))
        for name in ("cage", "ball_pass_inner", "ball_pass_outer", "ball_spin")
    )
    + _plain("orbit_spread"),
    "film": (*_plain("inlet_shear_heating"), Shown("combined_roughness_um", "combined_roughness", um)),
    "friction": (Shown("power_W", "power"), Shown("torque_Nmm", "torque", Nmm)),
    "friction_estimate": (
        Shown("speed_factor_mm_rpm", "speed_factor", mm * rpm),
        *_plain("speed_over_rating"),
        Shown("skf_torque_Nmm", "skf.torque", Nmm),
        Shown("skf_power_W", "skf.power"),
        Shown("palmgren_torque_Nmm", "palmgren.torque", Nmm),
        Shown("palmgren_power_W", "palmgren.power"),
    ),
    "overrun": (
        Shown("inner_edge_angle_deg", "inner.edge_angle", deg),
        Shown("outer_edge_angle_deg", "outer.edge_angle", deg),
    ),
}
"""Of the whole bearing; arrays of shape (*cases)."""

CONTACT: dict[str, tuple[Shown, ...]] = {
    "kinematics": (
        Shown("entrainment_speed_m_s", "entrainment_speed"),
        Shown("rolling_speed_rpm", "rolling_speed", rpm),
        Shown("spin_speed_rpm", "spin_speed", rpm),
        Shown("spin_to_roll", "spin_to_roll"),
        Shown("spin_sliding_speed_m_s", "spin_sliding_speed"),
        Shown("spin_pressure_speed_MPa_m_s", "spin_pressure_speed", MPa),
    ),
    "film": (
        Shown("central_thickness_um", "central_thickness", um),
        Shown("minimum_thickness_um", "minimum_thickness", um),
        Shown("reduced_minimum_thickness_um", "reduced_minimum_thickness", um),
        Shown("film_parameter", "film_parameter"),
        Shown("thermal_reduction", "thermal_reduction"),
    ),
    "friction": (
        Shown("sliding_power_W", "sliding_power"),
        Shown("spin_moment_Nmm", "spin_moment", Nmm),
        Shown("hysteresis_power_W", "hysteresis_power"),
    ),
    "pivot_points": (Shown("near_pivot_mm", "near", mm), Shown("far_pivot_mm", "far", mm)),
    "overrun": (Shown("edge_distance_mm", "edge_distance", mm), Shown("overrun_load_N", "overrun_load")),
    "stress": (
        Shown("max_shear_MPa", "max_shear", MPa),
        Shown("max_shear_depth_mm", "max_shear_depth", mm),
        Shown("orthogonal_shear_MPa", "orthogonal_shear", MPa),
        Shown("orthogonal_shear_depth_mm", "orthogonal_shear_depth", mm),
        Shown("dent_um", "dent", um),
    ),
}
"""Of each contact, inner and outer; arrays of shape (*cases, ball)."""

BALL: dict[str, tuple[Shown, ...]] = {"friction": (Shown("drag_power_W", "drag_power"),)}
"""Of each ball; arrays of shape (*cases, ball)."""


def value(holder: Any, shown: Shown) -> Any:
    """A number of a reading in its key's unit; None where it was not asked for."""
    found = reduce(lambda part, name: None if part is None else getattr(part, name), shown.path.split("."), holder)
    return None if found is None else np.asarray(found, float) / shown.size


def case_values(name: str, reading: Any) -> Iterator[tuple[str, NDArray | None]]:
    """(key, array over the cases or None) of a reading."""
    for shown in CASE.get(name, ()):
        yield shown.key, value(reading, shown)


def ball_values(name: str, reading: Any) -> Iterator[tuple[str, str, NDArray | None]]:
    """(inner, outer or empty; key; array over cases and balls or None) of a reading."""
    for side in ("inner", "outer"):
        for shown in CONTACT.get(name, ()):
            yield side, shown.key, value(getattr(reading, side), shown)
    for shown in BALL.get(name, ()):
        yield "", shown.key, value(reading, shown)


def reading_columns(solution: Solution, readings: Mapping[str, Any]) -> dict[str, NDArray]:
    """Readings as columns beside those of `Solution.to_dataframe`: one row per ball of every case, units in the names.

    Args:
        readings: results by the name of their reading, as `take_asked` gives them.
    """
    exists = np.isfinite(solution.azimuth)
    out: dict[str, NDArray] = {}
    for name, reading in readings.items():
        for key, values in case_values(name, reading):
            if values is not None:
                spread = np.broadcast_to(values, solution.shape)[..., None]
                out[f"{name}_{key}"] = np.broadcast_to(spread, exists.shape)[exists]
        for side, key, values in ball_values(name, reading):
            if values is not None:
                out["_".join(filter(None, (side, name, key)))] = np.broadcast_to(values, exists.shape)[exists]
    return out
