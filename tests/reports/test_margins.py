"""What a report opens with: how much of each limit is used, and the answer that follows from it and the remarks."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.contact.hertz import STATIC_PRESSURE
from qsbearing.pictures import margins as picture
from qsbearing.readings.asked import take_asked
from qsbearing.remarks.remark import remark
from qsbearing.reports.margins import Margin, answer, margins, margins_of_set

B218 = qs.load_scene("B218").bearing
BALLS: dict[str, Any] = {
    "ball_effects": (qs.CentrifugalForce(), qs.GyroscopicMoment()),
    "raceway_control": "outer",
}


def of(operation: qs.Operation, **other: Any) -> dict[str, Margin]:
    """Margins of a scene by their names."""
    solution = qs.solve(qs.Scene(B218, operation, **other))
    return {each.what: each for each in margins(solution, take_asked(solution))}


def test_each_limit_is_compared_with_its_number() -> None:
    """Of the raceway, ball and state that come closest; only limits that the scene has."""
    operation = qs.Operation(speed=9_000 * qs.rpm, axial_load=6_000.0, radial_load_y=2_000.0, tilt_y=0.0, tilt_z=0.0)
    solution = qs.solve(qs.Scene(B218, operation, **BALLS))
    found = of(operation, **BALLS)
    assert list(found) == ["contact pressure", "friction coefficient"]
    pressure = max(side.max_pressure.max() for side in (solution.inner, solution.outer))
    assert found["contact pressure"].used == pytest.approx(pressure / STATIC_PRESSURE, rel=1e-12)
    friction = max(side.required_friction.max() for side in (solution.inner, solution.outer))
    assert found["friction coefficient"].used == pytest.approx(friction / 0.1, rel=1e-12)
    given = (qs.CentrifugalForce(), qs.GyroscopicMoment(friction_coefficient=0.05))
    assert of(operation, **(BALLS | {"ball_effects": given}))["friction coefficient"].limit == 0.05
    assert list(of(replace(operation, speed=0.0))) == ["contact pressure"]


def test_a_contact_at_the_shoulder_uses_all_of_its_limit() -> None:
    """Semi-axes grow with the cube root of the load, up to that at which the reading has the ellipse at the edge."""
    asked = {"overrun": {"inner_shoulder_diameter": 118 * qs.mm}}
    scene = qs.Scene(B218, qs.Operation(axial_load=20_000.0), readings=asked)
    solution = qs.solve(scene)
    part = float(take_asked(solution)["overrun"].inner.overrun_load[0] / solution.inner.load[0])
    used = of(scene.operation, readings=asked)["inner contact to groove edge"].used
    assert used == pytest.approx(part ** (-1.0 / 3.0), rel=1e-9)


def test_the_row_that_is_closest_stands_for_its_set() -> None:
    rows = (qs.Row(B218, 0.0, "+x"), qs.Row(B218, 60 * qs.mm, "-x"))
    operation = qs.Operation(speed=0.0, axial_load=3_000.0)
    solution = qs.solve_set(qs.BearingSet(rows, operation, preload=qs.Preload(rigid=1_500.0)))
    found = {each.what: each for each in margins_of_set(solution, [{}, {}])}
    assert found["contact pressure"].row.startswith("row 1")
    assert found["contact pressure"].value == pytest.approx(solution.rows[0].inner.max_pressure.max() / 1e6)
    assert found["preload"].value == pytest.approx(1_500.0)
    assert found["preload"].used == pytest.approx(1.0 / 3.0)


@pytest.mark.parametrize(
    ("load", "said", "status", "words"),
    [
        (20_000.0, (), "pass", ("Within every known limit; the closest is contact pressure", "%)")),
        (20_000.0, ("balls_sparse",), "warning", ("Within every known limit", "Check the data")),
        (20_000.0, ("stiffness_undetermined",), "fail", ("The model does not describe this case.",)),
        (2e6, (), "fail", ("Contact pressure", "beyond the limit.")),
    ],
)
def test_the_answer_follows_from_margins_and_remarks(
    load: float, said: tuple[str, ...], status: str, words: tuple[str, ...]
) -> None:
    found = list(of(qs.Operation(axial_load=load)).values())
    shown = answer(found, [remark(code) for code in said])
    assert shown.status == status
    for each in words:
        assert each in shown.text


def test_bars_end_where_their_limit_is_used_up() -> None:
    """And below them stand the loads of the balls, where these differ."""
    alike, apart = (
        qs.solve(qs.Scene(B218, qs.Operation(axial_load=5_000.0, radial_load_y=load, tilt_y=0.0, tilt_z=0.0)))
        for load in (0.0, 2_000.0)
    )
    bars = [("a", 0.4, "4 of 10"), ("b", 30.0, "300 of 10")]
    assert len(picture.margins(bars, alike).axes) == 1
    above, below = picture.margins(bars, apart).axes
    np.testing.assert_allclose([each.get_width() for each in above.patches], [1.25, 1.25, 0.4, 1.25])
    heights = [each.get_height() for each in below.patches]
    np.testing.assert_allclose(heights, np.concatenate([apart.inner.load, apart.outer.load]))
