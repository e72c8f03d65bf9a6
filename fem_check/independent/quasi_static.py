"""The equilibrium of rows of balls on one shaft, found from the drawing alone, and its stiffness by differences.

Unknowns are the shaft's free channels and each ball's two. Newton's method on all of them, with differenced derivatives
of each ball's forces and the balls eliminated; any start that it converges from will do. A row's ring is displaced by
`place @ shaft + offset`, and its loads act on the shaft through the transpose; a bearing alone is a set of one row.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from fem_check.independent.contact_problem import Array
from fem_check.independent.equilibrium import BallRow, BallStates

CHANNELS = 6
"""Of the shaft: five, and the slide of sprung outer rings."""
STEP = 1e-8
"""Of differences, in ball diameters: a two-hundredth of an approach under light load, and far above the rounding of a
position, 1e-16 or so."""
LONGEST = 0.1
"""Step of Newton's method, over the distance of the groove centres."""
BALANCED = 1e-13
"""Imbalance over the largest force at which Newton's method stops; where rounding forbids it, ..."""
ACCEPTED = 1e-10
"""... what is still an equilibrium."""
MOST_STEPS = 30
"""Of Newton's method; from a good start it takes five."""
SHORTENINGS = 8
"""Of a step that does not lower the imbalance; then the best of them is taken."""


class NoReferenceError(Exception):
    """No start led to an equilibrium."""


@dataclass(frozen=True)
class Placed:
    """A row of balls on the shaft."""

    row: BallRow
    place: Array
    """(5, 6): the ring's displacement by that of the shaft."""
    offset: float = 0.0
    """Axial displacement of the ring while the shaft is at its zero [m]."""

    @cached_property
    def copies(self) -> BallRow:
        """The row at its place, and with each of a ball's four coordinates moved there and back."""
        return self.row.repeated(9)

    def moved(self, shaft: Array) -> Array:
        """Displacement of the row's ring, in the row's own frame; shape (5,)."""
        return np.asarray(self.place @ shaft + self.offset * np.eye(5)[0])


def alone() -> Array:
    """The place of a bearing alone."""
    return np.eye(5, CHANNELS)


@dataclass(frozen=True)
class BalanceProblem:
    """What is to be in equilibrium. Of each of the shaft's channels its load, or (held) its displacement."""

    rows: tuple[Placed, ...]
    load: Array
    held: Array
    shaft: Array
    """Displacements of the channels that are held; shape (6,)."""

    @property
    def lever(self) -> float:
        """Makes lengths of tilts, and forces of moments [m]."""
        return self.rows[0].row.lever

    @property
    def scale(self) -> Array:
        """Of displacements, to be lengths."""
        return np.array([1.0, 1.0, 1.0, self.lever, self.lever, 1.0])


@dataclass(frozen=True)
class Equilibrium:
    """The shaft's displacement, and all balls."""

    problem: BalanceProblem
    shaft: Array
    positions: tuple[Array, ...]
    """Of the balls' centres from the outer groove's, row by row; shape (ball, 2) [m]."""
    controls: tuple[Array | None, ...]

    @property
    def states(self) -> list[BallStates]:
        """Row by row."""
        return [
            placed.row.state(placed.row.groove_centres(placed.moved(self.shaft)), position, control)
            for placed, position, control in zip(self.problem.rows, self.positions, self.controls, strict=True)
        ]

    def row_load(self, number: int) -> Array:
        """On a row's ring, in the row's own frame; shape (5,)."""
        return np.asarray(self.problem.rows[number].row.on_ring(self.states[number]).sum(axis=0))

    @property
    def load(self) -> Array:
        """On the shaft; shape (6,)."""
        parts = [placed.place.T @ self.row_load(i) for i, placed in enumerate(self.problem.rows)]
        return np.asarray(np.sum(parts, axis=0))


def solve(
    problem: BalanceProblem,
    start: tuple[Array, Sequence[Array]],
    controls: Sequence[Array | None],
    speed: float = 1.0,
) -> Equilibrium:
    """Newton's method from a start: the shaft's displacement, and the balls' positions row by row.

    Args:
        controls: raceway control of each row's balls.
        speed: part of the speed of the rings.

    Raises:
        NoReferenceError: it does not converge.
    """
    shaft = np.where(problem.held, problem.shaft, start[0])
    positions = [np.array(each) for each in start[1]]
    free = np.flatnonzero(~problem.held)
    scale = problem.scale
    lengths = [placed.row.drawing.groove_centre_distance for placed in problem.rows]
    left = _imbalance(problem, shaft, positions, controls, speed)
    for _ in range(MOST_STEPS):
        if left <= BALANCED:
            break
        stiffness, unbalanced, moves = _linearised(problem, shaft, positions, controls, speed)
        change = np.zeros(CHANNELS)
        if free.size:
            matrix = stiffness[np.ix_(free, free)] / np.outer(scale[free], scale[free])
            # Least squares: nothing may resist some channel, as a pure thrust leaves a shaft with no tilt.
            change[free] = np.linalg.lstsq(matrix, unbalanced[free] / scale[free], rcond=1e-12)[0] / scale[free]
        turned = [
            (own + by @ (placed.row.by_ring @ (placed.place @ change))[:, :, None])[:, :, 0]
            for (own, by), placed in zip(moves, problem.rows, strict=True)
        ]
        longest = max(float(np.abs(each).max()) for each in (*turned, change * scale))
        part = min(1.0, LONGEST * min(lengths) / max(longest, 1e-300))
        tried = []
        for _ in range(SHORTENINGS):
            there = [position + part * each for position, each in zip(positions, turned, strict=True)]
            at = shaft + part * change
            tried.append((_imbalance(problem, at, there, controls, speed), part, at, there))
            if tried[-1][0] < left:
                break
            part *= 0.4
        best = min(tried, key=lambda each: each[:2])
        if best[0] >= left and left <= ACCEPTED:
            break
        left, _, shaft, positions = best
    if not left <= ACCEPTED:
        raise NoReferenceError(f"Newton's method leaves {left:.1e} of the largest force")
    return Equilibrium(problem, shaft, tuple(positions), tuple(controls))


def _imbalance(
    problem: BalanceProblem, shaft: Array, positions: Sequence[Array], controls: Sequence[Array | None], speed: float
) -> float:
    """The largest of any ball and of the shaft's free channels, over the largest force."""
    unbalanced, forces, left = problem.load.copy(), [1e-30], [0.0]
    for placed, position, control in zip(problem.rows, positions, controls, strict=True):
        state = placed.row.state(placed.row.groove_centres(placed.moved(shaft)), position, control, speed)
        unbalanced -= placed.place.T @ placed.row.on_ring(state).sum(axis=0)
        forces += [float(each.max()) for each in (state.q_i, state.q_o, state.centrifugal)]
        left.append(float(np.abs(state.left).max()))
    free = ~problem.held
    forces.append(float(np.abs(problem.load / problem.scale)[free].max(initial=0.0)))
    left.append(float(np.abs(unbalanced / problem.scale)[free].max(initial=0.0)))
    return max(left) / max(forces)


def _linearised(
    problem: BalanceProblem, shaft: Array, positions: Sequence[Array], controls: Sequence[Array | None], speed: float
) -> tuple[Array, Array, list[tuple[Array, Array]]]:
    """The shaft's stiffness and imbalance with the balls eliminated, and each row's moves of its balls: by themselves
    (ball, 2, 1), and by their groove centres (ball, 2, 2)."""
    stiffness, unbalanced, moves = np.zeros((CHANNELS, CHANNELS)), problem.load.copy(), []
    for placed, position, control in zip(problem.rows, positions, controls, strict=True):
        row, many = placed.row, placed.copies
        centres = row.groove_centres(placed.moved(shaft))
        # At its place, then with the groove's centre and the ball moved there and back.
        h = STEP * row.drawing.ball_diameter
        shifts = np.concatenate([np.zeros((1, 4)), h * np.eye(4), -h * np.eye(4)])[:, None, :]
        state = many.state(
            (centres + shifts[:, :, :2]).reshape(-1, 2), (position + shifts[:, :, 2:]).reshape(-1, 2),
            None if control is None else np.tile(control, len(shifts)), speed,
        )  # fmt: skip
        forces = np.concatenate([state.left, many.on_ring(state)], axis=1).reshape(len(shifts), -1, 7)
        here, slopes = forces[0], (forces[1:5] - forces[5:]).transpose(1, 2, 0) / (2.0 * h)
        (r_a, r_x), (h_a, h_x) = ((each[:, :, :2], each[:, :, 2:]) for each in (slopes[:, :2], slopes[:, 2:]))
        # A ball that nothing presses keeps its place: a stiffness far below any contact's holds it.
        r_x = r_x - 1e-12 * max(float(np.abs(r_x).max()), 1.0) * np.eye(2)
        own, by_centre = -np.linalg.solve(r_x, here[:, :2, None]), -np.linalg.solve(r_x, r_a)
        moves.append((own, by_centre))
        stiffness += placed.place.T @ np.sum((h_a + h_x @ by_centre) @ row.by_ring, axis=0) @ placed.place
        unbalanced -= placed.place.T @ (here[:, 2:] + (h_x @ own)[:, :, 0]).sum(axis=0)
    return stiffness, unbalanced, moves


def at_rest(problem: BalanceProblem) -> tuple[Array, Sequence[Array]]:
    """A start: the set at rest, each ball a spring along the line between its groove centres.

    Its energy is convex in the shaft's displacement; a stiffness is added while a step does not lower it.
    """
    free, scale, shaft, added = ~problem.held, problem.scale, np.where(problem.held, problem.shaft, 0.0), 1.0

    def evaluated(shaft: Array) -> tuple[float, Array, Array, list[Array]]:
        energy, slope, matrix = -float(problem.load @ shaft), -problem.load.copy(), np.zeros((CHANNELS, CHANNELS))
        positions = []
        for placed in problem.rows:
            row = placed.row
            centres = row.groove_centres(placed.moved(shaft))
            distance = np.hypot(*centres.T)
            normal = centres / distance[:, None]
            inner_length, outer_length = row.lengths
            (k_i, _), (k_o, _) = row.law("inner", normal), row.law("outer", normal)
            k = (k_i ** (-2.0 / 3.0) + k_o ** (-2.0 / 3.0)) ** -1.5
            delta = distance - inner_length - outer_length
            pressed = np.maximum(delta, 0.0)
            load = k * pressed**1.5
            energy += float(np.sum(0.4 * load * pressed))
            by = np.einsum("bi,bij->bj", normal, row.by_ring @ placed.place)
            slope = slope + load @ by
            matrix += np.einsum("b,bi,bj->ij", 1.5 * k * np.sqrt(pressed), by, by)
            positions.append(normal * (outer_length + delta * (k / k_o) ** (2.0 / 3.0))[:, None])
        return energy, slope / scale, matrix / np.outer(scale, scale), positions

    energy, slope, matrix, positions = evaluated(shaft)
    row = problem.rows[0].row
    typical = float(row.law("inner", np.array([[0.0, 1.0]] * len(row.azimuth)))[0][0])
    typical *= np.sqrt(1e-3 * row.drawing.groove_centre_distance)
    for _ in range(200):
        if not free.any() or np.abs(slope[free]).max() <= 1e-9 * max(np.abs(problem.load / scale).max(), 1e-30):
            break
        stiff = matrix[np.ix_(free, free)] + added * typical * np.eye(int(free.sum()))
        change = np.zeros(CHANNELS)
        change[free] = -np.linalg.solve(stiff, slope[free]) / scale[free]
        tried = evaluated(shaft + change)
        if tried[0] <= energy:
            shaft, (energy, slope, matrix, positions) = shaft + change, tried
            added = max(0.2 * added, 1e-12)
        else:
            added *= 5.0
    return shaft, positions


def at_speed(problem: BalanceProblem, controls: Sequence[Array | None]) -> Equilibrium:
    """The equilibrium that continues the one at rest, by Newton's method in as few steps of speed as it takes.

    Raises:
        NoReferenceError: it is not reached.
    """
    rest = at_rest(problem)
    for count in (1, 2, 4):
        start = rest
        try:
            for part in np.sqrt(np.arange(1, count + 1) / count):
                equilibrium = solve(problem, start, controls, float(part))
                start = equilibrium.shaft, equilibrium.positions
        except (NoReferenceError, np.linalg.LinAlgError):
            continue
        return equilibrium
    raise NoReferenceError("no equilibrium was found on the way from rest")


def stiffness(equilibrium: Equilibrium) -> Array:
    """Of the shaft, by differences between independent equilibria with all channels held; shape (5, 5), SI.

    A sprung ring keeps its spring's force.
    """
    problem, columns = equilibrium.problem, []
    held = np.append(np.ones(5, bool), problem.held[5])
    pressed = [np.maximum(each.delta_i, each.delta_o).max() for each in equilibrium.states]
    step = 1e-4 * max(float(np.max(pressed)), 1e-9)
    for channel in range(5):
        move = step / problem.scale[channel] * np.eye(CHANNELS)[channel]
        loads = []
        for shaft in (equilibrium.shaft + move, equilibrium.shaft - move):
            moved = replace(problem, held=held, shaft=shaft)
            loads.append(solve(moved, (shaft, equilibrium.positions), equilibrium.controls).load[:5])
        columns.append((loads[0] - loads[1]) / (2.0 * move[channel]))
    return np.stack(columns, axis=1)


def settles(equilibrium: Equilibrium) -> bool:
    """Whether Jones's criterion, asked again and again from this equilibrium, comes to controls that it confirms."""
    for _ in range(8):
        rows = zip(equilibrium.problem.rows, equilibrium.states, strict=True)
        controls = [placed.row.jones_control(state) for placed, state in rows]
        if all(
            own is not None and (each == own).all() for each, own in zip(controls, equilibrium.controls, strict=True)
        ):
            return True
        try:
            equilibrium = solve(equilibrium.problem, (equilibrium.shaft, equilibrium.positions), controls)
        except NoReferenceError:
            return False
    return False
