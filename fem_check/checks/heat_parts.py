"""Heat, as `solution_parts` judges it: which ring a contact heats, what every node gives off, what warm bodies do.

The balance of each node is written out here from what the network is given, friction is summed over the contacts'
areas, and the bearing at its temperatures is solved once more with these as given ones.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import pi
from typing import Any

import numpy as np

import qsbearing as qs
from fem_check.checks.product_scenes import ALUMINIUM, B218, BOTH, CELSIUS, MINUS
from fem_check.independent.sliding import mean_speed
from fem_check.product.scenes import drawing_of
from fem_check.rows.agreement import EXAMPLE, AgreementRow
from fem_check.rows.compared import compared
from qsbearing.systems.heat.network import Conductance, OilFlow, Thermal

MU, TO_RINGS, SPEED = 0.05, 0.65, 6000.0 * qs.rpm
DRAG, MIST = 1.1, 6.0
PATHS = {
    ("inner_ring", "balls"): 21.0, ("outer_ring", "balls"): 27.0, ("inner_ring", "shaft"): 35.0,
    ("outer_ring", "housing"): 45.0, ("housing", "ambient"): 17.0, ("shaft", "ambient"): 9.0, ("balls", "oil"): 13.0,
}  # fmt: skip
"""All unlike [W/K]."""
AMBIENT, MOTOR = CELSIUS + 24.0, 30.0
OIL = OilFlow(2.5e-6, CELSIUS + 35.0, 860.0, 1950.0)
THERMAL = Thermal(
    tuple(Conductance(ends, value) for ends, value in PATHS.items()), {"ambient": AMBIENT}, OIL,
    heat_to_rings=TO_RINGS, heats={"shaft": MOTOR},
)  # fmt: skip
SEATS: dict[str, Any] = {
    "bore_diameter": 90 * qs.mm, "outside_diameter": 160 * qs.mm, "shaft_interference": 12 * qs.um,
    "shaft_bore_diameter": 40 * qs.mm, "housing_interference": 10 * qs.um, "housing_outside_diameter": 210 * qs.mm,
    "housing_material": ALUMINIUM, "reference_temperature": CELSIUS + 20.0,
}  # fmt: skip
LOADS = qs.Operation(speed=SPEED, axial_load=9e3, radial_load_y=2e3, radial_load_z=-1e3, tilt_y=0.0, tilt_z=0.0)
FRICTION = {"friction_coefficient": MU, "drag_coefficient": DRAG, "fluid_density": MIST}
SCENE = qs.Scene(
    B218, LOADS, ring_effects=(qs.RingExpansion(**SEATS), qs.BallExpansion(CELSIUS)),
    readings={"friction": FRICTION}, thermal=THERMAL, **BOTH,
)  # fmt: skip
BALANCE_TOLERANCE = 1e-9
"""Of the whole heat: a hundred times where the steady state is taken as found, 1e-11."""
POWER_TOLERANCE = 1e-4
"""Of the table that friction reads, good to 5e-5, and of the sum here, 1e-5."""


def left(temperatures: dict[str, float], own: dict[str, float], rows: int = 1) -> np.ndarray:
    """What the nodes of a network are given and do not give off, of `PATHS` and the flow of oil [W].

    Args:
        temperatures, own: of each node, with the row's number where there are several [K, W].
        rows: each with its own rings and balls.
    """
    by_node = dict.fromkeys(temperatures, 0.0) | own

    def name(node: str, row: int) -> str:
        return f"{node} {row}" if rows > 1 and node in ("inner_ring", "balls", "outer_ring") else node

    for (one, other), conductance in PATHS.items():
        shared = name(one, 1) == one and name(other, 1) == other
        for row in range(1, 2 if shared else rows + 1):
            here, there = name(one, row), name(other, row)
            flow = conductance * (temperatures[here] - temperatures[there])
            by_node[here] -= flow
            by_node[there] += flow
    by_node["oil"] -= OIL.flow * OIL.density * OIL.specific_heat * (temperatures["oil"] - OIL.inlet_temperature)
    return np.array([heat for node, heat in by_node.items() if node != "ambient"])


def contact_heat(solution: qs.Solution, outer_speed: float = 0.0) -> dict[str, float]:
    """Of all contacts of each raceway, summed over their areas [W]."""
    drawing, by_race = drawing_of(solution.scene, EXAMPLE), {}
    turning = np.stack([np.asarray(solution.axial_rotation), -np.asarray(solution.radial_rotation)])
    orbit = np.asarray(solution.orbital_speed)
    for race, ring in (("inner", SPEED), ("outer", outer_speed)):
        contacts, groove = getattr(solution, race), getattr(drawing, f"{race}_groove_radius")
        relative = turning - np.stack([ring - orbit, 0.0 * orbit])
        sine, cosine = np.sin(contacts.angle), np.cos(contacts.angle)
        roll, spin = relative[0] * cosine - relative[1] * sine, relative[0] * sine + relative[1] * cosine
        radius = 2.0 / (2.0 / drawing.ball_diameter + 1.0 / groove)
        by_race[race] = sum(
            MU * load * mean_speed(abs(each_roll), abs(each_spin), (a, b), radius)
            for load, each_roll, each_spin, a, b in zip(
                contacts.load, roll, spin, contacts.semi_major_axis, contacts.semi_minor_axis, strict=True
            )
        )
    return by_race


def bearing_rows() -> Iterator[AgreementRow]:
    """One bearing at its steady temperatures."""
    solution = qs.solve(SCENE)
    state = solution.thermal
    assert state is not None
    T = {str(name): float(value) for name, value in state.temperatures.items()}
    power = {str(name): float(value) for name, value in state.powers.items()}
    case = "B218, heat of friction, a motor and oil, 6000 rpm"
    heat, orbit = contact_heat(solution), np.abs(np.asarray(solution.orbital_speed))
    drawing = drawing_of(solution.scene, EXAMPLE)
    disc, path = 0.25 * pi * drawing.ball_diameter**2, 0.5 * drawing.pitch_diameter * orbit
    drag = float((0.5 * DRAG * MIST * disc * path**3).sum())
    told = [power[name] for name in ("inner contacts", "outer contacts", "drag")]
    source = "friction summed over each contact's area, drag by its formula"
    yield compared(case, "heat of the contacts and of drag", "W", told, [*heat.values(), drag], source, POWER_TOLERANCE)
    inner, outer, drag = told
    own = {
        "inner_ring": TO_RINGS * inner, "outer_ring": TO_RINGS * outer, "balls": (1.0 - TO_RINGS) * (inner + outer),
        "oil": drag, "shaft": MOTOR,
    }  # fmt: skip
    total = sum(own.values())
    rest, source = left(T, own), "balance of each node, written out"
    yield compared(case, "heat left at the nodes, and all", "W", [*rest, total], [*(0.0 * rest), total], source,
                   BALANCE_TOLERANCE)  # fmt: skip
    bodies: dict[str, Any] = {
        f"{body}_temperature": T[body] for body in ("inner_ring", "outer_ring", "shaft", "housing")
    }
    ball = qs.BallExpansion(T["balls"])
    given = qs.solve(replace(SCENE, thermal=None, ring_effects=(qs.RingExpansion(**SEATS, **bodies), ball)))
    source = "the bearing at these temperatures, given"
    for quantity, unit, of in (
        ("displacement", "m, rad", lambda of: of.displacement),
        ("inner contact load", "N", lambda of: of.inner.load),
    ):
        yield compared(case, quantity, unit, of(solution), of(given), source)


def set_rows() -> Iterator[AgreementRow]:
    """Two rows on one warm shaft: each its own rings and balls, one shaft, housing and oil."""
    rows = (qs.Row(B218, 0.0), qs.Row(B218, 60e-3, MINUS))
    of = qs.BearingSet(
        rows,
        replace(
            LOADS, speed=2500.0 * qs.rpm, axial_load=3e3, moment_y=0.0, moment_z=0.0, tilt_y=None, tilt_z=None
        ),
        qs.Preload(rigid=1e3), ring_effects=SCENE.ring_effects, readings=SCENE.readings, thermal=THERMAL, **BOTH,
    )  # fmt: skip
    solution = qs.solve_set(of)
    state = solution.thermal
    assert state is not None
    T = {str(name): float(value) for name, value in state.temperatures.items()}
    own, total = {"shaft": MOTOR, "oil": 0.0}, MOTOR
    for number, row in enumerate(solution.rows, 1):
        friction = qs.readings.friction(row, **FRICTION)
        assert friction.drag_power is not None
        inner, outer, drag = (
            float(np.sum(each)) for each in (friction.inner.power, friction.outer.power, friction.drag_power)
        )
        own |= {
            f"inner_ring {number}": TO_RINGS * inner,
            f"outer_ring {number}": TO_RINGS * outer,
            f"balls {number}": (1.0 - TO_RINGS) * (inner + outer),
        }
        own["oil"] += drag
        total += inner + outer + drag
    rest = left(T, own, rows=2)
    yield compared(
        "two rows on a warm shaft, 2500 rpm", "heat left at the nodes, and all", "W", [*rest, total],
        [*(0.0 * rest), total], "balance of each node, written out", BALANCE_TOLERANCE,
    )  # fmt: skip


def heat_rows() -> Iterator[AgreementRow]:
    """All of heat."""
    yield from bearing_rows()
    yield from set_rows()
