"""How rows are held along the shaft: which stand by the plane of both grooves, whose outer rings slide, and the play.

A deep-groove row carries on either side of its middle. Where no preload presses it to one side, its place is the plane
of both grooves, and it takes axial load from either side unless its outer ring slides:

    both        located: the outer ring is held;
    +x, -x      held against one side only, as by one shoulder of the housing or one cover: the ring follows the shaft
                where the row would be pulled away from there. Two such rows locate a shaft together (cross location);
    none        floating: the outer ring slides, and the row carries no axial load.

At rest a row's energy is convex on both sides of its middle, and with a ring that slides it is the least over the
ring's place, convex too: the shaft's equilibrium is one point, or all of a play in which nothing holds it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.bearing import BearingKind
from qsbearing.systems.sets.row import ONE_WAY, Direction

LOCATED = {Direction.BOTH: "located", Direction.NONE: "floating"}
"""In words, of deep-groove rows that stand by their middle planes."""


def two_sided(of: Any) -> tuple[bool, ...]:
    """Of each row of a `BearingSet`, whether it stands by the plane of both grooves."""
    pressed = _pressed(of)
    return tuple(
        is_deep_groove(row)
        and not (number in pressed and row.carries in ONE_WAY if row.is_from_contact is None else row.is_from_contact)
        for number, row in enumerate(of.rows)
    )


def is_deep_groove(row: Any) -> bool:
    """Whether it has shoulders on both sides; not what is no bearing."""
    return getattr(row.bearing, "kind", None) is BearingKind.DEEP_GROOVE


def _pressed(of: Any) -> set[int]:
    """Numbers of the rows that a preload presses: those of its group that say in which direction."""
    preloaded = {number for group, preload in of.groups if preload is not None for number in group}
    return preloaded | {number for number, row in enumerate(of.rows) if row.sprung}


def sliding(of: Any) -> tuple[int, ...]:
    """Numbers of the rows, from 0, whose own outer rings slide, always or away from what holds them."""
    return tuple(n for n, row in enumerate(of.rows) if of.is_two_sided[n] and row.carries != Direction.BOTH)


def sleeves(of: Any) -> tuple[tuple[int, ...], ...]:
    """Numbers of the rows, from 0, that slide along the housing together: those of each floating group, then each ring
    that slides by itself."""
    groups = (tuple(number - 1 for number in group.rows) for group in of.floating)
    return (*groups, *((number,) for number in sliding(of)))


def carried(row: Any) -> tuple[float, ...]:
    """The signs of the axial loads on the shaft that a row carries."""
    return {Direction.BOTH: (1.0, -1.0), Direction.NONE: ()}.get(row.carries, (row.sign,))


def usual(row: Any) -> Direction:
    """The direction of a row that says none."""
    if row.carries is not None:
        return Direction(row.carries)
    return Direction.BOTH if is_deep_groove(row) else Direction.PLUS


def in_words(of: Any) -> str:
    """How a set with rows that stand by their middle planes is located, from the least x to the largest."""
    order = sorted(range(len(of.rows)), key=lambda number: float(np.ravel(of.rows[number].position)[0]))
    ways = [of.rows[number].carries for number in order]
    names = {
        (Direction.BOTH, Direction.NONE): "locating and floating",
        (Direction.NONE, Direction.BOTH): "floating and locating",
        (Direction.PLUS, Direction.MINUS): "cross location, each row from inside",
        (Direction.MINUS, Direction.PLUS): "cross location, each row from outside",
    }
    if len(ways) == 2 and all(of.is_two_sided) and tuple(ways) in names:
        return names[tuple(ways)]
    return ", ".join(
        LOCATED.get(way, f"held in {way}" if of.is_two_sided[number] else str(way))
        for way, number in zip(ways, order, strict=True)
    )


def touching(cases: NDArray) -> NDArray:
    """How far from the plane of both grooves a row of case records touches, in operation; shape (row, case) [m]."""
    span = cases["length"] * (cases["inner_coefficient"] + cases["outer_coefficient"] - 1.0)
    return np.asarray(span * cases["sin_free"])


def play(of: Any, cases: NDArray, offsets: NDArray) -> NDArray:
    """How far the shaft, straight and centred, goes in -x and in +x from its zero until a row carries it.

    As at rest: balls that are thrown outward push softly from 0.7 of the way on, where they leave the middle.

    Args:
        cases: case records, (row, case); offsets: from where a row touches in operation, likewise [m].

    Returns:
        (from, to) of each case, shape (case, 2) [m]; infinite where no row carries. From is beyond to where rows press
        each other: by so much.
    """
    low, high = np.full(cases.shape[1], -np.inf), np.full(cases.shape[1], np.inf)
    apart = 2.0 * touching(cases)
    away = {number - 1 for group in of.floating for number in group.rows}
    for number, row in enumerate(of.rows):
        if number in away or row.sprung:
            continue
        for way in carried(row):
            reach = -offsets[number] if way == row.sign else -offsets[number] - apart[number]
            if way > 0.0:
                high = np.minimum(high, reach)
            else:
                low = np.maximum(low, -reach if row.sign < 0.0 else reach)
    return np.stack([low, high], axis=-1)


def opposes(of: Any, group: tuple[int, ...]) -> bool:
    """Whether rows of a group that are pressed to one side carry in both directions."""
    return len({of.rows[number].sign for number in group if not of.is_two_sided[number]}) == 2
