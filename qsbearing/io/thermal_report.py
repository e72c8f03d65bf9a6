"""Temperatures and heat of a solution as plain data, the object under "thermal" of `run --json`, and as tables."""

from __future__ import annotations

from typing import Any

import numpy as np
from rich.console import RenderableType
from rich.text import Text

from qsbearing.io.readings_record import number
from qsbearing.io.tables import digits_of, plain_table
from qsbearing.solution.case_index import Place
from qsbearing.thermal.state import ThermalState
from qsbearing.units import zero_celsius


def thermal_record(state: ThermalState, index: Place = ()) -> dict[str, Any]:
    """One case; None stands for a number that there is not."""
    thermal = state.thermal
    return {
        "verdict": str(state.verdict[index]),
        "message": state.message(index),
        "friction": thermal.friction,
        "temperatures_C": {name: number(value[index] - zero_celsius) for name, value in state.temperatures.items()},
        "powers_W": {name: number(value[index]) for name, value in state.powers.items()},
        "flows_W": [
            {"from": one, "to": other, "heat_W": number(np.asarray(value)[index])}
            for (one, other), value in state.flows.items()
        ],
        "imbalance_W": number(state.imbalance[index]),
        "feedback": number(state.feedback[index]),
        "limit_C": thermal.limit_temperature - zero_celsius,
        "solves": state.solves,
    }


def thermal_tables(found: dict[str, Any]) -> list[RenderableType]:
    """What a record says of a steady state: nodes, paths, and the verdict."""
    nodes = plain_table("Steady state", ("node", "temperature C"))
    for name, value in found["temperatures_C"].items():
        nodes.add_row(name.replace("_", " "), digits_of(value))
    heat = plain_table("Heat", ("made by, or from", "to", "W"), left=(0, 1))
    for name, value in found["powers_W"].items():
        heat.add_row(f"{name} ({found['friction']})", "", digits_of(value))
    for path in found["flows_W"]:
        heat.add_row(path["from"].replace("_", " "), path["to"].replace("_", " "), digits_of(path["heat_W"]))
    return [nodes, heat, Text(found["message"])]
