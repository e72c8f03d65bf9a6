"""All of a solution as the columns of a table, one row per ball of every case, and as a dataset of xarray."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.described import materials_of, numbers_of
from qsbearing.model.material import Material
from qsbearing.model.operation import CHANNELS
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.groups import GROUPS, RING, SolvedScene
from qsbearing.model.solution.result_keys import BALL, Group, Place
from qsbearing.model.solution.traction_groups import TRACTION
from qsbearing.model.units import deg
from qsbearing.model.version import __version__

if TYPE_CHECKING:
    import xarray


def columns(solution: SolvedScene) -> dict[str, NDArray]:
    """Everything that there is to say about each ball; arrays of shape (row,), units in their names.

    The case's results, its status and the scene's numbers, as a scene file has them, follow on each of its rows.
    Cases not solved have their rows, with NaN for results. What the scene does not call for has no column.
    """
    exists = np.isfinite(solution.azimuth)
    rows = np.nonzero(exists)

    def per_case(values: Any) -> NDArray:
        return np.broadcast_to(np.asarray(values)[..., None], exists.shape)[exists]

    def part(belongs: Callable[[Group], bool]) -> dict[str, NDArray]:
        places = [Place(group, each) for group in GROUPS if belongs(group) for each in group.results if each.is_column]
        read = ((place, place.of(solution)) for place in places)
        return {
            place.column: values[exists] if place.is_per_ball else per_case(values)
            for place, values in read
            if values is not None
        }

    out: dict[str, NDArray] = {f"case_{axis}": number for axis, number in enumerate(rows[:-1])}
    out |= {"ball": rows[-1], "azimuth_deg": solution.azimuth[exists] / deg}
    out |= part(lambda each: each.axis == BALL)
    if solution.raceway_control is not None:
        out["raceway_control"] = solution.raceway_control[exists]
    if solution.slips is not None:
        out["slips"] = solution.slips[exists]
    out |= part(lambda each: each.before == RING)
    names = [channel.label.replace(" ", "_") for channel in CHANNELS]
    for row, column in np.ndindex(5, 5):
        values = solution.stiffness[..., row, column]
        out[f"ring_stiffness_SI_{names[row]}_by_{names[column]}"] = per_case(values)
    out |= part(lambda each: each.axis != BALL and each.before != RING)
    out |= {"status": per_case(solution.status), "reason": per_case(solution.reason)}
    return out | {key: per_case(values) for key, values in scene_numbers(solution.scene).items()}


def scene_numbers(scene: Scene) -> dict[str, Any]:
    """The scene's numbers, in the units in which they are given and under their names with these."""
    holders: list[tuple[str, Any]] = [("", scene.bearing), ("", scene.operation)]
    if scene.preload is not None:
        holders.append(("preload_", scene.preload))
    holders += _materials(scene.bearing)
    for effect in scene.ring_effects:
        if effect is scene.ball_diameter_deviations:
            continue  # by ball: a column of its own
        holders += [(f"{effect.name}_", effect), *_materials(effect)]
    if scene.gyroscopic_moment is not None:
        holders.append(("", scene.gyroscopic_moment))
    if scene.traction is not None:
        holders.append((f"{TRACTION}_", scene.traction))
    out: dict[str, Any] = {"bearing": scene.bearing.name}
    for prefix, holder in holders:
        for given in numbers_of(type(holder)):
            values = getattr(holder, given.name)
            if values is not None:
                in_unit = np.vectorize(given.in_unit, otypes=[float])
                out[prefix + given.column] = in_unit(np.asarray(values, float))
    return out


def _materials(holder: Any) -> Iterator[tuple[str, Material]]:
    """Those that it holds, after the beginning of their numbers' names."""
    for name in materials_of(type(holder)):
        if (material := getattr(holder, name)) is not None:
            yield f"{name}_", material


def dataset(solution: SolvedScene) -> xarray.Dataset:
    """Everything that a solution holds, labelled; what the scene does not call for is left out.

    The scene's numbers that vary are coordinates; an axis along which one alone varies bears its name.
    """
    import xarray

    inputs = {name: values for name, values in scene_numbers(solution.scene).items() if name != "bearing"}
    dims = _case_dims(inputs, solution.shape)
    variables: dict[str, Any] = {
        "status": (dims, np.asarray(solution.status, str)),
        "reason": (dims, np.asarray(solution.reason, str)),
        "iterations": (dims, np.asarray(solution.iterations)),
        "residual": (dims, np.asarray(solution.residual)),
    }
    for place in (Place(group, each) for group in GROUPS for each in group.results if each.is_usual):
        values = place.of(solution)
        if values is not None:
            own = (*dims, BALL) if place.is_per_ball else dims
            variables[place.name] = (own, values, place.attributes)
    coordinates = {}
    for name, values in inputs.items():
        axes = [axis for axis, length in enumerate(np.shape(values)[::-1]) if length > 1][::-1]
        own = tuple(dims[-1 - axis] for axis in axes)
        coordinates[name] = (own, np.squeeze(values))
    title = f"Solution of {solution.scene.bearing.name or 'a bearing'}"
    return xarray.Dataset(variables, coordinates, {"title": title, "qsbearing_version": __version__})


def _case_dims(inputs: dict[str, Any], shape: tuple[int, ...]) -> tuple[str, ...]:
    """Names of the case axes: case_0, ..., or the number that alone varies along one."""
    alone: dict[int, list[str]] = {}
    for name, values in inputs.items():
        axes = [len(shape) - 1 - axis for axis, length in enumerate(np.shape(values)[::-1]) if length > 1]
        if axes:
            alone.setdefault(axes[0] if len(axes) == 1 else -1, []).append(name)
    return tuple(alone[i][0] if len(alone.get(i, [])) == 1 else f"case_{i}" for i in range(len(shape)))
