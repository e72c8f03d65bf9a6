"""How heat and spacers move rows along the shaft and in the housing, and what that presses them by.

Inner rings move with the shaft, outer ones with the housing, both counted from the reference position. A body grows by
alpha dT of its sections where it has a temperature of its own, else by that which ring expansion gives it at the rows.
Between two rows with a spacer, the spacer's length grows as the spacer, and the rest as the body; by as much as the
inner spacer is longer than the outer, the inner rings are further apart than the outer ones.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.effects import RingExpansion
from qsbearing.sets.bearing_set import BearingSet, Row
from qsbearing.sets.shaft import REFERENCE_TEMPERATURE, Shaft, Spacer

SHAFT, HOUSING = 0, 1
"""Bodies that bearings are on and in."""
SIDES = ("inner", "outer")
BODIES = ("shaft", "housing")


def offset_in_operation(of: BearingSet, number: int, offset: NDArray) -> NDArray:
    """How far a row is pressed together while the shaft is at its zero, and as warm as it is in operation [m].

    What its offset was grows as the shaft. Inner rings move with the shaft, outer ones with the housing, both from the
    reference position.
    """
    row = of.rows[number]
    strain = seat_strains(of, row)[SHAFT]
    apart = growth_along(of, row.position, SHAFT) - growth_along(of, row.position, HOUSING)
    return np.asarray(offset * (1.0 + strain) + row.sign * apart)


def growth_along(of: BearingSet, position: ArrayLike, body: int) -> NDArray:
    """By how much heat and spacers move a place in +x on the shaft or in the housing, counted from the reference
    position [m]."""
    total = _growth(of, position, body)
    for spacer in of.spacers:
        first, last = (np.asarray(of.rows[number - 1].position, float) for number in spacer.rows)
        middle, x = 0.5 * (first + last), np.asarray(position, float)
        beyond = (x >= middle).astype(float) - (of.reference >= middle)
        total = total + beyond * _longer(of, spacer, first, last, body)
    return total


def _longer(of: BearingSet, spacer: Spacer, first: NDArray, last: NDArray, body: int) -> Any:
    """By how much a spacer parts its rows further than the body alone would [m]."""
    length = getattr(spacer, f"{SIDES[body]}_length")
    if length is None:
        return 0.0
    mean = (_growth(of, last, body) - _growth(of, first, body)) / (last - first)
    own = getattr(spacer, f"{SIDES[body]}_temperature")
    given = of.shaft if body == SHAFT else of.housing
    datum = REFERENCE_TEMPERATURE if given is None else given.reference_temperature
    warmer = _warmth(of, spacer, body) if own is None else np.asarray(own, float) - datum
    expands = getattr(spacer, f"{SIDES[body]}_material").thermal_expansion
    strain = 0.0 if expands is None else np.asarray(expands, float) * warmer
    more = np.asarray(length, float) * (strain - mean)
    if body == SHAFT and spacer.outer_length is not None:
        more = more + np.asarray(spacer.inner_length, float) - np.asarray(spacer.outer_length, float)
    return more


def _warmth(of: BearingSet, spacer: Spacer, body: int) -> Any:
    """How much warmer the body is at a spacer than at the reference temperature [K]."""
    given = of.shaft if body == SHAFT else of.housing
    if given is not None and given.temperature is not None:
        return np.asarray(given.temperature, float) - given.reference_temperature
    rings = [expansion(of, of.rows[number - 1]) for number in spacer.rows]
    known = [ring.temperatures[BODIES[body]].value - ring.reference_temperature for ring in rings if ring is not None]
    return 0.0 if not known else sum(known) / len(known)


def _growth(of: BearingSet, position: ArrayLike, body: int) -> NDArray:
    """Of the body itself: by its sections, or its one strain; else between two rows by the mean of the strains that
    ring expansion has there, beyond the outermost by that there."""
    if body == SHAFT and of.shaft is not None and of.shaft.temperature is not None:
        return _growth_of_sections(of.shaft, of.reference, np.asarray(position, float))
    if body == HOUSING and of.housing is not None and of.housing.temperature is not None:
        return np.asarray(of.housing.strain * (np.asarray(position, float) - of.reference))
    if all(expansion(of, row) is None for row in of.rows):
        return np.zeros(())
    positions, heats = zip(*((row.position, seat_strains(of, row)[body]) for row in of.rows), strict=True)
    numbers = np.array(np.broadcast_arrays(of.reference, position, *positions, *heats), float)
    (reference, place), places, strains = numbers[:2], numbers[2 : len(of.rows) + 2], numbers[len(of.rows) + 2 :]
    order = np.argsort(places, axis=0)
    places, strains = (np.take_along_axis(each, order, 0) for each in (places, strains))
    between = np.concatenate([strains[:1], 0.5 * (strains[1:] + strains[:-1]), strains[-1:]])
    beyond = np.full_like(places[:1], np.inf)
    low, high = np.concatenate([-beyond, places]), np.concatenate([places, beyond])
    return np.asarray((between * (np.clip(place, low, high) - np.clip(reference, low, high))).sum(axis=0))


def _growth_of_sections(shaft: Shaft, reference: NDArray, position: NDArray) -> NDArray:
    """Between the reference and a position, each section by its own strain."""
    ends = shaft.ends
    low, high = (np.clip(each[..., None], ends[:-1], ends[1:]) for each in (reference, position))
    return np.asarray(((high - low) * shaft.strains()).sum(axis=-1))


def seat_strains(of: BearingSet, row: Row) -> tuple[Any, Any]:
    """alpha dT of shaft and housing at a row."""
    rings = expansion(of, row)
    shaft, housing = (0.0, 0.0) if rings is None else rings.seat_strains(row.bearing)
    if of.shaft is not None and of.shaft.temperature is not None:
        shaft = of.shaft.strains()[..., of.shaft.section_number(row.position)]
    if of.housing is not None and of.housing.temperature is not None:
        housing = of.housing.strain
    return shaft, housing


def expansion(of: BearingSet, row: Row) -> RingExpansion | None:
    """The effect, where the row or the set names it."""
    return next((effect for effect in of.effects_of(row) if isinstance(effect, RingExpansion)), None)
