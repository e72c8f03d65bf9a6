"""What a scene gives of its heat: nodes, what conducts between them, what cools, and by which model friction heats."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from qsbearing.model.described import given_in
from qsbearing.model.solution.result_keys import NODES, OF_EACH_ROW
from qsbearing.model.units import zero_celsius
from qsbearing.model.validation import (
    DENSITY,
    LENGTH,
    RATIO,
    TEMPERATURE,
    ErrorDetail,
    Quantity,
    raise_if_any,
    within,
)

PALMGREN_NEEDS = "Palmgren's model needs it"
READING_OF = {"contacts": "friction", "skf": "friction_estimate", "palmgren": "friction_estimate"}
"""The models of friction, and the reading whose arguments each takes."""

LOWER_BOUND = ', with the friction model "contacts", a lower bound of the heat'
"""What verdicts add that rest on it."""

COLDEST, HOTTEST = 150.0, 800.0
"""Kelvin, of any temperature that is given: what catches mistakes of unit."""

CONDUCTANCE, POWER, CAPACITY = Quantity("W/K"), Quantity("W"), Quantity("J/K")


@dataclass(frozen=True)
class Conductance:
    """Heat flows between two nodes in proportion to the difference of their temperatures."""

    between: tuple[str, str]
    """The two nodes, by name."""
    conductance: float = field(metadata=given_in("W/K"))
    """[W/K]."""
    row: int | None = None
    """Of a set, the row that alone has it, from 1; None: every row, where a row's node is one of the two."""


@dataclass(frozen=True)
class OilFlow:
    """Oil that comes in at one temperature and leaves at that of the node `oil`: it takes away Q rho c (T - T_in)."""

    flow: float = field(metadata=given_in("cm3/min"))
    """Q [m^3/s]; of a set, of all rows together."""
    inlet_temperature: float = field(metadata=given_in("C"))
    """T_in [K]."""
    density: float = field(metadata=given_in("kg/m3"))
    """rho [kg/m^3]."""
    specific_heat: float = field(metadata=given_in("J/(kg K)"))
    """c [J/(kg K)]."""

    @property
    def conductance(self) -> float:
        """Q rho c [W/K]."""
        return self.flow * self.density * self.specific_heat

    def errors(self) -> list[ErrorDetail]:
        """Everything out of range."""
        errors = within("thermal.oil.flow", self.flow, Quantity("m^3/s"), 1e-10, 0.1)
        errors += _temperature("thermal.oil.inlet_temperature", self.inlet_temperature)
        errors += within("thermal.oil.density", self.density, DENSITY, 500.0, 2500.0)
        return errors + within("thermal.oil.specific_heat", self.specific_heat, Quantity("J/(kg K)"), 500.0, 6000.0)


@dataclass(frozen=True)
class Thermal:
    """Ask for the temperatures at which a bearing or a set runs. SI units, temperatures in kelvin.

    A node exists where anything names it. Its temperature is given (`fixed`) or found, and then becomes that of the
    same part in ring expansion, in ball expansion and of the lubricant, where the scene names these.

    Raises:
        SceneError: every error, at once.
    """

    conductances: tuple[Conductance, ...]
    fixed: Mapping[str, float] = field(default_factory=dict)
    """Nodes whose temperatures are given [K], such as ambient."""
    oil: OilFlow | None = None
    """What flows through the bearing and carries heat away; None: none."""
    friction: str = "contacts"
    """Which model makes the heat, with the arguments of its reading: contacts, skf or palmgren."""
    heat_to_rings: float = field(default=0.5, metadata=given_in())
    """Part of a contact's heat that goes into its ring [-]; the rest goes into the ball."""
    heat_at_inner: float = field(default=0.5, metadata=given_in())
    """Part of a whole bearing's friction that is made at the inner contacts, where the model does not say it [-]."""
    heats: Mapping[str, float] = field(default_factory=dict)
    """What else heats a node [W], such as a motor the shaft; of a row's node, in each row."""
    heat_capacities: Mapping[str, float] = field(default_factory=dict)
    """Of nodes [J/K], for heating up in time; those of rings and balls follow from geometry where they are left out."""
    ring_width: float | None = field(default=None, metadata=given_in("mm"))
    """Of both rings [m]: for their heat capacities, and nothing else."""
    viscosity_at: str | None = None
    """The node at whose temperature the lubricant's viscosity is taken; None: the oil, where there is such a node."""
    limit_temperature: float = field(default=150.0 + zero_celsius, metadata=given_in("C"))
    """Above which no steady state is looked for [K]."""

    def __post_init__(self) -> None:
        wrong = self._structure_errors() or self._array_errors()
        raise_if_any(wrong or self._number_errors() + self._path_errors())

    @property
    def nodes(self) -> tuple[str, ...]:
        """Those that exist, in the order of `NODES`."""
        named = {*self.fixed, *self.heats, *(() if self.oil is None else ("oil",))}
        named |= {end for each in self.conductances for end in each.between}
        return tuple(node for node in NODES if node in named)

    @property
    def bound(self) -> str:
        """What a sentence on its temperatures adds where the friction model leaves heat out; else nothing."""
        return LOWER_BOUND if self.friction == "contacts" else ""

    @property
    def found_nodes(self) -> tuple[str, ...]:
        """Those whose temperatures the heat balance finds."""
        return tuple(node for node in self.nodes if node not in self.fixed)

    @property
    def oil_node(self) -> str | None:
        """The node at whose temperature viscosity is taken; None: it stays at the lubricant's own."""
        return self.viscosity_at or ("oil" if "oil" in self.nodes else None)

    def errors(self, readings: Sequence[Mapping[str, Any]]) -> list[ErrorDetail]:
        """What does not suit a bearing or a set that asks each of its rows for these readings: the friction's
        arguments missing, rows that are not there."""
        errors = [each for own in readings for each in self._friction_errors(own)][:1]
        for number, each in enumerate(self.conductances, 1):
            if each.row is not None and not 1 <= each.row <= len(readings):
                path = f"thermal.conductances {number}.row"
                errors.append(ErrorDetail(path, f"is not a row of the set (1 to {len(readings)})", each.row))
        return errors

    def _friction_errors(self, readings: Mapping[str, Any]) -> list[ErrorDetail]:
        errors = []
        needed = READING_OF[self.friction]
        if needed not in readings:
            cause = f"Give [readings.{needed}] (in Python readings = {{{needed!r}: {{...}}}}), whose numbers it uses"
            errors.append(ErrorDetail("thermal.friction", "has no numbers to compute from", self.friction, cause=cause))
        elif self.friction == "palmgren":
            for name in ("static_load_rating", "lubrication_factor"):
                if readings[needed].get(name) is None:
                    errors.append(ErrorDetail(f"readings.{needed}.{name}", "missing", detail=PALMGREN_NEEDS))
        return errors

    def _structure_errors(self) -> list[ErrorDetail]:
        errors = []
        for number, each in enumerate(self.conductances, 1):
            path = f"thermal.conductances {number}"
            if len(each.between) != 2 or each.between[0] == each.between[1]:
                cause = 'Write between = ["inner_ring", "balls"]'
                errors.append(ErrorDetail(f"{path}.between", "are not two nodes", list(each.between), cause=cause))
            errors += _unknown_nodes(f"{path}.between", each.between)
            if each.row is not None and not set(each.between) & set(OF_EACH_ROW):
                errors.append(ErrorDetail(f"{path}.row", "is given, but neither node is a row's", each.row))
        for name in ("fixed", "heats", "heat_capacities"):
            errors += _unknown_nodes(f"thermal.{name}", getattr(self, name))
        if self.viscosity_at is not None:
            errors += _unknown_nodes("thermal.viscosity_at", (self.viscosity_at,))
        if self.friction not in READING_OF:
            cause = f"One of {', '.join(READING_OF)}"
            errors.append(ErrorDetail("thermal.friction", "is not a friction model", self.friction, cause=cause))
        return errors

    def _array_errors(self) -> list[ErrorDetail]:
        numbers = {f"conductances {n}.conductance": each.conductance for n, each in enumerate(self.conductances, 1)}
        for name in ("fixed", "heats", "heat_capacities"):
            numbers |= {f"{name}.{node}": value for node, value in getattr(self, name).items()}
        numbers |= {} if self.oil is None else {f"oil.{name}": value for name, value in vars(self.oil).items()}
        numbers |= {name: getattr(self, name) for name in ("heat_to_rings", "heat_at_inner", "limit_temperature")}
        cause = "All cases share one network: solve a scene for each value, or vary loads and speeds"
        return [ErrorDetail(f"thermal.{path}", "is an array", cause=cause) for path, x in numbers.items() if np.ndim(x)]

    def _number_errors(self) -> list[ErrorDetail]:
        errors = []
        for number, each in enumerate(self.conductances, 1):
            errors += within(f"thermal.conductances {number}.conductance", each.conductance, CONDUCTANCE, 1e-6, 1e6)
        for node, value in self.fixed.items():
            errors += _temperature(f"thermal.fixed.{node}", value)
        for node, value in self.heats.items():
            errors += within(f"thermal.heats.{node}", value, POWER, -1e6, 1e6)
        for node, value in self.heat_capacities.items():
            errors += within(f"thermal.heat_capacities.{node}", value, CAPACITY, 1e-3, 1e9)
        for name in ("heat_to_rings", "heat_at_inner"):
            errors += within(f"thermal.{name}", getattr(self, name), RATIO, 0.0, 1.0)
        if self.ring_width is not None:
            errors += within("thermal.ring_width", self.ring_width, LENGTH, 1e-4, 1.0)
        errors += _temperature("thermal.limit_temperature", self.limit_temperature)
        return errors + ([] if self.oil is None else self.oil.errors())

    def _path_errors(self) -> list[ErrorDetail]:
        """Nodes that are missing, and those from which no heat gets away."""
        errors = []
        for node in ("inner_ring", "outer_ring"):
            if node not in self.nodes:
                cause = f'Give a conductance between "{node}" and another node'
                errors.append(ErrorDetail("thermal.conductances", f"do not lead to {node}", cause=cause))
        if self.viscosity_at is not None and self.viscosity_at not in self.nodes:
            errors.append(ErrorDetail("thermal.viscosity_at", "is a node that has no other use", self.viscosity_at))
        if "oil" in self.fixed and self.oil is not None:
            cause = "Leave one of the two out: the oil's inlet temperature, or the temperature of the node"
            errors.append(ErrorDetail("thermal.fixed.oil", "is given together with the flow of oil", cause=cause))
        cooled = {*self.fixed, *(() if self.oil is None else ("oil",))}
        for _ in self.nodes:
            cooled |= {end for each in self.conductances if cooled & set(each.between) for end in each.between}
        if set(self.nodes) <= set(self.fixed):
            errors.append(ErrorDetail("thermal.fixed", "gives every temperature, so that none is left to find"))
        if stuck := [node for node in self.nodes if node not in cooled]:
            cause = "Conductances must lead from every node to a fixed temperature or to the flow of oil"
            errors.append(ErrorDetail("thermal.conductances", f"let no heat out of {', '.join(stuck)}", cause=cause))
        return errors


def _temperature(path: str, value: Any) -> list[ErrorDetail]:
    meaning = "is not a plausible temperature of a bearing" if isinstance(value, float | int) else ""
    return within(path, value, TEMPERATURE, COLDEST, HOTTEST, meaning)


def _unknown_nodes(path: str, names: Iterable[str]) -> Iterator[ErrorDetail]:
    for name in names:
        if name not in NODES:
            yield ErrorDetail(path, "is not a node", name, cause=f"One of {', '.join(NODES)}")
