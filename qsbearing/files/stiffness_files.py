"""The stiffness of a solved bearing or set for other programs: as JSON, for MATLAB, as elements of ROSS, as springs of
CalculiX, Nastran and Abaqus, as a matrix of ANSYS.

Each row by itself, about the plane of its balls' centres, in the axes of the shaft; as JSON and springs of CalculiX and
Nastran also in those of a model in which the shaft lies otherwise.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from io import BytesIO
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.numbers import plain
from qsbearing.model.solution.rounding import (
    NOISE,
    least_force,
    matrix_without_rounding,
    rounding_of,
    without_rounding,
)
from qsbearing.model.units import mm, rpm
from qsbearing.model.validation import printable
from qsbearing.model.version import __version__
from qsbearing.systems.rotor_dynamics.model_frame import OWN, ModelFrame, in_model
from qsbearing.systems.rotor_dynamics.springs import asymmetry, combined_springs, from_shaft

UNITS = {"N-mm-t": mm, "N-m-kg": 1.0}
"""Systems of units: the size of their length in metres."""
AXES = "x along the shaft, y and z across it; rotations right-handed"
IN_MODEL = "x, y, z of the model; rotations right-handed"
DIRECTIONS = "Of the scene +x, along the shaft, is {x} there, +y is {y}, +z is {z}."
POINT = "on the axis, in the plane of the balls' centres"
FIRST_NODE = 900_000
"""Nodes of a deck begin there: 100 for each row."""
HELD = "The shaft's rotation about its axis, which no bearing holds, is held here:"


NOT_RUN = "{mark} Not run here: no {program} was at hand. It follows the manual: first solve a load of known result."
ANSYS_TYPE = 900
"""Number of the element type; rows have real constants of the numbers after it."""


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
        ratio = asymmetry(self.stiffness, self.lever)
        return ratio if ratio > NOISE else 0.0


def seats_of(solution: Any, units: str, *, mirrored: bool = False) -> list[Seat]:
    """The rows of a solved case.

    Args:
        solution: of a scene or a set.
        mirrored: the bearing of a scene carries in -x of the shaft.
    """
    length = UNITS[units]
    if hasattr(solution, "rows"):
        listed = [(row.bearing, float(row.position), row.sign, solved, by_middle)
                  for row, solved, by_middle
                  in zip(solution.set.rows, solution.rows, solution.set.is_two_sided, strict=True)]  # fmt: skip
        speed = solution.set.operation.speed
    else:
        listed = [(solution.scene.bearing, 0.0, -1.0 if mirrored else 1.0, solution, False)]
        speed = solution.scene.operation.speed
    seats = []
    for bearing, position, sign, solved, by_middle in listed:
        lever = from_shaft(solved, sign, by_middle=by_middle)
        scale = np.array([length, length, length, 1.0, 1.0])  # from displacements of the program to metres, radians
        turned = matrix_without_rounding(lever.T @ solved.stiffness @ lever)
        radius = 0.5 * float(np.asarray(bearing.pitch_diameter)) * (np.arange(5) > 2) + (np.arange(5) < 3)
        forces = lever.T @ solved.load / radius
        forces = without_rounding(forces, rounding_of(np.abs(forces).max(), least_force(bearing)))
        stiffness, load = turned * scale[:, None] * scale / length, forces * radius * scale / length
        half = 0.5 * float(np.asarray(bearing.pitch_diameter)) / length
        name = printable(bearing.name) or "bearing"
        seats.append(Seat(name, position / length, stiffness, load, half, float(speed) / rpm))
    return seats


def _is_turned(frame: ModelFrame) -> bool:
    return bool((frame.directions != OWN.directions).any())


def _directions(frame: ModelFrame) -> str:
    """Those of a scene in the model, in words."""
    named = (f"({', '.join(f'{part:.6g}' for part in direction)})" for direction in frame.directions)
    return DIRECTIONS.format(**dict(zip("xyz", named, strict=True)))


def _facts(units: str, frame: ModelFrame = OWN) -> dict[str, str]:
    length = units.split("-")[1]
    return {
        "version": __version__,
        "what": "tangent stiffness: forces and moments of the shaft on the bearing over its displacements",
        "units": f"{units}: N/{length}, N/rad, N {length}/rad; positions in {length}, speeds in rpm",
        "axes": f"{IN_MODEL}. {_directions(frame)}" if _is_turned(frame) else AXES,
        "point": POINT,
        "channels": "x, y, z, rotations about x (free), y, z",
    }


def _of(seat: Seat, frame: ModelFrame = OWN) -> dict[str, Any]:
    """The numbers of a row, 6 × 6, without stiffness about the axis."""
    load = np.insert(seat.load, 3, 0.0)
    stiffness = np.insert(np.insert(seat.stiffness, 3, 0.0, axis=0), 3, 0.0, axis=1)
    where = {}
    if not frame.is_own:
        where = {"place": frame.place(seat.position)}
        load, stiffness = frame.vector(load.reshape(2, 3)).ravel(), in_model(stiffness, frame.directions)
    return {
        "name": seat.name,
        "position": seat.position,
        **where,
        "speed": seat.speed,
        "load": load,
        "stiffness": stiffness,
        "asymmetry": seat.asymmetry,
    }


def json_text(seats: list[Seat], units: str, frame: ModelFrame = OWN) -> str:
    """All rows as JSON; in another model's axes with the place of each row there."""
    rows = [{key: each.tolist() if isinstance(each, np.ndarray) else each for key, each in _of(seat, frame).items()}
            for seat in seats]  # fmt: skip
    return json.dumps(_facts(units, frame) | {"rows": rows}, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def mat_bytes(seats: list[Seat], units: str) -> bytes:
    """All rows as a file of MATLAB and Octave: the same, `rows` an array of structures."""
    from scipy.io import savemat

    data = BytesIO()
    savemat(data, _facts(units) | {"rows": [_of(seat) for seat in seats]}, oned_as="column")
    return data.getvalue()


def ross_module(seats: list[Seat]) -> str:
    """All rows as a module of Python that makes elements of ROSS of them; of seats in N, m, kg."""
    facts = _facts("N-m-kg")
    lines = [
        f'"""Bearings as elements of ROSS, by qsbearing {__version__} (its extra `ross`), at one operating point each.',
        "",
        "    rotor = ross.Rotor(shaft, disks, bearings(1, 6))",
        "",
        f"{facts['what'].capitalize()}; {facts['units']}.",
        f"Axes of ROWS: {AXES}; bearings() turns them into those of ROSS.",
        f"The node of a row: {POINT}. The whole matrix is used, what is not symmetric in it too.",
        '"""',
        "",
        "import qsbearing as qs",
        "",
        "ROWS = [",
    ]
    for number, seat in enumerate(seats, 1):
        load = ", ".join(f"{each:.6g}" for each in seat.load)
        lines += [f"    # {number}: {seat.name}, x = {seat.position:.6g} m, loads on it {load} (N, N m)"]
        lines += [f"    ({seat.speed * rpm!r}, [  # rad/s"]
        lines += [f"        {[float(each) for each in row]!r}," for row in seat.stiffness]
        lines += ["    ]),"]
    lines += ["]", "", ""]
    lines += [
        "def bearings(*nodes, **more):",
        '    """One for each row, at these nodes of the shaft; more: such as cxx, tag."""',
    ]
    lines += ["    pairs = zip(ROWS, nodes, strict=True)"]
    lines += ["    return [qs.to_ross(matrix, speed, node, **more) for (speed, matrix), node in pairs]"]
    return "\n".join(lines) + "\n"


def calculix_deck(seats: list[Seat], units: str, frame: ModelFrame = OWN) -> str:
    """All rows as an input of CalculiX to be included: springs between the shaft and the ground.

    An auxiliary node takes each combination of displacements by *EQUATION, and a SPRING1 holds it.
    """
    return _springs_by_equations(seats, units, [], True, frame)


def abaqus_deck(seats: list[Seat], units: str) -> str:
    """The same for Abaqus, whose nodes turn as well as move; not run."""
    return _springs_by_equations(seats, units, [NOT_RUN.format(mark="**", program="Abaqus")], False, OWN)


def _springs_by_equations(
    seats: list[Seat], units: str, more: list[str], has_rotation_node: bool, frame: ModelFrame
) -> str:
    lines = [*_head("**", units, "Include it before the first *STEP.", frame), *more]
    for number, seat in enumerate(seats, 1):
        moved, turned, springs = _springs(number, seat, frame)
        how = [f"** Node {moved} moves and turns with the shaft at the bearing. Write into your model:"]
        how += [f"**   *RIGID BODY, REF NODE={moved}, PIN NSET=your_seat"]
        if has_rotation_node:
            how = [f"** Node {moved} moves with the shaft at the bearing, and {turned} turns with it."]
            how += ["** Write into your model:"]
            how += [f"**   *RIGID BODY, NSET=your_seat, REF NODE={moved}, ROT NODE={turned}"]
        turning, first = (turned, 1) if has_rotation_node else (moved, 4)
        nodes = dict.fromkeys((moved, turning, *(each.node for each in springs)))
        lines += [*_row("**", number, seat, units, frame), *how, "*NODE"]
        x, *across = frame.place(seat.position)
        place = ", ".join([f"{x:.13e}", *(f"{each:.13e}" if each else "0." for each in across)])
        lines += [f"{node}, {place}" for node in nodes]
        for node, constant, moves, turns in springs:
            terms = [(node, 1, 1.0), *((moved, dof, -part) for dof, part in moves)]
            terms += [(turning, dof + first - 1, -part) for dof, part in turns]
            lines += [f"*ELEMENT, TYPE=SPRING1, ELSET=QS_{node}", f"{node}, {node}"]
            lines += [f"*SPRING, ELSET=QS_{node}", "1", f"{constant:.12e}", *_equation(terms)]
            lines += ["*BOUNDARY", f"{node}, 2, 3"] if has_rotation_node else []
        if number == 1:
            # The largest part first: it is the one that the program takes out of its unknowns.
            about = sorted(_parts(frame.directions[0]), key=lambda part: -abs(part[1]))
            held = [(turning, dof + first - 1, part) for dof, part in about]
            alone = ["*BOUNDARY", f"{turning}, {held[0][1]}, {held[0][1]}"]
            lines += [f"** {HELD}", *(alone if len(held) == 1 else _equation(held))]
    return "\n".join(lines) + "\n"


def _equation(terms: Sequence[tuple[int, int, float]]) -> list[str]:
    """That node, direction and part of each add up to nothing."""
    lines = ["*EQUATION", f"{len(terms)}"]
    for at in range(0, len(terms), 4):
        lines.append(", ".join(f"{each}, {dof}, {part:.12e}" for each, dof, part in terms[at : at + 4]))
    return lines


def ansys_deck(seats: list[Seat], units: str) -> str:
    """All rows as commands of ANSYS (APDL), not run: the symmetric part of each as a MATRIX27 from shaft to ground."""
    lines = [*_head("!", units, "Read it by /INPUT within /PREP7."), NOT_RUN.format(mark="!", program="ANSYS")]
    lines += [f"ET,{ANSYS_TYPE},MATRIX27", f"KEYOPT,{ANSYS_TYPE},3,4", f"TYPE,{ANSYS_TYPE}"]
    for number, seat in enumerate(seats, 1):
        moved, ground = FIRST_NODE + 100 * number + 1, FIRST_NODE + 100 * number + 2
        whole = np.zeros((12, 12))
        own = [0, 1, 2, 4, 5]
        whole[np.ix_(own, own)] = 0.5 * (seat.stiffness + seat.stiffness.T)
        constants = [f"{each:.12e}" for each in whole[np.triu_indices(12)]]
        real = ANSYS_TYPE + number
        lines += [
            *_row("!", number, seat, units),
            f"! Node {moved} moves and turns with the shaft at the bearing. Write into your model:",
            f"!   CERIG,{moved},ALL,ALL  with the nodes of your seat selected",
            *(f"N,{node},{seat.position:.13e},0,0" for node in (moved, ground)),
            *(f"{f'R,{real}' if at == 0 else 'RMORE'},{','.join(constants[at : at + 6])}" for at in range(0, 78, 6)),
            *(f"REAL,{real}", f"E,{moved},{ground}", f"D,{ground},ALL,0"),
            *([f"! {HELD}", f"D,{moved},ROTX,0"] if number == 1 else []),
        ]
    return "\n".join(lines) + "\n"


def nastran_deck(seats: list[Seat], units: str, frame: ModelFrame = OWN) -> str:
    """All rows as bulk data of Nastran to be included: springs between the shaft and the ground, in large fields.

    A grid of its own takes each combination of displacements by an MPC, and a CELAS2 holds it. In another model's axes
    the grids move along those of the bearing, by a coordinate system of their own.
    """
    use = f"Include it in the bulk data, and select MPC = {FIRST_NODE} in the case control."
    lines = _head("$", units, use, frame)
    system: Any = ""
    if _is_turned(frame):
        system = FIRST_NODE
        lines += [f"$ Grids that move with the shaft have its axes, x along it: coordinate system {system}."]
        points = (frame.origin, frame.origin + frame.directions[2], frame.origin + frame.directions[0])
        lines += _large("CORD2R", system, "", *(float(each) for point in points for each in point))
    lines += [f"$ Grid {FIRST_NODE} is the ground.", *_large("GRID", FIRST_NODE, "", 0.0, 0.0, 0.0, "", "123456")]
    for number, seat in enumerate(seats, 1):
        moved, _, springs = _springs(number, seat, OWN)
        point = [float(each) for each in frame.place(seat.position)]
        lines += [
            *_row("$", number, seat, units, frame),
            f"$ Grid {moved} moves and turns with the shaft at the bearing. Write into your model:",
            f"$   RBE2, EID, {moved}, 123456, grids of your seat",
            *([f"$ {HELD}"] if number == 1 else []),
            *_large("GRID", moved, "", *point, system, "4" if number == 1 else ""),
        ]
        for node, constant, moves, turns in springs:
            terms = [(node, 1, 1.0)]
            terms += [(moved, dof, -part) for dof, part in moves] + [(moved, dof + 3, -part) for dof, part in turns]
            fields: list[Any] = [FIRST_NODE]
            for place, (each, dof, part) in enumerate(terms):
                fields += [each, dof, part, *(["", ""] if place % 2 else [])]
            lines += _large("GRID", node, "", *point, "", "23456")
            lines += [*_large("MPC", *fields), *_large("CELAS2", node, constant, node, 1, FIRST_NODE, 1)]
    return "\n".join(lines) + "\n"


class _Spring(NamedTuple):
    node: int
    constant: float
    moves: list[tuple[int, float]]
    """By the number of the displacement, 1 to 3: its part in the combination."""
    turns: list[tuple[int, float]]
    """By the number of the rotation: its part in the combination."""


def _springs(number: int, seat: Seat, frame: ModelFrame) -> tuple[int, int, list[_Spring]]:
    """The nodes that move and turn with a row, and its springs, each with a node of its own."""
    first = FIRST_NODE + 100 * number
    springs = []
    for count, (constant, parts) in enumerate(zip(*combined_springs(seat.stiffness, seat.lever), strict=True), 11):
        moves, turns = (_parts(frame.vector(half)) for half in (parts[:3], [0.0, *parts[3:]]))
        springs.append(_Spring(first + count, float(constant), moves, turns))
    return first + 1, first + 2, springs


def _parts(vector: NDArray) -> list[tuple[int, float]]:
    """The directions, 1 to 3, of a vector's parts that are not 0, and these."""
    return [(dof, float(part)) for dof, part in enumerate(vector, 1) if part]


def _head(mark: str, units: str, use: str, frame: ModelFrame = OWN) -> list[str]:
    length = units.split("-")[1]
    return [
        f"{mark} Bearings as springs, by qsbearing {__version__}. {use}",
        f"{mark} Units {units}: N/{length}, N/rad, N {length}/rad. Axes: {IN_MODEL if _is_turned(frame) else AXES}.",
        *([f"{mark} {_directions(frame)}"] if _is_turned(frame) else []),
        f"{mark} Tangent stiffness about a solved operating point: load the model with changes of its loads.",
    ]


def _row(mark: str, number: int, seat: Seat, units: str, frame: ModelFrame = OWN) -> list[str]:
    length = units.split("-")[1]
    place, loads = f"x = {seat.position:.6g}", seat.load
    if not frame.is_own:
        place = f"({', '.join(f'{each:.6g}' for each in frame.place(seat.position))})"
        loads = frame.vector(np.insert(seat.load, 3, 0.0).reshape(2, 3)).ravel()
    load = ", ".join(f"{each:.6g}" for each in loads)
    return [
        mark,
        f"{mark} {number}: {seat.name}, {seat.speed:g} rpm, loads on it {load} (N, N {length})",
        f"{mark} Point: {POINT}, {place} {length}.",
        f"{mark} The springs are the symmetric part of the stiffness. Of what is not symmetric the largest",
        f"{mark} difference of two terms is {plain(100.0 * seat.asymmetry, '.3g')} % of the largest term.",
    ]


def _large(name: str, *fields: Any) -> list[str]:
    """A card of Nastran in fields of 16 letters, four in a line; of lines there are two, four, ..."""
    texts = [f"{_real(each) if isinstance(each, float) else each!s:>16}" for each in fields]
    texts += [""] * (-len(texts) % 8)
    lines = ["".join(texts[at : at + 4]).rstrip() for at in range(0, len(texts), 4)]
    return [f"{f'{name}*' if number == 0 else '*':<8}{line}" for number, line in enumerate(lines)]


def _real(value: float) -> str:
    """With the most digits that a field of 16 letters holds: the exponent without its E."""
    for digits in (11, 10):
        part, exponent = f"{value:.{digits}E}".split("E")
        text = f"{part}{int(exponent):+d}"
        if len(text) <= 16:
            break
    return text
