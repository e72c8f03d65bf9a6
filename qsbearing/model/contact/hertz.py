"""Hertz's contact of two smooth elastic bodies at a point: ellipse, approach, pressure, stiffness; where
it first yields, below the surface, and where it is dented for good.

Sources: H. Hertz 1881; K. L. Johnson, Contact Mechanics, 1985, section 4.2; Hamrock & Dowson, NASA TM-81691, 1981.
Numbers (19.x) are those of Wang, Yan, Zhang & Hong. Its (19.18) holds only with the meanings used here: K and E are
the complete elliptic integrals of the first and the second kind (printed there as one symbol), and the effective
modulus is E' = 2/[(1-nu1^2)/E1 + (1-nu2^2)/E2].

The gap between the undeformed surfaces is x^2/(2 Rx) + y^2/(2 Ry). The ellipse is long where the gap opens slowly:
with lambda = (smaller curvature)/(larger curvature) and kc = b/a,

    lambda = kc^2 D(kc)/B(kc)        (all integrals positive: exact from the circle to the slenderest ellipse)

which is the classical ((k^2+1)E - 2K)/((k^2-1)E) = F(rho) with its differences of near-equal numbers taken out.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from math import exp, log, pi, sqrt

from qsbearing.model.compiler.compiled import entry, formula, kernel
from qsbearing.model.contact.elliptic import both_parts

# The two raceways in the formulas that differ by a sign. Floats: for each integer constant handed to a compiled
# function the compiler would make another copy of it.
INNER_SIDE, OUTER_SIDE = -1.0, 1.0


class HertzForm(StrEnum):
    """How the shape of the ellipse is found from the curvatures."""

    EXACT = "exact"
    """The transcendental equation, solved to full precision."""
    BREWE_HAMROCK_1977 = "brewe_hamrock_1977"
    """Fit by Brewe & Hamrock (J. Lubrication Technology 99, 1977): about 0.7 % in approach for B218, up to 5.4 % near
    the circle."""
    HAMROCK_BREWE_1983 = "hamrock_brewe_1983"
    """Fit by Hamrock & Brewe (J. Lubrication Technology 105, 1983): about 0.3 % in approach for B218, up to 3 %
    between the circle and k = 15; exact at the circle."""


FORM_CODES = {form: code for code, form in enumerate(HertzForm)}
_EXACT, _BREWE_HAMROCK_1977 = 0, 1


@kernel
def _log_ratio_and_slope(kc: float, B: float, D: float) -> tuple[float, float]:
    """ln(lambda) as a function of kc = b/a and its two integrals, and its derivative by ln(kc)."""
    m = 1.0 - kc * kc
    # C = (D - B)/m = int sin^2 cos^2/Delta^3 loses digits near the circle, where its limit serves; it steers Newton
    # only and leaves the answer's precision alone.
    C = (D - B) / m if m > 1e-6 else pi / 16.0
    slope_D = -(B - kc * kc * C)  # dD/d ln(kc)
    slope_B = -kc * kc * C  # dB/d ln(kc)
    return log(kc * kc * D / B), 2.0 + slope_D / D - slope_B / B


@kernel
def exact_axis_ratio(curvature_ratio: float) -> float:
    """kc = b/a of the exact ellipse for lambda = smaller/larger gap curvature, 0 < lambda <= 1."""
    if curvature_ratio >= 1.0:
        return 1.0
    target = log(curvature_ratio)
    # The start: exponents from 2/3 at the circle, fitted here; within 1e-4 to k = 37, 7 % to k = 8000.
    above, below = target * (0.01641191 * target - 0.06459561), target * (0.03017285 * target - 0.09627403)
    x = target * (2.0 / 3.0 + above) / (1.0 + below)
    for _ in range(12):
        kc = min(exp(x), 1.0)
        B, D = both_parts(kc)
        value, slope = _log_ratio_and_slope(kc, B, D)
        step = (target - value) / slope
        x = min(x + step, 0.0)
        if abs(step) < 1e-8:  # quadratic: the next error is below rounding
            break
    return exp(x)


@formula
def contact_shape(form: int, curvature_ratio: float) -> tuple[float, float, float, float]:
    """Shape of the ellipse from lambda = smaller/larger curvature: (k = a/b, K, E, d ln(k^2 E/K^3)^(1/2)/d ln lambda).

    The last is the logarithmic slope of the part of the contact stiffness that depends on the shape.
    """
    if form == _EXACT:
        kc = exact_axis_ratio(curvature_ratio)
        B, D = both_parts(kc)
        K, E = B + D, B + kc * kc * D
        _, by_log_kc = _log_ratio_and_slope(kc, B, D)
        slope = (0.5 * kc * kc * D / E + 1.5 * B / K - 1.0) / by_log_kc
        return 1.0 / kc, K, E, slope
    ratio = 1.0 / curvature_ratio
    if form == _BREWE_HAMROCK_1977:
        K = 1.5277 + 0.6023 * log(ratio)
        E = 1.0003 + 0.5968 * curvature_ratio
        return 1.0339 * ratio**0.636, K, E, -0.636 + 0.5 * 0.5968 * curvature_ratio / E + 1.5 * 0.6023 / K
    q = 0.5 * pi - 1.0  # Hamrock & Brewe 1983
    K = 0.5 * pi + q * log(ratio)
    E = 1.0 + q * curvature_ratio
    return ratio ** (2.0 / pi), K, E, -2.0 / pi + 0.5 * q * curvature_ratio / E + 1.5 * q / K


@kernel
def stiffness_constant(k: float, K: float, E: float, curvature_sum: float, effective_modulus: float) -> float:
    """Q/approach^1.5 (19.18): pi k E' sqrt(E/(4.5 sum_rho K^3)) [N/m^1.5]."""
    return pi * k * effective_modulus * sqrt(E / (4.5 * curvature_sum * (K * K * K)))


@kernel
def ellipse_constants(
    form: int, curvature_x: float, curvature_y: float, effective_modulus: float
) -> tuple[float, float, float, float]:
    """(a/Q^(1/3), b/Q^(1/3), Q/approach^1.5, E): a = (6 k^2 E Q/(pi sum_rho E'))^(1/3), b = a/k."""
    k, K, E, _ = contact_shape(form, min(curvature_x, curvature_y) / max(curvature_x, curvature_y))
    curvature_sum = curvature_x + curvature_y
    a = (6.0 * k * k * E / (pi * curvature_sum * effective_modulus)) ** (1.0 / 3.0)
    return a, a / k, stiffness_constant(k, K, E, curvature_sum, effective_modulus), E


@kernel
def rolling_curvature(ball_diameter: float, pitch_diameter: float, cos_angle: float, side: float) -> float:
    """1/Rx of ball and raceway in the rolling direction [1/m]; side: INNER_SIDE or OUTER_SIDE.

    Rx = D/2 (1 -/+ gamma cos(alpha)), gamma = D/dm: the raceway's own radius is its distance to the bearing axis
    along the contact line, convex inside, concave outside.
    """
    return 2.0 / (ball_diameter * (1.0 + side * ball_diameter / pitch_diameter * cos_angle))


@kernel
def transverse_curvature(ball_diameter: float, groove_radius_coefficient: float) -> float:
    """1/Ry of ball and groove across the groove [1/m]: Ry = f D/(2f - 1)."""
    return (2.0 * groove_radius_coefficient - 1.0) / (groove_radius_coefficient * ball_diameter)


@formula
def stiffness_at_angle(
    form: int,
    ball_diameter: float,
    pitch_diameter: float,
    groove_radius_coefficient: float,
    effective_modulus: float,
    sin_angle: float,
    cos_angle: float,
    side: float,
) -> tuple[float, float]:
    """Contact stiffness of a raceway at a contact angle, and the derivative of its logarithm by that angle."""
    rho_x = rolling_curvature(ball_diameter, pitch_diameter, cos_angle, side)
    rho_y = transverse_curvature(ball_diameter, groove_radius_coefficient)
    ratio = min(rho_x, rho_y) / max(rho_x, rho_y)
    k, K, E, shape_slope = contact_shape(form, ratio)
    stiffness = stiffness_constant(k, K, E, rho_x + rho_y, effective_modulus)
    # Only rho_x turns with the angle: d ln(rho_x)/d alpha = side gamma sin(alpha)/(1 + side gamma cos(alpha)).
    gamma = ball_diameter / pitch_diameter
    log_slope_x = side * gamma * sin_angle / (1.0 + side * gamma * cos_angle)
    ratio_sign = -1.0 if rho_x >= rho_y else 1.0
    return stiffness, log_slope_x * (ratio_sign * shape_slope - 0.5 * rho_x / (rho_x + rho_y))


@entry(int, float, float, float)
def _ellipse(form: int, curvature_x: float, curvature_y: float, effective_modulus: float) -> tuple[float, ...]:
    return ellipse_constants(form, curvature_x, curvature_y, effective_modulus)


@dataclass(frozen=True)
class PointContact:
    """One Hertzian contact under load; SI units."""

    load: float
    """Normal load Q [N]."""
    semi_major_axis: float
    """a [m]."""
    semi_minor_axis: float
    """b [m]."""
    approach: float
    """Approach delta of points far inside both bodies [m]."""
    max_pressure: float
    """p0 at the centre of the ellipse [Pa]."""
    stiffness_constant: float
    """Q/approach^1.5 [N/m^1.5]."""

    @property
    def ellipticity(self) -> float:
        """k = a/b [-]."""
        return self.semi_major_axis / self.semi_minor_axis


def effective_modulus(
    elastic_modulus_1: float, poisson_ratio_1: float, elastic_modulus_2: float, poisson_ratio_2: float
) -> float:
    """E' = 2/[(1-nu1^2)/E1 + (1-nu2^2)/E2] [Pa] (Hamrock & Dowson, eq. 3): E/(1-nu^2) for equal materials."""
    return 2.0 / ((1.0 - poisson_ratio_1**2) / elastic_modulus_1 + (1.0 - poisson_ratio_2**2) / elastic_modulus_2)


def point_contact(
    load: float,
    curvature_x: float,
    curvature_y: float,
    effective_modulus: float,
    form: HertzForm = HertzForm.EXACT,
) -> PointContact:
    """The contact of two bodies whose gap is curvature_x x^2/2 + curvature_y y^2/2.

    Args:
        load: normal load Q > 0 [N].
        curvature_x, curvature_y: sums of both bodies' curvatures in the two principal planes, both > 0 [1/m].
        effective_modulus: E' [Pa], see `effective_modulus`.
        form: exact, or one of the two published fits.

    Returns:
        The ellipse, its largest pressure, and the approach of the bodies.

    Raises:
        ValueError: load, a curvature or the modulus is not positive and finite.

    Range: half-spaces, so an ellipse small beside the bodies; elastic; frictionless.

    Examples:
        >>> contact = qs.point_contact(1e3, 5.0, 150.0, 114e9)
        >>> print(f"{contact.max_pressure / qs.MPa:.0f} MPa, {contact.approach / qs.um:.2f} µm")
        1003 MPa, 14.58 µm
    """
    for name, value in (
        ("load", load),
        ("curvature_x", curvature_x),
        ("curvature_y", curvature_y),
        ("effective_modulus", effective_modulus),
    ):
        if not 0.0 < value < float("inf"):
            raise ValueError(f"{name} = {value}: must be positive and finite for two bodies to touch at a point")
    a, b, stiffness, _ = _ellipse(FORM_CODES[HertzForm(form)], curvature_x, curvature_y, effective_modulus)
    a, b = a * load ** (1.0 / 3.0), b * load ** (1.0 / 3.0)
    return PointContact(load, a, b, (load / stiffness) ** (2.0 / 3.0), 1.5 * load / (pi * a * b), stiffness)


@dataclass(frozen=True)
class SubsurfaceShear:
    """The largest shear stress below a contact, on the axis through its centre."""

    stress: float
    """Largest shear stress over the contact's maximum pressure [-]."""
    depth: float
    """Its depth over the semi-minor axis [-]."""


def subsurface_shear(ellipticity: float, poisson_ratio: float = 0.3) -> SubsurfaceShear:
    """Largest shear stress under the centre of the ellipse and its depth, by Boussinesq's potentials.

    Stresses on the axis follow from the potential psi of the ellipsoidal pressure and its integral chi (Johnson,
    eqs 2.25 and 3.36), j = x along a, y along b, here with a = k, b = 1, p0 = 1:

        sigma_z = psi_z - z psi_zz = -a b/(A B),     A = sqrt(a^2 + z^2),  B = sqrt(b^2 + z^2)
        sigma_j = 2 nu psi_z - z psi_jj - (1 - 2 nu) chi_jj
        psi_xx = -a b/3 R_D(z^2, B^2, A^2),     chi_xx = z psi_xx + a b/(A (A + B))

    and with A and B exchanged for y; R_D is Carlson's symmetric elliptic integral (DLMF 19.16.5).

    Args:
        ellipticity: k = a/b >= 1.
        poisson_ratio: of the body looked into.

    Returns:
        The largest shear stresses over the largest pressure, and their depths over b.

    Raises:
        ValueError: ellipticity below 1, or Poisson's ratio outside [0, 0.5].

    Examples:
        >>> shear = qs.subsurface_shear(8.0)
        >>> print(f"{shear.stress:.3f} of the pressure, {shear.depth:.3f} b deep")
        0.317 of the pressure, 0.764 b deep
    """
    from scipy.optimize import minimize_scalar
    from scipy.special import elliprd

    if not 1.0 <= ellipticity < float("inf"):
        raise ValueError(f"ellipticity = {ellipticity}: k = a/b is at least 1")
    if not 0.0 <= poisson_ratio <= 0.5:
        raise ValueError(f"poisson_ratio = {poisson_ratio}: between 0 and 0.5")

    def shear(z: float) -> float:
        a, b = sqrt(ellipticity**2 + z * z), sqrt(1.0 + z * z)  # A and B
        psi = [-ellipticity / 3.0 * elliprd(z * z, q * q, p * p) for p, q in ((a, b), (b, a))]  # psi_xx, psi_yy
        sigma_z = -ellipticity / (a * b)
        psi_z = sigma_z - z * sum(psi)  # psi is harmonic
        stresses = [sigma_z]
        for p, psi_jj in zip((a, b), psi, strict=True):
            chi_jj = z * psi_jj + ellipticity / (p * (a + b))
            stresses.append(2.0 * poisson_ratio * psi_z - z * psi_jj - (1.0 - 2.0 * poisson_ratio) * chi_jj)
        return 0.5 * (max(stresses) - min(stresses))

    minimum = minimize_scalar(lambda z: -shear(z), bounds=(0.2, 1.2), method="bounded", options={"xatol": 1e-7})
    return SubsurfaceShear(stress=-float(minimum.fun), depth=float(minimum.x))


FIRST_YIELD_SHEAR = 0.31
"""Largest shear stress below a contact over its maximum pressure: 0.30 of a line contact, 0.31 of a circle, up to 0.325
between (`hertz.subsurface_shear`, Poisson's ratio 0.3)."""

STATIC_PRESSURE = 4200e6
"""Permissible contact pressure of ball bearings at rest [Pa]: a permanent dent of about 1e-4 D (ISO 76)."""


def first_yield_pressure(yield_strength: float) -> float:
    """Maximum pressure at which steel first yields, below the surface [Pa]: 2 * 0.31 p0 = sigma_y.

    Tresca's criterion for the largest shear under the centre (Johnson, Contact Mechanics, chapter 6), within 5 % for
    every ellipse. `STATIC_PRESSURE` lies higher: there a permanent dent has grown to a size that is felt.

    Args:
        yield_strength: in simple tension [Pa].
    """
    return yield_strength / (2.0 * FIRST_YIELD_SHEAR)
