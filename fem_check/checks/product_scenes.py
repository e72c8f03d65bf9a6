"""What `solve` offers, on B218: a scene or set for each effect and choice, loads in all directions."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

import qsbearing as qs
from qsbearing.systems.sets.row import Direction

B218 = qs.load_scene("b218").bearing
PLUS, MINUS = Direction.PLUS, Direction.MINUS
BOTH: dict[str, Any] = {"ball_effects": (qs.CentrifugalForce(), qs.GyroscopicMoment()), "raceway_control": "outer"}
HARRIS = (qs.CentrifugalForce(), qs.GyroscopicMoment(qs.MomentShares.HARRIS))
FREE: dict[str, Any] = {"moment_y": 0.0, "moment_z": 0.0}
FIXED: dict[str, Any] = {"tilt_y": 0.0, "tilt_z": 0.0}
TURN = 217.0 * qs.deg
"""Neither an axis nor a plane between balls."""


def _turned(load: float) -> dict[str, float]:
    return {"radial_load_y": load * np.cos(TURN), "radial_load_z": load * np.sin(TURN)}


COMBINED: dict[str, Any] = {"axial_load": 12e3, **_turned(4e3), "first_ball_azimuth": 5.0 * qs.deg}
CELSIUS = qs.zero_celsius
ALUMINIUM = qs.Material(70e9, 0.33, 2700.0, 23e-6, "aluminium")


def _warm(shaft: float, inner_ring: float, outer_ring: float, housing: float, reference: float = 20.0) -> Any:
    """Seats that press and bodies of two materials, so that each temperature [degrees Celsius] counts."""
    return qs.RingExpansion(
        90 * qs.mm, 160 * qs.mm, shaft_interference=12 * qs.um, shaft_bore_diameter=40 * qs.mm,
        shaft_temperature=CELSIUS + shaft, inner_ring_temperature=CELSIUS + inner_ring,
        outer_ring_temperature=CELSIUS + outer_ring, housing_interference=10 * qs.um,
        housing_outside_diameter=210 * qs.mm, housing_material=ALUMINIUM, housing_temperature=CELSIUS + housing,
        reference_temperature=CELSIUS + reference,
    )  # fmt: skip


TURNING = qs.RingExpansion(90 * qs.mm, 160 * qs.mm, shaft_interference=10 * qs.um)
UNEQUAL = qs.BallDiameterDeviations([1.5 * qs.um, -1 * qs.um, 0.5 * qs.um, *13 * [0.0]])
WITH_CLEARANCE = qs.BallBearing.from_diametral_clearance(
    ball_count=7, ball_diameter=11.5e-3, pitch_diameter=43.5e-3, inner_groove_radius=5.98e-3,
    outer_groove_radius=6.095e-3, diametral_clearance=10e-6, kind=qs.BearingKind.DEEP_GROOVE,
)  # fmt: skip


def _at(rpm: float, loads: dict[str, Any] = COMBINED, outer_rpm: float | None = None, **more: Any) -> qs.Scene:
    outer = None if outer_rpm is None else outer_rpm * qs.rpm
    return qs.Scene(B218, qs.Operation(speed=rpm * qs.rpm, outer_speed=outer, **loads), **more)


def scenes() -> dict[str, qs.Scene]:
    """By label."""
    fixed, free, inner = COMBINED | FIXED, COMBINED | FREE, BOTH | {"raceway_control": "inner"}
    return {
        "loads turned by 217 degrees, free to tilt, at rest": _at(0.0, free),
        "loads turned by 217 degrees, free to tilt, 8000 rpm": _at(8000.0, free, **BOTH),
        "moments about y and z, 5000 rpm": _at(
            5000.0, {"axial_load": 20e3, "moment_y": 150.0, "moment_z": -90.0}, **BOTH
        ),
        "tilts and displacements held, 5000 rpm": _at(
            5000.0,
            {
                "axial_displacement": 40e-6, "radial_displacement_y": -12e-6, "radial_displacement_z": 20e-6,
                "tilt_y": 0.3e-3, "tilt_z": -0.2e-3,
            },
            **BOTH,
        ),
        "outer ring turns, 6000 rpm": _at(0.0, fixed, outer_rpm=6000.0, **BOTH),
        "both rings turn, 5000 and -3000 rpm": _at(5000.0, fixed, outer_rpm=-3000.0, **BOTH),
        "inner raceway control, 6000 rpm": _at(6000.0, fixed, **inner),
        "Harris's shares, inner raceway control, 6000 rpm": _at(6000.0, fixed, **inner | {"ball_effects": HARRIS}),
        "control by ball, 6000 rpm": _at(
            6000.0, fixed | {"axial_load": 25e3}, **BOTH | {"raceway_control": "per_ball"}
        ),
        "control by ball, near where it changes, 6000 rpm": replace(
            _at(6000.0, fixed | {"axial_load": 15e3, **_turned(2e3)}, **BOTH | {"raceway_control": "per_ball"}),
            bearing=replace(B218, outer_groove_radius=11.95e-3),
        ),
        "minimum dissipation, 8000 rpm": _at(8000.0, fixed, **BOTH | {"raceway_control": "minimum_dissipation"}),
        "balls slip, mu = 0.03, 10000 rpm": _at(
            10000.0, fixed,
            **BOTH | {"ball_effects": (qs.CentrifugalForce(), qs.GyroscopicMoment(friction_coefficient=0.03))},
        ),
        "displaced orbit, 10000 rpm": _at(10000.0, fixed, orbit_radius="displaced", **BOTH),
        "unequal balls, 6000 rpm": _at(6000.0, fixed, ring_effects=(UNEQUAL,), **BOTH),
        "rings grow by fits, heat and rotation, balls by heat, 12000 rpm": _at(
            12000.0, fixed, ring_effects=(_warm(52.0, 46.0, 33.0, 28.0), qs.BallExpansion(CELSIUS + 40)), **BOTH
        ),
        "preload as mounted, on a warm shaft in a warm housing, 9000 rpm": _at(
            9000.0, {}, preload=qs.Preload(mounted=2500.0),
            ring_effects=(_warm(47.0, 44.0, 36.0, 31.0, 22.0), qs.BallExpansion(CELSIUS + 42), UNEQUAL), **BOTH
        ),
        "rigid preload, rings grow by rotation and fit, 12000 rpm": _at(
            12000.0, {}, preload=qs.Preload(rigid=3000.0), ring_effects=(TURNING,), **BOTH
        ),
        "axial displacement as preload, 6000 rpm": _at(
            6000.0, {}, preload=qs.Preload(axial_displacement=30e-6), **BOTH
        ),
        "spring preload, 6000 rpm": _at(6000.0, {}, preload=qs.Preload(spring=5000.0), **BOTH),
        "stiffness of each contact's angle, 8000 rpm": _at(8000.0, fixed, hertz_angle="actual", **BOTH),
        "tilts about the pitch circle, Hertz at zero angle by Brewe and Hamrock, at rest": _at(
            0.0, free, tilt_lever="pitch_circle", hertz_angle="zero", hertz_form="brewe_hamrock_1977"
        ),
        "Hertz by Hamrock and Brewe 1983, at rest": _at(0.0, free, hertz_form="hamrock_brewe_1983"),
        "deep groove with 10 µm of clearance, at rest": qs.Scene(
            WITH_CLEARANCE, qs.Operation(axial_load=1000.0, radial_load_y=600.0, radial_load_z=800.0, **FREE)
        ),
    }  # fmt: skip


def sets() -> dict[str, qs.BearingSet]:
    """By label."""
    loads = qs.Operation(
        speed=8000.0 * qs.rpm, axial_load=1500.0, radial_load_y=3000.0, radial_load_z=-2000.0, first_ball_azimuth=0.1,
        **FREE,
    )  # fmt: skip
    pair = (qs.Row(B218, 0.0, PLUS), qs.Row(B218, 60e-3, MINUS))
    return {
        "back to back, rigid preload, 8000 rpm": qs.BearingSet(pair, loads, qs.Preload(rigid=4000.0), **BOTH),
        "tandem against a sprung row, 4000 rpm": qs.BearingSet(
            (qs.Row(B218, 0.0), qs.Row(B218, 40e-3), qs.Row(B218, 0.2, MINUS, sprung=True)),
            replace(loads, speed=4000.0 * qs.rpm, moment_y=60.0), qs.Preload(spring=6000.0), reference_position=30e-3,
            **BOTH,
        ),
        "face to face, pressed by 40 µm, rings that grow, 8000 rpm": qs.BearingSet(
            (qs.Row(B218, 0.0, MINUS, offset=3e-6), qs.Row(B218, 60e-3, PLUS, ring_effects=(TURNING,))),
            loads, qs.Preload(axial_displacement=40e-6), **BOTH,
        ),
        "back to back, mounted, shaft and housing warm from row to row, 6000 rpm": qs.BearingSet(
            (
                qs.Row(B218, 0.0, PLUS, offset=4e-6, ring_effects=(_warm(50.0, 46.0, 40.0, 28.0),)),
                qs.Row(B218, 50e-3, PLUS, ring_effects=(_warm(44.0, 42.0, 36.0, 27.0), UNEQUAL)),
                qs.Row(B218, 160e-3, MINUS, ring_effects=(_warm(38.0, 36.0, 31.0, 25.0),)),
            ),
            replace(loads, speed=6000.0 * qs.rpm), qs.Preload(mounted=20e3), reference_position=-30e-3, **BOTH,
        ),
    }  # fmt: skip


COUNT = f"{len(scenes())} scenes, {len(sets())} sets"
