"""The keys of [thermal] and of the tables within it."""

from __future__ import annotations

from qsbearing.model.scene.keys import Key, celsius
from qsbearing.model.solution.result_keys import NODES
from qsbearing.model.units import kg_m3, mm
from qsbearing.model.validation import DENSITY, LENGTH

THERMAL = (
    Key("heat_to_rings", "heat_to_rings"),
    Key("heat_at_inner", "heat_at_inner"),
    Key("ring_width_mm", "ring_width", "mm", mm, LENGTH),
    celsius("limit_temperature"),
)
WORDS = ("friction", "viscosity_at")
OIL = (
    Key("flow_cm3_min", "flow", "cm3/min", 1e-6 / 60.0),
    celsius("inlet_temperature"),
    Key("density_kg_m3", "density", "kg/m3", kg_m3, DENSITY),
    Key("specific_heat_J_kgK", "specific_heat", "J/(kg K)"),
)
BY_NODE = {
    "fixed": tuple(map(celsius, NODES)),
    "heats": tuple(Key(f"{node}_W", node, "W") for node in NODES),
    "heat_capacities": tuple(Key(f"{node}_J_per_K", node, "J/K") for node in NODES),
}
"""Tables with a number for each node."""
CONDUCTANCE = (Key("W_per_K", "conductance", "W/K"),)
CONDUCTANCES = "conductances"

NUMBERS = {"thermal": THERMAL, "oil": OIL, **BY_NODE, CONDUCTANCES: CONDUCTANCE}
SECTIONS = {name: tuple(key.name for key in keys) for name, keys in NUMBERS.items()}
SECTIONS["thermal"] += (*WORDS, *(name for name in NUMBERS if name != "thermal"))
SECTIONS[CONDUCTANCES] += ("between", "row")
"""Every key, by its table."""
