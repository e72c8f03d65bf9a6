"""A comparison says which tables of each file it does not use, whatever they hold."""

from __future__ import annotations

from typing import Any

import pytest

from qsbearing.studies.design.compare import compare

JOB: dict[str, Any] = {
    "bearing": {"name": "7210C"},
    "operation": {"speed_rpm": 9000, "axial_load_N": 500},
    "effects": {"ball": ["centrifugal_force"], "raceway_control": "outer"},
}
OWN: dict[str, Any] = {
    "operation": {"speed_rpm": 9000, "axial_load_N": 700},
    "effects": {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "outer"},
    "readings": {"life": {}},
    "preload": {"rigid_N": 100},
    "tolerance": 0.01,
}


def unused(other: dict[str, Any]) -> list[str]:
    found = compare([JOB, other]).remarks
    return [str(each.values["tables"]) for each in found if each.code == "job_of_another"]


@pytest.mark.parametrize("table", OWN)
def test_a_table_that_says_otherwise_is_named(table: str) -> None:
    assert unused({**JOB, table: OWN[table]}) == [f"[{table}]"]


def test_several_are_named_together_and_what_is_the_same_is_not() -> None:
    assert unused(JOB) == []
    assert unused({"bearing": {"name": "7210C"}}) == []
    assert unused(JOB | {"report": {"title": "of its own"}, "bearing": {"name": "B218"}}) == []
    assert unused(JOB | OWN)[0].count("[") == len(OWN)


def test_an_example_of_the_catalogue_has_no_job_of_its_own() -> None:
    assert not [each for each in compare(["b218", "7210c"]).remarks if each.code == "job_of_another"]


def test_of_a_set_what_the_job_replaces_is_named() -> None:
    row = {"bearing": {"name": "7210C"}, "position_mm": 10, "carries": "-x"}
    pair = {"rows": [row | {"position_mm": -10, "carries": "+x"}, row], "preload": {"rigid_N": 200}}
    one = pair | {"operation": {"speed_rpm": 3000, "axial_load_N": 100}}
    other = pair | {"operation": {"speed_rpm": 3000, "axial_load_N": 200}, "preload": {"rigid_N": 300}}
    found = [each for each in compare([one, other]).remarks if each.code == "job_of_another"]
    assert [each.values["tables"] for each in found] == ["[operation]"]
