"""The mounted envelope: scenes of the other two with what fits, heat, preload and the balls' own differences add.

| quantity | range |
|---|---|
| scene | realistic (60 % of the groups) or wild |
| rings | expanded in three groups of four: bore 50-92 % of the groove's bottom, outside likewise |
| fits | shaft solid or hollow, housing 1.2 to 2.5 times the ring, half each; to 0.8 per mille of the seat, or loose |
| temperatures | each body's own, 60 K either way; a third of these groups all at one |
| growth | by fits and heat together at most 0.3 of what part the free angle, or BD, leaves: a bearing remains |
| expansion | steel 12e-6/K, silicon nitride 3.2e-6/K, other materials 1e-6 to 25e-6/K |
| balls | in a third of the groups of diameters of their own, 0.01 to 10 um, at most 0.1 (2 r - D), 0.5 % of D |
| preload | for half of those that hold or load the axial channel: spring, rigid or axial displacement |
| friction coefficient | for half of those with a gyroscopic moment, 0.01 to 0.5 |
| control | minimum dissipation for a quarter of those with effects |
| orbit | of the balls' own for a third of those with effects |
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from tests.verification.campaign import realistic, wild
from tests.verification.campaign.group import GROUP, LOAD_KEYS, Group, mixture, one_of

MOST_FIT = 8e-4
"""Of the seat's diameter: half of what makes rings yield."""

ROOM = 0.3
"""Of the room that growth may take."""

LEAST_BOTTOM, MOST_HOUSING = 0.3, 19e3
"""Millimetres: half of the one, and the other, are within what ring expansion takes, also of a smaller twin."""

REFERENCE = 20.0
"""Degrees, at which all dimensions hold."""

PRELOADS = ("spring_N", "rigid_N", "axial_displacement_um")


def draw_group(rng: np.random.Generator, number: int) -> Group:
    """A group; its number decides which channels a wild one holds."""
    group = one_of(rng, (realistic, wild), [0.6, 0.4]).draw_group(rng, number)
    if group.effects:
        control = qs.RacewayControl.MINIMUM_DISSIPATION if rng.random() < 0.25 else group.control
        orbit = qs.OrbitRadius.DISPLACED if rng.random() < 1.0 / 3.0 else group.orbit
        group = replace(group, control=control, orbit=orbit)
    more: dict[str, dict[str, NDArray]] = {"effects": {}}
    if "gyroscopic_moment" in group.effects and rng.random() < 0.5:
        more["effects"]["friction_coefficient"] = 10.0 ** rng.uniform(-2.0, np.log10(0.5), GROUP)
    if rng.random() < 1.0 / 3.0:
        group = of_one_ball_count(group)
        more["effects"]["ball_diameter_deviations_um"] = draw_deviations(rng, group.bearing)
    more |= draw_preload(rng, group)
    if "preload" in more:
        channels = ("axial_load_N", "axial_displacement_um")
        operation = {key: value for key, value in group.operation.items() if key not in channels}
        group = replace(group, operation=operation)
    if rng.random() < 0.75 and bottom(group.bearing).min() > LEAST_BOTTOM:
        group = replace(group, materials=with_expansion(rng, group.materials))
        more |= draw_expansion(rng, group)
    return calmed(replace(group, more=more))


def of_one_ball_count(group: Group) -> Group:
    """All with as many balls as the first, on a pitch circle as full and as fast as before."""
    bearing, operation = dict(group.bearing), dict(group.operation)
    count = np.full_like(bearing["ball_count"], bearing["ball_count"][0])
    wider = np.sin(np.pi / bearing["ball_count"]) / np.sin(np.pi / count)
    bearing |= {"ball_count": count, "pitch_diameter_mm": bearing["pitch_diameter_mm"] * wider}
    operation |= {key: operation[key] / wider for key in ("speed_rpm", "outer_speed_rpm")}
    return replace(group, bearing=bearing, operation=operation)


def draw_deviations(rng: np.random.Generator, bearing: dict[str, NDArray]) -> NDArray:
    """Of each ball's diameter (scene, ball) [um]."""
    groove = np.minimum(bearing["inner_groove_radius_mm"], bearing["outer_groove_radius_mm"])
    most = np.minimum(100.0 * (2.0 * groove - bearing["ball_diameter_mm"]), 5.0 * bearing["ball_diameter_mm"])
    size = np.minimum(10.0 ** rng.uniform(-2.0, 1.0, GROUP), most)
    return size[:, None] * np.clip(rng.normal(size=(GROUP, int(bearing["ball_count"][0]))), -2.0, 2.0) / 2.0


def span(bearing: dict[str, NDArray]) -> NDArray:
    """BD, between the groove centres [mm]."""
    return bearing["inner_groove_radius_mm"] + bearing["outer_groove_radius_mm"] - bearing["ball_diameter_mm"]


def bottom(bearing: dict[str, NDArray], side: str = "inner") -> NDArray:
    """Of a ring's groove, a diameter [mm]; the groove's centre lies r - D/2 from the ball's, at the free angle."""
    radius, outward = bearing[f"{side}_groove_radius_mm"], 1.0 if side == "inner" else -1.0
    reach = (radius - 0.5 * bearing["ball_diameter_mm"]) * np.cos(np.radians(bearing["free_contact_angle_deg"]))
    return bearing["pitch_diameter_mm"] + 2.0 * outward * (reach - radius)


def draw_preload(rng: np.random.Generator, group: Group) -> dict[str, dict[str, NDArray]]:
    """In place of the axial load or displacement that the group has."""
    if rng.random() < 0.5:
        return {}
    if group.held[0]:
        return {"preload": {"axial_displacement_um": group.operation["axial_displacement_um"]}}
    return {"preload": {one_of(rng, PRELOADS[:2]): np.abs(group.operation[LOAD_KEYS[0]])}}


def with_expansion(rng: np.random.Generator, materials: dict[str, dict[str, NDArray]]) -> dict[str, dict[str, NDArray]]:
    """The materials with coefficients of thermal expansion."""
    found = {}
    for side, table in materials.items():
        density = table["density_kg_m3"]
        other = 10.0 ** rng.uniform(-6.0, np.log10(25e-6), density.size)
        known = [density == 7800.0, density == 3200.0]
        found[side] = {**table, "thermal_expansion_per_K": np.select(known, [12e-6, 3.2e-6], other)}
    return found


def draw_expansion(rng: np.random.Generator, group: Group) -> dict[str, dict[str, NDArray]]:
    """Tables of ring and ball expansion."""
    n, bearing = GROUP, group.bearing
    angle, distance = np.radians(bearing["free_contact_angle_deg"]), span(bearing)
    half_pitch, ball = 0.5 * bearing["pitch_diameter_mm"], bearing["ball_diameter_mm"]
    bore = bottom(bearing) * rng.uniform(0.5, 0.92, n)
    outside = bottom(bearing, "outer") / rng.uniform(0.7, 0.92, n)
    room = ROOM * distance * np.cos(angle)
    rings = {"bore_diameter_mm": bore, "outside_diameter_mm": outside}
    bodies = ["inner_ring", "outer_ring"]
    if rng.random() < 0.5:
        bodies.append("shaft")
        rings["shaft_interference_um"] = draw_fit(rng, bore, room)
        if rng.random() < 0.5:
            rings["shaft_bore_diameter_mm"] = bore * rng.uniform(0.0, 0.8, n)
    if rng.random() < 0.5:
        bodies.append("housing")
        rings["housing_interference_um"] = draw_fit(rng, outside, room)
        rings["housing_outside_diameter_mm"] = np.minimum(outside * rng.uniform(1.2, 2.5, n), MOST_HOUSING)
    expansion = np.maximum(*(table["thermal_expansion_per_K"] for table in group.materials.values()))
    most = np.minimum(60.0, 0.1 * room / (expansion * np.maximum(half_pitch, ball)))
    together = rng.uniform(-60.0, 60.0, n) * (0.1 * distance > 1.2e-3 * 60.0 * ball * 25e-3)
    is_uniform = rng.random() < 1.0 / 3.0

    def temperature() -> NDArray:
        own: NDArray = together if is_uniform else most * rng.uniform(-1.0, 1.0, n)
        return REFERENCE + own

    rings |= {f"{body}_temperature_C": temperature() for body in bodies}
    return {"ring_expansion": rings, "ball_expansion": {"ball_temperature_C": temperature()}}


def draw_fit(rng: np.random.Generator, seat: NDArray, room: NDArray) -> NDArray:
    """Interference [um]; a quarter are loose."""
    most = np.minimum(MOST_FIT * seat, 0.5 * room)
    return 1e3 * most * mixture(rng, rng.random(GROUP), -rng.random(GROUP), 0.75)


def calmed(group: Group) -> Group:
    """The group, at rest and cold where growth would leave no bearing: each error tells of some scenes."""
    for _ in range(GROUP):
        try:
            group.scene()
            break
        except qs.SceneError as error:
            for each in error.errors:
                group = quiet(group, np.broadcast_to(True if each.where is None else each.where, (GROUP,)))
    return group


def quiet(group: Group, where: NDArray) -> Group:
    """The group, where told at rest and cold, its seats neither tight nor loose."""

    def calm(key: str, value: NDArray) -> NDArray:
        is_changed = key.endswith(("speed_rpm", "_C", "_interference_um"))
        return np.where(where, REFERENCE if key.endswith("_C") else 0.0, value) if is_changed else value

    more = {name: {key: calm(key, value) for key, value in table.items()} for name, table in group.more.items()}
    return replace(group, operation={key: calm(key, value) for key, value in group.operation.items()}, more=more)
