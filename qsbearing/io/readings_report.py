"""Readings of a single case as tables for people."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from qsbearing.io.tables import plain_table, warning_lines
from qsbearing.readings.film_thickness import FACTOR_SPREAD
from qsbearing.readings.shown import ball_values, case_values

UNITS = {
    "Mrev": "million rev", "mm_rpm": "mm rpm", "m_s": "m/s", "MPa_m_s": "MPa m/s", "N": "N", "h": "h", "Hz": "Hz",
    "rpm": "rpm", "um": "um", "mm": "mm", "MPa": "MPa", "W": "W", "Nmm": "Nmm", "deg": "deg",
}  # fmt: skip


PLAIN_NAMES = {
    "reference_load_N": "reference load, C/(basic reference life)^(1/3)",
    "basic_duration_h": "basic reference rating life in hours",
    "reliability_factor": "reliability factor a1",
    "life_modification_factor": "life modification factor aISO",
    "duration_h": "reference life in hours, with a1 and aISO where given",
    "equivalent_load_N": "equivalent load P of ISO 281",
    "basic_rating_life_Mrev": "basic rating life of ISO 281",
    "static_equivalent_load_N": "static equivalent load P0 of ISO 76",
    "static_safety": "static safety C0/P0",
    "contact_safety": "static limit over load, most pressed contact",
    "orbit_spread": "range of the balls' orbital speeds over their mean",
    "nominal_cage_Hz": "cage, at the nominal contact angle",
    "nominal_ball_pass_inner_Hz": "ball pass inner, at the nominal contact angle",
    "nominal_ball_pass_outer_Hz": "ball pass outer, at the nominal contact angle",
    "nominal_ball_spin_Hz": "ball spin, at the nominal contact angle",
    "speed_factor_mm_rpm": "speed factor n dm",
    "skf_torque_Nmm": "torque by SKF",
    "skf_power_W": "power by SKF",
    "palmgren_torque_Nmm": "torque by Palmgren",
    "palmgren_power_W": "power by Palmgren",
    "power_W": "power, of the contacts only",
    "torque_Nmm": "torque, of the contacts only",
    "near_pivot_mm": "pivot point nearer to the centre",
    "far_pivot_mm": "other pivot point",
    "edge_distance_mm": "distance of ellipse from groove edge",
    "overrun_load_N": "load at which it reaches the edge",
    "max_shear_MPa": "largest shear stress",
    "max_shear_depth_mm": "its depth",
    "orthogonal_shear_MPa": "orthogonal shear stress, amplitude",
    "orthogonal_shear_depth_mm": "its depth",
    "dent_um": "permanent dent",
    "spin_pressure_speed_MPa_m_s": "p v of spin",
    "inlet_shear_heating": "inlet shear heating by SKF",
    "central_thickness_um": "central thickness, isothermal",
    "minimum_thickness_um": "minimum thickness, isothermal",
    "reduced_minimum_thickness_um": "the minimum reduced by inlet heating",
    "film_parameter": "film parameter, of the reduced minimum",
    "thermal_reduction": "film reduction by inlet heating",
}
"""Of keys whose own words do not state what they are."""

SCOPE = {
    "film": "Film: isothermal but for the reduced minimum, of which the film parameter is; published factors of the "
    f"reduction by inlet heating differ by some {100 * FACTOR_SPREAD:.0f} %.",
    "pivot_points": "Pivot points: where nothing slides, from the centre of the ellipse along its major axis.",
}
"""Of readings whose name does not state what they cover."""

NOISE = 1e-12
"""Below this part of the largest of its kind a number is rounding, and shown as zero."""


def readings_tables(readings: Mapping[str, Any]) -> list[RenderableType]:
    """Tables of each reading: numbers of the bearing; of the contacts' numbers the smallest and the largest."""
    parts: list[RenderableType] = []
    for name, reading in readings.items():
        title = name.replace("_", " ").capitalize()
        tables = [table for table in (_of_bearing(title, name, reading), _of_contacts(title, name, reading)) if table]
        parts += [Padding(table, (1, 0, 0, 0)) for table in tables]
        parts += [Text(SCOPE[name])] if name in SCOPE else []
        for model in getattr(reading, "models", ()):
            what = f"{model.name}: {model.contains}; without {model.lacks}."
            parts.append(Text(f"{what} Range: {model.range}. For heat: {model.heat}."))
        parts += warning_lines(getattr(reading, "warnings", ()))
    return parts


def _of_bearing(title: str, name: str, reading: Any) -> Table | None:
    found = [(key, values) for key, values in case_values(name, reading) if values is not None]
    if not found:
        return None
    table = plain_table(title, ("quantity", "value", "unit"), left=(0, 2))
    for key, values in found:
        words, unit = _words(key)
        table.add_row(words, _text(values), unit)
    return table


def _of_contacts(title: str, name: str, reading: Any) -> Table | None:
    cells: dict[str, dict[str, NDArray]] = {}
    for side, key, values in ball_values(name, reading):
        if values is not None and np.isfinite(values).any():
            cells.setdefault(key, {})[side or "ball"] = values
    if not cells:
        return None
    sides = [side for side in ("inner", "outer", "ball") if any(side in row for row in cells.values())]
    heading = [cell for side in sides for cell in (f"{side}\nsmallest", f"{side}\nlargest")]
    table = plain_table(title, ("quantity", *heading, "unit"), (0, 1 + len(heading)))
    for key, row in cells.items():
        words, unit = _words(key)
        largest = max(float(np.nanmax(np.abs(values))) for values in row.values())
        spans = [_span(row[side], NOISE * largest) if side in row else ("", "") for side in sides]
        table.add_row(words, *(cell for span in spans for cell in span), unit)
    return table


def _span(values: NDArray, noise: float) -> tuple[str, str]:
    """The smallest and the largest; one where they are the same to the digits shown."""
    values = np.where(np.abs(values) < noise, 0.0, values)
    if not np.isfinite(values).any():
        return "-", ""
    low, high = _text(np.nanmin(values)), _text(np.nanmax(values))
    return (low, "") if low == high else (low, high)


def _text(value: Any) -> str:
    return "-" if not np.isfinite(value) else f"{float(value) + 0.0:.5g}"


def _words(key: str) -> tuple[str, str]:
    """A key as words, and its unit."""
    words, unit = _split(key)
    return PLAIN_NAMES.get(key, words), unit


def _split(key: str) -> tuple[str, str]:
    for ending, unit in UNITS.items():
        if key.endswith(f"_{ending}"):
            if ending == "m_s" and key.endswith("_MPa_m_s"):
                continue
            return key.removesuffix(f"_{ending}").replace("_", " "), unit
    return key.replace("_", " "), ""
