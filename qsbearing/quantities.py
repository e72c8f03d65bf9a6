"""The results of a solution by name: what each is, its unit in files and pictures, and how it is read off.

A name and its unit joined are the column's name in a table: `inner_load` in N is `inner_load_N`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing import __version__
from qsbearing.columns import (
    BALL,
    CONTACT,
    DISPLACEMENT,
    GEOMETRY,
    LOAD,
    RING_SHAPE,
    RING_STATE,
    STIFFNESS,
    scene_numbers,
)
from qsbearing.scene.keys import READING_TABLES
from qsbearing.units import deg

if TYPE_CHECKING:
    import xarray

    from qsbearing.solution import Solution

_WORDS = {
    "N_per_um": "N/um",
    "Nm_per_mrad": "N m/mrad",
    "Nm": "N m",
    "Nmm": "N mm",
    "": "1",
}
STIFFNESSES = ("locked", "effective")


@dataclass(frozen=True)
class Quantity:
    """One result."""

    name: str
    unit: str
    """In files and pictures; "1" where it has none."""
    is_per_ball: bool
    read: Callable[[Solution], NDArray | None]
    """Shape (*cases) or (*cases, ball), in `unit`; None where the scene does not call for it."""

    @property
    def column(self) -> str:
        """Its name in a table, with the unit."""
        known = {shown: ending for ending, shown in _WORDS.items()}
        ending = known.get(self.unit, self.unit)
        return f"{self.name}_{ending}" if ending else self.name


def _per_ball(name: str, key: str, own: str, size: float, side: str = "") -> Quantity:
    def read(solution: Solution) -> NDArray | None:
        values = getattr(getattr(solution, side) if side else solution, own)
        return None if values is None else values / size

    return Quantity(name, _unit(key, own), True, read)


def _of_channel(kind: str, number: int, key: str, size: float) -> Quantity:
    stem, unit = _split(key)

    def read(solution: Solution) -> NDArray:
        return np.asarray(getattr(solution, kind)[..., number] / size)

    return Quantity(f"ring_{kind}_{stem}", unit, False, read)


def _of_geometry(key: str, own: str, size: float) -> Quantity:
    def read(solution: Solution) -> NDArray | None:
        if not solution.scene.is_reshaped:
            return None
        return np.broadcast_to(getattr(solution.scene.operating_bearing, own) / size, solution.shape)

    return Quantity(f"operating_{own}", _unit(key, own), False, read)


def _of_ring(side: str, key: str, own: str, size: float, what: str = "ring") -> Quantity:
    def read(solution: Solution) -> NDArray | None:
        values = getattr(getattr(solution, f"{side}_{what}"), own, None)
        return None if values is None else np.broadcast_to(values / size, solution.shape)

    return Quantity(f"{side}_{'elastic' if what == 'shape' else what}_{own}", _unit(key, own), False, read)


def _unit(key: str, name: str) -> str:
    ending = key.removeprefix(name).lstrip("_")
    return _WORDS.get(ending, ending)


def _split(key: str) -> tuple[str, str]:
    """`tilt_y_Nm_per_mrad` is tilt_y in N m/mrad."""
    for ending in ("N_per_um", "Nm_per_mrad", "um", "mrad", "Nm", "N"):
        if key.endswith(f"_{ending}"):
            return key.removesuffix(f"_{ending}"), _WORDS.get(ending, ending)
    raise ValueError(key)


def _unloaded(solution: Solution) -> NDArray:
    """Balls that have lost the inner raceway; NaN where not solved."""
    lost = (solution.inner.load == 0.0).sum(axis=-1)
    return np.where(solution.converged, lost, np.nan)


LEVEL = 1e-6
"""Relative difference of two balls' approaches below which neither is the less loaded one (chosen: far above what the
solver leaves, far below what matters)."""


def _least_loaded(solution: Solution) -> NDArray:
    """Azimuth of the ball that is first to leave the inner raceway, or farthest from it [deg]; of several the first.

    NaN where no ball is less loaded than the others, where not solved, and at rest where a ball touches no raceway.
    """
    approach = solution.inner.approach
    present = ~np.isnan(solution.azimuth)
    known = (np.isfinite(approach) | ~present).all(axis=-1)
    least = np.where(present & known[..., None], approach, np.inf).min(axis=-1)
    most = np.where(present & known[..., None], approach, -np.inf).max(axis=-1)
    margin = LEVEL * np.maximum(np.abs(least), np.abs(most))
    ball = (approach <= (least + margin)[..., None]).argmax(axis=-1)
    azimuth = np.take_along_axis(solution.azimuth, ball[..., None], -1)[..., 0]
    return np.where(known & (most - least > margin), azimuth / deg, np.nan)


def _control(solution: Solution) -> NDArray | None:
    if solution.raceway_control is None:
        return None
    return np.where(np.isnan(solution.inner.load), np.nan, solution.raceway_control == "inner")


def _all() -> dict[str, Quantity]:
    found = [
        _per_ball(f"{side}_{own}", key, own, size, side) for side in ("inner", "outer") for key, own, size in CONTACT
    ]
    found += [_per_ball(own, key, own, size) for key, own, size in BALL]
    found.append(Quantity("inner_raceway_controls", "1", True, _control))
    kinds = ("displacement", DISPLACEMENT), ("load", LOAD), *((f"{kind}_stiffness", STIFFNESS) for kind in STIFFNESSES)
    for kind, channels in kinds:
        found += [_of_channel(kind, number, key, size) for number, (key, size) in enumerate(channels)]
    found += [_of_geometry(key, own, size) for key, own, size in GEOMETRY]
    found += [_of_ring(side, key, own, size) for side in ("inner", "outer") for key, own, size in RING_STATE]
    found += [_of_ring(side, key, own, size, "shape") for side in ("inner", "outer") for key, own, size in RING_SHAPE]
    found.append(Quantity("balls_off_inner", "balls", False, _unloaded))
    found.append(Quantity("least_loaded_azimuth", "deg", False, _least_loaded))
    found.append(Quantity("azimuth", "deg", True, lambda solution: solution.azimuth / deg))
    return {each.name: each for each in found}


ALL = _all()
"""Every result that is read off a solution, by its name."""


def by_short_name(name: str, known: Iterable[str]) -> str | None:
    """The result of a reading whose name leaves out the reading: `basic_reference_rating_life` is that of `life`.

    Args:
        known: full names, such as `life_basic_reference_rating_life` and `outer_film_film_parameter`.

    Returns:
        None where there is none, or more than one.
    """
    found = {
        each
        for each in known
        for reading in READING_TABLES
        for side in ("", "inner_", "outer_")
        if each == f"{side}{reading}_{name.removeprefix(side)}" and name.startswith(side)
    }
    return found.pop() if len(found) == 1 else None


def dataset(solution: Solution) -> xarray.Dataset:
    """Everything that a solution holds, labelled; what the scene does not call for is left out.

    The scene's numbers that vary are coordinates; an axis along which one alone varies bears its name.
    """
    import xarray

    inputs = {name: values for name, values in scene_numbers(solution.scene).items() if name != "bearing"}
    dims = _case_dims(inputs, solution.shape)
    found: dict[str, Any] = {
        "status": (dims, np.asarray(solution.status, str)),
        "reason": (dims, np.asarray(solution.reason, str)),
        "iterations": (dims, np.asarray(solution.iterations)),
        "residual": (dims, np.asarray(solution.residual)),
    }
    for quantity in ALL.values():
        values = quantity.read(solution)
        if values is not None:
            own = (*dims, "ball") if quantity.is_per_ball else dims
            found[quantity.name] = (own, values, {"units": quantity.unit})
    coordinates = {}
    for name, values in inputs.items():
        axes = [axis for axis, length in enumerate(np.shape(values)[::-1]) if length > 1][::-1]
        own = tuple(dims[-1 - axis] for axis in axes)
        coordinates[name] = (own, np.squeeze(values))
    title = f"Solution of {solution.scene.bearing.name or 'a bearing'}"
    return xarray.Dataset(found, coordinates, {"title": title, "qsbearing_version": __version__})


def _case_dims(inputs: dict[str, Any], shape: tuple[int, ...]) -> tuple[str, ...]:
    """Names of the case axes: case_0, ..., or the number that alone varies along one."""
    alone: dict[int, list[str]] = {}
    for name, values in inputs.items():
        axes = [len(shape) - 1 - axis for axis, length in enumerate(np.shape(values)[::-1]) if length > 1]
        if axes:
            alone.setdefault(axes[0] if len(axes) == 1 else -1, []).append(name)
    return tuple(alone[i][0] if len(alone.get(i, [])) == 1 else f"case_{i}" for i in range(len(shape)))
