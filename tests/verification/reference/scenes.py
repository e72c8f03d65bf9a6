"""The scenes of the reference: every one a case that a model could get wrong in its own way.

A case is a dictionary in SI units and radians, except where a key names its unit; numbers are decimal strings, so that
every program reads exactly the same case.  Each channel of `channels` is ["load", N or N m] or
["displacement", m or rad].  `hertz_angle` tells whether the Hertz constants belong to the free contact angle or to
each ball's actual one.  `ball_diameter_deviations`, m, one for each ball, makes balls unequal; `seat_lobes`, each
[ring, lobes, amplitude in m, azimuth of a crest in degrees], puts rings out of round.  `control` "per_ball" leaves the
choice to Jones's criterion, ball by ball; the result tells what was chosen.
"""

from __future__ import annotations

from typing import Any

Case = dict[str, Any]

STEEL = {"elastic_modulus": "208e9", "poisson_ratio": "0.3", "density": "7800"}
RING_STEEL = {"elastic_modulus": "206e9", "poisson_ratio": "0.29", "density": "7830"}
SILICON_NITRIDE = {"elastic_modulus": "320e9", "poisson_ratio": "0.26", "density": "3200"}

B218 = {
    "ball_count": 16,
    "ball_diameter": "0.022225",
    "pitch_diameter": "0.12526",
    "inner_groove_radius": "0.0116281",
    "outer_groove_radius": "0.0116281",
    "free_contact_angle_deg": "40",
    "ball_material": STEEL,
    "ring_material": STEEL,
}
SPINDLE = {  # 70 x 110 mm, hybrid; different groove radii and materials on purpose
    "ball_count": 20,
    "ball_diameter": "0.0127",
    "pitch_diameter": "0.0895",
    "inner_groove_radius": "0.006731",
    "outer_groove_radius": "0.006604",
    "free_contact_angle_deg": "15",
    "ball_material": SILICON_NITRIDE,
    "ring_material": RING_STEEL,
}
DEEP_GROOVE = {  # the example bearing of ISO/TS 16281 calculations, without clearance
    "ball_count": 7,
    "ball_diameter": "0.0115",
    "pitch_diameter": "0.0435",
    "inner_groove_radius": "0.00598",
    "outer_groove_radius": "0.006095",
    "free_contact_angle_deg": "0",
    "ball_material": {"elastic_modulus": "210e9", "poisson_ratio": "0.3", "density": "7850"},
    "ring_material": {"elastic_modulus": "210e9", "poisson_ratio": "0.3", "density": "7850"},
}


UNEQUAL = [
    *("1.2e-6", "-0.4e-6", "0.9e-6", "-1.7e-6", "0.3e-6", "0.8e-6", "-0.2e-6", "2.1e-6"),
    *("-0.6e-6", "0.5e-6", "-1.1e-6", "1.6e-6", "0", "0.7e-6", "-2.3e-6", "0.1e-6"),
]
"""Deviations of sixteen ball diameters, m; no pattern."""


LOBES = [
    ["inner", "2", "0.8e-6", "23"], ["inner", "3", "0.5e-6", "-71"], ["outer", "2", "1.7e-6", "104"],
    ["outer", "3", "1.1e-6", "38"],
]  # fmt: skip
"""Both forms of both rings, none of which points at another's crest or at a ball."""


def load(x: str = "0", y: str = "0", z: str = "0", tilt_y: str = "0", tilt_z: str = "0") -> dict[str, list[str]]:
    """All five channels loaded, N and N m."""
    given = {"x": x, "y": y, "z": z, "tilt_y": tilt_y, "tilt_z": tilt_z}
    return {name: ["load", value] for name, value in given.items()}


def hold(channels: dict[str, list[str]], **displacements: str) -> dict[str, list[str]]:
    """The same channels with some held at a displacement instead, m and rad."""
    return {**channels, **{name: ["displacement", value] for name, value in displacements.items()}}


def upright(channels: dict[str, list[str]]) -> dict[str, list[str]]:
    """The same channels with both tilts held at nothing."""
    return hold(channels, tilt_y="0", tilt_z="0")


def at_rest(name: str, why: str, bearing: Case, channels: dict[str, list[str]], hertz_angle: str = "free") -> Case:
    """A bearing that does not turn."""
    return {
        "name": name,
        "why": why,
        **bearing,
        "inner_speed_rpm": "0",
        "outer_speed_rpm": "0",
        "channels": channels,
        "centrifugal_force": False,
        "gyroscopic_moment": False,
        "control": None,
        "shares": None,
        "hertz_angle": hertz_angle,
    }


def turning(name: str, why: str, bearing: Case, channels: dict[str, list[str]], speed: str, **other: Any) -> Case:
    """A bearing whose inner ring turns, with both ball effects and outer-raceway control unless told otherwise."""
    case = at_rest(name, why, bearing, channels)
    case |= {
        "inner_speed_rpm": speed,
        "centrifugal_force": True,
        "gyroscopic_moment": True,
        "control": "outer",
        "shares": "controlling",
    }
    return case | other


SCENES: list[Case] = [
    at_rest(
        "b218_thrust_at_rest",
        "the simplest anchor: two springs in series, all balls alike",
        B218, upright(load("17800")),
    ),
    turning(
        "b218_thrust_10000",
        "the classic case: both effects, the sign of the gyroscopic moment decides",
        B218, upright(load("17800")), "10000",
    ),
    turning(
        "b218_thrust_centrifugal_only",
        "separates the centrifugal force from the gyroscopic moment",
        B218, upright(load("17800")), "10000", gyroscopic_moment=False, shares=None,
    ),
    turning(
        "b218_thrust_actual_angle",
        "Hertz constants that follow each ball's own angle",
        B218, upright(load("17800")), "10000", hertz_angle="actual",
    ),
    turning(
        "b218_light_load_12000",
        "nearly all of the outer load is centrifugal and the outer angle almost vanishes",
        B218, upright(load("200")), "12000",
    ),
    turning(
        "b218_combined_held_tilt",
        "thrust and radial load on a stiff shaft: the reaction moment must come out",
        B218, upright(load("8000", "4000")), "10000",
    ),
    turning(
        "b218_combined_free_tilt",
        "the same loads with free tilts: a very different bearing",
        B218, load("8000", "4000"), "10000",
    ),
    turning(
        "b218_combined_actual_angle",
        "actual-angle Hertz where every ball has other angles, free tilt",
        B218, load("12000", "3000", "0", "0", "-30"), "8000", hertz_angle="actual",
    ),
    turning(
        "b218_thrust_and_moment",
        "a pure moment with thrust: the friction term of the ring's moment under shares (1, 1)",
        B218, load("15000", "0", "0", "0", "-200"), "6000", control="inner", shares="harris",
    ),
    turning(
        "b218_five_channels",
        "all five loads, no symmetry left: every sign of the frame counts",
        B218, load("12000", "3000", "-1500", "40", "-60"), "8000",
    ),
    turning(
        "b218_inner_control_own_share",
        "inner control with the whole moment on the inner race",
        B218, load("14000", "2500", "1000", "25", "-80"), "5000", control="inner", shares="controlling",
    ),
    turning(
        "b218_inner_control_harris_share",
        "the same with the moment halved between the races",
        B218, load("14000", "2500", "1000", "25", "-80"), "5000", control="inner", shares="harris",
    ),
    turning(
        "b218_per_ball_control_mixed",
        "Jones's criterion gives both answers within one bearing",
        B218, load("20000", "9000", "2000", "0", "-250"), "2600", control="per_ball", shares="controlling",
    ),
    turning(
        "b218_per_ball_control_mixed_harris",
        "mixed control again, tilts held and the moment halved at inner-controlled balls",
        B218, upright(load("10000", "6000")), "1500", control="per_ball", shares="harris",
    ),
    at_rest(
        "b218_unloading_at_rest",
        "half the balls leave both rings and have no position",
        B218, upright(load("8000", "8000")),
    ),
    at_rest(
        "b218_five_channels_at_rest_actual_angle",
        "a static scene without symmetry in which some balls unload, actual-angle Hertz",
        B218, load("9000", "5000", "-2500", "60", "-90"), hertz_angle="actual",
    ),
    turning(
        "b218_unloading_at_speed",
        "balls that leave the inner ring ride on the outer one at no angle",
        B218, hold(load("0", "8000", "-3000"), x="-0.0002", tilt_y="0", tilt_z="0"), "5000",
    ),
    turning(
        "b218_idle_balls",
        "nine balls far off the inner ring go round at the orbit of equal contact angles, beside seven that carry",
        B218, upright(load("2000", "4000")), "8000",
    ),
    turning(
        "b218_just_idle_balls",
        "three balls have just lost the inner ring: their orbit lies between the two",
        B218, upright(load("5000", "6500")), "8000",
    ),
    turning(
        "b218_light_combined_20000",
        "inertia forces of thousands of newtons against loads of hundreds",
        B218, upright(load("500", "150", "-50")), "20000",
    ),
    turning(
        "b218_odd_ball_count",
        "fifteen balls: no ball faces another",
        B218 | {"ball_count": 15}, load("10000", "2000", "3000", "0", "0"), "7000",
    ),
    turning(
        "b218_outer_ring_turns",
        "the outer ring turns alone: the gyroscopic moment changes its sign",
        B218, load("12000", "3000", "0", "20", "-40"), "0", outer_speed_rpm="6000",
    ),
    turning(
        "b218_counter_rotation",
        "rings that turn against each other: fast spin, slow orbit",
        B218, load("12000", "3000", "0", "20", "-40"), "7000", outer_speed_rpm="-4000",
    ),
    turning(
        "b218_both_rings_inner_control",
        "both rings turn forwards, inner control",
        B218, upright(load("16000", "3000", "1000")), "3000", outer_speed_rpm="1500", control="inner", shares="harris",
    ),
    turning(
        "b218_rigid_preload",
        "a held axial displacement with a radial load: the axial reaction must come out",
        B218, hold(load(y="5000"), x="0.00002", tilt_y="0", tilt_z="0"), "6000",
    ),
    turning(
        "b218_all_held",
        "all five displacements prescribed: no ring equation at all, five reactions",
        B218, hold(load(), x="0.00001", y="0.000015", z="-0.00001", tilt_y="0.0001", tilt_z="-0.0002"), "8000",
    ),
    turning(
        "spindle_hybrid_18000",
        "ceramic balls, unequal grooves and materials, small angle, high speed",
        SPINDLE, upright(load("800", "300")), "18000",
    ),
    turning(
        "spindle_hybrid_unloading_per_ball",
        "Jones's criterion where some balls leave the inner ring: there the outer race controls",
        SPINDLE, upright(load("300", "2500", "-700")), "3000", control="per_ball", shares="controlling",
    ),
    turning(
        "spindle_hybrid_free_tilt_24000",
        "the same bearing faster with a general load",
        SPINDLE, load("1500", "200", "150", "2", "-3"), "24000",
    ),
    turning(
        "b218_minimum_dissipation",
        "balls that spin on both raceways, their axes by the loads; both raceways carry the gyroscopic moment",
        B218, load("14000", "2500", "1000", "25", "-80"), "5000", control="minimum_dissipation",
    ),
    turning(
        "b218_minimum_dissipation_idle_balls",
        "the same where balls have lost the inner raceway, or just: no weight there, and no friction",
        B218, upright(load("5000", "6500")), "8000", control="minimum_dissipation", shares="harris",
    ),
    turning(
        "b218_slipping",
        "contacts that carry a twentieth of their load of friction: some balls slip, others do not",
        B218, load("8000", "4000"), "10000", friction_coefficient="0.05",
    ),
    turning(
        "b218_slipping_inner_control",
        "friction at the inner groove bounded: its term in the ring's moment too",
        B218, load("14000", "2500", "1000", "25", "-80"), "8000", control="inner", friction_coefficient="0.03",
    ),
    turning(
        "b218_own_orbits",
        "balls that go round on circles of their own; both rings turn",
        B218, load("12000", "3000", "0", "20", "-40"), "9000", outer_speed_rpm="-4000", orbit_radius="displaced",
    ),
    turning(
        "spindle_slip_dissipation_own_orbits",
        "all three at once",
        SPINDLE, load("600", "200", "150", "2", "-3"), "24000", control="minimum_dissipation", shares="harris",
        friction_coefficient="0.015", orbit_radius="displaced",
    ),
    at_rest(
        "deep_groove_moment_alone",
        "no clearance, no free angle, a moment of 1 N m alone: every angle comes from the tilt",
        DEEP_GROOVE, load(tilt_z="-1"),
    ),
    at_rest(
        "deep_groove_thrust",
        "no clearance and no free angle: the angle comes from the thrust, stiffness starts from nothing",
        DEEP_GROOVE, load("1000"),
    ),
    at_rest(
        "deep_groove_radial",
        "no clearance: just under half of the balls carry, the others touch nothing",
        DEEP_GROOVE, hold(load(y="1000"), x="0", tilt_y="0", tilt_z="0"),
    ),
    turning(
        "deep_groove_moment_at_speed",
        "angles of both signs in one bearing at speed",
        DEEP_GROOVE, load("150", "400", "100", "3", "-8"), "15000",
    ),
    turning(
        "b218_unequal_balls",
        "sixteen diameters between the same grooves, at speed, with all five loads",
        B218, load("12000", "3000", "-1500", "40", "-60"), "8000", ball_diameter_deviations=UNEQUAL,
    ),
    at_rest(
        "b218_one_large_ball_at_rest",
        "thrust alone, and yet no two balls alike: the ring tilts away from the one that is 6 µm too large",
        B218, load("2000"),
    ) | {"ball_diameter_deviations": ["6e-6"] + 15 * ["0"]},
    turning(
        "spindle_unequal_balls_and_all_else",
        "unequal balls where everything follows the ball: its own angle, orbit, weights of its raceways and slip",
        SPINDLE, load("600", "200", "150", "2", "-3"), "24000", control="minimum_dissipation", shares="harris",
        friction_coefficient="0.015", orbit_radius="displaced", hertz_angle="actual",
        ball_diameter_deviations=[*UNEQUAL, "1e-7", "-4e-7", "0", "9e-7"],
    ),
    turning(
        "b218_unequal_balls_by_each",
        "Jones's criterion for balls of unequal diameters",
        B218, load("20000", "9000", "2000", "0", "-250"), "2600", control="per_ball",
        ball_diameter_deviations=UNEQUAL[::-1],
    ),
    turning(
        "b218_seats_out_of_round",
        "two and three lobes of both rings, at speed, with all five loads",
        B218, load("12000", "3000", "-1500", "40", "-60"), "8000", seat_lobes=LOBES,
    ),
    at_rest(
        "b218_oval_seat_at_rest",
        "thrust alone in an oval housing: the ring stays where it is, the balls at the flats carry more",
        B218, load("2000"),
    ) | {"seat_lobes": [["outer", "2", "3e-6", "90"]]},
    at_rest(
        "deep_groove_wedged_at_three_places",
        "no clearance, and three lobes of the outer ring that wedge some of the seven balls beside the radial load",
        DEEP_GROOVE, hold(load(y="60"), x="0", tilt_y="0", tilt_z="0"),
    ) | {"seat_lobes": [["outer", "3", "2e-6", "10"]]},
    turning(
        "spindle_seats_out_of_round_and_all_else",
        "lobes and unequal balls where everything follows the ball: its angle, orbit, weights of its raceways and slip",
        SPINDLE, load("600", "200", "150", "2", "-3"), "24000", control="minimum_dissipation", shares="harris",
        friction_coefficient="0.015", orbit_radius="displaced", hertz_angle="actual", seat_lobes=LOBES,
        ball_diameter_deviations=[*UNEQUAL, "1e-7", "-4e-7", "0", "9e-7"],
    ),
    turning(
        "b218_seats_out_of_round_by_each",
        "Jones's criterion for balls between lobes",
        B218, load("20000", "9000", "2000", "0", "-250"), "2600", control="per_ball", seat_lobes=LOBES[::-1],
    ),
]  # fmt: skip
