"""The numeric keys that a study may vary: those of a scene file, groove radius coefficients, and the deviations of the
balls' diameters."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from qsbearing.files.file_keys import numbers, sections
from qsbearing.files.thermal_keys import SECTIONS as THERMAL_SECTIONS
from qsbearing.files.usual_words import usual
from qsbearing.model.operation import CHANNELS
from qsbearing.model.scene.keys import BALL_DEVIATIONS, COEFFICIENTS, MATERIALS, OPERATION, PRELOAD, RACEWAYS
from qsbearing.model.validation import near

_EITHER = (
    ("bearing.free_contact_angle_deg", "bearing.diametral_clearance_mm"),
    *(
        tuple(f"operation.{key.name}" for key in OPERATION if key.field in (each.load, each.displacement))
        for each in CHANNELS[1:]
    ),
    (
        *(f"operation.{key.name}" for key in OPERATION if key.field in (CHANNELS[0].load, CHANNELS[0].displacement)),
        *(f"preload.{key.name}" for key in PRELOAD),
    ),
)
"""Of these a scene has one."""


EACH_BALL = "ball_diameter_deviation_um"
"""Of every ball, drawn at random for each on its own; that of one ball has its number behind it."""
_ONE_BALL = re.compile(rf"{EACH_BALL}_(\d{{1,4}})")


@dataclass(frozen=True)
class StudyKey:
    """One number of a scene, as a study names it."""

    name: str
    """Of the axis: the key itself, a material's with the material before it."""
    path: tuple[str, ...]
    """Where it stands in a scene file."""
    unit: str
    replaces: tuple[str, ...] = ()
    """Paths of the keys that it stands in place of: a load for a displacement, an angle for a clearance."""
    ball: int | None = None
    """Of which ball it is one number of a list; None: it is a number by itself."""


def _all() -> dict[str, StudyKey]:
    tables: list[tuple[tuple[str, ...], str]] = []
    by_table, of_section = numbers(), sections()
    for table in by_table:
        if table == "unequal_balls":
            continue  # a list
        if table == "material":
            tables += [(("bearing", material), table) for material in MATERIALS]
        else:
            within = next((holder for holder, names in of_section.items() if table in names), "")
            tables.append(((within, table) if within else (table,), table))
    found: dict[str, StudyKey] = {}
    for path, table in tables:
        for key in by_table[table]:
            name = f"{path[-1]}_{key.name}" if table == "material" or key.name in found else key.name
            own = ".".join((*path, key.name))
            replaces = tuple(other for group in _EITHER if own in group for other in group if other != own)
            found[name] = StudyKey(name, (*path, key.name), key.unit, replaces)
    for name in COEFFICIENTS:
        found[name] = StudyKey(name, ("bearing", name), "1", _replaced(name))
    for key in RACEWAYS:
        found[key.name] = StudyKey(key.name, ("bearing", key.name), key.unit)
    for radius in ("inner_groove_radius_mm", "outer_groove_radius_mm"):
        found[radius] = replace(found[radius], replaces=_replaced(radius))
    return found


def _replaced(name: str) -> tuple[str, ...]:
    """Paths of the keys that say the same of a groove: of a radius its coefficient, of a coefficient what it covers."""
    radii = COEFFICIENTS.get(name, ())
    covered = [each for each, own in COEFFICIENTS.items() if own == (name,) or (len(own) < len(radii))]
    return tuple(f"bearing.{each}" for each in (*radii, *covered))


ALL = _all()
"""Every key by its name."""
TABLES = {table for key in ALL.values() for table in key.path[:-1]}
"""Names of the tables, and tables within, that hold them."""


def find(name: str) -> StudyKey | None:
    """The key of a name: `speed_rpm`, `operation.speed_rpm`, `ball_material.density_kg_m3`; None: there is none."""
    if name in ALL:
        return ALL[name]
    one = _ONE_BALL.fullmatch(name)
    if one or name == EACH_BALL:
        ball = int(one.group(1)) if one else None
        return StudyKey(name, ("effects", BALL_DEVIATIONS.name), BALL_DEVIATIONS.unit, ball=ball)
    return next((key for key in ALL.values() if "." in name and f".{'.'.join(key.path)}".endswith(f".{name}")), None)


def known(name: str) -> StudyKey:
    """The key of a name that has one."""
    key = find(name)
    assert key is not None, name
    return key


def suggestion(name: str) -> str:
    """What is likely meant by a name that no key has."""
    if "thermal" in name.split(".") or any(name in names for names in THERMAL_SECTIONS.values()):
        return "Numbers of [thermal] make one network for all points: write a file for each value"
    stems = {".".join(key.path[:-1]) + "." + key.path[-1]: key.name for key in ALL.values()}
    fields = {field.field: field.name for fields in numbers().values() for field in fields}
    word = name.rpartition(".")[2]
    by_word = usual(word)
    if by_word and by_word.key in ALL:
        return f"Did you mean {by_word}?"
    meant = (
        near(word, [*ALL, EACH_BALL], 0.6)
        or fields.get(near(word, fields, 0.5), "")
        or stems.get(near(name, stems, 0.6), "")
    )
    return f"Did you mean {meant}?" if meant else "Any numeric key of a scene file, such as speed_rpm or axial_load_N"
