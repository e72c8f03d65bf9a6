"""Published and twice-computed numbers, each to half a unit in its last printed place.

Sources: the 218 bearing of Harris & Kotzalas, *Rolling Bearing Analysis*, with the groove radii of Wang, Yan, Zhang &
Hong, "Research on the Dynamic Properties of Ball Bearings Based on the Quasi-Static Method" (chapter 19), computed by
two independent codes. What catalogues, standards, tests and other programs print: the validation book.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from fem_check.book.cases import iso_16281_seven_balls
from tests.qsbearing.scenes import B218, CENTRIFUGAL, DEEP_GROOVE, UPRIGHT, resting, solved, turning
from tests.verification.reference.published import CONTACTS, THRUST_TABLE, printed


@pytest.mark.parametrize("row", THRUST_TABLE, ids=lambda row: f"{row[0]} N, {row[1]} rpm")
def test_thrust_table(row: tuple[Any, ...]) -> None:
    """B218 from light load at speed to heavy load at rest: outer control, both effects, Hertz at each ball's angle."""
    axial_load, rpm, alpha_i, alpha_o, Qi, Qo, displacement, axial_stiffness = row
    solution = solved(turning(rpm, axial_load=axial_load, hertz_angle="actual"))
    for j in range(16):
        assert solution.inner.angle[j] / qs.deg == printed(alpha_i)
        assert solution.outer.angle[j] / qs.deg == printed(alpha_o)
        assert solution.inner.load[j] == printed(Qi)
        assert solution.outer.load[j] == printed(Qo)
    assert solution.displacement[0] / qs.um == printed(displacement)
    if axial_stiffness is not None:
        assert qs.stiffness(solution.scene, solution)[0, 0] * qs.um == printed(axial_stiffness)


def test_thrust_with_hertz_at_the_free_angle() -> None:
    """17 800 N, 10 000 rpm with contact stiffnesses that are constants of the bearing."""
    solution = solved(turning(10000, axial_load=17.8e3))
    assert solution.inner.angle[0] / qs.deg == printed("49.941413")
    assert solution.outer.angle[0] / qs.deg == printed("31.336597")
    assert solution.inner.load[0] == printed("1453.513")
    assert solution.outer.load[0] == printed("1921.556")
    assert solution.displacement[0] / qs.um == printed("14.7578")


def test_without_gyroscopic_moment() -> None:
    """The same point with centrifugal force alone: 47.76 and 34.42 degrees, between the right and the wrong sign."""
    solution = solved(turning(10000, effects=CENTRIFUGAL, axial_load=17.8e3))
    assert solution.inner.angle[0] / qs.deg == printed("47.76")
    assert solution.outer.angle[0] / qs.deg == printed("34.42")


def test_combined_load_with_held_tilt() -> None:
    """8000 N axial, 4000 N radial, 10 000 rpm, stiff shaft: displacements, reaction moment, extreme ball loads."""
    solution = solved(turning(10000, axial_load=8e3, radial_load_y=4e3, hertz_angle="actual", **UPRIGHT))
    assert solution.displacement[0] / qs.um == printed("-93.198")
    assert solution.displacement[1] / qs.um == printed("94.789")
    assert -solution.load[4] == printed("163.271")  # M = -Mz
    assert solution.inner.load[0] == printed("1808.43")
    assert solution.inner.load[8] == printed("305.26")


def test_radial_load_that_unloads_balls_at_rest() -> None:
    """8000 N axial and radial at rest: the ball opposite the load leaves both rings."""
    solution = solved(resting(axial_load=8e3, radial_load_y=8e3, hertz_angle="actual", **UPRIGHT))
    assert solution.inner.load[0] == printed("2752.19")
    assert solution.inner.load[8] == 0.0
    assert solution.displacement[0] / qs.um == printed("3.538")
    # 39.2185 was rounded a second time, to 39.219: hence one unit for the longer number, and one for the shorter.
    assert solution.displacement[1] / qs.um == printed("39.2185", units=1.0)
    assert solution.displacement[1] / qs.um == printed("39.219", units=1.0)


# ------------------------------------------------------------------------------------------------------ single contacts


@pytest.mark.parametrize("row", CONTACTS, ids=lambda row: f"{'inner' if row[0] < 0 else 'outer'} {row[4]:g} N")
def test_single_contacts(row: tuple[Any, ...]) -> None:
    """Radii, ellipse, pressure and approach of B218's two contacts at 40 degrees."""
    side, Rx, Ry, k, load, a, b, p0, approach = row
    radius_x = 0.5 * 22.225 * (1.0 + side * 22.225 / 125.26 * np.cos(40 * qs.deg))
    f = 11.6281 / 22.225
    radius_y = f * 22.225 / (2.0 * f - 1.0)
    assert radius_x == printed(Rx)
    assert radius_y == printed(Ry)
    contact = qs.point_contact(load, 1e3 / radius_x, 1e3 / radius_y, float(B218.effective_modulus))
    assert contact.ellipticity == printed(k)
    assert contact.semi_major_axis / qs.mm == printed(a)
    assert contact.semi_minor_axis / qs.mm == printed(b)
    assert contact.max_pressure / qs.MPa == printed(p0)
    assert contact.approach / qs.um == printed(approach)


# --------------------------------------------------------------------------------------------------------- ISO/TS 16281
#
# Displacements and lives against a commercial program: case iso_16281_seven_balls of the validation book.


def test_the_lever_of_a_tilt_shows() -> None:
    """With the circle of inner groove centres as the lever the tilts are 1 % smaller: 2.659 and 3.6468 mrad."""
    lever = qs.TiltLever.GROOVE_CENTRE
    clearance = iso_16281_seven_balls.bearing(10 * qs.um)
    combined = {"axial_load": 1000.0, "radial_load_y": 1000.0, "moment_z": 0.0}
    for bearing, operation, tilt, hertz_angle in (
        (clearance, combined, "2.659", qs.HertzAngle.ZERO),
        (DEEP_GROOVE, {"axial_displacement": 0.0, "moment_z": -1.0}, "3.6468", qs.HertzAngle.ZERO),
        (clearance, combined, "2.6590", qs.HertzAngle.ACTUAL),
    ):
        scene = qs.Scene(bearing, qs.Operation(**operation), hertz_angle=hertz_angle, tilt_lever=lever)
        assert abs(solved(scene).displacement[4]) / qs.mrad == printed(tilt)


# --------------------------------------------------------------------------------------------------------------- trends


def test_more_balls() -> None:
    """10 kN, 10 000 rpm, Z 12 to 18: the angles part and the ball load falls.

    Eighteen balls are wider than B218's pitch circle, which the bearing rightly refuses; under pure thrust a ball knows
    only its own share of the load, so that sixteen balls with 16/18 of it show what eighteen would.
    """
    twelve = solved(turning(10000, replace(B218, ball_count=12), axial_load=10e3, hertz_angle="actual"))
    eighteen = solved(turning(10000, axial_load=10e3 * 16 / 18, hertz_angle="actual"))
    assert twelve.inner.angle[0] / qs.deg == printed("51.88")
    assert twelve.outer.angle[0] / qs.deg == printed("27.68")
    assert twelve.inner.load[0] == printed("1059")
    assert eighteen.inner.angle[0] / qs.deg == printed("54.83")
    assert eighteen.outer.angle[0] / qs.deg == printed("21.30")
    assert eighteen.inner.load[0] == printed("680")
    with pytest.raises(qs.SceneError, match="do not fit"):
        replace(B218, ball_count=18)


def test_wider_grooves() -> None:
    """10 kN, 10 000 rpm, f 0.515 to 0.54: the pressure rises by a quarter, the ball load hardly moves."""
    tight, wide = (
        solved(
            turning(
                10000,
                replace(B218, inner_groove_radius=f * 22.225 * qs.mm, outer_groove_radius=f * 22.225 * qs.mm),
                axial_load=10e3,
                hertz_angle="actual",
            )
        )
        for f in (0.515, 0.54)
    )
    assert tight.inner.angle[0] / qs.deg == printed("54.69")
    assert wide.inner.angle[0] / qs.deg == printed("53.39")
    assert tight.inner.load[0] == printed("765.9")
    assert wide.inner.load[0] == printed("778.6")
    assert tight.inner.max_pressure[0] / qs.MPa == printed("1061")
    assert wide.inner.max_pressure[0] / qs.MPa == printed("1305")


@pytest.mark.parametrize("axial_load", [2e3, 10e3, 17.8e3, 44.5e3])
def test_with_speed_the_outer_angle_falls_and_the_inner_rises(axial_load: float) -> None:
    """Centrifugal force presses the balls outward: ao falls, ai rises, Qo > Qi, at every speed and load."""
    rpm = np.linspace(500.0, 15000.0, 30)
    solution = solved(turning(rpm, axial_load=axial_load))
    inner, outer = solution.inner.angle[:, 0], solution.outer.angle[:, 0]
    assert (np.diff(inner) > 0.0).all()
    assert (np.diff(outer) < 0.0).all()
    assert (solution.outer.load > solution.inner.load).all()


def test_friction_that_raceway_control_demands() -> None:
    """B218 asks 0.085 of the outer contact at 17.8 kN, 15 000 rpm; the peak over speed is much the same at any load."""
    rpm = np.linspace(100.0, 15000.0, 75)
    load = np.array([1e3, 2e3, 4e3, 8e3, 17.8e3])[:, None]
    solution = solved(turning(rpm, axial_load=load, hertz_angle="actual"))
    assert solution.inner.required_friction is not None
    assert solution.outer.required_friction is not None
    assert not solution.inner.required_friction.any()
    demanded = solution.outer.required_friction[..., 0]
    assert demanded[-1, -1] == printed("0.085")
    assert (demanded.max(axis=1) > 0.083).all()
    assert (demanded.max(axis=1) < 0.088).all()
