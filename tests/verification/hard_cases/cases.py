"""The hard cases, in the form of the reference's own scenes (SI, decimal strings; angles and speeds as the keys say).

Beside that form a case says its `kind` (whether its shoulders hold both sides), the azimuth of its first ball, and what
is expected of it:

    converged       against the fifty-digit solution in `reference.json`
    closed form     converged, to what the sentence derives; there is nothing to iterate on, or no unique answer
    no_equilibrium  and why

`because` is the reasoning; `case.reason` is never a number seen from the package itself.
"""

from __future__ import annotations

from typing import Any

from tests.verification.reference.scenes import (
    B218,
    DEEP_GROOVE,
    SPINDLE,
    STEEL,
    Case,
    at_rest,
    hold,
    load,
    turning,
    upright,
)

CONVERGED, CLOSED_FORM, NO_EQUILIBRIUM = "converged", "closed form", "no_equilibrium"

DEEP = "deep_groove"
CLEARANCE = DEEP_GROOVE | {"free_contact_angle_deg": "9", "ball_count": 9, "pitch_diameter": "0.046"}
"""A deep-groove bearing with play."""
STEEP = B218 | {"free_contact_angle_deg": "74.9"}
SLENDER = B218 | {"inner_groove_radius": "0.011112611125", "outer_groove_radius": "0.011112611125"}
"""f = 0.500005: ellipses a thousand times longer than wide."""
CLOSE = B218 | {"inner_groove_radius": "0.0111236125", "outer_groove_radius": "0.0111236125"}
"""f = 0.5005."""
OPEN = B218 | {"inner_groove_radius": "0.01666875", "outer_groove_radius": "0.01666875"}
"""f = 0.75: nearly round contacts, and as much play between the grooves as half a ball."""
MICRO = {
    "ball_count": 7,
    "ball_diameter": "0.0005",
    "pitch_diameter": "0.0021",
    "inner_groove_radius": "0.00026",
    "outer_groove_radius": "0.000265",
    "free_contact_angle_deg": "15",
    "ball_material": STEEL,
    "ring_material": STEEL,
}
GIANT = {
    "ball_count": 60,
    "ball_diameter": "0.1",
    "pitch_diameter": "2.5",
    "inner_groove_radius": "0.0525",
    "outer_groove_radius": "0.053",
    "free_contact_angle_deg": "45",
    "ball_material": STEEL,
    "ring_material": STEEL,
}
SHAFT = {"y": "0", "z": "0", "tilt_y": "0", "tilt_z": "0"}
"""Everything held but the axis."""


def of(kind: str, case: Case, expected: str = CONVERGED, because: str = "", **other: Any) -> Case:
    """A case with what this library adds to it."""
    return {**case, "kind": kind, "first_azimuth": "0", "expected": expected, "because": because} | other


def angular(case: Case, expected: str = CONVERGED, because: str = "", **other: Any) -> Case:
    """A case of an angular-contact bearing."""
    return of("angular_contact", case, expected, because, **other)


def deep(case: Case, expected: str = CONVERGED, because: str = "", **other: Any) -> Case:
    """A case of a bearing with shoulders on both sides."""
    return of(DEEP, case, expected, because, **other)


ONE = B218 | {"ball_count": 1}

CASES: list[Case] = [
    # Few balls, many balls ---------------------------------------------------------------------------------------
    angular(turning("one_ball_held", "a single ball, everything but the axis held",
        ONE, hold(load("500"), **SHAFT), "9000")),
    angular(turning("one_ball_free", "a single ball and a ring free to shift and tilt",
        ONE, load("500", y="20"), "3000"), NO_EQUILIBRIUM,
        "a ring on one ball moves without moving its groove centre in the ball's plane: across the plane, and by "
        "tilts about the ball; thrust works along such a motion"),
    deep(at_rest("single_ball_carries", "with play, a light radial load rests on one ball of nine",
        CLEARANCE, hold(load(y="0.5"), x="-0.00009", z="0", tilt_y="0", tilt_z="0"))),
    angular(turning("three_balls", "Z = 3: nothing to spare",
        B218 | {"ball_count": 3}, load("3000", "300", "-200", "3", "-5"), "6000")),
    angular(turning("sixty_balls", "Z = 60 in a giant bearing",
        GIANT, load("1e6", "2e5", "-1e5", "3e4", "-5e4"), "600")),
    # Touching and unloading --------------------------------------------------------------------------------------
    angular(at_rest("exactly_touching_at_rest", "all held where every ball just touches",
        B218, hold(load(), x="0", **SHAFT)), CLOSED_FORM,
        "the displacement counts from there: every approach is zero, and so is every load"),
    angular(turning("exactly_touching_at_speed",
        "the same turning: the balls press outward and wedge themselves between the rings",
        B218, hold(load(), x="0", **SHAFT), "9000")),
    deep(at_rest("touching_at_the_sides", "no play: the balls at 90 degrees just touch, those behind do not",
        DEEP_GROOVE | {"ball_count": 8}, hold(load(y="1000"), x="0", z="0", tilt_y="0", tilt_z="0"))),
    deep(at_rest("most_balls_unloaded_at_rest", "with play, most balls touch nothing",
        CLEARANCE, hold(load(y="200", z="-70"), x="-0.00009", tilt_y="0", tilt_z="0"))),
    deep(turning("most_balls_unloaded_at_speed", "the same at speed: they ride on the outer ring",
        CLEARANCE, hold(load(y="200", z="-70"), x="-0.00009", tilt_y="0", tilt_z="0"), "12000")),
    deep(turning("straddling_the_load", "two balls beside the load's line instead of one on it",
        CLEARANCE, hold(load(y="400"), x="-0.00009", z="0", tilt_y="0", tilt_z="0"), "8000"),
        first_azimuth="0.3490658503988659"),
    angular(turning("straddling_the_loaded_zone", "balls just inside and just outside the loaded zone",
        B218, load("6000", "9000", "0", "0", "-250"), "4000"),
        first_azimuth="0.19"),
    # Angles ------------------------------------------------------------------------------------------------------
    deep(at_rest("radial_at_no_angle", "radial load, free angle 0, free axis: the axis is nearly idle",
        DEEP_GROOVE | {"free_contact_angle_deg": "1e-6"}, hold(load("1e-3", "1000"), z="0", tilt_y="0", tilt_z="0"))),
    deep(at_rest("thrust_at_no_angle", "thrust, free angle 0: all stiffness comes from the load",
        DEEP_GROOVE, hold(load("10"), **SHAFT))),
    deep(at_rest("small_thrust_at_small_angle", "a millinewton at a millionth of a degree",
        DEEP_GROOVE | {"free_contact_angle_deg": "1e-6"}, hold(load("1e-3"), **SHAFT))),
    deep(turning("thrust_at_no_angle_at_speed", "the same turning",
        DEEP_GROOVE, hold(load("10"), **SHAFT), "15000")),
    angular(turning("steep_thrust", "free angle 74.9 degrees", STEEP, load("20000"), "3000")),
    angular(turning("steep_combined", "the same with a general load",
        STEEP, load("30000", "1500", "-500", "100", "-150"), "4000")),
    # Light, heavy, reversed --------------------------------------------------------------------------------------
    angular(turning("vanishing_thrust_at_speed", "a newton against eighty kilonewtons of centrifugal force",
        B218, load("1"), "18000")),
    angular(turning("vanishing_combined_at_speed", "the same with a radial load",
        B218, upright(load("10", "3", "-1")), "12000")),
    angular(at_rest("a_millionth_of_a_newton", "1e-6 N at rest",
        B218, load("1e-6", "2e-7", "1e-7", "1e-9", "-2e-9"))),
    angular(turning("a_millionth_of_a_newton_at_speed", "1e-6 N at 1e5 mm rpm",
        B218, load("1e-6"), "800")),
    angular(turning("yield_limit", "contact pressure about 4200 MPa",
        B218, load("3.2e5", "4e4", "-1e4", "500", "-800"), "3000")),
    angular(turning("far_past_yield", "ten times that load",
        B218, load("3e6", "3e5", "-1e5", "5000", "-8000"), "3000")),
    angular(at_rest("thrust_reversed", "an angular-contact bearing pulled off",
        B218, load("-5000")), NO_EQUILIBRIUM,
        "moving back along x presses no ball, and the load works along it"),
    angular(turning("thrust_reversed_at_speed", "the same at speed, outer control",
        B218, load("-5000", "300", "0", "0", "0"), "8000"), NO_EQUILIBRIUM,
        "the same direction: under outer control only normal loads push the ring"),
    angular(at_rest("moment_alone_one_sided", "a moment alone on an angular-contact bearing",
        B218, load(tilt_z="-50")), NO_EQUILIBRIUM,
        "without thrust the axial pushes, none negative, must all vanish, and then so does their moment"),
    angular(at_rest("radial_beyond_thrust", "more moment than the thrust's arm within the ball circle",
        B218, load("1000", tilt_z="-100")), NO_EQUILIBRIUM,
        "100 N m is more than 1000 N at the radius of the groove centres, 63 mm: the thrust's line of action passes"
        " outside the ball circle"),
    deep(at_rest("moment_alone", "a moment alone on a bearing with two shoulders",
        DEEP_GROOVE, load(tilt_z="-1"))),
    deep(turning("moment_alone_at_speed", "the same turning",
        DEEP_GROOVE, load(tilt_y="0.7", tilt_z="-1"), "9000")),
    # Held displacements ------------------------------------------------------------------------------------------
    angular(turning("huge_interference", "pressed together by half a millimetre",
        B218, hold(load(), x="0.0005", **SHAFT), "6000")),
    angular(turning("interference_and_radial", "0.1 mm of preload and a radial load",
        B218, hold(load(y="20000"), x="0.0001", z="0", tilt_y="0", tilt_z="0"), "9000")),
    angular(turning("huge_clearance", "pulled apart by a quarter millimetre: all balls on the outer ring",
        B218, hold(load(), x="-0.00025", **SHAFT), "6000")),
    # Conformity --------------------------------------------------------------------------------------------------
    angular(turning("slender_ellipses", "k = 1000",
        SLENDER, load("5", "0.5", "0.2", "0", "0"), "60")),
    angular(turning("slender_ellipses_actual_angle", "the same, stiffness following the angles",
        SLENDER, load("5", "0.5", "0.2", "0", "0"), "60", hertz_angle="actual")),
    angular(turning("close_conformity", "f = 0.5005",
        CLOSE, load("17800", "2000", "1000", "0", "0"), "8000")),
    angular(turning("open_conformity", "f = 0.75",
        OPEN, load("17800", "2000", "1000", "0", "0"), "8000", hertz_angle="actual")),
    # Size, material, speed ---------------------------------------------------------------------------------------
    angular(turning("micro", "balls of half a millimetre",
        MICRO, load("0.3", "0.05", "-0.02", "1e-5", "-2e-5"), "100000")),
    angular(turning("ceramic_on_steel", "ceramic balls, unequal grooves",
        SPINDLE, load("1500", "200", "150", "2", "-3"), "24000")),
    angular(turning("fastest", "dm n = 5e6 mm rpm, ceramic",
        SPINDLE, load("3000", "400", "150", "2", "-3"), "55865")),
    angular(turning("fastest_and_light", "the same under a tenth of the load",
        SPINDLE, upright(load("300", "30")), "55865")),
    angular(turning("counter_rotation", "rings against each other, nearly no orbit",
        B218, load("12000", "3000", "0", "20", "-40"), "7000", outer_speed_rpm="-5200")),
    angular(turning("rings_together", "both rings at one speed: no rolling, all centrifugal",
        B218, load("12000", "3000", "0", "20", "-40"), "5000", outer_speed_rpm="5000")),
    # Raceway control ---------------------------------------------------------------------------------------------
    angular(turning("inner_control_at_its_end",
        "a ten-thousandth below 9338.72 rpm, where the inner race loses its load",
        B218, load("2000"), "9337.8", control="inner")),
    angular(turning("inner_control_beyond_its_end", "above it the friction has nothing to press on",
        B218, load("2000"), "9400", control="inner"), NO_EQUILIBRIUM,
        "friction needs a load: that of the inner raceway falls evenly to nothing at 9338.72 rpm (test_hard_cases)"),
    angular(turning("control_switches_outer_side",
        "a millionth above 2086.90434, the least speed of consistent outer control",
        B218, load("17800"), "2086.9064", control="per_ball")),
    angular(turning("control_switches_inner_side",
        "a millionth below 2081.51116, the greatest speed of consistent inner control",
        B218, load("17800"), "2081.5091", control="per_ball")),
    angular(turning("control_between", "between the two no choice is consistent",
        B218, load("17800"), "2084", control="per_ball"), CLOSED_FORM,
        "the criterion, evaluated at either control's own solution, calls for the other: an equilibrium is "
        "reported with a warning, and it is that of one of the two"),
    angular(turning("mixed_control", "both answers within one bearing",
        B218, load("20000", "9000", "2000", "0", "-250"), "2600", control="per_ball")),
    # Tilt --------------------------------------------------------------------------------------------------------
    deep(turning("tilted_by_5_mrad", "five free channels, moments that tilt the ring by 5 mrad",
        DEEP_GROOVE, load("150", "400", "100", "3", "-8"), "9000")),
]  # fmt: skip
