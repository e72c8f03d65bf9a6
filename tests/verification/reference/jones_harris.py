"""The quasi-static equations of Jones and Harris, solved plainly and to fifty digits.

Sources: A. B. Jones 1960; T. A. Harris & M. N. Kotzalas, *Rolling Bearing Analysis*; Wang, Yan, Zhang & Hong,
"Research on the Dynamic Properties of Ball Bearings Based on the Quasi-Static Method" (chapter 19), whose equation
numbers (19.x) are quoted with their misprints put right.  SI units and radians throughout.

This module is a yardstick: it shares no code with the package that it measures, it is written to be read against the
equations, and it is slow on purpose.  Nothing is eliminated by hand: every ball has the four unknowns X1, X2, delta_i,
delta_o and every ring channel that carries a load adds one, the 4Z + 3 equations of the paper for three such channels.

Frame and signs
---------------
x is the bearing's axis, y and z are radial, and a ball's azimuth psi counts from +y towards +z, so that the radial
direction is e_r = (0, cos psi, sin psi) and the direction of travel is t = x cross e_r = (0, -sin psi, cos psi).
The outer ring stays put and the inner ring is displaced by d = (dx, dy, dz, gamma_y, gamma_z).  (a, r) below are the
axial and radial components in a ball's own plane.

* X = (X1, X2) is the ball's centre and A = (A1, A2) the inner groove's centre, both from the outer groove's centre.
* n_o = (sin alpha_o, cos alpha_o) points from the ball's centre to the outer contact,
  n_i = (sin alpha_i, cos alpha_i) from the inner contact to the ball's centre.

Kinematics with either ring turning
-----------------------------------
Look from the frame that turns with the ball's centre at the orbital speed w_m about +x.  There the rings turn at
w_i - w_m and w_o - w_m about +x and the ball spins at

    W = w_R (cos beta, -sin beta)        in (a, r),

so that a negative w_R, the usual case of an inner ring that turns forwards, is a ball that rolls backwards.  The
point at (a, r) from the centre of a body that turns at (W_a, W_r) moves along t at W_a r - W_r a.

*No slip at the outer contact*, (D/2) n_o from the ball's centre and dm/2 + (D/2) cos alpha_o from the axis:

    (w_o - w_m) (1 + g cos alpha_o) = + g w_R (cos beta cos alpha_o + sin beta sin alpha_o),      g = D/dm.

*No slip at the inner contact*, -(D/2) n_i from the ball's centre and dm/2 - (D/2) cos alpha_i from the axis:

    (w_i - w_m) (1 - g cos alpha_i) = - g w_R (cos beta cos alpha_i + sin beta sin alpha_i).

With  u = (cos alpha_o + tan beta sin alpha_o)/(1 + g cos alpha_o)  and
      v = (cos alpha_i + tan beta sin alpha_i)/(1 - g cos alpha_i)  these are two linear equations, whose solution is

    w_m = (u w_i + v w_o)/(u + v),        w_R = -(w_i - w_o)/[g cos beta (u + v)].                          (K1), (K2)

With w_o = 0 they are the printed w_m/w = 1/(1 + v/u) and w_R/w = -1/[(u + v) g cos beta].

*No spin at the controlling contact* fixes beta.  At the outer contact W . n_o = (w_o - w_m) sin alpha_o; put
w_o - w_m = g w_R cos beta u in it and the speeds cancel:

    outer control:  tan beta = sin alpha_o/(cos alpha_o + g),
    inner control:  tan beta = sin alpha_i/(cos alpha_i - g),

whichever ring turns.

*Minimum dissipation* lets the ball spin at both contacts, at w_s = W . n - (w_ring - w_m) sin alpha there.  Friction
moments c w_s with c = Q a E (a the semi-major axis, E of the second kind) dissipate c_i w_si^2 + c_o w_so^2, which is
least where c_i w_si + c_o w_so = 0.  That balance is linear in tan beta but for factors that do not vanish, so two
axes tell the third; shares of the gyroscopic moment follow the weights, see `shares_by_weight`.

*Unequal balls*, where a case gives each a deviation from D, lie between grooves that stay where they are: a ball's own
D makes its L_i and L_o, its Hertz constants, m, J and g.

*Seats out of round* have grooves of the form r = a cos n(psi - phase) each, outwards, which adds r_i - r_o to A2.

*The orbit* is the pitch circle, or the circle through the ball's own centre: then R = dm/2 + X2 - L_o cos alpha0
takes the place of dm/2, and g = D/(2 R), in all that follows from the ball's motion.

*A ball that has lost the inner race* has no contact line there.  It goes round as with equal contact angles: its inner
line counts as lying on the outer one.  So that its speeds do not jump where contact is lost, it goes over to that
within a gap of a fiftieth of the inner line's free length L_i, at the angle

    alpha_o + (1 - 3 t^2 + 2 t^3) (alpha_i - alpha_o),      t = -50 delta_i/L_i,      0 <= t <= 1.             (K3)

Inertia.  The ball's centre needs the centripetal force Fc = m (dm/2) w_m^2.  Its angular momentum J W is carried round
at w_m about x, which takes the moment  w_m x cross J W = J w_m W_r t = -Mg t  with

    Mg = J w_R w_m sin beta,

signed: negative if the inner ring alone turns, positive if the outer ring alone turns.  The friction that supplies it
is lambda_o (Mg/D) (cos alpha_o, -sin alpha_o) on the ball at the outer contact and the opposite-handed
-lambda_i (Mg/D) (cos alpha_i, -sin alpha_i) at the inner contact; its moment about the ball's centre is
-(lambda_o + lambda_i) (Mg/2) t, hence lambda_i + lambda_o = 2.  Where the contacts' friction
coefficient mu is given, a contact carries at most mu Q.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from mpmath import mp

Number = Any  # an mpf, or a float while the starting point is sought
CHANNELS = ("x", "y", "z", "tilt_y", "tilt_z")
GUARD_DIGITS = 30
PRINTED_DIGITS = 25


# ------------------------------------------------------------------------------------------------ the Hertz contact


@dataclass(frozen=True)
class HertzContact:
    """A ball in a groove: radii in m, moduli in Pa.  K and E are the complete elliptic integrals."""

    ellipticity: Number  # k = a/b >= 1
    first_kind: Number  # K
    second_kind: Number  # E
    curvature_sum: Number  # sum of the four principal curvatures, 1/m
    modulus: Number  # E', Pa

    @property
    def stiffness(self) -> Number:
        """Q/delta^1.5 = pi k E' sqrt(E/(4.5 rho K^3)), N/m^1.5  (19.18)."""
        roundness = self.second_kind / (mp.mpf(9) / 2 * self.curvature_sum * self.first_kind**3)
        return mp.pi * self.ellipticity * self.modulus * mp.sqrt(roundness)

    def semi_major_axis(self, load: Number) -> Number:
        """a = (6 k^2 E Q/(pi rho E'))^(1/3), m, across the direction of rolling."""
        return mp.cbrt(6 * self.ellipticity**2 * self.second_kind * load / (mp.pi * self.curvature_sum * self.modulus))

    def semi_minor_axis(self, load: Number) -> Number:
        """b = a/k, m."""
        return self.semi_major_axis(load) / self.ellipticity

    def max_pressure(self, load: Number) -> Number:
        """p0 = 1.5 Q/(pi a b), Pa."""
        if load == 0:
            return mp.mpf(0)
        return 3 * load / (2 * mp.pi * self.semi_major_axis(load) * self.semi_minor_axis(load))


def contact_modulus(one: tuple[Number, Number], two: tuple[Number, Number]) -> Number:
    """E' = 2/[(1 - nu1^2)/E1 + (1 - nu2^2)/E2] from two pairs (E in Pa, nu), Pa."""
    return 2 / ((1 - one[1] ** 2) / one[0] + (1 - two[1] ** 2) / two[0])


def solve_ellipticity(radius_ratio: Number) -> tuple[Number, Number, Number]:
    """(k, K, E) with the transverse radius over the rolling radius, Ry/Rx >= 1, given.

    The ellipticity equation ((k^2+1)E - 2K)/((k^2-1)E) = F(rho) = (1/Rx - 1/Ry)/(1/Rx + 1/Ry) says that 1/Rx and 1/Ry
    are to each other as k^2 E - K to K - E.  Newton's method on the logarithm of that ratio, over log k.
    """
    if radius_ratio == 1:
        return mp.mpf(1), mp.pi / 2, mp.pi / 2
    log_k = 2 / mp.pi * mp.log(radius_ratio)
    for _ in range(60):
        k = mp.exp(log_k)
        m = 1 - 1 / k**2
        first, second = mp.ellipk(m), mp.ellipe(m)
        first_rate = (second - (1 - m) * first) / (2 * m * (1 - m)) * 2 / k**2  # d/d(log k), as dm/d(log k) = 2/k^2
        second_rate = (second - first) / (2 * m) * 2 / k**2
        across, along = k**2 * second - first, first - second
        across_rate = 2 * k**2 * second + k**2 * second_rate - first_rate
        along_rate = first_rate - second_rate
        step = (mp.log(across / along) - mp.log(radius_ratio)) / (across_rate / across - along_rate / along)
        log_k -= step
        if abs(step) < mp.mpf(10) ** (-0.6 * mp.dps):  # quadratic: the next step would be below the last digit
            k = mp.exp(log_k)
            m = 1 - 1 / k**2
            return k, mp.ellipk(m), mp.ellipe(m)
    raise ArithmeticError("the ellipticity equation did not converge")


def groove_contact(
    ball_diameter: Number, groove_radius: Number, rolling_factor: Number, modulus: Number
) -> HertzContact:
    """The contact of a ball in a groove; rolling_factor is 1 - g cos(alpha) inside and 1 + g cos(alpha) outside."""
    conformity = groove_radius / ball_diameter
    rolling_radius = ball_diameter / 2 * rolling_factor
    transverse_radius = conformity * ball_diameter / (2 * conformity - 1)
    k, first, second = solve_ellipticity(transverse_radius / rolling_radius)
    return HertzContact(k, first, second, 1 / rolling_radius + 1 / transverse_radius, modulus)


# ------------------------------------------------------------------------------------------------ the scene in numbers


@dataclass(frozen=True)
class Scene:
    """A case in numbers (m, N, kg, rad, rad/s), all of one kind: mpf, or float for the search for a start."""

    ball_count: int
    D: Number  # ball diameter
    dm: Number  # pitch diameter
    ri: Number  # groove radii
    ro: Number
    alpha0: Number  # free contact angle
    sin0: Number
    cos0: Number
    mass: Number
    inertia: Number  # J = m D^2/10
    modulus: Number  # E'
    wi: Number  # speeds of the rings about +x
    wo: Number
    Ki: Number  # Hertz constants at the free angle
    Ko: Number
    psi: tuple[tuple[Number, Number], ...]  # (cos, sin) of each ball's azimuth
    loads: tuple[Number | None, ...]  # per channel: the load, or None if the channel is held
    held: tuple[Number | None, ...]  # per channel: the displacement, or None if the channel is loaded
    centrifugal: bool
    gyroscopic: Number  # 1 with and 0 without the gyroscopic moment; between them only on the way to a start
    control: tuple[str | None, ...]  # per ball: "outer", "inner" or None
    shares: str | None
    actual_angle: bool  # Hertz constants at each ball's own angle
    mu: Number | None  # friction that a contact carries at most, over its load
    own_orbit: bool  # balls go round on their own circles
    unequal: tuple[Scene, ...] | None = None  # per ball: the scene with that ball's diameter, mass and Hertz constants
    nearer: tuple[Number, ...] | None = None  # per ball: what lobes of the grooves add to A2

    @property
    def Lo(self) -> Number:
        """Distance of the ball's centre from the outer groove's centre at first touch, (fo - 1/2) D."""
        return self.ro - self.D / 2

    @property
    def Li(self) -> Number:
        """The same at the inner groove, (fi - 1/2) D."""
        return self.ri - self.D / 2

    @property
    def BD(self) -> Number:
        """Distance of the groove centres at first touch, (fi + fo - 1) D  (19.7)."""
        return self.ri + self.ro - self.D

    @property
    def Ri(self) -> Number:
        """Radius of the circle of inner groove centres, dm/2 + (fi - 1/2) D cos(alpha0)."""
        return self.dm / 2 + self.Li * self.cos0

    @property
    def g(self) -> Number:
        return self.D / self.dm

    def of_ball(self, ball: int) -> Scene:
        """The scene as a ball of its own diameter has it; the rings' lengths BD and Ri are the scene's own."""
        return self if self.unequal is None else self.unequal[ball]

    @property
    def turns(self) -> bool:
        """Whether a ball feels any inertia at all."""
        return (self.centrifugal or self.gyroscopic != 0) and (self.wi != 0 or self.wo != 0)

    @property
    def free(self) -> list[int]:
        """The channels whose displacement is unknown."""
        return [c for c in range(5) if self.held[c] is None]

    def in_floats(self) -> Scene:
        """The same scene in double precision, with the Hertz constants of the free angle."""
        names = ("D", "dm", "ri", "ro", "alpha0", "sin0", "cos0", "mass", "inertia", "modulus", "wi", "wo", "Ki", "Ko")
        values: dict[str, Any] = {name: float(getattr(self, name)) for name in names}
        values["mu"] = None if self.mu is None else float(self.mu)
        values["psi"] = tuple((float(c), float(s)) for c, s in self.psi)
        values["unequal"] = None if self.unequal is None else tuple(ball.in_floats() for ball in self.unequal)
        values["nearer"] = None if self.nearer is None else tuple(float(each) for each in self.nearer)
        values["loads"] = tuple(None if v is None else float(v) for v in self.loads)
        values["held"] = tuple(None if v is None else float(v) for v in self.held)
        return replace(self, gyroscopic=float(self.gyroscopic), actual_angle=False, **values)


def read_case(case: dict[str, Any]) -> Scene:
    """Turn a case (decimal strings, degrees and rpm as named by its keys) into numbers at the working precision."""
    count = int(case["ball_count"])
    D, dm = mp.mpf(case["ball_diameter"]), mp.mpf(case["pitch_diameter"])
    ri, ro = mp.mpf(case["inner_groove_radius"]), mp.mpf(case["outer_groove_radius"])
    alpha0 = mp.mpf(case["free_contact_angle_deg"]) * mp.pi / 180
    ball, ring = case["ball_material"], case["ring_material"]
    modulus = contact_modulus(
        (mp.mpf(ball["elastic_modulus"]), mp.mpf(ball["poisson_ratio"])),
        (mp.mpf(ring["elastic_modulus"]), mp.mpf(ring["poisson_ratio"])),
    )
    mass = mp.mpf(ball["density"]) * mp.pi * D**3 / 6
    channels = [case["channels"][name] for name in CHANNELS]
    control = case["control"]
    choices = (control,) * count
    if control == "per_ball":
        choices = tuple(case.get("ball_control") or ["outer"] * count)
    if case["gyroscopic_moment"] and (control is None or case["shares"] is None):
        raise ValueError("a gyroscopic moment needs a controlling raceway and a convention for its shares")
    if case["centrifugal_force"] and control is None:
        raise ValueError("a centrifugal force needs a controlling raceway")
    scene = Scene(
        ball_count=count, D=D, dm=dm, ri=ri, ro=ro, alpha0=alpha0, sin0=mp.sin(alpha0), cos0=mp.cos(alpha0), mass=mass,
        inertia=mass * D**2 / 10, modulus=modulus, wi=mp.mpf(case["inner_speed_rpm"]) * mp.pi / 30,
        wo=mp.mpf(case["outer_speed_rpm"]) * mp.pi / 30, Ki=None, Ko=None,
        psi=tuple((mp.cospi(mp.mpf(2 * j) / count), mp.sinpi(mp.mpf(2 * j) / count)) for j in range(count)),
        loads=tuple(mp.mpf(value) if kind == "load" else None for kind, value in channels),
        held=tuple(mp.mpf(value) if kind == "displacement" else None for kind, value in channels),
        centrifugal=bool(case["centrifugal_force"]), gyroscopic=mp.mpf(1 if case["gyroscopic_moment"] else 0),
        control=choices, shares=case["shares"], actual_angle=case["hertz_angle"] == "actual",
        mu=mp.mpf(case["friction_coefficient"]) if "friction_coefficient" in case else None,
        own_orbit=case.get("orbit_radius") == "displaced",
    )  # fmt: skip
    if "ball_diameter_deviations" in case:
        diameters = [D + mp.mpf(deviation) for deviation in case["ball_diameter_deviations"]]
        scene = replace(scene, unequal=tuple(with_balls_of(scene, diameter) for diameter in diameters))
    if "seat_lobes" in case:
        scene = replace(scene, nearer=tuple(lobes_at(case["seat_lobes"], mp.mpf(2 * j) / count) for j in range(count)))
    return replace(scene, Ki=inner_contact(scene, scene.cos0).stiffness, Ko=outer_contact(scene, scene.cos0).stiffness)


def lobes_at(seats: Sequence[Sequence[str]], half_turns: Number) -> Number:
    """r_i - r_o at an azimuth, of forms [ring, lobes, amplitude in m, phase in degrees]."""
    total = mp.mpf(0)
    for ring, lobes, amplitude, phase in seats:
        form = mp.mpf(amplitude) * mp.cospi(int(lobes) * (half_turns - mp.mpf(phase) / 180))
        total += form if ring == "inner" else -form
    return total


def with_balls_of(scene: Scene, diameter: Number) -> Scene:
    """The scene with balls of another diameter between the same grooves, and the Hertz constants that they have."""
    mass = scene.mass * (diameter / scene.D) ** 3
    changed = replace(scene, D=diameter, mass=mass, inertia=mass * diameter**2 / 10)
    return replace(
        changed, Ki=inner_contact(changed, scene.cos0).stiffness, Ko=outer_contact(changed, scene.cos0).stiffness
    )


def inner_contact(scene: Scene, cos_alpha: Number) -> HertzContact:
    """The inner contact at a contact angle: rolling radius D/2 (1 - g cos alpha)."""
    return groove_contact(scene.D, scene.ri, 1 - scene.g * cos_alpha, scene.modulus)


def outer_contact(scene: Scene, cos_alpha: Number) -> HertzContact:
    """The outer contact at a contact angle: rolling radius D/2 (1 + g cos alpha)."""
    return groove_contact(scene.D, scene.ro, 1 + scene.g * cos_alpha, scene.modulus)


# ------------------------------------------------------------------------------------------------ the equations


def root(x: Number) -> Number:
    """A square root of the same kind of number."""
    return x**0.5 if isinstance(x, float) else mp.sqrt(x)


def groove_centre(scene: Scene, ball: int, d: Sequence[Number]) -> tuple[Number, Number]:
    """A = (A1, A2), m: the inner groove's centre from the outer's in a ball's plane  (19.3), (19.4)."""
    c, s = scene.psi[ball]
    A1 = scene.BD * scene.sin0 + d[0] + scene.Ri * (d[3] * s - d[4] * c)
    A2 = scene.BD * scene.cos0 + d[1] * c + d[2] * s
    if scene.nearer is not None:
        A2 += scene.nearer[ball]
    return A1, A2


def attitude_tangent(control: str, inner: Sequence[Number], outer: Sequence[Number], g: Number) -> Number:
    """tan(beta) of the ball's axis for the raceway that controls; inner and outer are (sin, cos) of the angles."""
    if control == "outer":
        return outer[0] / (outer[1] + g)
    return inner[0] / (inner[1] - g)


def ball_speeds(
    wi: Number, wo: Number, inner: Sequence[Number], outer: Sequence[Number], tan_beta: Number, g: Number
) -> tuple[Number, Number]:
    """(w_m, w_R), rad/s, signed, by (K1) and (K2): orbit about +x and spin about (cos beta, -sin beta)."""
    u = (outer[1] + tan_beta * outer[0]) / (1 + g * outer[1])
    v = (inner[1] + tan_beta * inner[0]) / (1 - g * inner[1])
    secant = root(1 + tan_beta**2)  # 1/cos(beta)
    return (u * wi + v * wo) / (u + v), -(wi - wo) * secant / (g * (u + v))


def rolling_line(
    inner: tuple[Number, Number], outer: tuple[Number, Number], delta_i: Number, Li: Number
) -> tuple[Number, Number]:
    """(sin, cos) of the inner line as a rolling ball has it, by (K3)."""
    t = -50 * delta_i / Li
    if t <= 0:
        return inner
    if t >= 1:
        return outer
    exact = mp if isinstance(t, mp.mpf) else math
    apart = exact.atan2(
        inner[0] * outer[1] - inner[1] * outer[0], inner[0] * outer[0] + inner[1] * outer[1]
    )  # alpha_i - alpha_o
    angle = exact.atan2(outer[0], outer[1]) + (1 - t) ** 2 * (1 + 2 * t) * apart
    return exact.sin(angle), exact.cos(angle)


def spins(inner: Sequence[Number], outer: Sequence[Number], tan_beta: Number, g: Number) -> tuple[Number, Number]:
    """(w_si, w_so) of a ball beside each ring along the contact's normal, for rings that turn at 1 and at 0, times
    (u + v): both are then linear in tan beta."""
    wm, wR = ball_speeds(1 + 0 * g, 0 * g, inner, outer, tan_beta, g)
    cosine = 1 / root(1 + tan_beta**2)
    axial, radial = wR * cosine, -wR * tan_beta * cosine
    u = (outer[1] + tan_beta * outer[0]) / (1 + g * outer[1])
    v = (inner[1] + tan_beta * inner[0]) / (1 - g * inner[1])
    at_inner = axial * inner[0] + radial * inner[1] - (1 - wm) * inner[0]
    at_outer = axial * outer[0] + radial * outer[1] - (0 - wm) * outer[0]
    return at_inner * (u + v), at_outer * (u + v)


def least_dissipation(inner: Sequence[Number], outer: Sequence[Number], c_i: Number, c_o: Number, g: Number) -> Number:
    """tan(beta) at which the friction moments c w_s of both races are in balance."""

    def balance(tan_beta: Number) -> Number:
        at_inner, at_outer = spins(inner, outer, tan_beta, g)
        return c_i * at_inner + c_o * at_outer

    here, there = balance(0 * g), balance(1 + 0 * g)
    return here / (here - there)


def shares_by_weight(shares: str | None, weight: Number) -> tuple[Number, Number]:
    """(lambda_i, lambda_o) under minimum dissipation: between outer control, weight 0, and inner control, weight 1."""
    whole = moment_shares("inner", shares)[0]
    return whole * weight, 2 - whole * weight


def spin_weights(scene: Scene, Qi: Number, Qo: Number) -> tuple[Number, Number]:
    """c = Q a E of both contacts, ellipses at the free angle."""
    c = []
    for load, contact in ((Qi, inner_contact), (Qo, outer_contact)):
        hertz = contact(scene, scene.cos0)
        per_load = hertz.semi_major_axis(mp.mpf(1)) * hertz.second_kind
        c.append(
            0 * load
            if load <= 0
            else load ** (4 / mp.mpf(3) if isinstance(load, mp.mpf) else 4 / 3)
            * (per_load if isinstance(load, mp.mpf) else float(per_load))
        )
    return c[0], c[1]


def friction(scene: Scene, share: Number, Mg: Number, load: Number) -> Number:
    """T = lambda Mg/D, N, as far as the contact carries it."""
    T = share * Mg / scene.D
    if scene.mu is None or abs(T) <= scene.mu * load:
        return T
    return scene.mu * load if T > 0 else -scene.mu * load


def centrifugal_force(scene: Scene, wm: Number, R: Number) -> Number:
    """Fc = m R w_m^2, N."""
    return scene.mass * R * wm**2


def gyroscopic_moment(scene: Scene, wm: Number, wR: Number, tan_beta: Number) -> Number:
    """Mg = J w_R w_m sin(beta), N m, signed."""
    return scene.inertia * wR * wm * tan_beta / root(1 + tan_beta**2)


def moment_shares(control: str | None, shares: str | None) -> tuple[int, int]:
    """(lambda_i, lambda_o): how the races share the gyroscopic moment."""
    if control == "outer":
        return 0, 2
    return (1, 1) if shares == "harris" else (2, 0)


def hertz_load(stiffness: Number, approach: Number) -> Number:
    """Q = K max(delta, 0)^1.5, N."""
    return stiffness * approach * root(approach) if approach > 0 else 0 * approach


@dataclass(frozen=True)
class Ball:
    """Everything known of a ball: (sin, cos) of the angles, loads in N, speeds in rad/s, moment in N m."""

    inner: tuple[Number, Number]
    outer: tuple[Number, Number]
    Qi: Number
    Qo: Number
    wm: Number
    wR: Number
    tan_beta: Number
    Fc: Number
    Mg: Number
    share_i: Number
    share_o: Number
    Ti: Number  # friction that carries the moment
    To: Number


def ball_state(scene: Scene, ball: int, x: Sequence[Number], d: Sequence[Number]) -> Ball:
    """Angles, loads, speeds and inertia of a ball from its x = (X1, X2, delta_i, delta_o) and the ring's d."""
    X1, X2, delta_i, delta_o = x
    A1, A2 = groove_centre(scene, ball, d)
    own = scene.of_ball(ball)
    outer = X1 / (own.Lo + delta_o), X2 / (own.Lo + delta_o)
    inner = (A1 - X1) / (own.Li + delta_i), (A2 - X2) / (own.Li + delta_i)
    Ki, Ko = own.Ki, own.Ko
    if scene.actual_angle:
        Ki, Ko = inner_contact(own, inner[1]).stiffness, outer_contact(own, outer[1]).stiffness
    zero = 0 * X1
    wm = wR = tan_beta = Fc = Mg = zero
    control = scene.control[ball]
    Qi, Qo = hertz_load(Ki, delta_i), hertz_load(Ko, delta_o)
    R = scene.dm / 2 + (X2 - scene.Lo * scene.cos0 if scene.own_orbit else 0)
    g = own.D / (2 * R)
    share_i, share_o = moment_shares(control, scene.shares)
    if control is not None:
        rolled = rolling_line(inner, outer, delta_i, own.Li)
        if control == "minimum_dissipation":
            c_i, c_o = spin_weights(own, Qi, Qo)
            tan_beta = least_dissipation(rolled, outer, c_i, c_o, g)
            along_i, along_o = c_i * (1 + g * outer[1]), c_o * (1 - g * rolled[1])
            share_i, share_o = shares_by_weight(scene.shares, along_i / (along_i + along_o))
        else:
            tan_beta = attitude_tangent(control, rolled, outer, g)
        wm, wR = ball_speeds(scene.wi, scene.wo, rolled, outer, tan_beta, g)
    if scene.centrifugal:
        Fc = centrifugal_force(own, wm, R)
    if scene.gyroscopic:
        Mg = scene.gyroscopic * gyroscopic_moment(own, wm, wR, tan_beta)
    Ti, To = friction(own, share_i, Mg, Qi), friction(own, share_o, Mg, Qo)
    return Ball(inner, outer, Qi, Qo, wm, wR, tan_beta, Fc, Mg, share_i, share_o, Ti, To)


def ball_equations(scene: Scene, ball: int, x: Sequence[Number], d: Sequence[Number]) -> list[Number]:
    """The four equations of a ball, each zero at the solution: two lengths (m^2) and two force balances (N)."""
    X1, X2, delta_i, delta_o = x
    A1, A2 = groove_centre(scene, ball, d)
    b, own = ball_state(scene, ball, x, d), scene.of_ball(ball)
    (sin_i, cos_i), (sin_o, cos_o) = b.inner, b.outer
    Ti, To = b.Ti, b.To
    return [
        X1**2 + X2**2 - (own.Lo + delta_o) ** 2,
        (A1 - X1) ** 2 + (A2 - X2) ** 2 - (own.Li + delta_i) ** 2,
        b.Qi * sin_i - b.Qo * sin_o - Ti * cos_i + To * cos_o,  # (19.9)
        b.Qi * cos_i - b.Qo * cos_o + Ti * sin_i - To * sin_o + b.Fc,  # (19.10)
    ]


def ring_contribution(scene: Scene, ball: int, x: Sequence[Number], d: Sequence[Number]) -> list[Number]:
    """What one ball takes of the ring's load (Fx, Fy, Fz, My, Mz), in N and N m  (19.13)-(19.15).

    The normal force acts along the line through the groove's centre, at the radius Ri; the friction force acts at the
    groove's surface, ri = fi D from that centre, which adds lambda_i fi Mg to the moment.
    """
    b = ball_state(scene, ball, x, d)
    (sin_i, cos_i), (c, s) = b.inner, scene.psi[ball]
    Ti = b.Ti
    axial = b.Qi * sin_i - Ti * cos_i
    radial = b.Qi * cos_i + Ti * sin_i
    moment = axial * scene.Ri + scene.ri * Ti
    return [axial, radial * c, radial * s, moment * s, -moment * c]


# ------------------------------------------------------------------------------------------------ Newton's method


def scaled(scene: Scene, equations: Sequence[Number], force: Number) -> list[Number]:
    """A ball's four equations without dimension: lengths over D^2, forces over the given force."""
    return [equations[0] / scene.D**2, equations[1] / scene.D**2, equations[2] / force, equations[3] / force]


def greatest_force(scene: Scene, balls: dict[int, list[Number]], d: Sequence[Number]) -> Number:
    """The greatest of the applied loads, the contact loads and the inertia forces, N."""
    sizes = [abs(load) / (scene.Ri if c > 2 else 1) for c, load in enumerate(scene.loads) if load is not None]
    for ball, x in balls.items():
        b = ball_state(scene, ball, x, d)
        sizes += [b.Qi, b.Qo, b.Fc]
    return max(sizes)


def relative_residual(scene: Scene, balls: dict[int, list[Number]], d: Sequence[Number]) -> Number:
    """The worst of all equations, relative to the greatest force (lengths: to the ball's diameter squared)."""
    force = greatest_force(scene, balls, d)
    rows = [abs(r) for ball, x in balls.items() for r in scaled(scene, ball_equations(scene, ball, x, d), force)]
    total = ring_load(scene, balls, d)
    for c in scene.free:
        rows.append(abs(total[c] - scene.loads[c]) / (force * (scene.Ri if c > 2 else 1)))
    return max(rows)


def ring_load(scene: Scene, balls: dict[int, list[Number]], d: Sequence[Number]) -> list[Number]:
    """The load (Fx, Fy, Fz, My, Mz) that the balls take from the inner ring, N and N m."""
    shares = [ring_contribution(scene, ball, x, d) for ball, x in balls.items()]
    return [sum((share[c] for share in shares), 0 * d[0]) for c in range(5)]


def ball_jacobian(scene: Scene, ball: int, x: Sequence[Number], d: Sequence[Number]) -> Any:
    """9 x 9: derivatives of a ball's four equations and five ring loads by its four unknowns and the ring's five.

    Differenced with steps of half the working digits, so right to half the working digits.
    """
    tiny = mp.mpf(10) ** (-(mp.dps // 2))
    at = [*x, *d]

    def rows(point: Sequence[Number]) -> list[Number]:
        return ball_equations(scene, ball, point[:4], point[4:]) + ring_contribution(scene, ball, point[:4], point[4:])

    here = rows(at)
    jacobian = mp.matrix(9, 9)
    for column in range(9):
        step = tiny * (scene.D if column < 7 else 1)
        there = rows([value + step if i == column else value for i, value in enumerate(at)])
        for row in range(9):
            jacobian[row, column] = (there[row] - here[row]) / step
    return jacobian


def linearise(scene: Scene, balls: dict[int, list[Number]], d: Sequence[Number]) -> tuple[Any, Any, dict[int, Any]]:
    """Eliminate every ball from the linearised system.

    Returns the ring's tangent stiffness S (5 x 5, the Schur complement), the ring load p with the balls' own errors
    carried over (5), so that the ring's Newton step solves S dd = F - p, and for each ball the 4 x 6 matrix [R | E]
    of its answer dx = R dd + E.
    """
    stiffness, load, answers = mp.matrix(5, 5), mp.matrix(5, 1), {}
    for ball, x in balls.items():
        jacobian = ball_jacobian(scene, ball, x, d)
        own, coupling = jacobian[0:4, 0:4], jacobian[0:4, 4:9]
        error = mp.matrix(ball_equations(scene, ball, x, d))
        inverse = mp.inverse(own)
        response, correction = -(inverse * coupling), -(inverse * error)
        stiffness += jacobian[4:9, 4:9] + jacobian[4:9, 0:4] * response
        load += mp.matrix(ring_contribution(scene, ball, x, d)) + jacobian[4:9, 0:4] * correction
        answers[ball] = (response, correction)
    return stiffness, load, answers


def newton_step(
    scene: Scene, balls: dict[int, list[Number]], d: list[Number]
) -> tuple[dict[int, list[Number]], list[Number]]:
    """One Newton step on all 4Z + (free channels) unknowns at once."""
    stiffness, load, answers = linearise(scene, balls, d)
    free = scene.free
    change = mp.matrix(5, 1)
    if free:
        matrix = mp.matrix([[stiffness[r, c] for c in free] for r in free])
        wanted = mp.matrix([scene.loads[c] - load[c] for c in free])
        for c, value in zip(free, mp.lu_solve(matrix, wanted), strict=True):
            change[c] = value
    moved = {}
    for ball, x in balls.items():
        response, correction = answers[ball]
        dx = response * change + correction
        moved[ball] = [x[i] + dx[i] for i in range(4)]
    return moved, [d[c] + change[c] for c in range(5)]


# ------------------------------------------------------------------------------------------------ which race controls


def control_ratio(scene: Scene, ball: int, x: Sequence[Number], d: Sequence[Number]) -> Number:
    """Qo ao Eo cos(alpha_i - alpha_o)/(Qi ai Ei): by Jones's criterion the outer race controls if it exceeds 1."""
    b = ball_state(scene, ball, x, d)
    if b.Qi == 0:
        return mp.inf
    cosine_i, cosine_o = (b.inner[1], b.outer[1]) if scene.actual_angle else (scene.cos0, scene.cos0)
    own = scene.of_ball(ball)
    inner, outer = inner_contact(own, cosine_i), outer_contact(own, cosine_o)
    cosine = b.inner[0] * b.outer[0] + b.inner[1] * b.outer[1]
    return (b.Qo * outer.semi_major_axis(b.Qo) * outer.second_kind * cosine) / (
        b.Qi * inner.semi_major_axis(b.Qi) * inner.second_kind
    )


def jones_choices(scene: Scene, balls: dict[int, list[Number]], d: Sequence[Number]) -> tuple[str, ...]:
    """What Jones's criterion says of each ball at a solution."""
    return tuple("outer" if control_ratio(scene, j, balls[j], d) > 1 else "inner" for j in range(scene.ball_count))


# ------------------------------------------------------------------------------------------------ the solution


def solve(case: dict[str, Any], digits: int = 50) -> dict[str, Any]:
    """Solve a case (see `scenes`) and return its result, SI and radians, as strings of 25 significant digits.

    Besides displacement, load and balls the result holds the Hertz constants at the free angle, the ring's tangent
    stiffness d(load)/d(displacement) at constant speed over all five channels, loaded or held, and the residual.
    With `control` "per_ball" the case may give its choices as `ball_control`; otherwise they are sought, starting from
    outer control everywhere.  Either way Jones's criterion must confirm each of them.
    """
    with mp.workdps(digits + GUARD_DIGITS):
        scene = read_case(case)
        seek = case["control"] == "per_ball" and not case.get("ball_control")
        scene, balls, d = settle_control(scene) if seek else (scene, *solve_scene(scene))
        refuse_friction_without_contact(scene, balls, d)
        choices = jones_choices(scene, balls, d) if case["control"] == "per_ball" else None
        if choices is not None and choices != scene.control:
            raise ArithmeticError(f"{case['name']}: the choices {scene.control} are not Jones's {choices}")
        with mp.workdps(digits):
            rounded = {ball: [+value for value in x] for ball, x in balls.items()}
            residual = relative_residual(scene, rounded, [+value for value in d])
        if residual > mp.mpf(10) ** -(0.8 * digits):
            raise ArithmeticError(f"{case['name']}: residual {mp.nstr(residual, 3)}")
        return result_of(scene, balls, d, residual, jones=choices is not None)


def refuse_friction_without_contact(scene: Scene, balls: dict[int, list[Number]], d: Sequence[Number]) -> None:
    """The equations let an unloaded contact carry its share of the gyroscopic moment; mechanics does not."""
    if scene.mu is not None:
        return
    for ball, x in balls.items():
        b = ball_state(scene, ball, x, d)
        tiny = mp.mpf(10) ** -(mp.dps // 2) * scene.D * greatest_force(scene, balls, d)
        if (b.Qi == 0 and abs(b.share_i * b.Mg) > tiny) or (b.Qo == 0 and abs(b.share_o * b.Mg) > tiny):
            raise ArithmeticError(f"ball {ball} has friction at a contact that carries nothing")


def solve_scene(scene: Scene) -> tuple[dict[int, list[Number]], list[Number]]:
    """Balls (those that have a defined position) and ring displacement, to the working precision."""
    from .double_start import find_start  # here, as that module uses this one's equations

    positions, start = find_start(scene.in_floats())
    d = [mp.mpf(value) if scene.held[c] is None else scene.held[c] for c, value in enumerate(start)]
    balls = {}
    for ball, (X1, X2) in positions.items():
        A1, A2 = groove_centre(scene, ball, d)
        X1, X2 = mp.mpf(X1), mp.mpf(X2)
        own = scene.of_ball(ball)
        balls[ball] = [X1, X2, mp.hypot(A1 - X1, A2 - X2) - own.Li, mp.hypot(X1, X2) - own.Lo]
    for _ in range(20):
        balls, d = newton_step(scene, balls, d)
        if relative_residual(scene, balls, d) < mp.mpf(10) ** -(mp.dps - 12):
            return balls, d
    raise ArithmeticError("Newton's method did not reach the working precision")


def settle_control(scene: Scene) -> tuple[Scene, dict[int, list[Number]], list[Number]]:
    """Solve, ask Jones's criterion of every ball, and solve again until its answers are those assumed."""
    for _ in range(2 * scene.ball_count):
        balls, d = solve_scene(scene)
        choices = jones_choices(scene, balls, d)
        if choices == scene.control:
            return scene, balls, d
        scene = replace(scene, control=choices)
    raise ArithmeticError("no choice of raceway control that Jones's criterion confirms was found")


def text(value: Number, size: Number = 1) -> str:
    """25 significant digits; what is zero by symmetry but for rounding beside `size` is written as zero."""
    if mp.isinf(value):
        return "inf"
    return "0.0" if abs(value) < mp.mpf(10) ** -36 * size else mp.nstr(value, PRINTED_DIGITS, strip_zeros=False)


def result_of(
    scene: Scene, balls: dict[int, list[Number]], d: Sequence[Number], residual: Number, jones: bool
) -> dict[str, Any]:
    """The result in strings.  A ball that touches neither ring at rest has no angles, approaches or position."""
    return {
        "displacement": [text(value) for value in d],
        "load": [text(value) for value in ring_load(scene, balls, d)],
        "balls": [ball_result(scene, j, balls.get(j), d, jones) for j in range(scene.ball_count)],
        "inner_stiffness": text(scene.Ki),
        "outer_stiffness": text(scene.Ko),
        "stiffness": stiffness_text(linearise(scene, balls, d)[0]),
        "residual": mp.nstr(residual, 3),
    }


def stiffness_text(S: Any) -> list[list[str]]:
    """The 5 x 5 stiffness; its derivatives are right to some 38 digits, so the size of a zero is judged generously."""
    return [[text(S[r, c], 10**8 * mp.sqrt(abs(S[r, r] * S[c, c]))) for c in range(5)] for r in range(5)]


def ball_result(scene: Scene, ball: int, x: list[Number] | None, d: Sequence[Number], jones: bool) -> dict[str, Any]:
    """One ball's part of the result; speeds are null if no raceway control is given."""
    azimuth = text(2 * mp.pi * ball / scene.ball_count)
    if x is None:
        contact = {"load": "0.0", "angle": None, "approach": None, "semi_major_axis": None, "semi_minor_axis": None,
                   "max_pressure": None, "required_friction": None}  # fmt: skip
        return {"azimuth": azimuth, "inner": contact, "outer": dict(contact), "centrifugal_force": "0.0",
                "gyroscopic_moment": "0.0", "orbital_speed": None, "rotation_speed": None, "position": None,
                "control": scene.control[ball], "control_ratio": None}  # fmt: skip
    b, own = ball_state(scene, ball, x, d), scene.of_ball(ball)
    kinematic = scene.control[ball] is not None
    inner = inner_contact(own, b.inner[1] if scene.actual_angle else scene.cos0)
    outer = outer_contact(own, b.outer[1] if scene.actual_angle else scene.cos0)
    return {
        "azimuth": azimuth,
        "inner": contact_result(own, inner, b.Qi, b.inner, x[2], b.share_i * b.Mg),
        "outer": contact_result(own, outer, b.Qo, b.outer, x[3], b.share_o * b.Mg),
        "centrifugal_force": text(b.Fc),
        "gyroscopic_moment": text(b.Mg),
        "orbital_speed": text(b.wm) if kinematic else None,
        "rotation_speed": text(b.wR) if kinematic else None,
        "position": [text(x[0]), text(x[1])],
        "control": scene.control[ball],
        "control_ratio": text(control_ratio(scene, ball, x, d)) if jones else None,
    }


def contact_result(
    scene: Scene, hertz: HertzContact, load: Number, angle: Sequence[Number], approach: Number, moment: Number
) -> dict[str, Any]:
    """One contact: load, angle, approach, ellipse, pressure and the friction lambda |Mg|/(D Q) that it must supply."""
    return {
        "load": text(load),
        "angle": text(mp.atan2(angle[0], angle[1])),
        "approach": text(approach),
        "semi_major_axis": text(hertz.semi_major_axis(load)),
        "semi_minor_axis": text(hertz.semi_minor_axis(load)),
        "max_pressure": text(hertz.max_pressure(load)),
        "required_friction": text(abs(moment) / (scene.D * load)) if load > 0 else None,
    }
