"""What a scene may ask for beside the contacts: one effect, one file, each opening with its card."""

from qsbearing.effects.ball_expansion import BallExpansion
from qsbearing.effects.centrifugal_force import CentrifugalForce
from qsbearing.effects.gyroscopic_moment import GyroscopicMoment, MomentShares
from qsbearing.effects.ring_expansion import RingExpansion, RingState

BallEffect = CentrifugalForce | GyroscopicMoment
RingEffect = RingExpansion | BallExpansion

__all__ = [
    "BallEffect",
    "BallExpansion",
    "CentrifugalForce",
    "GyroscopicMoment",
    "MomentShares",
    "RingEffect",
    "RingExpansion",
    "RingState",
]
