"""Plain Python finds what the compiled kernel finds, to the last bit, however few iterations it is given."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler.compiled import COMPILED
from qsbearing.model.solution import solve_records
from tests.model.kernel.plain import as_new, digits
from tests.verification.campaign.chunk import groups_of
from tests.verification.hard_cases.cases import CASES
from tests.verification.hard_cases.scenes import scene_of

pytestmark = pytest.mark.skipif(not COMPILED, reason="nothing is compiled")


def assert_same(scene: qs.Scene) -> None:
    expected = digits(qs.solve(scene))
    with as_new():
        assert digits(qs.solve(scene)) == expected


def campaign(envelope: str, count: int) -> Iterator[qs.Scene]:
    for _, group in groups_of(envelope, 1, 0, count):
        for k in range(group.size):
            yield group.part(k).scene()


@pytest.mark.parametrize("envelope", ["realistic", "wild"])
def test_a_few_scenes_of_the_campaigns(envelope: str) -> None:
    for scene in campaign(envelope, 6):
        assert_same(scene)


@pytest.mark.heavy
@pytest.mark.parametrize("envelope", ["realistic", "wild"])
def test_hundreds_of_scenes_of_the_campaigns(envelope: str) -> None:
    for scene in campaign(envelope, 300):
        assert_same(scene)


@pytest.mark.heavy
@pytest.mark.parametrize("name", [case["name"] for case in CASES])
def test_hard_cases(name: str) -> None:
    assert_same(scene_of(name))


def test_a_solve_that_takes_all_iterations_is_taken_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """Plain with more of them, then compiled: what is found, iterations included, is the same."""
    scene = qs.load_scene("b218")
    expected = digits(qs.solve(scene))
    taken = int(qs.solve(scene).iterations)
    monkeypatch.setattr(solve_records, "PLAIN_BUDGET", taken - 1)
    assert_same(scene)
    monkeypatch.setattr(solve_records, "PATIENT_BUDGET", taken - 1)
    assert_same(scene)
    with as_new():
        warm = digits(qs.solve(scene, start=qs.solve(scene)))
    assert warm[3] == expected[3]


def test_several_cases_are_as_one_by_one() -> None:
    """Plain, the first of several cases is solved alone, and then twice as many each time."""
    scene = qs.load_scene("b218")
    several = replace(scene, operation=replace(scene.operation, speed=np.linspace(1e3, 9e3, 9) * qs.rpm))
    expected = qs.solve(several)
    with as_new():
        found = qs.solve(several)
        assert np.array_equal(found.displacement, expected.displacement)
        assert np.array_equal(found.iterations, expected.iterations)
        assert np.array_equal(found.inner.load, expected.inner.load)
