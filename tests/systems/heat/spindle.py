"""A spindle bearing whose preload its own heat raises: the scene of these tests, as tables of a file."""

from __future__ import annotations

import copy
from typing import Any

import qsbearing as qs
from qsbearing.files.scene_file import scene_of
from qsbearing.files.set_file import set_of

BEARING: dict[str, Any] = {
    "ball_count": 16, "ball_diameter_mm": 7.14, "pitch_diameter_mm": 46.5, "bore_diameter_mm": 35,
    "outside_diameter_mm": 62, "groove_radius_coefficient": 0.535, "free_contact_angle_deg": 24,
    "ball_material": "steel", "ring_material": "steel",
}  # fmt: skip
EFFECTS: dict[str, Any] = {
    "ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "outer", "ring_expansion": {},
    "ball_expansion": {},
}  # fmt: skip
BETWEEN = {("inner_ring", "balls"): 2.0, ("outer_ring", "balls"): 2.5, ("outer_ring", "ambient"): 3.0}
AMBIENT = 27.0


def paths(conductances: dict[tuple[str, str], float]) -> list[dict[str, Any]]:
    return [{"between": list(between), "W_per_K": value} for between, value in conductances.items()]


def tables(**changed: Any) -> dict[str, Any]:
    """With these tables in place of its own; None takes one away."""
    own = {
        "bearing": BEARING,
        "operation": {"speed_rpm": 8000},
        "preload": {"rigid_N": 400},
        "effects": EFFECTS,
        "readings": {"friction": {"friction_coefficient": 0.06}},
        "thermal": {
            "limit_temperature_C": 200.0,
            "fixed": {"ambient_C": AMBIENT},
            "conductances": paths(BETWEEN),
        },
    }
    return copy.deepcopy({name: value for name, value in (own | changed).items() if value is not None})


def scene(**changed: Any) -> qs.Scene:
    return scene_of(tables(**changed), "file")


def pair(**changed: Any) -> qs.BearingSet:
    """Two of them back to back on a warm shaft, SKF's friction at the outer rings' temperature."""
    between = {("inner_ring", "shaft"): 5.0, ("outer_ring", "housing"): 8.0, ("housing", "ambient"): 6.0}
    own = tables() | {
        "rows": [{"position_mm": 0.0, "carries": "+x"}, {"position_mm": 50.0, "carries": "-x"}],
        "effects": EFFECTS | {"ring_expansion": {"shaft_interference_um": 1.0}},
        "operation": {"speed_rpm": 5000, "radial_load_y_N": 100, "axial_load_N": 60, "moment_z_Nm": 0},
        "preload": {"rigid_N": 60},
        "readings": {"lubricant": {"iso_viscosity_grade": 32}, "friction_estimate": {}},
        "thermal": {
            "friction": "skf",
            "viscosity_at": "outer_ring",
            "fixed": {"ambient_C": AMBIENT},
            "heats": {"shaft_W": 5.0},
            "conductances": paths(BETWEEN | between | {("shaft", "ambient"): 1.0}),
        },
    }
    return set_of(copy.deepcopy(own | changed), "file")
