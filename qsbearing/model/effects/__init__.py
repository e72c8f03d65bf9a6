"""What a scene may ask for in addition to the contacts: one effect or choice, one file, each opening with its card.

`EFFECTS` is the one list of them, from the first to be added to the last. The chooser, `qsbearing explain`, the list
of model levels and the cost study go through it and know none by name. To add one:

1. One file here: the card (what, source and equation, assumptions, when not to use it, parameters, indicator); what it
   does, as formulas; and its `ENTRY`, which says how it is put into a scene, how much it matters and what it needs
   (`qsbearing.model.effects.entry`). An effect with parameters of its own is not made without them, and says so in
   `needs`.
2. One line in `_FILES`, where it stands by what it takes to evaluate it.

What changes the bearing before the solve, or chooses among formulas that are there, needs no more. What acts on the
balls while they are being solved also needs its switch in `kernel/case.py` and one guarded call in
`kernel/ball_inertia.py`. The keys of an effect's numbers in scene files follow from its fields (`described.py`).
The guide's page `adding_an_effect.md` does it once.
"""

from importlib import import_module

from qsbearing.model.effects.ball_expansion import BallExpansion
from qsbearing.model.effects.centrifugal_force import CentrifugalForce
from qsbearing.model.effects.elastic_rings import ElasticRings
from qsbearing.model.effects.entry import QUANTITIES, Entry
from qsbearing.model.effects.gyroscopic_moment import GyroscopicMoment, MomentShares
from qsbearing.model.effects.operating_point import OperatingPoint
from qsbearing.model.effects.ring_expansion import RingExpansion, RingState
from qsbearing.model.effects.seats_out_of_round import SeatsOutOfRound
from qsbearing.model.effects.unequal_balls import BallDiameterDeviations

_FILES = (
    "hertz_form",
    "tilt_lever",
    "ring_expansion",
    "ball_expansion",
    "elastic_rings",
    "unequal_balls",
    "seats_out_of_round",
    "centrifugal_force",
    "gyroscopic_moment",
    "moment_shares",
    "gyroscopic_slip",
    "raceway_control",
    "hertz_angle",
    "orbit_radius",
    "ball_motion",
)

EFFECTS: tuple[Entry, ...] = tuple(import_module(f"qsbearing.model.effects.{name}").ENTRY for name in _FILES)

BallEffect = CentrifugalForce | GyroscopicMoment
RingEffect = RingExpansion | BallExpansion | BallDiameterDeviations | ElasticRings | SeatsOutOfRound
"""The effects of this list that type checkers know."""


def types_in(slot: str) -> dict[str, type]:
    """The effects that a scene holds in a tuple, `ball_effects` or `ring_effects`, by their names."""
    return {entry.name: entry.switch.effect_type for entry in EFFECTS if entry.switch.slot == slot}


def as_made(ring_effects: tuple[RingEffect, ...]) -> tuple[RingEffect, ...]:
    """What of these ring effects a bearing has at rest and cold too, before fitting."""
    return tuple(filter(None, (effect.at_rest(False) for effect in ring_effects)))


def as_fitted(ring_effects: tuple[RingEffect, ...]) -> tuple[RingEffect, ...]:
    """What of these ring effects a bearing has at rest and cold, with its fits."""
    return tuple(filter(None, (effect.at_rest(True) for effect in ring_effects)))


__all__ = [
    "EFFECTS",
    "QUANTITIES",
    "BallDiameterDeviations",
    "BallEffect",
    "BallExpansion",
    "CentrifugalForce",
    "ElasticRings",
    "Entry",
    "GyroscopicMoment",
    "MomentShares",
    "OperatingPoint",
    "RingEffect",
    "RingExpansion",
    "RingState",
    "SeatsOutOfRound",
    "as_fitted",
    "as_made",
    "types_in",
]
