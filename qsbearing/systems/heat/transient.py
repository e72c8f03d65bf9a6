"""Heating up in time: the balance of every node as a stiff differential equation, friction at every instant.

    C dT/dt = S f(T) + q + K_f T_f - K T

by SciPy's implicit BDF method, the bearing solved at each of its steps, for the Jacobian's columns as cases of one
scene. The run ends where a node reaches the limit of temperature, or the bearing has no equilibrium any more.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.validation import TEMPERATURE, ErrorDetail, SceneError, within
from qsbearing.systems.heat.capacities import heat_capacities
from qsbearing.systems.heat.hot import HotSystem
from qsbearing.systems.heat.network import COLDEST, HOTTEST
from qsbearing.systems.heat.state import Course
from qsbearing.systems.heat.steady import Heated

RELATIVE, ABSOLUTE = 1e-6, 1e-3
"""Tolerances of the integration; kelvin."""
POINTS = 200
"""Instants at which the course is given."""


def heat_up(
    system: HotSystem,
    duration: float,
    *,
    start: float | None = None,
    progress: Callable[[float], None] = lambda part: None,
) -> Course:
    """The course of a single case from a uniform temperature.

    Args:
        system: at full speed from the first instant.
        duration: [s].
        start: of all free nodes at first [K]; None: the lowest of the given temperatures.
        progress: is told the part of the duration that is done.

    Raises:
        SceneError: heat capacities missing, numbers out of range, several cases, no equilibrium to begin with.
    """
    from scipy.integrate import solve_ivp

    errors = [] if duration > 0.0 else [ErrorDetail("duration", "is not positive", duration)]
    if start is not None:
        errors += within("start", start, TEMPERATURE, COLDEST, HOTTEST)
    if system.shape:
        errors.append(ErrorDetail("operation", f"has cases {system.shape}: heating up is computed for a single case"))
    if errors:
        raise SceneError(errors)
    heated = Heated(system)
    balance, limit = heated.balance, system.thermal.limit_temperature
    capacity = np.array(heat_capacities(balance, system.scenes))[:, None]
    first = min(balance.fixed.values()) if start is None else start

    def rate(time: float, T: NDArray) -> NDArray:
        progress(time / duration)
        states = T.reshape(len(T), -1)
        flow = balance.net_heat(states, heated.at(states)[1]) / capacity
        return np.nan_to_num(flow, nan=0.0).reshape(T.shape)

    def at_limit(time: float, T: NDArray) -> float:
        return float(limit - T.max())

    at_limit.terminal = True  # type: ignore[attr-defined]
    trajectory = solve_ivp(
        rate, (0.0, duration), np.full(len(balance.free), first), method="BDF", vectorized=True, dense_output=True,
        events=at_limit, rtol=RELATIVE, atol=ABSOLUTE, first_step=1e-6 * duration,
    )  # fmt: skip
    time = float(trajectory.t[-1]) * np.concatenate([[0.0], np.geomspace(1e-4, 1.0, POINTS - 1)])
    T = trajectory.sol(time)
    solution, powers = heated.at(T)
    solved = np.isfinite(powers).all(axis=0)
    count = POINTS if solved.all() else int(solved.argmin())
    if not count:
        raise SceneError([ErrorDetail("thermal", "heating up cannot start: the cold bearing has no equilibrium")])
    end = "no_equilibrium" if count < POINTS else "limit" if trajectory.status == 1 else "time"
    named = {name: value[:count] for name, value in balance.named(T).items()}
    return Course(time[:count], named, powers.T[:count], system.preloads(solution).T[:count], end, system.thermal.bound)
