"""How much an effect matters, judged without solving for it: dimensionless numbers that the error follows.

With Q the load of a contact, alpha its angle, delta the approach across the ball, BD the distance of the groove
centres and g = D/dm:

    centrifugal force    x = Fc/Q: the two contact angles of a ball part by about x cos(alpha)
    gyroscopic moment    y = 2 |Mg|/(D Q): the contact forces turn by about y
        for both, a turn of the contacts moves the ring by its square, enlarged by BD/delta, and the more so where a
        ball carries little: x (1 + BD/delta x), y (1 + BD/delta (x + y))
    control by each ball y, where Jones's criterion may give some ball to the inner raceway; else nothing
    actual angle         g sin(alpha)/(1 - g cos(alpha0)) for each radian by which angles leave alpha0: the change of
                         the curvature in the rolling direction
    exact Hertz          the fit's own deviation, in approach, semi-axes or pressure

Loads, angles and approaches come from formulas (`estimated`), before anything is solved, or from a solution (`found`).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.cost.answers import LIGHT
from qsbearing.cost.thrust_estimate import loaded_angle
from qsbearing.effects import CentrifugalForce, GyroscopicMoment
from qsbearing.hertz import HertzForm, point_contact
from qsbearing.raceway_control import RacewayControl
from qsbearing.scene import HertzAngle

if TYPE_CHECKING:
    from collections.abc import Callable

    from qsbearing.scene import Scene
    from qsbearing.solution import Solution

SPREAD = 2.5
"""A radial load or a moment adds about this times its mean share to the most loaded ball, and takes it from the least;
2 where all balls stay loaded, 4.4 where half of them are."""

TOUCHING = 0.02
"""A ball with less than this part of the largest load is about to lose its raceway."""

CONTROL_MARGIN = 1.02
"""Jones's criterion above this counts as settled for the outer raceway: the estimate of E is good to 1 %."""


@dataclass(frozen=True)
class Contacts:
    """What the balls carry; arrays (*cases)."""

    most: Any
    """Load of the most loaded ball [N]."""
    least: Any
    """Load of the least loaded ball that counts, at least a tenth of the most [N]."""
    angle: Any
    """Contact angle of the most loaded ball [rad]."""
    approach: Any
    """Across the most loaded ball [m]."""
    turn: Any
    """How far contact angles are from the free angle, at most [rad]."""
    control: Any
    """Jones's criterion Qo ao Eo cos(ai - ao)/(Qi ai Ei), the least: above 1 the outer raceway controls every ball."""
    touches: Any
    """Whether some ball is about to lose a raceway, or has: there stiffness starts with an infinite slope, and the
    little that an effect moves such a ball changes it out of proportion."""


class Judge:
    """A scene's bearing and speeds in numbers that all indicators share; arrays (*cases), 0-d for a single case."""

    def __init__(self, scene: Scene) -> None:
        bearing, operation = scene.bearing, scene.operation
        self.scene = scene
        self.count = np.asarray(bearing.ball_count, float)
        self.ball = np.asarray(bearing.ball_diameter, float)
        self.pitch = np.asarray(bearing.pitch_diameter, float)
        self.free = np.asarray(bearing.free_contact_angle, float)
        self.distance = bearing.groove_centre_distance
        self.gamma = self.ball / self.pitch
        self.mass, self.inertia = bearing.ball_mass, bearing.ball_inertia
        self.inner_speed = np.asarray(operation.speed, float)
        self.outer_speed = np.asarray(0.0 if operation.outer_speed is None else operation.outer_speed, float)
        self._contacts()

    def _contacts(self) -> None:
        """Both contacts under unit load at the free angle, exact and by the fit."""
        bearing = self.scene.bearing
        modulus = bearing.effective_modulus
        fields = [self.ball, self.gamma * np.cos(self.free), modulus]
        self.spin, stiffness, deviation = [], [], []
        for side, radius in ((-1.0, bearing.inner_groove_radius), (1.0, bearing.outer_groove_radius)):
            flat = np.broadcast_arrays(*fields, np.asarray(radius, float))
            cells = [_contact(side, *map(float, values)) for values in zip(*map(np.ravel, flat), strict=True)]
            table = np.array(cells).reshape(*flat[0].shape, 3)
            stiffness.append(table[..., 0])
            self.spin.append(table[..., 1])
            deviation.append(table[..., 2])
        self.inner_stiffness, self.outer_stiffness = stiffness
        self.series = (stiffness[0] ** (-2.0 / 3.0) + stiffness[1] ** (-2.0 / 3.0)) ** -1.5
        self.fit_deviation = np.maximum(*deviation)

    # Inertia forces, with both angles alike: theory of `kinematics` at ai = ao.

    def centrifugal_force(self, angle: Any) -> Any:
        """Fc of a ball at this contact angle [N]."""
        g = self.gamma * np.cos(angle)
        orbit = 0.5 * (self.inner_speed * (1.0 - g) + self.outer_speed * (1.0 + g))
        return 0.5 * self.mass * self.pitch * orbit**2

    def gyroscopic_force(self, angle: Any) -> Any:
        """2 |Mg|/D, the friction that carries the moment [N]; attitude by outer control."""
        g = self.gamma * np.cos(angle)
        orbit = 0.5 * (self.inner_speed * (1.0 - g) + self.outer_speed * (1.0 + g))
        rotation = 0.5 * (self.outer_speed - self.inner_speed) / self.gamma * (1.0 - g * g)
        attitude = np.arctan2(np.sin(angle), np.cos(angle) + self.gamma)
        # Along the contact line itself the speed is the rolling one; about the axis tilted from it, 1/cos of it.
        across = rotation * np.sin(attitude) / np.cos(attitude - angle)
        return 2.0 * self.inertia * np.abs(across * orbit) / self.ball


def _contact(side: float, ball: float, gamma: float, modulus: float, radius: float) -> tuple[float, float, float]:
    """(Q/delta^1.5, a E/Q^(1/3), deviation of the fit) of one raceway."""
    rolling, across = 2.0 / (ball * (1.0 + side * gamma)), 2.0 / ball - 1.0 / radius
    exact = point_contact(1.0, rolling, across, modulus)
    fit = point_contact(1.0, rolling, across, modulus, HertzForm.BREWE_HAMROCK_1977)
    deviation = max(
        abs(getattr(fit, name) / getattr(exact, name) - 1.0)
        for name in ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure")
    )
    ratio = min(rolling, across) / max(rolling, across)
    return exact.stiffness_constant, exact.semi_major_axis * (1.0 + (0.5 * pi - 1.0) * ratio), deviation


# Contacts before and after solving ----------------------------------------------------------------------------------


def estimated(judge: Judge) -> Contacts:
    """What the balls carry, by formulas: thrust as at rest, other loads by their usual share, held channels by the
    approach that they force."""
    operation = judge.scene.operation
    lever = 0.5 * judge.pitch
    thrust, central, angle = _in_the_middle(judge)
    sine, cosine = np.maximum(np.sin(angle), 0.05), np.maximum(np.cos(angle), 0.05)
    radial = _size(operation.radial_load_y, operation.radial_load_z)
    moment = _size(operation.moment_y, operation.moment_z) / lever
    around = SPREAD / judge.count * (radial / cosine + moment / sine)
    wobble = _size(operation.radial_displacement_y, operation.radial_displacement_z) * cosine
    wobble = wobble + _size(operation.tilt_y, operation.tilt_z) * lever * sine
    middle = (central / judge.series) ** (2.0 / 3.0)
    around = around + judge.series * ((middle + wobble) ** 1.5 - middle**1.5)
    most = np.maximum(central + around, 1e-300)
    least = np.maximum(central - around, LIGHT * most)
    approach = (most / judge.series) ** (2.0 / 3.0)
    pull = judge.centrifugal_force(angle) * cosine
    turn = np.abs(angle - judge.free) + 0.5 * np.minimum(pull / least, 1.0) + around / most * approach / judge.distance
    if operation.tilt_y is None and operation.tilt_z is None:
        # Free to tilt, the ring lets each ball's line of contact follow the load: its radial part varies with the
        # radial load, its axial part with the moment.
        axial, sideways = np.maximum(thrust, 1e-300), np.maximum(thrust, 1e-300) / np.tan(np.maximum(angle, 0.05))
        steep = np.arctan2(axial + SPREAD * moment, np.maximum(sideways - SPREAD * radial, 0.0))
        flat = np.arctan2(np.maximum(axial - SPREAD * moment, 0.0), sideways + SPREAD * radial)
        turn = turn + np.maximum(steep - angle, angle - flat)
    touches = central - around < LIGHT * most  # well above TOUCHING: the estimate is a rough one
    return Contacts(most, least, angle, approach, turn, _control(judge, 1.0 + pull / most, pull / most), touches)


def _in_the_middle(judge: Judge) -> tuple[Any, Any, Any]:
    """(axial load, ball load, contact angle) of the axial channel alone, loaded or held."""
    operation = judge.scene.operation
    if operation.axial_displacement is not None:
        rise = judge.distance * np.sin(judge.free) + np.asarray(operation.axial_displacement, float)
        level = judge.distance * np.cos(judge.free)
        approach = np.maximum(np.hypot(rise, level) - judge.distance, 0.0)
        load, angle = judge.series * approach**1.5, np.arctan2(rise, level)
        return judge.count * load * np.sin(angle), load, angle
    thrust = np.maximum(np.asarray(0.0 if operation.axial_load is None else operation.axial_load, float), 0.0)
    angle = np.vectorize(loaded_angle)(thrust / (judge.count * judge.series * judge.distance**1.5), judge.free)
    return thrust, thrust / (judge.count * np.maximum(np.sin(angle), 0.05)), angle


def found(judge: Judge, solution: Solution) -> Contacts:
    """What the balls carry in a solution."""
    inner, outer = solution.inner, solution.outer
    load, other = np.nan_to_num(inner.load), np.nan_to_num(outer.load)
    most = load.max(axis=-1)
    heavy = load > LIGHT * most[..., None]
    there = np.isfinite(solution.azimuth)
    top = np.argmax(load, axis=-1)[..., None]
    angle = np.take_along_axis(inner.angle, top, axis=-1)[..., 0]
    approach = np.take_along_axis(inner.approach + outer.approach, top, axis=-1)[..., 0]
    turns = [np.where(heavy, np.abs(side.angle - judge.free[..., None]), 0.0) for side in (inner, outer)]
    parting = np.where(heavy, np.abs(inner.angle - outer.angle), 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(heavy, other / load, np.inf)
    return Contacts(
        most,
        np.where(heavy, load, np.inf).min(axis=-1),
        angle,
        approach,
        np.maximum(turns[0], turns[1]).max(axis=-1),
        _control(judge, ratio, parting),
        (there & (load < TOUCHING * most[..., None])).any(axis=-1),
    )


def _control(judge: Judge, load_ratio: Any, parting: Any) -> Any:
    """Jones's criterion from Qo/Qi and |ai - ao|; the least over balls where these have them."""
    constant = judge.spin[1] / judge.spin[0]
    ratio = np.asarray(load_ratio)
    balls = ratio.ndim > constant.ndim
    criterion = (constant[..., None] if balls else constant) * ratio ** (4.0 / 3.0) * np.cos(parting)
    return criterion.min(axis=-1) if balls else criterion


def _size(*components: Any) -> Any:
    known = [np.asarray(component, float) for component in components if component is not None]
    return np.sqrt(sum((component**2 for component in known), np.zeros(())))


# Indicators ---------------------------------------------------------------------------------------------------------


def _turns(judge: Judge, contacts: Contacts) -> tuple[Any, Any, Any]:
    """(Fc/Q, 2 |Mg|/(D Q), BD/delta)."""
    fc = judge.centrifugal_force(contacts.angle) if judge.scene.centrifugal_force is not None else 0.0
    mg = judge.gyroscopic_force(contacts.angle) if judge.scene.gyroscopic_moment is not None else 0.0
    return fc / contacts.least, mg / contacts.least, judge.distance / contacts.approach


def centrifugal(judge: Judge, contacts: Contacts) -> Any:
    """Of leaving the centrifugal force out."""
    x, _, slender = _turns(judge, contacts)
    return x * (1.0 + slender * x)


def gyroscopic(judge: Judge, contacts: Contacts) -> Any:
    """Of leaving the gyroscopic moment out."""
    x, y, slender = _turns(judge, contacts)
    return y * (1.0 + slender * (x + y))


def control(judge: Judge, contacts: Contacts) -> Any:
    """Of letting the outer raceway control every ball."""
    x, y, slender = _turns(judge, contacts)
    return np.where(contacts.control > CONTROL_MARGIN, 0.0, (x + y) * (1.0 + slender * (x + y)))


def actual_angle(judge: Judge, contacts: Contacts) -> Any:
    """Of taking the curvature at the free contact angle."""
    g = judge.gamma
    return g * np.sin(contacts.angle) / (1.0 - g * np.cos(judge.free)) * contacts.turn


def exact_hertz(judge: Judge, contacts: Contacts) -> Any:
    """Of the fitted ellipse."""
    return judge.fit_deviation + 0.0 * contacts.most


@dataclass(frozen=True)
class Omission:
    """One thing that a simpler fidelity does without."""

    name: str
    words: str
    is_omitted: Callable[[Scene, Scene], bool]
    """Whether the first scene does without what the second, its full form, has."""
    indicator: Callable[[Judge, Contacts], Any]


def _lacks(effect: type) -> Callable[[Scene, Scene], bool]:
    def lacks(simple: Scene, full: Scene) -> bool:
        return any(isinstance(one, effect) for one in full.ball_effects) and not any(
            isinstance(one, effect) for one in simple.ball_effects
        )

    return lacks


OMISSIONS = (
    Omission(
        "exact_hertz",
        "the exact ellipse (a published fit instead)",
        lambda simple, full: simple.hertz_form is not full.hertz_form,
        exact_hertz,
    ),
    Omission("centrifugal_force", "the centrifugal force", _lacks(CentrifugalForce), centrifugal),
    Omission("gyroscopic_moment", "the gyroscopic moment", _lacks(GyroscopicMoment), gyroscopic),
    Omission(
        "per_ball_control",
        "control by each ball (outer control instead)",
        lambda simple, full: (
            full.raceway_control is RacewayControl.PER_BALL and simple.raceway_control is RacewayControl.OUTER
        ),
        control,
    ),
    Omission(
        "actual_angle",
        "the actual angle in Hertz (the free one instead)",
        lambda simple, full: full.hertz_angle is HertzAngle.ACTUAL and simple.hertz_angle is not full.hertz_angle,
        actual_angle,
    ),
)
"""Everything that some rung does without; its error is judged by its own indicator, and errors of several add up."""


def omissions(simple: Scene, full: Scene) -> tuple[Omission, ...]:
    """What a simpler fidelity does without."""
    return tuple(omission for omission in OMISSIONS if omission.is_omitted(simple, full))
