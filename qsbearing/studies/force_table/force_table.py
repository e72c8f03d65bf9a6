"""`force_table`: loads and stiffness of a bearing over displacements and speed, for programs without bearings."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.keys import OF_OPERATION
from qsbearing.files.scene_tables import input_tables
from qsbearing.model.bearing_errors import shapes_of
from qsbearing.model.operation import CHANNELS
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution import solver
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import ErrorDetail, alike, check_kind, question, raise_if_any
from qsbearing.model.version import __version__
from qsbearing.remarks.remark import Remark
from qsbearing.results.remarks import every_remark, remarks_record
from qsbearing.studies.chooser.choose import solve
from qsbearing.studies.chunk import STATUSES
from qsbearing.studies.force_table.refined_grid import FIRST, Errors, Evaluate, GridPoints, RefinedGrid
from qsbearing.studies.force_table.spline import Interpolation
from qsbearing.studies.force_table.table_axes import TableAxis, at_points, axes_of, held, loaded, over_errors
from qsbearing.studies.points import CHUNK
from qsbearing.studies.sweep import Progress

if TYPE_CHECKING:
    import xarray

WISHED = 0.01
MOST = 100_000
CHECKED = 1000
BOUNDS = {"wished_error": (1e-6, 1.0), "most_points": (FIRST, 10_000_000), "checked_points": (1, 1_000_000)}
"""What may be asked for."""
LOADS = {each.load: OF_OPERATION[each.load] for each in CHANNELS}
STIFFNESS = "stiffness_SI"
ORDER = "x, y, z, tilt y, tilt z"
SOLVED_STATUSES = STATUSES[:3]


class _Task(NamedTuple):
    """What is solved at every point, and by what its errors are divided."""

    scene: Scene
    """With everything chosen, and held where an axis has one value."""
    axes: list[TableAxis]
    remarks: list[Remark]
    """What there is to say of the scene's own operating point; none where it is not solved."""
    load: float
    """Size of the force under the scene's own operation [N]; 0: none, or no equilibrium."""


class Tabulated(NamedTuple):
    """A table, and what there is to say of its scene, which holds of the table too."""

    table: xarray.Dataset
    remarks: list[Remark]


def force_table(
    scene: Scene,
    over: Mapping[str, tuple[float, float] | None] | None = None,
    *,
    wished_error: float = WISHED,
    most_points: int = MOST,
    interpolation: str = "linear",
    checked_points: int = CHECKED,
    seed: int = 0,
    progress: Progress | None = None,
) -> xarray.Dataset:
    """Tabulate the loads and the stiffness of a bearing over displacements and speed.

    The grid is rectilinear and unevenly spaced: an axis is refined where interpolation errs most, until the error at
    points drawn at random between those of the grid, solved there and interpolated, is as wished. Effects are as the
    scene has them; with effects to be chosen, those that its operating point needs.

    Args:
        scene: of one operating point, without a heat balance.
        over: the axes, fields of an `Operation`: displacements, tilts, "speed"; each with its range in SI, or None: the
            range follows from the load of the scene. Two equal ends hold it there. None, or no channel in it: those
            that carry a load. The speed is an axis too, from rest to that of the scene, if anything depends on it.
            Other channels stay as the scene has them, held or free under their load.
        wished_error: the largest error, over the size of the force of the scene's own operating point, or where it has
            none, of the largest force of the table; of moments, over that times half the pitch diameter. 1e-6 to 1.
        most_points: of the grid; where they do not suffice, the table is the best of so many.
        interpolation: "linear", or "cubic" splines, which need every point solved: otherwise linear is taken, and said.
        checked_points: at which the error is measured in the end.
        seed: of the points at random.
        progress: called after each part with the points solved so far, at most `most_points`, and `most_points`.

    Returns:
        xarray.Dataset: in the units of files, axes as coordinates in the order speed, x, y, z, tilts. `axial_load_N`,
            ...: the load on the inner ring, in equilibrium with the balls; the bearing acts on the shaft with its
            negative. `stiffness_SI` (..., load, displacement) [N/m, N/rad, N, N m/rad]: its derivatives by x, y, z,
            tilt y, tilt z. `status`: 0 converged, 1 no_equilibrium, 2 not_converged; the last two hold NaN.
            `loaded_balls`: balls that press on the inner raceway; without one the load is 0 at rest. Each load has the
            attributes `error_largest`, `error_95` and both in percent, as measured at points that are none of the grid.
            Of the table: `wish_is_met`, `interpolation`, `unjudged_points`; `remarks`, what is said of the scene
            at its operating point, as JSON.

    Raises:
        SceneError: a name, range or number that cannot be; a range that the scene does not tell; every error, at once.
        ImportError: xarray is not installed (the `studies` extra).

    Examples:
        >>> span = {"axial_displacement": (-10 * qs.um, 30 * qs.um), "speed": (0.0, 20_000 * qs.rpm)}
        >>> table = qs.force_table(qs.load_scene("7210c"), span)
        >>> at = table["axial_load_N"].interp(speed_rpm=15_000, axial_displacement_um=12.5)
        >>> print(f"{at:.0f} N, {table.attrs['wish_is_met']}")
        817 N, 1
    """
    return tabulated(
        scene, over, wished_error=wished_error, most_points=most_points, interpolation=interpolation,
        checked_points=checked_points, seed=seed, progress=progress,
    ).table  # fmt: skip


def tabulated(
    scene: Scene,
    over: Mapping[str, tuple[float, float] | None] | None,
    *,
    wished_error: float,
    most_points: int,
    interpolation: str,
    checked_points: int,
    seed: int,
    progress: Progress | None,
) -> Tabulated:
    """What `force_table` gives, with the remarks on the scene, which it solves for its ranges."""
    import xarray

    check_kind("force_table", scene, "Scene")
    numbers = {"wished_error": wished_error, "most_points": most_points, "checked_points": checked_points}
    raise_if_any([*scene_errors(scene), *over_errors(over or {}), *number_errors(numbers, interpolation)])
    task = _task_of(scene, over or {})
    spans = [axis for axis in task.axes if axis.low < axis.high]
    raise_if_any(_size_errors(spans, most_points))
    report = progress or (lambda done, count: None)
    evaluate = _evaluation(
        task.scene, [each.field for each in spans], lambda done: report(min(done, most_points), most_points)
    )
    requested = Interpolation(interpolation)
    grid = RefinedGrid([(each.low, each.high) for each in spans], evaluate, requested, seed)
    forces, lever = grid.solved.load[..., :3], 0.5 * float(np.asarray(task.scene.bearing.pitch_diameter))
    size = task.load or float(np.nanmax(np.linalg.norm(forces, axis=-1), initial=0.0)) or 1.0
    scale = size * np.where([each.is_rotation for each in CHANNELS], lever, 1.0)
    errors = grid.refine(wished_error, scale, most_points, checked_points)
    table = xarray.Dataset(_variables(spans, grid, errors, scale), _coordinates(spans, grid))
    attributes = _attributes(task, grid, errors, wished_error, scale, seed, requested)
    return Tabulated(table.assign_attrs(attributes), task.remarks)


def scene_errors(scene: Scene) -> list[ErrorDetail]:
    """What keeps a scene from having a table."""
    errors = []
    if scene.thermal is not None:
        cause = "Leave it out, and give the temperatures that it finds"
        errors.append(
            ErrorDetail("thermal", "has no table: every point would have temperatures of its own", cause=cause)
        )
    parts: list[tuple[str, Any]] = [(name, getattr(scene, name)) for name in ("bearing", "operation", "preload")]
    parts += [(each.name, each) for each in scene.ring_effects]
    cause = "Make a scene of one of them; of a bearing by its number, choose one of its ball sets"
    several = dict.fromkeys(path.partition(".")[0] for path, shape in shapes_of(parts).items() if shape)
    errors += [ErrorDetail(name, "has several cases: a table is of one", cause=cause) for name in several]
    return errors


def number_errors(numbers: Mapping[str, float], interpolation: str) -> list[ErrorDetail]:
    """What is wrong with how fine the table is to be."""
    errors = []
    for name, value in numbers.items():
        least, most = BOUNDS[name]
        if not (isinstance(value, int | float) and least <= value <= most):
            errors.append(ErrorDetail(name, "is out of range", value, allowed=(least, most)))
    if interpolation not in tuple(Interpolation):
        cause = question(alike(interpolation, tuple(Interpolation))) or "One of: linear, cubic"
        errors.append(ErrorDetail("interpolation", "is not known", interpolation, cause=cause))
    return errors


def _size_errors(spans: list[TableAxis], most: int) -> list[ErrorDetail]:
    if not spans:
        return [ErrorDetail("over", "leaves no axis", cause="Give one of them a range")]
    if FIRST ** len(spans) <= most:
        return []
    problem = f"is too small for {len(spans)} axes of {FIRST} places"
    return [ErrorDetail("most_points", problem, most, allowed=(FIRST ** len(spans), BOUNDS["most_points"][1]))]


def _task_of(scene: Scene, over: Mapping[str, tuple[float, float] | None]) -> _Task:
    if not (set(over) - {"speed"} or loaded(scene)):
        cause = "Name the displacements that it is to span, and from where to where"
        raise_if_any([ErrorDetail("over", "is empty, and no channel of the scene carries a load", cause=cause)])
    solution = solve(scene)
    axes = axes_of(solution.scene, over, solution)
    force, remarks = 0.0, list[Remark]()
    if solution.converged:
        force, remarks = float(np.linalg.norm(solution.load[:3])), every_remark(solution)
    fixed = at_points(solution.scene, {name: np.asarray(value) for name, value in held(axes).items()})
    return _Task(fixed, axes, remarks, force)


def _evaluation(scene: Scene, fields: list[str], report: Callable[[int], object]) -> Evaluate:
    """What solves points of these fields, and reports how many it has solved in all."""
    done = 0

    def evaluate(at: NDArray) -> GridPoints:
        nonlocal done
        parts = []
        for start in range(0, len(at), CHUNK):
            some = at[start : start + CHUNK]
            parts.append(_read(solver.solve(at_points(scene, dict(zip(fields, some.T, strict=True))))))
            done += len(some)
            report(done)
        return GridPoints(*(np.concatenate(each) for each in zip(*parts, strict=True)))

    return evaluate


def _read(solution: Solution) -> GridPoints:
    is_solved = solution.codes == 0
    balls = np.where(is_solved, (solution.inner_load > 0.0).sum(axis=-1), -1)
    return GridPoints(solution.load, solution.stiffness, solution.codes.astype(np.int8), balls.astype(np.int16))


def _coordinates(spans: list[TableAxis], grid: RefinedGrid) -> dict[str, Any]:
    return {
        axis.key.name: (
            (axis.key.name,),
            np.array([axis.key.in_file(float(value)) for value in places]),
            {"units": axis.key.unit, "range": "assumed" if axis.is_assumed else "given"},
        )
        for axis, places in zip(spans, grid.axes, strict=True)
    }


def _variables(spans: list[TableAxis], grid: RefinedGrid, errors: Errors, scale: NDArray) -> dict[str, Any]:
    dims = tuple(each.key.name for each in spans)
    made: dict[str, Any] = {}
    for number, key in enumerate(LOADS.values()):
        largest, of_most = (float(each[number]) for each in (errors.largest, errors.of_most))
        made[key.name] = dims, grid.solved.load[..., number], {
            "units": key.unit, "error_largest": largest, "error_95": of_most,
            "error_largest_percent": float(100.0 * largest / scale[number]),
            "error_95_percent": float(100.0 * of_most / scale[number]),
        }  # fmt: skip
    told = {"units": "N/m, N/rad, N, N m/rad", "order": ORDER, "long_name": "derivatives of the loads"}
    made[STIFFNESS] = (*dims, "load", "displacement"), grid.solved.stiffness, told
    flags = {"flag_values": np.arange(len(SOLVED_STATUSES), dtype=np.int8), "flag_meanings": " ".join(SOLVED_STATUSES)}
    made["status"] = dims, grid.solved.status, flags
    made["loaded_balls"] = dims, grid.solved.loaded_balls, {"long_name": "balls that press on the inner raceway"}
    return made


def _attributes(
    task: _Task, grid: RefinedGrid, errors: Errors, wished: float, scale: NDArray, seed: int, requested: Interpolation
) -> dict[str, Any]:
    worst = float(np.max(errors.largest / scale))
    status, balls = grid.solved.status, grid.solved.loaded_balls
    count = int(np.asarray(task.scene.bearing.ball_count))
    return {
        "Conventions": "CF-1.11",
        "title": f"Loads and stiffness of {task.scene.bearing.name or 'a bearing'}",
        "source": f"qsbearing {__version__}",
        "loads": "on the inner ring; the bearing acts on the shaft with their negative",
        "point": "on the axis, in the plane of the inner groove centres; x along the axis",
        "interpolation": str(grid.interpolation),
        "interpolation_requested": str(requested),
        "wished_error_percent": 100.0 * wished,
        "wish_is_met": int(worst <= wished),
        "percent_of_N": float(scale[0]),
        "percent_is_of": "the force of the scene" if task.load else "the largest force of the first grid",
        "checked_points": len(errors.sizes) + errors.unjudged,
        "unjudged_points": errors.unjudged,
        "seed": seed,
        "points": grid.count,
        "unsolved_points": int((status != 0).sum()),
        "points_without_loaded_balls": int((balls == 0).sum()),
        "points_with_some_unloaded_balls": int(((balls > 0) & (balls < count)).sum()),
        "input": json.dumps(input_tables(task.scene)),
        "remarks": json.dumps(remarks_record(task.remarks)["remarks"]),
    }
