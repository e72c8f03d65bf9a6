"""The shaft of a set with its rows and supports as a rotor of ROSS."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.validation import ErrorDetail, SceneError
from qsbearing.systems.rotor_dynamics import ross_rotor
from qsbearing.systems.rotor_dynamics.ross_rotor import Holder, RotorSection
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.rigid_shaft import SLIDE, UNKNOWNS


def rotor(of: BearingSet, held: NDArray, disks: Sequence[dict[str, Any]], longest: float) -> Any:
    """The rotor.

    Args:
        held: what `held_by` gives, by cases; shape (row, *cases, 5, 5).
        disks, longest: as for `SetSolution.to_ross_rotor`.

    Raises:
        SceneError: there is no shaft.
    """
    shaft = of.shaft
    if shaft is None or not shaft.sections:
        raise SceneError([ErrorDetail("shaft", "missing", detail="the rotor is made of its sections")])
    sections = [
        RotorSection(begin, end, each.outer_diameters, each.inner_diameters, each.material)
        for (begin, end), each in zip(pairwise(map(float, shaft.ends)), shaft.sections, strict=True)
    ]
    rows = enumerate(zip(of.rows, held, strict=True), 1)
    holders = [Holder(float(np.asarray(row.position)), own, f"row {number}") for number, (row, own) in rows]
    supports = enumerate(shaft.supports, 1)
    holders += [Holder(each.position, each.stiffness, f"support {number}") for number, each in supports]
    places = [*shaft.points.values(), *(load.position for load in of.shaft_loads)]
    speed = np.broadcast_to(np.asarray(of.operation.speed, float), held.shape[1:-2])
    inertia = {"m": "mass", "Ip": "polar_inertia", "Id": "diametral_inertia"}
    masses = [
        {"position": each.position, **{name: float(np.asarray(getattr(each, of))) for name, of in inertia.items()}}
        for each in shaft.masses
    ]
    return ross_rotor.rotor(sections, holders, speed, places, [*masses, *disks], longest)


def rotor_of(solution: Any, turned: NDArray, given: NDArray, disks: Sequence[dict[str, Any]], longest: float) -> Any:
    """What `SetSolution.to_ross_rotor` gives, which says what `disks` and `longest` are.

    Args:
        turned, given: as for `held_by`.
    """
    if len(solution.shape) > 1:
        problem = "has several axes of cases; one is wanted, that of speed"
        raise SceneError([ErrorDetail("shape", problem, solution.shape)])
    if not np.all(solution.converged):
        raise SceneError([ErrorDetail("status", "not all cases are solved", cause="solution.message() says why")])
    own = np.stack([row.stiffness.reshape(-1, 5, 5) for row in solution.rows])
    held = held_by(solution.set, own, turned, given)
    return rotor(solution.set, held.reshape(len(solution.rows), *solution.shape, 5, 5), disks, longest)


def held_by(of: BearingSet, own: NDArray, turned: NDArray, given: NDArray) -> NDArray:
    """Stiffness with which each row holds its place on the shaft; shape (row, case, 5, 5).

    Args:
        own: stiffness of the rows; shape (row, case, 5, 5).
        turned: the matrices that turn the shaft's axes into the row's.
        given: which unknowns are given, rings at what holds them among them; shape (case, unknown).
    """
    held: NDArray = turned.swapaxes(2, 3) @ own @ turned
    for number, row in enumerate(of.rows):
        if row.housing_stiffness is not None:
            softening = np.eye(5) + row.housing_stiffness.compliance @ held[number]
            held[number] = held[number] @ np.linalg.inv(softening)
    sleeves = [(list(sleeve), ~given[:, column]) for column, sleeve in enumerate(of.sleeves, UNKNOWNS)]
    sleeves += [([number for number, row in enumerate(of.rows) if row.sprung], ~given[:, SLIDE])]
    for sleeve, slides in sleeves:
        if not sleeve:
            continue
        along = held[sleeve][..., 0]
        total = along[..., 0].sum(axis=0)
        with np.errstate(invalid="ignore"):  # an unloaded row of a sleeve that slides
            less = along[..., :, None] * held[sleeve][..., 0, None, :] / total[..., None, None]
        held[sleeve] -= np.where(slides[:, None, None], less, 0.0)
    return held
