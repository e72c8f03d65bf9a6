"""Natural frequencies of a rotor of ROSS over its speed, each mode by what moves in it, and its critical speeds.

ROSS takes the axial mode of a shaft on angular-contact bearings for a lateral one, for it tilts and bends a little.
Here a mode goes by the kinetic energy: along the axis, about it, or across. A lateral mode x e^(i w t), y e^(i w t)
whirls forward with (x + i y)/2 and backward with (x - i y)/2; so do its rotations about x and y.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

MODES = 32
"""Eigenvalues that are asked for, two for each mode."""
OF_NODE = 6
"""Coordinates of a node in ROSS: x, y, z along the axis, and the rotations about them."""
AXIAL, TORSION = 2, 5
ACROSS = (0, 1), (3, 4)
"""Displacements and rotations in the plane across the axis."""
EITHER, ROUND = "either", 1e-6
"""A mode that moves along a line, as without rotation, and by how much it may whirl."""


class NaturalFrequencies(NamedTuple):
    """Damped natural frequencies [rad/s], shape (speed, mode), the lowest first; NaN where there are no more."""

    speeds: NDArray
    """Of the shaft, rising [rad/s]."""
    forward: NDArray
    """Lateral modes that whirl with the shaft; those that whirl neither way, at rest, are half of them forward."""
    backward: NDArray
    axial: NDArray

    @property
    def critical_speeds(self) -> NDArray:
        """Where the shaft turns as fast as a mode whirls forward, and an unbalance meets it [rad/s]; by straight lines
        between the speeds."""
        crossings = []
        for mode in self.forward.T:
            above = mode - self.speeds
            for k in np.flatnonzero(above[:-1] * above[1:] <= 0.0):
                part = above[k] / (above[k] - above[k + 1]) if above[k] != above[k + 1] else 0.0
                crossings.append(self.speeds[k] + part * (self.speeds[k + 1] - self.speeds[k]))
        return np.unique(np.array(crossings, float))


def natural_frequencies(rotor: Any, speeds: NDArray) -> NaturalFrequencies:
    """Of a rotor that stands on stiffnesses over these speeds; such as `SetSolution.to_ross_rotor` makes."""
    kinds: dict[str, list[list[float]]] = {"forward": [], "backward": [], "axial": []}
    mass = np.asarray(rotor.M(0.0) if _takes_frequency(rotor) else rotor.M())
    for speed in speeds:
        modal = rotor.run_modal(float(speed), num_modes=min(MODES, 2 * (len(mass) - 1)))
        own: dict[str, list[float]] = {kind: [] for kind in kinds}
        for number, frequency in enumerate(modal.wd):
            kind = _kind(np.asarray(modal.evectors)[: len(mass), number], mass)
            if kind == EITHER:
                kind = min(("forward", "backward"), key=lambda way: len(own[way]))
            if kind in own:
                own[kind].append(float(frequency))
        for kind, frequencies in own.items():
            kinds[kind].append(sorted(frequencies))
    return NaturalFrequencies(np.asarray(speeds, float), *(_table(frequencies) for frequencies in kinds.values()))


def _takes_frequency(rotor: Any) -> bool:
    """Whether this version of ROSS has masses that depend on the frequency."""
    from inspect import signature

    return bool(signature(rotor.M).parameters)


def _kind(shape: NDArray, mass: NDArray) -> str:
    """Of a mode by its displacements: forward, backward, either, axial or torsional."""
    energy = np.abs((shape.conj() * (mass @ shape)).real).reshape(-1, OF_NODE).sum(axis=0)
    if energy[AXIAL] > 0.5 * energy.sum():
        return "axial"
    if energy[TORSION] > 0.5 * energy.sum():
        return "torsional"
    weighted = (np.sqrt(np.diagonal(mass)) * shape).reshape(-1, OF_NODE)
    pairs = [(weighted[:, i], weighted[:, j]) for i, j in ACROSS]
    ways = [sum(float(np.sum(np.abs(x + way * y) ** 2)) for x, y in pairs) for way in (1j, -1j)]
    if abs(ways[0] - ways[1]) < ROUND * sum(ways):
        return EITHER
    return "forward" if ways[0] > ways[1] else "backward"


def _table(frequencies: list[list[float]]) -> NDArray:
    """As many columns as every speed has modes."""
    count = max(map(len, frequencies), default=0)
    return np.array([each + [np.nan] * (count - len(each)) for each in frequencies], float).reshape(
        len(frequencies), count
    )
