"""A case of the reference, decimal strings and words, as a scene of the package."""

from __future__ import annotations

from typing import Any

import numpy as np

import qsbearing as qs

from .scenes import Case

CHANNELS = {
    "x": ("axial_load", "axial_displacement"),
    "y": ("radial_load_y", "radial_displacement_y"),
    "z": ("radial_load_z", "radial_displacement_z"),
    "tilt_y": ("moment_y", "tilt_y"),
    "tilt_z": ("moment_z", "tilt_z"),
}
"""The reference's channels, and the fields of an operation that load and hold them."""


def material(case: Case, key: str) -> dict[str, float]:
    """The fields of a material."""
    return {name: float(value) for name, value in case[key].items()}


def bearing_numbers(case: Case) -> dict[str, float]:
    """The numeric fields of a bearing (m, rad)."""
    keys = ("ball_count", "ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius")
    angle = {"free_contact_angle": float(case["free_contact_angle_deg"]) * qs.deg}
    return {key: float(case[key]) for key in keys} | angle


def operation_numbers(case: Case) -> dict[str, float]:
    """The fields of an operation (rad/s, N, N m, m, rad)."""
    speeds = {"speed": "inner_speed_rpm", "outer_speed": "outer_speed_rpm", "first_ball_azimuth": "first_azimuth"}
    units = (qs.rpm, qs.rpm, 1.0)
    numbers = {name: float(case.get(key, 0)) * unit for (name, key), unit in zip(speeds.items(), units, strict=True)}
    for key, (load, displacement) in CHANNELS.items():
        kind, value = case["channels"][key]
        numbers[displacement if kind == "displacement" else load] = float(value)
    return numbers


def seat_numbers(case: Case) -> dict[str, float]:
    """The fields of seats out of round (m, rad); 0 where a case has no such lobes, so that all have the same."""
    names = [f"{ring}_{word}_lobe" for ring in ("inner", "outer") for word in ("two", "three")]
    numbers = {f"{name}_{what}": 0.0 for name in names for what in ("amplitude", "phase")}
    for ring, lobes, amplitude, phase in case["seat_lobes"]:
        name = f"{ring}_{'two' if lobes == '2' else 'three'}_lobe"
        numbers |= {f"{name}_amplitude": float(amplitude), f"{name}_phase": float(phase) * qs.deg}
    return numbers


def scene_of(*cases: Case, stacked: bool = False) -> qs.Scene:
    """One scene of cases that make the same choices: numbers for one case, arrays in every field for several.

    A case without a `kind` gets shoulders on both sides, as the reference knows no open side.
    """

    def gather(numbers: list[dict[str, float]]) -> dict[str, Any]:
        if len(numbers) == 1 and not stacked:
            return dict(numbers[0])
        return {key: np.array([one[key] for one in numbers]) for key in numbers[:1] and numbers[0]}

    first = cases[0]
    bearing = qs.BallBearing(
        **gather([bearing_numbers(case) for case in cases]),
        ball_material=qs.Material(**gather([material(case, "ball_material") for case in cases])),
        ring_material=qs.Material(**gather([material(case, "ring_material") for case in cases])),
        kind=qs.BearingKind(first.get("kind", "deep_groove")),
    )
    effects: tuple[Any, ...] = (qs.CentrifugalForce(),) if first["centrifugal_force"] else ()
    if first["gyroscopic_moment"]:
        coefficient = gather(
            [{"mu": float(case["friction_coefficient"])} for case in cases if "friction_coefficient" in case]
        )
        effects += (qs.GyroscopicMoment(qs.MomentShares(first["shares"]), coefficient.get("mu")),)
    balls: tuple[Any, ...] = ()
    if "ball_diameter_deviations" in first:
        deviations = np.array([case["ball_diameter_deviations"] for case in cases], float)
        balls = (qs.BallDiameterDeviations(deviations if len(cases) > 1 or stacked else deviations[0]),)
    if "seat_lobes" in first:
        balls += (qs.SeatsOutOfRound(**gather([seat_numbers(case) for case in cases])),)
    return qs.Scene(
        bearing,
        qs.Operation(**gather([operation_numbers(case) for case in cases])),
        effects,
        qs.RacewayControl(first["control"]) if effects else None,
        hertz_angle=qs.HertzAngle(first["hertz_angle"]),
        orbit_radius=qs.OrbitRadius(first.get("orbit_radius", "pitch_circle")),
        ring_effects=balls,
    )
