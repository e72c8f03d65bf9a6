"""The table [effects] of a scene file: ball effects, choices, and the tables of ring effects within it."""

from __future__ import annotations

from math import nan
from typing import Any

import numpy as np

from qsbearing.files.file_errors import FileErrorDetail, translate
from qsbearing.files.fits import FITTED, fits_of
from qsbearing.files.keys import (
    BALL_DEVIATIONS,
    EFFECT_TABLES,
    EFFECTS,
    FRICTION_RANGE,
    RING_COMPLIANCES,
    RING_EFFECTS,
    SEATS,
    TRACTION,
    named,
    required_of,
)
from qsbearing.files.stated import NOTHING, Stated
from qsbearing.files.table_checks import (
    Errors,
    as_number,
    as_word,
    checked,
    choice_fields,
    did_you_mean,
    flattened,
    lacking,
    list_of,
    made,
    material,
    si,
    table_model,
)
from qsbearing.model.accuracy import DEFAULT_ACCURACY
from qsbearing.model.described import materials_of
from qsbearing.model.effects import (
    BallDiameterDeviations,
    BallEffect,
    ElasticRings,
    GyroscopicMoment,
    MomentShares,
    RingEffect,
    RingExpansion,
    types_in,
)
from qsbearing.model.effects.orbit_radius import OrbitRadius
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.effects.ring_expansion_errors import Fit
from qsbearing.model.effects.traction import Traction
from qsbearing.model.scene.scene import CHOICES, effect_errors

BALL_EFFECTS: dict[str, Any] = types_in("ball_effects")
AUTO = "auto"
"""In place of the table of effects: they are chosen to a tolerance."""

_EFFECTS = table_model(
    "effects",
    EFFECTS,
    {"ball": list_of(as_word), BALL_DEVIATIONS.name: list_of(as_number)} | choice_fields("moment_shares", *CHOICES),
)
_TRACTION = table_model(Traction.name, TRACTION, {FRICTION_RANGE.name: list_of(as_number)} | choice_fields("law"))
_EFFECT_TABLES = {name: table_model(name, keys) for name, keys in EFFECT_TABLES.items()}
_ELASTIC_RINGS = table_model(
    "elastic_rings",
    EFFECT_TABLES["elastic_rings"],
    dict.fromkeys(SEATS, as_word) | {key.name: list_of(as_number) for key in RING_COMPLIANCES},
)


def effects_of(
    document: dict[str, Any], errors: Errors, balance_keys: frozenset[str] = frozenset(), stated: Stated = NOTHING
) -> dict[str, Any]:
    """The fields of `Scene` that say what is asked for.

    Args:
        balance_keys: of temperatures that the heat balance will find.
        stated: what tables take and need not state.
    """
    table = document.get("effects")
    if table == AUTO:
        return {"tolerance": _tolerance(document.get("tolerance", DEFAULT_ACCURACY), errors)}
    if "tolerance" in document:
        cause = 'Write effects = "auto" next to it, at the top of the file, or leave it out'
        errors.append(FileErrorDetail("tolerance", 'is given without effects = "auto"', cause=cause))
    if isinstance(table, str):
        cause = 'Write effects = "auto" to have them chosen, or [effects] with its keys below it'
        errors.append(FileErrorDetail("effects", "is not a table", table, cause=cause))
        return {}
    table = {} if table is None else table
    traction, table = _traction(table, errors)
    within = {name: table[name] for name in EFFECT_TABLES if name in table} if isinstance(table, dict) else {}
    if within:
        table = {name: value for name, value in table.items() if name not in within}
    good, unusable = checked(_EFFECTS, "effects", table, errors)
    names, shares = good.get("ball", []), good.pop("moment_shares", None)
    numbers = {key.name: good.pop(key.name) for key in EFFECTS if key.name in good}
    for name in dict.fromkeys(name for name in names if name not in BALL_EFFECTS):
        cause = did_you_mean(name, list(BALL_EFFECTS)) or f"One of {', '.join(BALL_EFFECTS)}"
        errors.append(FileErrorDetail("effects.ball", "is not a ball effect", name, cause=cause))
        unusable.add("ball")
    made: dict[str, BallEffect] = {name: BALL_EFFECTS[name]() for name in names if name in BALL_EFFECTS}
    made[GyroscopicMoment.name] = _gyroscopic_moment(shares, si(EFFECTS, numbers), errors)
    effects = tuple(made[name] for name in names if name in made)
    if shares is not None and good.get("raceway_control") is RacewayControl.FRICTION:
        cause = "Leave it out: how contacts share the moment is a result"
        problem = "is a hypothesis, and friction moves the balls"
        errors.append(FileErrorDetail("effects.moment_shares", problem, str(shares), cause=cause))
    if not unusable & {"ball", "raceway_control"}:
        requested = good.get("raceway_control"), good.get("orbit_radius", OrbitRadius.PITCH_CIRCLE)
        errors += map(translate, effect_errors(effects, *requested))
    if "ball" not in unusable and GyroscopicMoment.name not in names:
        cause = "Leave it out, or ask for gyroscopic_moment in ball"
        of_moment = {"moment_shares": (shares, "share"), **{name: (each, "carry") for name, each in numbers.items()}}
        for name, (value, verb) in of_moment.items():
            if value is not None:
                problem = f"is given, but there is no gyroscopic moment to {verb}"
                shown = value if isinstance(value, float) else str(value)
                errors.append(FileErrorDetail(f"effects.{name}", problem, shown, cause=cause))
    made_of_tables: list[RingEffect | None] = [
        ring_effect(name, within[name], errors, balance_keys, stated) for name in within
    ]
    made_of_tables.append(ball_deviations(good.pop(BALL_DEVIATIONS.name, None), errors))
    ring_effects = tuple(effect for effect in made_of_tables if effect is not None)
    return {"ball_effects": effects, "ring_effects": ring_effects, **traction} | {
        name: good[name] for name in CHOICES if name in good
    }


def _traction(effects: Any, errors: Errors) -> tuple[dict[str, Any], Any]:
    """The field of `Scene` that the table of the law of friction makes, where there is one; and the other effects."""
    if not isinstance(effects, dict) or effects.get(Traction.name) is None:
        return {}, effects
    before = len(errors)
    good, _ = checked(_TRACTION, f"effects.{Traction.name}", effects[Traction.name], errors)
    words: dict[str, Any] = {name: good.pop(name) for name in ("law", FRICTION_RANGE.name) if name in good}
    words |= si(TRACTION, good)
    law = made(lambda: Traction(**words), errors) if len(errors) == before else None
    return {Traction.name: law}, {name: each for name, each in effects.items() if name != Traction.name}


def _tolerance(value: Any, errors: Errors) -> float | None:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0.0 < value <= 1.0:
        cause = "Give the relative error that is allowed, above 0 and at most 1: 0.01 is 1 %"
        errors.append(FileErrorDetail("tolerance", "is not a relative error", value, cause=cause))
        return None
    return float(value)


def _gyroscopic_moment(shares: MomentShares | None, numbers: dict[str, Any], errors: Errors) -> GyroscopicMoment:
    shares = shares or MomentShares.CONTROLLING
    return made(lambda: GyroscopicMoment(shares, **numbers), errors) or GyroscopicMoment(shares)


def ring_effect(
    name: str, table: Any, errors: Errors, balance_keys: frozenset[str] = frozenset(), stated: Stated = NOTHING
) -> RingEffect | None:
    """The effect that a table within [effects] names; None for temperatures that are yet to be found."""
    path, table = f"effects.{name}", stated.filled(name, table)
    if name == ElasticRings.name:
        return _elastic_rings(path, table, errors)
    known_materials = materials_of(RING_EFFECTS[name])
    is_table = isinstance(table, dict)
    numbers = {key: value for key, value in table.items() if key not in known_materials} if is_table else table
    before = len(errors)
    fits: dict[str, Fit] = {}
    if is_table and name == RingExpansion.name:
        numbers, fits = fits_of(path, numbers, errors)
    good, unusable = checked(_EFFECT_TABLES[name], path, numbers, errors)
    if not is_table:
        return None
    later = [key.field for key in EFFECT_TABLES[name] if key.name in balance_keys]
    needed = named(required_of(RING_EFFECTS[name]))
    missing = lacking(needed, good, unusable, balance_keys)
    errors += [FileErrorDetail(f"{path}.{key}", "missing", detail="the effect needs it") for key in missing]
    numbers_si: dict[str, Any] = dict.fromkeys(later)
    numbers_si |= si(EFFECT_TABLES[name], dict.fromkeys((*missing, *unusable), nan) | good)
    for key in known_materials:
        if key in table:
            numbers_si[key] = material(f"{path}.{key}", table[key], errors)
    numbers_si |= {f"{seat}_interference": nan for seat in FITTED if f"{seat}_fit" in table}
    for seat, fit in fits.items():
        numbers_si |= {f"{seat}_fit": fit, f"{seat}_interference": fit.mean}
    effect: RingEffect | None = made(lambda: RING_EFFECTS[name](**numbers_si), errors)
    return effect if len(errors) == before else None


def _elastic_rings(path: str, table: Any, errors: Errors) -> ElasticRings | None:
    """The effect whose rings, and what holds them, are tables within its own."""
    flat = flattened(table) if isinstance(table, dict) else table
    before = len(errors)
    good, _ = checked(_ELASTIC_RINGS, path, flat, errors)
    if not isinstance(table, dict) or len(errors) > before:
        return None
    fields: dict[str, Any] = si(EFFECT_TABLES[ElasticRings.name], good)
    fields |= {field: good[name] for name, field in SEATS.items() if name in good}
    fields |= {key.field: tuple(key.si(np.asarray(good[key.name]))) for key in RING_COMPLIANCES if key.name in good}
    return made(lambda: ElasticRings(**fields), errors)


def ball_deviations(given: Any, errors: Errors) -> BallDiameterDeviations | None:
    """The effect that a list of deviations within [effects] names, in the file's unit; None without one."""
    if given is None:
        return None
    return made(lambda: BallDiameterDeviations(BALL_DEVIATIONS.si(np.asarray(given, float))), errors)
