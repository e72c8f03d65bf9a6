"""The solution: what was solved, how it ended, and everything that can be read off it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.effects import OperatingPoint, RingState
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.kernel import results
from qsbearing.model.kernel.admissibility import CONVERGED, NO_CONSISTENT_CONTROL, UNLOADED_RING
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution import ring_stiffness
from qsbearing.model.solution.columns import columns, dataset
from qsbearing.model.solution.flatten import CaseMaker
from qsbearing.model.solution.of_arcs import SolutionOfArcs
from qsbearing.model.solution.preload_state import PreloadLoads
from qsbearing.model.solution.raceway_contacts import (
    CALLED_FOR_BY,
    CODES,
    Lazy,
    RacewayContacts,
)
from qsbearing.model.solution.ring_shape import RingShape, shape_of, share_of_displacement
from qsbearing.model.solution.rounding import rounding_of_load
from qsbearing.model.solution.solved_cases import OfSolvedCases, SolvedCases
from qsbearing.model.solution.status import reasons
from qsbearing.model.units import deg

if TYPE_CHECKING:
    import pandas
    import xarray

    from qsbearing.model.solution.friction_balance import FrictionMotion
    from qsbearing.model.solution.moved import Moved


class Solution(SolutionOfArcs, OfSolvedCases):
    """Solved cases of a scene. Arrays lead with the case axes of the scene: none for a single case.

    Displacements and loads are in the order x, y, z, tilt y, tilt z; SI units and radians. Cases that did not converge
    hold NaN everywhere but in `status`, `iterations` and `residual`; `message` says why.
    """

    def __init__(
        self,
        maker: CaseMaker,
        cases: NDArray | None,
        results: NDArray,
        positions: NDArray,
        controls: NDArray,
        seconds: float,
        threads: int,
        preloaded: Solution | None = None,
        solve: Callable[[Scene], Solution] | None = None,
        moved: Moved | None = None,
    ) -> None:
        super().__init__(maker.shape, seconds, solve)
        self.threads = threads
        """At most so many solved it, and read it off."""
        self.scene: Scene = maker.scene
        """What was solved, with the effects that were chosen."""
        self._preloaded = preloaded
        self._moved = moved  # arrays and stiffness where friction moves the balls; None by a hypothesis
        known = None if moved is None else moved.known
        self._keep_solved(SolvedCases(maker, cases, results, positions, controls, threads, known))

    @property
    def balance(self) -> FrictionMotion | None:
        """Of friction, where it moves the balls: without numbers at rest; None by a hypothesis."""
        return None if self._moved is None else self._moved.motion

    @property
    def friction(self) -> FrictionMotion | None:
        """The same; None at rest as well."""
        return None if self._moved is None or self._moved.is_at_rest else self._moved.motion

    @property
    def codes(self) -> NDArray:
        """How each of the flattened cases ended, by the kernel's codes; shape (case)."""
        return np.asarray(self._solved.results["status"])

    def mark_unsolved(self, cases: NDArray, code: int) -> None:
        """Count these cases as not solved, before anything is read off: they are in equilibrium, but not for long.

        Args:
            cases: a mask; shape (*cases).
            code: of the kernel, for their status.
        """
        self.codes[np.reshape(cases, -1)] = code

    @property
    def inner(self) -> RacewayContacts:
        """Contacts with the inner raceway."""
        return RacewayContacts(partial(self._array, row=results.AT_INNER))

    @property
    def outer(self) -> RacewayContacts:
        """Contacts with the outer raceway."""
        return RacewayContacts(partial(self._array, row=results.AT_OUTER))

    @property
    def operating_point(self) -> OperatingPoint:
        """The solution as the indicators of effects read it; not kept, since it holds the solution."""
        return OperatingPoint(self)

    def __repr__(self) -> str:
        name = f"Solution of {self.scene.bearing.name or 'a bearing'}"
        if self.shape:
            return f"{name}: {self._solved.maker.count} cases {self.shape}, {self.counts()}"
        if not self.converged:
            return f"{name}: {self._summary()}{', ' if self.reason else ''}{self.reason}"
        lines = [f"{name}: {self._summary()}", *self._channels()]
        others = [] if self.opposite is None else zip(("inner", "outer"), self.opposite, strict=True)
        beside = [(f"{side}, opposite", each) for side, each in others if each is not None]
        for side, contacts in (("inner", self.inner), ("outer", self.outer), *beside):
            angles = contacts.angle[contacts.load > 0.0] / deg
            if angles.size:
                span = " to ".join(dict.fromkeys(f"{angle:.5g}" for angle in (angles.min(), angles.max())))
                lines.append(f"  {side} raceway: largest load {contacts.load.max():.6g} N, contact angle {span} deg")
        return "\n".join(lines)

    def read_at_once(self, contacts: Iterable[str] = (), balls: Iterable[str] = ()) -> None:
        """Read several arrays off in one pass, which takes less time than one after the other as they are asked for.

        Args:
            contacts: names of arrays of both raceways, such as "angle".
            balls: names of arrays of the balls, such as "orbital_speed". What the scene does not call for is left out.
        """
        of_contacts = [(row, name) for row in (results.AT_INNER, results.AT_OUTER) for name in contacts]
        requested = [*of_contacts, *((results.OF_BALL, name) for name in balls)]
        self._solved.read_all([(row, CODES[name]) for row, name in requested if self._has(name)])

    def _has(self, name: str) -> bool:
        """Whether the scene calls for an array of contacts or balls."""
        return name not in CALLED_FOR_BY or getattr(self.scene, CALLED_FOR_BY[name]) is not None

    def _array(self, name: str, row: int = results.OF_BALL) -> NDArray | None:
        if name not in CODES:
            return self._moved.apex.get(row) if self._moved is not None else None
        return self._solved.read(row, CODES[name]) if self._has(name) else None

    @property
    def reason(self) -> Any:
        """`Reason` why there is no equilibrium, as its name; empty where there is one; shape (*cases)."""
        names = reasons(self._solved.results)
        return str(names[0]) if not self.shape else self._shaped(names)

    @property
    def control_is_consistent(self) -> Any:
        """Whether every ball's raceway control is the one that Jones's criterion then calls for; shape (*cases).

        Asked only under per-ball control; True elsewhere.
        """
        return self._shaped((self._solved.results["notes"] & NO_CONSISTENT_CONTROL) == 0)

    @property
    def ring_is_unloaded(self) -> Any:
        """Whether no load acts on the ring and nothing holds it, so that its position is arbitrary; shape (*cases)."""
        return self._shaped((self._solved.results["notes"] & UNLOADED_RING) != 0)

    @property
    def iterations(self) -> Any:
        """Newton iterations spent, fallbacks included; shape (*cases)."""
        return self._shaped(self._solved.results["iterations"])

    @property
    def residual(self) -> Any:
        """Largest imbalance of a ball or the ring over the largest applied or inertial force; shape (*cases) [-].
        NaN: not computed."""
        is_known = (self._solved.results["status"] == CONVERGED) | (self._solved.results["iterations"] > 0)
        return self._shaped(np.where(is_known, self._solved.results["residual"], np.nan))

    @property
    def speed_reached(self) -> Any:
        """The part of the speed that the status is for; shape (*cases).

        1 but where an equilibrium continued in speed was found to end below it: then the part that shows it.
        """
        return self._shaped(self._solved.results["reached"])

    @cached_property
    def displacement(self) -> NDArray:
        """Of the inner ring; shape (*cases, 5) [m, m, m, rad, rad].

        Axially from where the free contact angle is just reached at rest and cold; ring effects do not move that place.
        """
        out = self._known(self._solved.results["displacement"])
        for part, cases in self._solved.stretches():
            out[part, :3] *= cases["length"][:, None]
        out[:, 0] += self._solved.maker.axial_datum_shift()
        return self._shaped(out, 5)

    @cached_property
    def load(self) -> NDArray:
        """On the inner ring, reactions of prescribed displacements included; shape (*cases, 5) [N, N, N, N m, N m]."""
        out = self._known(self._solved.results["load"])
        for part, cases in self._solved.stretches():
            out[part] *= cases["force"][:, None]
            out[part, 3:] *= cases["length"][:, None]
        return self._shaped(out, 5)

    @cached_property
    def azimuth(self) -> NDArray:
        """Of the balls, from +y towards +z; shape (*cases, ball) [rad]."""
        balls = self._solved.maker.ball_axis
        count = np.asarray(self.scene.bearing.ball_count, float)[..., None]
        first = np.asarray(self.scene.operation.first_ball_azimuth, float)[..., None]
        index = np.arange(balls)
        azimuth = np.where(index < count, first + 2.0 * np.pi * index / count, np.nan)
        return np.broadcast_to(azimuth, (*self.shape, balls))

    @property
    def ball_diameter_deviation(self) -> NDArray | None:
        """Of each ball, as the scene gives it; shape (*cases, ball) [m]; None where it names no unequal balls."""
        given = self.scene.ball_diameter_deviations
        return None if given is None else np.broadcast_to(given.array, (*self.shape, self._solved.maker.ball_axis))

    centrifugal_force = Lazy[NDArray | None](
        "Of each ball; shape (*cases, ball) [N]; None where the scene does not name it."
    )
    gyroscopic_moment = Lazy[NDArray | None](
        "Mg of each ball, signed: negative under a turning inner ring; shape (*cases, ball) [N m]. None where the "
        "scene does not name it."
    )

    @cached_property
    def slips(self) -> NDArray | None:
        """Whether each ball slips: some contact is asked for more friction than its coefficient allows.

        Shape (*cases, ball); False where there is no ball; None where the scene gives no `friction_coefficient`.
        """
        moment = self.scene.gyroscopic_moment
        if moment is None or moment.friction_coefficient is None:
            return None
        return np.asarray(self._solved.read(results.OF_BALL, results.SLIPS) == 1.0)

    orbital_speed = Lazy[NDArray | None](
        "omega_m of each ball's centre about the bearing axis; shape (*cases, ball) [rad/s]. None without ball effects."
    )
    rotation_speed = Lazy[NDArray | None](
        "omega_R of each ball about its own axis, signed: negative under a turning inner ring; shape (*cases, ball) "
        "[rad/s]; None without a ball effect."
    )
    attitude_angle = Lazy[NDArray | None](
        "beta of each ball's rotation axis against the bearing axis, in the ball's plane; shape (*cases, ball) [rad]. "
        "Its rotation is omega_R (cos(beta) e_x - sin(beta) e_r), e_r outward at its azimuth; None without a ball "
        "effect. Where friction moves balls, the axis also leaves this plane, by `friction.yaw_angle`; omega_R is the "
        "whole rotation."
    )
    axial_rotation = Lazy[NDArray | None](
        "omega_R cos(beta) about +x; shape (*cases, ball) [rad/s]; None without a ball effect."
    )
    radial_rotation = Lazy[NDArray | None](
        "omega_R sin(beta), towards the axis; shape (*cases, ball) [rad/s]; None without a ball effect."
    )

    @cached_property
    def raceway_control(self) -> NDArray | None:
        """Of each ball: "outer", "inner", or of all "minimum_dissipation" or "friction"; None without a ball effect.

        Shape (*cases, ball). Where a gyroscopic moment acts, the outer raceway controls a ball off the inner one.
        """
        if self.scene.raceway_control is None:
            return None
        names = np.array(["outer", "inner", "", str(RacewayControl.MINIMUM_DISSIPATION)])
        if self.scene.raceway_control is RacewayControl.FRICTION:
            return np.where(np.isnan(self.azimuth), "", str(RacewayControl.FRICTION))
        index = np.where(np.isnan(self.azimuth), 2, self._shaped(self._solved.controls, self._solved.maker.ball_axis))
        return names[index]

    @cached_property
    def preload_at_rest(self) -> Any:
        """The preload as it is given: the axial load at rest and cold, nothing else acting, before fitting or, with
        `Preload(mounted=...)`, after it; shape (*cases) [N]; None without a preload.

        What it has become in operation is the axial load, `load[..., 0]`.
        """
        preload = self.scene.preload
        if preload is None:
            return None
        at_rest = preload.spring if self._preloaded is None else self._preloaded.load[..., 0]
        return np.broadcast_to(np.asarray(at_rest, float), self.shape)[()]

    @cached_property
    def preload_unmounted(self) -> Any:
        """The axial load at rest and cold, before fitting, the rings where the preload holds them; None without one."""
        return self._preload_of(self.at_rest(False))

    @cached_property
    def preload_mounted(self) -> Any:
        """The axial load at rest after fitting, at the reference temperature; None without preload."""
        return self._preload_of(self.at_rest(True))

    @cached_property
    def preload_in_operation(self) -> Any:
        """The axial load in operation without radial loads and moments, straight and centred; None without preload."""
        if self._preloaded is None or self._solve_alike is None:
            return self.preload_at_rest
        unloaded = replace(self.scene, operation=self.scene.operation.unloaded, readings={})
        return self._preload_of(self._solve_alike(unloaded))

    def at_rest(self, fitted: bool) -> Solution | None:
        """The bearing before or after fitting, the rings where the preload holds them; None where none does."""
        if self._preloaded is None or self._solve_alike is None or self.scene.preload is None:
            return None
        if fitted == self.scene.preload.is_given_mounted:
            return self._preloaded
        held = np.nan_to_num(self._preloaded.displacement[..., 0])[()]
        return self._solve_alike(self.scene.at_rest(fitted, axial_displacement=held))

    def _preload_of(self, other: Solution | None) -> Any:
        if other is None:
            return self.preload_at_rest
        load = np.where(np.isnan(self.preload_at_rest), np.nan, other.load[..., 0])
        return np.broadcast_to(load, self.shape)[()]

    @cached_property
    def preload_loads(self) -> PreloadLoads | None:
        """What is given, left without radial loads and moments, and carried; fields (*cases); None without preload."""
        if self.preload_at_rest is None:
            return None
        loads = self.preload_at_rest, self.preload_in_operation, self.load[..., 0]
        return PreloadLoads(*loads, rounding_of_load(self.load, self.scene.bearing))

    @cached_property
    def inner_ring(self) -> RingState | None:
        """Seat pressure, growth and stress of the inner ring; fields (*cases); None without ring expansion."""
        return self._ring_state(0)

    @cached_property
    def outer_ring(self) -> RingState | None:
        """Seat pressure, growth and stress of the outer ring; fields (*cases); None without ring expansion."""
        return self._ring_state(1)

    @cached_property
    def inner_shape(self) -> RingShape | None:
        """How the inner ring deflects under its balls; fields (*cases); None where it does not."""
        return shape_of(self, "inner")

    @cached_property
    def outer_shape(self) -> RingShape | None:
        """How the outer ring deflects under its balls; fields (*cases); None where it does not."""
        return shape_of(self, "outer")

    @cached_property
    def groove_deflection(self) -> NDArray | None:
        """By how much elastic rings' grooves part at each ball; shape (*cases, ball) [m]; None between rigid rings."""
        if self.scene.elastic_rings is None:
            return None
        out = self._solved.positions[..., 3].copy()
        for part, cases in self._solved.stretches():
            out[part] *= cases["length"][:, None]
        return np.where(np.isnan(self.inner.load), np.nan, out.reshape(*self.shape, -1))

    @cached_property
    def elastic_share(self) -> Any:
        """What part of the axial displacement is the rings' give, by a solve between rigid ones; (*cases)."""
        rings = self.scene.elastic_rings
        if rings is None or self._solve_alike is None:
            return None
        rest = tuple(effect for effect in self.scene.ring_effects if effect is not rings)
        rigid = self._solve_alike(replace(self.scene, ring_effects=rest, readings={}))
        return share_of_displacement(self, rigid)[()]

    def _ring_state(self, which: int) -> RingState | None:
        effect = self.scene.ring_expansion
        if effect is None:
            return None
        state = effect.states(self.scene.bearing, self.scene.operation)[which]
        return RingState._make(None if each is None else np.broadcast_to(each, self.shape)[()] for each in state)

    @cached_property
    def stiffness(self) -> NDArray:
        """The ring's exact tangent stiffness dF/dd, with speed; shape (*cases, 5, 5), SI; NaN where not solved.

        Rows are loads, columns displacements, both in the order x, y, z, tilt y, tilt z, all channels included whether
        load or displacement is prescribed. It is the elimination that the solver itself uses: symmetric without the
        gyroscopic moment and with fixed inertia forces; at speed the inertia forces follow the contact angles and it
        need not be.
        """
        if self._moved is not None:
            return self._moved.stiffness()
        return self._shaped(ring_stiffness.tangents_of_all(self._solved), 5, 5)

    @cached_property
    def compliance(self) -> NDArray:
        """Inverse of the stiffness over the free channels, those whose load is prescribed; shape (*cases, 5, 5), SI.

        NaN for channels whose displacement is prescribed, where a case is not solved, and where nothing resists some
        free direction.
        """
        if self._moved is not None:
            return self._moved.compliance(self.stiffness, self.free_channels)
        return self._shaped(ring_stiffness.compliance(self._solved), 5, 5)

    @property
    def free_channels(self) -> NDArray:
        """Numbers of the channels whose load is prescribed; shape (channel)."""
        return self._solved.maker.free_channels

    def to_dataframe(self, more: Mapping[str, NDArray] | None = None) -> pandas.DataFrame:
        """One row per ball of every case, units in the column names; needs pandas (the `frame` extra).

        Contacts and motion of the ball; displacement, load, locked and effective stiffness of the ring and its whole
        matrix; status and reason of the case, and the numbers of the scene under the keys of a scene file. A case that
        is not solved keeps its rows, with NaN for what there is not.

        Args:
            more: columns that follow, of as many rows; `qs.readings.reading_columns` makes them of readings.
        """
        import pandas

        return pandas.DataFrame(columns(self) | dict(more or {}))

    def to_xarray(self) -> xarray.Dataset:
        """All results, labelled, in the units of files (`units` on each); needs xarray (the `studies` extra).

        The numbers of the scene, under the keys of a scene file, are its coordinates. A case that is not solved holds
        NaN and, in `status` and `reason`, why.
        """
        return dataset(self)

    def to_ross(self, n: int, index: Any = None, **arguments: Any) -> Any:
        """A bearing element of ROSS at node n of its shaft, from the stiffness over the speed; needs the `ross` extra.

        ROSS's z is x here, its x and y are y and z; see `qsbearing.to_ross` for the arguments `tilt`, `mirrored`, `cxx`
        and those of ROSS, and for what of the matrix is kept.

        Args:
            index: which cases, as numpy's arrays take it, such as (0, slice(None)); None: all. One axis at most, along
                which the inner ring's speed rises.

        Raises:
            SceneError: every error of the arguments; cases that are not solved.
            ImportError: ROSS is not installed.
        """
        return qs.ross_element(self, n, index, **arguments)


def preloaded_of(solution: Solution) -> Solution | None:
    """The bearing at rest and cold under its preload, as it is given; None without one that holds the rings."""
    return solution._preloaded
