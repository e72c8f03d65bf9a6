"""Makes `values.json`: contacts with the exact gap of ball and groove by the boundary-element library tamaas.

    pip install tamaas
    python -m fem_check.boundary_element.generate

tamaas (L. Frerot et al., J. Open Source Software 5, 2020) solves the normal contact of half-spaces with piecewise
constant pressure on a regular grid, by Polonsky & Keer's conjugate gradients, with a non-periodic convolution. Nothing
of it is shared with the finite elements. Each contact is solved twice on one grid, with the exact gap and with its
parabola; the parabola's solution is Hertz's, so the ratio of the two is free of most of the grid's own error, and its
difference to Hertz, kept too, shows how large that error is.
"""

from __future__ import annotations

import importlib.metadata
import json
from math import radians
from pathlib import Path
from typing import Any

import numpy as np

from fem_check.contact_problem import ContactProblem, ElasticConstants, GapFunction
from fem_check.groove import RACES, BallInGroove
from fem_check.references import hertz

FILE = Path(__file__).parent / "values.json"
LOADS = (50.0, 500.0, 2000.0, 5000.0)
POINTS = 256
"""Along each side of the grid, which spans 2.5 by 2.5 semi-axes: 102 a semi-axis."""
SPAN = 2.5
CONFORMITIES = (0.505, 0.51, 0.515, 0.53, 0.56)
CONFORMITY_LOAD = 2000.0
STEEL = ElasticConstants(208e9, 0.3)
# B218 as its published table has it; the check compares these lengths with the scene's before it trusts the values.
B218 = {
    "ball_diameter": 22.225e-3,
    "groove_radius": 11.6281e-3,
    "pitch_diameter": 125.26e-3,
    "contact_angle": radians(40.0),
}


def solve(problem: ContactProblem, gap: GapFunction, a: float, b: float) -> dict[str, float]:
    """Approach and semi-axes (from the pressure's moments) of one contact."""
    import tamaas as tm

    size = [SPAN * a, SPAN * b]
    x, y = ((np.arange(POINTS) + 0.5) / POINTS * length - 0.5 * length for length in size)
    heights = np.asarray(gap(*np.meshgrid(x, y, indexing="ij")))
    compliance = problem.ball.compliance + problem.race.compliance
    # Lengths over b and pressures over E*: numbers near one, for the solver's absolute tolerances.
    model = tm.Model(tm.model_type.basic_2d, [length / b for length in size], [POINTS, POINTS])
    model.E, model.nu = 1.0, 0.0
    tm.ModelFactory.registerNonPeriodic(model, "dcfft")
    solver = tm.PolonskyKeerRey(model, -heights / b, 1e-9)
    solver.setIntegralOperator("dcfft")
    area = size[0] * size[1]
    solver.solve(problem.load * compliance / area)
    pressure = np.array(model.traction).reshape(POINTS, POINTS)
    # The solver leaves the displacement without its mean; the operator itself gives it measured from infinity.
    model.operators["dcfft"](model.traction, model.displacement)
    moved = np.asarray(model.displacement).reshape(POINTS, POINTS) * b
    total = pressure.sum()
    inside = pressure > 0.1 * pressure.max()
    return {
        "approach": float((moved + heights)[inside].mean()),
        "semi_major_axis": float(np.sqrt(5.0 * np.sum(pressure.sum(axis=1) * x**2) / total)),
        "semi_minor_axis": float(np.sqrt(5.0 * np.sum(pressure.sum(axis=0) * y**2) / total)),
    }


def main() -> None:
    """Make the file."""
    cases: list[dict[str, Any]] = []
    wanted = [(race, B218["groove_radius"] / B218["ball_diameter"], load) for race in RACES for load in LOADS]
    wanted += [("inner", coefficient, CONFORMITY_LOAD) for coefficient in CONFORMITIES]
    for race, coefficient, load in wanted:
        lengths = B218 | {"groove_radius": coefficient * B218["ball_diameter"]}
        groove = BallInGroove("B218", race, ball=STEEL, race=STEEL, **lengths)
        problem = groove.problem(load)
        exact = hertz(problem)
        true = solve(problem, groove.gap, exact.semi_major_axis, exact.semi_minor_axis)
        parabola = solve(problem, problem.parabolic_gap, exact.semi_major_axis, exact.semi_minor_axis)
        ratio = {name: true[name] / parabola[name] for name in true}
        ratio["max_pressure"] = 1.0 / (ratio["semi_major_axis"] * ratio["semi_minor_axis"])
        grid = {name: 100.0 * (parabola[name] / getattr(exact, name) - 1.0) for name in parabola}
        cases.append(
            {
                "race": race,
                "groove_radius_coefficient": coefficient,
                "load_N": load,
                "over_hertz": ratio,
                "grid_error_percent": grid,
            }
        )
    entry = {
        "library": f"tamaas {importlib.metadata.version('tamaas')}",
        "points": POINTS,
        "span_in_semi_axes": SPAN,
        "bearing": B218,
        "elastic_modulus": STEEL.elastic_modulus,
        "poisson_ratio": STEEL.poisson_ratio,
        "cases": cases,
    }
    FILE.write_text(json.dumps(entry, indent=1) + "\n")


if __name__ == "__main__":
    main()
