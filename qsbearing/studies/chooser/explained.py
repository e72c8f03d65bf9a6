"""What `qsbearing explain` finds of a scene or set, as data."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks.of_solution import message
from qsbearing.remarks.remark import Remark
from qsbearing.results.remarks import every_remark, remarks_record
from qsbearing.studies.chooser.explain import Assessment, explain
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution


class Explained(NamedTuple):
    """How much each effect and choice matters at one operating point."""

    solution: Solution | SetSolution
    rows: list[Assessment]
    remarks: list[Remark]
    record: dict[str, Any]
    """As `explain --json` prints it."""


def explained(of: Scene | BearingSet, tolerance: float) -> Explained:
    """Solve it with and without each.

    Args:
        tolerance: the relative change below which an effect is not needed.
    """
    requested = replace(of, tolerance=None)
    solution, rows, record = (
        _of_scene(requested, tolerance) if isinstance(requested, Scene) else _of_set(requested, tolerance)
    )
    said = every_remark(solution)
    told = remarks_record(said)
    record |= {"remarks": told["remarks"]} if isinstance(requested, Scene) else told
    record |= {"tolerance": tolerance, "effects": [vars(row) for row in rows]}
    return Explained(solution, rows, said, record)


def _of_scene(scene: Scene, tolerance: float) -> tuple[Solution, list[Assessment], dict[str, Any]]:
    solution, rows = explain(scene, tolerance)
    return solution, rows, {"status": str(solution.status), "message": message(solution)}


def _of_set(of: BearingSet, tolerance: float) -> tuple[SetSolution, list[Assessment], dict[str, Any]]:
    from qsbearing.results.set_record import set_record
    from qsbearing.studies.chooser.explain_set import explain_set
    from qsbearing.systems.sets.preload_limits import preload_summary

    solution, rows = explain_set(of, tolerance)
    whole = set_record(solution, [{}] * len(solution.rows))
    record = {key: whole[key] for key in ("status", "message", "arrangement")}
    return solution, rows, record | {"preload": preload_summary(solution) if solution.converged else []}
