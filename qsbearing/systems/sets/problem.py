"""All cases of a set, made ready for the kernel, solved in stretches, and what is found of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler.kinds import in_c_order
from qsbearing.model.kernel.admissibility import CONVERGED, NO_EQUILIBRIUM, NOT_CONVERGED
from qsbearing.model.kernel.case import OWN_BALL
from qsbearing.model.kernel.shaft import SHAFT, Shafts, shaft_system
from qsbearing.model.kernel.solve_sets import solve_set_cases
from qsbearing.model.kernel.workspace import BALL, WORKSPACE
from qsbearing.model.operation import CHANNELS, Operation
from qsbearing.model.solution.flatten import CaseMaker
from qsbearing.model.solution.rounding import NOISE
from qsbearing.model.solution.solution import Solution
from qsbearing.systems.sets.bearing_set import BearingSet, numbers_around, offset_in_operation, row_scene
from qsbearing.systems.sets.elastic_shaft import PLANES, structure_of
from qsbearing.systems.sets.equilibrium import LARGEST_STEP, Stretch, follow, is_beyond_springs, newton, unsupported
from qsbearing.systems.sets.location import play
from qsbearing.systems.sets.rigid_shaft import SLIDE, one_way_rings
from qsbearing.systems.sets.row import Row
from qsbearing.systems.sets.row_cases import RowCases, RowStates, empty
from qsbearing.systems.sets.start import begin


@dataclass
class Outcome:
    """How the flattened cases ended."""

    q: NDArray
    """The shaft's five channels, the slide of the sprung rings and what is elastic; shape (case, unknown) [m, rad]."""
    status: NDArray
    residual: NDArray
    iterations: NDArray
    fault: NDArray
    """The row that gave way; -1: none."""
    unsupported: NDArray
    """Which unknowns nothing resists although they are loaded; shape (case, unknown)."""
    reached: NDArray
    """The part of loads and speeds up to which an equilibrium was followed."""
    axial: NDArray
    """Load of each row in the direction that it carries; shape (row, case) [N]."""
    largest: NDArray
    """Of the forces on rows, in any direction; shape (case,) [N]."""
    noise: NDArray
    """Up to which size the axial load of a row is rounding, beside forces on rows and balls wedged between rings;
    shape (case,) [N]."""
    held: NDArray
    """Which unknowns are given: values that are prescribed, and rings at what holds them; shape (case, unknown)."""
    play: NDArray
    """`location.play` of a set with rows that stand by their middles; shape (case, 2) [m]."""

    @classmethod
    def of(cls, count: int, rows: int, unknowns: int) -> Outcome:
        """Of so many cases of so many unknowns, not solved yet."""
        numbers = np.zeros(count, np.int32), np.full(count, -1, np.int16)
        return cls(
            np.zeros((count, unknowns)), np.zeros(count, np.int8), np.zeros(count), *numbers,
            np.zeros((count, unknowns), bool), np.ones(count), np.zeros((rows, count)), np.zeros(count),
            np.zeros(count), np.zeros((count, unknowns), bool), np.full((count, 2), np.nan),
        )  # fmt: skip


def solve_directly(
    s: Stretch, cases: NDArray, own: NDArray, matrices: NDArray, offsets: NDArray, loose: NDArray, states: RowStates
) -> None:
    """Solve all cases of a stretch that this method solves; they are marked as solved there.

    Args:
        cases: case records of all rows, (row, case); own, matrices, offsets and states likewise: what the stretch holds
            row by row, offsets counting from where the row touches in operation.
    """
    rows, _, balls = states.controls.shape
    shafts = Shafts(s.load, s.held, s.scale(), s.elasticity, s.rigid, s.place.copy(), np.zeros(s.count, SHAFT))
    shafts.found["is_loose"] = loose
    # Of displacements that are prescribed, the kernel looks at which ones vanish.
    moving = ~s.held | (s.place != 0.0)
    cases["prescribed"] = ((matrices != 0.0) & moving[:, None, :]).any(axis=-1)
    memory = np.zeros(rows, WORKSPACE), np.zeros((rows, balls), BALL)
    filled = in_c_order(*states)  # a stretch of several is in another
    matrices, offsets = in_c_order(matrices, offsets)
    solve_set_cases(cases, *memory, own, matrices, offsets, shafts, shaft_system(s.unknowns), s.tolerance, *filled)
    for whole, part in zip(states, filled, strict=True):
        if part is not whole:
            whole[...] = part
    which = shafts.found["solved"]
    s.solved[:] = which
    s.q[which], s.residual[which] = shafts.q[which], shafts.found["residual"][which]
    s.iterations[:] = shafts.found["iterations"]


class Problem:
    """All cases of a set, made ready for the kernel; what is found of them."""

    def __init__(self, of: BearingSet, offsets: list[NDArray], tolerance: float, threads: int) -> None:
        self.of, self.tolerance, self.threads = of, tolerance, threads
        operation = of.operation
        scenes = {number: of.turning_scene(number) for number in sorted(set(of.alike))}
        spring = None if of.preload is None else of.preload.spring
        numbers = [*vars(operation).values(), *offsets, *(row.position for row in of.rows), of.reference, spring]
        numbers += numbers_around(of)
        shapes = [np.shape(number) for number in numbers if number is not None]
        try:
            self.shape = np.broadcast_shapes(*shapes, *(CaseMaker(scene).shape for scene in scenes.values()))
        except ValueError:
            raise ValueError("the array fields of the set do not broadcast to common case axes") from None
        self.count = prod(self.shape)
        given = {channel.displacement: np.zeros(self.shape) for channel in CHANNELS}
        self.makers = {number: CaseMaker(scene, dict(given)) for number, scene in scenes.items()}
        """Of bearings that are not alike, by their first row."""
        warm = (offset_in_operation(of, number, offset) for number, offset in enumerate(offsets))
        self.offsets = np.nan_to_num([self._flat(offset) for offset in warm])
        self._lever = 0.5 * np.mean(self._of_rows(lambda row: row.bearing.pitch_diameter), axis=0)
        self.structure = structure_of(of, self.shape, self._lever)
        self.matrices = self.structure.matrices
        self.outcome = Outcome.of(self.count, *self.matrices.shape[::3])
        size = max(maker.position_size for maker in self.makers.values())
        balls = max(maker.ball_axis for maker in self.makers.values())
        self.found = empty(len(of.rows), self.count, balls, position_size=size)
        """Of all rows: row, case, ball."""
        self._set_unknowns(spring)
        self._step = LARGEST_STEP * np.min(self._of_rows(lambda row: row.bearing.groove_centre_distance), axis=0)

    def _flat(self, values: Any) -> NDArray:
        array = np.asarray(values, float)
        return np.full(self.count, array) if array.ndim == 0 else np.broadcast_to(array, self.shape).reshape(-1)

    def _of_rows(self, number: Callable[[Row], Any]) -> list[NDArray]:
        """A number of each row over the flattened cases."""
        known = {same: self._flat(number(self.of.rows[same])) for same in self.makers}
        return [known[same] for same in self.of.alike]

    def _set_unknowns(self, spring: Any) -> None:
        """Loads, and which unknowns have their values given or vanish by symmetry."""
        self.load, self._place = self.structure.load.copy(), np.zeros_like(self.structure.load)
        self.held = np.zeros(self.load.shape, bool)
        self.held[:, self.structure.given :] = True
        self._place[:, self.structure.given :] = 1.0
        for i, channel in enumerate(CHANNELS):
            load = getattr(self.of.operation, channel.load)
            displacement = getattr(self.of.operation, channel.displacement)
            if load is not None:
                self.load[:, i] += self._flat(load)
            self.held[:, i] = displacement is not None
            if displacement is not None:
                self._place[:, i] = self._flat(displacement)
        for column in one_way_rings(self.of):  # at what holds them, until they are found to draw away
            self.held[:, column] = True
        self.held[:, SLIDE] = spring is None
        if spring is not None:
            self.load[:, SLIDE] = self._flat(spring)
        given = (self.load[:, 1:5] != 0.0) | (self._place[:, 1:5] != 0.0)  # y, z, tilt y, tilt z
        out_of_xy, out_of_xz = given[:, 1] | given[:, 2], given[:, 0] | given[:, 3]
        around = self.structure
        skew = self._has_uneven_balls | around.bends_askew
        out_of_xy, out_of_xz = out_of_xy | skew | around.bends_in(2), out_of_xz | skew | around.bends_in(1)
        is_thrust = ~out_of_xy & ~out_of_xz & np.all(np.array(self._of_rows(lambda row: row.bearing.ball_count)) >= 2)
        in_xy, in_xz = ~out_of_xy & self._mirrors(0.0), ~out_of_xz & self._mirrors(0.5 * np.pi)
        for plane, vanish in ((2, is_thrust | in_xy), (1, is_thrust | (in_xz & ~in_xy))):
            self.held[:, [*PLANES[plane], *self.structure.unknowns_in(plane)]] |= vanish[:, None]

    @property
    def _has_uneven_balls(self) -> NDArray:
        """Where some row has balls that make nothing symmetric."""
        is_uneven = [maker.has_uneven_balls(0, self.count) for maker in self.makers.values()]
        return np.any([np.broadcast_to(each, self.count) for each in is_uneven], axis=0)

    def _mirrors(self, azimuth: float) -> NDArray:
        """Where the plane at this azimuth is one of symmetry of every row's balls, as the kernel has it."""
        first = self._flat(self.of.operation.first_ball_azimuth)
        turns = (azimuth - first) * np.array(self._of_rows(lambda row: row.bearing.ball_count)) / np.pi
        return np.asarray((np.abs(turns - np.round(turns)) <= 1e-9).all(axis=0))

    def solve(self, part: slice, carried: NDArray) -> None:
        """A stretch of the flattened cases, but for those whose preload at rest is not carried.

        Rings that are held one way are held or free as `held` has it: see `one_way.settle`.
        """
        count = part.stop - part.start
        alike = self.of.alike
        made = {number: maker.make(part.start, part.stop) for number, maker in self.makers.items()}
        cases = np.stack([made[number] for number in alike])
        moved = {
            number: np.broadcast_to(maker.axial_datum_shift(), self.count) for number, maker in self.makers.items()
        }
        shift = np.stack([moved[number][part] for number in alike])
        own = self._own_balls(cases, part.start)
        matrices, offsets, states = self.matrices[:, part], self.offsets[:, part], self.found.part(np.s_[:, part])
        rows = [
            RowCases(cases[r], matrices[r], offsets[r], shift[r], states.part(np.s_[r]), own[r])
            for r in range(len(alike))
        ]
        o = self.outcome
        if any(self.of.is_two_sided):
            o.play[part] = play(self.of, cases, offsets - shift)
        given = self.load[part], self.held[part], self._place[part], self._lever[part], o.play[part]
        place, loose = begin(self.structure, part, cases, offsets - shift, *given)
        s = Stretch(
            rows, self.load[part], self.held[part], place, self.structure.elasticity[part],
            self.structure.rigid, self._lever[part], self._step[part], self.tolerance, o.q[part], o.residual[part],
            o.iterations[part], np.ones(count), np.ones(count), np.full(count, -1),
            np.zeros_like(o.q[part]), np.zeros(count, bool),
        )  # fmt: skip
        o.status[part] = np.where(carried[part], CONVERGED, NO_EQUILIBRIUM)
        solve_directly(s, cases, own, matrices, offsets - shift, loose, states)
        rest = np.flatnonzero(carried[part] & ~s.solved)
        if rest.size:
            is_lost = is_beyond_springs(s, rest)
            lost, rest = rest[is_lost], rest[~is_lost]
            o.status[part][lost], o.unsupported[part][lost, 0] = NO_EQUILIBRIUM, True
            rest = np.setdiff1d(rest, newton(s, rest))
        reached = np.ones(count)
        if rest.size:
            went, reached = follow(s, rest)
            rest = np.setdiff1d(rest, went)
        if rest.size:
            o.status[part][rest] = NOT_CONVERGED
            o.unsupported[part][rest] = unsupported(s, rest)
            for case in rest:
                if s.fault[case] >= 0:
                    rows[s.fault[case]].found.results[case] = s.refused[int(case)]
                    o.fault[part.start + case] = s.fault[case]
            refused = np.array([s.fault[k] >= 0 and s.refused[int(k)]["status"] == NO_EQUILIBRIUM for k in rest])
            o.status[part][rest[refused | o.unsupported[part][rest].any(axis=1)]] = NO_EQUILIBRIUM
            o.reached[part][rest] = reached[rest]
        o.held[part] = self.held[part]
        forces = states.results["load"][..., :3] * cases["force"][..., None]
        o.axial[:, part], o.largest[part] = forces[..., 0], np.abs(forces).max(axis=(0, 2))
        wedged = cases["series_stiffness"] * np.maximum(cases["interference"], 0.0) ** 1.5 * cases["force"]
        least = np.max([row.least_load(np.arange(count)) for row in rows], axis=0)
        o.noise[part] = least + NOISE * np.maximum(o.largest[part], wedged.max(axis=0))
        failed = o.status[part] != CONVERGED
        if failed.any():
            for row in rows:
                codes = row.found.results["status"]
                codes[failed & (codes != NO_EQUILIBRIUM)] = NOT_CONVERGED

    def _own_balls(self, cases: NDArray, begin: int) -> NDArray:
        """Records (row, case, ball) of unequal balls and the like; empty but for two axes where no row has them."""
        each = {number: maker.own_balls(cases[number], begin) for number, maker in self.makers.items()}
        together = np.zeros((*cases.shape, max(own.shape[1] for own in each.values())), OWN_BALL)
        for whole, number in zip(together, self.of.alike, strict=True):
            whole[:, : each[number].shape[1]] = each[number]
        return together

    def row_solution(self, number: int) -> Solution:
        """A row at the displacement found, with all its results."""
        moved = np.einsum("kij,kj->ki", self.matrices[number], self.outcome.q)
        moved[:, 0] += self.offsets[number]
        names = [channel.displacement for channel in CHANNELS]
        given = {name: moved[:, i].reshape(self.shape)[()] for i, name in enumerate(names)}
        maker = CaseMaker(row_scene(self.of, number, Operation(**self.of.operation.turning, **given)))  # type: ignore[arg-type]
        results, positions, controls = self.found.part(np.s_[number])
        balls = maker.ball_axis
        own = np.ascontiguousarray(positions[:, :balls]), np.ascontiguousarray(controls[:, :balls])
        return Solution(maker, None, results, *own, seconds=0.0, threads=self.threads)
