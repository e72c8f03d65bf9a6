"""All contacts of one raceway, as a solution has them."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from numpy.typing import NDArray

from qsbearing.kernel import results as readings

if TYPE_CHECKING:
    from qsbearing.solution import Solution


def _contact_result(what: int, unit: str, meaning: str) -> cached_property[NDArray]:
    """A property of `RacewayContacts` with its docstring."""

    def read(contacts: RacewayContacts) -> NDArray:
        return contacts._solution._read(contacts._side, what, unit)

    read.__doc__ = meaning
    return cached_property(read)


class RacewayContacts:
    """All contacts of one raceway; arrays of shape (*cases, ball), computed when first asked for.

    NaN stands where there is no number: cases not solved, balls beyond a case's ball count, and the angle and approach
    of a ball at rest that touches neither raceway, whose position is undetermined.
    """

    angle = _contact_result(
        readings.ANGLE, "", "From the radial plane towards +x [rad]; of an unloaded contact, the line it would act in."
    )
    load = _contact_result(readings.LOAD, "force", "Normal load Q, zero where the ball has lost the raceway [N].")
    approach = _contact_result(
        readings.APPROACH, "length", "Elastic approach of ball and ring; negative: the gap of a lost contact [m]."
    )
    semi_major_axis = _contact_result(readings.SEMI_MAJOR_AXIS, "length", "Of the ellipse, a [m]; zero without load.")
    semi_minor_axis = _contact_result(readings.SEMI_MINOR_AXIS, "length", "Of the ellipse, b [m]; zero without load.")
    max_pressure = _contact_result(
        readings.MAX_PRESSURE, "pressure", "Hertz's p0 at the centre of the ellipse [Pa]; zero without load."
    )

    def __init__(self, solution: Solution, side: float) -> None:
        self._solution = solution
        self._side = side

    @cached_property
    def required_friction(self) -> NDArray | None:
        """Coefficient of friction that the gyroscopic moment demands here, lambda |Mg|/(D Q); None without that effect.

        Above what the contact offers (0.06 to 0.1 is typical) the ball slips and raceway control no longer holds.
        """
        asked = self._solution.scene.gyroscopic_moment
        return self._solution._read_if(asked, self._side, readings.REQUIRED_FRICTION, "")
