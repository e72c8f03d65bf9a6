"""[housing]: what outer rings sit in, described once for the fit, the heat and the elasticity of its seats.

What a ring expansion with a fit in the housing, or an elastic outer ring, does not state itself is that of [housing].
A set takes material and temperature of its ring expansions from its housing itself (`BearingSet.effects_of`).
"""

from __future__ import annotations

from functools import cache
from typing import Any

from qsbearing.files.file_keys import set_numbers
from qsbearing.files.keys import DIAMETERS, MATERIAL
from qsbearing.files.table_checks import Errors, TableModel, as_it_is, checked, material, table_model
from qsbearing.model.material import STEEL

_FITTED = {"housing_interference_um", "housing_fit"}
_ELASTIC = tuple(key for key in MATERIAL if key.field in ("elastic_modulus", "poisson_ratio"))
"""What an elastic housing takes of its material."""


@cache
def model() -> TableModel:
    """How the table is built."""
    return table_model("housing", set_numbers()["housing"], {"material": as_it_is})


def with_housing(document: dict[str, Any], errors: Errors) -> dict[str, Any]:
    """The tables of a file, with those of [housing] in every effect that takes them; a single bearing's file without
    it, since nothing else there is in a housing.

    Args:
        errors: gets what is wrong with the table of a single bearing; that of a set is judged with the set.
    """
    table = document.get("housing")
    if table is None:
        return document
    of_set = "rows" in document
    document = dict(document) if of_set else {name: each for name, each in document.items() if name != "housing"}
    wrong: Errors = [] if of_set else errors
    good, _ = checked(model(), "housing", table, wrong)
    before = len(wrong)
    body = good.get("material", STEEL.name if of_set else None)  # of a set, `Housing` has it
    body = None if body is None else material("housing.material", body, wrong)
    diameter = good.get(DIAMETERS[1].name)
    fitted = {"housing_outside_diameter_mm": diameter}
    if not of_set:
        fitted |= {"housing_temperature_C": good.get("temperature_C"), "housing_material": good.get("material")}
        fitted |= {"reference_temperature_C": good.get("reference_temperature_C")}
    fitted = {name: value for name, value in fitted.items() if value is not None}
    elastic = {} if diameter is None or len(wrong) > before else {DIAMETERS[1].name: diameter}
    if elastic and body is not None:
        elastic |= {key.name: key.in_file(getattr(body, key.field)) for key in _ELASTIC}

    def filled(holder: Any) -> Any:
        if not isinstance(holder, dict):
            return holder
        holder = dict(holder)
        rings, bends = holder.get("ring_expansion"), holder.get("elastic_rings")
        if isinstance(rings, dict) and _FITTED & set(rings):
            holder["ring_expansion"] = {**fitted, **rings}
        outer = bends.get("outer") if isinstance(bends, dict) else None
        if isinstance(bends, dict) and isinstance(outer, dict) and elastic:
            holder["elastic_rings"] = {**bends, "outer": {"housing": elastic, **outer}}
        return holder

    if "effects" in document:
        document["effects"] = filled(document["effects"])
    if isinstance(document.get("rows"), list):
        document["rows"] = [filled(row) for row in document["rows"]]
    return document
