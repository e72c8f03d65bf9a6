"""The axes of a bearing against those of its shaft, and of a scene against both.

REXS has u along the axis and v, w across it, each component its own; a set has x, y, z along u, v, w of its shaft. A
bearing may point against its shaft and be turned about it. A single bearing is solved with +x in the direction of the
load that it carries: in -u as the mirror image in a plane across the shaft, which leaves y, z and the speed.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.file_errors import FileErrorDetail
from qsbearing.files.rexs.model import Component
from qsbearing.files.rexs.reader import AttributeReader

ALONG = 1e-6
"""By how much a bearing's axis may lie off its shaft's (chosen: vectors are written with some digits)."""


def turned(reader: AttributeReader, bearing: Component, shaft: Component | None) -> NDArray:
    """What takes loads and displacements (x, y, z, about y, about z) from the shaft's axes to the bearing's; (5, 5)."""
    within = reader.whole(bearing, "reference_component_for_position")
    own, other = unit_vectors(reader, bearing), np.eye(3)
    if shaft is not None and within != shaft.number:
        other = unit_vectors(reader, shaft)
    turn = np.eye(5)
    rotation = own @ other.T
    if abs(abs(rotation[0, 0]) - 1.0) > ALONG:
        path = f"{bearing}: u_axis_vector"
        error = FileErrorDetail(path, f"is not along the axis of {shaft}", own[0].round(9).tolist())
        reader.errors += [] if error in reader.errors else [error]
        return turn
    turn[:3, :3], turn[3:, 3:] = rotation, rotation[1:, 1:]
    return np.where(np.abs(turn) > ALONG, turn, 0.0)


def unit_vectors(reader: AttributeReader, component: Component) -> NDArray:
    """Unit vectors u, v, w as rows; those of the whole model where the component states none."""
    given = [reader.array(component, f"{name}_axis_vector") for name in "uw"]
    u, w = (None if each is None else np.asarray(each, float) for each in given)
    if u is None or u.shape != (3,) or not u.any():
        return np.eye(3)
    u = u / np.abs(u).max()  # first, for a number may be so large that its square is none
    u = u / np.linalg.norm(u)
    if w is None or w.shape != (3,) or not w.any():
        w = np.array([0.0, 0.0, 1.0]) if abs(u[2]) < 0.9 else np.array([0.0, 1.0, 0.0])
    w = w / np.abs(w).max()
    w = w - (w @ u) * u
    if not np.linalg.norm(w) > ALONG:
        return np.eye(3)
    w = w / np.linalg.norm(w)
    return np.stack([u, np.cross(w, u), w])
