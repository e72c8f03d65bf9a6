"""What is wrong with a scene file, said in the file's own keys and units."""

from __future__ import annotations

from qsbearing.files.errors import MOST_SHOWN, FileErrorDetail, SceneFileError, refused
from qsbearing.files.file_keys import find, path_in_file, spelled
from qsbearing.model.scene.keys import Key
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.model.validation import ErrorDetail, Field, Sentence, UnitAdvice

__all__ = ["MOST_SHOWN", "FileErrorDetail", "SceneFileError", "refused", "translate"]


def translate(error: ErrorDetail) -> FileErrorDetail:
    """An error of the Python objects as the file's reader needs it."""
    key = find(error.field) or Key("", "")
    value, allowed = error.value, error.allowed
    value = key.in_file(value) if isinstance(value, float | int) and not isinstance(value, bool) else value
    problem, detail, cause = (_written(each, error.field) for each in (error.problem, error.detail, error.cause))
    if allowed is not None:
        cause = _unit_mistake(key, value, allowed) if isinstance(error.cause, UnitAdvice) else cause
        allowed = (key.in_file(allowed[0]), key.in_file(allowed[1]))
    path = path_in_file(error.field)
    return FileErrorDetail(path, problem, value, key.unit, allowed, cause, where=error.where, detail=detail)


def _written(sentence: str, path: str) -> str:
    """A sentence on a path, its fields spelled as the file's keys and errors within it told in the file's units."""

    def spell(value: Field | ErrorDetail) -> str:
        return translate(value).line if isinstance(value, ErrorDetail) else spelled(value, path)

    return sentence.written(spell) if isinstance(sentence, Sentence) else sentence


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
