"""Twins are the scene that they are said to be, and what differs from its twin is seen."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from tests.verification.campaign.chunk import MOST_DIFFERENCE, Tally, groups_of, judge_twin
from tests.verification.campaign.envelope import chunk_groups
from tests.verification.campaign.group import GROUP, Group
from tests.verification.campaign.invariances import SIZES, TWINS, Twin, changed, compare

FEW = 4


def mounted_groups() -> list[Group]:
    """A few scenes of each of some groups."""
    return [group.part(slice(0, FEW)) for group in chunk_groups(4, 0, 8 * GROUP, "mounted")]


def is_held(group: Group) -> bool:
    """Whether the axial place of the ring is given, by a channel or by a preload."""
    return group.held[0] or "spring_N" not in group.more.get("preload", {"spring_N": ...})


def solved(group: Group) -> qs.Solution:
    return qs.solve(group.scene(), threads=1)


@pytest.mark.parametrize("name", TWINS)
def test_a_twin_is_the_same_bearing(name: str) -> None:
    seen = 0
    for group in mounted_groups():
        twin = TWINS[name](group)
        if twin is None:
            continue
        compared = compare(twin, solved(twin.of), solved(twin.group))
        assert (compared.difference <= MOST_DIFFERENCE).all(), group.toml(int(compared.difference.argmax()), name)
        seen += int(compared.both.sum())
    assert seen > FEW


@pytest.mark.parametrize("name", TWINS)
def test_a_twin_that_differs_is_seen(name: str) -> None:
    """By a load, a speed or a groove a ten-thousandth larger, or by balls in another order."""
    for group in mounted_groups():
        twin = TWINS[name](group)
        if twin is None or is_held(group):
            continue

        def spoil(key: str, value: np.ndarray) -> np.ndarray:
            return value * (1.0 + 1e-4) if key == "inner_groove_radius_mm" else value

        spoilt = replace(twin, group=changed(twin.group, spoil))
        assert (compare(spoilt, solved(twin.of), solved(spoilt.group)).difference > MOST_DIFFERENCE).any()
        return
    pytest.fail("no group has such a twin")


def test_loads_are_compared_as_far_as_positions_are_known() -> None:
    """Of a scene that as cold all through is pressed by little more than a rounding; a length that does not follow by a
    hundredth is seen."""
    [(_, group)] = groups_of("mounted", 1, 6997, 6998)
    twin = TWINS["warmed"](group)
    assert twin is not None
    of, other = solved(twin.of), solved(twin.group)
    assert 0.0 < np.nanmax(of.outer.approach) < 1e-13
    loads = np.nanmax(np.abs(of.outer.load - other.outer.load / twin.size**2)) / np.nanmax(of.outer.load)
    assert loads > MOST_DIFFERENCE
    assert compare(twin, of, other).difference <= 1e-12

    spoilt = solved(changed(twin.group, lambda name, value: value * 1.01 if name == "axial_displacement_um" else value))
    assert compare(twin, of, spoilt).difference > MOST_DIFFERENCE


def test_another_equilibrium_is_noted_and_other_equations_are_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    """Heat is the only twin whose equations may be others."""
    group = next(group for group in mounted_groups() if "ring_expansion" in group.more and not is_held(group))

    def spoilt(of: Group) -> Twin:
        return Twin(of, changed(of, lambda key, value: value * 1.01 if key == "inner_groove_radius_mm" else value))

    for name in ("scaled", "warmed"):
        tally = Tally()
        with monkeypatch.context() as patch:
            patch.setitem(TWINS, name, spoilt)
            number = GROUP * list(TWINS).index(name)
            wrong = judge_twin(tally, number, group, solved(group))
        assert bool(wrong) == (name == "warmed")
        assert bool(tally.noted["twin with another equilibrium"]) == (name == "scaled")


def test_one_of_several_equilibria_is_not_one_of_other_equations(monkeypatch: pytest.MonkeyPatch) -> None:
    """A scene of balls under minimum dissipation that has several: other sizes show it, the first of them does not.

    Rounding decides which of them a twin finds, so some are as warm as it takes for another one.
    """
    [(_, group)] = groups_of("mounted", 1, 88735, 88736)
    at, found = GROUP * list(TWINS).index("warmed"), 0
    for warmer in range(10, 100, 10):
        tally = Tally()
        with monkeypatch.context() as patch:
            patch.setattr("tests.verification.campaign.invariances.WARMER", float(warmer))
            assert judge_twin(tally, at, group, solved(group)) == {}
            if tally.noted["twin with another equilibrium"] == 1:
                found += 1
                patch.setattr("tests.verification.campaign.chunk.SIZES", SIZES[:1])
                assert list(judge_twin(tally, at, group, solved(group))) == [0]
    assert found > 0
