"""The fidelities of the model, from the cheapest to the finest: one line each.

A later effect or choice joins by one line in `LADDER`, and by one in `indicators.OMISSIONS` where leaving it out is to
be judged for `run --accuracy`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from qsbearing.effects import BallEffect, CentrifugalForce, GyroscopicMoment
from qsbearing.hertz import HertzForm
from qsbearing.raceway_control import RacewayControl
from qsbearing.scene import HertzAngle, Scene


@dataclass(frozen=True)
class Rung:
    """One fidelity: which ball effects it has, and how it settles each choice."""

    name: str
    """A key, in files."""
    words: str
    effects: tuple[type[BallEffect], ...] = ()
    control: RacewayControl = RacewayControl.OUTER
    hertz_angle: HertzAngle = HertzAngle.FREE
    hertz_form: HertzForm = HertzForm.EXACT
    is_solved: bool = True
    """False for a formula, which gives some of the answers only."""

    def of(self, scene: Scene) -> Scene:
        """The scene's bearing and operation at this fidelity, whatever effects and choices the scene names."""
        named = {type(effect): effect for effect in scene.ball_effects}
        effects = tuple(named.get(effect, effect()) for effect in self.effects)
        return replace(
            scene,
            ball_effects=effects,
            raceway_control=self.control if effects else None,
            hertz_angle=self.hertz_angle,
            hertz_form=self.hertz_form,
        )

    def simplified(self, scene: Scene) -> Scene:
        """The scene with what it names left out or simplified where this rung is simpler; nothing is added.

        Only what is a simplification is replaced: a scene's inner-raceway control, angle zero or published fit is part
        of its question. Effects that no rung knows stay.
        """
        known = {effect for rung in LADDER for effect in rung.effects}
        effects = tuple(
            effect for effect in scene.ball_effects if type(effect) in self.effects or type(effect) not in known
        )
        control, angle, form = scene.raceway_control, scene.hertz_angle, scene.hertz_form
        if control is RacewayControl.PER_BALL:
            control = self.control
        return replace(
            scene,
            ball_effects=effects,
            raceway_control=control if effects else None,
            hertz_angle=self.hertz_angle if angle is HertzAngle.ACTUAL else angle,
            hertz_form=self.hertz_form if form is HertzForm.EXACT else form,
        )


_BOTH = (CentrifugalForce, GyroscopicMoment)
_PER_BALL = RacewayControl.PER_BALL

LADDER = (
    Rung("thrust_estimate", "closed-form thrust estimate", hertz_form=HertzForm.BREWE_HAMROCK_1977, is_solved=False),
    Rung("static_closed_form_hertz", "static, closed-form Hertz", hertz_form=HertzForm.BREWE_HAMROCK_1977),
    Rung("static", "static, exact Hertz"),
    Rung("centrifugal", "centrifugal force alone", (CentrifugalForce,)),
    Rung("quasi_static", "both ball effects, outer control", _BOTH),
    Rung("per_ball_control", "both, control by each ball", _BOTH, _PER_BALL),
    Rung("actual_angle", "both, by each ball, actual-angle Hertz", _BOTH, _PER_BALL, HertzAngle.ACTUAL),
)
"""From the cheapest to the finest."""

SOLVED = tuple(rung for rung in LADDER if rung.is_solved)
TOP = LADDER[-1]


def ways(scene: Scene) -> list[tuple[Rung, Scene]]:
    """The simplifications of a scene, all different, the scene's own fidelity last; rungs that come to the same thing
    count as the cheapest of them."""
    found: list[tuple[Rung, Scene]] = []
    for rung in SOLVED:
        simpler = rung.simplified(scene)
        if not any(_same(simpler, other) for _, other in found):
            found.append((rung, simpler))
    return found


def _same(one: Scene, other: Scene) -> bool:
    """Whether two fidelities of one scene are the same."""
    return (
        one.ball_effects == other.ball_effects
        and one.raceway_control is other.raceway_control
        and one.hertz_angle is other.hertz_angle
        and one.hertz_form is other.hertz_form
    )
