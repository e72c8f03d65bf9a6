"""Materials by name: every one is stated with a source, within the ranges, and near its neighbours in handbooks."""

from __future__ import annotations

import tomllib

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.scene_file import scene_of
from qsbearing.model.material import BY_NAME, Material, material_errors, material_named

# E [GPa], Poisson's ratio, density [kg/m^3], expansion [1e-6/K]: what handbooks of engineers print, as ranges.
HANDBOOK = {
    "steel": (200, 215, 0.27, 0.31, 7600, 7900, 10, 13),
    "100Cr6": (200, 215, 0.27, 0.31, 7600, 7900, 10, 13),
    "M50": (200, 215, 0.27, 0.31, 7800, 8050, 10, 13),
    "440C": (195, 216, 0.26, 0.31, 7600, 7800, 9.8, 10.6),
    "silicon nitride": (290, 330, 0.24, 0.29, 3100, 3300, 2.8, 3.6),
    "aluminium": (68, 73, 0.3, 0.35, 2650, 2850, 22, 24.5),
    "cast iron": (95, 135, 0.24, 0.29, 7000, 7400, 9.5, 12.5),
    "1.4301": (190, 205, 0.27, 0.31, 7800, 8100, 15.5, 17.5),
    "titanium": (103, 120, 0.31, 0.36, 4400, 4520, 8.4, 9.2),
}  # fmt: skip


@pytest.mark.parametrize("name", HANDBOOK)
def test_a_named_material_is_as_handbooks_have_it(name: str) -> None:
    of = BY_NAME[name.lower()]
    numbers = of.elastic_modulus, of.poisson_ratio, of.density, of.thermal_expansion
    found = np.array(numbers, float) / (1e9, 1.0, 1.0, 1e-6)
    low, high = np.reshape(HANDBOOK[name], (4, 2)).T
    assert ((low <= found) & (found <= high)).all()
    assert of.name == name and len(of.source) > 20 and material_errors("material", of) == []


def test_every_named_material_is_looked_at() -> None:
    assert {of.name for of in BY_NAME.values()} == {*HANDBOOK}


@pytest.mark.parametrize(
    ("word", "name"),
    [("Aluminum", "aluminium"), ("EN-GJL-250", "cast iron"), ("CAST_IRON", "cast iron"), ("1.4125", "440C"),
     ("stainless", "1.4301"), ("ti-6al-4v", "titanium")],
)  # fmt: skip
def test_other_names_mean_the_same(word: str, name: str) -> None:
    found = material_named(word)
    assert isinstance(found, Material) and found.name == name


SCENE = """
[bearing]
name = "7210C"
ring_material = "{}"
[operation]
axial_load_N = 500
[housing]
material = "stainless"
"""


def test_stainless_rings_are_asked_which_steel_is_meant() -> None:
    with pytest.raises(qs.SceneFileError, match="is the name of several materials") as caught:
        scene_of(tomllib.loads(SCENE.format("stainless")), "a file")
    assert (
        "440C" in str(caught.value) and "housing" not in str(caught.value).partition("\n")[2].partition("Bearings")[0]
    )
    for word, name in (("440C", "440C"), ("1.4301", "1.4301")):
        assert scene_of(tomllib.loads(SCENE.format(word)), "a file").bearing.ring_material.name == name
