"""Effects completed on the page: from the catalogue, by usual numbers, by fits picked in a list, else asked for."""

from __future__ import annotations

import copy
from typing import Any

import pytest

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")

from qsbearing.app import answers, required
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.fits import classes, names
from qsbearing.files.keys import EFFECT_SECTIONS, EFFECT_TABLES
from tests.systems.sets.arrangements import PAIR_FILE


@pytest.fixture(scope="module")
def first() -> dict[str, Any]:
    document: dict[str, Any] = answers.start("7210C")["document"]
    return document


@pytest.fixture
def document(first: dict[str, Any]) -> dict[str, Any]:
    return copy.deepcopy(first)


def fields(document: dict[str, Any]) -> dict[str, dict[str, Any]]:
    return {field["key"]: field for field in answers.shown(document)["fields"]}


def test_the_growth_of_rings_comes_from_the_catalogue_and_fits_from_a_list(document: dict[str, Any]) -> None:
    told = answers.switched(document, "", "ring_expansion", True)
    own = told["document"]["effects"]["ring_expansion"]
    assert (own["bore_diameter_mm"], own["outside_diameter_mm"]) == (50.0, 90.0)
    assert answers.solved(told["document"], "")["is_solved"]
    every = fields(told["document"])
    path = "effects.ring_expansion"
    assert every[f"{path}.shaft_fit"]["options"] == list(names("shaft"))
    assert every[f"{path}.housing_fit"]["options"] == list(names("housing"))
    assert every[f"{path}.tolerance_class"]["options"] == list(classes())
    warm = every[f"{path}.housing_temperature_C"]
    assert warm["unit"] == "°C" and not warm["is_given"]
    own["shaft_fit"] = "k5"
    after = answers.solved(told["document"], "")
    assert after["key"] != answers.solved(document, "")["key"]


def test_a_fit_and_its_interference_stand_in_place_of_each_other(document: dict[str, Any]) -> None:
    told = answers.switched(document, "", "ring_expansion", True)["document"]
    every, path = fields(told), ("effects", "ring_expansion")
    for seat in ("shaft", "housing"):
        assert every[f"effects.ring_expansion.{seat}_fit"]["replaces"] == [(*path, f"{seat}_interference_um")]
        assert every[f"effects.ring_expansion.{seat}_interference_um"]["replaces"] == [(*path, f"{seat}_fit")]
    (usual,) = every["effects.ring_expansion.housing_fit"]["brings"]
    own = told["effects"]["ring_expansion"]
    own |= {"housing_fit": "H6"}
    with pytest.raises(SceneFileError, match="housing_outside_diameter"):
        answers.solved(told, "")
    own[usual["path"][-1]] = usual["value"]
    assert answers.solved(told, "")["is_solved"] and usual["value"] > own["outside_diameter_mm"]
    assert fields(told)["effects.ring_expansion.housing_fit"]["brings"] == []


def test_rings_that_deflect_take_usual_numbers_and_say_so(document: dict[str, Any]) -> None:
    told = answers.switched(document, "", "elastic_rings", True)
    outer = told["document"]["effects"]["elastic_rings"]["outer"]
    assert outer["housing"]["outside_diameter_mm"] == pytest.approx(1.4 * 90.0) and "steel housing" in told["said"]
    assert "assumed" in told["said"].lower()
    every = fields(told["document"])
    assert every["effects.elastic_rings.outer.housing"]["options"] == ["rigid", "free"]
    assert every["effects.elastic_rings.inner.shaft"]["options"] == ["rigid", "free", "solid"]
    before = answers.solved(told["document"], "")["key"]
    outer["housing"] = "free"
    assert answers.solved(told["document"], "")["key"] != before
    assert "effects.elastic_rings.outer.housing.outside_diameter_mm" not in fields(told["document"])


def test_what_nothing_tells_is_asked_for_at_an_empty_field(document: dict[str, Any]) -> None:
    told = answers.switched(document, "", "ball_expansion", True)
    assert told["document"]["effects"]["ball_expansion"] == {}
    with pytest.raises(SceneFileError) as caught:
        answers.solved(told["document"], "")
    (error,) = caught.value.errors
    field = fields(told["document"])[error.key]
    assert error.key == "effects.ball_expansion.ball_temperature_C" and not field["is_given"]
    told["document"]["effects"]["ball_expansion"]["ball_temperature_C"] = 50.0
    assert answers.solved(told["document"], "")["is_solved"]


def test_every_key_of_an_effect_has_a_field(document: dict[str, Any]) -> None:
    """But for lists, which stay in the file."""
    for name in EFFECT_TABLES:
        document["effects"][name] = {}
    every = set(fields(document))
    for name in EFFECT_TABLES:
        missing = {f"effects.{name}.{key}" for key in EFFECT_SECTIONS[name]} - every
        assert all("compliance" in each for each in missing), missing


def test_effects_of_a_set_are_one_table_for_all_rows() -> None:
    pair = answers.opened(PAIR_FILE, "pair")["document"]
    for name in ("ring_expansion", "elastic_rings"):
        told = answers.switched(pair, "pair", name, True)["document"]
        assert told["effects"][name] and not any(name in row for row in told["rows"])
        assert answers.solved(told, "pair")["is_solved"]
        assert answers.switched(told, "pair", name, False)["document"] == pair
    assert "effects.elastic_rings.outer.housing" in fields(told)
    told["rows"][1]["ring_expansion"] = {"bore_diameter_mm": 50.0, "outside_diameter_mm": 90.0}
    assert fields(told)["row 2.ring_expansion.shaft_fit"]["options"] == list(names("shaft"))


def test_effects_that_are_missing_and_matter_are_offered(document: dict[str, Any]) -> None:
    offered = {each["effect"]: each["is_missing"] for each in answers.effects(document, "")["effects"]}
    assert {name for name, is_missing in offered.items() if is_missing} == {"ring_expansion", "elastic_rings"}
    told = answers.switched(document, "", "ring_expansion", True)["document"]
    assert not {each["effect"]: each["is_missing"] for each in answers.effects(told, "")["effects"]}["ring_expansion"]


def test_results_that_may_be_required_have_names_that_are_known(document: dict[str, Any]) -> None:
    told = {each["name"]: each for each in required.names(document, "")["results"]}
    assert told["inner_max_pressure"]["unit"] == "MPa" and len(told) > 100
    for name in list(told)[::40]:
        document["require"] = {name: {"most": 1.0}}
        (answer,) = answers.solved(document, "")["required"]["answers"]
        assert answer["path"][:2] == ["require", name]
    document["require"] = {"no_such": {"most": 1.0}}
    with pytest.raises(SceneFileError, match=r"require\.no_such"):
        answers.solved(document, "")
