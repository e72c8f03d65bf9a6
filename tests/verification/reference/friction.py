"""A ball under thrust that friction moves, solved plainly and to fifty digits: `python -m
tests.verification.reference.friction` writes friction.json.

Seven unknowns: the ball's centre (X1, X2) from the outer groove's centre, its angular velocity (wx, wy, wz) in the
frame that goes round with it, its orbit wm, and the ring's displacement d. Axes: x the bearing's, z radially outward,
y = z cross x against the orbit. At a contact n points from the ball outward, t = (n_z, 0, -n_x), and with the ring's
speed in that frame, W = Omega - wm,

    ws = w.n - W n_x,    wr = w.t - W n_z,    v_t = wy h - ws eta,    v_y = ws xi - wr h + W R,
    dF = -mu p v/sqrt(v^2 + vc^2) dA,
    T = int dF_t,  Y = int dF_y,  M_n = int (xi dF_y - eta dF_t),  M_t = -int h dF_y,  M_y = int h dF_t.

Friction is summed over points: in s = sqrt(1 - rho^2) Gauss's for the weight s^2 on (0, 1), whose s are roots of the
Jacobi polynomial orthogonal under it, by angles in the middle of equal parts. What so many points leave of the integral
is told by other tests; with the same points the package must have all of these digits that a double holds.
"""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path
from typing import Any

from mpmath import mp

from tests.verification.reference.generate import as_text
from tests.verification.reference.jones_harris import (
    GUARD_DIGITS,
    PRINTED_DIGITS,
    HertzContact,
    contact_modulus,
    groove_contact,
)

Number = Any
DATA = Path(__file__).with_name("friction.json")
UNKNOWNS = ("X1", "X2", "wx", "wy", "wz", "wm", "d")
STEEL = ("208e9", "0.3", "7800")

CASES = [
    {
        "name": "b218_thrust",
        "why": "17.8 kN at 10,000 rpm: nearly all of the outer contact's friction carries the gyroscopic moment",
        **{"ball_count": 16, "ball_diameter": "0.022225", "pitch_diameter": "0.12526"},
        **{"inner_groove_radius": "0.0116281", "outer_groove_radius": "0.0116281", "free_contact_angle_deg": "40"},
        **{"axial_load": "17800", "inner_speed_rpm": "10000", "mu": "0.07", "slip_speed": "0.1"},
        **{"radii": 10, "angles": 24},
        # Of another program, to begin with: angles [deg], loads [N], the orbit over the shaft's speed.
        "start": [48.963953, 32.698952, 1441.8430, 1887.3988, 0.44532375],
    },
    {
        "name": "turbine_thrust",
        "why": "13.3 kN at 12,000 rpm on a 120 mm bore, far below slip; fewer points",
        **{"ball_count": 15, "ball_diameter": "0.02064", "pitch_diameter": "0.1545"},
        **{"inner_groove_radius": "0.0111456", "outer_groove_radius": "0.0107328", "free_contact_angle_deg": "24"},
        **{"axial_load": "13345", "inner_speed_rpm": "12000", "mu": "0.05", "slip_speed": "0.1"},
        **{"radii": 6, "angles": 16},
        "start": [30.122934, 18.692737, 1721.19875, 2500.04440, 0.44423757],
    },
]


def gauss_of_squares(count: int) -> list[tuple[Number, Number]]:
    """Points and weights on (0, 1) for the weight s^2, the weights' sum 1."""

    def polynomial(s: Number) -> Number:
        return mp.jacobi(count, 0, 2, 2 * s - 1)

    begin = [mp.mpf(k) / (40 * count) for k in range(40 * count + 1)]
    roots = [
        mp.findroot(polynomial, (a, b), solver="anderson")
        for a, b in pairwise(begin)
        if polynomial(a) * polynomial(b) < 0
    ]
    if len(roots) != count:
        raise ArithmeticError(f"{len(roots)} roots of {count}")
    # Weights that integrate 1, s, ... exactly: moments of s^2 are 1/(k + 3).
    matrix = mp.matrix([[s**k for s in roots] for k in range(count)])
    weights = mp.lu_solve(matrix, mp.matrix([mp.mpf(1) / (k + 3) for k in range(count)]))
    return [(s, 3 * w) for s, w in zip(roots, weights, strict=True)]


class Thrust:
    """One case in numbers."""

    def __init__(self, case: dict[str, Any]) -> None:
        names = ("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius")
        self.D, self.dm, self.ri, self.ro = (mp.mpf(case[name]) for name in names)
        self.alpha = mp.mpf(case["free_contact_angle_deg"]) * mp.pi / 180
        self.thrust = mp.mpf(case["axial_load"]) / case["ball_count"]
        self.speed = mp.mpf(case["inner_speed_rpm"]) * mp.pi / 30
        self.mu, self.vc = mp.mpf(case["mu"]), mp.mpf(case["slip_speed"])
        modulus, poisson, density = map(mp.mpf, STEEL)
        self.mass = density * mp.pi * self.D**3 / 6
        self.inertia = self.mass * self.D**2 / 10
        shared = contact_modulus((modulus, poisson), (modulus, poisson))
        g = self.D / self.dm * mp.cos(self.alpha)
        self.hertz = {
            "inner": groove_contact(self.D, self.ri, 1 - g, shared),
            "outer": groove_contact(self.D, self.ro, 1 + g, shared),
        }
        self.points = [
            (mp.sqrt(1 - s * s) * mp.cospi(turn), mp.sqrt(1 - s * s) * mp.sinpi(turn), w / case["angles"])
            for s, w in gauss_of_squares(case["radii"])
            for turn in (mp.mpf(2 * k + 1) / case["angles"] for k in range(case["angles"]))
        ]

    def start(self, numbers: list[float]) -> list[Number]:
        """Unknowns from printed ones: the ball rolls at the middle of both contacts."""
        inner, outer, qi, qo, orbit = map(mp.mpf, numbers)
        inner, outer, wm = inner * mp.pi / 180, outer * mp.pi / 180, orbit * self.speed
        li = self.ri - self.D / 2 + (qi / self.hertz["inner"].stiffness) ** (mp.mpf(2) / 3)
        lo = self.ro - self.D / 2 + (qo / self.hertz["outer"].stiffness) ** (mp.mpf(2) / 3)
        d = li * mp.sin(inner) + lo * mp.sin(outer) - (self.ri + self.ro - self.D) * mp.sin(self.alpha)
        # wr D/2 = W R with wr = (wx - W) nz - wz nx, for wx and wz.
        rows, right = [], []
        for angle, sign, ring in ((inner, -1, self.speed - wm), (outer, 1, -wm)):
            nx, nz = sign * mp.sin(angle), sign * mp.cos(angle)
            rows.append([nz, -nx])
            right.append(ring * (self.dm / self.D + nz))
        wx, wz = mp.lu_solve(mp.matrix(rows), mp.matrix(right))
        return [lo * mp.sin(outer), lo * mp.cos(outer), wx, mp.mpf(0), wz, wm, d]

    def contact(self, side: str, x: list[Number]) -> dict[str, Number]:
        """What one contact does, and how it lies."""
        X1, X2, wx, wy, wz, wm, d = x
        groove, hertz = (self.ro, self.hertz["outer"]) if side == "outer" else (self.ri, self.hertz["inner"])
        v1, v2, ring = X1, X2, -wm
        if side == "inner":
            span = self.ri + self.ro - self.D
            v1, v2, ring = X1 - span * mp.sin(self.alpha) - d, X2 - span * mp.cos(self.alpha), self.speed - wm
        length = mp.hypot(v1, v2)
        nx, nz, approach = v1 / length, v2 / length, length - (groove - self.D / 2)
        load = hertz.stiffness * approach ** mp.mpf("1.5")
        sums = self.friction(hertz, groove, load, (wx - ring) * nx + wz * nz, (wx - ring) * nz - wz * nx, wy, ring)
        return {"nx": nx, "nz": nz, "load": load, "approach": approach} | sums

    def friction(
        self, hertz: HertzContact, groove: Number, load: Number, ws: Number, wr: Number, wy: Number, ring: Number
    ) -> dict[str, Number]:
        """Its sums over the ellipse."""
        a, b = hertz.semi_major_axis(load), hertz.semi_minor_axis(load)
        common = 2 * groove * self.D / (2 * groove + self.D)
        rim = mp.sqrt(self.D**2 / 4 - a * a) - mp.sqrt(common**2 - a * a)
        t = y = mn = mt = my = heat = mp.mpf(0)
        for along, across, part in self.points:
            xi, eta = a * along, b * across
            h = mp.sqrt(common**2 - xi * xi) + rim
            vt, vy = wy * h - ws * eta, ws * xi - wr * h + ring * self.dm / 2
            over_slip = -self.mu * load * part / mp.sqrt(vt * vt + vy * vy + self.vc**2)
            ft, fy = over_slip * vt, over_slip * vy
            t, y, mn = t + ft, y + fy, mn + xi * fy - eta * ft
            mt, my, heat = mt - h * fy, my + h * ft, heat - ft * vt - fy * vy
        return {"T": t, "Y": y, "Mn": mn, "Mt": mt, "My": my, "heat": heat}

    def equations(self, x: list[Number]) -> list[Number]:
        """What forces [N] and moments over D lack."""
        _, _, _, wy, wz, wm, _ = x
        both = inner, outer = self.contact("inner", x), self.contact("outer", x)
        spin = self.inertia * wm
        return [
            sum(-c["load"] * c["nx"] + c["T"] * c["nz"] for c in both),
            sum(-c["load"] * c["nz"] - c["T"] * c["nx"] for c in both) + self.mass * wm**2 * self.dm / 2,
            inner["Y"] + outer["Y"],
            sum(c["Mn"] * c["nx"] + c["Mt"] * c["nz"] for c in both) / self.D,
            (inner["My"] + outer["My"] + spin * wz) / self.D,
            (sum(c["Mn"] * c["nz"] - c["Mt"] * c["nx"] for c in both) - spin * wy) / self.D,
            self.thrust + inner["load"] * inner["nx"] - inner["T"] * inner["nz"],
        ]

    def solve(self, x: list[Number]) -> tuple[list[Number], Number]:
        """Newton's method by differences: (unknowns, largest imbalance over the thrust)."""
        scale = [self.D, self.D, *[self.speed] * 4, self.D]
        for _ in range(40):
            now = self.equations(x)
            imbalance = max(map(abs, now)) / self.thrust
            if imbalance < mp.mpf(10) ** (10 - mp.dps):
                return x, imbalance
            columns = []
            for k, size in enumerate(scale):
                step = size * mp.mpf(10) ** (-mp.dps // 3)
                moved = [each + step * (i == k) for i, each in enumerate(x)]
                columns.append([(a - b) / step * size for a, b in zip(self.equations(moved), now, strict=True)])
            change = mp.lu_solve(mp.matrix(columns).T, -mp.matrix(now))
            x = [each + size * part for each, size, part in zip(x, scale, change, strict=True)]
        raise ArithmeticError(f"an imbalance of {mp.nstr(imbalance, 3)} is left")


def solve(case: dict[str, Any], digits: int = 50) -> dict[str, str]:
    """The case's answer, as decimal strings in SI units."""
    with mp.workdps(digits + GUARD_DIGITS):
        of = Thrust(case)
        x, imbalance = of.solve(of.start(case["start"]))
        found = dict(zip(UNKNOWNS, x, strict=True)) | {"Mg": of.inertia * x[5] * x[4]}
        for side, sign in (("inner", -1), ("outer", 1)):
            contact = of.contact(side, x)
            found[f"{side}_angle"] = mp.atan2(sign * contact["nx"], sign * contact["nz"])
            found |= {f"{side}_{name}": each for name, each in contact.items() if name not in ("nx", "nz")}
        torque = sum(found[f"inner_{m}"] * n for m, n in (("Mn", of.contact("inner", x)["nx"]),))
        torque += found["inner_Mt"] * of.contact("inner", x)["nz"] - found["inner_Y"] * of.dm / 2
        found["torque"] = -torque
        return {name: mp.nstr(each, PRINTED_DIGITS) for name, each in found.items()} | {
            "residual": mp.nstr(imbalance, 3)
        }


def load_reference() -> list[dict[str, Any]]:
    """The stored cases and results."""
    entries: list[dict[str, Any]] = json.loads(DATA.read_text(encoding="utf-8"))
    return entries


if __name__ == "__main__":
    DATA.write_text(as_text([{"case": case, "result": solve(case)} for case in CASES]), encoding="utf-8")
