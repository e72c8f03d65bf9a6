"""Array fields that do not broadcast to common case axes, by name."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations
from typing import Any

import numpy as np

from qsbearing.model.material import Material
from qsbearing.model.validation import ErrorDetail

Shapes = dict[str, tuple[int, ...]]


def shapes_of(named: Iterable[tuple[str, Any]]) -> Shapes:
    """The shapes of the array fields of these objects, materials within them included, by path."""
    shapes: Shapes = {}
    for path, holder in named:
        for name, value in getattr(holder, "__dict__", {}).items():
            if value is None or isinstance(value, float | int | str | tuple):
                continue  # at once, for most values are plain numbers
            if isinstance(value, Material):
                shapes |= shapes_of([(f"{path}.{name}", value)])
            elif np.ndim(value):
                shape = np.shape(value)
                # the last axis of deviations is the balls'
                shapes[f"{path}.{name}"] = shape[:-1] if name in getattr(holder, "of_each_ball", ()) else shape
    return shapes


def clash_errors(shapes: Shapes) -> list[ErrorDetail]:
    """The error that names the fields whose shapes do not broadcast; empty where all do."""
    clashing: Shapes = {}
    for (one, its), (other, others) in combinations(shapes.items(), 2):
        try:
            np.broadcast_shapes(its, others)
        except ValueError:
            clashing |= {one: its, other: others}
    if not clashing:
        return []
    first = next(iter(clashing))
    named = ", ".join(f"{path} {shape}" for path, shape in clashing.items())
    cause = f"To combine each with each, give one of them an axis of its own: {first.rpartition('.')[2]}[:, None]"
    return [ErrorDetail(first, f"arrays do not broadcast to common case axes: {named}", cause=cause)]
