"""The least thrust that a bearing carries at its speed under inner raceway control: below it there is no equilibrium.

Across its contact lines, D = ai - ao apart, a ball's equilibrium (19.9, 19.10) gives its loads whatever the thrust is,

    Qi sin D = Fc sin ao + Ti cos D - To,      Qo sin D = Fc sin ai + Ti - To cos D,

and its axial load on the ring (19.13) is q = Qi sin ai - Ti cos ai = Qo sin ao - To cos ao. Loops that close make the
states at one speed a curve, on which q falls with ao: from the heaviest loads, whose lines hardly part, to where a
contact bears nothing. Friction carries what is left there, since inner control puts it, Ti < 0, on the inner raceway
whatever the load: -Ti cos ai where the inner contact ends, -To cos ao where the outer does. That is the least thrust.

That q falls all along is not proved. It does over random scenes of usual bearings; where one groove is far wider than
the other, or hardly wider than the ball, one bearing in four hundred has states under less thrust, down to half of it,
and soft contacts turn up to 2e-3 below it. Therefore the question is asked only of cases for which the search from
closed forms and from rest has found nothing: of 60,720 random ones under 0.1 to 0.9999 of their least thrust it then
refuses none that the full search solves. With half of the friction on each raceway, one bearing in two hundred has
states apart from these, between an outer and an inner end, under a little less thrust. There that outer end counts, and
what has no equilibrium between both is left to the search.
"""

from __future__ import annotations

from math import sqrt

from numpy import recarray

from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.contact.hertz import INNER_SIDE, OUTER_SIDE
from qsbearing.model.effects.gyroscopic_moment import NO_BOUND
from qsbearing.model.effects.raceway_control import INNER
from qsbearing.model.kernel.ball_inertia import friction_shares, inertia
from qsbearing.model.kernel.raceway_stiffness import groove_stiffness

# Of the least thrust: so much below it is left to the search. An approach grows with the load's power 2/3, so that the
# lines turn at once where a contact comes to bear: the least is not quite at the end, but below it by 2e3 (q/K)^2 of
# it, as an expansion says: 1e-7 in the worst of random scenes of usual bearings.
MARGIN = 1e-4
# Of its bound: a thrust that the solver does not tell from none (newton.STALLED), for which the balls lie on the outer
# raceway alone.
NO_THRUST = 1e-9
# Beyond this free angle, 60 degrees, the inner contact may reach the shoulder before any contact ends.
STEEPEST_COSINE = 0.5
# Loads of the remaining contact that this cosine between the lines would make larger lie beyond any end.
LEAST_COSINE = 0.1
# An approach settles by a factor of twenty or more each time; so does the sine by secants.
MOST_APPROACHES, SETTLED = 20, 1e-13
MOST_SECANTS, SAME_SINE = 60, 1e-12


@kernel
def has_least_thrust(case: recarray, work: recarray) -> bool:
    """Whether the case is one of those above: thrust alone, equal balls on the pitch circle, of which the inner ring's
    turning makes the inertia, and friction without a bound."""
    is_thrust = work.ball_count == 1 and case.ball_count > 1 and not case.displacement_given[0]
    has_inertia = case.centrifugal and case.gyroscopic and case.inner_speed != 0.0 and case.outer_speed == 0.0
    is_usual = not (case.displaced_orbit or case.unequal_balls or case.elastic_rings)
    is_unbounded = case.control == INNER and case.friction_coefficient == NO_BOUND
    return bool(is_thrust and has_inertia and is_usual and is_unbounded and case.cos_free > STEEPEST_COSINE)


@kernel
def is_below_least_thrust(case: recarray, work: recarray, ball: recarray) -> bool:
    """Whether a case has no equilibrium because friction alone would carry more than its thrust."""
    if not has_least_thrust(case, work):
        return False
    thrust, bound = case.prescribed[0] / case.ball_count, thrust_bound(case)
    if not case.one_sided:
        thrust = abs(thrust)
    if not NO_THRUST * bound < thrust < bound:
        return False
    return bool(thrust < (1.0 - MARGIN) * least_thrust(case, work, ball))


@kernel
def thrust_bound(case: recarray) -> float:
    """What the least thrust of a ball does not exceed.

    With u/(1 + cos D)^2 <= 1/4 (`kinematics.py`), |Mg|/D <= (1 + g) omega^2/(40 g) sin ai. Of that Ti is at most twice
    as much, times cos ai, and with Harris's shares each T as much, times a cosine.
    """
    return 0.025 * (case.pitch_diameter + 1.0) * case.inner_speed * case.inner_speed


@kernel
def least_thrust(case: recarray, work: recarray, ball: recarray) -> float:
    """The least thrust of a ball; 0 where neither end is found."""
    fc, _, _, _, _, _ = inertia(case, work, INNER, case.sin_free, case.cos_free, case.sin_free, case.cos_free)
    lengths = case.inner_coefficient + case.outer_coefficient - 1.0
    stretched = lengths + 2.0 * (fc / min(case.inner_stiffness, case.outer_stiffness)) ** (2.0 / 3.0)
    cosine = min((lengths * case.cos_free + case.interference) / stretched, 1.0)
    highest = sqrt(1.0 - cosine * cosine)  # the lines are one, or have crossed
    lowest = 0.0
    _, share_o = friction_shares(case, INNER, 0.0)
    if share_o > 0.0:
        lowest, pressed, thrust = end_of_contact(case, work, ball, False, -highest, highest)
        if pressed > 0.0:
            return thrust
    _, pressed, thrust = end_of_contact(case, work, ball, True, lowest, highest)
    return thrust if pressed > 0.0 else 0.0


@kernel
def end_of_contact(
    case: recarray, work: recarray, ball: recarray, is_inner: bool, lowest: float, highest: float
) -> tuple[float, float, float]:
    """Where the inner or the outer contact ends, between two sines of the outer angle: (the sine, the load of the other
    contact there, the thrust); the lowest sine and zeros where it does not."""
    low, high = lowest, highest
    at_high, _, _, approach = without_contact(case, work, ball, is_inner, high, 0.0)
    at_low, _, _, _ = without_contact(case, work, ball, is_inner, low, approach)
    if at_low >= 0.0 or at_high <= 0.0:
        return lowest, 0.0, 0.0
    side, middle = 0, highest
    for _ in range(MOST_SECANTS):  # regula falsi, the end that stays counting half (Illinois)
        before, middle = middle, high - at_high * (high - low) / (at_high - at_low)
        value, load, thrust, approach = without_contact(case, work, ball, is_inner, middle, approach)
        if value < 0.0:
            at_high *= 0.5 if side < 0 else 1.0
            low, at_low, side = middle, value, -1
        else:
            at_low *= 0.5 if side > 0 else 1.0
            high, at_high, side = middle, value, 1
        if value == 0.0 or abs(middle - before) <= SAME_SINE:
            break
    return middle, load, thrust


@kernel
def without_contact(
    case: recarray, work: recarray, ball: recarray, is_inner: bool, so: float, approach: float
) -> tuple[float, float, float, float]:
    """At this sine of the outer angle, with no approach of the inner or outer contact: (what its load is in proportion
    to, the other's load if this one is none, the friction's axial part, the other's approach, from the one given)."""
    inner, outer = case.inner_coefficient - 0.5, case.outer_coefficient - 0.5
    radial = (inner + outer) * case.cos_free + case.interference
    share_i, share_o = friction_shares(case, INNER, 0.0)
    co = sqrt(1.0 - so * so)
    value, load, thrust = 0.0, 0.0, 0.0
    for _ in range(MOST_APPROACHES):
        ci = radial - (outer + approach) * co if is_inner else radial - outer * co
        ci = max(min(ci / (inner if is_inner else inner + approach), 1.0), -1.0)
        si = sqrt(1.0 - ci * ci)
        fc, _, _, mg, _, _ = inertia(case, work, INNER, si, ci, so, co)
        ti, to = share_i * mg, share_o * mg
        along, across = si * so + ci * co, si * co - ci * so
        within = max(along, LEAST_COSINE)
        if is_inner:
            value, load, thrust = fc * so + ti * along - to, (fc * ci + to * across) / within, -ti * ci
            stiffness, _ = groove_stiffness(case, ball, OUTER_SIDE, so, co)
        else:
            value, load, thrust = fc * si + ti - to * along, (-ti * across - fc * co) / within, -to * co
            stiffness, _ = groove_stiffness(case, ball, INNER_SIDE, si, ci)
        if mg > 0.0:  # a ball that would go backwards lies beyond any end
            value = -abs(value)
        before, approach = approach, (max(load, 0.0) / stiffness) ** (2.0 / 3.0)
        if abs(approach - before) <= SETTLED:
            break
    return value, load, thrust, approach
