"""The numbers that a study may vary: any number of a file by its path, those of a scene by their names alone too,
groove radius coefficients, and the deviations of the balls' diameters."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from qsbearing.files import paths
from qsbearing.files.file_keys import numbers, sections
from qsbearing.files.keys import BALL_DEVIATIONS, COEFFICIENTS, MATERIALS, OPERATION, PRELOAD, RACEWAYS
from qsbearing.files.scene_or_set import is_set
from qsbearing.files.usual_words import usual
from qsbearing.model.bearing_errors import BALL_COUNT_RANGE
from qsbearing.model.operation import CHANNELS
from qsbearing.model.validation import alike, question, whole_number

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
"""Of every ball, drawn at random for each on its own."""


def of_ball(number: int) -> str:
    """The name of the deviation of one ball, counted from 0."""
    return f"{EACH_BALL}_{number}"


def ball_of(name: str) -> int | None:
    """The ball that a name is of, as `of_ball` writes it; None: it is none of these names, or no bearing has it."""
    of, _, number = name.rpartition("_")
    ball = whole_number(number) if of == EACH_BALL else None
    return ball if ball is not None and ball < BALL_COUNT_RANGE[1] else None


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


SETTINGS = ("radial_points", "points_around")
"""Numbers of the solver, one for all cases."""


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
    by_name: dict[str, StudyKey] = {}
    for path, table in tables:
        for key in by_table[table]:
            if key.field in SETTINGS:
                continue
            name = f"{path[-1]}_{key.name}" if table == "material" or key.name in by_name else key.name
            own = ".".join((*path, key.name))
            replaces = tuple(other for group in _EITHER if own in group for other in group if other != own)
            by_name[name] = StudyKey(name, (*path, key.name), key.unit, replaces)
    for name in COEFFICIENTS:
        by_name[name] = StudyKey(name, ("bearing", name), "1", _replaced(name))
    for key in RACEWAYS:
        by_name[key.name] = StudyKey(key.name, ("bearing", key.name), key.unit)
    for radius in ("inner_groove_radius_mm", "outer_groove_radius_mm"):
        by_name[radius] = replace(by_name[radius], replaces=_replaced(radius))
    return by_name


def _replaced(name: str) -> tuple[str, ...]:
    """Paths of the keys that say the same of a groove: of a radius its coefficient, of a coefficient what it covers."""
    radii = COEFFICIENTS.get(name, ())
    covered = [each for each, own in COEFFICIENTS.items() if own == (name,) or (len(own) < len(radii))]
    return tuple(f"bearing.{each}" for each in (*radii, *covered))


ALL = _all()
"""Every key by its name."""


def find(name: str) -> StudyKey | None:
    """The key of a name or path: `speed_rpm`, `operation.speed_rpm`, `ball_material.density_kg_m3`,
    `shaft.loads.1.radial_y_N`; None: there is none."""
    if name in ALL:
        return ALL[name]
    ball = ball_of(name)
    if ball is not None or name == EACH_BALL:
        return StudyKey(name, ("effects", BALL_DEVIATIONS.name), BALL_DEVIATIONS.unit, ball=ball)
    path = tuple(name.split("."))
    if len(path) == 1:
        return None
    if path[:-1] == ("effects", BALL_DEVIATIONS.name) and (ball_number := whole_number(path[-1])):
        return find(of_ball(ball_number - 1))
    of_scene = next((key for key in ALL.values() if f".{'.'.join(key.path)}".endswith(f".{name}")), None)
    key = None if of_scene else paths.key_at(path)
    if key is None:
        return of_scene
    replaces = next((each.replaces for each in ALL.values() if each.path == path[-2:]), ())
    own = (each.removeprefix(f"{path[-2]}.") for each in replaces if each.startswith(f"{path[-2]}."))
    return StudyKey(name, path, key.unit, tuple(".".join((*path[:-1], each)) for each in own))


def known(name: str) -> StudyKey:
    """The key of a name that has one."""
    key = find(name)
    assert key is not None, name
    return key


def replaced(key: StudyKey, document: dict[str, Any]) -> list[tuple[str, ...]]:
    """The paths that a key stands in place of in this document: a set's preload leaves the shaft its axial channel."""
    others = [tuple(each.split(".")) for each in key.replaces]
    return [other for other in others if not is_set(document) or other[:-1] == key.path[:-1]]


def problem(name: str, document: dict[str, Any]) -> tuple[str, ...]:
    """What is wrong with a name as that of a number of this document, and what is likely meant; empty if nothing is."""
    key = find(name)
    if key is None:
        return "is not a numeric key of a scene", suggestion(name, document)
    lacks = paths.missing_table(document, key.path)
    return tuple(filter(None, (f"is not in the file: {lacks}", _told(paths.meant(name, document))))) if lacks else ()


def suggestion(name: str, document: dict[str, Any]) -> str:
    """What is likely meant by a name that no key has."""
    own = paths.meant(name, document)
    if own:
        return _told(own)
    stems = {".".join(key.path[:-1]) + "." + key.path[-1]: key.name for key in ALL.values()}
    fields = {field.field: field.name for fields in numbers().values() for field in fields}
    word = name.rpartition(".")[2]
    by_word = usual(word)
    if by_word and by_word.key in ALL:
        return f"Did you mean {by_word}?"
    meant = (
        alike(word, [*ALL, EACH_BALL])
        or [fields[each] for each in alike(word, fields)]
        or [stems[each] for each in alike(name, stems)]
    )
    return question(meant) or "Any number of the file, such as speed_rpm or rows.1.position_mm"


def _told(meant: list[str]) -> str:
    """Those likely meant, each as short as it may be."""
    return paths.told([key.name if (key := find(path)) else path for path in meant])
