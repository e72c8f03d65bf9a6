"""The table [bearing] of a scene file becomes a bearing, with a catalogue entry's numbers where it names one."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from math import nan
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from qsbearing.files import catalogue
from qsbearing.files.data_sheet_table import bearing_of_sheet, is_data_sheet, without_sheet
from qsbearing.files.designations import read
from qsbearing.files.file_errors import FileErrorDetail, translate
from qsbearing.files.keys import (
    BEARING,
    CLEARANCE,
    COEFFICIENTS,
    DIAMETERS,
    FREE_ANGLE,
    IN_PLACE,
    MATERIALS,
    PRINTED,
    RACEWAYS,
    RATINGS,
    SHEET_CHOICES,
    SHOULDERS,
    Key,
    required_of,
)
from qsbearing.files.sheet_by_name import clearance_by_name, designation_of, said_by_name, sheets_by_name
from qsbearing.files.table_checks import (
    Errors,
    as_it_is,
    as_word,
    checked,
    choice_fields,
    judged,
    material,
    si,
    table_model,
)
from qsbearing.inference import iso15
from qsbearing.inference.practice import RatingPractice
from qsbearing.model.bearing import (
    BallBearing,
    BearingKind,
    Outline,
    free_angle_from_clearance,
    pitch_and_clearance,
)
from qsbearing.model.bearing_errors import FREE_ANGLE_MAX
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.model.units import deg, mm
from qsbearing.model.validation import SceneError, printable

MODIFIED = ", modified"
"""After the name of a catalogue entry of which a scene changes some number."""
AGREEMENT = 0.005
"""A free contact angle and a diametral clearance given together may differ by this part of the clearance (chosen:
tables print both to three or four digits)."""

_OUTSIDE = {key.name for key in PRINTED}
_EITHER = {"free_contact_angle_deg", "diametral_clearance_mm"}
"""One given replaces the other of a catalogue's entry."""

_OTHERS = {"name": as_word, "maker": as_word, **dict.fromkeys(MATERIALS, as_it_is)}
_BEARING = table_model("bearing", (*BEARING, *IN_PLACE), _OTHERS | choice_fields("kind", *SHEET_CHOICES))
_RATED = RATINGS[0].name
_GUESSED = (
    "Its balls are guessed by proportions, from which lives are up to 8 times off: give dynamic_load_rating_N and "
    "static_load_rating_N in [bearing], as printed"
)
_DIFFER = "Makers rate it differently: write whose it is before the number"


class ReadBearing(NamedTuple):
    """A table [bearing] that was read, with what it states beside the bearing."""

    bearing: BallBearing | None = None
    """None where errors were found."""
    name: str = ""
    """As the file has it."""
    entry: catalogue.CatalogueEntry | None = None
    """Of the catalogue, by the name."""
    printed: Mapping[str, Any] = MappingProxyType({})
    """What a catalogue or a data sheet prints besides the model's lengths, in the units of a file by its keys."""
    unusable: frozenset[str] = frozenset()
    """Keys of which the file gives nothing that can be used."""
    tolerance_class: str = ""
    """Of its designation."""
    unrated: str = ""
    """Why nothing tells its C and C0, a sentence without its end; empty: they are printed, or follow from the balls."""
    preload_class: Any = None
    """The word of a preload beside it; None: there is none."""
    is_table: bool = True


NO_BEARING = ReadBearing(is_table=False)


def bearing_of(document: dict[str, Any], label: str, errors: Errors, may_infer: bool = False) -> BallBearing | None:
    """The bearing of a file's table [bearing]; None where errors were found and added."""
    return read_bearing(document, label, errors, may_infer).bearing


def read_bearing(
    document: dict[str, Any], label: str, errors: Errors, may_infer: bool = False, *, is_of_row: bool = False
) -> ReadBearing:
    """What a file's table [bearing] states.

    Args:
        may_infer: whether it may be a list of bearings, those that a data sheet allows.
        is_of_row: of a set, whose rows have no preload of their own.
    """
    if "bearing" not in document:
        cause = f'At the least name = "{catalogue.entries()[0].name}"'
        errors.append(FileErrorDetail("[bearing]", "missing", cause=cause))
    table = document.get("bearing")
    if table is None:
        return NO_BEARING
    before = len(errors)
    is_table = isinstance(table, dict)
    word = table.get("preload") if is_table and not is_of_row else None
    numbers = {key: value for key, value in table.items() if is_of_row or key != "preload"} if is_table else table
    good, unusable = checked(_BEARING, "bearing", numbers, errors)
    if not is_table:
        return NO_BEARING
    sheets = sheets_by_name(good, unusable)
    by_sheet = is_data_sheet({*good, *unusable}) or bool(sheets)
    clearance = clearance_by_name(good, unusable) if by_sheet else {}
    by_name = said_by_name(good, sheets, clearance)
    good = designated(good, unusable) | clearance
    entry, told = (catalogue.named(good["name"]), read(good["name"])) if "name" in good else (None, None)
    is_guess = good.get("rating_practice") == RatingPractice.PROPORTIONS or any(_RATED not in each for each in sheets)
    given = ReadBearing(
        name=good.get("name", ""),
        entry=entry,
        printed={key.name: good[key.name] for key in PRINTED if key.name in good},
        unusable=frozenset(unusable) - {""},
        tolerance_class="" if told is None else told.tolerance_class,
        unrated=_DIFFER if len(sheets) > 1 else _GUESSED if is_guess else "",
        preload_class=word,
    )
    if by_sheet and entry is None:
        rated = {key.name: sheets[0][key.name] for key in RATINGS if key.name in sheets[0]} if len(sheets) == 1 else {}
        if len(errors) == before:
            outline = _outline(given.printed)
            bearing = bearing_of_sheet(good, sheets, by_name, label, outline, errors, may_infer)
            given = given._replace(bearing=bearing)
        return given._replace(printed={**given.printed, **rated})
    return _of_balls(given, good, unusable, label, errors, before)


def _of_balls(
    given: ReadBearing, good: dict[str, Any], unusable: set[str], label: str, errors: Errors, before: int
) -> ReadBearing:
    """A bearing whose balls and grooves a file gives, or the catalogue.

    Args:
        good, unusable: the keys that can be used, with their values, and those that cannot.
        before: how many errors there were before the table was read.
    """
    entry = given.entry
    errors += without_sheet(good)
    # Which the model does not need: effects and readings take them, see `stated`.
    good = {key: each for key, each in good.items() if key not in given.printed}
    of_radius = _coefficients(good, unusable, errors)
    diameter = good.get("ball_diameter_mm")
    if diameter is None and entry is not None and "ball_diameter_mm" not in unusable:
        diameter = entry.bearing["ball_diameter_mm"]
    if diameter is None:
        unusable |= set(of_radius)  # one mistake: the ball's diameter is missing
    else:
        good |= {radius: coefficient * diameter for radius, coefficient in of_radius.items()}
    is_clearance_given = bool(_EITHER & {*good, *unusable})
    of_raceways = _raceways(good, unusable, {} if entry is None else entry.bearing, errors)
    good |= of_raceways
    from_entry: dict[str, Any] = {}
    if entry is not None:
        label = label_of(entry, good)
        given = given._replace(printed={**kept(entry, changed_keys(entry, good)), **given.printed})
        replaced = set(good) | unusable | (_EITHER if is_clearance_given or _EITHER & {*good} else set())
        from_entry = {key: value for key, value in entry.bearing.items() if key not in replaced}
        good = from_entry | good
    elif "name" in good:
        lacking: Errors = []
        _find_missing(set(good) | unusable, lacking)
        if lacking:
            absent = [each.key.partition(".")[2] for each in lacking]
            cause = catalogue.nearest(good["name"], {*absent})
            if read(good["name"]) is None:
                cause += f" A bearing of your own may have a name, but needs {', '.join(absent)}, too"
            errors.append(FileErrorDetail("bearing.name", "is not in the catalogue", good["name"], cause=cause))
        label = printable(good["name"]) or label
    if entry is not None or "name" not in {*good, *unusable}:
        _find_missing(set(good) | unusable, errors)
    materials = {side: material(f"bearing.{side}", good.get(side), errors) for side in MATERIALS}
    needed = (key.field for key in (*required_of(BallBearing), CLEARANCE))
    fields: dict[str, Any] = dict.fromkeys(needed, nan) | si(BEARING, good)
    fields |= materials
    fields["outline"] = _outline(given.printed)
    fields |= {"kind": BearingKind(good.get("kind", BearingKind.ANGULAR_CONTACT)), "name": label}
    bearing, wrong = _made(fields, good)
    for error in wrong:
        key = error.key.partition(".")[2]
        note = f"from the catalogue, {entry.name}" if entry is not None and key in from_entry else ""
        note = "from the raceway diameters" if key in of_raceways else note
        errors.append(FileErrorDetail(**{**vars(error), "note": note}))
    return given._replace(bearing=bearing) if len(errors) == before else given


def designated(given: dict[str, Any], unusable: Iterable[str] = ()) -> dict[str, Any]:
    """What a file gives in [bearing], with what ISO 15 and a designation that the catalogue does not hold add to it.

    Kind, angle and material only where numbers of the model are lacking: a bearing of one's own may have any name.
    """
    told = designation_of(given)
    added: dict[str, Any] = {}
    if told is not None and not told.is_refused:
        lacking: Errors = []
        of_radius = {radius for name, radii in COEFFICIENTS.items() if name in given for radius in radii}
        _find_missing({*given, *unusable, *of_radius}, lacking)
        added = {key: value for key, value in told.given.items() if lacking or key in _OUTSIDE}
        if _EITHER & {*given, *unusable}:
            added.pop("free_contact_angle_deg", None)
    size = [(added | given).get(key.name) for key in DIAMETERS]
    if all(isinstance(each, int | float) for each in size) and (width := iso15.width(*size)) is not None:
        added = {"width_mm": width} | added
    return {key: value for key, value in added.items() if key not in unusable} | given


def _coefficients(good: dict[str, Any], unusable: set[str], errors: Errors) -> dict[str, Any]:
    """The groove radius coefficient of each radius that a file gives by one, taken out of its values."""
    of_radius: dict[str, Any] = {}
    for name in sorted(COEFFICIENTS, key=lambda each: len(COEFFICIENTS[each])):  # that of one groove goes first
        radii = COEFFICIENTS[name]
        if name in unusable:
            unusable |= {radius for radius in radii if radius not in good}
        if name not in good:
            continue
        value = good.pop(name)
        if all(radius in good for radius in radii):
            cause = f"Keep one: {' and '.join(radii)} follow from it and the ball diameter"
            shown = None if isinstance(value, np.ndarray) else value
            errors.append(FileErrorDetail(f"bearing.{name}", f"is given together with {radii[0]}", shown, cause=cause))
        of_radius |= {radius: value for radius in radii if radius not in good and radius not in of_radius}
    return of_radius


def _raceways(good: dict[str, Any], unusable: set[str], of_entry: dict[str, Any], errors: Errors) -> dict[str, Any]:
    """Pitch diameter and clearance by the diameters of both raceways, which are taken out of a file's values."""
    given = {key.name: good.pop(key.name) for key in RACEWAYS if key.name in good}
    named = [key.name for key in RACEWAYS if key.name in given or key.name in unusable]
    if not named:
        return {}
    follow = ("pitch_diameter_mm", "diametral_clearance_mm")
    for name in (*follow, "free_contact_angle_deg"):
        if name in good:
            cause = "Keep one: pitch diameter, clearance and free contact angle follow from the raceway diameters"
            errors.append(FileErrorDetail(f"bearing.{name}", f"is given together with {named[0]}", cause=cause))
    if len(named) == 1:
        other = next(key.name for key in RACEWAYS if key.name not in named)
        cause = f"Both raceway diameters make the clearance; without {named[0]}, give {' and '.join(follow)}"
        errors.append(FileErrorDetail(f"bearing.{other}", "missing", cause=cause))
    lengths = [(of_entry | good).get(key) for key in ("ball_diameter_mm", *COEFFICIENTS["groove_radius_coefficient"])]
    if len(given) < 2 or None in lengths or any(name in good for name in follow):
        unusable |= set(follow)  # one mistake
        return {}
    (bottom, outer), (ball, radius, other_radius) = given.values(), lengths
    return dict(zip(follow, pitch_and_clearance(bottom, outer, ball, radius, other_radius), strict=True))


def entry_of(bearing: BallBearing) -> catalogue.CatalogueEntry | None:
    """The catalogue's entry of a bearing's name, whether or not its numbers were changed."""
    return catalogue.find(bearing.name.removesuffix(MODIFIED))


def label_of(entry: catalogue.CatalogueEntry, given: dict[str, Any]) -> str:
    """What a bearing is called of which a file gives an entry's name and these keys with it."""
    return f"{entry.name}{MODIFIED}" if changed_keys(entry, given) else entry.name


def changed_keys(entry: catalogue.CatalogueEntry, given: dict[str, Any]) -> set[str]:
    """Which of the keys that a file gives with an entry's name have another value than the entry."""
    numbers = {key: value for key, value in given.items() if key != "name"}
    return {key for key, each in numbers.items() if isinstance(each, np.ndarray) or each != entry.bearing.get(key)}


def kept(entry: catalogue.CatalogueEntry, changed: set[str]) -> dict[str, float]:
    """What the catalogue prints of an entry besides the model's lengths, in spite of what was changed."""
    lost: tuple[Key, ...] = RATINGS if changed else ()
    lost += SHOULDERS if changed - set(MATERIALS) else ()
    return {key.name: entry.dimensions[key.name] for key in PRINTED if key.name in entry.dimensions and key not in lost}


def _outline(printed: Mapping[str, Any]) -> Outline | None:
    printed_si = {key.field: key.si(printed[key.name]) for key in PRINTED if key.name in printed}
    known = {name: value for name, value in printed_si.items() if name in vars(Outline())}
    return Outline(**known) if known else None


def _find_missing(present: set[str], errors: Errors) -> None:
    """Keys that a bearing needs, from the file or its catalogue entry."""
    for key in required_of(BallBearing):
        if key.name not in present and key != FREE_ANGLE:
            cause = "A whole number" if key.name == "ball_count" else f"A number in {printed_unit(key.unit)}"
            errors.append(FileErrorDetail(f"bearing.{key.name}", "missing", cause=cause))
    for name in MATERIALS:
        if name not in present:
            cause = "'steel', 'silicon nitride', or a table"
            errors.append(FileErrorDetail(f"bearing.{name}", "missing", cause=cause))
    if not present & {"free_contact_angle_deg", "diametral_clearance_mm"}:
        errors.append(
            FileErrorDetail("bearing.free_contact_angle_deg", "missing", cause="Or give diametral_clearance_mm")
        )


def is_in_radians(kind: BearingKind, angle: float) -> bool:
    """Whether this is likely an angle of an angular-contact bearing in radians, given in degrees."""
    return kind is BearingKind.ANGULAR_CONTACT and 0.0 < angle <= FREE_ANGLE_MAX


def _made(fields: dict[str, Any], good: dict[str, Any]) -> tuple[BallBearing | None, Errors]:
    """The bearing of these fields in SI, or what is wrong with it."""
    angle, clearance = fields["free_contact_angle"], fields["diametral_clearance"]
    has_angle, has_clearance = "free_contact_angle_deg" in good, "diametral_clearance_mm" in good
    has_play, is_arched = "axial_clearance_mm" in good, fields["kind"] is BearingKind.FOUR_POINT
    by_clearance = has_clearance and (is_arched or not has_angle)  # of arched rings it is refused
    left_out = "free_contact_angle" if by_clearance else "diametral_clearance"
    fields = {name: value for name, value in fields.items() if name != left_out}
    make: Callable[..., BallBearing] = BallBearing.from_diametral_clearance if by_clearance else BallBearing
    if has_play and not by_clearance:
        make = BallBearing.from_axial_clearance
    fields = fields if has_play else {name: value for name, value in fields.items() if name != "axial_clearance"}
    try:
        bearing = make(**fields)
    except SceneError as error:
        return None, list(map(translate, judged(error.errors)))
    wrong: Errors = []
    if np.ndim(angle) or np.ndim(clearance):
        return bearing, wrong  # of a study, which varies one of the two alone
    if has_angle and is_in_radians(bearing.kind, angle / deg):
        given = good["free_contact_angle_deg"]
        cause = (
            f"Given in radians? {given:.6g} rad = {given / deg:.5g} deg. "
            "If so small an angle is meant, give diametral_clearance_mm instead"
        )
        problem = "is not an angle of an angular-contact bearing"
        wrong.append(FileErrorDetail("bearing.free_contact_angle_deg", problem, given, "deg", cause=cause))
    elif has_angle and has_clearance and abs(bearing.diametral_clearance - clearance) > AGREEMENT * abs(clearance):
        implied = float(free_angle_from_clearance(clearance, bearing.groove_centre_distance)) / deg
        meant = f"this clearance makes {implied:.6g} deg" if implied == implied else "no angle has this clearance"
        problem = (
            f"does not agree with free_contact_angle_deg = {angle / deg:.6g}: that angle makes "
            f"{float(bearing.diametral_clearance) / mm:.6g} mm, {meant}"
        )
        cause = "One follows from the other: keep only one, or correct one"
        given = good["diametral_clearance_mm"]
        wrong.append(FileErrorDetail("bearing.diametral_clearance_mm", problem, given, "mm", cause=cause))
    return bearing, wrong
