"""All contacts of one raceway, as a solution has them."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from qsbearing.kernel import results as readings

if TYPE_CHECKING:
    from qsbearing.solution.solution import Solution


class RacewayContacts:
    """All contacts of one raceway; arrays of shape (*cases, ball), computed when first asked for.

    NaN stands where there is no number: cases not solved, balls beyond a case's ball count, and the angle and approach
    of a ball at rest that touches neither raceway, whose position is undetermined.
    """

    def __init__(self, solution: Solution, row: int) -> None:
        self._solution = solution
        self._row = row
        # What has been read the solution holds, not this object: no cycle keeps a large solution alive.

    if not TYPE_CHECKING:  # type checkers know the names themselves

        def __getattr__(self, name: str) -> Any:
            """A name that there is not, with those that may be meant."""
            names = [each for each in dir(type(self)) if not each.startswith("_")]
            meant = [each for each in names if name in each] or get_close_matches(name, names, cutoff=0.5)
            hint = f"did you mean {' or '.join(meant)}?" if meant else f"there are {', '.join(names)}"
            raise AttributeError(f"contacts have no {name!r}: {hint}", name=name, obj=self)

    def _read(self, what: int) -> NDArray:
        return self._solution._read(self._row, what)

    @property
    def angle(self) -> NDArray:
        """From the radial plane towards +x [rad]; of an unloaded contact, the line it would act in."""
        return self._read(readings.ANGLE)

    @property
    def sine(self) -> NDArray:
        """Of the angle [-]."""
        return self._read(readings.SINE)

    @property
    def cosine(self) -> NDArray:
        """Of the angle [-]."""
        return self._read(readings.COSINE)

    @property
    def load(self) -> NDArray:
        """Normal load Q, zero where the ball has lost the raceway [N]."""
        return self._read(readings.LOAD)

    @property
    def approach(self) -> NDArray:
        """Elastic approach of ball and ring; negative: the gap of a lost contact [m]."""
        return self._read(readings.APPROACH)

    @property
    def semi_major_axis(self) -> NDArray:
        """Of the ellipse, a [m]; zero without load."""
        return self._read(readings.SEMI_MAJOR_AXIS)

    @property
    def semi_minor_axis(self) -> NDArray:
        """Of the ellipse, b [m]; zero without load."""
        return self._read(readings.SEMI_MINOR_AXIS)

    @property
    def max_pressure(self) -> NDArray:
        """Hertz's p0 at the centre of the ellipse [Pa]; zero without load."""
        return self._read(readings.MAX_PRESSURE)

    @property
    def required_friction(self) -> NDArray | None:
        """Coefficient of friction that the gyroscopic moment demands here, lambda |Mg|/(D Q); None without that effect.

        Above what the contact offers (0.06 to 0.1 is typical) the ball slips and raceway control no longer holds.
        """
        if self._solution.scene.gyroscopic_moment is None:
            return None
        return self._read(readings.REQUIRED_FRICTION)
