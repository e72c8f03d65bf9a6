"""Spindles: the random sets of `sets` on elastic shafts in elastic housings, recomputed from what the solution says.

    python -m tests.verification.campaign.spindles COUNT [SEED] [--out FILE]

The shaft's line is put into finite elements of the tests' own: what they say holds it there must be what rows, loads
and supports do. Every row must stand where line and housing have it; a sleeve that floats carries its spring's force.

| quantity | range |
|---|---|
| shaft | three sections, 0.5 to 1.2 of the pitch diameter less the ball's, bored to 0.6 of that; -20 to 50 K warmer |
| load | at the overhanging end: the set's radial one, turned, and a tenth of its axial one |
| support | for half, 1e6 to 1e8 N/m |
| housing | for two thirds, 1e7 to 1e10 N/m and as stiff in tilt on the pitch radius |
| spacer | between the first rows, for half, up to 5 um longer outside |
| floating | the last row, for a quarter of the sets of three rows and more, on a spring of a tenth of the axial load |
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from tests.systems.sets import timoshenko
from tests.verification.campaign.batches import Batch, of_sets, per_row, run
from tests.verification.campaign.checks import standing_balls
from tests.verification.campaign.group import GROUP
from tests.verification.campaign.set_certificates import is_unsupported, warm_places
from tests.verification.campaign.sets import draw_sets

BATCH = 100
BALANCE = 1e-7
"""Of the largest force: elements between places a millimetre apart lose that much of displacements of 16 digits."""
PLANES = ((1, 4, 1.0), (2, 3, -1.0))
"""Of each plane: channels of deflection and slope, and the slope's sign."""


def draw_spindles(rng: np.random.Generator, n: int = GROUP) -> qs.BearingSet:
    """Spindles that one call can solve, so many on shafts of one drawing."""
    of = draw_sets(rng, n)
    bearing = of.rows[0].bearing
    last = float(np.max(of.rows[-1].position))
    seat = float(np.min(np.asarray(bearing.pitch_diameter) - bearing.ball_diameter))
    overhang = last * rng.uniform(0.2, 0.8)
    outer = seat * rng.uniform(0.5, 1.2, 3)
    bores = outer.min() * rng.uniform(0.0, 0.6, 3)
    steps = np.sort(rng.uniform(0.0, last, 2))
    lengths = np.diff([-overhang, *steps, last * 1.1])
    sections = tuple(qs.ShaftSection(*map(float, each)) for each in zip(lengths, outer, bores, strict=True))
    turn, operation = rng.uniform(0.0, 2.0 * np.pi), of.operation
    radial = np.hypot(operation.radial_load_y, operation.radial_load_z)  # type: ignore[arg-type]
    axial = np.asarray(operation.axial_load)
    load = qs.ShaftLoad(-overhang, 0.1 * axial, radial * np.cos(turn), radial * np.sin(turn))
    spring = float(10.0 ** rng.uniform(6.0, 8.0))
    supports = (qs.ShaftSupport(float(rng.uniform(0.0, last)), radial_y=spring, radial_z=2.0 * spring),)
    shaft = qs.Shaft(
        sections, -overhang, (load,), supports if rng.random() < 0.5 else (),
        temperature=qs.zero_celsius + 20.0 + rng.uniform(-20.0, 50.0, n),
    )  # fmt: skip
    stiffness = float(10.0 ** rng.uniform(7.0, 10.0))
    housing = qs.HousingStiffness(
        stiffness, 1.5 * stiffness, stiffness * float(np.mean(bearing.pitch_diameter)) ** 2 / 4
    )
    rows = of.rows
    if rng.random() < 2.0 / 3.0:
        rows = tuple(replace(row, housing_stiffness=housing) for row in rows)
    around: dict[str, Any] = {}
    if rng.random() < 0.5:
        around["spacers"] = (qs.Spacer((1, 2), 0.002, 0.002 + rng.uniform(0.0, 5e-6, n)),)
    if len(rows) > 2 and not rows[-1].sprung and rng.random() < 0.25:
        around["floating"] = (qs.FloatingGroup((len(rows),), 0.1 * np.abs(axial)),)
        if of.preload is not None and {row.carries for row in rows[:-1]} == {rows[0].carries}:
            around["preload"] = None
    return replace(of, rows=rows, shaft=shaft, **around)


def wrong_of(solution: qs.SetSolution) -> dict[str, NDArray]:
    """By promise: which converged spindles of one case axis break it."""
    of = solution.set
    shaft = of.shaft
    assert shaft is not None
    failed = {name: np.zeros(solution.shape, bool) for name in ("line bent by its forces", "rings in place", "sleeve")}
    for row in solution.rows:
        for name, bad in standing_balls(row.scene, row).items():
            failed[name] = failed.get(name, False) | (bad & solution.converged)
    grown = 1.0 + np.asarray(shaft.strains)[:, 0]
    for k in np.flatnonzero(solution.converged):
        scale = max(np.abs(row.load[k, :3]).max() for row in solution.rows)
        at, forces = _forces(solution, k)
        places = np.unique([*shaft.ends, *(position for position, _ in forces)])
        line = solution.deflection(places)[k]
        x = np.array([at(place) for place in places])
        applied = np.zeros((places.size, 5))
        for position, force in forces:
            applied[np.abs(places - position).argmin()] += force
        middles = 0.5 * (places[1:] + places[:-1])
        numbers = np.searchsorted(shaft.ends[1:-1], middles)
        s = grown[k] if grown.size > 1 else grown[0]
        built = [shaft.sections[i] for i in numbers]
        sections = [timoshenko.section(each.outer_diameter * s, each.inner_diameter * s, 208e9, 0.3) for each in built]
        matrix = timoshenko.matrix(x, sections)
        arm = np.ptp(x)
        for channel, slope, sign in PLANES:
            moved = np.stack([line[:, channel], sign * line[:, slope]], axis=1)
            given = np.stack([applied[:, channel], sign * applied[:, slope]], axis=1)
            left = (matrix @ moved.ravel()).reshape(-1, 2) - given
            worst = max(np.abs(left[:, 0]).max(), np.abs(left[:, 1]).max() / arm)
            rounding = 1e-15 * np.abs(matrix).max() * np.abs(moved).max()
            failed["line bent by its forces"][k] |= bool(worst > BALANCE * scale + rounding)
        failed["line bent by its forces"][k] |= bool(abs(applied[:, 0].sum()) > BALANCE * scale)
        failed["rings in place"][k] = _misplaced(solution, k)
        for group in of.floating:
            along = sum(of.rows[i - 1].sign * solution.rows[i - 1].load[k, 0] for i in group.rows)
            spring = np.broadcast_to(np.asarray(group.spring, float), solution.shape)[k]
            failed["sleeve"][k] |= bool(abs(along + spring) > BALANCE * scale)
    return failed


def _forces(solution: qs.SetSolution, k: int) -> tuple[Callable[[Any], float], list[tuple[float, NDArray]]]:
    """(where a drawn place is once warm, forces and moments on the shaft with their places)."""
    of, shaft = solution.set, solution.set.shaft
    assert shaft is not None
    grown = np.atleast_1d(1.0 + np.asarray(shaft.strains)[:, 0])
    s = float(grown[k] if grown.size > 1 else grown[0])
    reference = float(np.broadcast_to(of.reference, solution.shape)[k])
    at = warm_places(solution, k)
    found = []
    for row, own in zip(of.rows, solution.rows, strict=True):
        flip, arm = _frame(row, own, k)
        load = own.load[k] * flip
        load[3:] += np.array([-arm * load[2], arm * load[1]])
        found.append((float(np.broadcast_to(row.position, solution.shape)[k]), -load))
    for each in shaft.loads:
        values = [np.broadcast_to(np.asarray(value, float), solution.shape)[k] for value in each.values]
        found.append((each.position, np.array(values)))
    for support, load in zip(shaft.supports, solution.support_loads[k], strict=True):
        found.append((support.position, -load))
    # Which stays where it is drawn, whatever a spacer moves there.
    found.append((float(reference - at(reference) / s), solution.load[k]))
    return at, found


def _frame(row: qs.Row, own: qs.Solution, k: int) -> tuple[NDArray, float]:
    """What turns a row's own axes, and how far its inner groove centres' plane is from the balls'."""
    bearing = own.scene.bearing
    past = (np.asarray(bearing.inner_groove_radius) - 0.5 * np.asarray(bearing.ball_diameter)) * np.sin(
        np.asarray(bearing.free_contact_angle)
    )
    rings = own.scene.ring_expansion
    strain = 0.0 if rings is None or rings.inner_ring_temperature is None else 12e-6 * (
        np.broadcast_to(rings.inner_ring_temperature, own.shape)[k] - rings.reference_temperature
    )  # fmt: skip
    flip = np.array([row.sign, 1.0, 1.0, row.sign, row.sign])
    return flip, float(row.sign * np.broadcast_to(past, own.shape)[k] * (1.0 + strain))


def _misplaced(solution: qs.SetSolution, k: int) -> bool:
    """Whether some ring is not where line and housing have it."""
    for row, own in zip(solution.set.rows, solution.rows, strict=True):
        flip, arm = _frame(row, own, k)
        ring = solution.deflection([float(np.broadcast_to(row.position, solution.shape)[k])])[k, 0].copy()
        if row.housing_stiffness is not None:
            load = own.load[k] * flip
            load[3:] += np.array([-arm * load[2], arm * load[1]])
            ring -= row.housing_stiffness.compliance @ load
        ring[1:3] += np.array([arm * ring[4], -arm * ring[3]])
        away = (own.displacement[k] - ring * flip)[1:]
        size = 1e-10 * float(np.max(row.bearing.groove_centre_distance)) + 1e-9 * np.abs(ring[1:3]).max()
        if max(np.abs(away[:2]).max(), np.abs(away[2:]).max() * abs(arm)) > size:
            return True
    return False


def batch(rng: np.random.Generator) -> Batch:
    """How one call's spindles ended."""
    solution = qs.solve_set(draw_spindles(rng, BATCH))
    return of_sets(solution, wrong_of(solution), lambda k: is_unsupported(solution, k))


if __name__ == "__main__":
    run("spindles", batch, BATCH, per_row(2.6), __doc__)
