"""How the error depends on the contact's shape, on the mesh, and on how many positions of its edge are averaged.

The contact's edge falls somewhere in an element; one position alone is off by five to ten times the mean over one
element. For each number of positions the error kept is the worst over all ways to space them evenly in the element.
Nothing is timed here: the errors are the same on every machine.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

from fem_check import half_space_contact, linear_solver
from fem_check.agreement import Level
from fem_check.checks.other_contacts import slender_problem
from fem_check.cost import configurations
from fem_check.references import hertz

POSITIONS = 32
COUNTS = (1, 2, 4, 8)
"""Numbers of positions offered; beyond eight nothing is gained."""
ELLIPTICITIES = {Level.QUICK: (1.0, 2.0, 8.0, 30.0), Level.RELEASE: (1.0, 2.0, 5.0, 12.0, 30.0)}
FINEST_ELLIPTICITIES = (1.0, 5.0, 30.0)
"""For the finest mesh, which alone takes as long as the others together."""


@dataclass(frozen=True)
class Shape:
    """A mesh and the shape of a contact."""

    elements: int
    ellipticity: float
    solver: str


def wanted(level: Level, solver: str) -> list[Shape]:
    """Every mesh with every shape."""
    *coarser, finest = configurations.MESHES[level]
    last = FINEST_ELLIPTICITIES if level is Level.RELEASE else ELLIPTICITIES[level]
    return [Shape(count, k, solver) for count in coarser for k in ELLIPTICITIES[level]] + [
        Shape(finest, k, solver) for k in last
    ]


def solve(shape: Shape) -> dict[str, Any]:
    """Worst relative error over the ways to space 1, 2, 4 and 8 positions, by quantity."""
    os.environ[linear_solver.ENVIRONMENT] = shape.solver
    problem = slender_problem(shape.ellipticity)
    bodies = half_space_contact.condensed_bodies(problem, shape.elements)
    _, measured = half_space_contact.solve_on(problem, bodies, POSITIONS)
    exact = hertz(problem)
    worst = {}
    for count in COUNTS:
        step = POSITIONS // count
        worst[str(count)] = {
            name: max(
                abs(float(measured.each[name][first::step].mean()) / getattr(exact, name) - 1.0)
                for first in range(step)
            )
            for name in configurations.JUDGED
        }
    return {"elements_per_semi_axis": shape.elements, "ellipticity": shape.ellipticity, "worst_error": worst}
