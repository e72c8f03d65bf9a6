"""The results of a set, in groups of what has them: its rows', its shaft's, and those of what stands on the shaft.

A row also has whatever a bearing has (`GROUPS`, and its readings'); rows count from 1.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.groups import OF_PRELOAD, channels, unasked
from qsbearing.model.solution.result_keys import (
    DISPLACEMENT,
    LOAD,
    ROW,
    STIFFNESS,
    Group,
    Path,
    Result,
    in_name,
    value_at,
)
from qsbearing.systems.sets.bearing_set import places_on_shaft
from qsbearing.systems.sets.deflection import parts_of
from qsbearing.systems.sets.system_life import system_life

if TYPE_CHECKING:
    from qsbearing.systems.sets.bearing_set import BearingSet
    from qsbearing.systems.sets.set_solution import SetSolution


def _is_opposed(of: BearingSet) -> bool:
    return of.is_opposed


AXIAL_LOAD = Group((Result("axial_load", "N", path="axial_loads"),), axis=ROW, table=("rows",))
SHARE = Group(unasked(LOAD), prefix="share", holder="row_loads", axis=ROW, table=("rows", "share"))
PRELOAD = Group(
    (
        Result("given", "N", path="preload_given", entry="preload_given_N", is_usual=False),
        Result("at_rest", "N", path="preload_at_rest", entry="preload_at_rest_N"),
        Result("unmounted", "N", path="preload_unmounted", entry="preload_unmounted_N"),
        Result("mounted", "N", path="preload_mounted", entry="preload_mounted_N"),
        Result("in_operation", "N", path="preload_in_operation", entry="preload_in_operation_N"),
        Result("alone", "N", path="preload_in_operation", entry="preload_alone_N", is_usual=False),
        Result("carried", "N", path="axial_loads", entry="preload_carried_N", is_usual=False),
        Result("share", path="preload_share", entry="preload_share", is_usual=False),
    ),
    prefix="preload", axis=ROW, table=("rows",), is_requested=_is_opposed,
)  # fmt: skip
"""Of each row. `in_operation` is what is left without external loads; of a bearing it is what it carries with them."""
OF_ROWS = AXIAL_LOAD, PRELOAD, SHARE


def of_bearing(groups: Iterable[Group]) -> list[Group]:
    """Those of a bearing that a row has too: all but of a preload, which is the set's."""
    return [each for each in groups if each is not OF_PRELOAD]


def groups_of_row(groups: Iterable[Group]) -> list[Group]:
    """Of a row: its own, and those of a bearing."""
    return [*OF_ROWS, *of_bearing(groups)]


SHAFT = "shaft"
OF_SHAFT = channels(SHAFT)


def _slides(of: BearingSet) -> bool:
    return any(row.sprung for row in of.rows)


SLIDE = Group((Result("slide", "um", is_usual=False),), prefix="preload", table=("preload",), is_requested=_slides)


def _has_two_sides(of: BearingSet) -> bool:
    return any(of.is_two_sided)


class EndOfPlay(NamedTuple):
    """Where the shaft's axial play begins or ends; not a number where no row ends it."""

    end: int

    def __call__(self, solution: SetSolution) -> NDArray | None:
        """Of the cases; None without rows that stand by their middles."""
        play = solution.axial_play
        return None if play is None else np.where(np.isfinite(play), play, np.nan)[..., self.end]


PLAY = Group(
    (
        Result("from", "um", "least axial displacement of a play", path=EndOfPlay(0), is_signed=True, is_usual=False),
        Result("to", "um", "largest axial displacement of a play", path=EndOfPlay(1), is_signed=True, is_usual=False),
    ),
    prefix="axial_play", table=("axial_play",), is_requested=_has_two_sides,
)  # fmt: skip
"""From where to where a straight, centred shaft goes until rows carry it, counted as its axial displacement."""


class OfAllRows(NamedTuple):
    """The life that all rows survive together [h], from the readings of each; None unless each has its own."""

    duration: Path

    def __call__(self, readings: Sequence[dict[str, Any]]) -> NDArray | None:
        """Of the cases."""
        lives = [value_at(self.duration, of_row["life"]) for of_row in readings or () if "life" in of_row]
        if not lives or len(lives) < len(readings):
            return None
        hours = Result("duration", "h", path="")
        return np.asarray(system_life([np.asarray(hours.of(each)) for each in lives]))


SYSTEM = Group(
    tuple(
        Result(f"{name}duration", "h", path=OfAllRows(f"{name}duration"), size=1.0, entry=f"system_{name}life_h",
               aliases=(f"system_{name}life", f"system_{name}life_h"))
        for name in ("basic_", "")
    ),
    before="system", prefix="life", table=(), reading="life",
)  # fmt: skip
"""The lives of all rows together."""


class OfSupport(NamedTuple):
    """What a support of the shaft carries, by its number from 0."""

    number: int

    def __call__(self, solution: SetSolution) -> NDArray:
        """Its channels, of the cases."""
        return np.asarray(solution.support_loads[..., self.number, :])


GEAR = unasked(
    (
        Result("torque", "N m", "torque on the shaft, about +x", is_signed=True),
        Result("tangential_force", "N", "towards growing azimuth", path="tangential", is_signed=True),
        Result("radial_force", "N", "towards the axis", path="radial", is_signed=True),
        Result("axial_force", "N", "along +x", path="axial", is_signed=True),
    )
)
"""Of the mate on a gear's teeth."""
BELT = unasked(
    (
        GEAR[0],
        Result("tight_tension", "N", "tension of the tight strand", path="tight"),
        Result("slack_tension", "N", "tension of the slack strand", path="slack"),
    )
)


def _transmits(of: BearingSet) -> bool:
    return of.shaft is not None and bool(of.shaft.gears or of.shaft.belts)


TORQUES = Group(
    unasked((Result("torque_sum", "N m", "torques of gears and belts together, about +x", path="", is_signed=True),)),
    before=SHAFT, holder="torque_sum", table=(SHAFT,), is_requested=_transmits,
)  # fmt: skip


class OfDrive(NamedTuple):
    """A gear or belt of the shaft, by its number from 0: its forces, or the load that it is on the shaft."""

    kind: str
    number: int
    is_load: bool = False

    def __call__(self, solution: SetSolution) -> Any:
        """Of the cases, NaN where they are not solved as of every other result."""
        speed = solution.set.operation.speed
        drive = solution.set.shaft.standing[self.kind][self.number]  # type: ignore[union-attr]
        if not self.is_load:
            return drive.forces(speed)
        parts = np.broadcast_arrays(*(np.broadcast_to(each, solution.shape) for each in drive.load(speed)))
        return np.stack(parts, axis=-1)


GROWTH = Result("axial_growth", "um", is_signed=True)


def groups_of_set(of: BearingSet) -> list[Group]:
    """Of a set's shaft, the points and supports of this, and places along it; the lives of all rows are `SYSTEM`."""
    shaft = of.shaft
    if shaft is None:
        return [*OF_SHAFT, SLIDE, PLAY]
    parts = parts_of(of)
    points = [group for name in shaft.points for group in _of_point(name, parts)]
    line = [group for name in places_on_shaft(of) for group in _of_line(name)]
    supports = [_of_support(number) for number in range(len(shaft.supports))]
    drives = [
        group for kind in ("gear", "belt") for n in range(len(shaft.standing[kind])) for group in _of_drive(kind, n)
    ]
    return [*OF_SHAFT, *points, SLIDE, PLAY, *line, *supports, *drives, *([TORQUES] if drives else [])]


def _of_point(name: str, parts: Iterable[str]) -> list[Group]:
    table, of = ("shaft", "points", name), ("points", name)
    moved = Group(
        DISPLACEMENT, prefix=f"{name}_displacement", holder=(*of, "displacement"), table=(*table, "displacement")
    )
    kind = "effective_stiffness"
    stiff = Group(STIFFNESS, prefix=f"{name}_{kind}", holder=(*of, kind), table=(*table, kind))
    grown = Group((GROWTH,), prefix=name, holder=of, table=table)
    return [moved, grown, stiff, *(_of_part(name, part) for part in parts)]


SHARES = unasked([Result(each.name, path=each.path, direction=each.direction) for each in DISPLACEMENT])


def _always(of: BearingSet) -> bool:
    """Of every set whose shaft has what they are of."""
    return True


def _of_part(point: str, part: str) -> Group:
    """What part of the deflection at a point it is."""
    table, of = ("shaft", "points", point, "shares", part), ("points", point, "relative_shares", part)
    return Group(SHARES, prefix=f"{point}_share_{in_name(part)}", holder=of, table=table, is_requested=_always)


def _of_support(number: int) -> Group:
    table, prefix = ("shaft", "supports", str(number)), f"support_{number + 1}_load"
    return Group(unasked(LOAD), prefix=prefix, holder=OfSupport(number), table=table, is_requested=_always)


def _of_drive(kind: str, number: int) -> list[Group]:
    table, prefix = ("shaft", f"{kind}s", str(number)), f"{kind}_{number + 1}"
    own = {"gear": GEAR, "belt": BELT}[kind]
    forces = Group(own, prefix=prefix, holder=OfDrive(kind, number), table=table, is_requested=_always)
    loads = unasked(LOAD)
    on_shaft = Group(loads, prefix=f"{prefix}_load", holder=OfDrive(kind, number, True), table=(*table, "load"))
    return [forces, on_shaft._replace(is_requested=_always)]


def _grows(of: BearingSet) -> bool:
    shaft, _ = of.growth
    return shaft.is_evaluated


def _of_line(name: str) -> list[Group]:
    table, of, prefix = ("shaft", "line", name), ("line", name), f"line_{in_name(name)}"

    def group(kind: str, results: tuple[Result, ...]) -> Group:
        return Group(
            unasked(results), prefix=f"{prefix}_{kind}", holder=(*of, kind), table=(*table, kind), is_requested=_always
        )

    return [
        group("displacement", DISPLACEMENT),
        Group(unasked((GROWTH,)), prefix=prefix, holder=of, table=table, is_requested=_grows),
        group("inner_forces", LOAD),
    ]
