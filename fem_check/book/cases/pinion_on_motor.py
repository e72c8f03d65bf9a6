"""A helical pinion on a motor shaft: the forces of its teeth and the reactions of two bearings, as a textbook prints
them."""

from __future__ import annotations

import numpy as np

import qsbearing as qs
from fem_check.book.case import CaseResult, Curve, Diagram, compared
from qsbearing.systems.sets.gears import Hand

SOURCE = "Shigley's Mechanical Engineering Design, example 13-9"
INCH, POUND, HORSEPOWER = 25.4e-3, 4.4482216152605, 745.69987
SPEED = -1800 * qs.rpm
"""Clockwise, seen from +x."""
BEARING_B, PINION = 10 * INCH, 13 * INCH
"""From bearing A."""
FORCES = {"tangential": 40.4, "radial": 17.0, "axial": -23.3}
TORQUE = 35.0
"""In inch pounds."""
REACTIONS = {
    "A": {"x": 23.3, "y": -3.1, "z": 12.1},
    "B": {"y": 20.1, "z": -52.5},
}
"""In pounds."""
STIFF = 1e12


def pinion() -> qs.Gear:
    """Of 18 teeth, 12 to the inch square to the tooth, 20 and 30 degrees."""
    return qs.Gear(
        PINION, 0.0, teeth=18, normal_module=INCH / 12, power=HORSEPOWER, normal_pressure_angle=20 * qs.deg,
        helix_angle=30 * qs.deg, hand=Hand.RIGHT, drives=True,
    )  # fmt: skip


def reactions() -> dict[str, dict[str, float]]:
    """What the bearings do to the shaft, as stiff springs without resistance to tilts [lbf]."""
    supports = (
        qs.ShaftSupport(0.0, axial=STIFF, radial_y=STIFF, radial_z=STIFF),
        qs.ShaftSupport(BEARING_B, radial_y=STIFF, radial_z=STIFF),
    )
    # A set has a row: one whose balls touch nothing.
    steel = qs.STEEL
    ball = qs.BallBearing(
        15, 12.5e-3, 70e-3, 6.5e-3, 6.5e-3, 15 * qs.deg, ring_material=steel, ball_material=steel
    )  # fmt: skip
    row = qs.Row(ball, 0.0, offset=-200 * qs.um)
    at_rest = qs.Operation(SPEED, moment_y=0.0, moment_z=0.0)
    solution = qs.solve_set(qs.BearingSet((row,), at_rest, shaft=qs.Shaft(supports=supports, gears=(pinion(),))))
    each_way = -solution.support_loads[:, :3] / POUND
    return {name: dict(zip("xyz", map(float, each), strict=True)) for name, each in zip("AB", each_way, strict=True)}


def run() -> CaseResult:
    """Forces and reactions, each beside what is printed."""
    forces, by_bearing = pinion().forces(SPEED), reactions()
    digits = "half the last printed digit"
    rows = [
        compared("pinion", f"{name} force", "lbf", printed, float(getattr(forces, name)) / POUND, SOURCE, 0.05, digits)
        for name, printed in FORCES.items()
    ]
    torque = float(forces.torque) / POUND / INCH
    rows.append(compared("pinion", "torque of the mate", "lbf in", TORQUE, torque, SOURCE, 0.5, digits))
    why = "half the last printed digit, and forces that the textbook rounds to 0.05 lbf, at a lever of 1.3"
    for bearing, printed_of in REACTIONS.items():
        rows += [
            compared(
                f"bearing {bearing}",
                f"reaction in {axis}",
                "lbf",
                printed,
                by_bearing[bearing][axis],
                SOURCE,
                0.115,
                why,
            )
            for axis, printed in printed_of.items()
        ]
    names = [f"{bearing}{axis}" for bearing, of in REACTIONS.items() for axis in of]
    printed = [value for of in REACTIONS.values() for value in of.values()]
    computed = [by_bearing[bearing][axis] for bearing, of in REACTIONS.items() for axis in of]
    worst = float(np.max(np.abs(np.subtract(printed, computed))))
    return CaseResult(
        f"Three forces, the torque and five reactions come out as printed, reactions within {worst:.2f} lbf.",
        rows,
        [
            Diagram(
                "reaction of a bearing", "lbf",
                [
                    Curve("printed", "circles", np.arange(len(names)), printed),
                    Curve("computed", "crosses", np.arange(len(names)), computed),
                ],
                x_names=names,
            )
        ],
    )  # fmt: skip
