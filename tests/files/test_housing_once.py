"""A housing described once: what the fit, the heat and the elasticity of its seats take from [housing]."""

from __future__ import annotations

import tomllib

import pytest

import qsbearing as qs
from qsbearing.files.scene_file import scene_of
from qsbearing.files.set_file import set_of

HOUSED = """
bearing.name = "7210C"
operation.axial_load_N = 1000
[effects.ring_expansion]
housing_fit = "JS6"
[effects.elastic_rings.outer]
shoulder_diameter_mm = 77
"""
ONCE = """
[housing]
outside_diameter_mm = 140
material = { elastic_modulus_GPa = 70, poisson_ratio = 0.33, density_kg_m3 = 2700, thermal_expansion_per_K = 2.3e-5 }
temperature_C = 30
"""
ROWS = 'rows = [{ position_mm = 0, carries = "+x" }, { position_mm = 20, carries = "-x" }]\n'


def scene(text: str) -> qs.Scene:
    return scene_of(tomllib.loads(text), "housed.toml")


def test_a_housing_of_one_bearing_is_stated_once() -> None:
    tables = tomllib.loads(ONCE)["housing"]
    spelled = HOUSED.replace('"JS6"', '"JS6"\nhousing_outside_diameter_mm = 140\nhousing_temperature_C = 30')
    thrice = tomllib.loads(spelled)
    thrice["effects"]["ring_expansion"]["housing_material"] = tables["material"]
    elastic = {"outside_diameter_mm": 140, "elastic_modulus_GPa": 70, "poisson_ratio": 0.33}
    thrice["effects"]["elastic_rings"]["outer"]["housing"] = elastic
    once = scene(HOUSED + ONCE)
    assert once.ring_effects == scene_of(thrice, "thrice.toml").ring_effects
    assert once.ring_expansion is not None
    assert once.ring_expansion.housing_outside_diameter == 140 * qs.mm
    bare = scene(HOUSED + "[housing]\noutside_diameter_mm = 140\n")
    assert bare.elastic_rings is not None
    assert bare.elastic_rings.housing_elastic_modulus is None  # that of the rings


def test_what_an_effect_states_itself_stands() -> None:
    rigid = HOUSED.replace("shoulder_diameter_mm", "housing = 'rigid'\nshoulder_diameter_mm")
    own = scene(rigid + ONCE)
    assert own.elastic_rings is not None
    assert own.elastic_rings.housing == "rigid"
    without_fit = scene(HOUSED.replace('housing_fit = "JS6"', 'shaft_fit = "k5"') + ONCE)
    assert without_fit.ring_expansion is not None
    assert without_fit.ring_expansion.housing_outside_diameter is None


def test_rows_of_a_set_take_it_too() -> None:
    tight = HOUSED.replace('housing_fit = "JS6"', "housing_interference_um = 60")
    of = set_of(tomllib.loads(ROWS + tight + ONCE), "set.toml")
    (rings, elastic) = of.effects_of(of.rows[0])
    assert (rings.housing_outside_diameter, rings.housing_temperature) == (140 * qs.mm, 30 + qs.zero_celsius)
    assert rings.housing_material.elastic_modulus == 70e9
    assert (elastic.housing_outside_diameter, elastic.housing_elastic_modulus) == (140 * qs.mm, 70e9)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[housing]\noutside_diametre_mm = 140\n", "Did you mean outside_diameter_mm"),
        ("[housing]\nmaterial = 'stel'\n", "housing.material"),
        ("[[housing]]\noutside_diameter_mm = 140\n", "housing"),
        ("[housing]\noutside_diameter_mm = 60\n", "housing"),
    ],
)
def test_what_is_wrong_with_it_is_said(text: str, said: str) -> None:
    with pytest.raises(qs.SceneFileError) as caught:
        scene(HOUSED + text)
    assert said in str(caught.value)
