"""One case of many: its index along the case axes."""

from __future__ import annotations

CasePlace = tuple[int, ...]
"""The index of one case along each case axis of its solution."""
Index = int | CasePlace | None
"""One case, along the case axes of its solution; None where there is a single case."""


def case_place(index: Index, shape: CasePlace) -> CasePlace:
    """The index of one case along each case axis of a solution of this shape.

    Raises:
        ValueError: the index is missing or does not name one case.
    """
    given = () if index is None else index if isinstance(index, tuple) else (index,)
    if len(given) != len(shape) or not all(-n <= i < n for i, n in zip(given, shape, strict=True)):
        hint = f"{shape} cases; give index, such as {tuple(n - 1 for n in shape)}"
        cases = hint if shape else "a single case; leave index out"
        raise ValueError(f"index = {index!r} names none of its cases: this solution has {cases}")
    return tuple(int(i) % n for i, n in zip(given, shape, strict=True))
