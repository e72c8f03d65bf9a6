"""What is wrong with the parameters of elastic rings: by themselves, and for a bearing."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from qsbearing.model.effects.ring_compliance import MOST_HARMONICS
from qsbearing.model.validation import LENGTH, MODULUS, RATIO, ErrorDetail, Field, Sentence, on_side, within


class Grooves(NamedTuple):
    """What of a bearing its rings' compliance depends on, over cases."""

    inner_bottom: Any
    """Radius [m]."""
    outer_bottom: Any
    inner_groove: Any
    """Radius of the profile [m]."""
    outer_groove: Any
    is_symmetric: Any
    """Whether both shoulders of a ring are alike, as in a deep-groove bearing."""
    modulus: Any
    """Of the rings [Pa]."""
    poisson_ratio: Any


SIDES = {
    "outer": ("outside_diameter", "housing", "housing_outside_diameter", ("rigid", "free")),
    "inner": ("bore_diameter", "shaft", "shaft_bore_diameter", ("rigid", "free", "solid")),
}
"""Of each ring: its diameter away from the groove, what holds it, the diameter of that, and the words for it."""
SHOULDERS = {side: (f"{side}_shoulder_diameter", f"{side}_open_diameter") for side in SIDES}
SOFTEST = 1e-3
"""[m/N]: a newton moves no ring that is one by a millimetre; it catches mistakes of unit."""


def parameter_errors(effect: Any) -> list[ErrorDetail]:
    """Every error of the parameters of `ElasticRings` by themselves."""
    errors = [error for side in SIDES for error in _side_errors(effect, side)]
    if not errors and all(value is None for value in vars(effect).values()):
        cause = "Describe the outer ring, the inner ring or both; or leave the effect out"
        errors.append(ErrorDetail(effect.name, "describes no ring", cause=cause))
    return errors


def _side_errors(effect: Any, side: str) -> list[ErrorDetail]:
    diameter, seat, seat_diameter, words = SIDES[side]
    path, width = effect.name, f"{side}_width"
    lengths = {name: getattr(effect, name) for name in (diameter, width, *SHOULDERS[side], seat_diameter)}
    constants = {name: getattr(effect, f"{seat}_{name}") for name in ("elastic_modulus", "poisson_ratio")}
    word, table = getattr(effect, seat), getattr(effect, f"{side}_compliance")
    given = [name for name, value in lengths.items() if value is not None]
    given += [f"{seat}_{name}" for name, value in constants.items() if value is not None]
    given += [] if word is None else [seat]
    if table is not None:
        return _replaced_errors(path, side, given) + _table_errors(f"{path}.{side}_compliance", table)
    if not given:
        return []
    errors = []
    for name, value in lengths.items():
        if value is not None:
            errors += within(f"{path}.{name}", value, LENGTH, 0.0 if name == "shaft_bore_diameter" else 1e-5, 20.0)
    if constants["elastic_modulus"] is not None:
        errors += within(f"{path}.{seat}_elastic_modulus", constants["elastic_modulus"], MODULUS, 1e6, 1e25)
    if constants["poisson_ratio"] is not None:
        errors += within(f"{path}.{seat}_poisson_ratio", constants["poisson_ratio"], RATIO, 0.0, 0.499)
    for name in () if word == "rigid" else (diameter, width):
        if lengths[name] is None:
            detail = "the stiffness of the ring depends on it"
            errors.append(ErrorDetail(f"{path}.{name}", "missing", detail=detail))
    shoulder, opposite = SHOULDERS[side]
    if lengths[shoulder] is None and lengths[opposite] is not None:
        detail = Sentence("{opposite} is given", opposite=Field(opposite))
        errors.append(ErrorDetail(f"{path}.{shoulder}", "missing", detail=detail))
    if word is not None and str(word) not in words:
        errors.append(ErrorDetail(f"{path}.{seat}", f"is not one of {_quoted(words)}", str(word)))
    has_body = lengths[seat_diameter] is not None
    if word is None and not has_body:
        cause = f"One of {_quoted(words)}, or the diameter of the {seat}"
        errors.append(ErrorDetail(f"{path}.{seat}", "missing", cause=cause, detail="how the ring is held"))
    if word is not None and has_body:
        own, other = f"{path}.{seat}", Field(seat_diameter)
        cause = Sentence("Leave one of the two out: {other} describes the {seat}", other=other, seat=seat)
        problem = Sentence("is given together with {other}", other=other)
        errors.append(ErrorDetail(own, problem, str(word), cause=cause))
    if not has_body and str(word) != "solid":
        errors += [
            ErrorDetail(f"{path}.{seat}_{name}", f"is given, but the {seat} is not elastic")
            for name, value in constants.items()
            if value is not None
        ]
    return errors


def _replaced_errors(path: str, side: str, given: list[str]) -> list[ErrorDetail]:
    if not given:
        return []
    cause = Sentence("Leave out {given}: the compliances replace them", given=tuple(map(Field, given)))
    problem = Sentence("is given together with {compliance}", compliance=Field(f"{side}_compliance"))
    return [ErrorDetail(f"{path}.{given[0]}", problem, cause=cause)]


def _quoted(words: tuple[str, ...]) -> str:
    return ", ".join(f'"{word}"' for word in words)


def _table_errors(field: str, table: Any) -> list[ErrorDetail]:
    cause = f"At most {MOST_HARMONICS + 1} numbers, for n = 0, 1, 2, ...; that for n = 1 is the mount's"
    if np.ndim(table) != 1 or not 1 <= len(table) <= MOST_HARMONICS + 1:
        return [ErrorDetail(field, "is not a list of compliances by harmonic", cause=cause)]
    return [error for value in table for error in within(field, value, RATIO, 0.0, SOFTEST)][:1]


def section_errors(effect: Any, grooves: Grooves) -> list[ErrorDetail]:
    """Diameters that are no rings around these grooves, no shoulders, no housing around the ring, no shaft within."""
    pairs = [
        ("outside_diameter", "around the bottom of the outer groove", 2.0 * grooves.outer_bottom, 1.0),
        ("bore_diameter", "within the bottom of the inner groove", 2.0 * grooves.inner_bottom, -1.0),
        ("housing_outside_diameter", "around the ring", effect.outside_diameter, 1.0),
        ("shaft_bore_diameter", "within the ring's bore", effect.bore_diameter, -1.0),
    ]
    for side, outward in (("outer", -1.0), ("inner", 1.0)):
        bottom, radius = (getattr(grooves, f"{side}_{name}") for name in ("bottom", "groove"))
        for name in SHOULDERS[side]:
            pairs.append((name, f"on the balls' side of the bottom of the {side} groove", 2.0 * bottom, outward))
            centre = 2.0 * (bottom + outward * radius)
            pairs.append((name, f"on the ring's side of the {side} groove's centre circle", centre, -outward))
    errors = []
    for name, what, limit, outward in pairs:
        value = getattr(effect, name)
        if value is not None and limit is not None:
            errors += on_side(f"{effect.name}.{name}", value, limit, outward, what)
    return errors
