"""Heat capacities of nodes: given, or by the volumes that a bearing's geometry says.

Rings are annuli from their seats to the bottoms of their grooves, as wide as `Thermal.ring_width` says, without what
shoulders add and grooves take away. Specific heats are usual handbook values, 460 J/(kg K) of bearing steel and 800 of
silicon nitride, which is told by its density.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import pi

import numpy as np

from qsbearing.model.effects import RingExpansion
from qsbearing.model.material import Material
from qsbearing.model.scene.scene import Scene
from qsbearing.model.validation import ErrorDetail, SceneError
from qsbearing.systems.heat.balance import HeatBalance, own_name

STEEL, CERAMIC = 460.0, 800.0
CERAMIC_BELOW = 5000.0
"""kg/m^3."""


def heat_capacities(balance: HeatBalance, scenes: Sequence[Scene]) -> list[float]:
    """Of the free nodes, in their order [J/K].

    Args:
        scenes: of each row.

    Raises:
        SceneError: nodes whose capacity neither the network nor the geometry gives; all at once.
    """
    thermal = balance.thermal
    known: dict[str, float] = {}
    for row, scene in enumerate(scenes):
        of_row = _of_geometry(scene, thermal.ring_width)
        known |= {own_name(node, row, balance.rows): value for node, value in of_row.items()}
    for node, value in thermal.heat_capacities.items():
        known |= {own_name(node, row, balance.rows): value for row in range(balance.rows)}
    missing = dict.fromkeys(name.kind for name in balance.free if name not in known)
    if missing:
        cause = "Heating up needs it [J/K]; that of a ring follows from thermal.ring_width with ring expansion"
        raise SceneError([ErrorDetail(f"thermal.heat_capacities.{node}", "missing", cause=cause) for node in missing])
    return [float(known[name]) for name in balance.free]


def _of_geometry(scene: Scene, width: float | None) -> dict[str, float]:
    bearing, rings = scene.bearing, scene.ring_expansion
    ball = pi / 6.0 * float(bearing.ball_diameter) ** 3  # type: ignore[arg-type]
    capacities = {"balls": float(bearing.ball_count) * ball * _per_volume(bearing.ball_material)}  # type: ignore[arg-type]
    if rings is None or width is None:
        return capacities
    return capacities | _of_rings(scene, rings, width)


def _of_rings(scene: Scene, rings: RingExpansion, width: float) -> dict[str, float]:
    bearing = scene.bearing
    bottoms = {
        "inner_ring": bearing.inner_groove_centre_radius - np.asarray(bearing.inner_groove_radius, float),
        "outer_ring": bearing.outer_groove_centre_radius + np.asarray(bearing.outer_groove_radius, float),
    }
    seats = {"inner_ring": rings.bore_diameter, "outer_ring": rings.outside_diameter}
    return {
        ring: abs(float(bottoms[ring]) ** 2 - 0.25 * float(seats[ring]) ** 2)  # type: ignore[arg-type]
        * pi * width * _per_volume(bearing.ring_material)
        for ring in bottoms
    }  # fmt: skip


def _per_volume(material: Material) -> float:
    """[J/(m^3 K)]."""
    density = float(material.density)  # type: ignore[arg-type]
    return density * (CERAMIC if density < CERAMIC_BELOW else STEEL)
