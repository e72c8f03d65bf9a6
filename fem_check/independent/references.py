"""Reference values by a derivation of their own: nothing here comes from `qsbearing`.

Hertz's ellipse stands here in Carlson's symmetric integrals (B. C. Carlson, Numerische Mathematik 33, 1979), which
need no modulus and lose no digit near the circle. With 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2 and the pressure
p0 sqrt(1 - x^2/a^2 - y^2/b^2), the displacement of both half-spaces together is (K. L. Johnson, Contact Mechanics,
1985, eqs 3.60 to 3.62, substituted w for the variable under the integrals)

    u = 3Q/(4 pi E*) int_0^oo (1 - x^2/(a^2+w) - y^2/(b^2+w)) dw / sqrt((a^2+w)(b^2+w)w)
      = 3Q/(2 pi E*) [ RF(0,a^2,b^2) - x^2/3 RD(0,b^2,a^2) - y^2/3 RD(0,a^2,b^2) ],

to be equal to delta - (curvature_x x^2 + curvature_y y^2)/2 all over the ellipse.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from math import exp, log, pi

import numpy as np
from scipy.optimize import brentq, minimize_scalar
from scipy.special import elliprd, elliprf, eval_legendre

from fem_check.independent.contact_problem import Array, ContactProblem, ContactQuantities, ElasticConstants

HERTZ_SOURCE = "Hertz 1881; Johnson 1985, section 4.2, in Carlson's integrals RF and RD"
SHEAR_SOURCE = "Boussinesq's point load (Johnson 1985, eqs 3.19) integrated over Hertz's pressure"


@lru_cache(maxsize=256)
def axis_ratio(curvature_ratio: float) -> float:
    """b/a of Hertz's ellipse for curvature_x/curvature_y in (0, 1]."""
    if curvature_ratio == 1.0:
        return 1.0

    def misfit(log_ratio: float) -> float:
        b = exp(log_ratio)
        return float(np.log(elliprd(0.0, b * b, 1.0) / elliprd(0.0, 1.0, b * b) / curvature_ratio))

    # b/a falls like curvature_ratio^(2/3) or slower: three times the logarithm brackets every case.
    return exp(brentq(misfit, 3.0 * float(np.log(curvature_ratio)) - 1e-6, 0.0, xtol=1e-15, rtol=1e-15))


def hertz(problem: ContactProblem) -> ContactQuantities:
    """Hertz's contact of the problem's parabolic gap, with the largest shear stress below its centre."""
    contact = ellipse(problem)
    shear, depth = largest_shear(contact.semi_major_axis / contact.semi_minor_axis, problem.race.poisson_ratio)
    return replace(
        contact, max_shear_stress=shear * contact.max_pressure, max_shear_depth=depth * contact.semi_minor_axis
    )


def ellipse(problem: ContactProblem, form: str = "exact") -> ContactQuantities:
    """Hertz's contact without the stress below it; exact, or with the ellipse of one of two published fits.

    The fits, in the ratio of the curvatures: D. E. Brewe & B. J. Hamrock, J. Lubr. Tech. 99, 1977; B. J. Hamrock & D.
    Brewe, J. Lubr. Tech. 105, 1983. With them k and both elliptic integrals stand in B. J. Hamrock & D. Dowson's forms.
    """
    compliance = problem.ball.compliance + problem.race.compliance
    scale = problem.load * compliance / pi
    x, y = problem.curvature_x, problem.curvature_y
    if form == "exact":
        ratio = axis_ratio(x / y)
        # x^2 terms: curvature_x/2 = 3Q/(2 pi E*) RD(0, b^2, a^2)/3, and RD has the dimension a^-3.
        a = (scale * float(elliprd(0.0, ratio**2, 1.0)) / x) ** (1.0 / 3.0)
        delta = 1.5 * scale * float(elliprf(0.0, (a * ratio) ** 2, a * a))
    else:
        ratio = 1.0 / _FITS[form][0](y / x)
        second, first = second_kind(x / y, form), _FITS[form][1](y / x)
        a = (3.0 * scale * second / (ratio**2 * (x + y))) ** (1.0 / 3.0)
        # delta = K (9 (x+y)/(2 E) (Q/(pi k E'))^2)^(1/3), E' = 2/compliance.
        delta = first * (4.5 * (x + y) / second * (0.5 * scale * ratio) ** 2) ** (1.0 / 3.0)
    b = a * ratio
    return ContactQuantities(delta, a, b, 1.5 * problem.load / (pi * a * b))


_FITS: dict[str, tuple[Callable[[float], float], ...]] = {
    "brewe_hamrock_1977": (
        lambda r: 1.0339 * r**0.636,
        lambda r: 1.5277 + 0.6023 * log(r),
        lambda r: 1.0003 + 0.5968 / r,
    ),
    "hamrock_brewe_1983": (
        lambda r: r ** (2.0 / pi),
        lambda r: 0.5 * pi + (0.5 * pi - 1.0) * log(r),
        lambda r: 1.0 + (0.5 * pi - 1.0) / r,
    ),
}
"""k, the elliptic integrals of the first and of the second kind, of curvature_y/curvature_x >= 1."""


def curvature_of_length(problem: ContactProblem, ratio: float) -> float:
    """By how much the curvature across the groove must be larger for a semi-major axis of `ratio` times its size [1/m].

    Args:
        problem: the contact.
        ratio: near 1.
    """
    usual = ellipse(problem).semi_major_axis

    def misfit(change: float) -> float:
        return (
            ellipse(replace(problem, curvature_x=(1.0 + change) * problem.curvature_x)).semi_major_axis / usual - ratio
        )

    return float(brentq(misfit, -0.5, 1.0, xtol=1e-10)) * problem.curvature_x


def second_kind(curvature_ratio: float, form: str = "exact") -> float:
    """Complete elliptic integral of the second kind of Hertz's ellipse, for curvature_x/curvature_y in (0, 1]."""
    if form != "exact":
        return _FITS[form][2](1.0 / curvature_ratio)
    square = axis_ratio(curvature_ratio) ** 2
    return float(elliprf(0.0, square, 1.0) - (1.0 - square) / 3.0 * elliprd(0.0, square, 1.0))


@lru_cache(maxsize=256)
def largest_shear(ellipticity: float, poisson_ratio: float) -> tuple[float, float]:
    """Largest shear stress on the axis over p0, and its depth over b.

    The stresses of a point load on a half-space, summed over the ellipse in its own polar coordinates: Gauss
    points in the radius (with p = p0 cos c, r = sin c both smooth), equal steps round the angle, where the sum over
    a smooth period converges faster than any power.
    """
    nodes, weights = np.polynomial.legendre.leggauss(96)
    c, c_weight = 0.25 * pi * (nodes + 1.0), 0.25 * pi * weights
    # The integrand's nearest pole in the angle lies about 1/k off the real axis: the count grows with k.
    count = int(200 + 60 * ellipticity)
    angle = (np.arange(count) + 0.5) * 0.5 * pi / count
    x = ellipticity * np.sin(c)[:, None] * np.cos(angle)
    y = np.sin(c)[:, None] * np.sin(angle)
    force = (np.cos(c) ** 2 * np.sin(c) * c_weight)[:, None] * ellipticity * 4.0 * 0.5 * pi / count
    r2 = x * x + y * y
    cos2 = x * x / r2

    def shear(z: float) -> float:
        rho = np.sqrt(r2 + z * z)
        near = (1.0 - 2.0 * poisson_ratio) / (rho * (rho + z))
        radial = near - 3.0 * r2 * z / rho**5
        hoop = (1.0 - 2.0 * poisson_ratio) * z / rho**3 - near
        stress_z = float(np.sum(force * -3.0 * z**3 / rho**5)) / (2.0 * pi)
        stress_x = float(np.sum(force * (radial * cos2 + hoop * (1.0 - cos2)))) / (2.0 * pi)
        stress_y = float(np.sum(force * (radial * (1.0 - cos2) + hoop * cos2))) / (2.0 * pi)
        principal = (stress_x, stress_y, stress_z)
        return 0.5 * (max(principal) - min(principal))

    minimum = minimize_scalar(lambda z: -shear(z), bounds=(0.2, 1.2), method="bounded", options={"xatol": 1e-8})
    return -float(minimum.fun), float(minimum.x)


def curvature_ratio(ratio: float) -> float:
    """curvature_x/curvature_y that gives an ellipse of the given b/a: the inverse of `axis_ratio`."""
    return float(elliprd(0.0, ratio * ratio, 1.0) / elliprd(0.0, 1.0, ratio * ratio))


def pressed_sphere(cosines: Array, forces: Array, radius: float, material: ElasticConstants) -> float:
    """Outward displacement [m] of a point on a sphere under radial forces, each with its mirror image at the antipode.

    A. I. Lur'e, Three-Dimensional Problems of the Theory of Elasticity, 1964, section 6.4: the normal traction P_n goes
    with the displacement A(n+1)(n-2+4nu) + Bn, where A(n^2+2n-1+2nu) + B(n-1) = 0 leaves no shear. Odd terms cancel.
    Forces spread over a patch, of which each part is a tenth or less, and a point a right angle or so away from it.

    Args:
        cosines: of the angle between the point and each force, shape (force,).
        forces: towards the centre [N], shape (force,).
        radius: [m].
        material: of the sphere.
    """
    nu = material.poisson_ratio
    # Of a patch the terms fade once a wave is shorter than it; soon after, the single forces would begin to show.
    spread = np.sqrt(forces @ (cosines - forces @ cosines / forces.sum()) ** 2 / forces.sum())
    n = np.arange(2.0, 8.0 / spread, 2.0)
    b = -(n * n + 2.0 * n - 1.0 + 2.0 * nu) / (n - 1.0)
    traction = (n + 1.0) * (n * n - n - 2.0 - 2.0 * nu) + b * n * (n - 1.0)
    displacement = np.concatenate(
        [[(2.0 - 4.0 * nu) / (2.0 + 2.0 * nu)], ((n + 1.0) * (n - 2.0 + 4.0 * nu) + b * n) / traction]
    )
    n = np.concatenate([[0.0], n])
    parts = eval_legendre(n[:, None], cosines) @ forces
    # The terms alternate, a right angle away from the forces: a sum that ends at one of them keeps half of it, up to
    # 0.3 % either way as the patch's edge has it. Means of neighbouring sums, over and over, leave 0.005 % (Euler's
    # transformation of alternating series).
    sums = np.cumsum(2.0 * (2.0 * n + 1.0) * displacement * parts)[len(n) // 2 :]
    while len(sums) > 1:
        sums = 0.5 * (sums[1:] + sums[:-1])
    twice_shear_modulus = material.elastic_modulus / (1.0 + nu)
    return -float(sums[0]) / (4.0 * pi * radius * twice_shear_modulus)
