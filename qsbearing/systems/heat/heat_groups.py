"""The results of a heat balance, in groups of what has them; nodes of each row of a set with its number."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from qsbearing.model.solution.groups import STEADY
from qsbearing.model.solution.result_keys import Group, Result, in_name
from qsbearing.systems.heat.balance import INLET, HeatBalance
from qsbearing.systems.heat.network import Thermal
from qsbearing.systems.heat.state import NetworkPart, ThermalState
from qsbearing.systems.heat.steady import sources_of

WHOLE = Group(
    (
        Result("imbalance", "W", entry="imbalance_W", is_usual=False),
        Result("feedback", words="by how much a further watt of heat makes friction grow", is_usual=False),
    ),
    prefix="steady", holder="thermal", table=("thermal",),
)  # fmt: skip


class NetworkNames(NamedTuple):
    """Those of a balance that nothing is known of yet."""

    temperatures: tuple[NetworkPart, ...]
    powers: tuple[NetworkPart, ...]
    flows: tuple[tuple[NetworkPart, NetworkPart], ...]


def names_of(thermal: Thermal | None, readings: Sequence[Mapping[str, Any]]) -> NetworkNames | None:
    """Nodes, sources and paths before anything is solved.

    Args:
        readings: of each row.
    """
    if thermal is None:
        return None
    balance = HeatBalance(thermal, [sources_of(thermal.friction, own) for own in readings])
    nodes = (*balance.free, *(node for node in balance.fixed if node != INLET))
    return NetworkNames(nodes, balance.source_names, tuple((one, other) for one, other, _ in balance.paths))


def groups_of_heat(state: ThermalState | NetworkNames | None) -> list[Group]:
    """What a balance has besides `STEADY`: other nodes, sources, paths; nothing without one."""
    if state is None:
        return []
    known = {each.entry for each in STEADY.results}
    nodes, *others = recorded_groups(state)
    return [nodes._replace(results=tuple(each for each in nodes.results if each.entry not in known)), *others]


def recorded_groups(state: ThermalState | NetworkNames) -> list[Group]:
    """All that a balance has: nodes, sources, paths, and numbers of the whole."""
    nodes = _one_each(state.temperatures, "temperature", "C", "temperatures_C", "temperatures")
    sources = _one_each(state.powers, "power", "W", "powers_W", "powers")
    flows = tuple(
        Result(
            f"heat_{in_name(one)}_to_{in_name(other)}",
            "W",
            path=((one, other),),
            is_usual=False,
            entry=f"{one}>{other}",
        )
        for one, other in state.flows
    )
    paths = Group(flows, prefix="steady", holder="thermal.flows", table=("thermal", "flows_W"))
    return [nodes, sources, paths, WHOLE]


def _one_each(parts: Iterable[NetworkPart], what: str, unit: str, table: str, holder: str) -> Group:
    results = tuple(Result(f"{in_name(part)}_{what}", unit, path=(part,), entry=part, is_usual=False) for part in parts)
    return Group(results, prefix="steady", holder=f"thermal.{holder}", table=("thermal", table))
