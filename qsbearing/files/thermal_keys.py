"""The keys of [thermal] and of the tables within it; loaded for heat and errors only."""

from __future__ import annotations

from qsbearing.files.keys import key_of, keys_of, named
from qsbearing.model.described import number
from qsbearing.model.solution.result_keys import NODES
from qsbearing.systems.heat.network import Conductance, OilFlow, Thermal

THERMAL, OIL, CONDUCTANCE = keys_of(Thermal), keys_of(OilFlow), keys_of(Conductance)
WORDS = ("friction", "viscosity_at")
BY_NODE = {
    name: tuple(key_of(number(node, unit)) for node in NODES)
    for name, unit in (("fixed", "C"), ("heats", "W"), ("heat_capacities", "J/K"))
}
"""Tables with a number for each node."""
CONDUCTANCES = "conductances"

THERMAL_NUMBERS = {"thermal": THERMAL, "oil": OIL, **BY_NODE, CONDUCTANCES: CONDUCTANCE}
THERMAL_SECTIONS = {name: named(keys) for name, keys in THERMAL_NUMBERS.items()}
THERMAL_SECTIONS["thermal"] += (*WORDS, *(name for name in THERMAL_NUMBERS if name != "thermal"))
THERMAL_SECTIONS[CONDUCTANCES] += ("between", "row")
"""Every key, by its table."""
