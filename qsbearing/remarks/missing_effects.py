"""Remarks on effects that a scene or set lacks, though its results would change with them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects import EFFECTS, QUANTITIES, Entry
from qsbearing.model.solution.changes import (
    Change,
    changes,
    has_size_for,
    is_unknown_to_friction,
    requested,
    rows_of,
)
from qsbearing.model.solution.comparison import moved
from qsbearing.model.solution.judgement import (
    ANOTHER_RESULT,
    WORDS,
    WORTH_A_WARNING,
    changed,
    estimated,
    judge,
    settings_to_add,
    shifted,
    unit_of,
)
from qsbearing.model.solution.of_cases import may_solve_alike
from qsbearing.model.units import um
from qsbearing.model.validation import Field, Sentence, Setting
from qsbearing.remarks.case_range import CaseRange
from qsbearing.remarks.kinds import INCOMPLETE, SEE_AXIS, Kind
from qsbearing.remarks.remark import Holding, Of, Remark
from qsbearing.remarks.wording import Audience, Words, listed, spanned

DISPLACEMENT = "displacement"
MOST_CASES = 64
"""More cases than these (chosen: more points than a load spectrum has) are not solved again: what indicators predict of
them is said with ≈, and nothing of effects of which they predict nothing."""
WORTH_A_SOLVE = 0.4 * WORTH_A_WARNING
"""A predicted error above which an effect that needs nothing is tried (chosen: most predictions are within a factor
of two)."""


_ADD = {
    Audience.PYTHON: "Set {}",
    Audience.FILE: "Add under [effects]: {}",
    Audience.PAGE: "Tick what is missing in the table of effects",
}
_ADVICE = {
    Audience.PYTHON: "give",
    Audience.FILE: "give",
    Audience.PAGE: "switch it on under Effects or add its numbers:",
}
EFFECT = {entry.name: entry for entry in EFFECTS}
MORE, BY = "more than 100", " by "
"""`ANOTHER_RESULT` in a sentence, and what then stands between a quantity and its change."""


def to_add(settings: Sequence[Setting], words: Words) -> str:
    """What to do for effects that could be named as it is."""
    return _ADD[words.reader].format(", ".join(words.spell(each, "") for each in settings))


def _missing(fields: Mapping[str, Any], words: Words) -> str:
    """Effects that could be named as it is, and what each would change."""
    moved = iter(fields.get("displacements_um", ()))
    said = [
        f"{EFFECT[name].what} ({_of_quantity(quantity, _changes(fields, quantity, change, moved))})"
        for name, quantity, change in zip(fields["effects"], fields["quantities"], fields["changes"], strict=True)
    ]
    are = "is" if len(said) == 1 else "are"
    return f"{listed(said)} {are} not included. {to_add(fields['add'], words)}"


def needed(entry: Entry, has_size: bool, words: Words) -> str:
    """What to give for an effect that needs numbers of the scene: in a file not what its bearing has."""
    beside = entry.needs_beside_size if has_size and words.reader is not Audience.PYTHON else ""
    return words.of(beside or entry.needs)


def _lacking(fields: Mapping[str, Any], words: Words) -> str:
    """An effect that needs numbers of the scene: what it would change, and what to give."""
    needs = needed(EFFECT[fields["effect"]], bool(fields.get("has_size")), words)
    return f"{_would_change(fields)}. To include it, {_ADVICE[words.reader]} {needs}"


def _unknown_to_friction(fields: Mapping[str, Any], words: Words) -> str:
    """An effect that cannot be asked for where friction moves the balls, and what it would change elsewhere."""
    return f"{_would_change(fields)} under outer control. Balls that friction moves do not know it yet"


def _would_change(fields: Mapping[str, Any]) -> str:
    entry, quantity = EFFECT[fields["effect"]], fields["quantity"]
    changes = _changes(fields, quantity, fields["changes"], iter(fields.get("displacements_um", ())), MORE)
    by = [f"{change}{f' ({under})' * bool(under)}" for change, under in zip(changes, fields["under"], strict=True)]
    begun = entry.without_it or f"{entry.what} is not included; it"
    return f"{begun} would change the {_of_quantity(quantity, by if len(set(changes)) > 1 else changes[:1], BY)}"


def _changes(
    fields: Mapping[str, Any], quantity: str, changes: Sequence[Any], moved: Iterator[Any], more: str = ANOTHER_RESULT
) -> list[str]:
    """Changes of a quantity, each of which may be a `Span`: in its own unit where solved, else relative ones."""
    if quantity == "displacement" and not fields["is_estimated"]:
        return [f"{spanned(shifted, next(moved))} {unit_of(quantity)}" for _ in changes]
    number = estimated if fields["is_estimated"] else changed
    return [f"{spanned(lambda each: more if each > 1.0 else number(each, ''), change)} %" for change in changes]


def _of_quantity(quantity: str, by: Sequence[str], link: str = " ") -> str:
    """What changes most, and by how much."""
    if not quantity:
        return "result: no solution is found with it"
    said = " to ".join(by)
    is_about = link == BY and not said.startswith(("≈", MORE, "0 "))
    return f"{WORDS[quantity]}{link}{'about ' * is_about}{said}"


OF_EFFECTS = {"gyroscopic_slip": "effects.friction_coefficient=0.06"}
"""To paste for an effect that lacks its numbers, where no example stands beside what it needs: the least of lubricated
steel."""


def _add_effects(values: Mapping[str, Any], words: Words) -> list[str]:
    return _under("effects", values["add"], words)


def _add_data(values: Mapping[str, Any], words: Words) -> list[str]:
    """What makes an effect act that needs numbers of the scene: the example beside what it needs."""
    name = values["effect"]
    needed = EFFECT[name].needs_beside_size
    if not values["has_size"] or not isinstance(needed, Sentence):
        return [OF_EFFECTS[name]] if name in OF_EFFECTS else []
    return _under(f"effects.{name}", needed.values["example"], words)


def _under(table: str, settings: Sequence[Field], words: Words) -> list[str]:
    """Keys of a table with their values; none where one takes a table of its own."""
    pairs = [words.spell(each, "").partition(" = ") for each in settings if isinstance(each, Setting)]
    return [f"{table}.{key}={_bare(value)}" for key, _, value in pairs] if all(value for *_, value in pairs) else []


def _bare(value: str) -> str:
    """A word without its quotation marks."""
    word = value.strip('"')
    return word if word.isidentifier() else value


EFFECTS_MISSING = Kind(
    "effects_missing", INCOMPLETE, "accuracy",
    "{effects} ({quantities} {changes}) are not included. Add under [effects]: {add}",
    say=_missing,
    setting=_add_effects,
)  # fmt: skip
EFFECT_DATA_MISSING = Kind(
    "effect_data_missing", INCOMPLETE, "accuracy",
    "{effect} is not included; it would change the {quantity} by about {changes} ({under}). To include it, give "
    "its numbers",
    say=_lacking,
    setting=_add_data,
)  # fmt: skip
EFFECT_UNKNOWN_TO_FRICTION = Kind(
    "effect_unknown_to_friction", INCOMPLETE, SEE_AXIS,
    "{effect} is not included, which balls that friction moves do not know; under outer control it would change the "
    "{quantity} by about {changes} ({under})",
    say=_unknown_to_friction,
)  # fmt: skip


def missing_effects(of: CaseRange) -> Iterator[Holding]:
    """Of a scene or set; a row of a set has nothing to say of itself."""
    solution, part = of.solution, of.part
    if not may_solve_alike(solution):
        return
    are_few = of.may_solve and int(np.prod(solution.shape)) <= MOST_CASES
    yield from _of_known(solution, part, are_few)
    yield from _of_assumed(solution, part, are_few)
    yield from _of_unknown_to_friction(solution, part, are_few)


def _of_known(solution: Any, part: slice, are_few: bool) -> Iterator[Holding]:
    """Effects and choices that could be named as it is."""
    if getattr(solution, "choice", None) is not None:  # what was left out there is said with its error
        return
    of = requested(solution)
    candidates = []
    for entry in EFFECTS:
        if entry.hypothesis or not entry.can_be_added(of):
            continue
        predicted = _predicted(entry, solution)
        if not are_few:
            candidates.append((entry, predicted))
        elif np.any(predicted.largest > WORTH_A_SOLVE):
            candidates += [(entry, each) for each in changes(entry, solution)]
    if not candidates:
        return
    matters = np.stack([_matters(change, part) for _, change in candidates])
    by = np.max([change.largest.reshape(-1)[part] for _, change in candidates], axis=0)

    def missing(i: int) -> Remark:
        here = [each for each, matters_there in zip(candidates, matters[:, i], strict=True) if matters_there]
        k = part.start + i
        most = [_most([change], k) for _, change in here]
        about = list(zip(here, most, strict=True))
        return Remark(
            EFFECTS_MISSING,
            values={
                "effects": tuple(entry.name for entry, _ in here),
                "quantities": tuple(quantity for quantity, _ in most),
                "changes": tuple(change for _, change in most),
                "is_estimated": not are_few,
                **_moved(solution, [each for (_, each), (name, _) in about if name == DISPLACEMENT], k),
                "add": settings_to_add(of, [entry for entry, _ in here]),
            },
        )

    yield np.where(matters.any(axis=0), by, 0.0), missing


def _of_assumed(solution: Any, part: slice, are_few: bool) -> Iterator[Holding]:
    """Effects that need numbers of the scene, which no choice of effects can add either."""
    rows = rows_of(solution)
    for entry in EFFECTS:
        lacking = [n for n, row in enumerate(rows, 1) if not entry.is_in(row.scene)]
        if not entry.needs or not lacking or is_unknown_to_friction(entry, solution):
            continue
        predicted = [_predicted(entry, solution)] if entry.tells_without else []
        assumed = changes(entry, solution) if are_few else predicted
        if assumed:
            of = Of(rows=() if len(lacking) == len(rows) else tuple(lacking))
            matters = np.any([_matters(each, part) for each in assumed], axis=0)
            by = np.max([each.largest.reshape(-1)[part] for each in assumed], axis=0)
            yield np.where(matters, by, 0.0), partial(_lacks, solution, entry, of, assumed, part.start)


def _of_unknown_to_friction(solution: Any, part: slice, are_few: bool) -> Iterator[Holding]:
    """What cannot be asked for beside friction, by what it changes under outer control."""
    for entry in EFFECTS:
        if not is_unknown_to_friction(entry, solution) or entry.is_in(requested(solution)):
            continue
        predicted = [_predicted(entry, solution)] if entry.tells_without or not entry.needs else []
        is_worth_it = entry.needs or np.any(predicted[0].largest > WORTH_A_SOLVE)
        compared = changes(entry, solution) if are_few and is_worth_it else [] if are_few else predicted
        if compared:
            matters = np.any([_matters(each, part) for each in compared], axis=0)
            by = np.max([each.largest.reshape(-1)[part] for each in compared], axis=0)
            yield np.where(matters, by, 0.0), partial(_unknown, solution, entry, compared, part.start)


def _unknown(solution: Any, entry: Entry, compared: list[Change], start: int, i: int) -> Remark:
    k = start + i
    there = [each for each in compared if np.ravel(each.is_solved)[k]]
    quantity, by = _most(compared, k)
    under, is_solved = tuple(each.under for each in there), all(each.displacement is not None for each in compared)
    values: dict[str, Any] = {"effect": entry.name, "quantity": quantity, "changes": by, "under": under}
    values |= {"is_estimated": not is_solved, **_moved(solution, there if quantity == DISPLACEMENT else [], k)}
    return Remark(EFFECT_UNKNOWN_TO_FRICTION, values=values)


def _lacks(solution: Any, entry: Entry, of: Of, assumed: list[Change], start: int, i: int) -> Remark:
    """That an effect is missing, in some rows or in all, what it would change under each assumption, if solved."""
    k = start + i
    quantity, by = _most(assumed, k)
    there = [each for each in assumed if np.ravel(each.is_solved)[k]]
    under, is_solved = tuple(each.under for each in there), all(each.displacement is not None for each in assumed)
    values: dict[str, Any] = {"effect": entry.name, "quantity": quantity, "changes": by, "under": under}
    values |= {"is_estimated": not is_solved, "has_size": has_size_for(entry, solution)}
    return Remark(EFFECT_DATA_MISSING, of, values | _moved(solution, there if quantity == DISPLACEMENT else [], k))


def _moved(solution: Any, compared: list[Change], k: int) -> dict[str, tuple[float, ...]]:
    """Of a remark that speaks of displacements: by how much they change with each effect, or under each assumption."""
    by = [moved(solution, each.displacement) for each in compared if each.displacement is not None]
    return {"displacements_um": tuple(float(np.ravel(each)[k] / um) for each in by)} if by else {}


def _most(compared: list[Change], k: int) -> tuple[str, tuple[float, ...]]:
    """Which quantity changes most in a case, counted along the flattened axes, and by how much with each change that is
    solved; nothing where none is."""
    with_solution = [each for each in compared if np.ravel(each.is_solved)[k]]
    if not with_solution:
        return "", ()
    errors = {name: np.ravel(error)[k] for name, error in with_solution[-1].errors.items()}
    name = max(errors, key=lambda each: np.nan_to_num(errors[each], nan=0.0))
    return name, tuple(float(np.ravel(each.errors[name])[k]) for each in with_solution)


def _predicted(entry: Entry, solution: Any) -> Change:
    """By the indicator, of a set in the row where it is most."""
    row_errors = [judge(entry, row).errors for row in rows_of(solution)]
    nothing = np.zeros(solution.shape)
    errors = {name: np.max([each.get(name, nothing) for each in row_errors], axis=0) for name in QUANTITIES}
    return Change("", "", errors, np.ones(solution.shape, bool))


def _matters(change: Change, part: slice) -> NDArray:
    """Where some answer changes noticeably, in which cases of a stretch."""
    return np.asarray(change.largest.reshape(-1)[part] > WORTH_A_WARNING)
