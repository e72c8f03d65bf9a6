"""Sets of rows: drawn at random, and recomputed from what their solution says.

    python -m tests.verification.campaign.sets COUNT [SEED] [--out FILE]

Every row is a bearing of its own with all channels held, so that its balls and its sums are checked as those of any
scene. What is left is the shaft: rigid, it moves every row by statics in space alone, and carries the rows' loads.

| quantity | range |
|---|---|
| rows | two to four of one bearing of the realistic envelope, 0.15 to 1 pitch diameters apart, either way round |
| preload | rigid or by a spring, 0.1 to 10 % of the axial static rating; none for a quarter, and for tandems |
| axial load | 0.01 to 20 % of that rating, either way, against a spring to 0.8 of its force |
| radial load | to 1.5 times the axial one, with a moment for half |
| rings and balls | for a third warmer by up to 50 K each, and fitted |
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from tests.verification.campaign import realistic
from tests.verification.campaign.batches import Batch, of_sets, per_row, run
from tests.verification.campaign.checks import MOST_IMBALANCE, findings, heat_strain, moved_by_heat
from tests.verification.campaign.group import GROUP, one_of
from tests.verification.campaign.mounted import of_one_ball_count, with_expansion
from tests.verification.campaign.set_certificates import is_unsupported

BATCH = 100
ARRANGEMENTS = (("+x", "-x"), ("-x", "+x"), ("+x", "+x"), ("+x", "+x", "-x"), ("+x", "+x", "-x", "-x"))

STATICS = 1e-9
"""Of the largest force: what the shaft's equilibrium and the rows' own leave, each 1e-10 at most, summed over rows."""


def draw_sets(rng: np.random.Generator, n: int = GROUP) -> qs.BearingSet:
    """Sets that one call can solve, so many of one arrangement and bearings with as many balls."""
    group = of_one_ball_count(realistic.draw_group(rng, 0, n))
    group = replace(group, materials=with_expansion(rng, group.materials))
    scene = replace(group, operation={"speed_rpm": group.operation["speed_rpm"]}).scene()
    bearing = replace(scene.bearing, ball_count=int(group.bearing["ball_count"][0]))
    pitch, angle = (np.asarray(value, float) for value in (bearing.pitch_diameter, bearing.free_contact_angle))
    rating = realistic.AXIAL_RATING * 1e6 * bearing.ball_count * np.asarray(bearing.ball_diameter) ** 2 * np.sin(angle)
    directions = one_of(rng, ARRANGEMENTS)
    apart = pitch * rng.uniform(0.15, 1.0, n)
    force = rating * 10.0 ** rng.uniform(-3.0, -1.0, n)
    axial = rating * 10.0 ** rng.uniform(-4.0, -0.7, n)
    preload, sprung = None, False
    if len(set(directions)) == 2:
        preload = one_of(rng, (qs.Preload(rigid=force), qs.Preload(spring=force), None), [0.5, 0.25, 0.25])
        sprung = preload is not None and preload.kind == "spring"
        axial *= one_of(rng, (1.0, -1.0))
        if sprung:  # against the spring no row carries more than its force
            axial = np.maximum(axial, -0.8 * force)
    rows = tuple(
        qs.Row(bearing, k * apart, direction, sprung=sprung and direction == "-x")  # type: ignore[arg-type]
        for k, direction in enumerate(directions)
    )
    radial, azimuth, turn = np.abs(axial) * rng.uniform(0.0, 1.5, n), *rng.uniform(0.0, 2.0 * np.pi, (2, n))
    moment = radial * apart * rng.uniform(0.0, 1.0, n) * (rng.random() < 0.5)
    operation = qs.Operation(
        scene.operation.speed,
        axial_load=axial,
        radial_load_y=radial * np.cos(azimuth),
        radial_load_z=radial * np.sin(azimuth),
        moment_y=moment * np.cos(turn),
        moment_z=moment * np.sin(turn),
    )
    ring_effects: tuple[qs.RingExpansion | qs.BallExpansion, ...] = ()
    if rng.random() < 1.0 / 3.0:
        warm = qs.zero_celsius + rng.uniform(20.0, 70.0, (3, n))
        ball = np.asarray(bearing.ball_diameter, float)
        bore, outside = 0.7 * (pitch - ball), 1.2 * (pitch + ball)
        fit = bore * rng.uniform(0.0, 3e-4, n)
        rings = qs.RingExpansion(
            bore, outside, shaft_interference=fit, inner_ring_temperature=warm[0], outer_ring_temperature=warm[1]
        )
        ring_effects = (rings, qs.BallExpansion(warm[2]))
    choices = {"hertz_angle": group.hertz_angle, "ring_effects": ring_effects, "raceway_control": group.control}
    return qs.BearingSet(rows, operation, preload, ball_effects=scene.ball_effects, **choices)


def wrong_of(solution: qs.SetSolution) -> dict[str, NDArray]:
    """By promise: which converged sets of one case axis break it."""
    of = solution.set
    converged = solution.converged
    failed: dict[str, NDArray] = {}
    # Of a row that carries a thousandth of its set the balls are balanced as the set is, not by their own loads.
    force = np.max([np.abs(row.load[:, :3]).max(axis=-1) for row in solution.rows], axis=0)
    for row in solution.rows:
        for name, bad in findings(row.scene, row, force=force).failed().items():
            if name == "misplaced":  # against the shaft, below
                continue
            failed[name] = failed.get(name, False) | (bad & converged)
    total, slid, displaced = np.zeros(solution.displacement.shape), 0.0, np.zeros(solution.shape)
    largest, lever = np.zeros(solution.shape), np.zeros(solution.shape)
    d = solution.displacement
    for row, found in zip(of.rows, solution.rows, strict=True):
        bearing = row.bearing
        # Of the plane of the inner groove centres, where a row's own loads and displacements are meant.
        past = (np.asarray(bearing.inner_groove_radius) - 0.5 * np.asarray(bearing.ball_diameter)) * np.sin(
            bearing.free_contact_angle
        )
        # The shaft is as warm at every row, and grows from the reference position.
        along = (np.asarray(row.position) - of.reference) * (1.0 + heat_strain(found.scene, "shaft"))
        arm = along + row.sign * (past + moved_by_heat(found.scene, "inner"))
        load = found.load
        total[:, 0] += row.sign * load[:, 0]
        total[:, 1:3] += load[:, 1:3]
        total[:, 3] += row.sign * load[:, 3] - arm * load[:, 2]
        total[:, 4] += row.sign * load[:, 4] + arm * load[:, 1]
        slid = slid + row.sprung * load[:, 0]
        y, z = d[:, 1] + arm * d[:, 4], d[:, 2] - arm * d[:, 3]
        moved = np.stack([y, z, row.sign * d[:, 3] * np.abs(arm), row.sign * d[:, 4] * np.abs(arm)], axis=-1)
        own = found.displacement[:, 1:] * np.stack([np.ones_like(arm)] * 2 + [np.abs(arm)] * 2, axis=-1)
        gap = np.abs(own - moved).max(axis=-1)
        displaced = np.maximum(displaced, gap / bearing.groove_centre_distance)
        lever = np.maximum(lever, np.abs(arm))
        largest = np.maximum(largest, np.abs(load[:, :3]).max(axis=-1))
    wanted = [getattr(of.operation, name) for name in ("axial_load", "radial_load_y", "radial_load_z")]
    wanted += [of.operation.moment_y, of.operation.moment_z]
    arms = np.stack([np.ones_like(lever)] * 3 + [lever] * 2, axis=-1)
    left = (np.abs(total - np.stack(np.broadcast_arrays(*wanted), axis=-1)) / arms).max(axis=-1)
    if of.preload is not None and of.preload.kind == "spring":
        left = np.maximum(left, np.abs(slid - np.asarray(of.preload.spring)))
    failed["shaft in equilibrium"] = converged & ~(left <= STATICS * largest)
    failed["shaft rigid"] = converged & ~(displaced <= MOST_IMBALANCE)
    return failed


def batch(rng: np.random.Generator) -> Batch:
    """How one call's sets ended."""
    solution = qs.solve_set(draw_sets(rng, BATCH))
    return of_sets(solution, wrong_of(solution), lambda k: is_unsupported(solution, k))


if __name__ == "__main__":
    run("sets", batch, BATCH, per_row(2.6), __doc__)
