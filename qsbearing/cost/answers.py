"""The numbers that people read off a solution, and how far they are from another solution's.

Each error is relative to a size that cannot vanish while the bearing carries load:

    contact load                        the largest on that raceway
    semi-axes, pressure                 the largest on that raceway; contacts that carry less than a tenth of its
                                        largest load do not count
    contact angle                       the largest on either raceway, at least one degree; of the same contacts
    displacement, tilt times dm/2       the largest of them all, at least the approach across the most loaded ball
    ring load (reactions)               the largest, moments over dm/2
    stiffness, diagonal                 its own, at least a tenth of the largest of its kind (per length, per angle)

Of several balls or channels the worst counts. The *accuracy* of an answer is the worst of all of these.
"""

from __future__ import annotations

from math import radians
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.solution import stiffness

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from qsbearing.scene import Scene
    from qsbearing.solution import Solution

LIGHT = 0.1
"""Of contacts that carry less than this part of the largest load only the load is judged; stiffnesses below this part
of the largest are judged against that part."""

SMALLEST_ANGLE = radians(1.0)
"""Contact angles below it are judged as if they were this large [rad]."""

RACEWAYS = ("inner", "outer")
CONTACT = ("load", "angle", "semi_major_axis", "semi_minor_axis", "max_pressure")
RING = ("axial_displacement", "radial_displacement", "tilt")
STIFFNESS = ("axial_stiffness", "radial_stiffness", "tilt_stiffness")
NAMES = (*RING, *(f"{side}_{name}" for side in RACEWAYS for name in CONTACT), *STIFFNESS, "ring_load")
"""Every answer judged."""

GROUPS = {
    "displacements": RING,
    "loads and angles": ("inner_load", "inner_angle", "outer_load", "outer_angle", "ring_load"),
    "semi-axes and pressures": tuple(f"{side}_{name}" for side in RACEWAYS for name in CONTACT[2:]),
    "stiffness": STIFFNESS,
}
"""Answers that err alike."""

Answers = dict[str, "NDArray | None"]
"""Arrays (*cases, balls or channels) by name, SI; None for what a fidelity does not give."""


def read(scene: Scene, solution: Solution) -> Answers:
    """The answers of a solution; NaN in cases that are not solved and for balls that are not there."""
    displacement, load = solution.displacement, solution.load
    lever = 0.5 * np.asarray(scene.bearing.pitch_diameter, float)[..., None]
    tangent = np.diagonal(stiffness(scene, solution), axis1=-2, axis2=-1)
    answers: Answers = {
        "axial_displacement": displacement[..., :1],
        "radial_displacement": displacement[..., 1:3],
        "tilt": displacement[..., 3:] * lever,
        "axial_stiffness": tangent[..., :1],
        "radial_stiffness": tangent[..., 1:3],
        "tilt_stiffness": tangent[..., 3:],
        "ring_load": np.concatenate([load[..., :3], load[..., 3:] / lever], axis=-1),
        "approach": np.maximum(solution.inner.approach, 0.0) + np.maximum(solution.outer.approach, 0.0),
    }
    for side in RACEWAYS:
        for name in CONTACT:
            answers[f"{side}_{name}"] = getattr(getattr(solution, side), name)
    return answers


def errors(found: Answers, full: Answers) -> dict[str, NDArray | None]:
    """Error of each answer against the full one's; shape (*cases), None for what was not given.

    NaN where the full answer has no number; infinite where only the one found has none.
    """
    length = _largest(full["approach"], *(full[name] for name in RING))
    judged: dict[str, NDArray | None] = {}
    for name in RING:
        judged[name] = _worst(found[name], full[name], length)
    judged["ring_load"] = _worst(found["ring_load"], full["ring_load"], _largest(full["ring_load"]))
    heavy = {side: _is_heavy(full[f"{side}_load"]) for side in RACEWAYS}
    turned = [np.where(heavy[side], _given(full[f"{side}_angle"]), 0.0) for side in RACEWAYS]
    angle = np.maximum(_largest(*turned), SMALLEST_ANGLE)
    for side in RACEWAYS:
        for name in CONTACT:
            key = f"{side}_{name}"
            size = angle if name == "angle" else _largest(full[key])
            judged[key] = _worst(found[key], full[key], size, None if name == "load" else heavy[side])
    sizes = {"tilt_stiffness": _largest(full["tilt_stiffness"])}
    sizes["axial_stiffness"] = sizes["radial_stiffness"] = _largest(full["axial_stiffness"], full["radial_stiffness"])
    for name in STIFFNESS:
        own = full[name]
        size = None if own is None else np.maximum(np.abs(own), LIGHT * sizes[name][..., None])
        judged[name] = None if found[name] is None or size is None else _nan_max(_gap(found[name], own) / size)
    return judged


def accuracy(judged: dict[str, NDArray | None], names: tuple[str, ...] = NAMES) -> NDArray:
    """The worst error of all; shape (*cases)."""
    given = [judged[name] for name in names if judged.get(name) is not None]
    return np.max(np.stack(np.broadcast_arrays(*given)), axis=0)  # type: ignore[arg-type]


def _largest(*arrays: NDArray | None) -> NDArray:
    return np.max(np.stack([_nan_max(np.abs(array)) for array in arrays if array is not None]), axis=0)


def _nan_max(array: Any) -> NDArray:
    """Largest along the last axis, missing balls passed over; NaN where all are missing."""
    known = np.where(np.isnan(array), -np.inf, array).max(axis=-1)
    return np.where(np.isneginf(known), np.nan, known)


def _is_heavy(load: NDArray | None) -> NDArray:
    known = np.nan_to_num(_given(load))
    return known > LIGHT * known.max(axis=-1, keepdims=True)


def _given(array: NDArray | None) -> NDArray:
    """What the full answer always has."""
    assert array is not None
    return array


def _gap(found: NDArray | None, full: NDArray | None) -> NDArray:
    """Absolute difference; infinite where only the one found has no number."""
    assert found is not None and full is not None
    gap = np.abs(found - full)
    return np.where(np.isnan(gap) & ~np.isnan(full), np.inf, gap)


def _worst(found: NDArray | None, full: NDArray | None, size: NDArray, counted: NDArray | None = None) -> Any:
    if found is None or full is None:
        return None
    gap = _gap(found, full)
    if counted is not None:
        gap = np.where(counted, gap, 0.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(_nan_max(gap) == 0.0, 0.0, _nan_max(gap) / size)
