"""Preload: how the bearing is pressed together before anything else acts on it."""

from __future__ import annotations

from dataclasses import dataclass, field

from numpy.typing import ArrayLike

from qsbearing.model.described import given_in
from qsbearing.model.operation import DISPLACEMENTS, LOADS
from qsbearing.model.validation import FORCE, LENGTH, ErrorDetail, Field, Sentence, raise_if_any, within

KINDS = ("spring", "rigid", "mounted", "axial_displacement")
FORCES = ("spring", "rigid", "mounted")
"""Those that are forces."""

NOT_A_PRELOAD = f"qs.Preload(...) with one of {', '.join(KINDS)}"
"""What to write in its place."""

PRELOADS = (0.0, LOADS[1])
"""Of a force, in SI."""


@dataclass(frozen=True)
class Preload:
    """A preload in +x, in one of four ways; SI units, which may be arrays that span cases.

    All but a spring hold the rings where the preload took them: at a displacement that grows with the heat of the shaft
    and by nothing else (`RingExpansion.shaft_temperature`; the inner ring's where it is left out).

    Raises:
        SceneError: none of them, several, or one out of its range.
    """

    spring: ArrayLike | None = field(default=None, metadata=given_in("N", PRELOADS, words="spring preload"))
    """The force of a spring, which stays what it is whatever the rings do [N]."""
    rigid: ArrayLike | None = field(default=None, metadata=given_in("N", PRELOADS, words="rigid preload"))
    """The axial load at rest and cold, before fitting [N]; the rings are then held at the axial displacement that it
    takes. Fits change the load to the mounted one."""
    axial_displacement: ArrayLike | None = field(default=None, metadata=given_in("um", DISPLACEMENTS, goes_last=True))
    """Of the inner ring, from where the free contact angle is just reached at rest and cold [m]; the rings are
    held there."""
    mounted: ArrayLike | None = field(default=None, metadata=given_in("N", PRELOADS, words="mounted preload"))
    """The axial load after fitting, at rest and at the reference temperature [N]; the rings are held where it
    leaves them."""

    def __post_init__(self) -> None:
        raise_if_any(preload_errors(self))

    @property
    def kind(self) -> str:
        """The way that is given: spring, rigid, mounted or axial_displacement."""
        return next(kind for kind in KINDS if getattr(self, kind) is not None)

    @property
    def is_given_mounted(self) -> bool:
        """Whether it is what presses the bearing after fitting, and not before."""
        return self.mounted is not None

    @property
    def state(self) -> str:
        """In which it is given, in words."""
        return "mounted" if self.is_given_mounted else "before fitting"


def preload_errors(preload: Preload) -> list[ErrorDetail]:
    """Every error of a preload."""
    given = [kind for kind in KINDS if getattr(preload, kind) is not None]
    if len(given) != 1:
        first, *others = (Field(f"preload.{kind}") for kind in given or KINDS)
        problem = Sentence("is given together with {others}", others=tuple(others)) if given else "is missing"
        cause = Sentence("Give one of {kinds}", kinds=tuple(Field(f"preload.{kind}") for kind in KINDS))
        return [ErrorDetail(first, problem, cause=cause)]
    (kind,) = given
    if kind == "axial_displacement":
        return within(f"preload.{kind}", preload.axial_displacement, LENGTH, *DISPLACEMENTS)
    errors = within(f"preload.{kind}", getattr(preload, kind), FORCE, *PRELOADS)
    if errors and isinstance(errors[0].value, float) and errors[0].value < 0.0:
        cause = Sentence(
            "A preload acts in +x; for -x, give {load} or {displacement} instead",
            load=Field("operation.axial_load"), displacement=Field("operation.axial_displacement"),
        )  # fmt: skip
        return [
            ErrorDetail(f"preload.{kind}", "is negative", errors[0].value, FORCE, (0.0, 1e8), cause, errors[0].where)
        ]
    return errors


def axial_channel_errors(operation: object) -> list[ErrorDetail]:
    """Errors of an operation that has an axial load or displacement of its own in addition to a preload."""
    problem = "is given together with a preload, which sets the axial channel"
    cause = "Keep one of the two: with both, the load of the ring is not defined"
    return [
        ErrorDetail(f"operation.{name}", problem, cause=cause)
        for name in ("axial_load", "axial_displacement")
        if getattr(operation, name) is not None
    ]
