"""How does Hertz's error grow as the groove conforms more closely to the ball: where does it reach 1 %, where 5 %?"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fem_check import contact, half_space_contact, measuring
from fem_check.agreement import EXAMPLE, Check, Findings, Kind, Level, Progress, Row
from fem_check.boundary_element import values
from fem_check.checks import groove_contacts
from fem_check.checks.true_geometry import gap_rows
from fem_check.groove import BallInGroove
from fem_check.references import hertz
from fem_check.scenes import groove_contact

COEFFICIENTS = (0.56, 0.53, 0.515, 0.51, 0.505)
"""f = r/D, open to close."""
LOAD = 2000.0
LOADS = (125.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0, 8000.0)
LIMITS = (1.0, 5.0)
"""Errors looked for [%]."""


def deviations(groove: BallInGroove, level: Level, progress: Progress) -> dict[str, list[float]]:
    """Exact gap over Hertz, minus one, in per cent, at every load; half-spaces."""
    found: dict[str, list[float]] = {"approach": [], "semi_major_axis": [], "semi_minor_axis": [], "max_pressure": []}
    for load in LOADS:
        problem = groove.problem(load)
        bodies = half_space_contact.condensed_bodies(
            problem, half_space_contact.SEQUENCES[level][-2], progress=progress
        )
        unit = contact.edge_positions(hertz(problem).semi_minor_axis, bodies.edge_element)
        flexibility = contact.total_flexibility(problem, bodies.ball, bodies.race)
        read = []
        for gap in (groove.gap, None):
            solution = contact.solve(problem, bodies.basis, flexibility, unit, gap)
            a, b, p0 = measuring.ellipse(solution)
            read.append([float(each.mean()) for each in (solution.approaches, a, b, p0)])
        for name, true, parabola in zip(found, *read, strict=True):
            found[name].append(100.0 * (true / parabola - 1.0))
    return found


def load_at_error(error: list[float], limit: float) -> float | None:
    """Load at which an error reaches a limit; None where it stays below up to the largest load."""
    size = np.abs(error)
    if size[-1] < limit:
        return None
    return float(np.exp(np.interp(np.log(limit), np.log(size), np.log(LOADS))))


def run(level: Level, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """B218's inner groove with its radius changed, everything else kept."""
    base = groove_contact(scene, "inner")
    rows: list[Row] = []
    series: dict[str, object] = {"load_N": list(LOADS), "curves": {}}
    curves: dict[str, object] = {}
    reached = []
    for coefficient in COEFFICIENTS:
        groove = replace(base, groove_radius=coefficient * base.ball_diameter)
        case = f"f = {coefficient:g}, Q = {LOAD:.0f} N"
        rows += gap_rows(groove, LOAD, case, level, progress)[0]
        curve = deviations(groove, level, progress)
        curves[f"{coefficient:g}"] = curve
        worst = [max(abs(curve[name][i]) for name in curve) for i in range(len(LOADS))]
        for limit in LIMITS:
            load = load_at_error(worst, limit)
            at = LOADS[-1] if load is None else load
            pressure = 1e-6 * hertz(groove.problem(at)).max_pressure
            within = "stays within {:g} % up to" if load is None else "is off by {:g} % at"
            reached.append(f"f = {coefficient:g}: it {within.format(limit)} {at:.0f} N ({pressure:.0f} MPa).")
    series["curves"] = curves
    bodies = half_space_contact.condensed_bodies(base.problem(LOAD), half_space_contact.SEQUENCES[level][-2])
    entry = {
        "elements_per_semi_axis": bodies.recipe.elements_per_semi_axis,
        "dofs": bodies.race.dofs,
        "file": bodies.recipe.file_name,
    }
    notes = [
        f"The gap's shape alone, on half-spaces; boundary-element values from {values.source()}. What finite bodies "
        "add to the approach is about the same for every groove and stands under true_geometry.",
        "Hertz's worst quantity over the load: " + " ".join(reached),
    ]
    return Findings(rows, entry, bodies.race.solver, {"conformity": series}, notes)


CHECK = Check(
    name="conformity",
    question="As the groove radius goes from 0.56 to 0.505 ball diameters: where is Hertz off by 1 %, where by 5 %?",
    kind=Kind.VALIDATION,
    reference="half-space boundary elements with the exact gap (tamaas)",
    tolerance="gap shape: a 0.1 %, b 0.2 %",
    run=run,
    largest_dofs=groove_contacts.largest_dofs,
)
