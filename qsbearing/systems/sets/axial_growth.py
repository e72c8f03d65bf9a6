"""How heat and spacers move rows along the shaft and in the housing, and what that presses them by.

Inner rings move with the shaft, outer ones with the housing, both counted from the reference position. A body grows by
alpha dT of its sections where it has a temperature of its own, else by that which ring expansion gives it at the rows.
Between two rows with a spacer, the spacer's length grows as the spacer, and the rest as the body; by as much as the
inner spacer is longer than the outer, the inner rings are further apart than the outer ones. What a spacer adds moves
the rows beyond it, seen from the row that stays (`BearingSet.axial_datum`).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.effects import RingExpansion
from qsbearing.systems.sets.shaft import REFERENCE_TEMPERATURE, Spacer, section_number

SHAFT, HOUSING = 0, 1
"""Bodies that bearings are on and in."""
SIDES = ("inner", "outer")
BODIES = ("shaft", "housing")


class Growth:
    """By how much heat and spacers move places in +x on the shaft or in the housing of a `BearingSet`."""

    def __init__(self, of: Any, body: int) -> None:
        self._of, self._body, self._reference = of, body, of.reference
        expansions = [expansion(of, row) for row in of.rows]
        self._rings_grow = any(each is not None for each in expansions)
        self._datum = np.asarray(of.rows[of.axial_datum].position, float)
        self._spacers = []
        for spacer in of.spacers:
            first, last = (np.asarray(of.rows[number - 1].position, float) for number in spacer.rows)
            rings = [expansions[number - 1] for number in spacer.rows]
            self._spacers.append((0.5 * (first + last), self._longer(spacer, first, last, rings)))

    def __call__(self, position: ArrayLike) -> NDArray:
        """By how much a row there is moved [m]; places may lie along axes before those of the cases."""
        x = np.asarray(position, float)
        total = self.by_heat(x)
        for middle, longer in self._spacers:
            beyond = (x >= middle).astype(float) - (self._datum >= middle)
            total = total + beyond * longer
        return total

    @property
    def is_evaluated(self) -> bool:
        """Whether the scene gives the body a temperature, or rings that grow."""
        body = getattr(self._of, BODIES[self._body])
        return self._rings_grow or (body is not None and body.temperature is not None)

    def _longer(
        self, spacer: Spacer, first: NDArray, last: NDArray, rings: Sequence[RingExpansion | None]
    ) -> NDArray | float:
        """By how much a spacer parts its rows further than the body alone would [m]."""
        side, body = SIDES[self._body], BODIES[self._body]
        length = getattr(spacer, f"{side}_length")
        if length is None:
            return 0.0
        mean = (self.by_heat(last) - self.by_heat(first)) / (last - first)
        own, given = getattr(spacer, f"{side}_temperature"), getattr(self._of, body)
        datum = REFERENCE_TEMPERATURE if given is None else given.reference_temperature
        warmer: Any = 0.0
        if own is not None:
            warmer = np.asarray(own, float) - datum
        elif given is not None and given.temperature is not None:
            warmer = np.asarray(given.temperature, float) - datum
        else:  # as the rings at both ends have it
            known = [ring.temperatures[body].value - ring.reference_temperature for ring in rings if ring is not None]
            warmer = sum(known) / len(known) if known else 0.0
        expands = getattr(spacer, f"{side}_material").thermal_expansion
        strain = 0.0 if expands is None else np.asarray(expands, float) * warmer
        more = np.asarray(length, float) * (strain - mean)
        if self._body == SHAFT and spacer.outer_length is not None:
            more = more + np.asarray(spacer.inner_length, float) - np.asarray(spacer.outer_length, float)
        return np.asarray(more)

    def by_heat(self, place: NDArray) -> NDArray:
        """Of the body itself, from the reference position [m]: by its sections, or its one strain; else between two
        rows by the mean of the strains that ring expansion has there, beyond the outermost by that there."""
        of, reference = self._of, self._reference
        if self._body == SHAFT and of.shaft is not None and of.shaft.temperature is not None:
            ends = of.shaft.ends
            low, high = (np.clip(each[..., None], ends[:-1], ends[1:]) for each in (reference, place))
            return np.asarray(((high - low) * of.shaft.strains).sum(axis=-1))
        if self._body == HOUSING and of.housing is not None and of.housing.temperature is not None:
            return np.asarray(of.housing.strain * (place - reference))
        if not self._rings_grow:
            return np.zeros(())
        positions, heats = zip(*((row.position, seat_strains(of, row)[self._body]) for row in of.rows), strict=True)
        numbers = np.array(np.broadcast_arrays(reference, place, *positions, *heats), float)
        (reference, place), places, strains = numbers[:2], numbers[2 : len(of.rows) + 2], numbers[len(of.rows) + 2 :]
        order = np.argsort(places, axis=0)
        places, strains = (np.take_along_axis(each, order, 0) for each in (places, strains))
        between = np.concatenate([strains[:1], 0.5 * (strains[1:] + strains[:-1]), strains[-1:]])
        beyond = np.full_like(places[:1], np.inf)
        low, high = np.concatenate([-beyond, places]), np.concatenate([places, beyond])
        return np.asarray((between * (np.clip(place, low, high) - np.clip(reference, low, high))).sum(axis=0))


def seat_strains(of: Any, row: Any) -> tuple[Any, Any]:
    """alpha dT of shaft and housing at a row."""
    rings = expansion(of, row)
    shaft, housing = (0.0, 0.0) if rings is None else rings.seat_strains(row.bearing)
    if of.shaft is not None and of.shaft.temperature is not None:
        shaft = of.shaft.strains[..., section_number(of.shaft, row.position)]
    if of.housing is not None and of.housing.temperature is not None:
        housing = of.housing.strain
    return shaft, housing


def expansion(of: Any, row: Any) -> RingExpansion | None:
    """The effect, where the row or the set names it."""
    return next((effect for effect in of.effects_of(row) if isinstance(effect, RingExpansion)), None)
