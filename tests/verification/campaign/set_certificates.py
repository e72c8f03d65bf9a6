"""Whether a set that is said to have no equilibrium has none: a direction in which its loads work and no ball is
pressed.

As `certificates.unsupported_direction` of one bearing, here of all rows of a shaft. Every ball presses the inner ring
of its row with Q (sin a, cos a), 0 <= a <= 90 degrees, whatever its stiffness, growth, fit, offset or size, and however
the shaft bends and the housing gives; a support on the shaft pushes either way along its springs. What these can be is
a cone in the shaft's five channels and in one more for each spring: the rows that a preload's spring moves, or that a
floating sleeve holds, carry just its force. Loads outside of the cone have no equilibrium (Farkas); the direction that
says so comes from non-negative least squares and is checked for itself.

No proof where friction of the gyroscopic moment may act on a ring. Evidence is not sought: a set is refused where one
of its rows is, on the way, which leaves no equilibrium of the set to look at.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from tests.verification.campaign.certificates import ROUNDING, remainder
from tests.verification.campaign.checks import heat_strain, moved_by_heat, tilt_lever

CHANNELS = 5


def is_unsupported(solution: qs.SetSolution, k: int) -> bool:
    """Whether the loads of a set are outside of what its balls, supports and springs can bear."""
    of = solution.set
    if any(row.bearing.kind is not qs.BearingKind.ANGULAR_CONTACT for row in of.rows):
        return False
    if any(map(_has_friction, (row.scene for row in solution.rows))):
        return False
    pressing, wanted = cone(solution, k)
    size = np.abs(wanted).max()
    if size == 0.0:
        return False
    pressing, wanted = pressing / np.linalg.norm(pressing, axis=0), wanted / size
    direction = remainder(pressing, wanted)
    if direction is None:
        return False
    return bool(direction @ wanted > ROUNDING and (direction @ pressing).max() <= ROUNDING)


def _has_friction(scene: qs.Scene) -> bool:
    """Of any case: one call has one control and the same effects."""
    if scene.gyroscopic_moment is None or scene.raceway_control is qs.RacewayControl.OUTER:
        return False
    speed = scene.operation.speed
    return speed is not None and bool(np.any(np.asarray(speed)))


def cone(solution: qs.SetSolution, k: int) -> tuple[NDArray, NDArray]:
    """(channel, generator), (channel): what presses the shaft, each by a unit, and what is to be borne.

    Of one set of a case axis; moments over the largest lever. Generators are each ball's axial and radial force, row by
    row, then those of supports, either way. Channels after the five are of springs.
    """
    of = solution.set
    at = warm_places(solution, k)
    springs = _springs(solution, k)
    columns = [_balls(row, own, k, at(row.position)) for row, own in zip(of.rows, solution.rows, strict=True)]
    counts = [each.shape[1] for each in columns]
    supports = np.array([_about(at(place), force) for place, force in _supports(of)]).reshape(-1, CHANNELS).T
    pressing = np.concatenate([*columns, supports, -supports], axis=1)
    wanted = sum((_about(x, force) for x, force in _loads(solution, k, at)), np.zeros(CHANNELS))
    more = np.zeros((len(springs), pressing.shape[1]))
    for channel, (pressed, _) in zip(more, springs, strict=True):
        for number in pressed:
            begin = sum(counts[:number])
            channel[begin : begin + counts[number]] = columns[number][0]
    lever = max(np.abs(pressing[3:CHANNELS]).max(), 1e-3)
    scale = np.array([1.0, 1.0, 1.0, 1.0 / lever, 1.0 / lever] + [1.0] * len(springs))
    whole = np.concatenate([pressing, more])
    return whole * scale[:, None], np.concatenate([wanted, [force for _, force in springs]]) * scale


def forces(solution: qs.SetSolution, k: int) -> NDArray:
    """What each ball's generators of `cone` are multiplied with in a set that is solved; supports are left out."""
    parts = []
    for row in solution.rows:
        side = row.inner
        load = np.nan_to_num(side.load[k])
        parts += [load * np.nan_to_num(side.sine[k]), load * np.nan_to_num(side.cosine[k])]
    return np.concatenate(parts)


def _about(x: float, force: NDArray) -> NDArray:
    """A force and moment at a place on the shaft, with its moment about the origin."""
    return np.asarray(force) + np.array([0.0, 0.0, 0.0, -x * force[2], x * force[1]])


def _balls(row: qs.Row, own: qs.Solution, k: int, x: float) -> NDArray:
    """(5, 2 Z): of a row's balls, in the shaft's axes about its origin."""
    scene = own.scene
    psi = own.azimuth[k]
    zero, one = np.zeros(psi.size), np.ones(psi.size)
    lever = _of(tilt_lever(scene), k)
    axial = np.array([one, zero, zero, lever * np.sin(psi), -lever * np.cos(psi)])
    radial = np.array([zero, np.cos(psi), np.sin(psi), zero, zero])
    forces = np.concatenate([axial, radial], axis=1) * np.array([row.sign, 1.0, 1.0, row.sign, row.sign])[:, None]
    bearing = row.bearing
    # Of the plane of the inner groove centres, where a row's own loads are meant.
    past = (np.asarray(bearing.inner_groove_radius) - 0.5 * np.asarray(bearing.ball_diameter)) * np.sin(
        np.asarray(bearing.free_contact_angle)
    )
    arm = x + row.sign * (_of(past, k) + _of(moved_by_heat(scene, "inner"), k))
    forces[3] -= arm * forces[2]
    forces[4] += arm * forces[1]
    return forces


def warm_places(solution: qs.SetSolution, k: int) -> Callable[[Any], float]:
    """Where a drawn place is once warm, from the reference position; an inner sleeve parts places by what it is
    longer."""
    of = solution.set
    strain = heat_strain(solution.rows[0].scene, "shaft") if of.shaft is None else np.asarray(of.shaft.strains)[:, 0]
    grown, reference = 1.0 + _of(strain, k), _of(of.reference, k)
    stays = _of(of.rows[of.axial_datum].position, k) if of.spacers else 0.0

    def at(position: Any) -> float:
        place = _of(position, k)
        x = (place - reference) * grown
        for spacer in of.spacers:
            middle = 0.5 * sum(_of(of.rows[number - 1].position, k) for number in spacer.rows)
            longer = _of(np.subtract(spacer.inner_length, spacer.outer_length), k)
            x += longer * (float(place >= middle) - float(stays >= middle))
        return x

    return at


def _loads(solution: qs.SetSolution, k: int, at: Any) -> list[tuple[float, NDArray]]:
    """Places and forces of what is to be borne."""
    of = solution.set
    names = ("axial_load", "radial_load_y", "radial_load_z", "moment_y", "moment_z")
    found = [(0.0, np.array([_of(getattr(of.operation, name), k) for name in names]))]
    for each in () if of.shaft is None else of.shaft.loads:
        found.append((at(each.position), np.array([_of(value, k) for value in each.values])))
    return found


def _supports(of: qs.BearingSet) -> list[tuple[float, NDArray]]:
    """Places of a shaft's supports, once for each of their two radial springs."""
    directions = ((0.0, 1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0, 0.0))
    return [(each.position, np.array(way)) for each in (of.shaft.supports if of.shaft else ()) for way in directions]


def _springs(solution: qs.SetSolution, k: int) -> list[tuple[list[int], float]]:
    """Numbers of rows that a spring presses, from 0, and the axial force that the shaft has from all of them."""
    of = solution.set
    found = []
    sprung = [number for number, row in enumerate(of.rows) if row.sprung]
    if sprung and of.preload is not None and of.preload.spring is not None:
        found.append((sprung, of.rows[sprung[0]].sign * _of(of.preload.spring, k)))
    for group in of.floating:
        found.append(([number - 1 for number in group.rows], -_of(group.spring, k)))
    return found


def _of(value: Any, k: int) -> float:
    """Of one case, whether there is one value for all or one for each."""
    flat = np.ravel(np.asarray(0.0 if value is None else value, float))
    return float(flat[k] if flat.size > 1 else flat[0])
