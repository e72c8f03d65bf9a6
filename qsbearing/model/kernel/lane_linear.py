"""The rings' small systems solved in lanes: `solve_in_place` of sixteen cases at once, with its digits.

A row is a tuple, its right side last: what stands in no array can be packed whatever the order of the rows.
"""

from __future__ import annotations

from numpy import recarray

from qsbearing.model.compiler.compiled import inlined, kernel
from qsbearing.model.kernel.lane_state import LANES

Row = tuple[float, float, float, float, float, float]


@kernel
def solve_lanes(ring: recarray) -> None:
    """Solve each lane's system: the solution stands in its right side, the least size of a pivot in `ring.pivot`."""
    for lane in range(LANES):
        row0, row1, row2 = row_in(ring, lane, 0), row_in(ring, lane, 1), row_in(ring, lane, 2)
        x, ring.pivot[lane] = solved(row0, row1, row2, row_in(ring, lane, 3), row_in(ring, lane, 4))
        ring.right_side[0, lane], ring.right_side[1, lane], ring.right_side[2, lane] = x[0], x[1], x[2]
        ring.right_side[3, lane], ring.right_side[4, lane] = x[3], x[4]


@kernel
def leave_out_others(ring: recarray, work: recarray) -> None:
    """Make each channel that the lanes' cases do not solve an equation of its own, beside the others."""
    following = 0
    for i in range(5):
        if following < work.channel_count and work.channel[following] == i:
            following += 1
            continue
        for lane in range(LANES):
            ring.right_side[i, lane] = 0.0
            for k in range(5):
                ring.matrix[i, k, lane], ring.matrix[k, i, lane] = 0.0, 0.0
            ring.matrix[i, i, lane] = 1.0


@inlined
def row_in(ring: recarray, lane: int, row: int) -> Row:
    """A row of a lane's system."""
    return (
        ring.matrix[row, 0, lane], ring.matrix[row, 1, lane], ring.matrix[row, 2, lane], ring.matrix[row, 3, lane],
        ring.matrix[row, 4, lane], ring.right_side[row, lane],
    )  # fmt: skip


@inlined
def solved(a: Row, b: Row, c: Row, d: Row, e: Row) -> tuple[tuple[float, ...], float]:
    """(the solution of five rows, the least size of a pivot)."""
    n = largest_of(a[0], b[0], c[0], d[0], e[0])
    a, b = exchanged(n == 1.0, a, b)
    a, c = exchanged(n == 2.0, a, c)
    a, d = exchanged(n == 3.0, a, d)
    a, e = exchanged(n == 4.0, a, e)
    inverse = 1.0 / a[0]
    b, c = reduced(b, b[0] * inverse, a), reduced(c, c[0] * inverse, a)
    d, e = reduced(d, d[0] * inverse, a), reduced(e, e[0] * inverse, a)
    n = largest_of(b[1], c[1], d[1], e[1], 0.0)
    b, c = exchanged(n == 1.0, b, c)
    b, d = exchanged(n == 2.0, b, d)
    b, e = exchanged(n == 3.0, b, e)
    inverse = 1.0 / b[1]
    c, d, e = reduced(c, c[1] * inverse, b), reduced(d, d[1] * inverse, b), reduced(e, e[1] * inverse, b)
    n = largest_of(c[2], d[2], e[2], 0.0, 0.0)
    c, d = exchanged(n == 1.0, c, d)
    c, e = exchanged(n == 2.0, c, e)
    inverse = 1.0 / c[2]
    d, e = reduced(d, d[2] * inverse, c), reduced(e, e[2] * inverse, c)
    d, e = exchanged(largest_of(d[3], e[3], 0.0, 0.0, 0.0) == 1.0, d, e)
    e = reduced(e, e[3] * (1.0 / d[3]), d)
    x4 = e[5] / e[4]
    x3 = (d[5] - d[4] * x4) / d[3]
    x2 = (c[5] - c[3] * x3 - c[4] * x4) / c[2]
    x1 = (b[5] - b[2] * x2 - b[3] * x3 - b[4] * x4) / b[1]
    x0 = (a[5] - a[1] * x1 - a[2] * x2 - a[3] * x3 - a[4] * x4) / a[0]
    return (x0, x1, x2, x3, x4), min(min(min(abs(a[0]), abs(b[1])), min(abs(c[2]), abs(d[3]))), abs(e[4]))


@inlined
def largest_of(a: float, b: float, c: float, d: float, e: float) -> float:
    """Which is largest, the first of equals."""
    n, largest = 0.0, abs(a)
    n, largest = (1.0 if abs(b) > largest else n), (abs(b) if abs(b) > largest else largest)
    n, largest = (2.0 if abs(c) > largest else n), (abs(c) if abs(c) > largest else largest)
    n, largest = (3.0 if abs(d) > largest else n), (abs(d) if abs(d) > largest else largest)
    return 4.0 if abs(e) > largest else n


@inlined
def exchanged(is_so: bool, one: Row, other: Row) -> tuple[Row, Row]:
    """Two rows, or the other way round."""
    return (other, one) if is_so else (one, other)


@inlined
def reduced(row: Row, factor: float, by: Row) -> Row:
    """A row less so much of another."""
    return (
        row[0] - factor * by[0], row[1] - factor * by[1], row[2] - factor * by[2], row[3] - factor * by[3],
        row[4] - factor * by[4], row[5] - factor * by[5],
    )  # fmt: skip
