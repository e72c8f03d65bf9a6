"""A set in which no two things are alike, as `solution_parts` judges it: by the equations of `on_shaft`.

Where balls and rings, grooves, rows, planes, sections and temperatures are alike, an error that takes one for the other
changes nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np

import qsbearing as qs
from fem_check.checks.motion_parts import motion_of, stress_of
from fem_check.checks.product_scenes import ALUMINIUM, CELSIUS, MINUS, PLUS
from fem_check.checks.solution_contacts import closed_form_rows, loaded_contacts
from fem_check.independent import quasi_static
from fem_check.independent.groove import RACES
from fem_check.product.on_shaft import OnShaft
from fem_check.product.scenes import SolvedPoint
from fem_check.product.solution_equilibrium import equilibrium_rows, reference_near
from fem_check.rows.agreement import AgreementRow, collapsed
from fem_check.rows.compared import compared

CASE = "two unlike rows on a hollow, conical, warm shaft"
HYBRID = qs.BallBearing(
    ball_count=17, ball_diameter=12.7e-3, pitch_diameter=92.5e-3, inner_groove_radius=6.54e-3,
    outer_groove_radius=6.76e-3, free_contact_angle=22.0 * qs.deg, ball_material=qs.SILICON_NITRIDE,
)  # fmt: skip
OF_STEEL = qs.BallBearing(
    ball_count=19, ball_diameter=11.1125e-3, pitch_diameter=85e-3, inner_groove_radius=5.84e-3,
    outer_groove_radius=5.71e-3, free_contact_angle=33.0 * qs.deg,
)  # fmt: skip
UNEQUAL = qs.BallDiameterDeviations([1.1 * qs.um, *4 * [0.0], -0.8 * qs.um, *5 * [0.0], 0.5 * qs.um, *5 * [0.0]])
TITANIUM = qs.Material(114e9, 0.34, 4430.0, 8.6e-6, "titanium")
BRONZE = qs.Material(105e9, 0.35, 8800.0, 18e-6, "bronze")
FITTED = qs.RingExpansion(
    70e-3, 118e-3, shaft_interference=9 * qs.um, inner_ring_temperature=CELSIUS + 46.0,
    outer_ring_temperature=CELSIUS + 37.0, housing_interference=-4 * qs.um, housing_outside_diameter=170e-3,
)  # fmt: skip
LOOSE = qs.RingExpansion(
    66e-3, 108e-3, inner_ring_temperature=CELSIUS + 43.0, outer_ring_temperature=CELSIUS + 35.0,
    housing_interference=6 * qs.um, housing_outside_diameter=165e-3,
)  # fmt: skip
SHAFT = qs.Shaft(
    (
        qs.ShaftSection(0.14, 70e-3, 32e-3, end_outer_diameter=67e-3, end_inner_diameter=25e-3),
        qs.ShaftSection(0.15, 66e-3, 28e-3, TITANIUM, end_outer_diameter=52e-3, end_inner_diameter=30e-3),
    ),
    -0.06,
    loads=(qs.ShaftLoad(-0.05, 300.0, -800.0, 500.0, 20.0, -15.0),),
    supports=(qs.ShaftSupport(0.21, 4e6, 9e6, 1.4e7, 3e3, 5e3),),
    temperature=CELSIUS + 49.0, masses=(qs.ShaftMass(0.19, 3.5),), gravity=(1.2, -9.2, 3.1),
)  # fmt: skip
BETWEEN = (SHAFT.start, *(each.position for each in SHAFT.loads), 0.1, 0.23)
"""Places where nothing holds the shaft: its ends, its load, and amid its rows [m]."""
SPACER = qs.Spacer(
    (1, 2), 0.11 + 11e-6, 0.11, inner_material=qs.STEEL, outer_material=BRONZE,
    inner_temperature=CELSIUS + 55.0, outer_temperature=CELSIUS + 41.0,
)  # fmt: skip


def unlike_set() -> qs.BearingSet:
    """The set; every number of it counts."""
    rows = (
        qs.Row(
            HYBRID, 12e-3, PLUS, 6e-6, housing_radial_y=7e-6, housing_radial_z=-4e-6,
            ring_effects=(FITTED, UNEQUAL, qs.BallExpansion(CELSIUS + 44.0)),
        ),
        qs.Row(
            OF_STEEL, 148e-3, MINUS, -3e-6, housing_stiffness=qs.HousingStiffness(axial=5e8, radial=7e8, tilt=2e6),
            housing_tilt_y=0.15e-3, housing_tilt_z=-0.1e-3, ring_effects=(LOOSE,),
        ),
    )  # fmt: skip
    choices: dict[str, Any] = {
        "raceway_control": "minimum_dissipation", "hertz_angle": "actual", "orbit_radius": "displaced",
    }  # fmt: skip
    loads: dict[str, Any] = {
        "axial_load": 900.0, "radial_load_y": 1500.0, "radial_load_z": -700.0, "moment_y": 25.0, "moment_z": -40.0,
    }  # fmt: skip
    return qs.BearingSet(
        rows, qs.Operation(speed=9000.0 * qs.rpm, outer_speed=-400.0 * qs.rpm, first_ball_azimuth=0.13, **loads),
        qs.Preload(rigid=1500.0), reference_position=0.095,
        ball_effects=(qs.CentrifugalForce(), qs.GyroscopicMoment()), shaft=SHAFT,
        housing=qs.Housing(CELSIUS + 33.0, ALUMINIUM), spacers=(SPACER,), **choices,
    )  # fmt: skip


def unlike_rows() -> Iterator[AgreementRow]:
    """Statics, the shaft's shape, where that puts each row, its balls there, and the stiffness of the whole."""
    of = unlike_set()
    solution, own = qs.solve_set(of), OnShaft(of)
    transfers = [own.to_row(number) for number in range(len(of.rows))]
    on_shaft = [-to_row.T @ row.load for to_row, row in zip(transfers, solution.rows, strict=True)]
    at, forces = own.acting(on_shaft, -solution.support_loads, BETWEEN)
    total, size = forces.sum(axis=0), np.array([1.0, 1.0, 1.0, 0.1, 0.1])
    total[3] -= (at * forces[:, 2]).sum()
    total[4] += (at * forces[:, 1]).sum()
    scale = np.full(5, np.abs(np.asarray(on_shaft)).max())
    yield compared(
        CASE, "forces left, moments over 0.1 m, and the largest", "N", total / size + scale, scale, "statics"
    )
    places = [*own.positions, *(each.position for each in SHAFT.supports), *BETWEEN]
    moved = own.moved(at, forces, solution.displacement, np.array([own.arm(each) for each in places]))
    source, told = "a beam under the solution's forces, by integration", solution.deflection(places)
    quantity = "the shaft at rows, support and between, tilts over 0.1 m"
    yield compared(CASE, quantity, "m", told * size, moved * size, source)
    springs = np.array(
        [[each.axial, each.radial_y, each.radial_z, each.tilt_y, each.tilt_z] for each in SHAFT.supports]
    )
    expected = springs * moved[len(of.rows) : -len(BETWEEN)]
    yield compared(CASE, "what the support carries", "N, N m", solution.support_loads, expected, "springs on the beam")
    stiffness: list[Any] = []
    rows: list[AgreementRow] = []
    for number, row in enumerate(solution.rows):
        ring = own.row_moved(number, moved[number], on_shaft[number])
        source = "the shaft there, heat, spacer, preload, seat and housing"
        quantity = f"displacement of row {number + 1}, tilts over 0.1 m"
        yield compared(CASE, quantity, "m", row.displacement * size, ring * size, source)
        label, make = f"row {number + 1}", partial(own.row_problem, number, ring)
        rows += equilibrium_rows(label, make, [row], row, row.displacement)
        point = (SolvedPoint(label, row),)
        for race in RACES:
            rows += closed_form_rows(loaded_contacts(race, point, label), [])
        rows += [*motion_of(label, row), *stress_of(label, row)]
        stiffness.append(quasi_static.stiffness(reference_near(make(), [row], row.displacement)))
    yield from collapsed(rows, f"{CASE}: balls and contacts")
    over = np.outer(size, size)
    yield compared(
        CASE, "stiffness, tilts over 0.1 m", "N/m", solution.stiffness / over, own.stiffness(stiffness) / over,
        "rows, housing, support and beam in series", 1e-6,
    )  # fmt: skip
