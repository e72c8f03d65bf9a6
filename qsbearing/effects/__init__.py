"""What a scene may ask for beside the contacts: one effect, one file, each opening with its card."""

from qsbearing.effects.centrifugal_force import CentrifugalForce
from qsbearing.effects.gyroscopic_moment import GyroscopicMoment, MomentShares

BallEffect = CentrifugalForce | GyroscopicMoment

__all__ = ["BallEffect", "CentrifugalForce", "GyroscopicMoment", "MomentShares"]
