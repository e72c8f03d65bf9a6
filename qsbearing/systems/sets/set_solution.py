"""The solution of a set: the shaft's displacement and stiffness, what each row carries, what is left of the preload."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import qsbearing as qs
from qsbearing.model.effects import RingEffect, as_fitted, as_made
from qsbearing.model.kernel.admissibility import NO_EQUILIBRIUM
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.case_index import Index
from qsbearing.model.solution.of_cases import SolutionOfCases
from qsbearing.model.solution.preload_state import PreloadLoads
from qsbearing.model.solution.ring_stiffness import inverse
from qsbearing.model.solution.rounding import least_force, rounding_of, without_rounding
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.status import Reason
from qsbearing.remarks.remark import Warned, row_name
from qsbearing.systems.sets.axial_growth import SHAFT
from qsbearing.systems.sets.bearing_set import BearingSet, places_on_shaft
from qsbearing.systems.sets.deflection import Deflection, ShaftPoint, solve_known
from qsbearing.systems.sets.drives import torque_sum
from qsbearing.systems.sets.elastic_shaft import Structure
from qsbearing.systems.sets.one_way import nothing_holds, without_idle_rings
from qsbearing.systems.sets.problem import Outcome
from qsbearing.systems.sets.rigid_shaft import SLIDE, UNKNOWNS

AtRest = Callable[[tuple[RingEffect, ...]], tuple[RingEffect, ...]]
"""What of a bearing's ring effects it has at rest and cold: `as_made`, `as_fitted`."""

LENGTH_OF_TILTS = 0.1
"""Metres: makes tilts lengths where stiffnesses are weighed against each other; of the size of a spindle bearing."""


class SetSolution(SolutionOfCases):
    """Solved cases of a set. Arrays lead with the case axes: none for a single case.

    Displacements and loads are the shaft's at the set's reference position, in the order x, y, z, tilt y, tilt z; SI
    units and radians. Cases that did not converge hold NaN; `qs.message` says why and which row has no solution.
    """

    def __init__(
        self,
        of: BearingSet,
        shape: tuple[int, ...],
        row_solution: Callable[[int], Solution],
        structure: Structure,
        outcome: Outcome,
        sides: dict[tuple[int, ...], SetSolution],
        unloaded: Callable[[AtRest | None], SetSolution],
        seconds: float,
        solve: Callable[[BearingSet], SetSolution],
    ) -> None:
        super().__init__(shape, seconds, solve)
        self.set = of
        """What was solved, with the effects that were chosen."""
        self._row_solution = row_solution
        self._structure = structure
        self._outcome = outcome
        self._sides = sides
        self._unloaded = unloaded

    @property
    def codes(self) -> NDArray:
        """How each of the flattened cases ended, by the kernel's codes; shape (case)."""
        return self._outcome.status

    def __getstate__(self) -> dict[str, Any]:
        """Plain data: rows as they are known, and not what the solver works with."""
        return vars(self) | {"rows": self.rows, "_row_solution": None}

    def mark_unsolved(self, cases: NDArray, code: int) -> None:
        """As `Solution.mark_unsolved`."""
        self.codes[np.reshape(cases, -1)] = code
        for row in self.rows:
            row.mark_unsolved(cases, code)

    @cached_property
    def rows(self) -> tuple[Solution, ...]:
        """Each row's own solution, in its own frame: axial displacement and load count in the direction that it
        carries, and so do tilts; azimuths and speeds are the shaft's."""
        return tuple(map(self._row_solution, range(len(self.set.rows))))

    def __repr__(self) -> str:
        name = f"SetSolution of {self.set.name or 'a set'}, {self.set.arrangement}"
        if self.shape:
            return f"{name}: {self.message()}"
        if not self.converged:
            return f"{name}: {self._summary()}\n  {self.message()}"
        lines = [f"{name}: {self._summary()}", *self._channels()]
        for number, (row, load) in enumerate(zip(self.set.rows, self.axial_loads, strict=True)):
            largest = self.rows[number].inner.load.max()
            name = row_name(row, number)
            lines.append(f"  {name}: axial load {load:.6g} N, largest ball load {largest:.6g} N")
        return "\n".join(lines)

    def message(self, index: Index = None) -> str:
        """A sentence or two on how a case ended, and which row has no solution; for several cases without an index, the
        number of cases with each status.

        Raises:
            ValueError: the index does not name one case of this solution.
        """
        return qs.message(self, index)

    def warnings(self, index: Index = None) -> list[Warned]:
        """Sentences on what to beware of in a case, the rows' own warnings among them; of several cases without an
        index, in how many cases each holds.

        Raises:
            ValueError: the index does not name one case of this solution.
        """
        return qs.warnings(self, index)

    @property
    def reason(self) -> Any:
        """`Reason` why there is no equilibrium, as its name; empty where there is one; shape (*cases)."""
        names = np.full(self._outcome.status.shape, "", dtype=f"<U{max(map(len, Reason))}")
        names[self._outcome.unsupported.any(axis=1)] = Reason.UNSUPPORTED
        for number in np.unique(self._outcome.fault[self._outcome.fault >= 0]):
            own = np.asarray(self.rows[number].reason).reshape(-1)
            at = self._outcome.fault == number
            names[at] = own[at]
        names[self._outcome.status != NO_EQUILIBRIUM] = ""
        return str(names[0]) if not self.shape else self._shaped(names)

    @property
    def control_is_consistent(self) -> Any:
        """Whether every row's is; shape (*cases)."""
        return self._shaped(np.all([np.reshape(row.control_is_consistent, -1) for row in self.rows], axis=0))

    @property
    def residual(self) -> Any:
        """Largest imbalance of the shaft over the largest force on it, applied or of a row; shape (*cases)."""
        return self._shaped(self._outcome.residual)

    @property
    def iterations(self) -> Any:
        """Newton iterations of the shaft; shape (*cases)."""
        return self._shaped(self._outcome.iterations)

    @property
    def row_that_gives_way(self) -> Any:
        """Number of the row, from 0, whose own equilibrium ends before the set's; -1: none; shape (*cases)."""
        return self._shaped(self._outcome.fault)

    @cached_property
    def displacement(self) -> NDArray:
        """Of the shaft at the reference position; shape (*cases, 5) [m, m, m, rad, rad].

        Axially from where every row is pressed by its offset and by the preload that is held, and by what heat and
        spacers move it: heat from the reference position, spacers from the row of `BearingSet.axial_datum`.
        """
        return np.asarray(self._shaped(self._known(self._outcome.q[:, :5]), 5))

    @cached_property
    def slide(self) -> Any:
        """How far the sprung outer rings have slid towards their balls; shape (*cases) [m]; None without a spring."""
        if not any(row.sprung for row in self.set.rows):
            return None
        return self._shaped(self._known(self._outcome.q[:, SLIDE]))

    @cached_property
    def row_loads(self) -> NDArray:
        """What each row carries of the shaft's load, about the reference position and in the shaft's axes;
        shape (*cases, row, 5) [N, N m]."""
        parts = [
            np.einsum("kij,ki->kj", matrix, row.load.reshape(-1, 5))[:, :5]
            for matrix, row in zip(self._structure.matrices, self.rows, strict=True)
        ]
        return np.asarray(self._shaped(self._known(np.stack(parts, axis=1)), len(parts), 5))

    @cached_property
    def load(self) -> NDArray:
        """On the shaft at the reference position, shape (*cases, 5) [N, N m]: what was prescribed, or the reaction to a
        prescribed displacement. Loads of the shaft's own, elsewhere, are not in it."""
        beside = -self._structure.load[:, :5]
        if self._structure.elasticity.size:
            beside = beside + np.einsum("kij,kj->ki", self._structure.elasticity[:, :5], self._outcome.q)
        load = self.row_loads.sum(axis=-2) + self._shaped(beside, 5)
        for i, channel in enumerate(CHANNELS):
            given = getattr(self.set.operation, channel.load)
            if getattr(self.set.operation, channel.displacement) is None:
                prescribed = np.asarray(0.0 if given is None else given, float)
                load[..., i] = np.where(np.isnan(load[..., i]), np.nan, prescribed)
        return np.asarray(load)

    @cached_property
    def rounding(self) -> NDArray:
        """Up to which size forces on its rows are rounding; shape (*cases) [N]."""
        least = [np.broadcast_to(least_force(row.bearing), self.shape) for row in self.set.rows]
        return rounding_of(self._shaped(self._outcome.largest), np.max(least, axis=0))

    @cached_property
    def axial_loads(self) -> NDArray:
        """Of each row in the direction that it carries, in +x where that is both or none; what is rounding as zero;
        shape (*cases, row) [N]."""
        loads = self._shaped(self._known(self._outcome.axial.T), len(self.set.rows))
        return without_rounding(loads, self.rounding[..., None])

    @property
    def axial_play(self) -> NDArray | None:
        """`location.play`, shape (*cases, 2) [m]; None without rows that stand by their middle planes."""
        return self._shaped(self._known(self._outcome.play), 2) if any(self.set.is_two_sided) else None

    @cached_property
    def is_axially_free(self) -> Any:
        """Whether nothing holds the shaft along x where it is, within its play; shape (*cases)."""
        is_free = nothing_holds(self.stiffness, [row.stiffness for row in self.rows])
        return np.asarray(self.converged) & is_free & (self.set.operation.axial_displacement is None)

    @cached_property
    def stiffness(self) -> NDArray:
        """The shaft's exact tangent stiffness dF/dd at the reference position; shape (*cases, 5, 5), SI.

        Rows are loads, columns displacements, in the order x, y, z, tilt y, tilt z; all channels, whether load or
        displacement is prescribed. Sprung rings slide so that the spring's force stays what it is. NaN where some row's
        per-ball control contradicts itself: such a row has several solutions side by side and no tangent.
        """
        total, follow = self._tangent, self._followers
        if follow:
            inner = solve_known(total[:, follow][..., follow], total[:, follow, :5])
            total = total[:, :5, :5] - total[:, :5, follow] @ inner
        return np.asarray(self._shaped(self._known(total[:, :5, :5]), 5, 5))

    @cached_property
    def _tangent(self) -> NDArray:
        """Over all unknowns of the flattened cases."""
        parts = [
            matrix.swapaxes(1, 2) @ row.stiffness.reshape(-1, 5, 5) @ matrix
            for matrix, row in zip(self._structure.matrices, self.rows, strict=True)
        ]
        total = np.asarray(sum(parts))
        if self._structure.elasticity.size:
            total = total + self._structure.elasticity
        total[~np.reshape(self.control_is_consistent, -1)] = np.nan
        return without_idle_rings(self.set, total, self._outcome.held)

    @cached_property
    def _deflection(self) -> Deflection:
        loads = np.stack([row.load.reshape(-1, 5) for row in self.rows])
        return Deflection(self.set, self.shape, self._structure, self._outcome.q, loads, self.load.reshape(-1, 5))

    def deflection(self, positions: ArrayLike) -> NDArray:
        """Displacement of the shaft at these positions [m]; shape (*cases, position, 5) [m, m, m, rad, rad].

        Tilt z is the slope of y, tilt y that of -z. Growth by heat is not in it: `axial_growth`.
        """
        along = self._known(self._deflection.along(positions))
        return np.asarray(self._shaped(along, *along.shape[1:]))

    def axial_growth(self, positions: ArrayLike) -> NDArray | None:
        """By how much heat moves these positions [m] of the shaft in +x, seen from the reference position; shape
        (*cases, position) [m]. None: the set names no temperature of it."""
        growth = self.set.growth[SHAFT]
        if not growth.is_evaluated:
            return None
        places = np.atleast_1d(np.asarray(positions, float))
        along = [np.broadcast_to(growth.by_heat(each), self.shape) for each in places]
        return np.where(np.asarray(self.converged)[..., None], np.stack(along, axis=-1), np.nan)

    def inner_forces(self, positions: ArrayLike) -> NDArray:
        """Axial force, shear forces and bending moments of the shaft at these positions [m]: what its part beyond, in
        +x, does to that before; shape (*cases, position, 5) [N, N, N, N m, N m]."""
        along = self._known(self._deflection.inner_forces(positions))
        return np.asarray(self._shaped(along, *along.shape[1:]))

    @cached_property
    def support_loads(self) -> NDArray:
        """What each support of the shaft carries; shape (*cases, support, 5) [N, N m]."""
        loads = self._known(-self._deflection.supports)
        return np.asarray(self._shaped(loads, *loads.shape[1:]))

    @property
    def torque_sum(self) -> NDArray | None:
        """Of gears and belts, about +x; shape of the cases that it spans [N m]. None: there are none."""
        return None if self.set.shaft is None else torque_sum(self.set.shaft, self.set.operation.speed)

    @cached_property
    def points(self) -> dict[str, ShaftPoint]:
        """The shaft's named points: deflection, compliance, and the parts that contribute to it."""
        return {} if self.set.shaft is None else {name: self.point(at) for name, at in self.set.shaft.points.items()}

    @cached_property
    def line(self) -> dict[str, dict[str, NDArray | None]]:
        """What the shaft does at its ends and where something stands on it: `deflection`, `inner_forces` and
        `axial_growth` of each, under the name of the place."""
        along = places_on_shaft(self.set)
        at = [*along.values()]
        moved, forces, grown = self.deflection(at), self.inner_forces(at), self.axial_growth(at)
        return {
            name: {
                "displacement": moved[..., i, :],
                "inner_forces": forces[..., i, :],
                "axial_growth": None if grown is None else grown[..., i],
            }
            for i, name in enumerate(along)
        }

    def point(self, position: float) -> ShaftPoint:
        """As one of `points`, of any position on the shaft [m]."""
        rows = np.stack([row.stiffness.reshape(-1, 5, 5) for row in self.rows])
        free = [*self.free_channels, *self._followers]
        compliance, parts = self._deflection.compliance(position, self._tangent, free, rows)
        shares = {name: np.asarray(self._shaped(self._known(part), 5)) for name, part in parts.items()}
        compliance = np.asarray(self._shaped(self._known(compliance), 5, 5))
        growth = self.axial_growth(position)
        growth = None if growth is None else growth[..., 0]
        return ShaftPoint(position, self.deflection(position)[..., 0, :], compliance, shares, growth)

    @property
    def _followers(self) -> list[int]:
        """Unknowns that go where their equations take them: the slide and what is elastic."""
        return [*([] if self.slide is None else [SLIDE]), *range(UNKNOWNS, self._structure.given)]

    @cached_property
    def unmounted(self) -> SetSolution | None:
        """The set at rest and cold under its preload alone, before its rings are fitted, straight and centred; None
        where nothing presses one row against another."""
        return self._unloaded(as_made) if self.set.is_opposed else None

    @cached_property
    def mounted(self) -> SetSolution | None:
        """The set at rest and cold, with its fits and nothing else acting; None where nothing presses one row against
        another."""
        return self._unloaded(as_fitted) if self.set.is_opposed else None

    @cached_property
    def without_load(self) -> SetSolution | None:
        """The set in operation without its external loads, straight and centred; None where nothing presses one row
        against another."""
        return self._unloaded(None) if self.set.is_opposed else None

    @property
    def preload_unmounted(self) -> NDArray | None:
        """Axial load of each row at rest and cold, before fitting, nothing else acting; shape (*cases, row) [N]; None
        where nothing presses one row against another."""
        return self._spread(self.unmounted)

    @property
    def preload_mounted(self) -> NDArray | None:
        """Axial load of each row at rest after fitting, nothing else acting; shape (*cases, row) [N]; None where
        nothing presses one row against another."""
        return self._spread(self.mounted)

    @property
    def preload_at_rest(self) -> NDArray | None:
        """`preload_mounted` with `Preload(mounted=...)`, else `preload_unmounted`; shape (*cases, row) [N]; or None."""
        return self.preload_mounted if self._is_given_mounted else self.preload_unmounted

    @cached_property
    def preload_given(self) -> NDArray | None:
        """What the preload alone gives each row, where it is a force that holds the rings: without offsets and spacers.
        Else what lengths or a spring make at rest; shape (*cases, row) [N]; None where nothing presses one
        row against another."""
        at_rest = self.preload_at_rest
        if at_rest is None:
            return None
        given = np.array(at_rest)
        for numbers, side in self._sides.items():
            given[..., list(numbers)] = side.axial_loads
        return np.where(given != 0.0, given, at_rest)

    @property
    def _is_given_mounted(self) -> bool:
        return self.set.preload is not None and self.set.preload.is_given_mounted

    @property
    def preload_in_operation(self) -> NDArray | None:
        """What is left of it, or has grown, in operation without external loads; shape (*cases, row) [N]; None
        where nothing presses one row against another."""
        return self._spread(self.without_load)

    @cached_property
    def preload_loads(self) -> PreloadLoads | None:
        """What is given, left and carried, of each row; None where nothing presses one row against another."""
        if not self.set.is_opposed:
            return None
        together = [each for each in (self, self.mounted, self.without_load) if each is not None]
        rounding = np.max([np.broadcast_to(each.rounding, self.shape) for each in together], axis=0)
        loads = self.preload_given, self.preload_in_operation, self.axial_loads
        return PreloadLoads(*loads, np.broadcast_to(rounding[..., None], self.axial_loads.shape))

    @cached_property
    def free_channels(self) -> NDArray:
        """Numbers of the channels whose load is prescribed; shape (channel)."""
        given = [getattr(self.set.operation, channel.displacement) for channel in CHANNELS]
        return np.flatnonzero([displacement is None for displacement in given])

    @cached_property
    def compliance(self) -> NDArray:
        """Inverse of the stiffness over the free channels, those whose load is prescribed; shape (*cases, 5, 5), SI.

        NaN for channels whose displacement is prescribed, where a case is not solved, and where nothing resists some
        free direction.
        """
        out = np.full((*self.shape, 5, 5), np.nan)
        free = self.free_channels
        if not free.size:
            return out
        scale = np.ones(5)
        scale[3:] = 1.0 / LENGTH_OF_TILTS
        sizes = scale[free, None] * scale[free]
        out[..., free[:, None], free] = inverse(self.stiffness[..., free[:, None], free] * sizes) * sizes
        return out

    def to_ross(self, n: int, index: Any = None, **arguments: Any) -> Any:
        """One bearing element of ROSS for the whole set, at the node of its reference position; needs the `ross` extra.

        As `Solution.to_ross`; for an element per row, at a node each: `rows[i].to_ross(n, mirrored=...)`, mirrored
        where the row carries in -x.

        Raises:
            SceneError: every error of the arguments; cases that are not solved.
            ImportError: ROSS is not installed.
        """
        return qs.ross_element(self, n, index, **arguments)

    def to_ross_rotor(self, *, disks: Sequence[dict[str, Any]] = (), longest: float = 0.5) -> Any:
        """The whole as a rotor of ROSS: the shaft's elements, each row with its stiffness over the speed in series with
        its housing's, and the supports; needs the `ross` extra.

        A node stands at each row, support, load, point and step of the shaft. The rows that slide in one sleeve have
        each its own axial stiffness in ROSS, less than that by which the sleeve would follow; their coupling through
        the sleeve has no place there.

        Args:
            disks: what is on the shaft, arguments of ROSS's `DiskElement` each: m, Id, Ip, and `position` [m] for n.
            longest: element, in outer diameters.

        Raises:
            SceneError: no shaft, more than one axis of cases, cases that are not solved, or a speed that falls.
            ImportError: ROSS is not installed.
        """
        from qsbearing.systems.sets.rotor import rotor_of

        return rotor_of(self, self._deflection.turned, self._outcome.held, disks, longest)

    def _spread(self, other: SetSolution | None) -> NDArray | None:
        return None if other is None else np.broadcast_to(other.axial_loads, (*self.shape, len(self.rows)))


def ends_of(solution: SetSolution) -> tuple[Outcome, dict[tuple[int, ...], SetSolution]]:
    """How the flattened cases ended; and of a preload given as a force the rows of each direction alone, at rest."""
    return solution._outcome, solution._sides
