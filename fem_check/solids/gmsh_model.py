"""A model in gmsh; millimetres, which gmsh's tolerances are made for."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from fem_check.independent.contact_problem import Array
from fem_check.meshing import MeshError, gmsh_problem


def millimetres(length: Any) -> Any:
    return 1e3 * length


@contextmanager
def gmsh_model() -> Iterator[Any]:
    problem = gmsh_problem()
    if problem is not None:
        raise MeshError(f"a mesh of the bodies has to be made, but {problem}")
    import gmsh

    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.add("body")
        yield gmsh
    finally:
        gmsh.finalize()


def revolved(occ: Any, face: int, axis: Array, angle: float) -> list[int]:
    return [tag for dim, tag in occ.revolve([(2, face)], 0, 0, 0, *axis, angle) if dim == 3]
