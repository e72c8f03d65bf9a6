"""The numbers that the report's pictures are drawn from, taken from a solved contact; kept in the record."""

from __future__ import annotations

from typing import Any

import numpy as np

from fem_check.independent.contact_problem import Array
from fem_check.independent.references import hertz
from fem_check.mechanics.contact import ContactSolution
from fem_check.mechanics.half_space_contact import Bodies


def _short(values: Array) -> list[float]:
    # Four digits are more than a picture shows, and keep the records small.
    return [float(f"{value:.4g}") for value in np.asarray(values).ravel()]


def contact_pictures(solution: ContactSolution, bodies: Bodies, label: str) -> dict[str, Any]:
    """Pressure over the ellipse, along both axes, shear in the plane x = 0, and the mesh's lines."""
    exact = hertz(solution.problem)
    a, b, p0 = exact.semi_major_axis, exact.semi_minor_axis, exact.max_pressure
    basis = solution.basis
    x = np.concatenate([basis.points[0] * length for length in solution.unit_lengths]) / a
    y = np.concatenate([basis.points[1] * length for length in solution.unit_lengths]) / b
    p = solution.pressures.T.ravel() / p0
    on_x, on_y = y < 1e-9, x < 1e-9
    middle = len(solution.unit_lengths) // 2
    length = float(solution.unit_lengths[middle])
    body = bodies.race
    points = body.stress_points * length / b
    near_plane = body.stress_points[0] < basis.lines_x[1] * 0.5  # the Gauss points next to the plane of symmetry
    stress = np.einsum("cph,h->cp", body.stresses[:, near_plane], solution.pressures[:, middle]) / p0
    # Largest shear of the three principal differences; x is principal by symmetry.
    mean = 0.5 * (stress[1] + stress[2])
    radius = np.hypot(0.5 * (stress[1] - stress[2]), stress[3])
    principal = np.stack([stress[0], mean + radius, mean - radius])
    shear = 0.5 * (principal.max(axis=0) - principal.min(axis=0))
    return {
        "contact": {
            "label": label,
            "name": solution.problem.name,
            "load_N": solution.problem.load,
            "a_mm": 1e3 * a,
            "b_mm": 1e3 * b,
            "p0_MPa": 1e-6 * p0,
            "ellipse": {"x": _short(x), "y": _short(y), "p": _short(p)},
            "along_x": {"x": _short(x[on_x]), "p": _short(p[on_x])},
            "along_y": {"y": _short(y[on_y]), "p": _short(p[on_y])},
            "shear": {"y": _short(points[1, near_plane]), "z": _short(points[2, near_plane]), "tau": _short(shear)},
            "max_shear_over_p0": exact.max_shear_stress / p0,
            "max_shear_depth_over_b": exact.max_shear_depth / b,
        },
        "mesh": mesh_lines(bodies),
    }


def mesh_lines(bodies: Bodies) -> dict[str, Any]:
    """Grid lines of the block along each axis, in semi-axes of the contact."""
    lines: dict[str, Any] = {}
    for axis, segments in zip("xyz", (bodies.recipe.x, bodies.recipe.y, bodies.recipe.z), strict=True):
        stations = [0.0]
        for segment in segments:
            steps = segment.growth ** np.arange(segment.elements)
            stations += list(stations[-1] + segment.length * np.cumsum(steps) / steps.sum())
        lines[axis] = _short(np.asarray(stations))
    lines["elements"] = bodies.recipe.elements
    return lines
