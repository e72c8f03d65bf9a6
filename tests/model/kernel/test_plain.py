"""Plain Python finds what the machine code finds, to the last bit."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from tests.model.kernel.plain import digits, in_plain_python
from tests.verification.campaign.chunk import groups_of
from tests.verification.hard_cases.cases import CASES
from tests.verification.hard_cases.scenes import scene_of

pytestmark = pytest.mark.skipif(not has_fast_code(), reason="nothing is compiled")


def assert_same(scene: qs.Scene) -> None:
    expected = digits(qs.solve(scene))
    with in_plain_python():
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
@pytest.mark.parametrize(("envelope", "count"), [("realistic", 300), ("wild", 100)])
def test_hundreds_of_scenes_of_the_campaigns(envelope: str, count: int) -> None:
    """Wild ones take a second each in plain Python."""
    for scene in campaign(envelope, count):
        assert_same(scene)


@pytest.mark.heavy
@pytest.mark.parametrize("name", [case["name"] for case in CASES])
def test_hard_cases(name: str) -> None:
    assert_same(scene_of(name))


def test_several_cases_are_as_one_by_one() -> None:
    scene = qs.load_scene("b218")
    several = replace(scene, operation=replace(scene.operation, speed=np.linspace(1e3, 9e3, 9) * qs.rpm))
    expected = qs.solve(several)
    with in_plain_python():
        found = qs.solve(several)
        assert np.array_equal(found.displacement, expected.displacement)
        assert np.array_equal(found.iterations, expected.iterations)
        assert np.array_equal(found.inner.load, expected.inner.load)
