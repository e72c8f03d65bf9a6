"""The results of a set by name, as a sweep keeps them: the shaft's, and each row's own, rows counting from 1."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.quantities import ALL, STIFFNESSES
from qsbearing.model.units import um

if TYPE_CHECKING:
    from qsbearing.systems.sets.set_solution import SetSolution

OF_ROW = (
    *((f"{side}_load", "max") for side in ("inner", "outer")),
    *((f"{side}_max_pressure", "max") for side in ("inner", "outer")),
    *((f"{side}_angle", end) for side in ("inner", "outer") for end in ("min", "max", "size")),
)
"""Of each row's balls: the result, and its maximum, its minimum or, as its sign is a direction, its largest size."""


class SetQuantity(NamedTuple):
    """One result of a set; `read` gives an array of shape (*cases) in the unit."""

    name: str
    unit: str
    column: str
    read: Callable[[], NDArray]


def set_quantities(solution: SetSolution) -> dict[str, SetQuantity]:
    """Every result of this solution, by its name; those first that most readers want."""
    found = (*_of_rows(solution), *_of_shaft(solution), *_of_points(solution))
    first = [each for each in found if each.name.endswith("_axial_load")]
    first += [each for each in found if each.name.startswith("shaft_effective_stiffness")]
    return {each.name: each for each in (*first, *found)}


def _of_shaft(solution: SetSolution) -> Iterator[SetQuantity]:
    """Displacement, load and stiffnesses, read as those of a ring are."""
    for kind in ("displacement", "load", *(f"{kind}_stiffness" for kind in STIFFNESSES)):
        for quantity in ALL.values():
            if quantity.ring is not None and quantity.ring[0] == kind:
                name, column = (f"shaft_{own}" for own in quantity.ring[1:])

                def read(of: Callable[..., NDArray | None] = quantity.read) -> NDArray:
                    return np.asarray(of(solution), float)

                yield SetQuantity(name, quantity.unit, column, read)


def _of_points(solution: SetSolution) -> Iterator[SetQuantity]:
    """Displacement and stiffness of the shaft's points, likewise."""
    for point in {} if solution.set.shaft is None else solution.set.shaft.points:
        for quantity in ALL.values():
            if quantity.ring is not None and quantity.ring[0] in ("displacement", "effective_stiffness"):
                name, column = (f"{point}_{own}" for own in quantity.ring[1:])

                def read(of: Callable[..., NDArray | None] = quantity.read, point: str = point) -> NDArray:
                    return np.asarray(of(solution.points[point]), float)

                yield SetQuantity(name, quantity.unit, column, read)
        if solution.points[point].axial_growth is not None:
            name = f"{point}_axial_growth"
            yield SetQuantity(name, "um", f"{name}_um", lambda point=point: solution.points[point].axial_growth / um)  # type: ignore[misc, operator, arg-type]


def _of_rows(solution: SetSolution) -> Iterator[SetQuantity]:
    for i in range(len(solution.set.rows)):
        loads: dict[str, Callable[[], Any]] = {"axial_load": lambda: solution.axial_loads}
        if solution.set.is_opposed:
            for state in ("at_rest", "unmounted", "mounted", "in_operation"):
                loads[f"preload_{state}"] = partial(getattr, solution, f"preload_{state}")
        for name, of in loads.items():
            name = f"row_{i + 1}_{name}"
            yield SetQuantity(name, "N", f"{name}_N", lambda of=of, i=i: of()[..., i])  # type: ignore[misc]
        for name, end in OF_ROW:
            quantity = ALL[name]
            own = f"row_{i + 1}_{name}_{end}"
            column = quantity.column.replace(name, own, 1)

            def read(of: Callable[..., NDArray | None] = quantity.read, i: int = i, end: str = end) -> NDArray:
                values = np.asarray(of(solution.rows[i]), float)
                over = np.fmin if end == "min" else np.fmax
                return over.reduce(np.abs(values) if end == "size" else values, axis=-1)

            yield SetQuantity(own, quantity.unit, column, read)
