"""How much each effect and choice matters at a solution: predicted by its indicator, without solving anything."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects import Entry
from qsbearing.model.scene.scene import CHOICES, Scene
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import Setting

WORDS = {
    "contact_angle": "contact angles",
    "load": "contact loads",
    "pressure": "contact pressures",
    "displacement": "displacement",
    "stiffness": "locked stiffness",
}
"""What people read, in words."""

WORTH_A_WARNING = 0.05
"""A predicted error above which a missing effect is said to be missing."""


@dataclass(frozen=True)
class Judgement:
    """One effect or choice at a solution, whose scene has it or not; arrays of shape (*cases)."""

    entry: Entry
    indicator: NDArray
    errors: dict[str, NDArray]
    """What leaving it out changes, by quantity."""

    @property
    def largest(self) -> NDArray:
        """Largest error of all quantities; infinite where there is none to tell."""
        return np.nan_to_num(np.max(list(self.errors.values()), axis=0), nan=np.inf)

    def worst(self, case: int = 0) -> tuple[str, float]:
        """The quantity that errs most in a case (counted along the flattened axes), and by how much."""
        errors = {name: float(np.ravel(error)[case]) for name, error in self.errors.items()}
        name = max(errors, key=lambda each: errors[each])
        return name, errors[name]


def judge(entry: Entry, solution: Solution, requested: Scene | None = None) -> Judgement:
    """One effect or choice at a solution, whose scene has it or not; asked for with the parameters of another scene."""
    point = solution.operating_point if requested is None else replace(solution.operating_point, requested=requested)
    with np.errstate(invalid="ignore", divide="ignore"):
        return Judgement(entry, entry.indicator(point), entry.errors(point))


def settings_to_add(scene: Any, entries: list[Entry]) -> tuple[Setting, ...]:
    """What to write for a scene or set to ask for these besides."""
    finer = scene
    for entry in entries:
        finer = entry.finer(finer)
    before, after = _effects_of(scene), _effects_of(finer)
    return tuple(Setting(name, after[name]) for name in after if _names(after[name]) != _names(before[name]))


def _effects_of(scene: Any) -> dict[str, Any]:
    return {name: getattr(scene, name) for name in ("ball_effects", *CHOICES)}


def _names(value: Any) -> Any:
    return [effect.name for effect in value] if isinstance(value, tuple) else value


def estimated(error: float, unit: str = " %") -> str:
    """A predicted relative error in per cent: with ≈, in as many digits as it is good for, which is one."""
    if not NOTHING <= error <= 1.0:
        return changed(error, unit)
    return f"≈ {float(f'{100.0 * error:.1g}'):.0f}{unit}" if error > 0.0095 else f"≈ {100.0 * error:.1g}{unit}"


ANOTHER_RESULT = "> 100"
"""Per cent; by how much more does not matter."""
NOTHING = 1e-6
"""A relative change below it is not worth showing: two solutions differ by as much as their solver allows."""


def percent(error: float, unit: str = " %", digits: int = 2) -> str:
    """A relative error in as many digits as it is good for, which are two; a share in more."""
    if abs(error) < NOTHING:
        return f"0{unit}"
    text = f"{100.0 * error:.{digits}g}"
    return f"{text}{unit}" if error < 0.99 else f"{float(text):.0f}{unit}"


def changed(error: float, unit: str = " %") -> str:
    """A relative change of a result."""
    return f"{ANOTHER_RESULT}{unit}" if error > 1.0 else percent(error, unit)


ATOM = 1e-4
"""Displacements below it are nothing [µm]."""


def shifted(by: float) -> str:
    """A change of a displacement [µm], without its unit."""
    return "0" if by < ATOM else f"{by:.2g}" if by < 99.5 else f"{by:.0f}"


def unit_of(quantity: str) -> str:
    """What a change of one of `WORDS` is told in: a displacement has no size of its own to be a part of."""
    return "µm" if quantity == "displacement" else "%"
