"""Balls that friction moves: random bearings, and every solution recomputed from what it says of ring, balls and
contacts.

    python -m tests.verification.campaign.friction COUNT [SEED] [--out FILE]

Nothing of the kernel is used. Velocities are those of two bodies at a point, omega x r in space; friction is summed
over points of SciPy's rule for the weight s^2; a ball's inertia is its acceleration and the change of its angular
momentum on its way, whose derivatives come from a Fourier transform of the balls' motions. What converged must balance
in force and moment, ball by ball and on the ring, and in energy; the outer ring must carry what loads the inner one.

| quantity | range |
|---|---|
| bearing, speeds, axial load | those of the realistic envelope; a tenth at rest, 15 % with the outer ring turning |
| radial load | none, but for `RADIAL` bearings of each batch: to 0.8 or 3 Fa/tan(alpha), tilts held |
| friction | mu 0.02 to 0.2, at slip speeds of 0.01 to 1 m/s; for a sixth of the batches in proportion to slip |
| contacts | on their common curvature (three quarters of the batches), or flat |
| orbits | of the pitch circle, or, without radial load, for a third of the balls' own radii |
| drag | for a third of the batches whose friction has a bound: of oil to 100 kg/m^3, and up to 2 N of the cage |
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import roots_sh_jacobi

import qsbearing as qs
from qsbearing.model.effects.traction import Traction, TractionLaw
from qsbearing.model.kernel.traction import ANGLES, RADII
from qsbearing.model.kernel.traction_balance import TOLERANCE
from qsbearing.model.solution.friction_balance import ContactFriction, FrictionMotion
from qsbearing.model.solution.friction_motion import friction_motion
from tests.verification.campaign import realistic
from tests.verification.campaign.batches import Batch, per_row, run
from tests.verification.campaign.certificates import NOT_PROVED
from tests.verification.campaign.checks import CLOSURE, HERTZ, Contacts, hertz_error
from tests.verification.campaign.friction_certificates import certificates
from tests.verification.campaign.group import Group, one_of

BATCH, RADIAL = 208, 8
"""Bearings of a batch, and how many of them are under radial load: of 10,400, 400."""
BALANCE = 1e-9
"""Of the largest load, of that times D, and of the power."""
SKIDDING = 0.9
"""Of the drag that friction can bear: the balance may be lost from here on."""
UNEXPLAINED = "not_converged"
E_X = np.array([1.0, 0.0, 0.0])


def draw(rng: np.random.Generator, is_radial: bool, n: int) -> tuple[qs.Scene, Traction]:
    """So many bearings that one call can solve, and the law of their friction."""
    bearing, materials = realistic.draw_bearing(rng, n)
    held = (False, False, False, is_radial, is_radial)
    operation = realistic.draw_operation(rng, held, (is_radial, False), bearing, materials)
    for axis in "yz":
        if is_radial:
            operation[f"tilt_{axis}_mrad"] = np.zeros(n)
    orbit = qs.OrbitRadius.DISPLACED if not is_radial and rng.random() < 1.0 / 3.0 else qs.OrbitRadius.PITCH_CIRCLE
    group = Group(
        qs.BearingKind.ANGULAR_CONTACT, realistic.BOTH, qs.RacewayControl.OUTER, qs.MomentShares.CONTROLLING,
        qs.HertzAngle.FREE, qs.HertzForm.EXACT, qs.TiltLever.GROOVE_CENTRE, held, bearing, materials, operation, orbit,
    )  # fmt: skip
    law = one_of(rng, list(TractionLaw), [5.0 / 6.0, 1.0 / 6.0])
    more: dict[str, Any] = {}
    if law is TractionLaw.COULOMB and rng.random() < 1.0 / 3.0:
        more = {"drag_coefficient": 0.4, "fluid_density": float(10.0 ** rng.uniform(0.0, 2.0))}
        more["cage_drag"] = float(rng.uniform(0.0, 2.0)) * (rng.random() < 0.5)
    traction = Traction(
        rng.uniform(0.02, 0.2, n),
        10.0 ** rng.uniform(-2.0, 0.0, n),
        law,
        bool(rng.random() < 0.75),
        **more,
    )
    return group.scene(), traction


@dataclass(frozen=True)
class AtContacts:
    """What one ring's contacts do to the balls, in space; (case, ball, 3), powers (case, ball)."""

    normal: NDArray
    force: NDArray
    moment: NDArray
    """About the ball's centre."""
    heat: NDArray
    torque: NDArray
    """About the bearing's axis."""


@dataclass(frozen=True)
class Recomputed:
    """A solution's balls as bodies in space; arrays (case, ball), vectors (case, ball, 3)."""

    scene: qs.Scene
    traction: Traction
    found: FrictionMotion

    @cached_property
    def there(self) -> NDArray:
        """Whether the case has the ball, and a solution."""
        count = np.asarray(self.scene.bearing.ball_count)[..., None]
        number = np.arange(self.found.weight.shape[-1])
        return np.asarray((number < count) & (self.found.status == "converged")[:, None])

    def of_bearing(self, name: str) -> NDArray:
        """A length or so of the bearing, (case, 1)."""
        return self.column(getattr(self.scene.bearing, name))

    def column(self, value: Any) -> NDArray:
        """A number of each case, or of all, (case, 1)."""
        return np.asarray(np.broadcast_to(np.asarray(value, float), self.found.status.shape)[:, None])

    @cached_property
    def azimuth(self) -> NDArray:
        """Of balls that stand at equal angles."""
        first = self.column(self.scene.operation.first_ball_azimuth)
        number = np.arange(self.found.weight.shape[-1])
        return np.asarray(first + 2.0 * np.pi * number / self.of_bearing("ball_count"))

    @cached_property
    def axes(self) -> tuple[NDArray, NDArray]:
        """Radially outward, and against the orbit."""
        zero = np.zeros_like(self.azimuth)
        outward = np.stack([zero, np.cos(self.azimuth), np.sin(self.azimuth)], axis=-1)
        return outward, np.cross(outward, E_X)

    @cached_property
    def speeds(self) -> dict[str, NDArray]:
        """Of the rings, (case, 1)."""
        operation = self.scene.operation
        outer = 0.0 if operation.outer_speed is None else operation.outer_speed
        return {"inner": self.column(operation.speed), "outer": self.column(outer)}

    @cached_property
    def orbit(self) -> NDArray:
        """omega_m; nothing at rest."""
        return np.nan_to_num(self.found.orbital_speed)

    @cached_property
    def radius(self) -> NDArray:
        """At which balls go round: the pitch circle's, or as far out as their outer contacts let them."""
        half = np.broadcast_to(0.5 * self.of_bearing("pitch_diameter"), self.azimuth.shape)
        if self.scene.orbit_radius is qs.OrbitRadius.PITCH_CIRCLE:
            return half
        free = self.line("outer", 0.0) * np.cos(self.of_bearing("free_contact_angle"))
        return half + self.line("outer", self.found.outer.approach) * np.cos(self.found.outer.angle) - free

    def line(self, side: str, approach: Any) -> NDArray:
        """Length of a contact line, from the groove's centre to the ball's."""
        return self.of_bearing(f"{side}_groove_radius") - 0.5 * self.of_bearing("ball_diameter") + approach

    @cached_property
    def rotation(self) -> NDArray:
        """The balls' angular velocity in space."""
        outward, against = self.axes
        w = np.nan_to_num(self.found.angular_velocity)
        along = (w[..., 0] + self.orbit)[..., None] * E_X
        return along + w[..., 1, None] * against + w[..., 2, None] * outward

    def contact(self, side: str) -> AtContacts:
        """Friction over the ellipses of one ring's contacts, from the velocities of ball and ring."""
        return self.at(side, getattr(self.found, side))

    def at(self, side: str, of: ContactFriction) -> AtContacts:
        """The same of these contacts."""
        outward, against = self.axes
        sign = 1.0 if side == "outer" else -1.0
        normal = sign * (np.sin(of.angle)[..., None] * E_X + np.cos(of.angle)[..., None] * outward)
        across = np.cross(against, normal)
        a, b = (np.nan_to_num(each)[..., None] for each in (of.semi_major_axis, of.semi_minor_axis))
        x, y, part = ellipse_points()
        xi, eta, h = a * x, b * y, self.height(side, a, a * x)
        arm = (
            h[..., None] * normal[:, :, None]
            + xi[..., None] * across[:, :, None]
            + eta[..., None] * against[:, :, None]
        )
        centre = self.radius[..., None] * outward
        place = centre[:, :, None] + arm
        ball = np.cross(self.orbit[..., None] * E_X, centre)[:, :, None] + np.cross(self.rotation[:, :, None], arm)
        ring = np.cross(self.speeds[side][..., None, None] * E_X, place)
        slip = ball - ring
        slip = slip - np.einsum("cbpi,cbi->cbp", slip, normal)[..., None] * normal[:, :, None]
        pushed = -self.over_slip(slip) * part * np.nan_to_num(of.load)[..., None]
        force = pushed[..., None] * slip
        return AtContacts(
            normal,
            force.sum(axis=2) - np.nan_to_num(of.load)[..., None] * normal,
            np.cross(arm, force).sum(axis=2),
            -(force * slip).sum(axis=(2, 3)),
            np.cross(place, force)[..., 0].sum(axis=2),
        )

    def height(self, side: str, a: NDArray, xi: NDArray) -> NDArray:
        """Of points of the contact over the ball's centre: on an arc of the common radius, through the ball at +-a."""
        ball = 0.5 * self.of_bearing("ball_diameter")[..., None]
        if not self.traction.has_curvature:
            return np.broadcast_to(ball, xi.shape)
        groove = self.of_bearing(f"{side}_groove_radius")[..., None]
        common = 2.0 / (1.0 / ball + 1.0 / groove)
        return np.asarray(np.sqrt(common**2 - xi**2) - np.sqrt(common**2 - a**2) + np.sqrt(ball**2 - a**2))

    def over_slip(self, slip: NDArray) -> NDArray:
        """Friction over load and slip."""
        of = self.traction
        mu, vc = (self.column(each)[:, None] for each in (of.coefficient, of.slip_speed))
        if of.law is TractionLaw.LINEAR:
            return np.broadcast_to(mu / vc, slip.shape[:-1])
        return np.asarray(mu / np.sqrt((slip**2).sum(axis=-1) + vc**2))

    @cached_property
    def drag(self) -> NDArray:
        """Against the orbit."""
        speed, of = self.radius * self.orbit, self.traction
        forward = np.where(self.speeds["inner"] + self.speeds["outer"] > 0.0, 1.0, -1.0)
        disc = (of.drag_coefficient or 0.0) * (of.fluid_density or 0.0) * np.pi / 8.0
        of_oil = disc * self.of_bearing("ball_diameter") ** 2 * speed * np.abs(speed)
        is_turning = (self.speeds["inner"] != 0.0) | (self.speeds["outer"] != 0.0)
        return np.asarray((of_oil + of.cage_drag * forward) * is_turning)

    @cached_property
    def rates(self) -> tuple[NDArray, NDArray]:
        """(angular velocity in the ball's own axes, omega_m) by the azimuth, of balls that are carried round."""
        w, orbit = np.nan_to_num(self.found.angular_velocity), self.orbit
        by_azimuth = np.zeros_like(w), np.zeros_like(orbit)
        if not self.is_radial:
            return by_azimuth
        for case, count in enumerate(np.broadcast_to(self.scene.bearing.ball_count, self.found.status.shape)):
            count = int(count)
            wave = 1j * np.fft.fftfreq(count, 1.0 / count)
            wave[count // 2] *= count % 2  # the highest wave of an even number has no derivative at the balls
            for values, into in ((w, by_azimuth[0]), (orbit, by_azimuth[1])):
                turned = np.fft.fft(values[case, :count], axis=0)
                into[case, :count] = np.fft.ifft((wave * turned.T).T, axis=0).real
        return by_azimuth

    @cached_property
    def is_radial(self) -> bool:
        """Whether balls have different loads to go through."""
        given = self.scene.operation.radial_load_y, self.scene.operation.radial_load_z
        return any(np.any(np.asarray(each, float) != 0.0) for each in given if each is not None)

    @cached_property
    def weight(self) -> NDArray:
        """Part of the time at each azimuth, times the number of balls."""
        stays = np.where(self.there & (self.orbit != 0.0), 1.0 / np.where(self.orbit == 0.0, 1.0, self.orbit), 0.0)
        mean = stays.sum(axis=1, keepdims=True) / self.of_bearing("ball_count")
        return np.where(mean != 0.0, stays / np.where(mean == 0.0, 1.0, mean), self.there)

    def changes(self) -> tuple[NDArray, NDArray]:
        """Of momentum and of angular momentum in time."""
        outward, against = self.axes
        mass = (
            self.column(self.scene.bearing.ball_material.density) * np.pi / 6.0 * self.of_bearing("ball_diameter") ** 3
        )
        inertia = mass * self.of_bearing("ball_diameter") ** 2 / 10.0
        w_rate, orbit_rate = self.rates
        travel = np.cross(E_X, outward)
        faster = (self.radius * self.orbit * orbit_rate)[..., None] * travel
        momentum = mass[..., None] * (faster - (self.radius * self.orbit**2)[..., None] * outward)
        turned = w_rate[..., 0, None] * E_X + w_rate[..., 1, None] * against + w_rate[..., 2, None] * outward
        turned = self.orbit[..., None] * (turned + orbit_rate[..., None] * E_X)
        carried = np.cross(self.orbit[..., None] * E_X, self.rotation)
        return momentum, inertia[..., None] * (turned + carried)

    @cached_property
    def largest(self) -> NDArray:
        """Load of a contact, (case,)."""
        largest = np.maximum(np.nan_to_num(self.found.inner.load), np.nan_to_num(self.found.outer.load)).max(axis=1)
        return np.where(largest > 0.0, largest, 1.0)

    def errors(self) -> dict[str, NDArray]:
        """By name, (case,): of the largest load, of that times D, of the power that friction and drag take."""
        inner, outer = self.contact("inner"), self.contact("outer")
        against = self.axes[1]
        momentum, angular = self.changes()
        held_back = self.drag[..., None] * against
        there = self.there[..., None]
        largest = self.largest
        of_balls = np.where(there, inner.force + outer.force + held_back - momentum, 0.0)
        moments = np.where(there, inner.moment + outer.moment - angular, 0.0)
        weight = np.where(self.there, self.weight, 0.0)
        on_inner = -np.where(there, weight[..., None] * inner.force, 0.0).sum(axis=1)
        on_outer = -np.where(there, weight[..., None] * outer.force, 0.0).sum(axis=1)
        lost = np.where(there, weight[..., None] * held_back, 0.0).sum(axis=1)
        load = self.load()
        power = np.where(self.there, weight * (inner.heat + outer.heat), 0.0).sum(axis=1)
        power += np.where(self.there, weight * self.drag * self.radius * self.orbit, 0.0).sum(axis=1)
        driven = np.zeros_like(power)
        for side, each in (("inner", inner), ("outer", outer)):
            driven += np.where(self.there, weight * each.torque * self.speeds[side], 0.0).sum(axis=1)
        # Slow balls slip by little, and what Newton's method leaves of forces and moments works at the bodies' speeds.
        fastest = (np.abs(self.speeds["inner"]) + np.abs(self.speeds["outer"])) * self.radius
        fastest = fastest + np.linalg.norm(self.rotation, axis=-1) * self.of_bearing("ball_diameter")
        residual = np.maximum(TOLERANCE, self.found.residual)
        left = residual * largest * fastest.max(axis=1, initial=0.0, where=self.there)
        least = left * self.of_bearing("ball_count")[:, 0] / BALANCE
        said = np.where(self.there, np.abs(self.found.weight - self.weight), 0.0).max(axis=1)
        diameter = self.of_bearing("ball_diameter")[:, 0]
        return {
            "force on a ball": np.abs(of_balls).max(axis=(1, 2)) / largest,
            "moment on a ball": np.abs(moments).max(axis=(1, 2)) / (largest * diameter),
            "force on the inner ring": np.abs(on_inner + load).max(axis=1) / largest,
            "outer against inner ring": np.abs(on_outer + on_inner - lost).max(axis=1) / largest,
            "energy": np.where(driven == power, 0.0, np.abs(driven - power) / np.maximum(np.abs(power), least)),
            "weights": said,
        }

    def load(self) -> NDArray:
        """On the inner ring, (case, 3)."""
        operation, shape = self.scene.operation, self.found.status.shape
        given = operation.axial_load, operation.radial_load_y, operation.radial_load_z
        loads = [np.broadcast_to(np.asarray(0.0 if each is None else each, float), shape) for each in given]
        return np.stack(loads, axis=-1)

    def closure(self) -> NDArray:
        """Gap between the contact lines and the groove centres where the ring's displacement puts them, over BD."""
        found = self.found
        inner, outer = self.line("inner", found.inner.approach), self.line("outer", found.outer.approach)
        distance, free = self.of_bearing("groove_centre_distance"), self.of_bearing("free_contact_angle")
        x, y, z = (found.displacement[:, k, None] for k in range(3))
        axial = inner * np.sin(found.inner.angle) + outer * np.sin(found.outer.angle) - distance * np.sin(free) - x
        radial = inner * np.cos(found.inner.angle) + outer * np.cos(found.outer.angle) - distance * np.cos(free)
        radial = radial - y * np.cos(self.azimuth) - z * np.sin(self.azimuth)
        gap = np.maximum(np.abs(axial), np.abs(radial)) / np.maximum(distance, np.maximum(inner, outer))
        return np.where(self.there, gap, 0.0).max(axis=1)

    def hertz(self) -> NDArray:
        """Largest relative error of an ellipse or a load."""
        of_sides: Any = SimpleNamespace(inner=self.found.inner, outer=self.found.outer, ball_diameter_deviation=None)
        sides = (Contacts(self.scene, of_sides, race) for race in ("inner", "outer"))
        diameter = self.of_bearing("ball_diameter")
        return np.max([hertz_error(self.scene, side, diameter) for side in sides], axis=0)


def ellipse_points(radii: int = RADII, angles: int = ANGLES) -> tuple[NDArray, NDArray, NDArray]:
    """(x/a, y/b, part of the load) of all points of an ellipse."""
    s, weight = roots_sh_jacobi(radii, 3.0, 3.0)
    theta = 2.0 * np.pi * (np.arange(angles) + 0.5) / angles
    reach = np.sqrt(1.0 - s * s)[:, None]
    part = np.repeat(weight / weight.sum() / angles, angles)
    return (reach * np.cos(theta)).ravel(), (reach * np.sin(theta)).ravel(), part


def ends(scene: qs.Scene, traction: Traction, found: FrictionMotion) -> list[str]:
    """How each case ended, in words."""
    words = []
    skids = np.max(np.nan_to_num(drag_at(scene, traction, found.start)), axis=1) > SKIDDING
    for k, status in enumerate(found.status):
        if status == "not_converged":
            words.append(UNEXPLAINED + ": skids" * bool(skids[k]))
        else:
            words.append(f"{status}: {found.reason[k]}".removesuffix(": "))
    return words


def drag_at(scene: qs.Scene, traction: Traction, start: qs.Solution) -> NDArray:
    """Of each ball under outer control: drag over what friction bears at most, mu Qi (1 + cos(ai - ao)); less than that
    mu where the whole of the rings' speed is little slip."""
    bearing, operation = scene.bearing, scene.operation
    radius = 0.5 * np.asarray(bearing.pitch_diameter)[:, None]
    speed = radius * np.asarray(start.orbital_speed)
    disc = (traction.drag_coefficient or 0.0) * (traction.fluid_density or 0.0) * np.pi / 8.0
    drag = disc * (np.asarray(bearing.ball_diameter)[:, None] * speed) ** 2 + traction.cage_drag
    outer_speed = np.asarray(0.0 if operation.outer_speed is None else operation.outer_speed, float)
    slip = 0.5 * radius * (np.asarray(operation.speed, float) - outer_speed)[:, None]
    mu, vc = (np.asarray(each, float)[:, None] for each in (traction.friction_coefficient, traction.slip_speed))
    mu = mu * np.abs(slip) / np.hypot(slip, vc)
    return np.asarray(drag / (mu * start.inner.load * (1.0 + np.cos(start.inner.angle - start.outer.angle))))


def batch(rng: np.random.Generator, thrust: int = BATCH - RADIAL, radial: int = RADIAL) -> Batch:
    """How the bearings of a batch ended, those under thrust first."""
    return of_both(draw, solved, rng, thrust, radial)


def of_both(
    draw: Callable[..., Any], solved: Callable[..., Batch], rng: np.random.Generator, thrust: int, radial: int
) -> Batch:
    """What is drawn under thrust and what under radial load, in one batch."""
    of = Batch()
    for count, is_radial in ((thrust, False), (radial, True)):
        if count:
            merge(of, solved(*draw(rng, is_radial, count)), thrust * is_radial)
    return of


def solved(scene: qs.Scene, traction: Traction) -> Batch:
    """How the bearings of a call ended."""
    found = friction_motion(scene, traction)
    of = recomputed(Recomputed(scene, traction, found), ends(scene, traction, found))
    of.refusals = Counter(certificates(scene, traction, found, lambda each: holds(scene, traction, each)))
    return of


def holds(scene: qs.Scene, traction: Traction, found: FrictionMotion) -> NDArray:
    """Whether all that is recomputed of a case agrees."""
    return np.all([each <= most_of(name) for name, each in all_errors(Recomputed(scene, traction, found)).items()], 0)


def all_errors(of: Recomputed) -> dict[str, NDArray]:
    """By name, (case,)."""
    with np.errstate(all="ignore"):
        return of.errors() | {"closure": of.closure(), "hertz": of.hertz()}


def most_of(name: str) -> float:
    """That an error may be."""
    return {"closure": CLOSURE, "hertz": HERTZ}.get(name, BALANCE)


def recomputed(of: Recomputed, words: list[str]) -> Batch:
    """What became of cases that ended so, by what of them is recomputed."""
    return judged(of.found, words, all_errors(of))


def merge(of: Batch, more: Batch, first: int) -> None:
    """Put the cases of one call into a batch, with numbers from the first."""
    of.ended.update(more.ended)
    of.wrong |= {first + k: what for k, what in more.wrong.items()}
    of.not_converged += [first + k for k in more.not_converged]
    of.refusals.update(more.refusals)
    for error, value in more.largest.items():
        of.largest[error] = max(of.largest.get(error, 0.0), value)


def judged(found: FrictionMotion, words: list[str], errors: dict[str, NDArray]) -> Batch:
    """What became of the cases, by the errors of those that converged."""
    converged = found.status == "converged"
    of = Batch(Counter(words))
    for name, each in errors.items():
        for k in np.flatnonzero(converged & ~(each <= most_of(name))):
            of.wrong[int(k)] = f"{of.wrong.get(int(k), '')} {name} {each[k]:.1e}".strip()
        of.largest[name] = float(np.max(each, where=converged, initial=0.0))
    of.refusals = Counter(NOT_PROVED for word in words if word.startswith("no_equilibrium"))
    of.not_converged = [k for k, word in enumerate(words) if word == UNEXPLAINED]
    return of


if __name__ == "__main__":
    run("friction", batch, BATCH, per_row(), __doc__)
