"""The numbers that the report's pictures are drawn from, taken from a solved contact; kept in the record."""

from __future__ import annotations

from typing import Any

import numpy as np

from fem_check.contact import ContactField
from fem_check.contact_problem import Array
from fem_check.half_space_contact import Bodies
from fem_check.references import hertz


def _short(values: Array) -> list[float]:
    # Four digits are more than a picture shows, and keep the records small.
    return [float(f"{value:.4g}") for value in np.asarray(values).ravel()]


def contact_pictures(field: ContactField, pair: Bodies, label: str) -> dict[str, Any]:
    """Pressure over the ellipse, along both axes, shear in the plane x = 0, and the mesh's lines."""
    exact = hertz(field.problem)
    a, b, p0 = exact.semi_major_axis, exact.semi_minor_axis, exact.max_pressure
    hats = field.hats
    x = np.concatenate([hats.points[0] * length for length in field.unit_lengths]) / a
    y = np.concatenate([hats.points[1] * length for length in field.unit_lengths]) / b
    p = field.pressures.T.ravel() / p0
    on_x, on_y = y < 1e-9, x < 1e-9
    middle = len(field.unit_lengths) // 2
    length = float(field.unit_lengths[middle])
    body = pair.race
    points = body.stress_points * length / b
    near_plane = body.stress_points[0] < hats.lines_x[1] * 0.5  # the Gauss points next to the plane of symmetry
    stress = np.einsum("cph,h->cp", body.stresses[:, near_plane], field.pressures[:, middle]) / p0
    # Largest shear of the three principal differences; x is principal by symmetry.
    mean = 0.5 * (stress[1] + stress[2])
    radius = np.hypot(0.5 * (stress[1] - stress[2]), stress[3])
    principal = np.stack([stress[0], mean + radius, mean - radius])
    shear = 0.5 * (principal.max(axis=0) - principal.min(axis=0))
    return {
        "contact": {
            "label": label,
            "name": field.problem.name,
            "load_N": field.problem.load,
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
        "mesh": mesh_lines(pair),
    }


def mesh_lines(pair: Bodies) -> dict[str, Any]:
    """Grid lines of the block along each axis, in semi-axes of the contact."""
    lines: dict[str, Any] = {}
    for axis, segments in zip("xyz", (pair.recipe.x, pair.recipe.y, pair.recipe.z), strict=True):
        stations = [0.0]
        for segment in segments:
            steps = segment.growth ** np.arange(segment.elements)
            stations += list(stations[-1] + segment.length * np.cumsum(steps) / steps.sum())
        lines[axis] = _short(np.asarray(stations))
    lines["elements"] = pair.recipe.elements
    return lines
