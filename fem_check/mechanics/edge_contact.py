"""A contact that its groove's edge cuts off, by boundary elements of a half-space that ends to be pressed at the edge.

The parabola's contact is similar at every load: with lengths over the semi-minor axis b, pressures over p0 and
displacements over p0 b/E*, what the edge does depends on the part t of the major axis beyond it and on k = a/b alone.
x runs along the groove's profile from the middle of the uncut ellipse, the edge lies at x = k (1 - 2t). Asked is the
contact at the approach of the uncut one: its load, where its resultant acts, and the intensity of the pressure at the
edge, which is that of a sharp punch there, p = K p0 sqrt(b/d) with d the distance from the edge.

An edge with a radius, tangent to the groove at the edge, opens the gap by (x - edge)^2/(2 radius) beyond it; radii here
are over b E*/p0.

Rectangles of constant pressure, graded towards the edge, symmetric in y; the influence is Love's. Contacts that end at
an edge: M. J. Hartnett, J. Lubr. Tech. 101, 1979; J. M. de Mul, J. J. Kalker, B. Fredriksson, J. Tribol. 108, 1986.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from scipy.special import elliprd, elliprf

from fem_check.independent.contact_problem import Array
from fem_check.mechanics import contact
from fem_check.mechanics.boundary_element import normal_influence

SOURCE = "boundary elements of a half-space whose pressure ends at the edge (Love 1929)"
FIRST, GROWTH, LARGEST, ACROSS = 0.01, 1.3, 0.036, 16
"""Widths of rectangles along x: at the edge over b, their growth from there, the largest over a; and how many a
semi-minor axis has across."""
WIDER = 1.3
"""Half-width of the grid: the cut contact is as wide as the uncut one but for its end at the edge."""
NEAR_EDGE = (0.02, 0.15)
"""Distances from the edge within which the intensity is read; rectangles of half the size give 1 % less."""


@dataclass(frozen=True)
class UnitContact:
    """Hertz's contact with b = 1, p0 = 1, E* = 1."""

    ellipticity: float

    @property
    def load(self) -> float:
        """Q."""
        return 2.0 / 3.0 * pi * self.ellipticity

    @property
    def approach(self) -> float:
        """delta."""
        return 1.5 * self.load / pi * float(elliprf(0.0, 1.0, self.ellipticity**2))

    def holds(self, x: Array, y: Array) -> Array:
        """Whether points lie in the ellipse."""
        return np.hypot(x / self.ellipticity, y) < 1.0

    def gap(self, x: Array, y: Array) -> Array:
        """The parabola."""
        square = self.ellipticity**2
        return self.load / (2.0 * pi) * (elliprd(0.0, 1.0, square) * x**2 + elliprd(0.0, square, 1.0) * y**2)


@dataclass(frozen=True)
class Cut:
    """A cut contact at the uncut one's approach."""

    load: float
    """Over that of the uncut contact."""
    centre: float
    """Of the resultant from the uncut contact's middle, over a; away from the edge is positive."""
    intensity: float
    """K."""
    largest: float
    """Pressure, over p0; where the edge is sharp it is the grid's."""


def opened(unit: UnitContact, edge: float, radius: float) -> contact.GapFunction:
    """The gap above a groove and its rounded edge."""
    return lambda x, y: unit.gap(x, y) + np.where(x > edge, (x - edge) ** 2 / (2.0 * radius), 0.0)


def cut(share: float, ellipticity: float, radius: float | None = None, finer: float = 1.0) -> Cut:
    """A contact with a share t of its major axis beyond the edge.

    Args:
        radius: of the edge over b E*/p0; None: sharp.
        finer: by how much the rectangles are smaller.
    """
    unit, edge = UnitContact(ellipticity), ellipticity * (1.0 - 2.0 * share)
    first, beyond = FIRST / finer, 0.0
    if radius is not None:
        # The contact ends soon beyond the edge, within a few of this length.
        length = radius ** (2.0 / 3.0)
        first, beyond = min(first, length / 10.0), 3.0 * length
    lines = edge - graded(edge + 1.02 * ellipticity, first, GROWTH, LARGEST * ellipticity / finer)[::-1]
    if beyond:
        lines = np.concatenate([lines, edge + np.arange(1, int(np.ceil(beyond / first)) + 1) * first])
    count = round(WIDER * ACROSS * finer)
    height = WIDER / count
    middles, widths = 0.5 * (lines[1:] + lines[:-1]), np.diff(lines)
    column, row = (each.ravel() for each in np.indices((len(middles), count)))
    x, y = middles[column], (row + 0.5) * height
    inside = y < 1.15 * np.sqrt(np.maximum(1.0 - (x / ellipticity) ** 2, 0.0)) + 0.2
    column, row, x, y, width = column[inside], row[inside], x[inside], y[inside], widths[column[inside]]
    # Few distances stand between many rectangles.
    rows_apart = height * np.arange(2 * count)
    table = normal_influence((middles[:, None] - middles)[..., None], rows_apart, widths[:, None], height)
    influence = table[column[:, None], column, np.abs(row[:, None] - row)]
    influence += table[column[:, None], column, row[:, None] + row + 1]  # their mirror images
    pressure = _pressed(x, y, width * height, influence, unit, edge, radius)
    area = 2.0 * height * width
    force = area * pressure
    # K and how it changes, from p sqrt(d); each rectangle has the mean of its d^-1/2.
    distance = edge - x
    near = (y < height) & (distance > NEAR_EDGE[0]) & (distance < NEAR_EDGE[1])
    ends = distance[near] - 0.5 * width[near], distance[near] + 0.5 * width[near]
    root = 2.0 * (np.sqrt(ends[1]) - np.sqrt(ends[0])) / width[near]
    of_edge = float(np.polyfit(distance[near], pressure[near] / root, 1)[1])
    return Cut(
        float(force.sum()) / unit.load,
        -float(force @ x) / float(force.sum()) / ellipticity,
        of_edge,
        float(pressure.max()),
    )


def _pressed(
    x: Array, y: Array, area: Array, influence: Array, unit: UnitContact, edge: float, radius: float | None
) -> Array:
    """Pressure of each rectangle at the approach of the uncut contact."""
    gap = unit.gap if radius is None else opened(unit, edge, radius)
    # Weighted with the areas it is nearly symmetric, and is made so.
    flexibility = influence * area[:, None]
    flexibility = 0.5 * (flexibility + flexibility.T)
    left = area * (gap(x, y) - unit.approach)
    return fixed_approach(flexibility, left, unit.holds(x, y))


def fixed_approach(flexibility: Array, left: Array, start: Array) -> Array:
    """Pressures that close what the undeformed gap lacks, and pull nowhere.

    Args:
        flexibility: (basis, basis).
        left: gap less approach, weighted with each basis function.
        start: initial active set.
    """

    def given(inside: Array, factor: contact.Factor) -> tuple[contact.Trial, Array]:
        pressure = np.zeros_like(left)
        pressure[inside] = contact.cho_solve(factor, -left[inside])
        opened_by = flexibility[:, inside] @ pressure[inside] + left
        return contact.Trial(pressure, opened_by, 1e-12 * np.abs(left).max()), np.zeros(0)

    return contact.settle(flexibility, start, given)[1].pressure


def graded(length: float, first: float, growth: float, largest: float) -> Array:
    """Distances from 0 to a length, by steps that grow from the first to the largest."""
    steps = [first]
    while sum(steps) < length:
        steps.append(min(steps[-1] * growth, largest))
    return np.concatenate([[0.0], np.cumsum(steps)]) * (length / sum(steps))
