"""The model levels, from the cheapest to the finest: a line each in `LEVELS`.

An effect added later joins by a line there, and by one in `indicators` for `run --accuracy`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from qsbearing.contact.hertz import HertzForm
from qsbearing.effects import BallEffect, CentrifugalForce, GyroscopicMoment
from qsbearing.effects.raceway_control import RacewayControl
from qsbearing.scene.scene import HertzAngle, Scene


@dataclass(frozen=True)
class Level:
    """One model level: which ball effects it has, and what it chooses."""

    name: str
    """A key, in files."""
    text: str
    effects: tuple[type[BallEffect], ...] = ()
    control: RacewayControl = RacewayControl.OUTER
    hertz_angle: HertzAngle = HertzAngle.FREE
    hertz_form: HertzForm = HertzForm.EXACT

    def of(self, scene: Scene) -> Scene:
        """The scene's bearing and operation at this level, whatever effects and choices the scene names."""
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
        """The scene without the ball effects and the actual angle that this level does not have; nothing is added.

        All else is part of the scene's question or saves no time: raceway control, angle zero, the Hertz formula.
        """
        effects = tuple(one for one in scene.ball_effects if type(one) in self.effects or type(one) not in _BOTH)
        is_free = scene.hertz_angle is HertzAngle.ACTUAL and self.hertz_angle is HertzAngle.FREE
        return replace(
            scene,
            ball_effects=effects,
            raceway_control=scene.raceway_control if effects else None,
            hertz_angle=HertzAngle.FREE if is_free else scene.hertz_angle,
        )


_BOTH = (CentrifugalForce, GyroscopicMoment)
_PER_BALL = RacewayControl.PER_BALL

LEVELS = (
    Level("static_closed_form_hertz", "static, closed-form Hertz", hertz_form=HertzForm.BREWE_HAMROCK_1977),
    Level("static", "static, exact Hertz"),
    Level("centrifugal", "centrifugal force alone", (CentrifugalForce,)),
    Level("quasi_static", "both ball effects, outer control", _BOTH),
    Level("per_ball_control", "both ball effects, control by each ball", _BOTH, _PER_BALL),
    Level("actual_angle", "both, by each ball, actual-angle Hertz", _BOTH, _PER_BALL, HertzAngle.ACTUAL),
)
FINEST = LEVELS[-1]


def simplifications(scene: Scene) -> list[tuple[Level, Scene]]:
    """The scene simplified to each level, all different, the scene itself last; of levels that come to the same scene
    the cheapest."""
    found: dict[object, tuple[Level, Scene]] = {}
    for level in LEVELS[1:]:
        simple = level.simplified(scene)
        found.setdefault((simple.ball_effects, simple.hertz_angle), (level, simple))
    return list(found.values())
