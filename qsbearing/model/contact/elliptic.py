"""Complete elliptic integrals by one algorithm that never subtracts.

Bulirsch's general complete integral (R. Bulirsch, Numerische Mathematik 13, 1969, 305-315), here with p = 1,

    cel(kc; a, b) = int_0^{pi/2} (a cos^2 t + b sin^2 t) / sqrt(cos^2 t + kc^2 sin^2 t) dt = a B + b D,

holds all the integrals that point contact needs, each to full precision from the circle (kc = 1) to the
most slender ellipse, since for a, b >= 0 all its terms are positive:

    B = cel(1, 0)    D = cel(0, 1) = (K - E)/m,    m = 1 - kc^2,    K = B + D    E = B + kc^2 D.
"""

from __future__ import annotations

from math import pi, sqrt

from qsbearing.model.compiler.compiled import formula, kernel

# The arithmetic-geometric mean doubles its digits at each step: when the two means agree to this, the next
# step, which the closing formula takes, agrees to its square, below rounding.
_MEANS_AGREE = 1e-8


@kernel
def both_parts(kc: float) -> tuple[float, float]:
    """(B, D) for complementary modulus 0 < kc <= 1: Bulirsch's cel with p = 1, of (1, 0) and (0, 1) at once."""
    geometric, arithmetic, product, weight = kc, 1.0, kc, 1.0
    a, b, c, d = 1.0, 0.0, 0.0, 1.0
    while True:
        inverse = 1.0 / weight
        ratio = product * inverse
        a, b = a + b * inverse, 2.0 * (b + a * ratio)
        c, d = c + d * inverse, 2.0 * (d + c * ratio)
        weight += ratio
        mean_before = arithmetic
        arithmetic += geometric
        if not abs(mean_before - geometric) > _MEANS_AGREE * mean_before:  # so put, it also ends what is not a number
            factor = 0.5 * pi / (arithmetic * (arithmetic + weight))
            return factor * (b + a * arithmetic), factor * (d + c * arithmetic)
        geometric = 2.0 * sqrt(product)
        product = geometric * arithmetic


@formula
def second_kind(kc: float) -> float:
    """E, the complete elliptic integral of the second kind, by its complementary modulus kc."""
    B, D = both_parts(kc)
    return B + kc * kc * D
