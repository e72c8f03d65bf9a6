"""All contacts of one raceway, as a solution has them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar

from numpy.typing import NDArray

from qsbearing.model.kernel import results
from qsbearing.model.validation import alike, question

CODES = {
    name: getattr(results, name.upper())
    for name in (
        *("angle", "sine", "cosine", "load", "approach", "semi_major_axis", "semi_minor_axis", "max_pressure"),
        *("required_friction", "centrifugal_force", "gyroscopic_moment"),
        *("orbital_speed", "rotation_speed", "attitude_angle", "axial_rotation", "radial_rotation"),
    )
}
"""What the kernel calls the arrays of contacts and of balls."""
CALLED_FOR_BY = {
    "required_friction": "gyroscopic_moment",
    "centrifugal_force": "centrifugal_force",
    "gyroscopic_moment": "gyroscopic_moment",
} | dict.fromkeys(
    ("orbital_speed", "rotation_speed", "attitude_angle", "axial_rotation", "radial_rotation"), "raceway_control"
)
"""The field of the scene without which there is no such array."""
T = TypeVar("T")


class Lazy(Generic[T]):
    """A property of contacts or balls: an array that the kernel reads off when it is first asked for."""

    def __init__(self, doc: str) -> None:
        self.__doc__ = doc

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, holder: Any, owner: type) -> T:
        value: Any = self if holder is None else holder._array(self._name)
        return value


class OppositeContacts(NamedTuple):
    """Of a four-point bearing, the contacts of those arcs that carry angles below zero; None of a ring with one arc."""

    inner: RacewayContacts | None
    outer: RacewayContacts | None


class RacewayContacts:
    """All contacts of one raceway; arrays of shape (*cases, ball), computed when first asked for.

    NaN stands where there is no number: cases not solved, balls beyond a case's ball count, and the angle and approach
    of a ball at rest that touches neither raceway, whose position is undetermined.
    """

    def __init__(self, read: Callable[[str], NDArray | None]) -> None:
        self._array = read
        # What has been read the solution holds, not this object: no cycle keeps a large solution alive.

    if not TYPE_CHECKING:  # type checkers know the names themselves

        def __getattr__(self, name: str) -> Any:
            """A name that there is not, with those that may be meant."""
            names = [each for each in dir(type(self)) if not each.startswith("_")]
            hint = question(alike(name, names)) or f"There are {', '.join(names)}"
            raise AttributeError(f"contacts have no {name!r}. {hint}", name=name, obj=self)

    angle = Lazy[NDArray]("From the radial plane towards +x [rad]; of an unloaded contact, the line it would act in.")
    sine = Lazy[NDArray]("Of the angle [-].")
    cosine = Lazy[NDArray]("Of the angle [-].")
    load = Lazy[NDArray]("Normal load Q, zero where the ball has lost the raceway [N].")
    approach = Lazy[NDArray]("Elastic approach of ball and ring; negative: the gap of a lost contact [m].")
    semi_major_axis = Lazy[NDArray]("Of the ellipse, a [m]; zero without load.")
    semi_minor_axis = Lazy[NDArray]("Of the ellipse, b [m]; zero without load.")
    max_pressure = Lazy[NDArray]("Hertz's p0 at the centre of the ellipse [Pa]; zero without load.")
    required_friction = Lazy[NDArray | None](
        """Coefficient of friction that the gyroscopic moment demands here, lambda |Mg|/(D Q) [-]; None without it.

        Above what the contact offers (0.06 to 0.1 is typical) the ball slips and raceway control no longer holds.
        """
    )
    apex_margin = Lazy[NDArray | None](
        """From the end of the ellipse to the apex of an arched groove, along the groove [m].

        Below zero the ellipse would pass it; NaN without load; None where the groove has one arc.
        """
    )
