"""The check that a ball which only Newton's and Euler's laws move goes as the product says."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

import qsbearing as qs
from fem_check.checks import ALL, free_ball
from fem_check.rows.agreement import AgreementRow, MeshLevel
from qsbearing.model.compiler.compiled import has_fast_code

pytestmark = pytest.mark.skipif(not has_fast_code(), reason="one of its scenes is solved by friction")


def failing(rows: list[AgreementRow]) -> set[str]:
    return {row.quantity for row in rows if row.verdict == "fail"}


def run(level: MeshLevel = MeshLevel.QUICK) -> list[AgreementRow]:
    return ALL["free_ball"].run(level, lambda stage, part: None).rows


def test_the_product_goes_as_free_balls_do() -> None:
    rows = run()
    assert failing(rows) == set()
    assert len(rows) == 18
    # The moment is a large part of what turns the contact lines: not a row that any product would pass.
    without = replace(next(iter(free_ball.scenes().values())), ball_effects=(qs.CentrifugalForce(),))
    angle = qs.solve(without).inner.angle[0] / qs.deg
    (row,) = [row for row in rows[:6] if row.quantity == "inner angle"]
    assert abs(angle - row.reference) > 50.0 * 0.01 * row.tolerance_percent * row.reference


@pytest.mark.parametrize(
    ("planted", "seen"),
    [
        ({"density": 1.002}, {"gyroscopic moment", "inner load", "outer load"}),
        ({"elastic_modulus": 1.02}, {"inner angle", "orbital speed"}),
    ],
)
def test_an_error_in_the_product_is_seen(
    planted: dict[str, float], seen: set[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Balls of the product alone that are 0.2 % heavier, or 2 % stiffer."""
    right = qs.solve

    def off(scene: qs.Scene, **more: Any) -> qs.Solution:
        (name, factor), material = *planted.items(), scene.bearing.ball_material
        other = replace(material, **{name: factor * getattr(material, name)})
        return right(replace(scene, bearing=replace(scene.bearing, ball_material=other)), **more)

    monkeypatch.setattr(qs, "solve", off)
    assert failing(run()) >= seen
