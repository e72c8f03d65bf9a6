"""What was solved, whatever it is, as the JSON of `qsbearing run --json`: a bearing, a set, either over a spectrum."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from qsbearing.files.scene_tables import input_tables
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.changes import requested
from qsbearing.model.solution.solution import Solution
from qsbearing.results.record_type import Record

if TYPE_CHECKING:
    from collections.abc import Callable

    from qsbearing.systems.sets.bearing_set import BearingSet
    from qsbearing.systems.sets.set_solution import SetSolution


def whole_record(solution: Solution | SetSolution, readings: Any) -> Record:
    """A solution and its readings as an object, without the input; what a kind needs is loaded only for it.

    Args:
        readings: as `readings_record.all_taken` gives them.
    """
    from qsbearing.results import requirements  # loaded only where all of a solution is told

    record = _record_of(solution)(solution, readings)
    record |= requirements.record(requirements.answered(solution, readings), solution)
    return record | (of_fits("fits_record", solution) or {})


def _record_of(solution: Solution | SetSolution) -> Callable[..., Record]:
    if not isinstance(solution, Solution):
        if "spectrum" in solution.set.readings:
            from qsbearing.results.set_spectrum_report import set_spectrum_record

            return set_spectrum_record
        from qsbearing.results.set_record import set_record

        return set_record
    if "spectrum" in solution.scene.readings:
        from qsbearing.results.spectrum_report import spectrum_record

        return spectrum_record
    from qsbearing.results.json_record import record

    return record


def with_input(of: Scene | BearingSet, record: Record) -> Record:
    """A record with the input that it is reproduced from."""
    return {"version": record["version"], "input": input_tables(of), **record}


def of_fits(what: str, solution: Solution | SetSolution) -> Any:
    """Of `fit_limits`, which is loaded only for a scene or set with expanding rings."""
    of: Any = requested(solution)
    if not any(of.ring_effects) and not any(getattr(row, "ring_effects", None) for row in getattr(of, "rows", ())):
        return None
    from qsbearing.results import fit_limits

    return getattr(fit_limits, what)(solution)
