"""Small dense systems, written out for the kernel: calling a library costs more than solving them."""

from __future__ import annotations

from numpy import ndarray

from qsbearing.model.compiler.compiled import kernel


@kernel
def solve_in_place(matrix: ndarray, right_side: ndarray, size: int) -> bool:
    """Solve the leading size x size system by Gaussian elimination with partial pivoting.

    Overwrites both arguments; the solution stands in `right_side`. Returns False where a pivot vanishes.
    """
    for column in range(size):
        pivot = column
        for row in range(column + 1, size):
            if abs(matrix[row, column]) > abs(matrix[pivot, column]):
                pivot = row
        if not abs(matrix[pivot, column]) > 0.0:
            return False
        if pivot != column:
            for k in range(column, size):
                matrix[column, k], matrix[pivot, k] = matrix[pivot, k], matrix[column, k]
            right_side[column], right_side[pivot] = right_side[pivot], right_side[column]
        inverse = 1.0 / matrix[column, column]
        for row in range(column + 1, size):
            factor = matrix[row, column] * inverse
            if factor != 0.0:
                for k in range(column + 1, size):
                    matrix[row, k] -= factor * matrix[column, k]
                right_side[row] -= factor * right_side[column]
    for row in range(size - 1, -1, -1):
        value = right_side[row]
        for k in range(row + 1, size):
            value -= matrix[row, k] * right_side[k]
        right_side[row] = value / matrix[row, row]
    return True


@kernel
def eliminate(system: ndarray, size: int, columns: int) -> bool:
    """The same for several right sides, which stand after the matrix in its rows, up to this column."""
    for column in range(size):
        pivot = column
        for row in range(column + 1, size):
            if abs(system[row, column]) > abs(system[pivot, column]):
                pivot = row
        if not abs(system[pivot, column]) > 0.0:
            return False
        inverse = 1.0 / system[pivot, column]
        for k in range(column, columns):
            system[column, k], system[pivot, k] = system[pivot, k], system[column, k]
        for k in range(column + 1, columns):
            system[column, k] *= inverse
        for row in range(size):
            factor = system[row, column]
            if row != column and factor != 0.0:
                for k in range(column + 1, columns):
                    system[row, k] -= factor * system[column, k]
    return True
