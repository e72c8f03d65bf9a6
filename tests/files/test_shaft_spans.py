"""Sections of a shaft by where they begin and end, against the same shaft by lengths."""

from __future__ import annotations

import tomllib

import pytest

import qsbearing as qs
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.set_file import set_of
from qsbearing.studies.schema import file_schema
from tests.systems.sets.arrangements import PAIR_FILE

ENDS = """
[[shaft.sections]]
from_mm = -40.1
to_mm = 30.2
diameter_mm = 50
inner_diameter_mm = 20
[[shaft.sections]]
from_mm = 30.2
to_mm = 75
diameter_mm = 40
end_outer_diameter_mm = 35
material = "titanium"
[[shaft.loads]]
position_mm = 60
radial_y_N = 100
"""
LENGTHS = """
[shaft]
start_mm = -40.1
[[shaft.sections]]
length_mm = 70.3
outer_diameter_mm = 50
inner_diameter_mm = 20
[[shaft.sections]]
length_mm = 44.8
outer_diameter_mm = 40
end_outer_diameter_mm = 35
material = "titanium"
[[shaft.loads]]
position_mm = 60
radial_y_N = 100
"""


def read(text: str) -> qs.BearingSet:
    return set_of(tomllib.loads(PAIR_FILE + text), "shaft.toml", "shaft")


def test_ends_are_lengths_to_the_last_bit() -> None:
    by_ends, by_lengths = read(ENDS), read(LENGTHS)
    assert by_ends.shaft == by_lengths.shaft and by_ends.shaft is not None
    assert by_ends.shaft.ends[-1] == pytest.approx(0.075, rel=1e-14)
    written = input_tables(by_ends)
    assert written["shaft"]["sections"][0]["length_mm"] == 70.3 and written["shaft"]["start_mm"] == -40.1
    assert set_of(written, "again", "shaft").shaft == by_ends.shaft


def test_a_diameter_goes_with_lengths_too() -> None:
    assert read(LENGTHS.replace("outer_diameter_mm = 50", "diameter_mm = 50")).shaft == read(LENGTHS).shaft


def test_the_schema_has_them() -> None:
    sections = file_schema()["properties"]["shaft"]["properties"]["sections"]["items"]["properties"]
    assert {"from_mm", "to_mm", "diameter_mm"} <= sections.keys()


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("from_mm = 30.2", "from_mm = 31", ["section 2.from_mm = 31 mm: leaves a gap to section 1: 0.8 mm", "30.2 mm"]),
        ("from_mm = 30.2", "from_mm = 25", ["section 2.from_mm = 25 mm: overlaps section 1: 5.2 mm"]),
        ("to_mm = 75", "to_mm = 20", ["section 2.to_mm = 20 mm: is not beyond where the section begins"]),
        ("to_mm = 75\n", "", ["section 2.to_mm: missing"]),
        ("from_mm = 30.2\nto_mm = 75", "length_mm = 44.8", ["section 2.from_mm: missing: others have it"]),
        ("to_mm = 75", "to_mm = 75\nlength_mm = 44.8", ["section 2.length_mm: is given together with from_mm"]),
        ("diameter_mm = 40", "diameter_mm = 40\nouter_diameter_mm = 40", ["diameter_mm = 40 mm: is given together"]),
        ("to_mm = 75", 'to_mm = "75"', ["section 2.to_mm = '75': is not a number"]),
        ("from_mm = 30.2", "form_mm = 30.2", ["section 2.from_mm: missing"]),
        (
            "[[shaft.sections]]",
            "[shaft]\nstart_mm = 0\n[[shaft.sections]]",
            ["shaft.start_mm = 0 mm: is given together"],
        ),
        ("diameter_mm = 40", "diameter_mm = 4000000", ["section 2.outer_diameter_mm", "is too large"]),
    ],
)
def test_what_is_wrong_is_told_and_nothing_else(old: str, new: str, told: list[str]) -> None:
    with pytest.raises(qs.SceneFileError) as caught:
        read(ENDS.replace(old, new, 1))
    text = str(caught.value)
    assert [each for each in told if each not in text] == [], text
    assert len(caught.value.errors) == 1, text


def test_faults_of_sections_and_loads_are_told_at_once() -> None:
    with pytest.raises(qs.SceneFileError) as caught:
        read(ENDS.replace("to_mm = 75", "to_mm = 20").replace("radial_y_N", "radial_N"))
    assert len(caught.value.errors) == 2
