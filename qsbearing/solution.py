"""The solution: what was solved, how it ended, and everything that can be read off it."""

from __future__ import annotations

from enum import StrEnum
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing import readings
from qsbearing.hertz import INNER_SIDE, OUTER_SIDE
from qsbearing.solver import (
    CONVERGED,
    FRICTION_WITHOUT_LOAD,
    NO_CONSISTENT_CONTROL,
    NO_EQUILIBRIUM,
    NOT_CONVERGED,
    OPEN_SIDE,
    OVER_SHOULDER,
    RUNAWAY,
)
from qsbearing.state import working_memory

if TYPE_CHECKING:
    import pandas
    from numpy.typing import NDArray

    from qsbearing.case import CaseMaker
    from qsbearing.scene import Scene

CHUNK = 4096
"""Cases whose records exist at a time while something is read off a large solution."""


class Status(StrEnum):
    """How a case ended."""

    CONVERGED = "converged"
    """Balls and ring are in balance."""
    NO_EQUILIBRIUM = "no_equilibrium"
    """Nothing in the bearing supports the load; `outcome.message` says which channel or which hypothesis fails."""
    NOT_CONVERGED = "not_converged"
    """No balance was found; that is no proof that there is none."""


class Reason(StrEnum):
    """Why a case has no equilibrium."""

    UNSUPPORTED = "unsupported"
    """Nothing supports the load: the ring moves without end, and the energy falls without bound."""
    OPEN_SIDE = "open_side"
    """Balls would have to press on the open side of the inner groove, at angles below zero."""
    OVER_SHOULDER = "over_shoulder"
    """Balls would have to press beyond 90 degrees, where no groove is."""
    FRICTION_WITHOUT_LOAD = "friction_without_load"
    """The raceway-control hypothesis puts friction where too little load or none carries it."""


_REASONS = {
    RUNAWAY: Reason.UNSUPPORTED,
    FRICTION_WITHOUT_LOAD: Reason.FRICTION_WITHOUT_LOAD,
    OPEN_SIDE: Reason.OPEN_SIDE,
    OVER_SHOULDER: Reason.OVER_SHOULDER,
}
"""Several may hold; the first of these is told."""


STATUS_OF_CODE = {
    CONVERGED: Status.CONVERGED,
    NO_EQUILIBRIUM: Status.NO_EQUILIBRIUM,
    NOT_CONVERGED: Status.NOT_CONVERGED,
}


class RacewayContacts:
    """All contacts of one raceway; arrays of shape (*cases, ball), computed when first asked for.

    NaN stands where there is no number: cases not solved, balls beyond a case's ball count, and the angle and approach
    of a ball at rest that touches neither raceway and so has no defined place.
    """

    def __init__(self, solution: Solution, side: float) -> None:
        self._solution = solution
        self._side = side

    def _read(self, what: int, power: str) -> NDArray:
        return self._solution._read(self._side, what, power)

    @cached_property
    def angle(self) -> NDArray:
        """Contact angle, from the radial plane towards +x [rad]; of an unloaded contact, the line it would act in."""
        return self._read(readings.ANGLE, "")

    @cached_property
    def load(self) -> NDArray:
        """Normal load Q, zero where the ball has lost the raceway, never negative [N]."""
        return self._read(readings.LOAD, "force")

    @cached_property
    def approach(self) -> NDArray:
        """Elastic approach of ball and ring; negative: the gap of a lost contact [m]."""
        return self._read(readings.APPROACH, "length")

    @cached_property
    def semi_major_axis(self) -> NDArray:
        """Of the contact ellipse, a [m]; zero without load."""
        return self._read(readings.SEMI_MAJOR_AXIS, "length")

    @cached_property
    def semi_minor_axis(self) -> NDArray:
        """Of the contact ellipse, b [m]; zero without load."""
        return self._read(readings.SEMI_MINOR_AXIS, "length")

    @cached_property
    def max_pressure(self) -> NDArray:
        """Hertz's p0 at the centre of the ellipse [Pa]; zero without load."""
        return self._read(readings.MAX_PRESSURE, "pressure")

    @cached_property
    def required_friction(self) -> NDArray | None:
        """Coefficient of friction that the gyroscopic moment demands here, lambda |Mg|/(D Q); None without that effect.

        Above what the contact offers (0.06 to 0.1 is typical) the ball slips and raceway control no longer holds.
        """
        if self._solution.scene.gyroscopic_moment is None:
            return None
        return self._read(readings.REQUIRED_FRICTION, "")


class Solution:
    """Solved cases of a scene. Arrays lead with the case axes of the scene: none for a single case.

    Displacements and loads are in the order x, y, z, tilt y, tilt z; SI units and radians. Cases that did not converge
    hold NaN everywhere but in `status`, `iterations` and `residual`; `outcome.message` says why.
    """

    def __init__(
        self,
        maker: CaseMaker,
        cases: NDArray | None,
        ring: NDArray,
        position: NDArray,
        control: NDArray,
        load: NDArray,
        codes: NDArray,
        notes: NDArray,
        iterations: NDArray,
        residual: NDArray,
        reached: NDArray,
        seconds: float,
    ) -> None:
        self.scene: Scene = maker.scene
        self.shape = maker.shape
        self._maker = maker
        self._cases = cases
        self._ring = ring
        self._position = position
        self._control = control
        self._load = load
        self._codes = codes
        self._notes = notes
        self._iterations = iterations
        self._residual = residual
        self._reached = reached
        self.seconds = seconds
        """Wall time of the solve [s]."""
        self.inner = RacewayContacts(self, INNER_SIDE)
        """Contacts with the inner raceway."""
        self.outer = RacewayContacts(self, OUTER_SIDE)
        """Contacts with the outer raceway."""

    def _shaped(self, array: NDArray, *tail: int) -> Any:
        shaped = array.reshape(self.shape + tail)
        return shaped[()] if not shaped.shape else shaped

    def _stretches(self) -> Any:
        """(slice, case records) of all cases, some at a time."""
        if self._cases is not None:
            yield slice(0, self._maker.count), self._cases
            return
        for start in range(0, self._maker.count, CHUNK):
            stop = min(start + CHUNK, self._maker.count)
            yield slice(start, stop), self._maker.make(start, stop)

    def _read(self, side: float, what: int, unit: str) -> NDArray:
        balls = self._maker.ball_axis
        out = np.empty((self._maker.count, balls))
        for part, cases in self._stretches():
            readings.read_cases(
                cases,
                *working_memory(balls),
                self._codes[part],
                self._ring[part],
                self._position[part],
                self._control[part],
                side,
                what,
                out[part],
            )
            if unit:
                out[part] *= _unit(cases, unit)[:, None]
        return self._shaped(out, balls)

    @property
    def converged(self) -> Any:
        """Whether each case is solved; shape (*cases)."""
        return self._shaped(self._codes == CONVERGED)

    @property
    def status(self) -> Any:
        """`Status` of a single case, or an array of its words; shape (*cases)."""
        if not self.shape:
            return STATUS_OF_CODE[int(self._codes[0])]
        words = np.array([str(STATUS_OF_CODE[code]) for code in sorted(STATUS_OF_CODE)])
        return self._shaped(words[self._codes])

    @property
    def reason(self) -> Any:
        """`Reason` why there is no equilibrium, as a word; empty where there is one; shape (*cases)."""
        words = np.full(self._notes.shape, "", dtype=f"<U{max(map(len, Reason))}")
        for bit, reason in reversed(_REASONS.items()):
            words[(self._codes == NO_EQUILIBRIUM) & ((self._notes & bit) != 0)] = reason
        return str(words[0]) if not self.shape else self._shaped(words)

    @property
    def control_is_consistent(self) -> Any:
        """Whether every ball's raceway control is the one that Jones's criterion then calls for; shape (*cases).

        Asked only under per-ball control; True elsewhere.
        """
        return self._shaped((self._notes & NO_CONSISTENT_CONTROL) == 0)

    @property
    def iterations(self) -> Any:
        """Newton iterations spent, safety nets included; shape (*cases)."""
        return self._shaped(self._iterations)

    @property
    def residual(self) -> Any:
        """Largest imbalance of any ball or of the ring over the largest applied or inertial force; shape (*cases)."""
        return self._shaped(self._residual)

    @property
    def speed_reached(self) -> Any:
        """The part of the speed that the verdict is for; shape (*cases).

        1 but where a balance followed up in speed was found to have ended below it: then the part that shows it.
        """
        return self._shaped(self._reached)

    @cached_property
    def displacement(self) -> NDArray:
        """Of the inner ring; shape (*cases, 5) [m, m, m, rad, rad]."""
        out = np.where((self._codes == CONVERGED)[:, None], self._ring, np.nan)
        for part, cases in self._stretches():
            out[part, :3] *= cases["length"][:, None]
        return self._shaped(out, 5)

    @cached_property
    def load(self) -> NDArray:
        """On the inner ring, reactions of held channels included; shape (*cases, 5) [N, N, N, N m, N m]."""
        out = np.where((self._codes == CONVERGED)[:, None], self._load, np.nan)
        for part, cases in self._stretches():
            out[part] *= cases["force"][:, None]
            out[part, 3:] *= cases["length"][:, None]
        return self._shaped(out, 5)

    @cached_property
    def azimuth(self) -> NDArray:
        """Of the balls, from +y towards +z; shape (*cases, ball) [rad]."""
        balls = self._maker.ball_axis
        count = np.asarray(self.scene.bearing.ball_count, float)[..., None]
        first = np.asarray(self.scene.operation.first_ball_azimuth, float)[..., None]
        index = np.arange(balls)
        azimuth = np.where(index < count, first + 2.0 * np.pi * index / count, np.nan)
        return np.broadcast_to(azimuth, (*self.shape, balls))

    @cached_property
    def centrifugal_force(self) -> NDArray | None:
        """Of each ball [N]; None where the scene does not name it."""
        if self.scene.centrifugal_force is None:
            return None
        return self._read(OUTER_SIDE, readings.CENTRIFUGAL_FORCE, "force")

    @cached_property
    def gyroscopic_moment(self) -> NDArray | None:
        """Mg of each ball, signed: negative under a turning inner ring [N m]; None where the scene does not name it."""
        if self.scene.gyroscopic_moment is None:
            return None
        return self._read(OUTER_SIDE, readings.GYROSCOPIC_MOMENT, "moment")

    @cached_property
    def orbital_speed(self) -> NDArray | None:
        """omega_m of each ball's centre about the bearing axis [rad/s]; None without a ball effect."""
        if self.scene.raceway_control is None:
            return None
        return self._read(OUTER_SIDE, readings.ORBITAL_SPEED, "speed")

    @cached_property
    def rotation_speed(self) -> NDArray | None:
        """omega_R of each ball about its own axis, signed: negative under a turning inner ring [rad/s]; None without a
        ball effect."""
        if self.scene.raceway_control is None:
            return None
        return self._read(OUTER_SIDE, readings.ROTATION_SPEED, "speed")

    @cached_property
    def raceway_control(self) -> NDArray | None:
        """ "outer" or "inner" for each ball; shape (*cases, ball); None without a ball effect."""
        if self.scene.raceway_control is None:
            return None
        words = np.array(["outer", "inner", ""])
        index = np.where(np.isnan(self.azimuth), 2, self._shaped(self._control, self._maker.ball_axis))
        return words[index]

    def to_dataframe(self) -> pandas.DataFrame:
        """One row a ball (and case), units in the column names; needs pandas (the `frame` extra)."""
        import pandas

        columns: dict[str, Any] = {}
        full = (*self.shape, self._maker.ball_axis)
        for axis, index in enumerate(np.indices(full)[:-1]):
            columns[f"case_{axis}"] = index.ravel()
        columns["ball"] = np.indices(full)[-1].ravel()
        columns["azimuth_deg"] = np.degrees(self.azimuth).ravel()
        for name, contacts in (("inner", self.inner), ("outer", self.outer)):
            columns[f"{name}_load_N"] = contacts.load.ravel()
            columns[f"{name}_angle_deg"] = np.degrees(contacts.angle).ravel()
            columns[f"{name}_approach_um"] = contacts.approach.ravel() * 1e6
            columns[f"{name}_semi_major_axis_mm"] = contacts.semi_major_axis.ravel() * 1e3
            columns[f"{name}_semi_minor_axis_mm"] = contacts.semi_minor_axis.ravel() * 1e3
            columns[f"{name}_max_pressure_MPa"] = contacts.max_pressure.ravel() / 1e6
            if contacts.required_friction is not None:
                columns[f"{name}_required_friction"] = contacts.required_friction.ravel()
        if self.centrifugal_force is not None:
            columns["centrifugal_force_N"] = self.centrifugal_force.ravel()
        if self.gyroscopic_moment is not None:
            columns["gyroscopic_moment_Nmm"] = self.gyroscopic_moment.ravel() * 1e3
        if self.orbital_speed is not None and self.rotation_speed is not None and self.raceway_control is not None:
            columns["orbital_speed_rpm"] = self.orbital_speed.ravel() * 30.0 / np.pi
            columns["rotation_speed_rpm"] = self.rotation_speed.ravel() * 30.0 / np.pi
            columns["raceway_control"] = self.raceway_control.ravel()
        frame = pandas.DataFrame(columns)
        return frame[frame["azimuth_deg"].notna()].reset_index(drop=True)


def _unit(cases: NDArray, unit: str) -> NDArray:
    """SI size of a quantity in each case's own units."""
    length, force = cases["length"], cases["force"]
    if unit == "pressure":
        return force / length**2
    if unit == "moment":
        return force * length
    return cases[unit]


def stiffness(scene: Scene, solution: Solution) -> NDArray:
    """The ring's exact tangent stiffness dF/dd at the solution, with speed; shape (*cases, 5, 5), SI.

    Rows are loads, columns displacements, both in the order x, y, z, tilt y, tilt z, all channels included whether
    loaded or held. It is the elimination that the solver itself uses: symmetric without the gyroscopic moment and with
    fixed inertia forces; at speed the inertia forces follow the contact angles and it need not be.

    Raises:
        ValueError: the solution belongs to another scene.
    """
    if scene is not solution.scene:
        raise ValueError("this solution belongs to another scene: solve this one first")
    out = np.empty((solution._maker.count, 5, 5))
    for part, cases in solution._stretches():
        out[part] = tangents(solution, part, cases)
    return solution._shaped(out, 5, 5)


def tangents(solution: Solution, part: slice, cases: NDArray) -> NDArray:
    """Stiffness (case, 5, 5) of a stretch of flattened cases."""
    out = np.empty((cases.size, 5, 5))
    readings.stiffness_of_cases(
        cases,
        *working_memory(solution._maker.ball_axis),
        solution._codes[part],
        solution._ring[part],
        solution._position[part],
        solution._control[part],
        out,
    )
    return out
