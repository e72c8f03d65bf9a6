"""Runs of free balls through time, and the steady motion that they come to."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fem_check.independent.contact_problem import Array
from fem_check.independent.free_ball import ACROSS, ALONG, RING, YZ, FreeBalls

STEADY = 1e-4
"""Change of a ball's motion in one turn of the inner ring, over that ring's speed, above which it has not settled."""
LAST, LAST_STEP = 5e-4, 1e-6
"""Duration and step of a settled run's last part [s]: with larger steps friction follows the ball's way round late."""


class UnsettledError(Exception):
    """A run ended before its motion was steady."""


@dataclass(frozen=True)
class BallRun:
    """What was kept of a run."""

    balls: FreeBalls
    times: Array
    """(sample,) [s]."""
    states: Array
    """(sample, 8, case)."""


@dataclass(frozen=True)
class Motion:
    """Of balls, in the frame that goes round with each; arrays (case,), of contacts (2, case), inner ones first."""

    displacement: Array
    """Of the inner ring, along the axis [m]."""
    orbit: Array
    """[rad/s]."""
    rotation: Array
    """About e_x, e_r x e_x and e_r; shape (3, case) [rad/s]."""
    angle: Array
    """Of contact [rad]."""
    load: Array
    """[N]."""
    tangential: Array
    """Friction on the ball along t [N]."""
    sideways: Array
    """Friction on the ball along e_r x e_x [N]."""
    moment: Array
    """Of all friction on the ball about e_r x e_x [N m]."""
    heat: Array
    """[W]."""

    @property
    def inner_share(self) -> Array:
        """Of the inner contact in the sum of both tangential forces."""
        return np.asarray(self.tangential[0] / self.tangential.sum(axis=0))

    @property
    def attitude(self) -> Array:
        """beta, of the ball's axis against the bearing's [rad]."""
        return np.asarray(np.arctan2(self.rotation[2], -self.rotation[0]))


def run(balls: FreeBalls, state: Array, duration: float, step: float = 5e-6, samples: int = 100) -> BallRun:
    """By Runge and Kutta's method of fourth order.

    Args:
        step: [s]. The stiffest is friction at slips below vc, mu Q/vc over 2/7 of the ball's mass, some 1e5 1/s: the
            step must stay below 2.8 over that. A ball goes round by a few thousandths of a radian meanwhile.
        samples: how many states are kept.

    Raises:
        UnsettledError: nothing holds the balls, and no numbers are left.
    """
    stride = max(1, round(duration / step / samples))
    states, rates = [state], balls.rates
    for _ in range(samples):
        for _ in range(stride):
            first = rates(state)
            second = rates(state + 0.5 * step * first)
            third = rates(state + 0.5 * step * second)
            fourth = rates(state + step * third)
            state = state + step / 6.0 * (first + 2.0 * (second + third) + fourth)
        if not np.isfinite(state).all():
            raise UnsettledError(f"no number is left after {len(states) * stride} steps: nothing holds the balls")
        states.append(state)
    return BallRun(balls, stride * step * np.arange(samples + 1), np.array(states))


def motion(balls: FreeBalls, state: Array) -> Motion:
    """Of a state, steady or not."""
    contacts, (_, w_x) = balls.contacts(state), state[ALONG].real
    reach = np.abs(state[YZ])
    moving, turning = state[ACROSS] * state[YZ].conj() / reach
    orbit = moving.imag / reach
    torque = contacts.on_ball[1][1].sum(axis=0)
    toward = contacts.normal * np.array([[-1.0], [1.0]])
    return Motion(
        displacement=state[RING].real,
        orbit=orbit,
        rotation=np.array([w_x - orbit, -turning.imag, turning.real]),
        angle=np.arctan2(toward.real, toward.imag),
        load=contacts.load,
        tangential=contacts.friction.real,
        sideways=contacts.friction.imag,
        moment=-(torque * state[YZ].conj() / reach).imag,
        heat=contacts.heat,
    )


def unrest(of: BallRun) -> Array:
    """How much each ball's motion changed in the run's last turn of the inner ring, over that ring's speed; (case,).

    Raises:
        UnsettledError: the run is shorter than a turn.
    """
    last, changes = motion(of.balls, of.states[-1]), []
    for case, speed in enumerate(np.abs(of.balls.speeds[0])):
        start = of.times[-1] - 2.0 * np.pi / speed
        if start < 0.0:
            raise UnsettledError("the run is shorter than a turn of the inner ring")
        before = motion(of.balls, of.states[np.searchsorted(of.times, start, side="right") - 1])
        parts = [last.orbit - before.orbit, *(last.rotation - before.rotation)]
        changes.append(max(abs(float(part[case])) for part in parts) / speed)
    return np.array(changes)


def settled(of: BallRun) -> Motion:
    """The steady motion that a run has come to, as small steps have it.

    Raises:
        UnsettledError: it still changes.
    """
    change = unrest(of)
    if not (change <= STEADY).all():
        raise UnsettledError(f"the motion still changes by {change.max():.1e} of the speed in a turn")
    return motion(of.balls, run(of.balls, of.states[-1], LAST, LAST_STEP, 1).states[-1])


def _azimuths(of: BallRun) -> Array:
    return np.unwrap(np.angle(of.states[:, YZ]), axis=0)


def mean_of_round(of: BallRun, values: Array) -> Array:
    """Mean over time of values (sample, case), during each ball's last round; shape (case,)."""
    azimuths, means = _azimuths(of), []
    middles = 0.5 * (values[1:] + values[:-1]) * np.diff(of.times)[:, None]
    sums = np.concatenate([np.zeros((1, values.shape[1])), np.cumsum(middles, axis=0)])
    for case, azimuth in enumerate(azimuths.T):
        begin = np.interp(azimuth[-1] - 2.0 * np.pi, azimuth, of.times)
        sum_before = np.interp(begin, of.times, sums[:, case])
        means.append((sums[-1, case] - sum_before) / (of.times[-1] - begin))
    return np.array(means)


def at_azimuths(of: BallRun, values: Array, azimuths: Array) -> Array:
    """Values (sample, case) as each ball last passed these azimuths [rad]; shape (azimuth, case)."""
    columns = []
    for case, azimuth in enumerate(_azimuths(of).T):
        last = azimuths + 2.0 * np.pi * np.floor((azimuth[-1] - azimuths) / (2.0 * np.pi))
        columns.append(np.interp(last, azimuth, values[:, case]))
    return np.stack(columns, axis=1)
