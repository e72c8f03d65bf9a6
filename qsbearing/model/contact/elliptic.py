"""Complete elliptic integrals by one algorithm that never subtracts.

Bulirsch's general complete integral (R. Bulirsch, Numerische Mathematik 13, 1969, 305-315), here with p = 1,

    cel(kc; a, b) = int_0^{pi/2} (a cos^2 t + b sin^2 t) / sqrt(cos^2 t + kc^2 sin^2 t) dt,

holds all the integrals that point contact needs, each to full precision from the circle (kc = 1) to the
most slender ellipse, since for a, b >= 0 all its terms are positive:

    K = cel(1, 1)    E = cel(1, kc^2)    B = cel(1, 0)    D = cel(0, 1) = (K - E)/m,    m = 1 - kc^2.
"""

from __future__ import annotations

from math import pi, sqrt

from qsbearing.model.compiler.compiled import formula, kernel

# The arithmetic-geometric mean doubles its digits at each step: when the two means agree to this, the next
# step, which the closing formula takes, agrees to its square, below rounding.
_MEANS_AGREE = 1e-8


@kernel
def complete_integral(kc: float, a: float, b: float) -> float:
    """Bulirsch's cel with p = 1 for complementary modulus 0 < kc <= 1."""
    geometric = kc
    arithmetic = 1.0
    product = kc
    weight = 1.0
    while True:
        a_before = a
        a += b / weight
        b = 2.0 * (b + a_before * product / weight)
        weight += product / weight
        mean_before = arithmetic
        arithmetic += geometric
        if not abs(mean_before - geometric) > _MEANS_AGREE * mean_before:  # so put, it also ends what is not a number
            return 0.5 * pi * (b + a * arithmetic) / (arithmetic * (arithmetic + weight))
        geometric = 2.0 * sqrt(product)
        product = geometric * arithmetic


@formula
def first_kind(kc: float) -> float:
    """K, the complete elliptic integral of the first kind, by its complementary modulus kc."""
    return complete_integral(kc, 1.0, 1.0)


@formula
def second_kind(kc: float) -> float:
    """E, the complete elliptic integral of the second kind, by its complementary modulus kc."""
    return complete_integral(kc, 1.0, kc * kc)


@formula
def cosine_part(kc: float) -> float:
    """B = int cos^2 t / Delta dt."""
    return complete_integral(kc, 1.0, 0.0)


@formula
def sine_part(kc: float) -> float:
    """D = int sin^2 t / Delta dt = (K - E)/m, without the subtraction."""
    return complete_integral(kc, 0.0, 1.0)
