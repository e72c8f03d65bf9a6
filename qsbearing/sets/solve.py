"""`solve_set`: all cases of a set of rows on one shaft."""

from __future__ import annotations

import time
from dataclasses import replace
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.effects import as_made
from qsbearing.flatten import CaseMaker
from qsbearing.kernel.admissibility import CONVERGED, NO_EQUILIBRIUM, NOT_CONVERGED
from qsbearing.scene.operation import CHANNELS, Operation
from qsbearing.sets.bearing_set import BearingSet
from qsbearing.sets.equilibrium import LARGEST_STEP, Stretch, follow, newton, unsupported
from qsbearing.sets.rigid_shaft import SLIDE, UNKNOWNS, row_matrix
from qsbearing.sets.row_cases import RowCases, empty
from qsbearing.sets.set_solution import Outcome, SetSolution
from qsbearing.solution import Solution
from qsbearing.solver import TOLERANCE
from qsbearing.threads import in_threads, thread_count

STRAIGHT = {"radial_displacement_y": 0.0, "radial_displacement_z": 0.0, "tilt_y": 0.0, "tilt_z": 0.0}
"""A shaft that is neither moved sideways nor tilted."""
TURNING = ("speed", "outer_speed", "first_ball_azimuth")
CHOICES_OF_CONTACT = ("hertz_angle", "hertz_form", "tilt_lever")


def solve_set(of: BearingSet, *, threads: int | None = None, tolerance: float = TOLERANCE) -> SetSolution:
    """Solve every case of a set.

    Args:
        of: what to solve; its array fields broadcast to the case axes.
        threads: at most this many; None: the environment variable QSBEARING_THREADS, else all cores.
        tolerance: largest imbalance over the largest force at which a case counts as solved. Where rounding forbids
            it, 1e-10 is accepted and `SetSolution.residual` tells.

    Returns:
        SetSolution: raises nothing for a physical outcome; `status` and `message` say what happened and which row
        gives way.

    Raises:
        ValueError: array fields that do not broadcast, a tolerance or thread count out of range.
    """
    if not 0.0 < tolerance <= 0.1:
        raise ValueError(f"tolerance = {tolerance}: must lie between 0 and 0.1")
    began = time.perf_counter()
    workers = thread_count(threads)
    sides = _sides(of, threads, tolerance)
    offsets = _offsets(of, sides)
    problem = _Problem(of, offsets, tolerance)
    mounted = [np.broadcast_to(side.converged, problem.shape).reshape(-1) for side in sides.values()]
    carried = np.logical_and.reduce(mounted) if mounted else np.ones(problem.count, bool)

    in_threads(lambda part: problem.solve(part.start, part.stop, carried), problem.count, workers)
    rows = [problem.row_solution(number, workers) for number in range(len(of.rows))]

    def unloaded(at_speed: bool) -> SetSolution:
        return solve_set(without_load(of, offsets, at_speed), threads=threads, tolerance=tolerance)

    seconds = time.perf_counter() - began
    return SetSolution(of, problem.shape, rows, problem.matrices, problem.outcome, sides, unloaded, seconds)


def without_load(of: BearingSet, offsets: list[NDArray], at_speed: bool) -> BearingSet:
    """The set under its preload alone, straight and centred: in operation, or at rest and cold."""
    rows = tuple(
        replace(row, offset=np.nan_to_num(offset)[()], readings=None)
        for row, offset in zip(of.rows, offsets, strict=True)
    )
    preload = of.preload if of.preload is not None and of.preload.kind == "spring" else None
    if at_speed:
        turning = {name: getattr(of.operation, name) for name in TURNING}
        return replace(of, rows=rows, preload=preload, operation=Operation(**turning, **STRAIGHT), readings={})
    cold = tuple(replace(row, ring_effects=as_made(of.effects_of(row))) for row in rows)
    choices = {name: getattr(of, name) for name in CHOICES_OF_CONTACT}
    return BearingSet(cold, Operation(**STRAIGHT), preload, of.reference_position, **choices)


def _sides(of: BearingSet, threads: int | None, tolerance: float) -> dict[float, SetSolution]:
    """Under a rigid preload: the rows of either direction alone, at rest and cold, under the preload."""
    if of.preload is None or of.preload.kind != "rigid":
        return {}
    choices = {name: getattr(of, name) for name in CHOICES_OF_CONTACT}
    force = np.asarray(of.preload.rigid, float)
    sides = {}
    for sign in (1.0, -1.0):
        rows = tuple(
            replace(row, ring_effects=as_made(of.effects_of(row)), readings=None) for row in of.rows if row.sign == sign
        )
        side = BearingSet(rows, Operation(axial_load=(sign * force)[()], **STRAIGHT), **choices)
        sides[sign] = solve_set(side, threads=threads, tolerance=tolerance)
    return sides


def _offsets(of: BearingSet, sides: dict[float, SetSolution]) -> list[NDArray]:
    """How far each row is pressed together while the shaft is at its zero [m]; NaN where its side is not solved."""
    common: dict[float, Any] = {1.0: 0.0, -1.0: 0.0}
    if sides:
        common = {sign: sign * side.displacement[..., 0] for sign, side in sides.items()}
    elif of.preload is not None and of.preload.kind == "axial_displacement":
        half = 0.5 * np.asarray(of.preload.axial_displacement, float)
        common = {1.0: half, -1.0: half}
    return [np.asarray(row.offset, float) + common[row.sign] for row in of.rows]


class _Problem:
    """All cases of a set, made ready for the kernel; what is found of them."""

    def __init__(self, of: BearingSet, offsets: list[NDArray], tolerance: float) -> None:
        self.of, self.tolerance = of, tolerance
        operation = of.operation
        self._turning = {name: getattr(operation, name) for name in TURNING}
        scenes = [of.row_scene(number, Operation(**self._turning)) for number in range(len(of.rows))]
        spring = None if of.preload is None else of.preload.spring
        numbers = [*vars(operation).values(), *offsets, *(row.position for row in of.rows), of.reference, spring]
        shapes = [np.shape(number) for number in numbers if number is not None]
        try:
            self.shape = np.broadcast_shapes(*shapes, *(CaseMaker(scene).shape for scene in scenes))
        except ValueError:
            raise ValueError("the array fields of the set do not broadcast to common case axes") from None
        self.count = prod(self.shape)
        given = {channel.displacement: np.zeros(self.shape) for channel in CHANNELS}
        self.makers = [CaseMaker(scene, dict(given)) for scene in scenes]
        self.matrices = [row_matrix(of, number, self.shape) for number in range(len(of.rows))]
        self.offsets = [np.nan_to_num(self._flat(offset)) for offset in offsets]
        self.outcome = Outcome.of(self.count)
        self.found = [empty(self.count, maker.ball_axis) for maker in self.makers]
        self._set_unknowns(spring)
        pitch = [self._flat(row.bearing.pitch_diameter) for row in of.rows]
        self._lever = 0.5 * np.mean(pitch, axis=0)
        self._step = LARGEST_STEP * np.min([self._flat(row.bearing.groove_centre_distance) for row in of.rows], axis=0)

    def _flat(self, values: Any) -> NDArray:
        return np.broadcast_to(np.asarray(values, float), self.shape).reshape(-1)

    def _set_unknowns(self, spring: Any) -> None:
        """Loads, and which unknowns have their values given or vanish by symmetry."""
        self._load, self._place = np.zeros((self.count, UNKNOWNS)), np.zeros((self.count, UNKNOWNS))
        self._held = np.zeros((self.count, UNKNOWNS), bool)
        for i, channel in enumerate(CHANNELS):
            load = getattr(self.of.operation, channel.load)
            displacement = getattr(self.of.operation, channel.displacement)
            if load is not None:
                self._load[:, i] = self._flat(load)
            self._held[:, i] = displacement is not None
            if displacement is not None:
                self._place[:, i] = self._flat(displacement)
        self._held[:, SLIDE] = spring is None
        if spring is not None:
            self._load[:, SLIDE] = self._flat(spring)
        given = (self._load[:, 1:5] != 0.0) | (self._place[:, 1:5] != 0.0)  # y, z, tilt y, tilt z
        out_of_xy, out_of_xz = given[:, 1] | given[:, 2], given[:, 0] | given[:, 3]
        out_of_xy |= self._has_unequal_balls
        out_of_xz |= self._has_unequal_balls
        is_thrust = ~out_of_xy & ~out_of_xz & np.all([self._flat(row.bearing.ball_count) >= 2 for row in self.of.rows])
        in_xy, in_xz = ~out_of_xy & self._mirrors(0.0), ~out_of_xz & self._mirrors(0.5 * np.pi)
        for channels, vanish in (((2, 3), is_thrust | in_xy), ((1, 4), is_thrust | (in_xz & ~in_xy))):
            self._held[:, channels] |= vanish[:, None]

    @property
    def _has_unequal_balls(self) -> NDArray:
        """Where some row has balls that make nothing symmetric."""
        return np.any([np.broadcast_to(maker.has_unequal_balls(0, self.count), self.count) for maker in self.makers], 0)

    def _mirrors(self, azimuth: float) -> NDArray:
        """Where the plane at this azimuth is one of symmetry of every row's balls, as the kernel has it."""
        first = self._flat(self.of.operation.first_ball_azimuth)
        turns = [(azimuth - first) * self._flat(row.bearing.ball_count) / np.pi for row in self.of.rows]
        return np.asarray(np.all([np.abs(each - np.round(each)) <= 1e-9 for each in turns], axis=0))

    def solve(self, begin: int, stop: int, carried: NDArray) -> None:
        """The flattened cases [begin, stop), but for those whose preload at rest is not carried."""
        part, count = slice(begin, stop), stop - begin
        rows = [
            RowCases.of(maker, matrix, offset, begin, stop)
            for maker, matrix, offset in zip(self.makers, self.matrices, self.offsets, strict=True)
        ]
        o = self.outcome
        s = Stretch(
            rows, self._load[part], self._held[part], self._place[part], self._lever[part], self._step[part],
            self.tolerance, o.q[part], o.residual[part], o.iterations[part], np.ones(count), np.ones(count),
            np.full(count, -1),
        )  # fmt: skip
        cases = np.flatnonzero(carried[part])
        o.status[part] = NO_EQUILIBRIUM
        o.status[part][cases] = CONVERGED
        rest = np.setdiff1d(cases, newton(s, cases))
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
                    o.fault[begin + case] = s.fault[case]
            refused = np.array([s.fault[k] >= 0 and s.refused[int(k)]["status"] == NO_EQUILIBRIUM for k in rest])
            o.status[part][rest[refused | o.unsupported[part][rest].any(axis=1)]] = NO_EQUILIBRIUM
            o.reached[part][rest] = reached[rest]
        failed = o.status[part] != CONVERGED
        for row, found in zip(rows, self.found, strict=True):
            results = row.found.results
            results["status"][failed & (results["status"] != NO_EQUILIBRIUM)] = NOT_CONVERGED
            found.put(np.arange(begin, stop), row.found)

    def row_solution(self, number: int, threads: int) -> Solution:
        """A row at the displacement found, with all its results."""
        moved = np.einsum("kij,kj->ki", self.matrices[number], self.outcome.q)
        moved[:, 0] += self.offsets[number]
        names = [channel.displacement for channel in CHANNELS]
        given = {name: moved[:, i].reshape(self.shape)[()] for i, name in enumerate(names)}
        maker = CaseMaker(self.of.row_scene(number, Operation(**self._turning, **given)))
        return Solution(maker, None, *self.found[number], seconds=0.0, threads=threads)
