"""Starting values: where ring and balls are likely to be, from closed forms.

In the spirit of (19.16)-(19.17), where "ao" means the free angle: the contact angles at speed follow from a thrust
balance of one ball,

    cot ao = cot ai + Fc/q,     (Li + di) cos ai + (Lo + do) cos ao = BD cos a0,     d = (q/(K sin a))^(2/3),

q being the axial load a ball. At rest ao = ai and the two relations are the usual ones of a thrust-loaded bearing.
"""

from __future__ import annotations

from math import sqrt

from numpy import ndarray, recarray

from qsbearing.ball import groove_stiffness, inertia, is_moving, lay_loose, series_stiffness, set_outer
from qsbearing.compiled import kernel
from qsbearing.hertz import INNER_SIDE, OUTER_SIDE
from qsbearing.ring import inner_groove_centre


@kernel
def resting_thrust(case: recarray, axial_load: float) -> float:
    """Axial displacement of the ring at rest under pure thrust, to a few per cent."""
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    q = abs(axial_load) / (case.ball_count * case.series_stiffness)
    # Near a0 = 0 the angle is made by the load: sin a = sqrt(2 d/l), q = d^(3/2) sin a.
    sine = max(case.sin_free, (q * sqrt(2.0 / length)) ** 0.25 * sqrt(sqrt(2.0 / length)))
    approach = 0.0
    for _ in range(4):
        approach = (q / sine) ** (2.0 / 3.0)
        cosine = case.cos_free * length / (length + approach)
        sine = sqrt(max(1.0 - cosine * cosine, 1e-12))
    size = (length + approach) * sine
    return (size if axial_load >= 0.0 else -size) - length * case.sin_free


@kernel
def ring_at_rest(case: recarray, displacement: ndarray) -> None:
    """First displacement of the ring at rest, to be improved by descent."""
    for i in range(5):
        displacement[i] = case.prescribed[i] if case.is_held[i] else 0.0
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    radial = 0.0
    for i in range(1, 3):
        if not case.is_held[i]:
            radial += case.prescribed[i] * case.prescribed[i]
    for i in range(3, 5):
        if not case.is_held[i]:
            moment = case.prescribed[i] / (0.5 * case.pitch_diameter)
            radial += moment * moment
    radial = sqrt(radial)
    thrust = case.prescribed[0]
    is_thrown = case.centrifugal and is_moving(case)
    if not case.is_held[0] and (thrust != 0.0 or radial > 0.0 or is_thrown):
        # Without thrust the balls seat where the axial forces cancel, at angle zero, or leave the ring alone.
        displacement[0] = resting_thrust(case, thrust) if thrust != 0.0 else -length * case.sin_free
    # How far the ring must go sideways until balls touch, at the axial place that it has.
    axial = length * case.sin_free + displacement[0]
    gap = sqrt(max(length * length - axial * axial, 0.0)) - length * case.cos_free
    if (thrust != 0.0 and not case.is_held[0]) or is_thrown:
        gap = 0.0
    if radial > 0.0:
        # Stribeck's largest ball load, 4.37 Fr/Z, if little else holds the ring.
        size = gap + (4.37 * radial / (case.ball_count * case.series_stiffness)) ** (2.0 / 3.0)
        for i in range(1, 3):
            if not case.is_held[i]:
                displacement[i] = size * case.prescribed[i] / radial


@kernel
def seat_balls(case: recarray, ring: recarray, balls: ndarray) -> None:
    """Part the one link of each ball at rest into its two contacts, springs in series; loose balls lie as they do."""
    ring.at_rest = False
    for n in range(ring.balls):
        ball = balls[n]
        n1, n2, approach = ball.inner_sine, ball.inner_cosine, ball.inner_approach
        if approach > 0.0:
            ki, _ = groove_stiffness(case, INNER_SIDE, n1, n2)
            ko, _ = groove_stiffness(case, OUTER_SIDE, n1, n2)
            series, _ = series_stiffness(case, n1, n2)
            set_outer(ball, n1, n2, approach * (series / ko) ** (2.0 / 3.0))
            ball.inner_approach = approach * (series / ki) ** (2.0 / 3.0)
        else:
            a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
            lay_loose(case, ball, a1, a2)


@kernel
def moving_thrust(case: recarray, control: int, axial_load: float) -> tuple[float, float, float]:
    """Ring and ball under thrust at speed, without the gyroscopic moment: (axial displacement, u1, u2).

    The two relations above, solved for t = cot ai with the elastic approaches and Fc brought up to date on the way.
    """
    s, c = case.sin_free, case.cos_free
    li, lo = case.inner_coefficient - 0.5, case.outer_coefficient - 0.5
    radial = (li + lo) * c
    q = max(axial_load, 0.0) / case.ball_count
    ki, ko = case.inner_stiffness, case.outer_stiffness
    si, ci, so, co = s, c, s, c
    t = c / max(s, 0.05)
    s_first = max(s, 0.05)
    si, so = s_first, s_first
    di, do = 0.0, 0.0
    for _ in range(5):
        fc, _, _, _, _, _ = inertia(case, control, si, ci, so, co)
        ratio = fc / q
        di, do = (q / (si * ki)) ** (2.0 / 3.0), (q / (so * ko)) ** (2.0 / 3.0)
        ri, ro = sqrt(1.0 + t * t), sqrt(1.0 + (t + ratio) * (t + ratio))
        value = (li + di) * t / ri + (lo + do) * (t + ratio) / ro - radial
        slope = (li + di) / ri**3 + (lo + do) / ro**3
        t = max(t - value / slope, 0.02)
        ri, ro = sqrt(1.0 + t * t), sqrt(1.0 + (t + ratio) * (t + ratio))
        si, ci, so, co = 1.0 / ri, t / ri, 1.0 / ro, (t + ratio) / ro
    x1, x2 = (lo + do) * so, (lo + do) * co
    return (li + di) * si + x1 - (li + lo) * s, x1 - lo * s, x2 - lo * c
