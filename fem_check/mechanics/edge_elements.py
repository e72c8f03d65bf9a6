"""A contact that its groove's edge cuts off, by finite elements of the half-space: the other side of `edge_contact`.

A block of hexahedra, y >= 0, its mesh refined towards the edge at x = 0. A pressure on one side of the edge is half an
even and half an odd one, so two quarters of the block are solved; one mesh serves every cut, as the gap is shifted. x
runs from the edge into the contact. Lengths are over b, pressures over p0.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fem_check.elements.elastic_body import HeldBlock, Support
from fem_check.elements.pressure_basis import PressureBasis
from fem_check.independent.contact_problem import Array, GapFunction
from fem_check.mechanics.edge_contact import Cut, UnitContact, fixed_approach, graded, opened

POISSON_RATIO = 0.3
FIRST, GROWTH = 0.015, 1.5
"""Of elements at the edge, and away from it along the contact."""
LARGEST = 0.08
"""Along the contact, over a."""
DEPTH = 6.0
"""Of the block below the contact, and beside it."""
NEAR_EDGE = (0.05, 0.6)
"""Distances from the edge up to which the pressure is integrated for its intensity."""
PATCH = 1.4
"""Half-width of the patch that may carry pressure."""


@dataclass(frozen=True)
class Block:
    """Both quarters, condensed."""

    basis: PressureBasis
    even: Array
    odd: Array
    dofs: int
    solver: str

    def cut(self, share: float, ellipticity: float, radius: float | None = None) -> Cut:
        """As `edge_contact.cut`."""
        unit, edge = UnitContact(ellipticity), ellipticity * (1.0 - 2.0 * share)
        basis, gap = self.basis, unit.gap if radius is None else opened(unit, edge, radius)
        # Parts of each function's even and odd half: hats within the groove, whole ones on a rounded edge, and beyond.
        one = np.identity(len(basis.forces))
        even, odd = 0.5 * one, 0.5 * one
        if radius is not None:
            on_edge = basis.points[0] == 0.0
            others = one[:, ~on_edge]
            even, odd = even + 0.5 * one * on_edge, odd * ~on_edge
            even, odd = np.hstack([even, 0.5 * others]), np.hstack([odd, -0.5 * others])
        within, beyond = even + odd, even - odd
        flexibility = 2.0 * (even.T @ self.even @ even + odd.T @ self.odd @ odd)

        def integrated(function: GapFunction) -> Array:
            sides = (basis.weighted(lambda x, y, side=side: function(side * x, y)) for side in (1.0, -1.0))  # type: ignore[misc]
            return sum(each.T @ side for each, side in zip((within, beyond), sides, strict=True))  # type: ignore[return-value]

        left = integrated(lambda x, y: gap(edge - x, y) - unit.approach)
        sides = [unit.holds(edge - side * basis.points[0], basis.points[1]) for side in (1.0, -1.0)]
        start = (within.T @ sides[0] + beyond.T @ sides[1]) > 0.0
        pressure = fixed_approach(flexibility, left, start)
        load = 2.0 * float(integrated(lambda x, y: 1.0 + 0.0 * x) @ pressure)
        moment = 2.0 * float(integrated(lambda x, y: x - edge) @ pressure)
        on_axis = np.flatnonzero(basis.points[1] == 0.0)
        at, along = basis.points[0, on_axis], pressure[on_axis]
        means = 0.5 * (along[1:] + along[:-1])
        # K from the pressure integrated from the edge, 2 K sqrt(d) (1 + ...): single values swing about it.
        distance, pressed = at[1:], np.cumsum(means * np.diff(at))
        near = (distance > NEAR_EDGE[0]) & (distance < NEAR_EDGE[1])
        of_edge = np.polyfit(distance[near], 0.5 * pressed[near] / np.sqrt(distance[near]), 2)[2]
        return Cut(load / unit.load, moment / load / ellipticity, float(of_edge), float(means.max()))


def block(ellipticity: float, elements: int) -> Block:
    """For contacts of an ellipticity.

    Args:
        elements: per semi-minor axis across.
    """
    from skfem import MeshHex

    inside = graded(2.05 * ellipticity, FIRST, GROWTH, LARGEST * ellipticity)
    across = np.linspace(0.0, PATCH, round(PATCH * elements) + 1)
    lines = inside, across, np.zeros(1)
    firsts = inside[-1] - inside[-2], across[1], 0.6 / elements
    x, y, z = (
        np.concatenate([line, line[-1] + graded(DEPTH, first, 1.8, DEPTH)[1:]])
        for line, first in zip(lines, firsts, strict=True)
    )
    brick = MeshHex.init_tensor(x, y, z)
    brick = brick.with_boundaries({"contact": lambda p: (p[2] == 0.0) & (p[0] < inside[-1]) & (p[1] < across[-1])})
    basis = PressureBasis(inside, across, samples_per_cell=3)
    parts = []
    for is_odd in (False, True):
        held = HeldBlock(brick, basis, POISSON_RATIO, Support.HALF_SPACE, is_odd=is_odd)
        moved = held.moved(np.identity(len(basis.forces)))
        flexibility = (held.loads.T @ moved) / (1.0 - POISSON_RATIO**2)
        parts.append(0.5 * (flexibility + flexibility.T))
    return Block(basis, parts[0], parts[1], len(held.free), held.solver)
