"""The table [effects] of a scene file: ball effects, choices, and the tables of ring effects within it."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from qsbearing.files.file_errors import FileErrorDetail, translate
from qsbearing.files.fits import fits_of
from qsbearing.files.keys import (
    BALL_DEVIATIONS,
    EFFECT_TABLES,
    EFFECTS,
    RING_EFFECTS,
    SEAT_FITS,
    SEATS,
)
from qsbearing.files.stated import Given, Stated
from qsbearing.files.table_checks import (
    Check,
    Errors,
    add_missing,
    as_it_is,
    as_number,
    as_word,
    checked,
    choice_fields,
    did_you_mean,
    flattened,
    list_of,
    made,
    read_fields,
    si,
    table_model,
)
from qsbearing.model import accuracy
from qsbearing.model.effects import (
    BallDiameterDeviations,
    BallEffect,
    ElasticRings,
    GyroscopicMoment,
    RingEffect,
    RingExpansion,
    types_in,
)
from qsbearing.model.effects.orbit_radius import OrbitRadius
from qsbearing.model.effects.raceway_control import RacewayControl
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
_OTHERS: dict[str, dict[str, Check]] = {
    RingExpansion.name: dict.fromkeys(SEAT_FITS, as_it_is), ElasticRings.name: dict.fromkeys(SEATS, as_word)
}  # fmt: skip
"""What the tables of ring effects have that is described at no field."""


class ReadEffects(NamedTuple):
    """The table [effects] as it was read."""

    fields: dict[str, Any]
    """Those of `Scene` that say what is asked for, but the ring effects."""
    tables: dict[str, Given]
    """Of the ring effects that have one."""
    deviations: BallDiameterDeviations | None = None

    def made(self, errors: Errors, balance_keys: frozenset[str], stated: Stated) -> tuple[RingEffect, ...]:
        """Its ring effects."""
        effects = [*ring_effects(self.tables.values(), errors, balance_keys, stated), self.deviations]
        return tuple(each for each in effects if each is not None)


def read_effects(document: dict[str, Any], errors: Errors) -> ReadEffects:
    """What a file asks for in [effects]."""
    table = document.get("effects")
    if table == AUTO:
        tolerance = _tolerance(document.get("tolerance", accuracy.DEFAULT_ACCURACY), errors)
        return ReadEffects({"tolerance": tolerance}, {})
    if "tolerance" in document:
        cause = 'Write effects = "auto" next to it, at the top of the file, or leave it out'
        errors.append(FileErrorDetail("tolerance", 'is given without effects = "auto"', cause=cause))
    if isinstance(table, str):
        cause = 'Write effects = "auto" to have them chosen, or [effects] with its keys below it'
        errors.append(FileErrorDetail("effects", "is not a table", table, cause=cause))
        return ReadEffects({}, {})
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
    by_name: dict[str, BallEffect] = {name: BALL_EFFECTS[name]() for name in names if name in BALL_EFFECTS}
    moment = partial(GyroscopicMoment, *(() if shares is None else (shares,)))
    by_name[GyroscopicMoment.name] = made(lambda: moment(**si(EFFECTS, numbers)), errors) or moment()
    effects = tuple(by_name[name] for name in names if name in by_name)
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
    deviations = None
    if BALL_DEVIATIONS.name in good:
        by_ball = BALL_DEVIATIONS.si(np.asarray(good[BALL_DEVIATIONS.name], float))
        deviations = made(lambda: BallDiameterDeviations(by_ball), errors)
    fields = {"ball_effects": effects, **traction} | {name: good[name] for name in CHOICES if name in good}
    return ReadEffects(fields, tables, deviations)


def _traction(effects: Any, errors: Errors) -> tuple[dict[str, Any], Any]:
    """The field of `Scene` that the table of the law of friction makes, where there is one; and the other effects."""
    if not isinstance(effects, dict) or effects.get(Traction.name) is None:
        return {}, effects
    before = len(errors)
    path, law = f"effects.{Traction.name}", choice_fields("law")
    fields = read_fields(Traction, Traction.name, path, effects[Traction.name], errors, law)
    traction = made(lambda: Traction(**fields), errors) if len(errors) == before else None
    return {Traction.name: traction}, {name: each for name, each in effects.items() if name != Traction.name}


def _tolerance(value: Any, errors: Errors) -> float | None:
    if isinstance(value, bool) or not isinstance(value, int | float) or not accuracy.is_allowed(value):
        cause = f"Give the relative error that is allowed, {accuracy.ALLOWED}: 0.01 is 1 %"
        errors.append(FileErrorDetail("tolerance", "is not a relative error", value, cause=cause))
        return None
    return float(value)


def read_tables(tables: dict[str, Any], errors: Errors) -> dict[str, Given]:
    """What the tables of ring effects among these state."""
    read = {name: _read(name, tables[name], errors) for name in EFFECT_TABLES if name in tables}
    return {name: each for name, each in read.items() if each is not None}


def _read(name: str, table: Any, errors: Errors) -> Given | None:
    is_nested = name == ElasticRings.name and isinstance(table, dict)  # its rings, and what holds them
    flat, others, before = flattened(table) if is_nested else table, _OTHERS.get(name, {}), len(errors)
    fields = read_fields(RING_EFFECTS[name], name, f"effects.{name}", flat, errors, others)
    if not isinstance(table, dict):
        return None
    return Given(name, {SEATS.get(key, key): each for key, each in fields.items()}, len(errors) == before)


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
    of, path = RING_EFFECTS[given.name], f"effects.{given.name}"
    if of is ElasticRings and not given.is_sound:
        return None
    fields: dict[str, Any] = {key.field: None for key in EFFECT_TABLES[given.name] if key.name in balance_keys}
    fields |= stated.filled(given).fields
    if of is RingExpansion:
        fields |= fits_of(path, fields, errors)
    add_missing(of, path, fields, errors, "the effect needs it")
    effect: RingEffect | None = made(lambda: of(**fields), errors)
    return effect
