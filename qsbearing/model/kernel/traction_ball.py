"""One ball between its contacts, moved by their friction: six equations, their derivatives, and its force on the ring.

Unknown are its place (X1, X2), its angular velocity (wx, wy, wz) in the frame that goes round with it, and its orbit
omega_m. With F = -Q n + T t of each contact in (x, z), Y along y = z x x, Mx = (Mn n + Mt t)_x and so on,

    sum F + (0, m omega_m^2 R) = 0
    sum Y + Fd + m R omega_m omega_m' = 0              Fd: drag against the orbit
    sum Mx - J omega_m (wx' + omega_m') = 0
    sum My + J omega_m wz - J omega_m wy' = 0
    sum Mz - J omega_m wy - J omega_m wz' = 0

where ' is d/dpsi along the orbit: rates are nothing for a ball that has all the time it needs at its azimuth, as under
thrust. The gyroscopic moment is J omega_m x X (w + omega_m x) = J omega_m (0, -wz, wy).

Any number of contacts will do: each is a groove that stands or turns, whose arc's centre C lies where the ring has it;
n = (X - C)/|X - C|, and the approach is |X - C| - (r - D/2). Derived here from rigid-body mechanics; the force balance
without friction is (19.9), (19.10), with T = lambda Mg/D.
"""

from __future__ import annotations

import numpy as np
from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import inlined, kernel
from qsbearing.model.kernel.case import BALL_INERTIA, BALL_MASS, record
from qsbearing.model.kernel.contact_line import contact_load, direction
from qsbearing.model.kernel.traction import contact_sums

LAW = record(
    ("law", np.int64),
    ("friction_coefficient", np.float64),
    ("slip_speed", np.float64),
    ("drag_force", np.float64),  # of a cage on each ball, against the orbit
    ("drag_factor", np.float64),  # of the oil: its drag over the square of the balls' speed
    ("has_curvature", np.bool_),
)
"""Friction and drag, in the case's units."""

GROOVE = record(
    ("speed", np.float64),  # of its ring
    ("follows_ring", np.bool_),  # the inner ring, which is displaced
    ("sine", np.float64),  # of n where the ball just touches at the free angle
    ("cosine", np.float64),
    ("gap1", np.float64),  # of the ball there, beyond touching, from the arc's centre
    ("gap2", np.float64),
    ("length", np.float64),  # r - D/2
    ("stiffness", np.float64),
    ("semi_major", np.float64),  # a/Q^(1/3)
    ("semi_minor", np.float64),
    ("curvature", np.float64),  # 1/Rd
)
"""One arc of a ring's groove."""

X1, X2, WX, WY, WZ, ORBIT, BY_RADIUS = range(7)
"""Unknowns of a ball, X from touching at the free angle; and X2 as far as it is part of the orbit's radius. Its
equations stand in the order of its forces."""
FX, FZ, FY, MX, MY, MZ = range(6)
RING_FORCES = 4  # axial, radial, along y, torque

MOVED_BALL = record(
    ("cosine", np.float64),  # of its azimuth
    ("sine", np.float64),
    ("diameter", np.float64),  # as that of balls elsewhere: 1, and no deflection nor lobe
    ("deflection", np.float64),
    ("lobe", np.float64),
    ("unknown", np.float64, (6,)),
    ("rate", np.float64, (6,)),  # of wx, wy, wz and omega_m along the orbit
    ("before", np.float64, (6,)),
    ("kept", np.float64, (6,)),  # of a solution on the way to another
    ("step", np.float64, (6,)),
    ("residual", np.float64, (6,)),
    ("matrix", np.float64, (6, 6)),
    ("by_ring", np.float64, (6, 2)),
    ("by_rate", np.float64, (6, 6)),
    ("ring_force", np.float64, (RING_FORCES,)),  # on the ring that is displaced
    ("ring_matrix", np.float64, (RING_FORCES, 6)),
    ("ring_by_ring", np.float64, (RING_FORCES, 2)),
    ("largest_load", np.float64),
    ("column", np.float64, (6,)),
    ("shift", np.float64, (2, 8)),  # of X: what stands by itself (7), less parts by w and omega_m (0-3), ring (4-6)
)
"""One ball, and its equations where it is."""

SINE, COSINE, APPROACH, LOAD, TRACTION, SIDEWAYS, SPIN_MOMENT, ROLL_MOMENT, TURN_MOMENT, HEAT = range(10)
SPIN, SLIP_ACROSS, SLIP_ALONG, SEMI_MAJOR, SEMI_MINOR, DISSIPATION = range(10, 16)
CONTACT_QUANTITIES = 16
"""Of a contact: n, load, T, Y, Mn, Mt, My, heat, ws and the slips at its centre, semi-axes, P."""


@inlined
def line_to(groove: recarray, x1: float, x2: float, a1: float, a2: float) -> tuple[float, float, float, float]:
    """(approach, n1, n2, 1/|X - C|) of a groove that its ring has displaced by (a1, a2)."""
    v1, v2 = x1 + groove.gap1, x2 + groove.gap2
    if groove.follows_ring:
        v1, v2 = v1 - a1, v2 - a2
    return direction(groove.length, groove.sine, groove.cosine, v1, v2)


@inlined
def slips_at(
    groove: recarray, ball: recarray, n1: float, n2: float, radius: float
) -> tuple[float, float, float, float]:
    """(wy, ws, wr, vr) of a ball at a contact."""
    ring = groove.speed - ball.unknown[ORBIT]
    wx, wz = ball.unknown[WX] - ring, ball.unknown[WZ]
    return ball.unknown[WY], wx * n1 + wz * n2, wx * n2 - wz * n1, ring * radius


@kernel
def read_groove(
    case: recarray, law: recarray, groove: recarray, points: ndarray, ball: recarray, a1: float, a2: float, out: ndarray
) -> None:
    """Write what there is to say about one contact."""
    approach, n1, n2, _ = line_to(groove, ball.unknown[X1], ball.unknown[X2], a1, a2)
    load, _ = contact_load(groove.stiffness, approach)
    out[SINE], out[COSINE], out[APPROACH], out[LOAD] = n1, n2, approach, load
    for k in range(TRACTION, CONTACT_QUANTITIES):
        out[k] = 0.0
    slips = slips_at(groove, ball, n1, n2, orbit_of(case, ball))
    wy, ws, wr, vr = slips
    out[SPIN], out[SLIP_ACROSS], out[SLIP_ALONG] = ws, 0.5 * wy, vr - 0.5 * wr
    if load > 0.0:
        root = load ** (1.0 / 3.0)
        a, b = groove.semi_major * root, groove.semi_minor * root
        sums = contact_sums(law, points, load, a, b, groove.curvature, slips)
        out[TRACTION], out[SIDEWAYS], out[SPIN_MOMENT] = sums.t, sums.y, sums.mn
        out[ROLL_MOMENT], out[TURN_MOMENT], out[HEAT] = sums.mt, sums.my, sums.heat
        out[SEMI_MAJOR], out[SEMI_MINOR], out[DISSIPATION] = a, b, sums.dissipation


@inlined
def orbit_of(case: recarray, ball: recarray) -> float:
    """R, by which X2 counts where orbits are displaced."""
    return 0.5 * case.pitch_diameter + (ball.unknown[X2] if case.displaced_orbit else 0.0)


@kernel
def add_groove(
    case: recarray, law: recarray, groove: recarray, points: ndarray, ball: recarray, a1: float, a2: float
) -> None:
    """Add one contact to a ball's equations, their matrix, and its force on the ring."""
    approach, n1, n2, inverse = line_to(groove, ball.unknown[X1], ball.unknown[X2], a1, a2)
    load, load_slope = contact_load(groove.stiffness, approach)
    if load <= 0.0:
        return
    ball.largest_load = max(ball.largest_load, load)
    radius, root = orbit_of(case, ball), load ** (1.0 / 3.0)
    slips = slips_at(groove, ball, n1, n2, radius)
    _, ws, wr, _ = slips
    a, b = groove.semi_major * root, groove.semi_minor * root
    sums = contact_sums(law, points, load, a, b, groove.curvature, slips)
    mx, mz = sums.mn * n1 + sums.mt * n2, sums.mn * n2 - sums.mt * n1
    fx, fz = -load * n1 + sums.t * n2, -load * n2 - sums.t * n1
    column = ball.column
    column[FX], column[FZ], column[FY], column[MX], column[MY], column[MZ] = fx, fz, sums.y, mx, sums.my, mz
    add_force(groove, ball, radius)
    ring = groove.speed - ball.unknown[ORBIT]
    for k in range(BY_RADIUS + 1 if case.displaced_orbit else BY_RADIUS):
        by_load, turn, changes = changes_by(k, load_slope, inverse, n1, n2, ws, wr, radius, ring)
        t, y = changed(sums.t_slopes, changes), changed(sums.y_slopes, changes)
        mn, mt = changed(sums.mn_slopes, changes), changed(sums.mt_slopes, changes)
        column[FX] = -by_load * n1 + t * n2 - turn * (load * n2 + sums.t * n1)
        column[FZ] = -by_load * n2 - t * n1 + turn * (load * n1 - sums.t * n2)
        column[FY], column[MY] = y, changed(sums.my_slopes, changes)
        column[MX], column[MZ] = mn * n1 + mt * n2 + turn * mz, mn * n2 - mt * n1 - turn * mx
        torque = column[MX] - radius * y
        if k == BY_RADIUS:
            torque -= sums.y
        add_column(groove, ball, k, torque)


@inlined
def changes_by(
    k: int, load_slope: float, inverse: float, n1: float, n2: float, ws: float, wr: float, radius: float, ring: float
) -> tuple[float, float, tuple[float, float, float, float, float]]:
    """What an unknown of the ball changes at a contact: the load, the angle of n towards t; (wy, ws, wr, vr, load)."""
    if k <= X2:
        along, across = (n1, n2) if k == X1 else (n2, -n1)
        by_load, turn = load_slope * along, across * inverse
        return by_load, turn, (0.0, wr * turn, -ws * turn, 0.0, by_load)
    if k == WX:
        return 0.0, 0.0, (0.0, n1, n2, 0.0, 0.0)
    if k == WY:
        return 0.0, 0.0, (1.0, 0.0, 0.0, 0.0, 0.0)
    if k == WZ:
        return 0.0, 0.0, (0.0, n2, -n1, 0.0, 0.0)
    if k == ORBIT:
        return 0.0, 0.0, (0.0, n1, n2, -radius, 0.0)
    return 0.0, 0.0, (0.0, 0.0, 0.0, ring, 0.0)


@inlined
def add_force(groove: recarray, ball: recarray, radius: float) -> None:
    """Add a contact's forces and moments on the ball, which stand in its column."""
    force = ball.column
    for row in range(6):
        ball.residual[row] += force[row]
    if groove.follows_ring:
        ball.ring_force[0] -= force[FX]
        ball.ring_force[1] -= force[FZ]
        ball.ring_force[2] -= force[FY]
        ball.ring_force[3] -= force[MX] - radius * force[FY]


@inlined
def add_column(groove: recarray, ball: recarray, k: int, torque: float) -> None:
    """Add their change by an unknown, which stands there, and that of the torque; the ring displaced is X the other
    way, but for R."""
    column, at = ball.column, X2 if k == BY_RADIUS else k
    for row in range(6):
        ball.matrix[row, at] += column[row]
    if not groove.follows_ring:
        return
    ball.ring_matrix[0, at] -= column[FX]
    ball.ring_matrix[1, at] -= column[FZ]
    ball.ring_matrix[2, at] -= column[FY]
    ball.ring_matrix[3, at] -= torque
    if k > X2:
        return
    for row in range(6):
        ball.by_ring[row, k] -= column[row]
    ball.ring_by_ring[0, k] += column[FX]
    ball.ring_by_ring[1, k] += column[FZ]
    ball.ring_by_ring[2, k] += column[FY]
    ball.ring_by_ring[3, k] += torque


@inlined
def changed(slopes: tuple[float, ...], changes: tuple[float, ...]) -> float:
    """A quantity's change by (wy, ws, wr, vr) and the load."""
    return (
        slopes[0] * changes[0] + slopes[1] * changes[1] + slopes[2] * changes[2] + slopes[3] * changes[3]
        + slopes[4] * changes[4]
    )  # fmt: skip


@kernel
def moved_ball(
    case: recarray, law: recarray, grooves: ndarray, points: ndarray, ball: recarray, a1: float, a2: float
) -> None:
    """Fill a ball's equations where it is, and its force on the ring, by its unknowns, its rates and the ring.

    Args:
        a1, a2: displacement of the inner groove's centre from touching at the free angle.
    """
    ball.largest_load = 0.0
    for row in range(6):
        ball.residual[row], ball.by_ring[row, 0], ball.by_ring[row, 1] = 0.0, 0.0, 0.0
        for k in range(6):
            ball.matrix[row, k], ball.by_rate[row, k] = 0.0, 0.0
    for row in range(RING_FORCES):
        ball.ring_force[row], ball.ring_by_ring[row, 0], ball.ring_by_ring[row, 1] = 0.0, 0.0, 0.0
        for k in range(6):
            ball.ring_matrix[row, k] = 0.0
    for k in range(grooves.size):
        add_groove(case, law, grooves[k], points, ball, a1, a2)
    add_inertia(case, ball)
    add_drag(case, law, ball)


@kernel
def add_inertia(case: recarray, ball: recarray) -> None:
    """What the ball's own motion asks for."""
    radius, orbit = orbit_of(case, ball), ball.unknown[ORBIT]
    wy, wz, rate = ball.unknown[WY], ball.unknown[WZ], ball.rate
    spin = BALL_INERTIA * orbit
    ball.residual[FZ] += BALL_MASS * orbit * orbit * radius
    ball.matrix[FZ, ORBIT] += 2.0 * BALL_MASS * orbit * radius
    ball.residual[FY] += BALL_MASS * radius * orbit * rate[ORBIT]
    ball.matrix[FY, ORBIT] += BALL_MASS * radius * rate[ORBIT]
    ball.by_rate[FY, ORBIT] = BALL_MASS * radius * orbit
    if case.displaced_orbit:
        ball.matrix[FZ, X2] += BALL_MASS * orbit * orbit
        ball.matrix[FY, X2] += BALL_MASS * orbit * rate[ORBIT]
    ball.residual[MX] -= spin * (rate[WX] + rate[ORBIT])
    ball.residual[MY] += spin * (wz - rate[WY])
    ball.residual[MZ] -= spin * (wy + rate[WZ])
    ball.matrix[MX, ORBIT] -= BALL_INERTIA * (rate[WX] + rate[ORBIT])
    ball.matrix[MY, ORBIT] += BALL_INERTIA * (wz - rate[WY])
    ball.matrix[MZ, ORBIT] -= BALL_INERTIA * (wy + rate[WZ])
    ball.matrix[MY, WZ] += spin
    ball.matrix[MZ, WY] -= spin
    ball.by_rate[MX, WX], ball.by_rate[MX, ORBIT] = -spin, -spin
    ball.by_rate[MY, WY], ball.by_rate[MZ, WZ] = -spin, -spin


@kernel
def drag_of(case: recarray, law: recarray, ball: recarray) -> tuple[float, float]:
    """Fd against the orbit, along y where it runs with +x, and dFd/d omega_m; none at rest."""
    speed, both = orbit_of(case, ball) * ball.unknown[ORBIT], case.inner_speed + case.outer_speed
    forward = 1.0 if both > 0.0 else -1.0 if both < 0.0 else 0.0
    force = law.drag_factor * speed * abs(speed) + law.drag_force * forward
    return force, 2.0 * law.drag_factor * abs(speed) * orbit_of(case, ball)


@kernel
def add_drag(case: recarray, law: recarray, ball: recarray) -> None:
    """Of oil and cage."""
    force, slope = drag_of(case, law, ball)
    ball.residual[FY] += force
    ball.matrix[FY, ORBIT] += slope
    if case.displaced_orbit:
        orbit = ball.unknown[ORBIT]
        ball.matrix[FY, X2] += 2.0 * law.drag_factor * orbit_of(case, ball) * orbit * abs(orbit)
