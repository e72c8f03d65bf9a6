"""The results of a solution by name: what each is, its unit in files and pictures, and how it is read off.

The column's name in a table has the unit behind it: `inner_load` in N is `inner_load_N`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.operating_point import Solved
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.result_keys import (
    BALL,
    CONTACT,
    DISPLACEMENT,
    GEOMETRY,
    LOAD,
    NODES,
    RING_SHAPE,
    RING_STATE,
    STIFFNESS,
    Shown,
    attributes,
    split,
)
from qsbearing.model.units import deg, zero_celsius


class Solution(Solved, Protocol):
    """What is read here and in `columns` of a solution, which lies above: its methods call what is here."""

    scene: Scene
    thermal: Any

    @property
    def stiffness(self) -> NDArray: ...
    @property
    def gyroscopic_moment(self) -> NDArray | None: ...
    @property
    def slips(self) -> NDArray | None: ...
    @property
    def status(self) -> Any: ...
    @property
    def reason(self) -> Any: ...
    @property
    def iterations(self) -> Any: ...
    @property
    def residual(self) -> Any: ...
    @property
    def preload_at_rest(self) -> Any: ...


STIFFNESSES = ("locked", "effective")


@dataclass(frozen=True)
class Quantity:
    """One result."""

    name: str
    unit: str
    """In files and pictures; "1" where it has none."""
    column: str
    """Its name in a table, with the unit."""
    is_per_ball: bool
    read: Callable[[Solution], NDArray | None]
    """Shape (*cases) or (*cases, ball), in `unit`; None where the scene does not call for it."""
    is_column: bool = True
    """Whether tables have it; else it follows from what they have."""
    symbol: str = ""
    source: str = ""
    is_signed: bool = False
    """As of `Shown`."""
    ring: tuple[str, str, str] | None = None
    """Of a channel of the ring: what of it (displacement, load, ...), and name and column without "ring_"."""

    @property
    def attributes(self) -> dict[str, str]:
        """What datasets say of it."""
        return attributes(self.unit, self.name.replace("_", " "), self.symbol, self.source)


def _quantity(prefix: str, of: str | Shown, is_per_ball: bool, read: Callable[[Solution], NDArray | None]) -> Quantity:
    shown = of if isinstance(of, Shown) else Shown(of, "")
    (name, unit), column = split(shown.key), f"{prefix}{shown.key}"
    about = shown.symbol, shown.source, shown.is_signed
    return Quantity(f"{prefix}{name}", unit, column, is_per_ball, read, True, *about)


def _of_case(prefix: str, shown: Shown, holder: Callable[[Solution], Any]) -> Quantity:
    def read(solution: Solution) -> NDArray | None:
        values = shown.of(holder(solution))
        return None if values is None else np.broadcast_to(values, solution.shape)

    return _quantity(prefix, shown, False, read)


def _reshaped(solution: Solution) -> Any:
    return solution.scene.operating_bearing if solution.scene.is_reshaped else None


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


def _node_temperature(solution: Solution, node: str) -> NDArray | None:
    if solution.thermal is None or node not in solution.thermal.temperatures:
        return None
    return solution.thermal.temperatures[node] - zero_celsius


def _steady_friction(solution: Solution) -> NDArray | None:
    return None if solution.thermal is None else np.asarray(sum(solution.thermal.powers.values()))


def _control(solution: Solution) -> NDArray | None:
    if solution.raceway_control is None:
        return None
    return np.where(np.isnan(solution.inner.load), np.nan, solution.raceway_control == "inner")


def _all() -> dict[str, Quantity]:
    sides = "inner", "outer"
    found = [
        _quantity(f"{side}_", shown, True, lambda solution, side=side, of=shown.of: of(getattr(solution, side)))  # type: ignore[misc]
        for side in sides
        for shown in CONTACT
    ]
    found += [_quantity("", shown, True, shown.of) for shown in BALL]
    found.append(Quantity("inner_raceway_controls", "1", "inner_raceway_controls", True, _control, False))
    kinds = ("displacement", DISPLACEMENT), ("load", LOAD), *((f"{kind}_stiffness", STIFFNESS) for kind in STIFFNESSES)
    for kind, channels in kinds:
        for number, (key, size) in enumerate(channels):
            values, own = attrgetter(kind), f"{kind}_"
            of_shaft = _quantity(own, key, False, lambda it, of=values, n=number, size=size: of(it)[..., n] / size)  # type: ignore[misc]
            names = of_shaft.name, of_shaft.column
            found.append(replace(of_shaft, name=f"ring_{names[0]}", column=f"ring_{names[1]}", ring=(kind, *names)))
    found += [_of_case("operating_", shown, _reshaped) for shown in GEOMETRY]
    found += [_of_case(f"{side}_ring_", shown, attrgetter(f"{side}_ring")) for side in sides for shown in RING_STATE]
    found += [
        _of_case(f"{side}_elastic_", shown, attrgetter(f"{side}_shape")) for side in sides for shown in RING_SHAPE
    ]
    found += [
        _quantity("steady_", f"{node}_temperature_C", False, lambda it, node=node: _node_temperature(it, node))  # type: ignore[misc]
        for node in NODES
    ]
    found.append(_quantity("steady_", "friction_W", False, _steady_friction))
    found.append(Quantity("balls_off_inner", "balls", "balls_off_inner_balls", False, _unloaded, False))
    found.append(Quantity("least_loaded_azimuth", "deg", "least_loaded_azimuth_deg", False, _least_loaded, False))
    found.append(Quantity("azimuth", "deg", "azimuth_deg", True, lambda solution: solution.azimuth / deg, False))
    return {each.name: each for each in found}


ALL = _all()
"""Every result that is read off a solution, by its name."""
