"""A body condensed onto its contacts: flexibility under the pressure basis functions.

Two ways to hold it: nodes fixed, as a ring in its seat; or free, as a ball, where a body force like gravity balances
every load (inertia relief) and displacements count from the body's mean translation and rotation. Once the loads of a
free body add up to a given force, that body force is the force's uniform counterpart, as is the centrifugal force.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem_check.elements.linear_solver import factorise
from fem_check.independent.contact_problem import Array
from fem_check.solids.tetrahedral_body import TetrahedralBody

NEAR = 1e-7
"""How far from a plane or cylinder a node on it may be [m]; meshes are kept in single precision."""
RIGHT_HAND_SIDES = 64
"""Solved at a time."""


@dataclass(frozen=True)
class CondensedSolid:
    """Response of a body to each of its loads; its mesh and factor are no longer needed."""

    flexibility: Array
    """Work of load i along the displacement under load j, shape (load, load); symmetrised."""
    dofs: int
    solver: str
    held: Array
    """Force of what holds the body on it, per load, in space, shape (3, load); of a free body those of the three
    unknowns that only stop its rigid motions: without fault none."""
    dilation: float
    """Work of a displacement that is the position itself along the forces that it takes [N m], the body's stiffness in
    one number: 3 E V/(1 - 2 nu)."""


def condense_supported(
    body: TetrahedralBody, loads: sp.csr_matrix, fixed: Array, turn: sp.csr_matrix | None = None
) -> CondensedSolid:
    """Condense a body some of whose displacements are zero.

    Args:
        loads: nodal forces, shape (dof, load).
        fixed: of each unknown, whether it is zero, shape (node, 3).
        turn: rotation of the unknowns from the directions in which `fixed` counts into x, y, z; None: the same.
    """
    matrix, forces = body.stiffness, loads
    dilation = _dilation(body, matrix)
    shifts = sp.csr_matrix(np.tile(np.identity(3), body.space.count))
    if turn is not None:
        matrix, forces = sp.csr_matrix(turn.T @ matrix @ turn), sp.csr_matrix(turn.T @ loads)
        shifts = sp.csr_matrix(shifts @ turn)
    free, held = np.flatnonzero(~fixed.ravel()), np.flatnonzero(fixed.ravel())
    of_held = sp.csr_matrix(shifts[:, held])
    inside, to_held = sp.csc_matrix(matrix[free][:, free]), sp.csr_matrix(of_held @ matrix[held][:, free])
    del matrix  # the factor needs the memory
    flexibility, moved, solver = _solved(inside, sp.csc_matrix(forces[free]), to_held)
    return CondensedSolid(flexibility, len(free), solver, moved - (of_held @ forces[held]).toarray(), dilation)


def moved(
    body: TetrahedralBody,
    force: Array,
    fixed: Array,
    turn: sp.csr_matrix | None = None,
    stiffness: sp.csr_matrix | None = None,
) -> Array:
    """Displacement (node, 3) under a force, held as for `condense_supported`; the body's stiffness if it is known."""
    stiffness = body.stiffness if stiffness is None else stiffness
    turn = sp.identity(3 * body.space.count, format="csr") if turn is None else turn
    free = np.flatnonzero(~fixed.ravel())
    matrix = sp.csr_matrix(turn.T @ stiffness @ turn)
    displacement = np.zeros(3 * body.space.count)
    displacement[free] = factorise(sp.csc_matrix(matrix[free][:, free])).solve((turn.T @ force)[free, None])[:, 0]
    return np.asarray(turn @ displacement).reshape(-1, 3)


def _dilation(body: TetrahedralBody, matrix: sp.csr_matrix) -> float:
    position = body.nodes.T.ravel()
    return float(position @ (matrix @ position))


def condense_free(body: TetrahedralBody, loads: sp.csr_matrix) -> CondensedSolid:
    """Condense a body that is free in its plane of symmetry z = 0, under self-balancing body forces."""
    fixed, stops, carried, share = free_support(body, loads)
    free = np.flatnonzero(~fixed.ravel())
    matrix = body.stiffness
    dilation = _dilation(body, matrix)
    inside, to_held = sp.csc_matrix(matrix[free][:, free]), sp.csr_matrix(matrix[stops][:, free])
    del matrix  # the factor needs the memory
    flexibility, moved, solver = _solved(inside, sp.csc_matrix(loads[free]), to_held, carried[free], share)
    held = moved - loads[stops].toarray() + carried[stops] @ share
    return CondensedSolid(flexibility, len(free), solver, held, dilation)


def free_support(body: TetrahedralBody, loads: sp.csr_matrix | Array) -> tuple[Array, list[int], Array, Array]:
    """How a free body is held: which unknowns are zero, those three of them that only stop its rigid motions, and the
    body forces `carried @ share`, to be taken off the loads, that balance them."""
    x, y = body.nodes[:2] - body.nodes[:2].mean(axis=1, keepdims=True)
    # Rigid motions that keep the plane of symmetry: along x, along y, about z.
    rigid = np.zeros((body.space.count, 3, 3))
    rigid[:, 0, 0] = rigid[:, 1, 1] = 1.0
    rigid[:, 0, 2], rigid[:, 1, 2] = -y, x
    motions = rigid.reshape(-1, 3)
    carried = body.mass @ motions
    # Loads less the body force that balances them: P F, and as P' takes out the mean motion, all stays symmetric.
    share = np.linalg.solve(motions.T @ carried, (loads.T @ motions).T)
    fixed = np.zeros((body.space.count, 3), dtype=bool)
    plane = body.on(lambda p: np.abs(p[2]) < NEAR)
    fixed[plane, 2] = True
    # Three unknowns that stop the rigid motions; they carry nothing, for every load is balanced.
    far = plane[np.argsort(np.hypot(x[plane], y[plane]))]
    stops = [3 * far[0], 3 * far[0] + 1, 3 * far[-1] + (1 if abs(x[far[-1]]) > abs(y[far[-1]]) else 0)]
    fixed.ravel()[stops] = True
    return fixed, stops, carried, share


def _solved(
    matrix: sp.csc_matrix,
    loads: sp.csc_matrix,
    to_held: sp.csr_matrix,
    carried: Array | None = None,
    share: Array | None = None,
) -> tuple[Array, Array, str]:
    """Flexibility, and the forces `to_held @ displacement`, under each load, less `carried @ share` where given.

    Some at a time, for all are large.
    """
    factor = factorise(matrix)
    count = loads.shape[1]
    flexibility = np.empty((count, count))
    held = np.empty((to_held.shape[0], count))
    for start in range(0, count, RIGHT_HAND_SIDES):
        some = slice(start, min(start + RIGHT_HAND_SIDES, count))
        forces = loads[:, some].toarray()
        if carried is not None and share is not None:
            forces -= carried @ share[:, some]
        moved = factor.solve(forces)
        flexibility[:, some] = loads.T @ moved
        held[:, some] = to_held @ moved
        if carried is not None and share is not None:
            flexibility[:, some] -= share.T @ (carried.T @ moved)
    return 0.5 * (flexibility + flexibility.T), held, factor.solver
