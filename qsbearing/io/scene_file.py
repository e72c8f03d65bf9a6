"""A scene file becomes a Scene: its tables checked, every error of all of them reported at once."""

from __future__ import annotations

import os
from math import nan
from pathlib import Path
from typing import Any

import numpy as np

from qsbearing.effects import BallEffect, GyroscopicMoment, MomentShares, RingEffect, types_in
from qsbearing.effects.orbit_radius import OrbitRadius
from qsbearing.io import catalogue
from qsbearing.io.effect_tables import ball_deviations, find_unused_expansion, ring_effect
from qsbearing.io.file_errors import FileErrorDetail, SceneFileError, translate
from qsbearing.io.read_toml import read_toml
from qsbearing.io.readings_table import asked_readings, errors_in_scene
from qsbearing.io.spectrum_table import scene_of_spectrum
from qsbearing.io.table_checks import (
    Errors,
    checked,
    choice_fields,
    did_you_mean,
    judged,
    material,
    number_list,
    si,
    table_model,
)
from qsbearing.io.unknown_key import near, suggest
from qsbearing.scene.bearing import BallBearing, BearingKind, free_angle_from_clearance
from qsbearing.scene.bearing_errors import FREE_ANGLE_MAX
from qsbearing.scene.keys import (
    BALL_DEVIATIONS,
    BEARING,
    EFFECT_SECTIONS,
    EFFECT_TABLES,
    EFFECTS,
    MATERIALS,
    OPERATION,
    PRELOAD,
    READING_SECTIONS,
    SECTIONS,
    SET_SECTIONS,
)
from qsbearing.scene.operation import CHANNELS, Operation
from qsbearing.scene.preload import Preload, beside_preload
from qsbearing.scene.scene import CHOICES, Scene, effect_errors
from qsbearing.units import deg, mm
from qsbearing.validation import SceneError, printable

BALL_EFFECTS: dict[str, Any] = types_in("ball_effects")
STUDY_TABLES = ("vary", "study")
"""What a study file has beside the tables of a scene."""
SETS_ARE_READ_BY = "Of a set of rows on one shaft, which `qsbearing run`, `sweep` and `qs.load_set` read"
AUTO = "auto"
"""In place of the table of effects: they are chosen to a tolerance."""
DEFAULT_TOLERANCE = 0.01
MODIFIED = ", modified"
"""After the name of a catalogue entry of which a scene changes some number."""
AGREEMENT = 0.005
"""A free contact angle and a diametral clearance given together may differ by this part of the clearance (chosen:
tables print both to three or four digits)."""


_BEARING = table_model("bearing", BEARING, {"name": (str | None, None)} | choice_fields("kind"))
_OPERATION = table_model("operation", OPERATION, {})
_PRELOAD = table_model("preload", PRELOAD, {})
_EFFECTS = table_model(
    "effects",
    EFFECTS,
    {"ball": (list[str], []), BALL_DEVIATIONS.name: number_list()} | choice_fields("moment_shares", *CHOICES),
)


def load_scene(source: str | os.PathLike[str]) -> Scene:
    """The scene of a TOML file, or a built-in example by its name.

    Args:
        source: a path, or the name of a catalogue entry, such as "b218". A file of that very name goes first.

    Raises:
        SceneFileError: everything that is wrong with the file, at once.
    """
    return scene_of(*document_of(source))


def document_of(source: str | os.PathLike[str]) -> tuple[dict[str, Any], str, str]:
    """The tables of a file or of a built-in example, what to call it in errors, and the label of its bearing.

    Raises:
        SceneFileError: it cannot be read.
    """
    path = Path(source)
    if isinstance(source, str) and path.suffix == "" and source in (path.name, "") and not _is_file(path):
        entry = catalogue.find(source)
        if entry is None:
            cause = f"{catalogue.nearest(source)} A scene of your own is a file, such as {source or 'my'}.toml"
            error = FileErrorDetail("", "neither a file nor a bearing of the catalogue", cause=cause)
            raise SceneFileError(repr(source), [error])
        return {"bearing": {"name": entry.name}, **entry.example}, entry.name, ""
    return read_toml(path), str(source), printable(path.stem)


def scene_of(document: dict[str, Any], file: str, label: str = "") -> Scene:
    """The scene of a parsed file.

    Args:
        file: what to call the file in errors.
        label: name of the bearing where the catalogue gives none.

    Raises:
        SceneFileError: everything that is wrong with it.
    """
    if "spectrum" in document:
        return scene_of_spectrum(document, file, label, scene_of)
    errors: Errors = []
    _find_unknown_tables(document, errors)
    bearing = bearing_of(document, label, errors)
    operation = operation_of(document, errors)
    preload = preload_of(document, operation, errors)
    effects = effects_of(document, errors)
    find_unused_expansion(document, errors)
    readings = asked_readings(document, errors)
    if errors or bearing is None or operation is None:
        raise SceneFileError(file, errors)
    try:
        scene = Scene(bearing, operation, preload=preload, **effects, readings=readings)
    except SceneError as error:
        raise SceneFileError(file, map(translate, error.errors)) from None
    wrong = errors_in_scene(scene)
    if wrong:
        raise SceneFileError(file, wrong)
    return scene


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # a name too long, or with a null character
        return False


# Structure: known tables and keys, values of the right kind -----------------------------------------------------------


def _find_unknown_tables(document: dict[str, Any], errors: Errors) -> None:
    for name, value in list(document.items()):
        if name in (*SECTIONS, "tolerance"):
            continue
        if isinstance(value, dict):
            meant = near(name.lower(), SECTIONS, 0.5)
            if name in EFFECT_SECTIONS:
                meant = f"effects.{name}"
            if name in READING_SECTIONS:
                meant = f"readings.{name}"
            known = "A scene has [bearing], [operation], [effects] and [readings]"
            cause = f"Did you mean [{meant}]?" if meant else known
            if name in STUDY_TABLES:
                meant, cause = "", "Of a study, which `qsbearing sweep` solves"
            if name in SET_SECTIONS:
                meant, cause = "", SETS_ARE_READ_BY
            errors.append(FileErrorDetail(f"[{name}]", "unknown table", cause=cause))
            if meant:
                document.setdefault(meant, None)  # one mistake: the table that is meant is not missing as well
        else:
            cause = SETS_ARE_READ_BY if name in SET_SECTIONS else suggest(name, "", value).sentence
            errors.append(FileErrorDetail(name, "unknown key", cause=cause))


# Bearing --------------------------------------------------------------------------------------------------------------


def bearing_of(document: dict[str, Any], label: str, errors: Errors) -> BallBearing | None:
    """The bearing of a file's table [bearing]; None where errors were found and added."""
    if "bearing" not in document:
        cause = f'At the least name = "{catalogue.entries()[0].name}"'
        errors.append(FileErrorDetail("[bearing]", "missing", cause=cause))
    table = document.get("bearing")
    if table is None:
        return None
    before = len(errors)
    numbers = {key: value for key, value in table.items() if key not in MATERIALS} if isinstance(table, dict) else table
    good, unusable = checked(_BEARING, "bearing", numbers, errors)
    if not isinstance(table, dict):
        return None
    good |= {side: table[side] for side in MATERIALS if side in table}
    entry = catalogue.find(good["name"]) if "name" in good else None
    from_entry: dict[str, Any] = {}
    if entry is not None:
        label = f"{entry.name}{MODIFIED}" if set(good) - {"name"} else entry.name
        either = {"free_contact_angle_deg", "diametral_clearance_mm"}  # one given replaces the entry's other
        replaced = set(good) | unusable | (either if either & set(table) else set())
        from_entry = {key: value for key, value in entry.bearing.items() if key not in replaced}
        good = from_entry | good
    elif "name" in good:
        cause = (
            f"{catalogue.nearest(good['name'])} For a bearing of your own leave the name out and give every other key"
        )
        errors.append(FileErrorDetail("bearing.name", "is not in the catalogue", good["name"], cause=cause))
    if entry is not None or "name" not in table:
        _find_missing(set(good) | unusable, errors)
    materials = {side: material(f"bearing.{side}", good.get(side), errors) for side in MATERIALS}
    fields: dict[str, Any] = dict.fromkeys((key.field for key in BEARING), nan) | si(BEARING, good)
    fields |= materials
    fields |= {"kind": BearingKind(good.get("kind", BearingKind.ANGULAR_CONTACT)), "name": label}
    bearing, wrong = _made(fields, good)
    for error in wrong:
        key = error.key.partition(".")[2]
        note = f"from the catalogue, {entry.name}" if entry is not None and key in from_entry else ""
        errors.append(FileErrorDetail(**{**vars(error), "note": note}))
    return bearing if len(errors) == before else None


def _find_missing(present: set[str], errors: Errors) -> None:
    """Keys that a bearing needs, from the file or its catalogue entry."""
    for name in (*(key.name for key in BEARING[:5]), *MATERIALS):
        if name not in present:
            cause = "'steel', 'silicon nitride', or a table" if name in MATERIALS else ""
            errors.append(FileErrorDetail(f"bearing.{name}", "missing", cause=cause))
    if not present & {"free_contact_angle_deg", "diametral_clearance_mm"}:
        errors.append(
            FileErrorDetail("bearing.free_contact_angle_deg", "missing", cause="Or give diametral_clearance_mm")
        )


def _made(fields: dict[str, Any], good: dict[str, Any]) -> tuple[BallBearing | None, Errors]:
    """The bearing of these fields in SI, or what is wrong with it."""
    angle, clearance = fields["free_contact_angle"], fields["diametral_clearance"]
    has_angle, has_clearance = "free_contact_angle_deg" in good, "diametral_clearance_mm" in good
    unwanted = "free_contact_angle" if has_clearance and not has_angle else "diametral_clearance"
    fields = {name: value for name, value in fields.items() if name != unwanted}
    make = BallBearing.from_diametral_clearance if unwanted == "free_contact_angle" else BallBearing
    try:
        bearing = make(**fields)
    except SceneError as error:
        return None, list(map(translate, judged(error)))
    wrong: Errors = []
    if np.ndim(angle) or np.ndim(clearance):
        return bearing, wrong  # of a study, which varies one of the two alone
    if has_angle and bearing.kind is BearingKind.ANGULAR_CONTACT and 0.0 < angle / deg <= FREE_ANGLE_MAX:
        given = good["free_contact_angle_deg"]
        cause = (
            f"Given in radians? {given:.6g} rad = {given / deg:.5g} deg. "
            "If so small an angle is meant, give diametral_clearance_mm instead"
        )
        problem = "is no angle of an angular-contact bearing"
        wrong.append(FileErrorDetail("bearing.free_contact_angle_deg", problem, given, "deg", cause=cause))
    elif has_angle and has_clearance and abs(bearing.diametral_clearance - clearance) > AGREEMENT * abs(clearance):
        implied = float(free_angle_from_clearance(clearance, bearing.groove_centre_distance)) / deg
        meant = f"this clearance makes {implied:.6g} deg" if implied == implied else "no angle has this clearance"
        problem = (
            f"does not agree with free_contact_angle_deg = {angle / deg:.6g}: that angle makes "
            f"{float(bearing.diametral_clearance) / mm:.6g} mm, {meant}"
        )
        cause = "Either defines the other: keep one, or correct one"
        given = good["diametral_clearance_mm"]
        wrong.append(FileErrorDetail("bearing.diametral_clearance_mm", problem, given, "mm", cause=cause))
    return bearing, wrong


# Operation and effects ------------------------------------------------------------------------------------------------


def operation_of(document: dict[str, Any], errors: Errors) -> Operation | None:
    """The operation of a file's table [operation]; likewise."""
    if "operation" not in document:
        needed = "At the least one load or displacement, such as axial_load_N = 1000; speed_rpm if it turns"
        errors.append(FileErrorDetail("[operation]", "missing", cause=needed))
    table = document.get("operation")
    if table is None:
        return None
    good, unusable = checked(_OPERATION, "operation", table, errors)
    # A number that cannot be used still says that its channel is given: NaN stands for it.
    fields = si(OPERATION, dict.fromkeys(unusable, nan) | good)
    if (
        isinstance(table, dict)
        and "preload" not in document
        and not any(channel.load in fields or channel.displacement in fields for channel in CHANNELS)
    ):
        cause = "Give a load or a displacement, such as axial_load_N = 1000; if none is meant, axial_load_N = 0"
        errors.append(FileErrorDetail("operation", "neither a load nor a displacement is given", cause=cause))
    try:
        return Operation(**fields)
    except SceneError as error:
        errors += map(translate, judged(error))
        return None


def preload_of(document: dict[str, Any], operation: Operation | None, errors: Errors) -> Preload | None:
    """The preload of a file's table [preload], where it has one; with an operation given, judged beside it."""
    if document.get("preload") is None:
        return None
    good, unusable = checked(_PRELOAD, "preload", document["preload"], errors)
    if operation is not None:
        errors += map(translate, beside_preload(operation))
    if not isinstance(document["preload"], dict):
        return None
    try:
        return Preload(**si(PRELOAD, dict.fromkeys(unusable, nan) | good))
    except SceneError as error:
        errors += map(translate, judged(error))
        return None


def effects_of(document: dict[str, Any], errors: Errors) -> dict[str, Any]:
    """The fields of `Scene` that say what is asked for."""
    table = document.get("effects")
    if table == AUTO:
        return {"tolerance": _tolerance(document.get("tolerance", DEFAULT_TOLERANCE), errors)}
    if "tolerance" in document:
        cause = 'Write effects = "auto" beside it, at the top of the file; or leave it out'
        errors.append(FileErrorDetail("tolerance", "is given, but the effects are not chosen by it", cause=cause))
    if isinstance(table, str):
        cause = 'effects = "auto" has them chosen; or write [effects], keys below it'
        errors.append(FileErrorDetail("effects", "is not a table", table, cause=cause))
        return {}
    table = {} if table is None else table
    within = {name: table[name] for name in EFFECT_TABLES if name in table} if isinstance(table, dict) else {}
    if within:
        table = {name: value for name, value in table.items() if name not in within}
    good, unusable = checked(_EFFECTS, "effects", table, errors)
    names, shares = good.get("ball", []), good.pop("moment_shares", None)
    friction = good.pop("friction_coefficient", None)
    for name in dict.fromkeys(name for name in names if name not in BALL_EFFECTS):
        cause = did_you_mean(name, list(BALL_EFFECTS)) or f"One of {', '.join(BALL_EFFECTS)}"
        errors.append(FileErrorDetail("effects.ball", "is not a ball effect", name, cause=cause))
        unusable.add("ball")
    made: dict[str, BallEffect] = {name: BALL_EFFECTS[name]() for name in names if name in BALL_EFFECTS}
    made[GyroscopicMoment.name] = _gyroscopic_moment(shares, friction, errors)
    effects = tuple(made[name] for name in names if name in made)
    if not unusable & {"ball", "raceway_control"}:
        asked = good.get("raceway_control"), good.get("orbit_radius", OrbitRadius.PITCH_CIRCLE)
        errors += map(translate, effect_errors(effects, *asked))
    if "ball" not in unusable and GyroscopicMoment.name not in names:
        cause = "Leave it out, or ask for gyroscopic_moment in ball"
        for name, value, verb in (("moment_shares", shares, "share"), ("friction_coefficient", friction, "carry")):
            if value is not None:
                problem = f"is given, but no gyroscopic moment is there to {verb}"
                shown = value if isinstance(value, float) else str(value)
                errors.append(FileErrorDetail(f"effects.{name}", problem, shown, cause=cause))
    made_of_tables: list[RingEffect | None] = [ring_effect(name, within[name], errors) for name in within]
    made_of_tables.append(ball_deviations(good.pop(BALL_DEVIATIONS.name, None), errors))
    ring_effects = tuple(effect for effect in made_of_tables if effect is not None)
    return {"ball_effects": effects, "ring_effects": ring_effects} | {
        name: good[name] for name in CHOICES if name in good
    }


def _tolerance(value: Any, errors: Errors) -> float | None:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0.0 < value <= 1.0:
        cause = "The relative error that is allowed, above 0 and at most 1: 0.01 is one per cent"
        errors.append(FileErrorDetail("tolerance", "is no relative error", value, cause=cause))
        return None
    return float(value)


def _gyroscopic_moment(shares: MomentShares | None, friction: float | None, errors: Errors) -> GyroscopicMoment:
    shares = shares or MomentShares.CONTROLLING
    try:
        return GyroscopicMoment(shares, friction)
    except SceneError as error:
        errors += map(translate, error.errors)
        return GyroscopicMoment(shares)
