"""From what is asked of qsbearing, a scene or a set of rows, to the problem that the reference solves.

Only what a user gives is read here: dimensions, materials, operation, effects. Whatever follows from it, curvatures,
grown rings, preload displacements, levers, is the reference's own.
"""

from __future__ import annotations

from dataclasses import replace
from math import sin
from typing import Any

import numpy as np

import qsbearing
from fem_check.independent import quasi_static
from fem_check.independent.contact_problem import Array
from fem_check.independent.equilibrium import BalanceTerms, BallRow
from fem_check.independent.quasi_static import CHANNELS, BalanceProblem, Placed, alone
from fem_check.product.scenes import (
    SceneProblemError,
    axial_growth,
    ball_count,
    drawing_at_rest,
    drawing_of,
    heat_strains,
)
from qsbearing.systems.sets.bearing_set import row_scene

LOADS = ("axial_load", "radial_load_y", "radial_load_z", "moment_y", "moment_z")
DISPLACEMENTS = ("axial_displacement", "radial_displacement_y", "radial_displacement_z", "tilt_y", "tilt_z")
STRAIGHT = np.array([False, True, True, True, True, True])
"""Channels that are held while a bearing is mounted."""
COLD: dict[str, Any] = {
    **dict.fromkeys(f"{body}_temperature" for body in ("shaft", "inner_ring", "outer_ring", "housing")),
    "reference_temperature": qsbearing.RingExpansion.reference_temperature,
}
"""Ring expansion that is given no temperature."""


def of_scene(scene: qsbearing.Scene, name: str) -> BalanceProblem:
    """A bearing alone.

    Raises:
        SceneProblemError: a field holds several values.
        NoReferenceError: its preload at rest has no equilibrium.
    """
    load, held, shaft = _channels(scene.operation)
    preload = scene.preload
    if preload is not None and preload.spring is not None:
        load[0] = _number(preload.spring)
    elif preload is not None:
        held[0] = True
        if preload.axial_displacement is not None:
            shaft[0] = _number(preload.axial_displacement)
        else:
            mounted = Placed(row_of(as_preloaded(scene, preload), name), alone())
            shaft[0] = approach_of((mounted,), _force(preload))
        # The shaft, as long as it was held, has grown since.
        shaft[0] *= 1.0 + heat_strains(scene, name)["shaft"]
    return BalanceProblem((Placed(row_of(scene, name), alone()),), load, held, shaft)


def of_set(of: qsbearing.BearingSet, name: str) -> BalanceProblem:
    """Rows on one shaft.

    Inner rings part as the shaft grows between them, outer ones as the housing does, both from the reference position;
    what presses a row while the shaft is at its zero is a length of the shaft.

    Raises:
        SceneProblemError: a field holds several values; outer rings that slide, each by itself.
        NoReferenceError: a side of it has no equilibrium under its preload at rest.
    """
    sliding = [number for number, row in enumerate(of.rows, 1) if of.is_two_sided[number - 1] and row.carries != "both"]
    if sliding:
        problem = f"the outer ring of row {sliding[0]} slides, which the reference does not move"
        raise SceneProblemError(f'scene {name}: {problem}; judge the set with carries = "both"')
    load, held, shaft = _channels(of.operation)
    turning = {each: getattr(of.operation, each) for each in ("speed", "outer_speed", "first_ball_azimuth")}
    scenes = [row_scene(of, number, qsbearing.Operation(**turning)) for number in range(len(of.rows))]
    strains = [heat_strains(scene, name) for scene in scenes]
    moved = {body: _moved_by_heat(of, [each[body] for each in strains]) for body in ("shaft", "housing")}
    places = [_place(of, number, scene, name, moved["shaft"][number]) for number, scene in enumerate(scenes)]
    preload = of.preload
    pressed = dict.fromkeys((1.0, -1.0), 0.0)
    if preload is not None and preload.spring is not None:
        load[5], held[5] = _number(preload.spring), False
    elif preload is not None and preload.axial_displacement is not None:
        pressed = dict.fromkeys(pressed, 0.5 * _number(preload.axial_displacement))
    elif preload is not None:
        for sign in pressed:  # without offsets, which add to what the preload takes
            side = tuple(
                Placed(row_of(as_preloaded(scene, preload), name), place * sign)
                for number, (scene, place, row) in enumerate(zip(scenes, places, of.rows, strict=True))
                if row.sign == sign and not of.is_two_sided[number]
            )
            pressed[sign] = approach_of(side, _force(preload))
    rows = []
    for number, (scene, place, row) in enumerate(zip(scenes, places, of.rows, strict=True)):
        apart = moved["shaft"][number] - moved["housing"][number]
        balls = row_of(scene, name)
        both = of.is_two_sided[number]
        length = (_number(row.offset) + (0.0 if both else pressed[row.sign])) * (1.0 + strains[number]["shaft"])
        # Such a row is placed with its grooves in one plane.
        rows.append(Placed(balls, place, length + row.sign * apart - both * balls.touching_offset))
    return BalanceProblem(tuple(rows), load, held, shaft)


def as_preloaded(scene: qsbearing.Scene, preload: qsbearing.Preload) -> qsbearing.Scene:
    """The bearing at rest and at the reference temperature, with its fits where the preload is given mounted."""
    effects: list[Any] = []
    for effect in scene.ring_effects:
        is_kept = isinstance(effect, qsbearing.SeatsOutOfRound) and preload.mounted is not None
        if is_kept or isinstance(effect, qsbearing.BallDiameterDeviations):
            effects.append(effect)
        elif isinstance(effect, qsbearing.RingExpansion) and preload.mounted is not None:
            effects.append(replace(effect, **COLD))
    still = qsbearing.Operation(first_ball_azimuth=scene.operation.first_ball_azimuth)
    return replace(
        scene, operation=still, preload=None, ball_effects=(), raceway_control=None,
        orbit_radius=qsbearing.OrbitRadius.PITCH_CIRCLE, ring_effects=tuple(effects),
    )  # fmt: skip


def row_of(scene: qsbearing.Scene, name: str) -> BallRow:
    """The balls of a scene's bearing."""
    drawing, moment, operation = drawing_at_rest(scene, name), scene.gyroscopic_moment, scene.operation
    turns = bool(scene.ball_effects)
    model = BalanceTerms(
        centrifugal=turns and scene.centrifugal_force is not None,
        gyroscopic=turns and moment is not None,
        control=str(scene.raceway_control) if turns else None,
        harris_shares=moment is not None and moment.moment_shares is qsbearing.MomentShares.HARRIS,
        friction_coefficient=None if moment is None or moment.friction_coefficient is None
        else _number(moment.friction_coefficient),
        displaced_orbit=scene.orbit_radius is qsbearing.OrbitRadius.DISPLACED,
        hertz_angle=str(scene.hertz_angle),
        hertz_form=str(scene.hertz_form),
        pitch_circle_lever=scene.tilt_lever is qsbearing.TiltLever.PITCH_CIRCLE,
    )  # fmt: skip
    count = ball_count(scene)
    row = BallRow(
        drawing=drawing_of(scene, name),
        model=model,
        azimuth=_number(operation.first_ball_azimuth) + 2.0 * np.pi * np.arange(count) / count,
        inner_speed=_number(operation.speed) if turns else 0.0,
        outer_speed=_number(operation.outer_speed or 0.0) if turns else 0.0,
        touching_offset=drawing.touching_offset + sum(axial_growth(scene, name)),
    )
    seats = scene.seats_out_of_round
    if seats is not None:
        row = replace(row, lobes=_ring_form(seats, "inner", row.azimuth) - _ring_form(seats, "outer", row.azimuth))
    deviations = scene.ball_diameter_deviations
    if deviations is None:
        return row
    # Deviations are those of cold balls, which grow alike.
    own = 1.0 + np.asarray(deviations.deviations, float).reshape(-1) / drawing.ball_diameter
    return replace(row, diameters=row.drawing.ball_diameter * own)


def _ring_form(seats: qsbearing.SeatsOutOfRound, side: str, azimuth: Array) -> Array:
    """By how much this ring's groove stands out at each ball [m]: the real part of a e^(i n (psi - phase))."""
    form = np.zeros_like(azimuth)
    for lobes, word in ((2, "two"), (3, "three")):
        amplitude, phase = (getattr(seats, f"{side}_{word}_lobe_{what}") for what in ("amplitude", "phase"))
        if amplitude is not None:
            turned = np.exp(1j * lobes * (azimuth - _number(phase or 0.0)))
            form = form + _number(amplitude) * turned.real
    return form


def _number(value: Any) -> float:
    return float(np.asarray(value, float).reshape(-1)[0])


def _force(preload: qsbearing.Preload) -> float:
    return _number(preload.rigid if preload.mounted is None else preload.mounted)


def _channels(operation: qsbearing.Operation) -> tuple[Array, Array, Array]:
    """Loads, what is held, and displacements of the shaft's channels; the last is held unless a spring presses."""
    load, held, shaft = np.zeros(CHANNELS), np.zeros(CHANNELS, bool), np.zeros(CHANNELS)
    held[5] = True
    for channel, (force, displacement) in enumerate(zip(LOADS, DISPLACEMENTS, strict=True)):
        given = getattr(operation, displacement)
        if given is not None:
            held[channel], shaft[channel] = True, _number(given)
        elif getattr(operation, force) is not None:
            load[channel] = _number(getattr(operation, force))
    return load, held, shaft


def _moved_by_heat(of: qsbearing.BearingSet, strains: list[float]) -> Array:
    """By how much a shaft or housing with these strains at the rows moves each row in +x from the reference position.

    Between two rows it grows by the mean of their strains, beyond the outermost by the strain there.
    """
    at, reference = np.array([_number(row.position) for row in of.rows]), _number(of.reference)
    order = np.argsort(at)
    places, grown = at[order], np.array(strains)[order]
    moved = np.concatenate([[0.0], np.cumsum(0.5 * (grown[1:] + grown[:-1]) * np.diff(places))])
    beyond = grown[0] * min(reference - places[0], 0.0) + grown[-1] * max(reference - places[-1], 0.0)
    return np.asarray(np.interp(at, places, moved) - np.interp(reference, places, moved) - beyond)


def _place(of: qsbearing.BearingSet, number: int, scene: qsbearing.Scene, name: str, moved: float) -> Array:
    """How the shaft moves a row's ring, where its groove centres' circle is; in the row's own axes.

    A row that carries in -x is seen in a mirror across the shaft: axial displacement and tilts are reversed, and the
    groove centres, which lie past the balls' on the side that is pushed, are on the other side.

    Args:
        moved: the row, by the heat of the shaft, in +x [m].
    """
    row = of.rows[number]
    sign, arm = row.sign, _number(row.position) - _number(of.reference) + moved
    if scene.tilt_lever is not qsbearing.TiltLever.PITCH_CIRCLE and not of.is_two_sided[number]:
        arm += sign * past_the_balls(scene, name)
    at = np.array([arm, 0.0, 0.0])
    place = np.zeros((5, CHANNELS))
    for channel, direction in enumerate(np.eye(3)):
        place[:3, channel] = direction
    for channel, turn in ((3, np.array([0.0, 1.0, 0.0])), (4, np.array([0.0, 0.0, 1.0]))):
        place[:3, channel] = np.cross(turn, at)
        place[channel, channel] = 1.0
    place[[0, 3, 4]] *= sign
    place[0, 5] = float(row.sprung)
    return place


def past_the_balls(scene: qsbearing.Scene, name: str) -> float:
    """How far the plane of the inner groove centres is past that of the balls, on the side that is pushed [m]."""
    drawing = drawing_at_rest(scene, name)
    beyond = (drawing.inner_groove_radius - 0.5 * drawing.ball_diameter) * sin(drawing.free_contact_angle)
    return float(beyond + axial_growth(scene, name)[0])


def approach_of(rows: tuple[Placed, ...], force: float) -> float:
    """The axial displacement of straight rings at rest under a force."""
    load = force * np.eye(CHANNELS)[0]
    problem = BalanceProblem(rows, load, STRAIGHT, np.zeros(CHANNELS))
    controls = [None] * len(rows)
    return float(quasi_static.solve(problem, quasi_static.at_rest(problem), controls).shaft[0])
