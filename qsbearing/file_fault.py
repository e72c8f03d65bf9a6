"""What is wrong with a scene file, said in the file's own keys and units."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from qsbearing.faults import Fault, SceneError, likely_slip
from qsbearing.scene_keys import Key, find, in_file_words, path_in_file


@dataclass(frozen=True)
class FileFault:
    """One thing wrong with one key."""

    key: str
    """Table and key, e.g. `bearing.ball_diameter_mm`; empty where the whole file is at fault."""
    problem: str
    value: Any = None
    """As the file gives it."""
    unit: str = ""
    allowed: tuple[float, float] | None = None
    """Inclusive range, in the file's unit."""
    cause: str = ""
    """What is likely meant, or what to write instead."""
    note: str = ""
    """Where the value came from, if not from the file itself."""

    def __str__(self) -> str:
        head = self.key
        if self.value is not None:
            head += f" = {_shown(self.value)}"
            if self.unit and isinstance(self.value, float | int):
                head += f" {self.unit}"
        if self.note:
            head += f" ({self.note})"
        lines = [f"{head}: {self.problem}" if head else self.problem]
        if self.allowed is not None:
            lines.append(f"    allowed: {self.allowed[0]:.6g} to {self.allowed[1]:.6g} {self.unit}".rstrip())
        if self.cause:
            lines.append(f"    {self.cause}")
        return "\n".join(lines)


class SceneFileError(SceneError):
    """A scene file that cannot be used; `faults` holds every reason found, and the text shows them all."""

    def __init__(self, file: str, faults: Iterable[FileFault]) -> None:
        self.file = file
        self.faults = tuple(faults)  # type: ignore[arg-type]
        count = f"{len(self.faults)} faults" if len(self.faults) != 1 else "1 fault"
        ValueError.__init__(self, "\n".join([f"{file}: {count}", *map(str, self.faults)]))


def translate(fault: Fault) -> FileFault:
    """A fault of the Python objects as the file's reader needs it."""
    key = find(fault.field)
    path = path_in_file(fault.field)
    problem, cause = in_file_words(fault.problem), fault.cause
    value, allowed = fault.value, fault.allowed
    unit, size = (key.unit, key.size) if key else ("", 1.0)
    judged = fault.quantity is not None and allowed is not None and isinstance(value, float | int)
    # Python's advice on units is about SI; the file's unit needs its own. A more particular cause stays.
    if judged and cause == likely_slip(value, fault.quantity, *allowed):  # type: ignore[arg-type,misc]
        cause = slip_of_unit(key, value / size, allowed)  # type: ignore[arg-type]
    if isinstance(value, float | int) and not isinstance(value, bool):
        value = _clean(value / size)
    if allowed is not None:
        allowed = (allowed[0] / size, allowed[1] / size)
    return FileFault(path, problem, value, unit, allowed, in_file_words(cause))


def slip_of_unit(key: Key | None, value: float, allowed: tuple[float, float]) -> str:
    """A sentence naming the unit in which a value out of range would be in range; empty where none would.

    Args:
        value: in the key's unit.
        allowed: inclusive range, SI.
    """
    if key is None or key.quantity is None:
        return ""
    for name, size in key.quantity.slips:
        in_si = value * size
        if size != key.size and value != 0.0 and allowed[0] <= in_si <= allowed[1]:
            return f"Given in {name}? {value:.6g} {name} = {in_si / key.size:.6g} {key.unit}"
    return ""


def _clean(value: float) -> float:
    """The value without the rounding of its way to SI and back."""
    return float(f"{value:.12g}")


def _shown(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        text = str(value) if value.bit_length() < 64 else f"{'-' if value < 0 else ''}<an integer beyond 64 bits>"
    elif isinstance(value, float):
        text = f"{value:.10g}"
    else:
        text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
