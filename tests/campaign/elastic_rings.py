"""Random bearings between elastic rings, down to 1 mm thin: solved or refused with a reason, none wrong.

    python -m tests.campaign.elastic_rings COUNT [SEED]

What is solved is recomputed from its outputs by code of its own: the ring's equilibrium, each ball's, loop closure, and
the gives of both rings under the balls' loads, with compliances from Navier's equations in place of Airy's function.
"""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs

HARMONICS = 24
BATCH = 500
TOLERANCE = 1e-6
"""Of the largest give or load: far above the solver's 1e-12 times a thin ring's flexibility, far below an error."""


def rim_matrix(n: int, a: NDArray, b: NDArray, modulus: float, nu: float) -> NDArray:
    """(case, 2, 2): outward displacement of bore and outside by pressures on them, from Navier's equations.

    u = U r^s cos n t, v = V r^s sin n t; of s = +-n +- 1 each leaves one ratio V/U by the equilibrium around.
    """
    if n == 0:
        square = b * b - a * a
        bore = a / modulus * ((a * a + b * b) / square + nu)
        outside = -b / modulus * ((a * a + b * b) / square - nu)
        cross = 2.0 * a * b / modulus / square
        return np.moveaxis(np.array([[bore, -cross * b], [cross * a, outside]]), -1, 0)
    c, half = modulus / (1.0 - nu * nu), 0.5 * (1.0 - nu)
    middle = np.sqrt(a * b)
    system, moved = np.zeros((a.size, 4, 4)), np.zeros((a.size, 2, 4))
    for column, s in enumerate((n + 1.0, n - 1.0, 1.0 - n, -n - 1.0)):
        v = n * ((1.0 + nu * s) + (s + 1.0) * half) / ((s * s - 1.0) * half - n * n)
        for rim, radius in enumerate((a / middle, b / middle)):
            size = radius**s
            system[:, rim, column] = c * (s + nu * (1.0 + n * v)) * size / radius
            system[:, 2 + rim, column] = half * (-n + (s - 1.0) * v) * size / radius
            moved[:, rim, column] = size
    scale = np.abs(system).max(axis=1, keepdims=True)
    pressed = np.zeros((a.size, 4, 2))
    pressed[:, 0, 0] = pressed[:, 1, 1] = -1.0
    return (moved / scale) @ np.linalg.solve(system / scale, pressed) * middle[:, None, None]


def gives(load: NDArray, azimuth: NDArray, compliance: list[NDArray]) -> NDArray:
    """(case, ball) by radial loads (case, ball)."""
    apart = azimuth[:, :, None] - azimuth[:, None, :]
    influence = sum(c[:, None, None] * np.cos(n * apart) for n, c in enumerate(compliance))
    return np.asarray(np.einsum("kji,ki->kj", influence, load))


def batch(rng: np.random.Generator, count: int) -> dict[str, int]:
    """How these cases ended; wrong ones are printed."""
    z = int(rng.integers(4, 24))
    ball = rng.uniform(4.0, 30.0) * qs.mm
    pitch = ball * z / np.pi * rng.uniform(1.15, 1.8, count)
    ri, ro = (ball * rng.uniform(0.512, 0.54) for _ in range(2))
    alpha = rng.uniform(5.0, 40.0) * qs.deg
    bearing = qs.BallBearing(z, ball, pitch, ri, ro, alpha)
    inner = bearing.inner_groove_centre_radius - ri
    outer = bearing.outer_groove_centre_radius + ro
    thickness = np.exp(rng.uniform(np.log(1e-3), np.log(0.5 * ball), (2, count)))
    width = 1.3 * ball
    rings: dict[str, Any] = {"outside_diameter": 2.0 * (outer + thickness[0]), "outer_width": width}
    housed, on_shaft = rng.random() < 0.4, rng.random() < 0.4
    wall = 1.0 + rng.uniform(0.05, 0.5, count)
    if housed:
        rings |= {"housing_outside_diameter": wall * rings["outside_diameter"], "housing_elastic_modulus": 70e9}
    else:
        rings["housing"] = "free"
    bore = np.maximum(inner - thickness[1], 0.5 * inner)
    rings |= {"bore_diameter": 2.0 * bore, "inner_width": width}
    if on_shaft:
        rings["shaft_bore_diameter"] = bore  # half the ring's
    else:
        rings["shaft"] = "free"
    turns = rng.random() < 0.5
    heavy = 3e7 * ball * ball * z * 10.0 ** rng.uniform(-4.0, 0.3, count)
    loads: dict[str, Any] = {"axial_load": heavy, "radial_load_y": heavy * rng.uniform(0.0, 1.2, count)}
    loads["radial_load_z"] = heavy * rng.uniform(0.0, 0.5, count) if rng.random() < 0.5 else 0.0
    held = rng.random() < 0.5
    if held:
        loads |= {"tilt_y": 0.0, "tilt_z": 0.0}
    else:
        loads |= {"moment_y": 0.0, "moment_z": heavy * pitch * rng.uniform(-0.2, 0.2, count)}
    speed = rng.uniform(0.0, 1e6, count) / (pitch / qs.mm) * qs.rpm if turns else 0.0
    effects = {"ball_effects": (qs.CentrifugalForce(),), "raceway_control": "outer"} if turns else {}
    scene = qs.Scene(bearing, qs.Operation(speed=speed, **loads), ring_effects=(qs.ElasticRings(**rings),), **effects)
    s = qs.solve(scene)
    good = np.asarray(s.converged)
    ended: dict[str, int] = {}
    for status, reason in zip(s.status, s.reason, strict=True):
        name = f"{status} {reason}".strip()
        ended[name] = ended.get(name, 0) + 1
    q = {side: np.nan_to_num(getattr(s, side).load) for side in ("inner", "outer")}
    sine = {side: np.nan_to_num(getattr(s, side).sine) for side in ("inner", "outer")}
    cosine = {side: np.nan_to_num(getattr(s, side).cosine) for side in ("inner", "outer")}
    largest = np.maximum(max_of(q["inner"]), max_of(q["outer"])) + 1e-300
    # Each ball, and the ring in the channels that are free.
    fc = 0.0 if s.centrifugal_force is None else np.nan_to_num(s.centrifugal_force)
    errors = [max_of(q["inner"] * sine["inner"] - q["outer"] * sine["outer"]) / largest]
    errors.append(max_of(q["inner"] * cosine["inner"] - q["outer"] * cosine["outer"] + fc) / largest)
    axial, radial = q["inner"] * sine["inner"], q["inner"] * cosine["inner"]
    lever = bearing.inner_groove_centre_radius
    azimuth = s.azimuth
    sums = [axial, radial * np.cos(azimuth), radial * np.sin(azimuth)]
    wanted: list[Any] = [heavy, loads["radial_load_y"], loads["radial_load_z"]]
    if not held:
        sums += [axial * np.sin(azimuth), -axial * np.cos(azimuth)]
        wanted += [loads["moment_y"] / lever, loads["moment_z"] / lever]
    errors += [np.abs(each.sum(axis=1) - want) / (z * largest) for each, want in zip(sums, wanted, strict=True)]
    # Gives of the rings, and loop closure at balls that carry.
    outer_ring, inner_ring = [], []
    for n in range(HARMONICS + 1):
        if n == 1:
            outer_ring.append(np.zeros(count))
            inner_ring.append(np.zeros(count))
            continue  # the mount's
        own = rim_matrix(n, outer, outer + thickness[0], 208e9, 0.3)
        give = own[:, 0, 0]
        if housed:
            edge = outer + thickness[0]
            wall_bore = rim_matrix(n, edge, wall * edge, 70e9, 0.3)[:, 0, 0]
            give = give + own[:, 0, 1] * own[:, 1, 0] / (wall_bore - own[:, 1, 1])
        outer_ring.append(give)
        own = rim_matrix(n, bore, inner, 208e9, 0.3)
        give = -own[:, 1, 1]
        if on_shaft:
            shaft = rim_matrix(n, 0.5 * bore, bore, 208e9, 0.3)[:, 1, 1]
            give = give - own[:, 1, 0] * own[:, 0, 1] / (shaft - own[:, 0, 0])
        inner_ring.append(give)
    total = np.zeros(azimuth.shape)
    for give, radius, load in (
        (np.array(outer_ring), outer, q["outer"] * cosine["outer"]),
        (np.array(inner_ring), inner, radial),
    ):
        n = np.arange(2.0, HARMONICS + 1)[:, None]
        give[2:] = np.maximum(give[2:] - 2.0 * radius / (208e9 * n), 0.0)  # a half-plane's is in Hertz's contact
        taken = give / (2.0 * np.pi * radius * width)
        total += gives(load, azimuth, [taken[0], *(2.0 * taken[1:])])
    lines = {
        side: (r - 0.5 * ball) + np.nan_to_num(getattr(s, side).approach) for side, r in (("inner", ri), ("outer", ro))
    }
    reach = lines["inner"] * cosine["inner"] + lines["outer"] * cosine["outer"]
    distance = (ri + ro - ball) * np.cos(alpha)
    d = s.displacement
    rigid = distance + d[:, 1:2] * np.cos(azimuth) + d[:, 2:3] * np.sin(azimuth)
    loaded = (q["inner"] > 0.0) & (q["outer"] > 0.0)
    apart = np.where(loaded, rigid - reach - total, 0.0)
    bending = max_of(np.abs(total)) + 1e-9
    largest_error = np.nanmax(np.where(good, np.max(errors, axis=0), 0.0))
    worst = np.nanmax(np.where(good, max_of(apart) / bending, 0.0))
    ended["largest imbalance, 1e-12"] = int(largest_error / 1e-12)
    ended["largest error of gives, 1e-9"] = int(worst / 1e-9)
    wrong = good & ((np.max(errors, axis=0) > TOLERANCE) | (max_of(apart) / bending > TOLERANCE))
    ended["wrong"] = int(wrong.sum())
    for k in np.flatnonzero(wrong)[:3]:
        print("WRONG", z, ball, k, thickness[:, k], heavy[k], np.max(errors, axis=0)[k], max_of(apart)[k] / bending[k])
    ended["give beyond a thickness"] = int((good & (max_of(total) > thickness.min(axis=0))).sum())
    return ended


def max_of(values: NDArray) -> NDArray:
    """Largest magnitude of each case."""
    return np.asarray(np.nanmax(np.abs(values), axis=1))


def main() -> None:
    count, seed = int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1
    rng = np.random.default_rng(seed)
    found: dict[str, int] = {}
    for _ in range(max(count // BATCH, 1)):
        for name, number in batch(rng, BATCH).items():
            found[name] = max(found.get(name, 0), number) if name.startswith("largest") else found.get(name, 0) + number
    for name, number in sorted(found.items()):
        print(f"{number:8d}  {name}")
    sys.exit(1 if found["wrong"] else 0)


if __name__ == "__main__":
    main()
