"""A bearing's drawing: the dimensions and materials from which fem_check derives all of its own closed forms."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi

from fem_check.contact_problem import ElasticConstants
from fem_check.groove import BallInGroove


@dataclass(frozen=True)
class Drawing:
    """One bearing; SI units, radians. Nothing derived is taken over: curvatures, masses and lengths follow here."""

    name: str
    ball_diameter: float
    pitch_diameter: float
    inner_groove_radius: float
    outer_groove_radius: float
    free_contact_angle: float
    ball: ElasticConstants
    ring: ElasticConstants
    ball_density: float

    def groove(self, race: str, contact_angle: float | None = None) -> BallInGroove:
        """Ball and raceway where they touch: at the free contact angle, or at another."""
        return BallInGroove(
            name=self.name,
            race_name=race,
            ball_diameter=self.ball_diameter,
            groove_radius=self.inner_groove_radius if race == "inner" else self.outer_groove_radius,
            pitch_diameter=self.pitch_diameter,
            contact_angle=self.free_contact_angle if contact_angle is None else contact_angle,
            ball=self.ball,
            race=self.ring,
        )

    @property
    def ball_mass(self) -> float:
        """Of a solid sphere [kg]."""
        return self.ball_density * 4.0 / 3.0 * pi * (0.5 * self.ball_diameter) ** 3

    @property
    def ball_inertia(self) -> float:
        """Of a solid sphere about any axis through its centre, 2/5 m r^2 [kg m^2]."""
        return 0.4 * self.ball_mass * (0.5 * self.ball_diameter) ** 2

    @property
    def inner_groove_centre_radius(self) -> float:
        """Of the circle of inner groove centres [m].

        The unloaded ball's centre lies on the pitch circle, the groove's beyond it along the contact line by what the
        groove's radius exceeds the ball's.
        """
        beyond = self.inner_groove_radius - 0.5 * self.ball_diameter
        return 0.5 * self.pitch_diameter + beyond * cos(self.free_contact_angle)
