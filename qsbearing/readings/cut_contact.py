"""What a contact is that the edge of its groove cuts off: its load, its line of load, the pressure at the edge.

A Hertz contact is similar at every load, so all depends on the part t of its major axis beyond the edge and on k = a/b.
At the approach that the uncut contact would have:

    1 - Q/Q0, centre/a, K = exp(sum c_ij ln(k/8)^i ln(t)^j),    turn = centre/R,    p = K p0 sqrt(b/d) near the edge,

fitted to boundary elements of a half-space whose pressure ends at the edge (0.05 <= t <= 0.5, 2 <= k <= 30; within 0.5,
1.2 and 0.7 %; 42 contacts). Below t = 0.05 all fall as powers, from values that no longer matter. At a sharp edge the
pressure is infinite; at one of the radius rho, tangent to the groove, it is at most

    1.07 p0 (K^2 E* b/(p0 rho))^(1/3), within 5 % (10 % at t = 0.1).

Range: elastic; Q0 and p0 of an endless groove. The real edge is obtuse, and the ring finite: finite elements of it
carry up to 2 % less load than these; the turn is up to 12 % more (40 % at t = 0.1). Contacts that end at an edge: M. J.
Hartnett, J. Lubr. Tech. 101, 1979; J. M. de Mul, J. J. Kalker, B. Fredriksson, J. Tribol. 108, 1986.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

LEAST, MOST = 0.05, 0.5
"""Part of the major axis beyond the edge that the fits hold between."""
ELLIPTICITIES = 2.0, 30.0
_POWERS = ((0, 0), (0, 1), (0, 2), (0, 3), (1, 0), (1, 1), (2, 0), (2, 1), (1, 2))
"""Of ln(k/8) and ln t."""
_FITS = {
    "load_loss": (0.16078, 1.6678, -0.21345, -0.025373, 0.070194, -0.10347, -0.025822, 0.0042767, -0.0054391),
    "centre": (0.012669, 1.47, -0.21122, -0.018572, -0.017006, -0.080062, -0.0018804, 0.0023644, -0.00054086),
    "intensity": (-0.21378, 0.013327, -0.31821, -0.041188, 0.10143, -0.074166, -0.024675, 0.0051936, -0.0065042),
}
_BELOW = {"load_loss": 2.5, "centre": 2.0, "intensity": 1.0}
"""Powers of t below `LEAST`."""


def of_share(name: str, share: NDArray, ellipticity: NDArray) -> NDArray:
    """One of `_FITS` by the part of the major axis beyond the edge: zero where none is, NaN beyond `MOST`."""
    fitted = np.where(np.isnan(share) | (share > MOST), np.nan, 0.0)
    at = np.flatnonzero((share > 0.0) & (share <= MOST))
    if at.size:
        t, k = share.ravel()[at], np.broadcast_to(ellipticity, share.shape).ravel()[at]
        log_t, log_k = np.log(np.maximum(t, LEAST)), np.log(np.clip(k, *ELLIPTICITIES) / 8.0)
        terms = (c * log_k**i * log_t**j for c, (i, j) in zip(_FITS[name], _POWERS, strict=True))
        fitted.ravel()[at] = np.exp(sum(terms)) * np.minimum(t / LEAST, 1.0) ** _BELOW[name]
    return fitted


def edge_pressure(
    intensity: NDArray, max_pressure: NDArray, semi_minor_axis: NDArray, contact_modulus: ArrayLike, radius: ArrayLike
) -> NDArray:
    """Largest pressure of a contact at an edge of a radius, at least that at its middle; SI.

    Args:
        contact_modulus: E*, half of Hertz's E'.
    """
    length = np.asarray(contact_modulus) / max_pressure * semi_minor_axis
    return np.asarray(max_pressure * np.maximum(1.0, 1.07 * np.cbrt(intensity**2 * length / np.asarray(radius))))
