"""What is wrong with a scene file, said in the file's own keys and units."""

from __future__ import annotations

from qsbearing.files.errors import MOST_SHOWN, FileErrorDetail, SceneFileError, refused
from qsbearing.files.file_keys import find, path_in_file, with_file_keys
from qsbearing.model.scene.keys import Key
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.model.validation import ErrorDetail, unit_mistake

__all__ = ["MOST_SHOWN", "FileErrorDetail", "SceneFileError", "refused", "translate"]


def translate(error: ErrorDetail) -> FileErrorDetail:
    """An error of the Python objects as the file's reader needs it."""
    key = find(error.field) or Key("", "")
    value, allowed, cause = error.value, error.allowed, error.cause
    is_number = isinstance(value, float | int) and not isinstance(value, bool)
    # Python's advice on units is about SI; the file's unit needs its own. A more particular cause stays.
    if allowed is not None and error.quantity is not None and is_number:
        for_python = unit_mistake(value, error.quantity, *allowed)
        cause = _unit_mistake(key, key.in_file(value), allowed) if cause == for_python else cause
    if allowed is not None:
        allowed = (key.in_file(allowed[0]), key.in_file(allowed[1]))
    value = key.in_file(value) if is_number else value
    problem, cause = (with_file_keys(sentence, error.field) for sentence in (error.problem, cause))
    return FileErrorDetail(path_in_file(error.field), problem, value, key.unit, allowed, cause, where=error.where)


def _unit_mistake(key: Key, value: float, allowed: tuple[float, float]) -> str:
    """A sentence naming the unit in which a value out of range would be in range; empty where none would.

    Args:
        value: in the key's unit.
        allowed: inclusive range, SI.
    """
    for _, name, size in key.quantity.units if key.quantity else ():
        if size != key.size and value != 0.0 and allowed[0] <= value * size <= allowed[1]:
            return f"Given in {name}? {value:.6g} {name} = {value * size / key.size:.6g} {printed_unit(key.unit)}"
    return ""
