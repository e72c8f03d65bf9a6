"""Stiffness over the frequency of a load: of balls that friction moves, which do not follow a load that turns or
pulsates as they follow one that stands still.

No damping is given: that of balls which lag behind has a sign along the axis that no practice confirms.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.effects.hypotheses import FRICTION
from qsbearing.model.solution.motion_stiffness import turning_stiffness
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import ErrorDetail, check_kind, raise_if_any

OF_SHAFT = "x"
"""After a number: times the shaft's speed, as 1x."""


class StiffnessOverFrequency(NamedTuple):
    """Of a bearing under thrust, (*cases, frequency) [N/m]; NaN without a solution and, across the axis, near the speed
    of the cage, at which a load meets the same balls for ever."""

    radial: NDArray
    """Against a displacement across the axis that turns at the frequency."""
    axial: NDArray
    """Against one along the axis that pulsates."""


class LoadFrequency(NamedTuple):
    """As people write it: 50, in Hz, or 1x, times the shaft's speed."""

    value: float
    is_of_shaft: bool = False

    @property
    def label(self) -> str:
        """In names of columns."""
        return f"{self.value:g}{OF_SHAFT if self.is_of_shaft else 'Hz'}"

    def angular(self, speed: NDArray) -> NDArray:
        """In rad/s, at these speeds of the shaft."""
        return np.asarray(self.value * (speed if self.is_of_shaft else np.full_like(speed, 2.0 * np.pi)))


def frequencies_of(text: str) -> list[LoadFrequency]:
    """From numbers and multiples of the shaft's speed, such as 0,1x,50.

    Raises:
        SceneError: what is neither, or stands twice.
    """
    made, errors = list[LoadFrequency](), list[ErrorDetail]()
    for word in map(str.strip, text.split(",")):
        is_of_shaft = word.endswith(OF_SHAFT)
        try:
            each = LoadFrequency(float(word.removesuffix(OF_SHAFT)), is_of_shaft)
        except ValueError:
            each = LoadFrequency(np.nan)
        if not np.isfinite(each.value) or each in made:
            problem = "stands twice" if each in made else "is no frequency"
            errors.append(
                ErrorDetail("frequency", problem, word, cause="Write Hz, or times the shaft's speed: 0,1x,50")
            )
        made.append(each)
    raise_if_any(errors)
    return made


def stiffness_over_frequency(solution: Solution, frequency: ArrayLike) -> StiffnessOverFrequency:
    """Stiffness against small displacements that turn or pulsate, tilts held.

    At 0 it is that against a load that stands still, at the speed of the shaft that against its unbalance. In a case at
    rest it is the static one at all frequencies.

    Args:
        solution: under thrust, with raceway_control "friction".
        frequency: angular, (n,) or (*cases, n) [rad/s]; across the axis positive where the displacement turns about
            +x, as a shaft of positive speed does.

    Returns:
        The complex stiffness at each frequency.

    Raises:
        SceneError: another raceway control; a radial load or displacement, which makes balls unlike.

    Examples:
        >>> scene = qs.load_scene("b218")
        >>> scene = dataclasses.replace(scene, raceway_control="friction", traction=qs.Traction(0.07))
        >>> found = qs.stiffness_over_frequency(qs.solve(scene), [0.0, 1000.0])
        >>> print(f"{found.radial[0] / 1e6:.0f} N/µm")
        228 N/µm
    """
    check_kind("stiffness_over_frequency", solution, "Solution")
    raise_if_any(_errors(solution))
    nu = np.atleast_1d(np.asarray(frequency, float))
    nu = np.broadcast_to(nu, (*solution.shape, nu.shape[-1]))
    static = solution.stiffness
    values = [np.broadcast_to(static[..., k, k, None], nu.shape) for k in (1, 0)]
    motion = solution.friction
    if motion is not None:
        turns = np.isfinite(motion.orbital_speed[..., 0])[..., None]
        turning = turning_stiffness(motion, nu)
        values = [np.where(turns, *each) for each in zip((turning.radial, turning.axial), values, strict=True)]
    return StiffnessOverFrequency(*values)


def _errors(solution: Solution) -> list[ErrorDetail]:
    scene = solution.scene
    if scene.raceway_control != FRICTION:
        problem, cause = "must be friction for a stiffness over frequency", "Balls follow a load by no hypothesis"
        return [ErrorDetail("raceway_control", problem, str(scene.raceway_control), cause=cause)]
    return [
        ErrorDetail(f"operation.{name}", "makes balls unlike: stiffness over frequency knows thrust alone", value)
        for kind in ("load", "displacement")
        for axis in "yz"
        for name in [f"radial_{kind}_{axis}"]
        for value in [getattr(scene.operation, name)]
        if value is not None and np.any(np.asarray(value) != 0.0)
    ]


def frequency_columns(solution: Solution, frequencies: Sequence[LoadFrequency]) -> dict[str, NDArray]:
    """Those of a table with a row for each case: k_radial_1x_N_per_m and so on.

    Raises:
        SceneError: as `stiffness_over_frequency`.
    """
    speed = np.broadcast_to(np.asarray(solution.scene.operation.speed, float), solution.shape)
    angular = np.stack([each.angular(speed) for each in frequencies], axis=-1)
    stiffness = stiffness_over_frequency(solution, angular)
    return {
        f"k_{name}_{each.label}_N_per_m": np.ravel(values[..., n])
        for name, values in zip(stiffness._fields, stiffness, strict=True)
        for n, each in enumerate(frequencies)
    }
