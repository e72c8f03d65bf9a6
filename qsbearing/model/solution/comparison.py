"""The numbers that people read off a solution, and how far they are from another solution's.

Each error is relative to a size that cannot vanish while the bearing carries load:

    contact load                        the largest on that raceway
    semi-axes, pressure                 the largest on that raceway; contacts that carry less than a tenth of its
                                        largest load do not count
    contact angle                       the largest on either raceway, at least one degree; of the same contacts
    displacement, tilt times dm/2       the largest of them all, at least the approach across the most loaded ball
    ring load (reactions)               the largest, moments over dm/2
    stiffness, diagonal                 its own, at least a tenth of the largest of its kind (per length, per angle)

Contacts below a tenth of the largest load, and stiffnesses below a tenth of the largest: `LIGHT`. Of a set the ring is
the shaft, dm the mean of the rows', and the balls are those of all rows.

Of several balls or channels the worst counts. The same definitions hold for what the indicators of effects predict.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.operating_point import LIGHT, SMALLEST_ANGLE

RACEWAYS = ("inner", "outer")
CONTACT = ("load", "angle", "semi_major_axis", "semi_minor_axis", "max_pressure")
RING = ("axial_displacement", "radial_displacement", "tilt")
STIFFNESS = ("axial_stiffness", "radial_stiffness", "tilt_stiffness")

GROUPS = {
    "contact_angle": ("inner_angle", "outer_angle"),
    "load": ("inner_load", "outer_load", "ring_load"),
    "pressure": tuple(f"{side}_{name}" for side in RACEWAYS for name in CONTACT[2:]),
    "displacement": RING,
    "stiffness": STIFFNESS,
}
"""The results behind each of `qsbearing.model.effects.QUANTITIES`; semi-axes go with pressures."""

Results = dict[str, NDArray]
"""Arrays (*cases, balls or channels) by name, SI."""


def read(solution: Any) -> Results:
    """The results of a scene's or set's solution; NaN in cases that are not solved and for balls that are not there."""
    displacement, load = solution.displacement, solution.load
    rows = getattr(solution, "rows", (solution,))
    for row in rows:
        row.read_at_once((*CONTACT, "approach"))
    lever = lever_of(solution)[..., None]
    tangent = np.diagonal(solution.stiffness, axis1=-2, axis2=-1)
    quantities: Results = {
        "axial_displacement": displacement[..., :1],
        "radial_displacement": displacement[..., 1:3],
        "tilt": displacement[..., 3:] * lever,
        "axial_stiffness": tangent[..., :1],
        "radial_stiffness": tangent[..., 1:3],
        "tilt_stiffness": tangent[..., 3:],
        "ring_load": np.concatenate([load[..., :3], load[..., 3:] / lever], axis=-1),
    }
    for side in RACEWAYS:
        for name in (*CONTACT, "approach"):
            of_rows = [getattr(getattr(row, side), name) for row in rows]
            quantities[f"{side}_{name}"] = np.concatenate(of_rows, axis=-1)
    quantities["approach"] = sum(np.maximum(quantities.pop(f"{side}_approach"), 0.0) for side in RACEWAYS)
    return quantities


def lever_of(solution: Any) -> NDArray:
    """dm/2, which makes tilts lengths and moments forces."""
    rows = getattr(solution, "rows", (solution,))
    pitch = np.broadcast_arrays(*(np.asarray(row.scene.bearing.pitch_diameter, float) for row in rows))
    return np.asarray(0.5 * np.mean(pitch, axis=0))


def moved(solution: Any, displacement: Any) -> NDArray:
    """By how much displacements, as those of another solution of the same cases, differ from a solution's, tilts times
    dm/2 [m]; shape (*cases)."""
    lever = lever_of(solution)[..., None]
    gap = _gap(solution.displacement, displacement)
    return np.asarray(_nan_max(np.concatenate([gap[..., :3], gap[..., 3:] * lever], axis=-1)))


def errors(approximate: Results, full: Results) -> dict[str, NDArray]:
    """Error of each result against the full one's; shape (*cases).

    NaN where the full result has no number; infinite where only the one found has none.
    """
    loads = {side: np.nan_to_num(full[f"{side}_load"]) for side in RACEWAYS}
    heavy = {side: load > LIGHT * load.max(axis=-1, keepdims=True) for side, load in loads.items()}
    turned = [np.where(heavy[side], full[f"{side}_angle"], 0.0) for side in RACEWAYS]
    angle = np.maximum(_largest(*turned), SMALLEST_ANGLE)
    sizes: dict[str, Any] = dict.fromkeys(RING, _largest(full["approach"], *(full[name] for name in RING)))
    sizes["ring_load"] = _largest(full["ring_load"])
    counted: dict[str, Any] = {}
    for side in RACEWAYS:
        for name in CONTACT:
            key = f"{side}_{name}"
            sizes[key] = angle if name == "angle" else _largest(full[key])
            counted[key] = True if name == "load" else heavy[side]
    judged = {}
    for name, size in sizes.items():
        gap = _nan_max(np.where(counted.get(name, True), _gap(approximate[name], full[name]), 0.0))
        with np.errstate(invalid="ignore", divide="ignore"):
            judged[name] = np.where(gap == 0.0, 0.0, gap / size)
    for kind in (STIFFNESS[:2], STIFFNESS[2:]):
        smallest = LIGHT * _largest(*(full[name] for name in kind))[..., None]
        for name in kind:
            size = np.maximum(np.maximum(np.abs(full[name]), smallest), np.finfo(float).tiny)
            with np.errstate(over="ignore"):  # of a stiffness that there is in one of them only
                judged[name] = _nan_max(_gap(approximate[name], full[name]) / size)
    return judged


def by_quantity(solution: Any, full: Any) -> Results:
    """Error of each quantity that people read, against another solution of the same cases; shape (*cases).

    Zero where neither is solved, infinite where one alone is.
    """
    judged = errors(read(solution), read(full))
    one, other = np.asarray(solution.converged), np.asarray(full.converged)
    unsolved = np.where(one == other, 0.0, np.inf)
    # Where friction moves balls, tilts have no stiffness, and others do.
    of_all = {name: np.fmax.reduce if name == "stiffness" else np.max for name in GROUPS}
    return {
        name: np.where(one & other, of_all[name]([judged[each] for each in members], axis=0), unsolved)
        for name, members in GROUPS.items()
    }


def largest(solution: Any, full: Any) -> NDArray:
    """Largest error of all; shape (*cases)."""
    return np.asarray(np.max(list(by_quantity(solution, full).values()), axis=0))


def _largest(*arrays: NDArray) -> NDArray:
    return np.max(np.stack([_nan_max(np.abs(array)) for array in arrays]), axis=0)


def _nan_max(array: Any) -> NDArray:
    """Largest along the last axis, missing balls passed over; NaN where all are missing."""
    known = np.where(np.isnan(array), -np.inf, array).max(axis=-1)
    return np.where(np.isneginf(known), np.nan, known)


def _gap(approximate: NDArray, full: NDArray) -> NDArray:
    """Absolute difference; infinite where only the one found has no number."""
    gap = np.abs(approximate - full)
    return np.where(np.isnan(gap) & ~np.isnan(full), np.inf, gap)
