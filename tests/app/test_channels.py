"""What is done to the bearing, as the page has it: each channel loaded, placed or free; preload; another bearing."""

from __future__ import annotations

import copy
from typing import Any

import pytest

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")

from qsbearing.app import answers, channels
from qsbearing.files.file_errors import SceneFileError
from qsbearing.model.operation import CHANNELS
from tests.systems.sets.arrangements import PAIR_FILE

LABELS = [channel.label for channel in CHANNELS]


@pytest.fixture(scope="module")
def first() -> dict[str, Any]:
    document: dict[str, Any] = answers.start("7210C")["document"]
    return document


@pytest.fixture
def document(first: dict[str, Any]) -> dict[str, Any]:
    return copy.deepcopy(first)


def ways(document: dict[str, Any]) -> dict[str, str]:
    return {each["name"]: each["way"] for each in answers.shown(document)["channels"]}


def test_all_channels_are_there_whatever_the_file_gives(document: dict[str, Any]) -> None:
    told = answers.shown(document)["channels"]
    assert [each["name"] for each in told] == [*LABELS, "preload"]
    assert ways(document) == {"axial": "load", **dict.fromkeys(LABELS[1:], "free"), "preload": "none"}
    assert all([way["way"] for way in each["ways"]] == ["load", "place", "free"] for each in told[:-1])
    assert [way["way"] for way in told[-1]["ways"]] == ["none", *channels.WAYS]
    document["operation"]["moment_z_Nm"] = 0.0
    assert ways(document)["tilt z"] == "free"  # as a file says that it is


def test_a_radial_load_is_one_choice_and_one_number(document: dict[str, Any]) -> None:
    """The file asks for the tilt beside it; the page has it in view, and states that it is free."""
    loaded = answers.put_way(document, "radial y", "load")["document"]
    loaded["operation"]["radial_load_y_N"] = 800.0
    told = answers.solved(loaded, "")
    assert told["is_solved"] and loaded["operation"]["moment_z_Nm"] == 0.0 and "moment_y_Nm" not in loaded["operation"]
    assert told["channels"]["radial y"]["load"] == 800.0 and told["channels"]["tilt z"]["place"] != 0.0
    assert ways(loaded) == {**ways(document), "radial y": "load"}


@pytest.mark.parametrize("channel", LABELS)
def test_a_place_begins_where_the_ring_stands(document: dict[str, Any], channel: str) -> None:
    """So the choice moves nothing: up to the digits that are taken over."""
    loaded = answers.put_way(document, "radial y", "load", 300.0)["document"]
    loaded = answers.put_way(loaded, "radial z", "load", -200.0)["document"]
    before = answers.solved(loaded, "")["channels"]
    placed = answers.put_way(loaded, channel, "place", before[channel]["place"])["document"]
    after = answers.solved(placed, "")["channels"]
    assert ways(placed)[channel] == "place"
    lever = max(abs(each["load"]) for each in before.values())
    for name in LABELS:
        assert after[name]["load"] == pytest.approx(before[name]["load"], rel=5e-3, abs=5e-3 * lever), name
    back = answers.put_way(placed, channel, "free")["document"]
    key = channels.KEYS[channel]["place"].name
    assert key not in back["operation"] and ways(back)[channel] == "free"
    assert answers.solved(back, "")["is_solved"] or channel == "axial"  # whose radial loads then hold nothing


def test_a_preload_takes_the_axial_channel_and_gives_it_back(document: dict[str, Any]) -> None:
    found = answers.solved(document, "")["channels"]
    loaded = answers.put_way(document, "preload", "rigid_N", found["preload"]["load"])["document"]
    assert loaded["preload"] == {"rigid_N": 1220.0} and "axial_load_N" not in loaded["operation"]
    axial = answers.shown(loaded)["channels"][0]
    assert (axial["way"], axial["held_by"]) == ("free", "preload")
    sprung = answers.put_way(loaded, "preload", "spring_N", 900.0)["document"]
    assert sprung["preload"] == {"spring_N": 1220.0}  # the same number in another way
    again = answers.put_way(sprung, "axial", "load", 500.0)["document"]
    assert "preload" not in again and again["operation"]["axial_load_N"] == 500.0
    none = answers.put_way(sprung, "preload", "none", 1220.0)["document"]
    assert "preload" not in none and none["operation"]["axial_load_N"] == 1220.0
    for each in (loaded, sprung, again, none):
        assert answers.solved(each, "")["is_solved"]


def test_a_preload_never_begins_at_nothing(document: dict[str, Any]) -> None:
    del document["operation"]["axial_load_N"]
    assert answers.put_way(document, "preload", "rigid_N", 0.0)["document"]["preload"]["rigid_N"] > 0.0


def test_the_preload_of_a_set_leaves_its_shaft_the_axial_channel() -> None:
    pair = answers.opened(PAIR_FILE, "pair")["document"]
    assert answers.shown(pair)["channels"][0]["held_by"] == ""
    placed = answers.put_way(pair, "axial", "place", 1.5)["document"]
    assert placed["preload"] == {"rigid_N": 720.0} and placed["operation"]["axial_displacement_um"] == 1.5
    assert answers.put_way(pair, "preload", "none", 200.0)["document"]["operation"]["axial_load_N"] == 200.0


def test_all_free_is_stated_as_no_load(document: dict[str, Any]) -> None:
    """A file says that nothing acts."""
    free = answers.put_way(document, "axial", "free")["document"]
    assert free["operation"]["axial_load_N"] == 0.0 and set(ways(free).values()) == {"free", "none"}


@pytest.mark.parametrize(("channel", "way"), [("sideways", "load"), ("axial", "rigid_N"), ("preload", "free")])
def test_what_is_no_way_is_refused(document: dict[str, Any], channel: str, way: str) -> None:
    with pytest.raises(SceneFileError, match="no such channel, or no such way"):
        answers.put_way(document, channel, way, 1.0)


def test_another_bearing_brings_its_own_dimensions(document: dict[str, Any]) -> None:
    expanded = answers.switched(document, "", "ring_expansion", True)["document"]
    assert expanded["effects"]["ring_expansion"]["bore_diameter_mm"] == 50.0
    other = answers.of_bearing(expanded, "", "B218")["document"]
    assert other["bearing"]["name"] == "B218" and other["effects"]["ring_expansion"]["bore_diameter_mm"] == 90.0
    with pytest.raises(SceneFileError, match="not in the catalogue"):
        answers.of_bearing(expanded, "", "no such")
