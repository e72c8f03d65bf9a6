"""Keys that have other values in a comparison: of the job that all share, of every scene, of one of them."""

from __future__ import annotations

from typing import Any

import pytest

import qsbearing as qs
from qsbearing.studies.design.compare import OtherValue, job_of, solved

BEARING = {"name": "7210C"}
FIRST: dict[str, Any] = {"bearing": dict(BEARING), "operation": {"speed_rpm": 9000, "axial_load_N": 500}}
SECOND: dict[str, Any] = {"bearing": dict(BEARING)}


def of(*settings: OtherValue, at: dict[str, Any] | None = None) -> Any:
    return solved(job_of([FIRST, SECOND], at, settings))


def test_a_key_of_one_scene_changes_that_one_alone() -> None:
    found = of(OtherValue(2, "bearing.ball_count", 12))
    assert [int(each.scene.bearing.ball_count) for each in found.solutions] == [15, 12]
    (line,) = (each for each in found.inputs if each.name == "ball_count")
    assert line.values == (15.0, 12.0)
    assert SECOND["bearing"] == BEARING, "what was given is as it was"


def test_a_key_of_a_bearing_without_a_number_is_of_all() -> None:
    found = of(OtherValue(None, "ball_count", 14))
    assert [int(each.scene.bearing.ball_count) for each in found.solutions] == [14, 14]


@pytest.mark.parametrize("at", [None, {"bearing": {"name": "B218"}, "operation": {"axial_load_N": 400}}])
def test_a_key_of_the_job_is_put_where_the_job_stands(at: dict[str, Any] | None) -> None:
    job = job_of([FIRST, SECOND], at, [OtherValue(None, "speed_rpm", 7000)])
    assert [float(each.operation.speed) / qs.rpm for each in job.made] == pytest.approx([7000.0, 7000.0])
    ((_, change),) = job.changes
    assert change.key == "operation.speed_rpm" and change.before == (None if at else 9000)


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        (OtherValue(2, "speed_rpm", 7000), "operation is of the job, which all share"),
        (OtherValue(3, "bearing.ball_count", 12), "there are 1 to 2"),
        (OtherValue(None, "bearing.ball_cuont", 12), "ball_cuont"),
    ],
)
def test_what_has_no_place_is_refused(setting: OtherValue, said: str) -> None:
    with pytest.raises(qs.SceneError, match=said):
        of(setting)
