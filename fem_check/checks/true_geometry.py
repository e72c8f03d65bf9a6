"""How far is Hertz from the real sphere and groove, and is it the gap's shape or the bodies' size?"""

from __future__ import annotations

import numpy as np

from fem_check import boundary_element, contact, half_space_contact, measuring, meshing, true_bodies
from fem_check.agreement import EXAMPLE, Check, Findings, Kind, Level, Progress, Row
from fem_check.checks import groove_contacts
from fem_check.checks.conformity import over_hertz
from fem_check.contact_problem import QUANTITIES
from fem_check.groove import RACES, BallInGroove
from fem_check.references import HERTZ_SOURCE, hertz
from fem_check.scenes import groove_contact

LOADS = {Level.QUICK: (500.0, 2000.0, 5000.0), Level.RELEASE: (50.0, 500.0, 2000.0, 5000.0)}
ELEMENTS = {Level.QUICK: 4, Level.RELEASE: 6}
# Two methods whose own errors are below 0.08 % (quick level, b) and 0.01 %.
GAP_TOLERANCES = {"approach": 0.1, "semi_major_axis": 0.1, "semi_minor_axis": 0.2, "max_pressure": 0.3}
BODY_TOLERANCES = {"semi_major_axis": 0.1, "semi_minor_axis": 0.2}
LINEAR_TOLERANCE = 5.0


def gap_rows(
    groove: BallInGroove, load: float, case: str, level: Level, progress: Progress
) -> tuple[list[Row], dict[str, float]]:
    """What the gap's shape does to each quantity, finite elements against boundary elements."""
    reference = boundary_element.over_hertz(groove, load).ratio
    found = over_hertz(groove, load, half_space_contact.SEQUENCES[level][-1], progress)
    rows = [
        Row(
            f"{case}: half-spaces, exact gap",
            f"{name} over Hertz",
            "1",
            reference[name],
            boundary_element.SOURCE,
            found[name],
            None,
            GAP_TOLERANCES[name],
            "two methods, each within 0.1 % of Hertz for the parabola; b and p0 twice and three times that",
        )
        for name in reference
    ]
    return rows, {name: 100.0 * (value - 1.0) for name, value in found.items()}


def finite_part(
    groove: BallInGroove, load: float, elements: int, progress: Progress, *, pressure_turns: bool = False
) -> dict[str, float]:
    """What the finite bodies add, part by part, in per cent of the half-spaces'; and the approach itself [m]."""
    problem = groove.problem(load)
    exact = hertz(problem)
    bodies = true_bodies.condensed_bodies(
        groove, exact.semi_major_axis, exact.semi_minor_axis, elements, progress, pressure_turns=pressure_turns
    )
    unit = np.array([bodies.unit_length])
    read = {}
    for name, (ball, race) in {
        "half_space": (bodies.half_space, bodies.half_space),
        "true": (bodies.ball, bodies.race),
    }.items():
        flexibility = contact.total_flexibility(problem, ball, race)
        solution = contact.solve(problem, bodies.basis, flexibility, unit, groove.gap)
        a, b = measuring.ellipse(solution)
        p0 = measuring.largest_pressure(solution, a, b)
        read[name] = {
            "approach": float(solution.approaches[0]),
            "semi_major_axis": float(a[0]),
            "semi_minor_axis": float(b[0]),
            "max_pressure": float(p0[0]),
        }
    found = {name: 100.0 * (read["true"][name] / read["half_space"][name] - 1.0) for name in read["true"]}
    found["added_approach"] = read["true"]["approach"] - read["half_space"]["approach"]
    found["dofs"] = bodies.ball.dofs
    return found


def run(level: Level, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """Both raceways of B218 over the loads."""
    rows: list[Row] = []
    series = {}
    dofs = 0
    for race in RACES:
        groove = groove_contact(scene, race)
        shape, finite, turned = [], [], []
        for load in LOADS[level]:
            case = f"B218 {race}, Q = {load:.0f} N"
            compared, part = gap_rows(groove, load, case, level, progress)
            rows += compared
            shape.append(part)
            finite.append(finite_part(groove, load, ELEMENTS[level], progress))
            turned.append(finite_part(groove, load, ELEMENTS[level], progress, pressure_turns=True))
            exact = hertz(groove.problem(load))
            boundary = boundary_element.over_hertz(groove, load).ratio
            for name in ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure"):
                total = (1.0 + shape[-1][name] / 100.0) * (1.0 + finite[-1][name] / 100.0)
                if name in BODY_TOLERANCES:
                    rows.append(
                        Row(
                            f"{case}: true bodies, exact gap",
                            f"{name} over Hertz",
                            "1",
                            boundary[name],
                            boundary_element.SOURCE,
                            total,
                            None,
                            BODY_TOLERANCES[name],
                            "a tolerance set beforehand: the gap determines the ellipse, not the size of the bodies",
                        )
                    )
                rows.append(
                    Row(
                        f"{case}: true bodies",
                        name,
                        QUANTITIES[name],
                        getattr(exact, name),
                        HERTZ_SOURCE,
                        getattr(exact, name) * total,
                        None,
                        None,
                        f"a finding: gap shape {shape[-1][name]:+.3f} %, finite bodies {finite[-1][name]:+.3f} %; with "
                        f"the pressure along the deformed surface's normal {turned[-1][name]:+.3f} %",
                    )
                )
        added = np.array([part["added_approach"] for part in finite])
        loads = np.asarray(LOADS[level])
        slope = float(np.mean(added / loads))
        dofs = int(finite[-1]["dofs"])
        rows += [
            Row(
                f"B218 {race}: approach that the finite bodies add, over the load",
                f"at {load:.0f} N",
                "m/N",
                slope,
                "linear in load: the mean of all loads",
                float(value / load),
                None,
                LINEAR_TOLERANCE,
                "a tolerance set beforehand: the bodies' own compliance does not depend on the contact's size",
            )
            for load, value in zip(loads, added, strict=True)
        ]
        series[race] = {
            "load_N": list(LOADS[level]),
            "gap_shape_percent": {name: [part[name] for part in shape] for name in shape[0]},
            "finite_bodies_percent": {name: [part[name] for part in finite] for name in shape[0]},
            "pressure_turned_percent": {name: [part[name] for part in turned] for name in shape[0]},
            "added_approach_per_load": slope,
        }
    notes = [
        "Reference points of the approach: the ball's equator (plane of symmetry through its centre, sides free, as "
        "between two equal and opposite contacts), and infinity for the raceway (a block of 0.9 ball radii whose far "
        "faces move as a half-space's). Another convention moves the finite-body part of the approach, nothing else.",
        "Gap and pressure count along the contact's normal, as in Hertz's and the boundary elements' problem: what the "
        "true bodies then change is theirs alone. A pressure that turns with the surface the deformed bodies share is "
        "an effect of second order, which linear theory does not settle. Each finding states it beside the rest.",
    ]
    entry = {
        "elements_per_semi_axis": ELEMENTS[level],
        "dofs": dofs,
        "file": meshing.finite_body(ELEMENTS[level]).file_name,
    }
    solver = half_space_contact.condensed_bodies(
        groove_contact(scene, "inner").problem(1000.0), half_space_contact.SEQUENCES[level][-1]
    ).race.solver
    return Findings(rows, entry, solver, {"true_geometry": series}, notes)


CHECK = Check(
    name="true_geometry",
    question="True sphere and groove, finite bodies: how far is Hertz from them, at which load, and why?",
    kind=Kind.VALIDATION,
    reference="half-space boundary elements with the exact gap",
    tolerance="a 0.1 %, b 0.2 % of boundary elements, half-spaces and true bodies; finite-body approach linear in load "
    "within 5 %",
    run=run,
    largest_dofs=lambda level: max(groove_contacts.largest_dofs(level), meshing.finite_body(ELEMENTS[level]).dofs),
)
