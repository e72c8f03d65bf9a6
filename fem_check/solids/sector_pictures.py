"""The numbers that the sector's pictures are drawn from: the meshed bodies' surfaces, pressure and gap of a contact."""

from __future__ import annotations

from typing import Any

import numpy as np

from fem_check.independent.contact_problem import Array
from fem_check.solids.bearing_sector import BearingSector, SectorResults
from fem_check.solids.body_mesh import BodyMesh
from fem_check.solids.contact_frame import ContactFrame

RACES = ("inner", "outer")


def of_sector(sector: BearingSector, results: SectorResults, label: str) -> dict[str, Any]:
    """All that is drawn of one solved case, lengths in mm, pressures in MPa, gaps in um."""
    pressures = dict(zip(RACES, results.pressures, strict=True))
    frames = dict(zip(RACES, sector.geometry.frames, strict=True))
    bodies = {}
    for name in ("ball", *RACES):
        mesh = sector.geometry.mesh(name)
        touching = RACES if name == "ball" else (name,)
        bodies[name] = _surface(mesh, [(frames[race], pressures[race], name == "ball") for race in touching])
    contacts = {}
    for race, gap in zip(RACES, results.gaps, strict=True):
        x, y = frames[race].basis.points
        contacts[race] = {
            "x": _short(1e3 * x),
            "y": _short(1e3 * y),
            "p": _short(1e-6 * pressures[race]),
            "gap": _short(1e6 * gap),
            "load_N": getattr(results, race).load,
        }
    return {"label": label, "bodies": bodies, "contacts": contacts}


def _surface(mesh: BodyMesh, contacts: list[tuple[ContactFrame, Array, bool]]) -> dict[str, Any]:
    """Outer triangles of a mesh, with the pressure on each of their corners."""
    corners = np.sort(
        np.concatenate([mesh.tetrahedra[list(face)] for face in ((0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3))], axis=1),
        axis=0,
    )
    triangles, count = np.unique(corners, axis=1, return_counts=True)
    triangles = triangles[:, count == 1]  # a face inside belongs to two elements
    kept, numbered = np.unique(triangles, return_inverse=True)
    points = mesh.points[:, kept]
    pressure = sum(
        frame.pressure_on(points, coefficients, on_ball=on_ball) for frame, coefficients, on_ball in contacts
    )
    return {
        "points": [_short(1e3 * axis) for axis in points],
        "triangles": numbered.reshape(triangles.shape).T.tolist(),
        "pressure": _short(1e-6 * np.asarray(pressure)),
    }


def _short(values: Array) -> list[float]:
    # Five digits are more than a picture shows, and keep the records small.
    return [float(f"{value:.5g}") for value in np.asarray(values).ravel()]
