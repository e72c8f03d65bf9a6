"""From where to where a displacement and a stiffness go over several solutions: members of a choice, assumptions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.operating_point import LIGHT
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.changes import Change
from qsbearing.model.solution.comparison import lever_of
from qsbearing.model.solution.result_keys import DISPLACEMENT, STIFFNESS, Result, printed_unit

KEYS = {"displacement": DISPLACEMENT, "stiffness": STIFFNESS}
TILTS = np.array([channel.is_rotation for channel in CHANNELS])
HERE = "as it stands"
ROUNDING = 1e-6
"""Of a number: less is not worth showing."""


@dataclass(frozen=True)
class ResultRange:
    """Of one channel of the displacement or of the locked stiffness."""

    of: Result
    """Of the channel; the unit is that of all numbers."""
    here: float
    """Of the solution itself, which counts."""
    least: float
    least_under: str
    """Which member or assumption; empty for the solution itself."""
    most: float
    most_under: str

    @property
    def moves(self) -> bool:
        """Whether there is more to it than rounding."""
        return self.most - self.least > ROUNDING * max(abs(self.least), abs(self.most))

    @property
    def key(self) -> str:
        """Of the channel, with the unit."""
        return self.of.key

    @property
    def record(self) -> dict[str, Any]:
        """As plain data."""
        return {"key": self.key} | {name: value for name, value in vars(self).items() if name != "of"}

    @property
    def what(self) -> str:
        """In words."""
        unit = self.of.unit
        noun = "stiffness" if "/" in unit else "" if unit == "mrad" else "displacement"
        return f"{self.of.plain_name} {noun}".rstrip()

    @property
    def unit(self) -> str:
        """As people write it."""
        return printed_unit(self.of.unit)

    @property
    def text(self) -> str:
        """In words, with what has the least and the most."""
        low, high = (f"{value:.4g} {self.unit}" for value in (self.least, self.most))
        return f"{self.what} {low} ({self.least_under or HERE}) to {high} ({self.most_under or HERE})"


def ranges(solution: Any, changes: Sequence[Change], case: int = 0) -> dict[str, ResultRange]:
    """Of displacement and locked stiffness, in a case counted along the flattened axes; nothing of what some solution
    has not, nor where nothing else is solved.

    Of each in the channel that moves most; of the stiffness rather in that of the displacement, unless another moves
    twice as much.
    """
    solved = [each for each in changes if each.displacement is not None and np.ravel(each.is_solved)[case]]
    own = {
        "displacement": solution.displacement,
        "stiffness": np.diagonal(solution.stiffness, axis1=-2, axis2=-1),
    }
    lever = float(np.ravel(np.broadcast_to(lever_of(solution), solution.shape))[case])
    unders = ["", *(each.under for each in solved)]
    spans: dict[str, ResultRange] = {}
    channel, moves = 0, False
    for name, results in KEYS.items() if solved else ():
        arrays = (own[name], *(getattr(each, name) for each in solved))
        values = np.array([np.reshape(each, (-1, len(CHANNELS)))[case] for each in arrays])
        sizes = np.where(TILTS, 1.0 / lever, 1.0) if name == "displacement" else _stiffness_sizes(values[0])
        if np.isfinite(values).all():
            moved = np.ptp(values, axis=0) / sizes
            if not moves or moved.max() > 2.0 * moved[channel]:
                channel = int(np.argmax(moved))
            moves = bool(moved[channel] > 0.0)
            spans[name] = _range(results[channel], values[:, channel], unders)
    return spans


def _stiffness_sizes(own: NDArray) -> NDArray:
    """What a change of each channel is weighed by, as in `comparison`."""
    largest = np.where(TILTS, np.max(np.abs(own[TILTS])), np.max(np.abs(own[~TILTS])))
    return np.asarray(np.maximum(np.abs(own), np.maximum(LIGHT * largest, np.finfo(float).tiny)))


def _range(of: Result, values: NDArray, unders: list[str]) -> ResultRange:
    low, high = int(np.argmin(values)), int(np.argmax(values))
    here, least, most = (float(values[n] / of.unit_size) for n in (0, low, high))
    return ResultRange(of, here, least, unders[low], most, unders[high])
