"""What `qsbearing explain` finds of a scene or set, as data."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks.of_solution import message
from qsbearing.remarks.remark import Remark
from qsbearing.results.remarks import every_remark, remarks_record
from qsbearing.studies.chooser.explain import Row, explain
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution


class Explained(NamedTuple):
    """How much each effect and choice matters at one operating point."""

    solution: Solution | SetSolution
    rows: list[Row]
    remarks: list[Remark]
    record: dict[str, Any]
    """As `explain --json` prints it."""


def explained(of: Scene | BearingSet, tolerance: float) -> Explained:
    """Solve it with and without each.

    Args:
        tolerance: the relative change below which an effect is not needed.
    """
    asked = replace(of, tolerance=None)
    solution, rows, found = _of_scene(asked, tolerance) if isinstance(asked, Scene) else _of_set(asked, tolerance)
    said = every_remark(solution)
    told = remarks_record(said)
    found |= {"remarks": told["remarks"]} if isinstance(asked, Scene) else told
    found |= {"tolerance": tolerance, "effects": [vars(row) for row in rows]}
    return Explained(solution, rows, said, found)


def _of_scene(scene: Scene, tolerance: float) -> tuple[Solution, list[Row], dict[str, Any]]:
    solution, rows = explain(scene, tolerance)
    return solution, rows, {"status": str(solution.status), "message": message(solution)}


def _of_set(of: BearingSet, tolerance: float) -> tuple[SetSolution, list[Row], dict[str, Any]]:
    from qsbearing.results.set_record import set_record
    from qsbearing.studies.chooser.explain_set import explain_set
    from qsbearing.systems.sets.preload_limits import preload_summary

    solution, rows = explain_set(of, tolerance)
    whole = set_record(solution, [{}] * len(solution.rows))
    found = {key: whole[key] for key in ("status", "message", "arrangement")}
    return solution, rows, found | {"preload": preload_summary(solution) if solution.converged else []}
