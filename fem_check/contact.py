"""The contact condition: pressure nowhere negative, surfaces nowhere through each other, the load carried.

With the bodies condensed onto their pressure hats the contact is a small dense problem,

    gap_i = sum_j F_ij p_j + g_i - delta m_i >= 0,   p_i >= 0,   gap_i p_i = 0,   sum_i m_i p_i = load,

with F the flexibilities of both bodies, g the undeformed gap and m the area, each weighted with hat i: milliseconds a
load by an active set. g comes from the exact surfaces, never from the mesh's facets.

A mesh in units of a contact is similar at every size, so one factorisation serves any unit length. That is used twice:
for any load of a series, and to take out the luck of where the contact's edge falls in the mesh. The edge passes
through the elements as the unit length changes by one element; p0 swings by up to 0.35 % at 8 elements per semi-axis,
its mean over one such period is within 0.08 % (0.12 and 0.02 % at 12). So every contact is solved at `POSITIONS` unit
lengths, evenly over one element, and the mean is the answer. No mesh line is ever put on the edge on purpose.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from fem_check.contact_problem import Array, ContactProblem, GapFunction
from fem_check.elastic_body import CondensedBody
from fem_check.pressure_hats import PressureHats

POSITIONS = 8
"""Places of the edge within one element."""
MAX_CHANGES = 200
"""Rounds of the active set; ten are usual."""


class ContactError(Exception):
    """The contact could not be solved; the message says why."""


@dataclass(frozen=True)
class ContactField:
    """A solved contact at each position of its edge in the mesh; SI units."""

    problem: ContactProblem
    hats: PressureHats
    unit_lengths: Array
    """Length of the mesh's unit [m], shape (position,)."""
    pressures: Array
    """Pressure of each hat [Pa], shape (hat, position)."""
    approaches: Array
    """Approach [m], shape (position,)."""
    penetration: float
    """Deepest penetration left, weighted over a hat, over the approach."""
    load_error: float
    """Largest relative difference of the pressure's force and the load."""


def edge_positions(semi_axis: float, element: float, positions: int = POSITIONS) -> Array:
    """Unit lengths that move the edge of a contact of the given semi-axis through one element about 1.

    Args:
        semi_axis: the contact's expected semi-axis along which the mesh's unit is 1 [m].
        element: size of the element at 1, in mesh units.
    """
    tips = 1.0 + element * ((np.arange(positions) + 0.5) / positions - 0.5)
    return semi_axis / tips


def total_flexibility(problem: ContactProblem, ball: CondensedBody, race: CondensedBody) -> Array:
    """Both bodies' flexibilities per unit length [1/Pa]."""
    return ball.flexibility / problem.ball.elastic_modulus + race.flexibility / problem.race.elastic_modulus


def solve(
    problem: ContactProblem, hats: PressureHats, flexibility: Array, unit_lengths: Array, gap: GapFunction | None = None
) -> ContactField:
    """Solve the contact at each unit length.

    Args:
        problem: the load, and the parabolic gap unless another is given.
        hats: of the flexibility, on the quarter x, y >= 0.
        flexibility: of both bodies, see `total_flexibility`.
        unit_lengths: length of the mesh's unit [m], shape (position,).
        gap: the undeformed gap at (x, y) [m]; None: the problem's parabola.
    """
    undeformed = problem.parabolic_gap if gap is None else gap
    pressures = np.zeros((len(hats.forces), len(unit_lengths)))
    approaches = np.zeros(len(unit_lengths))
    penetrations, load_errors = [], []
    start: Array | None = None
    for position, length in enumerate(unit_lengths):
        gaps = hats.weighted(lambda x, y, scale=length: undeformed(scale * x, scale * y))  # type: ignore[misc]
        force = 0.25 * problem.load / length**2
        if start is None:
            x, y = hats.points * length
            # Any start serves; the parabola cut where it encloses about the contact saves rounds.
            height = undeformed(x, y)
            start = height < 0.3 * height.max()
        pressure, approach, left = _active_set(length * flexibility, gaps, hats.forces, force, start)
        start = pressure > 0.0
        pressures[:, position] = pressure
        approaches[position] = approach
        penetrations.append(max(0.0, -float((left / hats.forces).min())) / approach)
        load_errors.append(abs(float(hats.forces @ pressure) / force - 1.0))
        if _reaches_rim(hats, pressure):
            raise ContactError(
                f"the contact of {problem.name} at {problem.load:g} N fills the whole patch that the mesh allows: the "
                "unit length does not fit this contact"
            )
    return ContactField(
        problem, hats, np.asarray(unit_lengths), pressures, approaches, max(penetrations), max(load_errors)
    )


def _active_set(
    flexibility: Array, gaps: Array, areas: Array, force: float, start: Array
) -> tuple[Array, float, Array]:
    """Pressures, approach and remaining weighted gaps of the dense contact problem."""
    active = start.copy()
    seen: set[bytes] = set()
    single = False
    for _ in range(MAX_CHANGES):
        inside = np.flatnonzero(active)
        factor = cho_factor(flexibility[np.ix_(inside, inside)], check_finite=False)
        per_approach, from_gap = cho_solve(factor, np.column_stack([areas[inside], gaps[inside]])).T
        approach = (force + areas[inside] @ from_gap) / (areas[inside] @ per_approach)
        pressure = np.zeros_like(areas)
        pressure[inside] = approach * per_approach - from_gap
        left = flexibility[:, inside] @ pressure[inside] + gaps - approach * areas
        tolerance = 1e-12 * approach * areas
        drop = active & (pressure < 0.0)
        add = ~active & (left < -tolerance)
        if not drop.any() and not add.any():
            return pressure, float(approach), np.where(active, 0.0, left)
        if single:
            # One hat at a time cannot cycle: each change lowers the energy.
            worst = np.where(drop, pressure / np.abs(pressure).max(), np.where(add, left / np.abs(left).max(), 0.0))
            change = int(np.argmin(worst))
            active[change] = ~active[change]
            continue
        active = (active & ~drop) | add
        key = active.tobytes()
        single = key in seen
        seen.add(key)
    raise ContactError(f"the contact condition did not settle in {MAX_CHANGES} rounds")


def _reaches_rim(hats: PressureHats, pressure: Array) -> bool:
    # A contact that needs more room than the patch has would load its last grid line.
    rim = (hats.points[0] >= hats.lines_x[-1] * (1.0 - 1e-9)) | (hats.points[1] >= hats.lines_y[-1] * (1.0 - 1e-9))
    return bool((pressure[rim] > 0.0).any())
