"""The stiffness of a solved bearing or set for finite-element programs: as JSON, and as springs of CalculiX.

Each row by itself, about the plane of its balls' centres, in the axes of the shaft.
"""

from __future__ import annotations

import json
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.units import mm, rpm
from qsbearing.model.validation import printable
from qsbearing.model.version import __version__
from qsbearing.systems.rotor_dynamics.springs import asymmetry, combined_springs, from_shaft

UNITS = {"N-mm-t": mm, "N-m-kg": 1.0}
"""Systems of units: the size of their length in metres."""
AXES = "x along the shaft, y and z across it; rotations right-handed"
POINT = "on the axis, in the plane of the balls' centres"
FIRST_NODE = 900_000
"""Nodes of a deck begin there: 100 for each row."""
_CHANNELS = ("x", "y", "z", "rotation x", "rotation y", "rotation z")


class Seat(NamedTuple):
    """A row of balls as a program has it, in the units of that program."""

    name: str
    position: float
    stiffness: NDArray
    """(5, 5), without the rotation about x, which is free."""
    load: NDArray
    lever: float
    """Half the pitch diameter, by which tilts are weighed."""
    speed: float
    """[rpm]"""

    @property
    def asymmetry(self) -> float:
        """As `springs.asymmetry`."""
        return asymmetry(self.stiffness, self.lever)


def seats_of(solution: Any, units: str, *, mirrored: bool = False) -> list[Seat]:
    """The rows of a solved case.

    Args:
        solution: of a scene or a set.
        mirrored: the bearing of a scene carries in -x of the shaft.
    """
    length = UNITS[units]
    if hasattr(solution, "rows"):
        listed = [(row.bearing, float(row.position), row.sign, solved)
                  for row, solved in zip(solution.set.rows, solution.rows, strict=True)]  # fmt: skip
        speed = solution.set.operation.speed
    else:
        listed = [(solution.scene.bearing, 0.0, -1.0 if mirrored else 1.0, solution)]
        speed = solution.scene.operation.speed
    found = []
    for bearing, position, sign, solved in listed:
        lever = from_shaft(solved, sign)
        scale = np.array([length, length, length, 1.0, 1.0])  # from displacements of the program to metres, radians
        stiffness = (lever.T @ solved.stiffness @ lever) * scale[:, None] * scale / length
        load = (lever.T @ solved.load) * scale / length
        half = 0.5 * float(np.asarray(bearing.pitch_diameter)) / length
        name = printable(bearing.name) or "bearing"
        found.append(Seat(name, position / length, stiffness, load, half, float(speed) / rpm))
    return found


def json_text(seats: list[Seat], units: str) -> str:
    """All rows as JSON: 6 × 6, the rotation about the axis without stiffness."""
    length = units.split("-")[1]
    rows = []
    for seat in seats:
        whole = np.insert(np.insert(seat.stiffness, 3, 0.0, axis=0), 3, 0.0, axis=1)
        rows.append(
            {
                "name": seat.name,
                f"position_{length}": seat.position,
                "speed_rpm": seat.speed,
                "load": np.insert(seat.load, 3, 0.0).tolist(),
                "stiffness": whole.tolist(),
                "asymmetry": seat.asymmetry,
            }
        )
    head = {
        "version": __version__,
        "what": "tangent stiffness of the bearings, force of the shaft on them over its displacement",
        "units": {"force": "N", "length": length, "moment": f"N {length}", "rotation": "rad", "system": units},
        "axes": AXES,
        "point": POINT,
        "channels": list(_CHANNELS),
    }
    return json.dumps(head | {"rows": rows}, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def calculix_deck(seats: list[Seat], units: str) -> str:
    """All rows as an input of CalculiX to be included: springs between the shaft and the ground.

    The symmetric part of the stiffness, as `combined_springs`: an auxiliary node takes each combination of
    displacements by *EQUATION, and a SPRING1 holds it.
    """
    length = units.split("-")[1]
    lines = [
        f"** Bearings as springs, by qsbearing {__version__}. Include it before the first *STEP.",
        f"** Units {units}: N/{length}, N/rad, N {length}/rad. Axes: {AXES}.",
        "** Tangent stiffness about a solved operating point: load the model with changes of its loads.",
    ]
    for number, seat in enumerate(seats, 1):
        first = FIRST_NODE + 100 * number
        moved, turned = first + 1, first + 2
        load = ", ".join(f"{each:.6g}" for each in seat.load)
        constants, combinations = combined_springs(seat.stiffness, seat.lever)
        lines += [
            "**",
            f"** {number}: {seat.name}, {seat.speed:g} rpm, loads on it {load} (N, N {length})",
            f"** Point: {POINT}, x = {seat.position:.6g} {length}. The springs are the symmetric part; the largest",
            f"** difference of what is not symmetric is {100.0 * seat.asymmetry:.3g} % of the largest term.",
            f"** Node {moved} moves with the shaft at the bearing, and {turned} turns with it. Write into your model:",
            f"**   *RIGID BODY, NSET=your_seat, REF NODE={moved}, ROT NODE={turned}",
            "*NODE",
        ]
        helpers = range(first + 11, first + 11 + len(constants))
        lines += [f"{node}, {seat.position:.13e}, 0., 0." for node in (moved, turned, *helpers)]
        for node, constant, combination in zip(helpers, constants, combinations, strict=True):
            terms = [(node, 1, 1.0)]
            terms += [(moved, dof, -part) for dof, part in zip((1, 2, 3), combination[:3], strict=True)]
            terms += [(turned, dof, -part) for dof, part in zip((2, 3), combination[3:], strict=True)]
            terms = [term for term in terms if term[2]]
            lines += [f"*ELEMENT, TYPE=SPRING1, ELSET=QS_{node}", f"{node}, {node}"]
            lines += [f"*SPRING, ELSET=QS_{node}", "1", f"{constant:.12e}", "*EQUATION", f"{len(terms)}"]
            for at in range(0, len(terms), 4):
                lines.append(", ".join(f"{each}, {dof}, {part:.12e}" for each, dof, part in terms[at : at + 4]))
            lines += ["*BOUNDARY", f"{node}, 2, 3"]
        if number == 1:
            lines += ["** The shaft's rotation about its axis, which no bearing holds:", "*BOUNDARY", f"{turned}, 1, 1"]
    return "\n".join(lines) + "\n"
