"""The bricks that the checks need, graded towards the contact."""

from __future__ import annotations

import numpy as np

from fem_check.meshing.recipe import Recipe, Segment


def growing(length: float, first: float, growth: float) -> Segment:
    """A segment whose elements grow from about `first` by about `growth` to fill `length`."""
    elements, reached, size = 0, 0.0, first
    while reached < 0.98 * length:
        size *= growth
        reached += size
        elements += 1
    return Segment(length, elements, growth)


# What the block needs, measured on B218's contacts. Beyond the candidates the pressure is smooth seen from afar: growth
# 1.3 or 1.7 sideways and 8 or 6 elements per semi-axis in depth move nothing by more than 0.002 %; the far field is
# exact, so 1.8, 2.5 or 3.5 semi-axes to the cut agree to 0.001 %. All of the error is in how finely the contact's
# surface is divided, and there the elements go.
CUT = 2.5
CANDIDATES = 1.25
SIDE_GROWTH = 1.7
DEPTH_GROWTH = 1.3
FINE_DEPTH = 0.5
BOX_SIDE_GROWTH, BOX_DEPTH_GROWTH = 2.6, 2.0
"""Of clamped boxes, whose walls are far: 1.7 and 1.5 move the limit of their approaches by 0.007 %."""


def half_space(elements: int) -> Recipe:
    """A block cut out of a half-space, in semi-axes of the contact: x/a, y/b, z/b."""
    if elements < 2:
        raise ValueError(f"elements = {elements}: at least 2 per semi-axis")
    inner = Segment(CANDIDATES, max(2, round(CANDIDATES * elements)))
    outer = growing(CUT - CANDIDATES, 1.0 / elements, SIDE_GROWTH)
    layers = max(2, round(0.25 * elements) + 1)
    deep = growing(CUT - FINE_DEPTH, FINE_DEPTH / layers, DEPTH_GROWTH)
    return Recipe(
        f"half_space_{elements:02d}", elements, (inner, outer), (inner, outer), (Segment(FINE_DEPTH, layers), deep)
    )


def load_series(elements: int, span: float) -> Recipe:
    """One block for contacts from 1 to `span` times the smallest: elements grow with the distance.

    Lengths are in semi-axes of the smallest contact; `elements` counts those on the outer 1 of any semi-axis's length.
    """
    inner = Segment(1.0, elements)
    growth = 1.0 + 1.0 / elements
    middle_length = CANDIDATES * span - 1.0
    count = round(np.log(CANDIDATES * span) / np.log(growth))
    middle = Segment(middle_length, count, float((CANDIDATES * span) ** (1.0 / count)))
    outer = growing((CUT - CANDIDATES) * span, CANDIDATES * span / elements, SIDE_GROWTH)
    layers = max(2, round(0.25 * elements) + 1)
    deep = growing(CUT * span - FINE_DEPTH, FINE_DEPTH / layers, 1.4)
    name = f"load_series_{elements:02d}_{span:.2f}"
    return Recipe(
        name, elements, (inner, middle, outer), (inner, middle, outer), (Segment(FINE_DEPTH, layers), deep), 2
    )


def clamped_box(elements: int, size: float, ellipticity: float) -> Recipe:
    """A box of `size` semi-major axes in each direction round a contact's quarter; lengths in semi-axes, z in b."""
    near = half_space(elements)
    inner, fine = near.x[0], near.z[0]
    first = 1.0 / elements
    along = growing(size - inner.length, first, BOX_SIDE_GROWTH)
    across = growing(size * ellipticity - inner.length, first, BOX_SIDE_GROWTH)
    deep = growing(size * ellipticity - fine.length, fine.length / fine.elements, BOX_DEPTH_GROWTH)
    name = f"clamped_box_{elements:02d}_{size:g}_{ellipticity:g}"
    return Recipe(name, elements, (inner, along), (inner, across), (fine, deep))


COMMITTED = (
    *(half_space(elements) for elements in (3, 4, 5, 6, 8)),
    *(load_series(elements, 2.8) for elements in (3, 4, 6)),
    *(clamped_box(3, size, 8.2) for size in (8.0, 16.0, 32.0)),
)
"""The meshes of the quick level."""
