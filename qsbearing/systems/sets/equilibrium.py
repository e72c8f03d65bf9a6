"""The equilibrium of shaft and rows: Newton's method over the shaft's displacement, vectorised over cases.

    R(q) = sum over rows G^T F(G q + offset) + S q - (external load, spring),     dR/dq = sum over rows G^T K G + S,

with F and K, the row's exact tangent stiffness, from the kernel, and S of all else that is elastic. At rest each
row's energy is convex and q enters it affinely, so that the set's energy is convex too: there is one equilibrium at
most. Steps are limited, and shortened until the imbalance falls, or until the energy does. Cases that this does not
solve are followed from the unloaded set at rest.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.kernel.admissibility import CONVERGED
from qsbearing.model.solution.ring_stiffness import SOFTEST
from qsbearing.systems.sets.rigid_shaft import SLIDE, UNKNOWNS
from qsbearing.systems.sets.row_cases import RowCases, RowStates

# Choices that shape the way to an equilibrium, not the equilibrium.
MOST_ITERATIONS = 60
# A step moves no row further than this part of the distance of its groove centres: that, not the stiffness, is the
# scale on which contact angles change.
LARGEST_STEP = 0.1
SHORTEST = 0.5**11
# Of the stiffness: keeps a channel that nothing resists solvable.
REGULARISATION = 1e-12
# Where rounding forbids the tolerance, this relative imbalance still counts as solved; as in the kernel.
STALLED = 1e-10
# Continuation from the unloaded set at rest: its first and its least step, as parts of the way.
FIRST_PART, LEAST_PART, LONGER, SHORTER = 0.25, 1e-2, 1.6, 0.4


@dataclass
class Stretch:
    """A stretch of cases; arrays lead with the case. Unknowns: the shaft's channels, the slide, what is elastic."""

    rows: list[RowCases]
    load: NDArray
    """External load on the shaft, and the spring's force; shape (case, unknown)."""
    held: NDArray
    """Which unknowns are given; shape (case, unknown)."""
    place: NDArray
    """The values of those, and where the others begin; shape (case, unknown)."""
    elasticity: NDArray
    """S; shape (case, unknown, unknown), or of no case where all but the rows is rigid."""
    rigid: int
    """Up to this unknown they are those of rigid bodies."""
    lever: NDArray
    """Makes forces of moments; shape (case,) [m]."""
    step: NDArray
    """The longest step of any row; shape (case,) [m]."""
    tolerance: float
    q: NDArray
    """Shape (case, unknown) [m, rad]."""
    residual: NDArray
    """Largest imbalance over the largest force; shape (case,)."""
    iterations: NDArray
    speed_factor: NDArray
    load_factor: NDArray
    fault: NDArray
    """The row that its own solve did not solve where the last step was; -1: none; shape (case,)."""
    tried: NDArray
    """Where that was; shape (case, unknown)."""
    solved: NDArray
    """Which cases are solved directly."""
    refused: dict[int, NDArray] = field(default_factory=dict)
    """The record of that row's result."""

    @property
    def count(self) -> int:
        """Cases."""
        return int(self.q.shape[0])

    @property
    def unknowns(self) -> int:
        """Those that are held included."""
        return int(self.q.shape[1])

    def scale(self, which: NDArray | slice = np.s_[:]) -> NDArray:
        """What unknowns are multiplied by to be lengths; shape (case, unknown)."""
        scale = np.ones((self.lever[which].size, self.unknowns))
        scale[:, 3:5] = self.lever[which, None]
        return scale

    def imbalance(self, which: NDArray, q: NDArray, of_rows: list[RowStates]) -> tuple[NDArray, NDArray]:
        """(what the rows' loads exceed the applied by, free unknowns only and as forces; that over the largest).

        Nothing where all of them are what rounding of positions presses: a set without load that just touches.
        """
        target = self.load[which] * self.load_factor[which, None]
        target[:, SLIDE] = self.load[which, SLIDE]
        total, largest = -target, np.abs(target / self.scale(which)).max(axis=1)
        for row, of_row in zip(self.rows, of_rows, strict=True):
            own = np.einsum("kij,ki->kj", row.matrix[which], row.load(of_row, which))
            largest = np.maximum(largest, np.abs(own / self.scale(which)).max(axis=1))
            total = total + own
        if self.elasticity.size:
            total = total + np.einsum("kij,kj->ki", self.elasticity[which], q)
        total = np.where(self.held[which], 0.0, total / self.scale(which))
        least = np.max([row.least_load(which) for row in self.rows], axis=0)
        return total, np.where(largest <= least, 0.0, np.abs(total).max(axis=1) / np.maximum(largest, least))

    def tangent(self, which: NDArray) -> NDArray:
        """dR/dq; shape (case, unknown, unknown), SI."""
        parts = [(row.matrix[which], row.stiffness(which, self.speed_factor[which])) for row in self.rows]
        total = np.asarray(sum(matrix.swapaxes(1, 2) @ own @ matrix for matrix, own in parts))
        return total + self.elasticity[which] if self.elasticity.size else total

    def solve_rows(self, q: NDArray, which: NDArray, is_trial: bool = False) -> tuple[list[RowStates], NDArray]:
        """All rows at this displacement: (what is found, where all are solved); none after one that is not.

        Args:
            is_trial: give up a row that its first method does not solve: to find out why takes most of the time, and a
                shorter step needs no reason.
        """
        every, good = [], np.ones(which.size, bool)
        for number, row in enumerate(self.rows):
            state, left = row.found.part(which), np.flatnonzero(good)
            new, solved = row.solve(q[left], which[left], self.tolerance, self.speed_factor[which[left]], is_trial)
            state.put(left, new)
            for k in left[~solved]:
                self.fault[which[k]], self.refused[int(which[k])] = number, state.results[k].copy()
                self.tried[which[k]] = q[k]
            good[left[~solved]] = False
            every.append(state)
        return every, good

    def keep(self, which: NDArray, q: NDArray, of_rows: list[RowStates], residual: NDArray) -> None:
        """Go on from here."""
        self.q[which], self.residual[which] = q, residual
        self.fault[which[np.isfinite(residual)]] = -1
        for row, of_row in zip(self.rows, of_rows, strict=True):
            row.found.put(which, of_row)


def newton(s: Stretch, which: NDArray) -> NDArray:
    """Solve these cases from where they are: which of them converged, as numbers."""
    active = which
    q = np.where(s.held[active], s.place[active] * s.load_factor[active, None], s.q[active])
    of_rows, good = s.solve_rows(q, active)
    imbalance, relative = s.imbalance(active, q, of_rows)
    s.keep(active, q, of_rows, np.where(good, relative, np.inf))
    active, imbalance = active[good], imbalance[good]
    before = np.full(active.size, np.inf)
    done = [active[:0]]
    for _ in range(MOST_ITERATIONS):
        residual = s.residual[active]
        solved = (residual <= s.tolerance) | ((residual <= STALLED) & (residual > 0.5 * before))
        done.append(active[solved])
        active, imbalance, before = active[~solved], imbalance[~solved], residual[~solved]
        if not active.size:
            break
        step = _step(s, active, imbalance)
        active, imbalance, before = _take(s, active, imbalance, before, step)
        s.iterations[active] += 1
    return np.sort(np.concatenate(done))


def _step(s: Stretch, which: NDArray, imbalance: NDArray) -> NDArray:
    """Newton's step of the unknowns as lengths, no longer than is allowed."""
    scale, held = s.scale(which), s.held[which]
    matrix = s.tangent(which) / scale[:, :, None] / scale[:, None, :]
    matrix[held[:, :, None] | held[:, None, :]] = 0.0
    size = np.abs(matrix[:, : s.rigid, : s.rigid]).max(axis=(1, 2))
    softest = REGULARISATION * np.where(size > 0.0, size, 1.0)
    diagonal = np.arange(s.unknowns)
    matrix[:, diagonal, diagonal] += np.where(held, 1.0, softest[:, None])
    step = -np.linalg.solve(matrix, imbalance[:, :, None])[:, :, 0]
    longest = np.abs(step).max(axis=1)
    return np.asarray(step * np.minimum(1.0, s.step[which] / np.maximum(longest, 1e-300))[:, None])


def _take(
    s: Stretch, which: NDArray, imbalance: NDArray, before: NDArray, step: NDArray
) -> tuple[NDArray, NDArray, NDArray]:
    """Take each step, or the longest part of it, by halves, that lessens the imbalance; cases without one are left.

    A step is taken too at whose end the imbalance still points back, R(new) . step <= 0: at rest, where the energy is
    convex, it has then fallen all along. Across a gap R is the load, and just beyond larger: no step would lessen it.
    By quarters where some row is not solved.
    """
    size, fraction = np.linalg.norm(imbalance, axis=1), np.ones(which.size)
    left = np.arange(which.size)
    taken = np.zeros(which.size, bool)
    while left.size:
        cases = which[left]
        q = s.q[cases] + fraction[left, None] * step[left] / s.scale(cases)
        of_rows, good = s.solve_rows(q, cases, is_trial=True)
        new, relative = s.imbalance(cases, q, of_rows)
        # The limit of rounding: an imbalance as small as any may stay as it is.
        downhill = np.einsum("kj,kj->k", new, step[left]) <= 0.0
        better = good & ((np.linalg.norm(new, axis=1) < size[left]) | downhill | (relative <= STALLED))
        s.keep(cases[better], q[better], [each.part(np.flatnonzero(better)) for each in of_rows], relative[better])
        imbalance[left[better]] = new[better]
        taken[left[better]] = True
        fraction[left] *= np.where(good, 0.5, 0.25)
        left = left[~better & (fraction[left] >= SHORTEST)]
    return which[taken], imbalance[taken], before[taken]


def follow(s: Stretch, which: NDArray) -> tuple[NDArray, NDArray]:
    """From the unloaded set at rest to these cases, loads and speeds growing together.

    Returns:
        Which converged; and the part of the way that each case of the stretch was followed.
    """
    for row in s.rows:
        row.found.results["status"][which] = -1  # no place to continue from
    s.q[which], s.load_factor[which], s.speed_factor[which] = 0.0, 0.0, 0.0
    active = newton(s, which)
    reached, part = np.zeros(s.count), np.full(s.count, FIRST_PART)
    done = [which[:0]]
    while active.size:
        kept = [row.found.part(active) for row in s.rows]
        q = s.q[active].copy()
        s.load_factor[active] = s.speed_factor[active] = np.minimum(1.0, reached[active] + part[active])
        went = np.isin(active, newton(s, active))
        reached[active[went]] = s.load_factor[active[went]]
        part[active] *= np.where(went, LONGER, SHORTER)
        back = np.flatnonzero(~went)
        s.q[active[back]] = q[back]
        for row, old in zip(s.rows, kept, strict=True):
            row.found.put(active[back], old.part(back))
        finished = reached[active] >= 1.0
        done.append(active[finished])
        ended = active[~finished & (part[active] < LEAST_PART)]
        _explain(s, ended[s.fault[ended] >= 0])
        active = active[~finished & (part[active] >= LEAST_PART)]
    s.load_factor[which] = s.speed_factor[which] = 1.0
    return np.sort(np.concatenate(done)), reached


def _explain(s: Stretch, which: NDArray) -> None:
    """Why the last row of these cases that was not solved is not: by all that a row's own solve can find out."""
    s.fault[which] = -1
    s.solve_rows(s.tried[which], which)


def is_beyond_springs(s: Stretch, which: NDArray) -> NDArray:
    """Whether the shaft can be pushed out along x: what is on springs gives way with it, no row is pressed, and the
    loads work more than the springs resist. Their work is that of constant forces, so there is no equilibrium.

    Sprung rings slide as far as the shaft goes, or stay; each sleeve goes with the shaft, or stays.
    """
    is_beyond = np.zeros(which.size, bool)
    rigid = np.s_[: s.rigid]
    load, held = s.load[which, rigid], s.held[which, rigid]
    sleeves = [(0.0,) if s.held[which, column].all() else (0.0, 1.0) for column in range(UNKNOWNS, s.rigid)]
    for sign in product((1.0, -1.0), (0.0, 1.0), *sleeves):
        motion = np.zeros(s.rigid)
        motion[0], motion[SLIDE], motion[UNKNOWNS:] = sign[0], -sign[1], sign[0] * np.array(sign[2:])
        stays = (held & (motion != 0.0)).any(axis=1)
        for row in s.rows:
            along = row.matrix[which][:, 0, rigid] @ motion
            stays |= np.where(row.cases["one_sided"][which], along > 0.0, along != 0.0)
        if s.elasticity.size:  # supports
            stays |= np.einsum("i,kij,j->k", motion, s.elasticity[which][:, rigid, rigid], motion) > 0.0
        is_beyond |= ~stays & (load @ motion > 0.0)
    return is_beyond


def unsupported(s: Stretch, which: NDArray) -> NDArray:
    """Which unknowns of cases not solved are loaded although nothing resists them where the shaft went."""
    out = np.zeros((which.size, s.unknowns), bool)
    known = np.logical_and.reduce([row.found.results["status"][which] == CONVERGED for row in s.rows])
    cases = which[known]
    if not cases.size:
        return out
    scale, held = s.scale(cases), s.held[cases]
    imbalance, _ = s.imbalance(cases, s.q[cases], [row.found.part(cases) for row in s.rows])
    matrix = s.tangent(cases) / scale[:, :, None] / scale[:, None, :]
    matrix[held[:, :, None] | held[:, None, :]] = 0.0
    values, vectors = np.linalg.eigh(0.5 * (matrix + matrix.swapaxes(1, 2)))
    soft = np.abs(values) <= SOFTEST * np.abs(values).max(axis=1, keepdims=True)
    along = np.where(soft, np.einsum("kij,ki->kj", vectors, imbalance), 0.0)
    part = np.abs(np.einsum("kij,kj->ki", vectors, along))
    size = np.linalg.norm(imbalance, axis=1, keepdims=True)
    out[known] |= (part > 0.5 * part.max(axis=1, keepdims=True)) & (part.max(axis=1, keepdims=True) > 0.5 * size)
    return out & ~s.held[which]
