"""The table [effects] of a scene file: ball effects, choices, and the tables of ring effects within it."""

from __future__ import annotations

from collections.abc import Iterable
from math import nan
from typing import Any, NamedTuple

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
    SEAT_FITS,
    SEATS,
    TRACTION,
    required_of,
)
from qsbearing.files.stated import Given, Stated
from qsbearing.files.table_checks import (
    Check,
    Errors,
    as_it_is,
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
_LISTS = {key.name: key for key in RING_COMPLIANCES}
_FIELDS = SEATS | {name: key.field for name, key in _LISTS.items()}
"""How Python calls what is no number."""
_MATERIALS = {name: materials_of(of) for name, of in RING_EFFECTS.items()}
_OTHERS: dict[str, dict[str, Check]] = {name: dict.fromkeys(each, as_it_is) for name, each in _MATERIALS.items()}
_OTHERS[RingExpansion.name] |= dict.fromkeys(SEAT_FITS, as_it_is)
_OTHERS[ElasticRings.name] |= dict.fromkeys(SEATS, as_word) | {key.name: list_of(as_number) for key in RING_COMPLIANCES}
_EFFECT_TABLES = {name: table_model(name, keys, _OTHERS[name]) for name, keys in EFFECT_TABLES.items()}


class ReadEffects(NamedTuple):
    """The table [effects] as it was read."""

    fields: dict[str, Any]
    """Those of `Scene` that say what is asked for, but the ring effects."""
    tables: dict[str, Given]
    """Of the ring effects that have one."""
    deviations: BallDiameterDeviations | None
    has_deviations: bool
    """Whether it gives any, usable or not."""

    def made(self, errors: Errors, balance_keys: frozenset[str], stated: Stated) -> tuple[RingEffect, ...]:
        """Its ring effects."""
        effects = [*ring_effects(self.tables.values(), errors, balance_keys, stated), self.deviations]
        return tuple(each for each in effects if each is not None)


def read_effects(document: dict[str, Any], errors: Errors) -> ReadEffects:
    """What a file asks for in [effects]."""
    table = document.get("effects")
    if table == AUTO:
        tolerance = _tolerance(document.get("tolerance", DEFAULT_ACCURACY), errors)
        return ReadEffects({"tolerance": tolerance}, {}, None, False)
    if "tolerance" in document:
        cause = 'Write effects = "auto" next to it, at the top of the file, or leave it out'
        errors.append(FileErrorDetail("tolerance", 'is given without effects = "auto"', cause=cause))
    if isinstance(table, str):
        cause = 'Write effects = "auto" to have them chosen, or [effects] with its keys below it'
        errors.append(FileErrorDetail("effects", "is not a table", table, cause=cause))
        return ReadEffects({}, {}, None, False)
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
    tables = read_tables(within, errors)
    has_deviations = isinstance(table, dict) and BALL_DEVIATIONS.name in table
    deviations = ball_deviations(good.pop(BALL_DEVIATIONS.name, None), errors)
    fields = {"ball_effects": effects, **traction} | {name: good[name] for name in CHOICES if name in good}
    return ReadEffects(fields, tables, deviations, has_deviations)


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


def read_tables(tables: dict[str, Any], errors: Errors) -> dict[str, Given]:
    """What the tables of ring effects among these state."""
    read = {name: _read(name, tables[name], errors) for name in EFFECT_TABLES if name in tables}
    return {name: each for name, each in read.items() if each is not None}


def _read(name: str, table: Any, errors: Errors) -> Given | None:
    path, keys = f"effects.{name}", EFFECT_TABLES[name]
    is_nested = name == ElasticRings.name and isinstance(table, dict)  # its rings, and what holds them
    good, unusable = checked(_EFFECT_TABLES[name], path, flattened(table) if is_nested else table, errors)
    if not isinstance(table, dict):
        return None
    fields: dict[str, Any] = si(keys, good)
    for key in [each for each in _OTHERS[name] if each in good]:
        value = good[key]
        if key in _MATERIALS[name]:
            value = material(f"{path}.{key}", value, errors)
        elif key in _LISTS:
            value = tuple(_LISTS[key].si(np.asarray(value)))
        fields[_FIELDS.get(key, key)] = value
    names = {key.name: key.field for key in keys} | _FIELDS
    return Given(name, fields, frozenset(names.get(key, key) for key in unusable))


def ring_effects(
    tables: Iterable[Given], errors: Errors, balance_keys: frozenset[str], stated: Stated
) -> tuple[RingEffect, ...]:
    """The effects of these tables; without those whose errors were found.

    Args:
        balance_keys: of temperatures that the heat balance will find.
        stated: what tables take and need not state.
    """
    made = (_ring_effect(each, errors, balance_keys, stated) for each in tables)
    return tuple(each for each in made if each is not None)


def _ring_effect(given: Given, errors: Errors, balance_keys: frozenset[str], stated: Stated) -> RingEffect | None:
    name, path, keys = given.name, f"effects.{given.name}", EFFECT_TABLES[given.name]
    if name == ElasticRings.name and given.unusable:
        return None
    of, before = RING_EFFECTS[name], len(errors)
    fields, fits = {**stated.filled(given).fields}, dict[str, Fit]()
    if name == RingExpansion.name:
        fields, fits = fits_of(path, fields, errors)
    required = {key.name: key.field for key in required_of(of)}
    missing = lacking(required, {key.name for key in keys if key.field in {*fields, *given.unusable}}, balance_keys)
    errors += [FileErrorDetail(f"{path}.{key}", "missing", detail="the effect needs it") for key in missing]
    later: dict[str, Any] = {key.field: None for key in keys if key.name in balance_keys}
    numbers = {key.field for key in keys}
    unusable = dict.fromkeys((*(required[key] for key in missing), *(given.unusable & numbers)), nan)
    seats: dict[str, Any] = {f"{seat}_interference": nan for seat in FITTED if f"{seat}_fit" in given.fields}
    for seat, fit in fits.items():
        seats |= {f"{seat}_fit": fit, f"{seat}_interference": fit.mean}
    effect: RingEffect | None = made(lambda: of(**later | unusable | fields | seats), errors)
    return effect if len(errors) == before and not given.unusable else None


def ball_deviations(given: Any, errors: Errors) -> BallDiameterDeviations | None:
    """The effect that a list of deviations within [effects] names, in the file's unit; None without one."""
    if given is None:
        return None
    return made(lambda: BallDiameterDeviations(BALL_DEVIATIONS.si(np.asarray(given, float))), errors)
