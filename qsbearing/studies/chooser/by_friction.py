"""What friction itself gives beside the hypotheses of raceway control: the scene solved with balls that it moves, over
a range of its coefficient."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from qsbearing.model.effects.raceway_control import ENTRY as RACEWAY_CONTROL
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.effects.traction import FRICTION_COEFFICIENT, Traction
from qsbearing.model.scene.moved_by_friction import BOTH
from qsbearing.model.solution.changes import requested
from qsbearing.model.solution.friction_band import friction_band
from qsbearing.model.solution.of_cases import may_solve_alike, solve_alike
from qsbearing.model.solution.result_keys import DISPLACEMENT, STIFFNESS, Result, printed_unit
from qsbearing.model.validation import SceneError

USUAL = (0.03, 0.1)
"""What lubricated steel contacts have, from the least to the most."""


@dataclass(frozen=True)
class ByFriction:
    """Displacements and locked stiffnesses between these coefficients, by their keys; null without a solution."""

    friction_range: list[float]
    displacement: dict[str, list[float | None]]
    stiffness: dict[str, list[float | None]]
    text: str


def by_friction(entry: Any, solution: Any) -> ByFriction | None:
    """Of a scene's raceway control; None for other effects, at rest, and where a ball effect is not named."""
    of = requested(solution)
    named = {each.name for each in of.ball_effects}
    is_here = entry is RACEWAY_CONTROL and solution.converged and named == BOTH and not hasattr(of, "rows")
    if not is_here or not may_solve_alike(solution):
        return None
    law = getattr(of, "traction", None) or Traction(FRICTION_COEFFICIENT)
    over = law.friction_range or USUAL
    law = replace(law, friction_range=over)
    try:
        moved = replace(of, raceway_control=RacewayControl.FRICTION, traction=law, ball_effects=_plain(of), readings={})
    except SceneError as error:
        first = error.errors[0]
        return ByFriction(list(over), {}, {}, f"not told by friction: {first.field} {first.problem}")
    band = friction_band(solve_alike(solution, moved))
    if band is None:
        return None
    displacement = {each.key: _span(each, band.displacement) for each in DISPLACEMENT}
    stiffness = {each.key: _span(each, band.stiffness) for each in STIFFNESS}
    text = _said(band.over, (DISPLACEMENT[0], displacement), (STIFFNESS[0], stiffness))
    return ByFriction(list(band.over), displacement, stiffness, text)


def _plain(of: Any) -> tuple[Any, ...]:
    """The ball effects without what belongs to hypotheses."""
    return tuple(type(each)() for each in of.ball_effects)


def _span(of: Result, ends: Any) -> list[float | None]:
    values = [of.of(end) for end in ends]
    return [float(each) if each is not None and np.isfinite(each) else None for each in values]


def _said(over: tuple[float, float], *axial: tuple[Result, dict[str, list[float | None]]]) -> str:
    parts = []
    for each, (result, spans) in zip(("displacement", "stiffness"), axial, strict=True):
        least, most = spans[result.key]
        if least is not None and most is not None:
            parts.append(f"{result.plain_name} {each} {least:.4g} to {most:.4g} {printed_unit(result.unit)}")
    by = f'with raceway_control = "friction", µ = {over[0]:g} to {over[1]:g}'
    return f"{by}: {', '.join(parts)}" if parts else f"{by}: no solution"
