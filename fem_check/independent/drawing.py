"""A bearing's drawing: the dimensions and materials from which fem_check derives all of its own closed forms."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import acos, cos, pi, sin

from fem_check.independent.contact_problem import ElasticConstants
from fem_check.independent.groove import BallInGroove


@dataclass(frozen=True)
class BearingDrawing:
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
    interference: float = 0.0
    """How much less room, radially, the grooves leave than the balls need [m]; the free contact angle is then zero."""

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
        groove's radius exceeds the ball's; where the ball finds too little room, further out by what it lacks.
        """
        beyond = self.inner_groove_radius - 0.5 * self.ball_diameter
        return 0.5 * self.pitch_diameter + self.interference + beyond * cos(self.free_contact_angle)

    @property
    def outer_groove_centre_radius(self) -> float:
        """Of the circle of outer groove centres, on the pitch circle's other side [m]."""
        beyond = self.outer_groove_radius - 0.5 * self.ball_diameter
        return 0.5 * self.pitch_diameter - beyond * cos(self.free_contact_angle)

    @property
    def groove_centre_distance(self) -> float:
        """From groove centre to groove centre through a ball that just touches both [m]."""
        return self.inner_groove_radius + self.outer_groove_radius - self.ball_diameter

    @property
    def touching_offset(self) -> float:
        """The axial part of that distance [m]."""
        return self.groove_centre_distance * sin(self.free_contact_angle)

    @property
    def diametral_clearance(self) -> float:
        """How far the rings can be moved across the axis, from contact to contact of balls at the bottom [m]."""
        apart = self.inner_groove_centre_radius - self.outer_groove_centre_radius
        return 2.0 * (self.groove_centre_distance - apart)

    def with_ball(self, diameter: float) -> BearingDrawing:
        """A ball of another diameter between the same grooves; lengths of the rings are to be taken from this one."""
        return replace(self, ball_diameter=diameter)

    def grown(
        self,
        ball: float = 0.0,
        inner_radius: float = 0.0,
        outer_radius: float = 0.0,
        inner_centre: float = 0.0,
        outer_centre: float = 0.0,
    ) -> BearingDrawing:
        """The drawing once the ball's diameter, the groove radii and the circles of groove centres have grown [m].

        The free contact line joins the groove centres; its angle follows from how far apart they now are, radially. A
        ball keeps its mass.
        """
        grown = replace(
            self,
            ball_diameter=self.ball_diameter + ball,
            inner_groove_radius=self.inner_groove_radius + inner_radius,
            outer_groove_radius=self.outer_groove_radius + outer_radius,
            ball_density=self.ball_density * (self.ball_diameter / (self.ball_diameter + ball)) ** 3,
        )
        inner = self.inner_groove_centre_radius + inner_centre
        outer = self.outer_groove_centre_radius + outer_centre
        apart, distance = inner - outer, grown.groove_centre_distance
        angle = acos(min(apart / distance, 1.0))
        return replace(
            grown,
            free_contact_angle=angle,
            interference=max(apart - distance, 0.0),
            pitch_diameter=2.0 * (outer + (grown.outer_groove_radius - 0.5 * grown.ball_diameter) * cos(angle)),
        )
