"""What is wrong with a file: one exception, which holds every reason."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from numpy.typing import NDArray

from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.model.validation import SceneError, printable, shown

MOST_SHOWN = 50
"""Errors of a file that are told one by one; the others are counted."""


@dataclass(frozen=True)
class FileErrorDetail:
    """One thing wrong with one key."""

    key: str
    """Table and key, e.g. `bearing.ball_diameter_mm`; empty where it is the whole file."""
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
    where: NDArray | None = field(default=None, compare=False, repr=False)
    """Which cases of a study it concerns; None: all of them."""
    detail: str = ""
    """More of the problem, such as its numbers."""

    def __str__(self) -> str:
        return "\n    ".join(map(printable, self._parts()))

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
        self.errors = tuple(errors)  # type: ignore[arg-type]
        count = f"{len(self.errors)} errors" if len(self.errors) != 1 else "1 error"
        lines = [f"{printable(file)}: {count}", *map(str, self.errors[:MOST_SHOWN])]
        if len(self.errors) > MOST_SHOWN:
            lines.append(f"... and {len(self.errors) - MOST_SHOWN:,} more")
        ValueError.__init__(self, "\n".join(lines))


def refused(file: object, problem: str, cause: str = "") -> SceneFileError:
    """A file that cannot be used as a whole."""
    return SceneFileError(str(file), [FileErrorDetail("", problem, cause=cause)])
