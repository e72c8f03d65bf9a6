"""Tables of effects within [effects]: each names its effect and holds its numbers."""

from __future__ import annotations

from dataclasses import MISSING, fields
from math import nan
from typing import Any

import numpy as np

from qsbearing.effects import BallDiameterDeviations, BallExpansion, RingEffect, RingExpansion, types_in
from qsbearing.io.file_errors import FileErrorDetail, translate
from qsbearing.io.table_checks import Errors, checked, judged, material, si, table_model
from qsbearing.scene.keys import BALL_DEVIATIONS, EFFECT_SECTIONS, EFFECT_TABLES, MATERIALS, SEAT_MATERIALS
from qsbearing.validation import SceneError

_EFFECT_TABLES = {name: table_model(name, keys, {}) for name, keys in EFFECT_TABLES.items()}
_RING_EFFECTS: dict[str, Any] = types_in("ring_effects")


def _needed(name: str) -> list[str]:
    """The keys of an effect's table that have no usual value."""
    required = {field.name for field in fields(_RING_EFFECTS[name]) if field.default is MISSING}
    return [key.name for key in EFFECT_TABLES[name] if key.field in required]


def ring_effect(name: str, table: Any, errors: Errors) -> RingEffect | None:
    """The effect that a table within [effects] names."""
    path = f"effects.{name}"
    known_materials = [key for key in SEAT_MATERIALS if key in EFFECT_SECTIONS[name]]
    is_table = isinstance(table, dict)
    numbers = {key: value for key, value in table.items() if key not in known_materials} if is_table else table
    good, unusable = checked(_EFFECT_TABLES[name], path, numbers, errors)
    if not is_table:
        return None
    before = len(errors)
    missing = [key for key in _needed(name) if key not in good and key not in unusable]
    errors += [FileErrorDetail(f"{path}.{key}", "missing: the effect needs it") for key in missing]
    numbers_si: dict[str, Any] = si(EFFECT_TABLES[name], dict.fromkeys((*missing, *unusable), nan) | good)
    for key in known_materials:
        if key in table:
            numbers_si[key] = material(f"{path}.{key}", table[key], errors)
    try:
        effect: RingEffect = _RING_EFFECTS[name](**numbers_si)
    except SceneError as error:
        errors += map(translate, judged(error))
        return None
    return effect if len(errors) == before else None


def ball_deviations(given: Any, errors: Errors) -> BallDiameterDeviations | None:
    """The effect that a list of deviations within [effects] names, in the file's unit; None without one."""
    if given is None:
        return None
    try:
        return BallDiameterDeviations(BALL_DEVIATIONS.si(np.asarray(given, float)))
    except SceneError as error:
        errors += map(translate, error.errors)
        return None


def find_unused_expansion(document: dict[str, Any], errors: Errors) -> None:
    """Coefficients of thermal expansion in the file that no effect uses."""
    bearing, effects = document.get("bearing"), document.get("effects")
    for side, effect in zip(MATERIALS, (BallExpansion.name, RingExpansion.name), strict=True):
        given = bearing.get(side) if isinstance(bearing, dict) else None
        is_used = isinstance(effects, dict) and effect in effects
        if isinstance(given, dict) and "thermal_expansion_per_K" in given and not is_used:
            cause = f"Leave it out, or ask for the effect by a table [effects.{effect}]"
            problem = f"is given, but without {effect.replace('_', ' ')} nothing uses it"
            errors.append(FileErrorDetail(f"bearing.{side}.thermal_expansion_per_K", problem, cause=cause))
