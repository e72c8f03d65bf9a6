"""What must not change a solution: the same scene of another size, mirrored, turned, its effects in another order, or
as warm all through, which makes a larger bearing.

Each twin is solved anew, from its own starts, and its solution taken back. Equations that hold for one hold for the
other, so that where both converge and still differ, there are two equilibria, or a length that does not follow.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from tests.verification.campaign.checks import GAP
from tests.verification.campaign.group import DISPLACEMENT_KEYS, LOAD_KEYS, Group

SIZES = (0.9, 0.7, 1.05, 1.3, 1.7)
"""Of scaled twins: no powers of two, so that every number is rounded anew. The first is a campaign's; the others are to
tell a scene that has several equilibria from one that has another when warm."""
WARMER = 60.0
"""Kelvin."""
EXPANSION = 12e-6
"""Per kelvin, of every body: as warm all through, a bearing of one material stays itself."""

Tables = dict[str, NDArray]


@dataclass(frozen=True)
class Twin:
    """A group whose solution follows from another's, and how it is taken back to that one."""

    of: Group
    """The group itself, or what of it has such a twin."""
    group: Group
    size: float = 1.0
    """Of its lengths over the other's; loads go with the square."""
    ball: NDArray | None = None
    """Which of its balls is each of the other's (case, ball); None: the same."""
    turn: NDArray | None = None
    """(case, 2, 2), by which y and z of its displacement are taken back; tilts likewise."""


def changed(group: Group, change: Callable[[str, NDArray], NDArray]) -> Group:
    """The group with every number changed by its key."""

    def all_of(table: Tables) -> Tables:
        return {key: change(key, value) for key, value in table.items()}

    more = {name: all_of(table) for name, table in group.more.items()}
    return replace(group, bearing=all_of(group.bearing), operation=all_of(group.operation), more=more)


def scaled(group: Group, size: float = SIZES[0]) -> Twin:
    """All lengths larger; pressures, densities, angles and surface speeds the same."""
    powers = {"_mm": 1, "_um": 1, "_N": 2, "_Nm": 3, "_rpm": -1}

    def change(key: str, value: NDArray) -> NDArray:
        return value * size ** next((power for unit, power in powers.items() if key.endswith(unit)), 0)

    return Twin(group, changed(group, change), size)


def mirrored(group: Group) -> Twin:
    """In the plane of x and y: what is along z and about y turns round, and so do the rings; balls come backwards."""
    reversed_ = (LOAD_KEYS[2], DISPLACEMENT_KEYS[2], LOAD_KEYS[3], DISPLACEMENT_KEYS[3], "first_ball_azimuth_deg")
    ball = -np.arange(int(group.bearing["ball_count"].max())) % group.bearing["ball_count"].astype(int)[:, None]

    def change(key: str, value: NDArray) -> NDArray:
        if key == "ball_diameter_deviations_um":
            return np.take_along_axis(value, ball, axis=-1)
        return -value if key in reversed_ or key.endswith("speed_rpm") else value

    turn = np.array([[[1.0, 0.0], [0.0, -1.0]]])
    return Twin(group, changed(group, change), ball=ball, turn=turn)


def turned(group: Group) -> Twin:
    """Loads by one pitch, which leaves the balls to each other; with channels held otherwise along y than along z
    everything by a quarter turn."""
    balls = np.arange(int(group.bearing["ball_count"].max()))
    count = group.bearing["ball_count"].astype(int)[:, None]
    is_quarter = group.held[1] != group.held[2] or group.held[3] != group.held[4]
    angle = np.full(group.size, 0.5 * np.pi) if is_quarter else 2.0 * np.pi / group.bearing["ball_count"]
    cosine, sine = np.round(np.cos(angle), 17 if is_quarter else 99), np.sin(angle)
    operation = {
        key: value for key, value in group.operation.items() if key not in (*LOAD_KEYS[1:], *DISPLACEMENT_KEYS[1:])
    }
    held = list(group.held)
    for y, z in ((1, 2), (3, 4)):
        along_y, along_z = (group.operation[(DISPLACEMENT_KEYS if group.held[c] else LOAD_KEYS)[c]] for c in (y, z))
        if is_quarter:
            held[y], held[z] = group.held[z], group.held[y]
            along_y, along_z = -along_z, along_y
        else:
            along_y, along_z = cosine * along_y - sine * along_z, sine * along_y + cosine * along_z
        for c, value in ((y, along_y), (z, along_z)):
            operation[(DISPLACEMENT_KEYS if held[c] else LOAD_KEYS)[c]] = value
    more, ball = group.more, None
    if is_quarter:
        first = operation["first_ball_azimuth_deg"] + 90.0
        operation["first_ball_azimuth_deg"] = np.where(first > 360.0, first - 360.0, first)
        cosine = np.zeros(group.size)
    else:
        ball = (balls + 1) % count
        deviations = group.more.get("effects", {}).get("ball_diameter_deviations_um")
        if deviations is not None:
            rolled = {"ball_diameter_deviations_um": np.roll(deviations, 1, axis=-1)}
            more = group.more | {"effects": group.more["effects"] | rolled}
    twin = replace(group, operation=operation, held=tuple(held), more=more)
    turn = np.stack([np.stack([cosine, sine], axis=-1), np.stack([-sine, cosine], axis=-1)], axis=-2)
    return Twin(group, twin, ball=ball, turn=turn)


def reordered(group: Group) -> Twin | None:
    """Ball effects the other way round."""
    return Twin(group, replace(group, effects=group.effects[::-1])) if len(group.effects) > 1 else None


def warmed(group: Group) -> Twin | None:
    """As warm all through, of one coefficient of expansion: larger by that. Balls keep their mass, so that the square
    of the speed grows with the size; what is said of the cold bearing, fits and a held preload, stays."""
    if "ring_expansion" not in group.more:
        return None
    size = 1.0 + EXPANSION * WARMER
    powers = {"_um": 1.0, "_N": 2.0, "_Nm": 3.0, "_rpm": 0.5}
    steel = {
        side: {**table, "thermal_expansion_per_K": np.full(group.size, EXPANSION)}
        for side, table in group.materials.items()
    }

    def cold(key: str, value: NDArray) -> NDArray:
        return np.full(group.size, 20.0) if key.endswith("_C") else value

    def grown(key: str, value: NDArray) -> NDArray:
        if key == "ball_diameter_deviations_um":  # of cold balls
            return value
        return value * size ** next((power for unit, power in powers.items() if key.endswith(unit)), 0)

    of = changed(replace(group, materials=steel), cold)
    growing = {name: of.more[name] for name in ("ring_expansion", "ball_expansion")}
    warm = {
        name: {key: value + WARMER * key.endswith("_C") for key, value in table.items()}
        for name, table in growing.items()
    }
    twin = changed(of, grown)
    preload = of.more.get("preload", {})
    if "spring_N" not in preload and preload:
        twin = replace(twin, more=twin.more | {"preload": preload})
    return Twin(of, replace(twin, more=twin.more | warm), size)


TWINS = {"scaled": scaled, "mirrored": mirrored, "turned": turned, "reordered": reordered, "warmed": warmed}


@dataclass(frozen=True)
class Compared:
    """A twin's solution beside the group's; arrays have shape (case,)."""

    both: NDArray
    """Whether both converged."""
    either: NDArray
    """Whether only one did."""
    difference: NDArray
    """Largest of any ball's load over the largest load, of any loaded ball's angle, and of the displacement over the
    distance of the groove centres; of loads what rounding of positions cannot make."""


def compare(twin: Twin, solution: qs.Solution, other: qs.Solution) -> Compared:
    """A group's solution beside that of its twin."""
    of = twin.of.bearing
    distance = 1e-3 * (of["inner_groove_radius_mm"] + of["outer_groove_radius_mm"] - of["ball_diameter_mm"])

    def back(values: NDArray) -> NDArray:
        return values if twin.ball is None else np.take_along_axis(values, twin.ball, axis=-1)

    lever = 0.5e-3 * of["pitch_diameter_mm"][:, None]
    arms = np.concatenate([np.ones_like(lever)] * 3 + [lever] * 2, axis=-1)
    # Both solutions' lines close, to GAP, a chain of grooves and displacements whose lengths are themselves rounded; an
    # approach is what is left of that chain. So loads are known to K ((delta + e)^1.5 - delta^1.5) only: all digits of
    # micrometres, but of a load of nanonewtons some, and of contacts lighter than that none.
    chain = distance + 1e-3 * of["ball_diameter_mm"] + (np.abs(solution.displacement) * arms).max(axis=-1)
    rounding = 2.0 * GAP * chain[:, None]
    largest = np.nanmax(np.maximum(solution.inner.load, solution.outer.load), axis=-1, keepdims=True, initial=0.0)
    largest = np.where(largest > 0.0, largest, 1.0)
    difference = np.zeros(solution.shape)
    for side in ("inner", "outer"):
        mine, its = getattr(solution, side), getattr(other, side)
        load, its_load = mine.load, back(its.load) / twin.size**2
        pressed = np.maximum(np.nan_to_num(mine.approach, nan=0.0), 0.0)
        stiffness = np.where(load > 0.0, load / np.where(load > 0.0, pressed, 1.0) ** 1.5, 0.0).max(axis=-1)[:, None]
        known = stiffness * ((pressed + rounding) ** 1.5 - pressed**1.5)
        turn = np.where(load > 0.0, np.abs(np.sin(0.5 * (mine.angle - back(its.angle)))) * load, 0.0)
        worst = np.nan_to_num(np.maximum(np.abs(load - its_load) - known, turn) / largest)
        difference = np.maximum(difference, worst.max(axis=-1))
    moved = other.displacement / np.array([twin.size] * 3 + [1.0] * 2)
    if twin.turn is not None:
        moved[:, 1:3] = np.einsum("...ij,...j->...i", twin.turn, moved[:, 1:3])
        sign = np.linalg.det(twin.turn)[..., None]  # tilts are axial vectors
        moved[:, 3:] = sign * np.einsum("...ij,...j->...i", twin.turn, moved[:, 3:])
    apart = (np.abs(moved - solution.displacement) * arms).max(axis=-1) / distance
    both = solution.converged & other.converged
    return Compared(both, solution.converged ^ other.converged, np.where(both, np.maximum(difference, apart), 0.0))
