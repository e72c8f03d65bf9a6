"""What is wrong with a scene file, said in the file's own keys and units."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from numpy.typing import NDArray

from qsbearing.files.file_keys import find, path_in_file, spelled
from qsbearing.files.keys import Key
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.model.validation import ErrorDetail, Field, SceneError, Sentence, UnitAdvice, printable, shown

MOST_SHOWN = 50
"""Errors of a file that are told one by one; the others are counted."""


@dataclass(frozen=True)
class FileErrorDetail:
    """One thing wrong with one key."""

    key: str
    """Table and key, e.g. `bearing.ball_diameter_mm`; empty where it is the whole file."""
    problem: str
    """What is wrong, in a sentence."""
    value: Any = None
    """As the file gives it."""
    unit: str = ""
    """Of the key, as files have it; empty where it has none."""
    allowed: tuple[float, float] | None = None
    """Inclusive range, in the file's unit."""
    cause: str = ""
    """What is likely meant, or what to write instead."""
    note: str = ""
    """Where the value came from, if not from the file itself."""
    where: NDArray | None = field(default=None, compare=False, repr=False)
    """Which cases of a study it concerns; None: all of them."""
    detail: str = ""
    """More of the problem, such as its numbers."""

    def __str__(self) -> str:
        return "\n    ".join(map(printable, self._parts()))

    def record(self) -> dict[str, Any]:
        """Its fields as data, those that there are; a value that is no number as a message repeats it."""
        value = self.value if isinstance(self.value, bool | int | float) or self.value is None else shown(self.value)
        fields: dict[str, Any] = {"key": self.key, "problem": self.problem, "detail": self.detail, "value": value}
        fields |= {"unit": self.unit, "allowed": self.allowed and list(self.allowed), "cause": self.cause}
        fields |= {"note": self.note}
        texts = {name: printable(each) if isinstance(each, str) else each for name, each in fields.items()}
        return {name: each for name, each in texts.items() if each not in ("", None)}

    @property
    def line(self) -> str:
        """All of it on one line, for use within another sentence."""
        return ". ".join(map(printable, self._parts()))

    def _parts(self) -> list[str]:
        """The problem, the range and the cause, as far as there are any."""
        head = self.key
        if self.value is not None:
            text = shown(self.value)
            head += f" = {text.lower() if isinstance(self.value, bool) else text}"
            if self.unit and isinstance(self.value, float | int) and not isinstance(self.value, bool):
                head += f" {printed_unit(self.unit)}"
        if self.note:
            head += f" ({self.note})"
        parts = [": ".join(filter(None, (head, self.problem, self.detail)))]
        if self.allowed is not None:
            parts.append(f"allowed: {self.allowed[0]:.6g} to {self.allowed[1]:.6g} {printed_unit(self.unit)}".rstrip())
        return [*parts, self.cause] if self.cause else parts


class SceneFileError(SceneError):
    """A scene file that cannot be used; `errors` holds every reason found, the text the first fifty."""

    def __init__(self, file: str, errors: Iterable[FileErrorDetail]) -> None:
        self.file = file
        """What was read."""
        self.errors = tuple(errors)  # type: ignore[arg-type]
        """Everything that is wrong, each a `FileErrorDetail`."""
        count = f"{len(self.errors)} errors" if len(self.errors) != 1 else "1 error"
        lines = [f"{printable(file)}: {count}", *map(str, self.errors[:MOST_SHOWN])]
        if len(self.errors) > MOST_SHOWN:
            lines.append(f"... and {len(self.errors) - MOST_SHOWN:,} more")
        ValueError.__init__(self, "\n".join(lines))

    def __reduce__(self) -> tuple[type[SceneFileError], tuple[object, ...]]:
        return type(self), (self.file, self.errors)


def refused(file: object, problem: str, cause: str = "") -> SceneFileError:
    """A file that cannot be used as a whole."""
    return SceneFileError(str(file), [FileErrorDetail("", problem, cause=cause)])


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
