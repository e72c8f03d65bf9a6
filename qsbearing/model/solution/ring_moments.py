"""Moments of balls that friction moves on the inner ring whose tilts are held, about y and z.

Derived here. The contact pushes the ring with G = -F through the circle of groove centres, at the lever Ri; friction
acts at the contact, beyond the ball's centre at L = ri - D/2 + approach from there, so that there is besides

    m = -(Mn n + Mt t + My y) - L n x (T t + Y y),      n x t = y,  n x y = -t.

With e_r radially outward at psi and y = e_r x e_x = (0, sin psi, -cos psi),

    M = sum of g [(Ri Gx + m_y) y + m_r e_r],           g: the ball's weight.

Range: balls on the pitch circle, the ring in its middle: displacements over dm/2 are left out, 4e-4 of M for B218.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.kernel import traction_ball as kernel
from qsbearing.model.kernel.traction_balance import PLACES


def ring_moments(cases: NDArray, contacts: NDArray, places: NDArray) -> NDArray:
    """About y and z, (case, 2), in the cases' units.

    Args:
        contacts: at the inner ring, (case, ball, quantity).
        places: (case, ball, `PLACES`).
    """
    names = kernel.SINE, kernel.COSINE, kernel.APPROACH, kernel.LOAD, kernel.TRACTION, kernel.SIDEWAYS
    nx, nz, approach, load, t, y = (contacts[..., each] for each in names)
    spin, roll, turn = (contacts[..., each] for each in (kernel.SPIN_MOMENT, kernel.ROLL_MOMENT, kernel.TURN_MOMENT))
    length = cases["inner_coefficient"][:, None] - 0.5 + approach
    across = cases["tilt_lever"][:, None] * (load * nx - t * nz) - turn - length * t
    outward = (roll - length * y) * nx - spin * nz
    ball = np.arange(contacts.shape[1])
    psi = cases["first_azimuth"][:, None] + 2.0 * np.pi * ball / cases["ball_count"][:, None]
    weight = np.where(ball < cases["ball_count"][:, None], places[..., PLACES.index("weight")], 0.0)
    s, c = np.sin(psi), np.cos(psi)
    about = across * s + outward * c, outward * s - across * c
    return np.stack([np.where(weight == 0.0, 0.0, weight * each).sum(axis=1) for each in about], axis=-1)
