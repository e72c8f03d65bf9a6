"""The contact condition: no tension, no penetration, the load carried.

With the bodies condensed onto their pressure basis the contact is a small dense problem,

    gap_i = sum_j F_ij p_j + g_i - delta m_i >= 0,   p_i >= 0,   gap_i p_i = 0,   sum_i m_i p_i = load,

with F the flexibilities of both bodies, g the undeformed gap and m the area, each weighted with basis function i:
milliseconds per load by an active set. g comes from the exact surfaces, never from the mesh's facets.

A mesh in units of a contact is similar at every size, so one factorisation serves any unit length. That is used twice:
for any load of a series, and to average out where the contact's edge happens to fall in the mesh. The edge passes
through the elements as the unit length changes by one element; p0 swings by up to 0.35 % at 8 elements per semi-axis,
its mean over one such period is within 0.08 % (0.12 and 0.02 % at 12). So every contact is solved at `POSITIONS` unit
lengths, evenly over one element, and the result is the mean. No mesh line is ever placed on the edge on purpose.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from fem_check.elements.elastic_body import CondensedBody
from fem_check.elements.pressure_basis import PressureBasis
from fem_check.independent.contact_problem import Array, ContactProblem, GapFunction

POSITIONS = 8
"""Positions of the contact's edge within one element."""
MAX_CHANGES = 200
"""Iterations of the active set; ten are usual."""


class ContactError(Exception):
    """The contact could not be solved; the message says why."""


Factor = tuple[Array, bool]
"""As `scipy.linalg.cho_factor` gives it."""


@dataclass(frozen=True)
class Trial:
    """What an active set leads to."""

    pressure: Array
    """Zero outside the set."""
    left: Array
    """The weighted gaps."""
    tolerance: Array | float
    """Penetration, weighted, that counts as none."""


@dataclass(frozen=True)
class ContactSolution:
    """A solved contact at each position of its edge in the mesh; SI units."""

    problem: ContactProblem
    basis: PressureBasis
    unit_lengths: Array
    """Length of the mesh's unit [m], shape (position,)."""
    pressures: Array
    """Coefficient of each pressure basis function [Pa], shape (basis, position)."""
    approaches: Array
    """Approach [m], shape (position,)."""
    penetration: float
    """Deepest remaining penetration, weighted over a basis function, over the approach."""
    load_error: float
    """Largest relative difference of the pressure's force and the load."""


def edge_positions(semi_axis: float, element: float) -> Array:
    """Unit lengths that move the edge of a contact of the given semi-axis through one element about 1.

    Args:
        semi_axis: the contact's expected semi-axis along which the mesh's unit is 1 [m].
        element: size of the element at 1, in mesh units.
    """
    tips = 1.0 + element * ((np.arange(POSITIONS) + 0.5) / POSITIONS - 0.5)
    return semi_axis / tips


def total_flexibility(problem: ContactProblem, ball: CondensedBody, race: CondensedBody) -> Array:
    """Both bodies' flexibilities per unit length [1/Pa]."""
    return ball.flexibility / problem.ball.elastic_modulus + race.flexibility / problem.race.elastic_modulus


def solve(
    problem: ContactProblem,
    basis: PressureBasis,
    flexibility: Array,
    unit_lengths: Array,
    gap: GapFunction | None = None,
) -> ContactSolution:
    """Solve the contact at each unit length.

    Args:
        problem: the load, and the parabolic gap unless another is given.
        basis: of the flexibility, on the quarter x, y >= 0.
        flexibility: of both bodies, see `total_flexibility`.
        unit_lengths: length of the mesh's unit [m], shape (position,).
        gap: the undeformed gap at (x, y) [m]; None: the problem's parabola.
    """
    undeformed = problem.parabolic_gap if gap is None else gap
    pressures = np.zeros((len(basis.forces), len(unit_lengths)))
    approaches = np.zeros(len(unit_lengths))
    penetrations, load_errors = [], []
    start: Array | None = None
    for position, length in enumerate(unit_lengths):
        gaps = basis.weighted(lambda x, y, scale=length: undeformed(scale * x, scale * y))  # type: ignore[misc]
        force = 0.25 * problem.load / length**2
        if start is None:
            x, y = basis.points * length
            # Any initial active set serves; where the parabola is low enough to enclose about the contact, iterations
            # are saved.
            height = undeformed(x, y)
            start = height < 0.3 * height.max()
        pressure, moved, left = active_set(length * flexibility, gaps, basis.forces[:, None], np.array([force]), start)
        approach = float(moved[0])
        start = pressure > 0.0
        pressures[:, position] = pressure
        approaches[position] = approach
        penetrations.append(max(0.0, -float((left / basis.forces).min())) / approach)
        load_errors.append(abs(float(basis.forces @ pressure) / force - 1.0))
        if _reaches_patch_edge(basis, pressure):
            raise ContactError(
                f"the contact of {problem.name} at {problem.load:g} N fills the whole patch that the mesh allows: the "
                "unit length does not fit this contact"
            )
    return ContactSolution(
        problem, basis, np.asarray(unit_lengths), pressures, approaches, max(penetrations), max(load_errors)
    )


def active_set(
    flexibility: Array, gaps: Array, motions: Array, forces: Array, start: Array
) -> tuple[Array, Array, Array]:
    """Pressures, approaches and remaining weighted gaps of the dense contact problem.

    Args:
        flexibility: shape (basis, basis).
        gaps: weighted with each basis function, shape (basis,).
        motions: by how much each rigid motion closes each weighted gap, shape (basis, motion); the first is the
            approach, and so the area.
        forces: that the pressures exert along each motion.
        start: initial active set.

    Raises:
        ContactError: the active set does not settle.
    """
    areas = motions[:, 0]

    def given(inside: Array, factor: Factor) -> tuple[Trial, Array]:
        per_motion, from_gap = np.split(cho_solve(factor, np.column_stack([motions[inside], gaps[inside]])), [-1], 1)
        moved = np.linalg.solve(motions[inside].T @ per_motion, forces + motions[inside].T @ from_gap[:, 0])
        pressure = np.zeros_like(areas)
        pressure[inside] = per_motion @ moved - from_gap[:, 0]
        left = flexibility[:, inside] @ pressure[inside] + gaps - motions @ moved
        return Trial(pressure, left, 1e-12 * moved[0] * areas), moved

    active, trial, moved = settle(flexibility, start, given)
    return trial.pressure, moved, np.where(active, 0.0, trial.left)


def settle(
    flexibility: Array, start: Array, given: Callable[[Array, Factor], tuple[Trial, Array]]
) -> tuple[Array, Trial, Array]:
    """Change the active set until no pressure on it is tensile and nothing penetrates outside it.

    Args:
        flexibility: shape (basis, basis).
        start: initial active set.
        given: what an active set leads to, from its indices and the Cholesky factor of the flexibility on it; and the
            rigid motions that go with it.

    Returns:
        the active set, what it leads to, and the motions.

    Raises:
        ContactError: the active set does not settle.
    """
    active = start.copy()
    seen: set[bytes] = set()
    single = False
    for _ in range(MAX_CHANGES):
        inside = np.flatnonzero(active)
        trial, moved = given(inside, cho_factor(flexibility[np.ix_(inside, inside)], check_finite=False))
        pressure, left = trial.pressure, trial.left
        drop = active & (pressure < 0.0)
        add = ~active & (left < -trial.tolerance)
        if not drop.any() and not add.any():
            return active, trial, moved
        if single:
            # One basis function at a time cannot cycle: each change lowers the energy.
            worst = np.where(drop, pressure / np.abs(pressure).max(), np.where(add, left / np.abs(left).max(), 0.0))
            change = int(np.argmin(worst))
            active[change] = ~active[change]
            continue
        active = (active & ~drop) | add
        key = active.tobytes()
        single = key in seen
        seen.add(key)
    raise ContactError(f"the active set did not converge in {MAX_CHANGES} iterations")


def _reaches_patch_edge(basis: PressureBasis, pressure: Array) -> bool:
    # A contact that needs more room than the patch has would load its last grid line.
    last_lines = (basis.points[0] >= basis.lines_x[-1] * (1.0 - 1e-9)) | (
        basis.points[1] >= basis.lines_y[-1] * (1.0 - 1e-9)
    )
    return bool((pressure[last_lines] > 0.0).any())
