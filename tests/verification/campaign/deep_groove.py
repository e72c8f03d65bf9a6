"""Deep-groove rows on one shaft, located, floating or held one way: drawn at random, and balanced a second time.

    python -m tests.verification.campaign.deep_groove COUNT [SEED] [--out FILE]

Balls and sums of every row are checked as those of any scene, which says where its grooves stand to each other. From
there on all is this module's own: where a row's grooves stand is what shaft, heat and offset make of its place, but for a
ring that slides; one that is held one way presses what holds it or has drawn away from it; forces and moments of all rows
balance the loads, about middle planes; the play follows from the triangle of groove centres. At rest a set has no
equilibrium only where no row is held against the thrust.

| quantity | range |
|---|---|
| rows | two to four of bearings of their own, 0.5 to 5 pitch diameters apart; 0.4 located, 0.2 floating, 0.4 held one way |
| clearance | 2e-4 to 5e-3 ball diameters, one row in ten without, by up to 3e-4 |
| offset | for half, up to a tenth of the distance of groove centres, either way |
| loads | for 1 in 12 none; radial 1e-4 to 0.1 of Z D^2 30 MPa, for 1 in 6 none; thrust none for a quarter, else 0.01 to 2 times that size, either way; moments for half |
| speed | for half, to 500,000 mm/min on the pitch circle, with centrifugal forces |
| rings and balls | for a third warmer by up to 30 K each |
"""  # noqa: E501

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from tests.verification.campaign.batches import Batch, of_sets, per_row, run
from tests.verification.campaign.checks import MOST_IMBALANCE, findings, heat_strain, moved_by_heat
from tests.verification.campaign.group import one_of
from tests.verification.campaign.sets import STATICS

BATCH = 100
WAYS, SHARES = ("both", "none", "+x", "-x"), (0.4, 0.2, 0.2, 0.2)
CARRIES = {"both": (1.0, -1.0), "none": (), "+x": (1.0,), "-x": (-1.0,)}
PLACES = 1e-9
"""Of the distance of groove centres: what rounding leaves of places that are sums of lengths a thousand times larger,
and rings that press with no more than the balance leaves."""


def draw_sets(rng: np.random.Generator, n: int = BATCH) -> qs.BearingSet:
    """Sets that one call can solve, so many with rows of one size each, held alike."""
    rows, at = [], np.zeros(n)
    steel = qs.STEEL
    uses_offsets = rng.random() < 0.5
    for _ in range(int(rng.integers(2, 5))):
        balls, ball = int(rng.integers(7, 16)), rng.uniform(4.0, 30.0) * qs.mm
        pitch = ball * balls / np.pi * rng.uniform(1.25, 1.7)
        inner, outer = (ball * rng.uniform(0.51, 0.535) for _ in range(2))
        clearance = ball * 10.0 ** rng.uniform(np.log10(2e-4), np.log10(5e-3), n)
        clearance = np.minimum(clearance, 0.5 * (inner + outer - ball))
        if rng.random() < 0.1:
            clearance = -ball * rng.uniform(0.0, 3e-4, n)
        bearing = qs.BallBearing.from_diametral_clearance(
            kind=qs.BearingKind.DEEP_GROOVE, ball_count=balls, ball_diameter=ball, pitch_diameter=pitch,
            inner_groove_radius=inner, outer_groove_radius=outer, diametral_clearance=clearance,
            ball_material=steel, ring_material=steel,
        )  # fmt: skip
        offset = 0.1 * (inner + outer - ball) * rng.uniform(-1.0, 1.0, n) * uses_offsets
        rows.append(qs.Row(bearing, at, one_of(rng, WAYS, SHARES), offset))
        at = at + pitch * rng.uniform(0.5, 5.0, n)
    size = min(30e6 * row.bearing.ball_count * np.asarray(row.bearing.ball_diameter) ** 2 for row in rows)
    size = size * 10.0 ** rng.uniform(-4.0, -1.0, n) * (rng.random() >= 1.0 / 12.0)
    radial = size * (rng.random() >= 1.0 / 6.0)
    axial = size * 10.0 ** rng.uniform(-2.0, 0.3, n) * one_of(rng, (0.0, 1.0, -1.0), (0.25, 0.375, 0.375))
    azimuth, turn = rng.uniform(0.0, 2.0 * np.pi, (2, n))
    moment = radial * at * rng.uniform(0.0, 0.3, n) * (rng.random() < 0.5)
    widest = max(float(row.bearing.pitch_diameter) for row in rows)  # type: ignore[arg-type]
    speed = rng.uniform(0.0, 5e5, n) * qs.mm / widest * qs.rpm * (rng.random() < 0.5)
    operation = qs.Operation(
        speed, axial_load=axial, radial_load_y=radial * np.cos(azimuth), radial_load_z=radial * np.sin(azimuth),
        moment_y=moment * np.cos(turn), moment_z=moment * np.sin(turn),
    )  # fmt: skip
    effects: dict[str, Any] = {}
    if speed.any():
        effects = {"ball_effects": (qs.CentrifugalForce(),), "raceway_control": "outer"}
    if rng.random() < 1.0 / 3.0:
        warm = qs.zero_celsius + rng.uniform(20.0, 50.0, (3, n))
        rows = [replace(row, ring_effects=_grown(row.bearing, warm)) for row in rows]
    return qs.BearingSet(tuple(rows), operation, **effects)


def _grown(bearing: qs.BallBearing, warm: NDArray) -> tuple[qs.RingExpansion, qs.BallExpansion]:
    """Rings and balls as warm as that, loose on shaft and in housing."""
    pitch, ball = float(np.ravel(bearing.pitch_diameter)[0]), float(np.ravel(bearing.ball_diameter)[0])
    seats = 0.7 * (pitch - ball), 1.2 * (pitch + ball)
    rings = qs.RingExpansion(*seats, inner_ring_temperature=warm[0], outer_ring_temperature=warm[1])
    return rings, qs.BallExpansion(warm[2])


def half_play(bearing: qs.BallBearing) -> NDArray:
    """By the triangle of groove centres, apart by BD along the contact and by BD - Pd/2 across; wedged leave none."""
    apart = np.asarray(bearing.groove_centre_distance, float)
    across = np.minimum(apart - 0.5 * np.asarray(bearing.diametral_clearance, float), apart)
    return np.asarray(np.sqrt((apart - across) * (apart + across)))


def wrong_of(solution: qs.SetSolution) -> dict[str, NDArray]:
    """By promise: which sets of one case axis break it."""
    of, converged = solution.set, solution.converged
    d, shape = solution.displacement, solution.shape
    failed: dict[str, NDArray] = {}
    # Of rows that carry nothing the balls are balanced as those are that are wedged, or thrown outward.
    forces = [np.abs(row.load[:, :3]).max(axis=-1) for row in solution.rows]
    forces += [side.load.max(axis=-1) for row in solution.rows for side in (row.inner, row.outer)]
    force = np.max(forces, axis=0)
    for row in solution.rows:
        for name, bad in findings(row.scene, row, force=force).failed().items():
            if name not in ("misplaced", "open_side"):
                failed[name] = failed.get(name, False) | (bad & converged)
    total, lever = np.zeros((*shape, 5)), np.zeros(shape)
    across, along, pulls, passed = (np.zeros(shape) for _ in range(4))
    low, high = np.full(shape, -np.inf), np.full(shape, np.inf)
    for row, found in zip(of.rows, solution.rows, strict=True):
        side = -1.0 if row.carries == "-x" else 1.0
        span = np.asarray(row.bearing.groove_centre_distance)
        shaft, housing = heat_strain(found.scene, "shaft"), heat_strain(found.scene, "housing")
        cold = np.asarray(row.position) - of.reference
        arm, load = np.broadcast_to(cold * (1.0 + shaft), shape), found.load
        total[:, 0] += side * load[:, 0]
        total[:, 1:3] += load[:, 1:3]
        total[:, 3] += side * load[:, 3] - arm * load[:, 2]
        total[:, 4] += side * load[:, 4] + arm * load[:, 1]
        lever = np.maximum(lever, np.abs(arm))
        y, z = d[:, 1] + arm * d[:, 4], d[:, 2] - arm * d[:, 3]
        own = found.displacement
        turned = (own[:, 3:] - side * d[:, 3:]) * np.abs(arm)[:, None]
        gap = np.abs(np.concatenate([own[:, 1:3] - np.stack([y, z], axis=-1), turned], axis=-1)).max(axis=-1)
        across = np.maximum(across, gap / span)
        # Grooves apart along x: as the balls have it, and as the shaft, heat and offset do.
        grown = moved_by_heat(found.scene, "inner") + moved_by_heat(found.scene, "outer")
        apart = own[:, 0] + half_play(row.bearing) + grown
        offset = np.asarray(row.offset) * (1.0 + shaft)
        placed = side * (d[:, 0] + cold * (shaft - housing)) + offset
        left, thrust = (apart - placed) / span, load[:, 0] / np.maximum(force, 1e-300)
        if row.carries == "both":
            along = np.maximum(along, np.abs(left))
        elif row.carries == "none":
            pulls = np.maximum(pulls, np.abs(thrust))
        else:  # at what holds it, or beyond from there, without thrust
            pulls = np.maximum(pulls, -thrust)
            passed = np.maximum(passed, np.where(thrust > PLACES, np.abs(left), -left))
        play = half_play(found.scene.operating_bearing)
        for way in CARRIES[str(row.carries)]:
            reach = play - way * (side * offset + cold * (shaft - housing))
            if way > 0.0:
                high = np.minimum(high, reach)
            else:
                low = np.maximum(low, -reach)
    names = ("axial_load", "radial_load_y", "radial_load_z", "moment_y", "moment_z")
    loads = np.stack(np.broadcast_arrays(*(getattr(of.operation, name) for name in names)), axis=-1)
    arms = np.stack([np.ones_like(lever)] * 3 + [np.maximum(lever, 1e-3)] * 2, axis=-1)
    off = (np.abs(total - loads) / arms).max(axis=-1)
    failed["shaft in equilibrium"] = converged & ~(off <= STATICS * force)
    failed["shaft rigid"] = converged & ~(across <= MOST_IMBALANCE)
    failed["grooves where the shaft has them"] = converged & ~(along <= PLACES)
    failed["ring pulled"] = converged & ~(pulls <= PLACES)
    failed["ring past what holds it"] = converged & ~(passed <= PLACES)
    span = np.min([np.asarray(row.bearing.groove_centre_distance) for row in of.rows])
    play = np.nan_to_num(solution.axial_play, posinf=1.0, neginf=-1.0)
    known = np.stack([np.nan_to_num(low, neginf=-1.0), np.nan_to_num(high, posinf=1.0)], axis=-1)
    failed["play"] = converged & ~(np.abs(play - known).max(axis=-1) <= PLACES * span)
    carried = is_carried(of, shape)
    at_rest = ~np.broadcast_to(np.asarray(of.operation.speed, float) != 0.0, shape)
    failed["no equilibrium at rest"] = at_rest & carried & ~converged
    failed["thrust that no row carries"] = ~carried & converged
    ends = np.isfinite(low) & np.isfinite(high) & (low <= high)
    middle = np.where(ends, 0.5 * (low + high), 0.0)
    wedged = [np.asarray(row.scene.operating_bearing.diametral_clearance) < 0.0 for row in solution.rows]
    wedged = np.any(np.broadcast_arrays(converged, *wedged)[1:], axis=0)
    is_free = converged & at_rest & ends & (loads == 0.0).all(axis=-1) & ~wedged
    failed["not amid its play"] = is_free & ~(np.abs(d[:, 0] - middle) <= PLACES * span)
    return failed


def is_carried(of: qs.BearingSet, shape: tuple[int, ...]) -> NDArray:
    """Whether some row is held against the thrust, or there is none. Else there is no equilibrium: along the axis the
    load works, and no row presses."""
    ways = [0.0, *(way for row in of.rows for way in CARRIES[str(row.carries)])]
    return np.isin(np.sign(np.broadcast_to(np.asarray(of.operation.axial_load, float), shape)), ways)


def batch(rng: np.random.Generator) -> Batch:
    """How one call's sets ended."""
    solution = qs.solve_set(draw_sets(rng))
    carried = is_carried(solution.set, solution.shape)
    return of_sets(solution, wrong_of(solution), lambda k: not carried[k])


if __name__ == "__main__":
    run("deep_groove", batch, BATCH, per_row(3), __doc__)
