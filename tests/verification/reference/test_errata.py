"""The source's errors put back one at a time: the equations without them are the package's, each of them shows."""

from __future__ import annotations

import numpy as np
import pytest

from tests.verification.reference import errata

HERTZ_DIGITS = 1e-6
"""Ki and Ko are written with eight digits; angles and displacements follow them at this part."""


@pytest.mark.parametrize("inner_control", [False, True])
def test_the_corrected_equations_are_those_of_the_package(inner_control: bool) -> None:
    solution = errata.package(inner_control=inner_control)
    found = errata.solve(errata.Equations(inner_control=inner_control), errata.start_of(solution))
    expected = (
        *solution.displacement[:2] * 1e6,
        solution.displacement[4] * 1e3,
        *(np.degrees(side.angle[0]) for side in (solution.inner, solution.outer)),
        solution.inner.load[0],
    )
    assert list(found.values()) == pytest.approx(expected, rel=HERTZ_DIGITS)


def test_each_error_shows() -> None:
    """Whatever has a number differs from the corrected one by more than it is printed with."""
    found = errata.effects()
    for place in ("(19.14)", "(19.15)", "(19.3)", "ωR, Mg"):
        assert found[place].count("→") >= 1, place
    assert "BD 12.14 mm in place of 1.031 mm" in found["(19.7)"]
    assert "αi changes by +" in found["conclusion"]
    assert "αo by -" in found["conclusion"]
