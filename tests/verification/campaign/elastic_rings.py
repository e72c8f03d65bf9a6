"""Random bearings between elastic rings, down to 1 mm thin: solved or refused with a reason, none wrong.

    python -m tests.verification.campaign.elastic_rings COUNT [SEED] [--out FILE]

What is solved is recomputed from its outputs by code of its own: the ring's equilibrium, each ball's, loop closure, and
the deflections of both rings under the balls' loads, with compliances from Navier's equations in place of Airy's
function and sections with shoulders in closed form in place of Gauss points.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.effects.raceway_control import HYPOTHESES
from tests.verification.campaign.batches import Batch, per_row, run
from tests.verification.campaign.certificates import NONE, NOT_PROVED, as_left, directional
from tests.verification.campaign.checks import ANGLE_ROUNDING, findings
from tests.verification.campaign.group import one_of

HARMONICS = 24
BATCH = 500
MOTIONS = (
    (qs.CentrifugalForce(), qs.GyroscopicMoment()),
    (qs.CentrifugalForce(), qs.GyroscopicMoment(qs.MomentShares.HARRIS, friction_coefficient=0.07)),
    (qs.CentrifugalForce(),),
    (qs.GyroscopicMoment(),),
)
"""Ball effects of bearings that turn."""
TOLERANCE = 1e-6
"""Of the largest deflection or load: far above the solver's 1e-12 times a thin ring's compliance, below an error."""


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


def deflections(load: NDArray, azimuth: NDArray, compliance: list[NDArray]) -> NDArray:
    """(case, ball) by radial loads (case, ball)."""
    apart = azimuth[:, :, None] - azimuth[:, None, :]
    influence = sum(c[:, None, None] * np.cos(n * apart) for n, c in enumerate(compliance))
    return np.asarray(np.einsum("kji,ki->kj", influence, load))


def stiff_height(thickness: NDArray, width: float, groove_radius: NDArray, shoulders: list[NDArray]) -> NDArray:
    """Height of the rectangle of this width that bends as stiffly as the section with its groove: case.

    From the back, the section is as high as the thickness and t = c - sqrt(R^2 - x^2) of the arc, whose powers have
    antiderivatives, up to the shoulders' edges.
    """
    area, first, second = (np.zeros_like(thickness) for _ in range(3))
    r = groove_radius
    c = thickness + r
    for height in shoulders:
        x = np.minimum(np.sqrt(height * (2.0 * r - height)), 0.5 * width)
        s = np.sqrt(r * r - x * x)
        of_s = 0.5 * (x * s + r * r * np.arcsin(x / r))
        of_s2 = r * r * x - x**3 / 3.0
        of_s3 = 0.25 * x * s**3 + 0.75 * r * r * of_s
        top, rest = thickness + height, 0.5 * width - x
        area += c * x - of_s + top * rest
        first += 0.5 * (c * c * x - 2.0 * c * of_s + of_s2 + top**2 * rest)
        second += (c**3 * x - 3.0 * c * c * of_s + 3.0 * c * of_s2 - of_s3 + top**3 * rest) / 3.0
    return np.asarray(np.cbrt(12.0 * (second - first**2 / area) / width))


def draw_shoulders(rng: np.random.Generator, radius: NDArray, is_symmetric: bool) -> list[NDArray]:
    """Heights of both over the groove's bottom, that of the loaded side first; none for a third."""
    kind = rng.random()
    if kind < 1.0 / 3.0:
        return []
    first = radius * rng.uniform(0.02, 0.95, radius.shape)
    if kind < 2.0 / 3.0:
        return [first, first if is_symmetric else np.zeros_like(first)]  # the other is not given
    return [first, radius * rng.uniform(0.02, 0.95, radius.shape)]


def batch(rng: np.random.Generator, count: int = BATCH) -> Batch:
    """How these cases ended."""
    z = int(rng.integers(4, 24))
    ball = rng.uniform(4.0, 30.0) * qs.mm
    pitch = ball * z / np.pi * rng.uniform(1.15, 1.8, count)
    ri, ro = (ball * rng.uniform(0.512, 0.54) for _ in range(2))
    alpha = rng.uniform(5.0, 40.0) * qs.deg
    is_symmetric = rng.random() < 0.2
    bearing = qs.BallBearing(z, ball, pitch, ri, ro, alpha, kind="deep_groove" if is_symmetric else "angular_contact")
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
    radii = {"outer": np.full(count, ro), "inner": np.full(count, ri)}
    shoulders = {side: draw_shoulders(rng, radius, is_symmetric) for side, radius in radii.items()}
    for side, bottom, inward in (("outer", outer, -1.0), ("inner", inner, 1.0)):
        for name, height in zip(("shoulder", "open"), shoulders[side], strict=False):
            if name == "shoulder" or not (height is shoulders[side][0] or (height == 0.0).all()):
                rings[f"{side}_{name}_diameter"] = 2.0 * (bottom + inward * height)
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
    solved = qs.solve(scene)
    good, refused = np.asarray(solved.converged), np.asarray(solved.status) == "no_equilibrium"
    s = as_left(solved)  # refusals are recomputed where they were left
    ended = Counter(
        f"{status}: {reason}".removesuffix(": ") for status, reason in zip(solved.status, solved.reason, strict=True)
    )
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
    bends = {"outer": outer, "inner": inner}
    if shoulders["outer"]:
        height = stiff_height(thickness[0], width, radii["outer"], shoulders["outer"])
        bends["outer"] = outer + thickness[0] - height
    if shoulders["inner"]:
        bends["inner"] = bore + stiff_height(inner - bore, width, radii["inner"], shoulders["inner"])
    edge = outer + thickness[0]
    for n in range(HARMONICS + 1):
        if n == 1:
            outer_ring.append(np.zeros(count))
            inner_ring.append(np.zeros(count))
            continue  # the mount's
        own = rim_matrix(n, bends["outer"] if n else outer, edge, 208e9, 0.3)
        soft = own[:, 0, 0]
        if housed:
            wall_bore = rim_matrix(n, edge, wall * edge, 70e9, 0.3)[:, 0, 0]
            soft = soft + own[:, 0, 1] * own[:, 1, 0] / (wall_bore - own[:, 1, 1])
        outer_ring.append(soft)
        own = rim_matrix(n, bore, bends["inner"] if n else inner, 208e9, 0.3)
        soft = -own[:, 1, 1]
        if on_shaft:
            shaft = rim_matrix(n, 0.5 * bore, bore, 208e9, 0.3)[:, 1, 1]
            soft = soft - own[:, 1, 0] * own[:, 0, 1] / (shaft - own[:, 0, 0])
        inner_ring.append(soft)
    total = np.zeros(azimuth.shape)
    for soft, bottom, radius, load in (
        (np.array(outer_ring), outer, bends["outer"], q["outer"] * cosine["outer"]),
        (np.array(inner_ring), inner, bends["inner"], radial),
    ):
        n = np.arange(2.0, HARMONICS + 1)[:, None]
        soft[2:] = np.maximum(soft[2:] - 2.0 * radius / (208e9 * n), 0.0)  # a half-plane's is in Hertz's contact
        growth = soft[0] / (2.0 * np.pi * bottom * width)
        bending = soft[1:] / (np.pi * radius * width)
        total += deflections(load, azimuth, [growth, *bending])
    lines = {
        side: (r - 0.5 * ball) + np.nan_to_num(getattr(s, side).approach) for side, r in (("inner", ri), ("outer", ro))
    }
    reach = lines["inner"] * cosine["inner"] + lines["outer"] * cosine["outer"]
    distance = (ri + ro - ball) * np.cos(alpha)
    d = s.displacement
    rigid = distance + d[:, 1:2] * np.cos(azimuth) + d[:, 2:3] * np.sin(azimuth)
    loaded = (q["inner"] > 0.0) & (q["outer"] > 0.0)
    apart = np.where(loaded, rigid - reach - total, 0.0)
    size = max_of(np.abs(total)) + 1e-9
    imbalance, error = np.max(errors, axis=0), max_of(apart) / size
    wrong = good & ((imbalance > TOLERANCE) | (error > TOLERANCE))
    bearing_is = f"Z {z}, D {ball:.4g}, thickness"
    told = {
        int(k): f"{bearing_is} {thickness[:, k]}, load {heavy[k]:.4g}: {imbalance[k]:.1e}, {error[k]:.1e}"
        for k in np.flatnonzero(wrong)
    }
    is_balanced = (imbalance <= TOLERANCE) & (error <= TOLERANCE)
    is_broken = {
        "open side, an equilibrium": (sine["inner"] < -ANGLE_ROUNDING) & (not is_symmetric),
        "over the shoulder, an equilibrium": cosine["inner"] < -ANGLE_ROUNDING,
    }
    broken = {name: ((q["inner"] > 0.0) & bad).any(axis=1) & is_balanced for name, bad in is_broken.items()}
    kinds = (
        certificate(scene, int(k), [name for name, bad in broken.items() if bad[k]]) for k in np.flatnonzero(refused)
    )
    return Batch(
        ended,
        told | (wrong_in_motion(rng, scene) if turns else {}),
        [int(k) for k in np.flatnonzero(np.asarray(solved.status) == "not_converged")],
        Counter(kinds),
        {
            "imbalance": float(np.max(imbalance, where=good, initial=0.0)),
            "error of the gives": float(np.max(error, where=good, initial=0.0)),
            "give over thickness": float(np.max(max_of(total) / thickness.min(axis=0), where=good, initial=0.0)),
        },
    )


def certificate(scene: qs.Scene, k: int, broken: list[str]) -> str:
    """Of a case that is refused: a direction (proof), or the restriction that an equilibrium breaks (evidence)."""
    kind = directional(between_rigid_rings(scene, k)).kind
    return kind if kind != NONE else next(iter(broken), NOT_PROVED)


def between_rigid_rings(scene: qs.Scene, k: int) -> qs.Scene:
    """One of these cases without rings that bend: its balls press along lines of the same directions, and these are all
    that a certificate's direction knows."""
    bearing, operation = (
        replace(of, **{name: float(np.ravel(value)[k]) for name, value in vars(of).items() if np.size(value) > 1})
        for of in (scene.bearing, scene.operation)
    )
    return replace(scene, bearing=bearing, operation=operation, ring_effects=())


def wrong_in_motion(rng: np.random.Generator, scene: qs.Scene) -> dict[int, str]:
    """Of the same bearings under any raceway control and ball effects: the cases that break a promise which knows
    nothing of rings, by number. Closure does."""
    effects = one_of(rng, MOTIONS)
    control = one_of(rng, HYPOTHESES)
    scene = replace(scene, ball_effects=effects, raceway_control=control)
    solution = qs.solve(scene)
    failed = {name: bad & solution.converged for name, bad in findings(scene, solution).failed().items()}
    said = f"{control}, {', '.join(effect.name for effect in effects)}"
    return {int(k): f"{said}: {name}" for name, bad in failed.items() if name != "closure" for k in np.flatnonzero(bad)}


def max_of(values: NDArray) -> NDArray:
    """Largest magnitude of each case."""
    return np.asarray(np.nanmax(np.abs(values), axis=1))


if __name__ == "__main__":
    run("elastic_rings", batch, BATCH, per_row(), __doc__)
