"""How far a value may move from the previous release's, though it is still within its tolerance; and why so far."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Limit:
    """A bound and its reason."""

    value: float
    why: str


REFERENCE = Limit(
    1e-6,
    "per cent of the value: a reference is a closed form, a quadrature or a boundary-element solution converged to "
    "1e-10; only rounding moves it",
)

SAME_MESH = Limit(
    1e-5,
    "per cent of the reference: on the same mesh only rounding moves a value, by 1e-12 % where another linear solver "
    "is taken (measured), and by what the tolerance of an iterated equilibrium leaves",
)

FLAT_MAXIMUM = Limit(
    1e-3,
    "per cent of the reference: the place of a maximum, near which the curve is flat: moved by 1e-5, the value there "
    "differs by 1e-10, and the search for it sees no more",
)

FLAT = ("max_shear_depth",)
"""Quantities that are places of a maximum."""

OF_TOLERANCE = Limit(
    0.1,
    "of the tolerance, where that is less than rounding may move other values: such a row is itself about rounding",
)

ANOTHER_MESH = "per cent of the reference: the mesh is another one than before, and both have their uncertainty"


def of_row(
    quantity: str, same_mesh: bool, uncertainties: tuple[float | None, float | None], tolerance: float | None
) -> Limit:
    """The limit of a value that is compared with its reference, in per cent of it.

    Args:
        tolerance: in per cent; None for a finding.
        uncertainties: of the previous value and of the present one, in per cent; None where nothing is discretised.
    """
    rounding = FLAT_MAXIMUM if any(name in quantity for name in FLAT) else SAME_MESH
    both = sum(value or 0.0 for value in uncertainties)
    if same_mesh or both <= rounding.value:
        of_tolerance = rounding.value if tolerance is None else OF_TOLERANCE.value * tolerance
        if of_tolerance < rounding.value:
            return Limit(of_tolerance, f"{OF_TOLERANCE.value:g} {OF_TOLERANCE.why}")
        return rounding
    return Limit(both, ANOTHER_MESH)


HARD_CASE_ROUNDING = Limit(
    10.0,
    "times the larger of the previous error and what the case's condition number makes of 2^-52: errors of this kind "
    "are sums of roundings, which differ between processors and mathematical libraries by some such factor",
)

HARD_CASE_LEAST = Limit(1e-12, "relative: the solver's own tolerance; below it an error is rounding alone")

CAMPAIGN_SCENES = Limit(
    2e-4,
    "of all scenes: those that are on the verge of two classes, which rounding decides; as many as may be not "
    "converged in the wild envelope",
)

TIME_RATIO = Limit(
    1.5,
    "times the previous ratio, by the lower end of its spread: on one machine under a load of 7 the medians of three "
    "runs differ by 3 and 7 %, and between processors the ratio of two loops differs by more",
)

QUICK_TIME_RATIO = Limit(
    2.0,
    "times the previous ratio, by the lower end of its spread: a few rounds in one process, on whatever machine "
    "continuous integration has",
)

ITERATIONS = Limit(1.0, "per cent of the mean: the same points from the same start, up to rounding")
