"""What stands in for a number that a table leaves out is found where its effect or reading is made: once, and from what
was read, so that one mistake of the file is one error."""

from __future__ import annotations

import copy
from collections.abc import Callable
from typing import Any

import pytest

import qsbearing as qs
from qsbearing.files import scene_file, set_file
from qsbearing.files.scene_file import scene_of
from qsbearing.files.set_file import set_of

SCENE: dict[str, Any] = {
    "bearing": {"name": "7210C"},
    "operation": {"axial_load_N": 500.0},
    "effects": {"ring_expansion": {"shaft_fit": "k5", "housing_fit": "JS6"}},
    "readings": {"life": {}, "static_safety": True},
    "housing": {"outside_diameter_mm": 140.0},
}
SET: dict[str, Any] = {
    "operation": {"speed_rpm": 0.0},
    "preload": {"rigid_N": 300.0},
    "effects": {"ring_expansion": {"shaft_fit": "k5"}},
    "readings": {"life": {}},
    "rows": [
        {"position_mm": 0.0, "carries": "+x", "bearing": {"name": "71914C"}},
        {"position_mm": 40.0, "carries": "-x", "bearing": {"name": "7210C"}},
    ],
}


def with_(tables: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """With these in place of what stands at their paths."""
    changed = copy.deepcopy(tables)
    for path, value in changes.items():
        *within, last = path.split(".")
        table = changed
        for step in within:
            table = table[step]
        table[last] = value
    return changed


@pytest.mark.parametrize(
    ("tables", "changes", "key"),
    [
        (SCENE, {"bearing.bore_diameter_mm": "50"}, "bearing.bore_diameter_mm"),
        (SCENE, {"bearing.static_load_rating_N": "37000"}, "bearing.static_load_rating_N"),
        (SCENE, {"housing.material": "stel"}, "housing.material"),
        (SCENE, {"housing.outside_diameter_mm": [140.0]}, "housing.outside_diameter_mm"),
        (SCENE, {"bearing": {"nmae": "7210C"}, "effects": {}}, "bearing.nmae"),
        (SCENE, {"preload": "light", "operation": {}, "bearing.name": 7210, "effects": {}}, "bearing.name"),
        (SET, {"effects.ring_expansion.shaft_bore_diameter_mm": "20"}, "effects.ring_expansion.shaft_bore_diameter_mm"),
        (SET, {"readings.life": 60}, "readings.life"),
        (SET, {"readings.life": {"reliabilty": 0.9}}, "readings.life.reliabilty"),
    ],
)
def test_one_mistake_is_one_error(tables: dict[str, Any], changes: dict[str, Any], key: str) -> None:
    with pytest.raises(qs.SceneFileError) as raised:
        (set_of if "rows" in tables else scene_of)(with_(tables, changes), "")
    assert [each.key for each in raised.value.errors] == [key], raised.value


def test_a_reading_that_is_required_takes_what_one_that_is_asked_for_takes() -> None:
    """The printed load ratings of each row's own bearing."""
    asked = set_of(copy.deepcopy(SET), "")
    tables = copy.deepcopy(SET) | {"require": {"life.basic_duration_h": ">= 100"}}
    del tables["readings"]
    required = set_of(tables, "")
    assert [row.readings for row in required.rows] == [row.readings for row in asked.rows]
    assert required.rows[1].readings == {"life": {"dynamic_load_rating": 47_500.0}}


def test_who_made_a_bearing_of_the_catalogue_changes_none_of_its_numbers() -> None:
    assert scene_of(with_(SCENE, {"bearing.maker": "GMN"}), "").readings == scene_of(copy.deepcopy(SCENE), "").readings


def test_a_material_that_is_null_is_missing() -> None:
    own = {"ball_count": 15, "ball_diameter_mm": 12.7, "pitch_diameter_mm": 70.0, "groove_radius_coefficient": 0.52,
           "free_contact_angle_deg": 15.0, "ball_material": None, "ring_material": "steel"}  # fmt: skip
    with pytest.raises(qs.SceneFileError, match=r"bearing\.ball_material: missing"):
        scene_of({"bearing": own, "operation": {"axial_load_N": 500.0}}, "")


@pytest.mark.parametrize("tables", [SCENE, SET, SCENE | {"preload": "light", "operation": {"speed_rpm": 0.0}}])
def test_every_table_is_read_as_the_file_has_it(tables: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """No copy in which defaults stand is read in place of it."""
    given, seen = copy.deepcopy(tables), []

    def noted(read: Callable[..., Any]) -> Callable[..., Any]:
        return lambda document, *others: seen.append(document) or read(document, *others)

    for module in (scene_file, set_file):
        for name in ("read_effects", "read_readings", "preload_table"):
            monkeypatch.setattr(module, name, noted(getattr(module, name)))
    (set_of if "rows" in given else scene_of)(given, "")
    assert len(seen) == 3 and all(each is given for each in seen)
    assert given == tables
