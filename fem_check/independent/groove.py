"""Ball and groove: the curvatures that Hertz sees, and the true surfaces, sphere and torus."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin

import numpy as np

from fem_check.independent.contact_problem import Array, ContactProblem, ElasticConstants

RACES = ("inner", "outer")
NEWTON_STEPS = 4
"""For the height of the inclined torus, from that of the upright one, which is a hundredth of the gap away."""


@dataclass(frozen=True)
class BallInGroove:
    """One contact of a bearing: where ball and raceway touch at the free contact angle; SI units, radians.

    x runs across the groove, y along the rolling direction, z along the contact normal into the raceway. In `gap` the
    torus has its axis parallel to the tangent plane, at the distance that gives the rolling direction's radius, so that
    both planes are planes of symmetry. The bearing's own axis is inclined to it by the contact angle, which adds terms
    odd in x: `inclined_gap` has them.
    """

    name: str
    race_name: str
    """inner or outer."""
    ball_diameter: float
    groove_radius: float
    pitch_diameter: float
    contact_angle: float
    ball: ElasticConstants
    race: ElasticConstants

    def __post_init__(self) -> None:
        if self.race_name not in RACES:
            raise ValueError(f"raceway {self.race_name!r}: must be one of {', '.join(RACES)}")

    @property
    def _sign(self) -> int:
        return -1 if self.race_name == "inner" else 1

    @property
    def ball_radius(self) -> float:
        """D/2 [m]."""
        return 0.5 * self.ball_diameter

    @property
    def rolling_radius(self) -> float:
        """Of the raceway along the rolling direction, from its axis along the contact normal [m]."""
        reach = self.ball_diameter / self.pitch_diameter * cos(self.contact_angle)
        return self.ball_radius * (1.0 + self._sign * reach) / reach

    def problem(self, load: float) -> ContactProblem:
        """As Hertz sees it: curvature sums across and along the groove."""
        return ContactProblem(
            name=f"{self.name} {self.race_name}",
            curvature_x=1.0 / self.ball_radius - 1.0 / self.groove_radius,
            curvature_y=1.0 / self.ball_radius - self._sign / self.rolling_radius,
            ball=self.ball,
            race=self.race,
            load=load,
        )

    def ball_height(self, x: Array, y: Array) -> Array:
        """z of the ball's surface [m]: negative, it curves away from the raceway."""
        r2 = x * x + y * y
        return -r2 / (self.ball_radius + np.sqrt(self.ball_radius**2 - r2))

    def race_height(self, x: Array, y: Array) -> Array:
        """z of the raceway's surface [m]: the groove rises at its flanks (z < 0), an outer ring along y too."""
        rise = x * x / (self.groove_radius + np.sqrt(self.groove_radius**2 - x * x))
        profile = self.rolling_radius - self._sign * rise  # distance from the bearing axis
        drop = y * y / (profile + np.sqrt(profile**2 - y * y))
        return -rise - self._sign * drop

    def gap(self, x: Array, y: Array) -> Array:
        """The exact gap along the contact normal [m]."""
        return self.race_height(x, y) - self.ball_height(x, y)

    def inclined_gap(self, x: Array, y: Array) -> Array:
        """The same of the torus as it stands, its axis inclined by the contact angle; x grows with this angle."""
        sine, cosine = sin(self.contact_angle), cos(self.contact_angle)
        centres = 0.5 * self.pitch_diameter - self._sign * (self.groove_radius - self.ball_radius) * cosine
        z = self.race_height(x, y)
        for _ in range(NEWTON_STEPS):
            rise = z + self.groove_radius  # along the normal, from the circle of the groove's profile
            # Away from the bearing's axis, and along it towards growing contact angles.
            reach = centres + self._sign * (rise * cosine - x * sine)
            from_axis = np.hypot(reach, y)
            out, along = from_axis - centres, rise * sine + x * cosine
            miss = out**2 + along**2 - self.groove_radius**2
            z = z - 0.5 * miss / (self._sign * out * cosine * reach / from_axis + along * sine)
        return z - self.ball_height(x, y)

    def shared_slope(self, x: Array, y: Array) -> Array:
        """Slope across the groove of the surface that the deformed bodies share: each gives way by its compliance."""
        share = self.ball.compliance / (self.ball.compliance + self.race.compliance)
        ball = x / np.sqrt(self.ball_radius**2 - x * x - y * y)
        return (1.0 - share) * ball + share * x / np.sqrt(self.groove_radius**2 - x * x)
