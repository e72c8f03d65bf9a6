"""The heat balance of a network: its free nodes, and their temperatures by the heat that friction makes.

    K T = S P + q + K_f T_f          steady
    C dT/dt = S P + q + K_f T_f - K T

with K the conductances among the free nodes (the flow of oil on the diagonal of its node), T_f the given temperatures,
S how the sources' powers P divide among the nodes, q what else heats them. So the temperatures of the steady state are
linear in the powers, and only these, one to three a row, are unknown.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.result_keys import OF_EACH_ROW
from qsbearing.systems.heat.network import Thermal
from qsbearing.systems.heat.state import NetworkPart

INLET = NetworkPart("oil inlet")
"""What the oil's flow leads to, among the paths of heat."""


def own_name(node: str, row: int, rows: int) -> NetworkPart:
    """A node of one row, or a shared one."""
    return NetworkPart(node, row if rows > 1 and node in OF_EACH_ROW else None)


class HeatBalance:
    """Nodes and equations of a network with so many rows, each with these sources of heat."""

    def __init__(self, thermal: Thermal, sources: Sequence[tuple[str, ...]]) -> None:
        rows = len(sources)
        self.thermal, self.rows = thermal, rows
        names = dict.fromkeys(
            own_name(node, row, rows) for node in thermal.nodes for row in range(rows if node in OF_EACH_ROW else 1)
        )
        self.fixed = {own_name(node, row, rows): value for node, value in thermal.fixed.items() for row in range(rows)}
        self.free = tuple(name for name in names if name not in self.fixed)
        self.sources = tuple((row, source) for row in range(rows) for source in sources[row])
        if thermal.oil is not None:
            self.fixed[INLET] = thermal.oil.inlet_temperature
        self.paths = self._paths()
        """(node, node, conductance) of every path of heat."""
        self._index = {name: number for number, name in enumerate(self.free)}
        self.matrix, self.given = self._matrix()
        """K of the free nodes; and q + K_f T_f."""
        self.shares = self._shares()
        """S; shape (free node, source)."""

    @property
    def source_names(self) -> tuple[NetworkPart, ...]:
        """Of the sources, in their order."""
        return tuple(NetworkPart(source, row if self.rows > 1 else None) for row, source in self.sources)

    def _paths(self) -> tuple[tuple[NetworkPart, NetworkPart, float], ...]:
        conductances: dict[tuple[NetworkPart, NetworkPart], float] = {}
        for each in self.thermal.conductances:
            is_of_rows = bool(set(each.between) & set(OF_EACH_ROW))
            for row in range(self.rows) if is_of_rows else (0,):
                if each.row is None or each.row == row + 1:
                    one, other = (own_name(node, row, self.rows) for node in each.between)
                    key = (other, one) if (other, one) in conductances else (one, other)
                    conductances[key] = conductances.get(key, 0.0) + each.conductance
        if self.thermal.oil is not None:
            conductances[NetworkPart("oil"), INLET] = self.thermal.oil.conductance
        return tuple((*ends, conductance) for ends, conductance in conductances.items())

    def _matrix(self) -> tuple[NDArray, NDArray]:
        matrix, given = np.zeros((len(self.free), len(self.free))), np.zeros(len(self.free))
        for one, other, conductance in self.paths:
            for here, there in ((one, other), (other, one)):
                if here in self._index:
                    matrix[self._index[here], self._index[here]] += conductance
                    if there in self._index:
                        matrix[self._index[here], self._index[there]] -= conductance
                    else:
                        given[self._index[here]] += conductance * self.fixed[there]
        for node, heat in self.thermal.heats.items():
            for name in {own_name(node, row, self.rows) for row in range(self.rows)} & set(self.free):
                given[self._index[name]] += heat
        return matrix, given

    def _shares(self) -> NDArray:
        """A contact's heat goes into its ring and the balls; where there are no balls, all into the ring. Drag goes
        into the oil, where there is oil, else the balls, else half into each ring."""
        own, thermal = self._index, self.thermal
        shares = np.zeros((len(self.free), len(self.sources)))
        to_rings = thermal.heat_to_rings if "balls" in thermal.nodes else 1.0
        drag = next((node for node in ("oil", "balls") if node in thermal.nodes), None)
        for column, (row, source) in enumerate(self.sources):
            inner = {"inner contacts": 1.0, "outer contacts": 0.0}.get(source, thermal.heat_at_inner)
            parts = {"inner_ring": inner * to_rings, "outer_ring": (1.0 - inner) * to_rings, "balls": 1.0 - to_rings}
            if source == "drag":
                parts = {"inner_ring": 0.5, "outer_ring": 0.5} if drag is None else {drag: 1.0}
            for node, part in parts.items():
                name = own_name(node, row, self.rows)
                if name in own:
                    shares[own[name], column] += part
        return shares

    def temperatures(self, powers: NDArray) -> NDArray:
        """Of the free nodes where these powers are carried off, as a steady state does.

        Args:
            powers: shape (source, *cases) [W].
        """
        heat = np.tensordot(self.shares, powers, 1)
        heat += self.given.reshape(-1, *[1] * (powers.ndim - 1))
        return np.linalg.solve(self.matrix, heat.reshape(len(self.free), -1)).reshape(heat.shape)

    def named(self, temperatures: NDArray) -> dict[NetworkPart, NDArray]:
        """Of all nodes, by name; shape (*cases) each."""
        shape = temperatures.shape[1:]
        of_free = {name: np.asarray(temperatures[number]) for number, name in enumerate(self.free)}
        return of_free | {name: np.full(shape, value) for name, value in self.fixed.items() if name != INLET}

    def net_heat(self, temperatures: NDArray, powers: NDArray) -> NDArray:
        """What each free node takes in beyond what it gives off [W]; shape (free node, *cases); zero if steady."""
        given = self.given.reshape(-1, *[1] * (powers.ndim - 1))
        return np.asarray(np.tensordot(self.shares, powers, 1) + given - np.tensordot(self.matrix, temperatures, 1))

    def flows(self, temperatures: Mapping[NetworkPart, NDArray]) -> dict[tuple[NetworkPart, NetworkPart], NDArray]:
        """Heat on each path from its first node to its second [W]."""
        known = {name: np.asarray(value) for name, value in (*self.fixed.items(), *temperatures.items())}
        return {(one, other): np.asarray(G * (known[one] - known[other])) for one, other, G in self.paths}
