"""TOML in, Scene out: what a scene file may say, and every fault of one at once."""

from __future__ import annotations

import difflib
import os
import tomllib
from decimal import Decimal
from math import isnan, nan, radians, sin
from pathlib import Path
from typing import Annotated, Any, NamedTuple

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag, ValidationError

from qsbearing import catalogue
from qsbearing.bearing import FREE_ANGLE_MAX, BallBearing, BearingKind, free_angle_from_clearance
from qsbearing.effects import BallEffect, CentrifugalForce, GyroscopicMoment, MomentShares
from qsbearing.faults import SceneError
from qsbearing.file_fault import FileFault, SceneFileError, translate
from qsbearing.hertz import HertzForm
from qsbearing.material import BY_NAME, Material
from qsbearing.operation import CHANNELS, Operation
from qsbearing.raceway_control import RacewayControl
from qsbearing.scene import HertzAngle, Scene, TiltLever, effect_faults
from qsbearing.scene_keys import BEARING, MATERIAL, MATERIAL_KEYS, OPERATION, SECTIONS
from qsbearing.scene_keys import find as find_key
from qsbearing.units import deg, mm

LARGEST_FILE = 1_000_000
"""Bytes; a scene takes about a thousand, and what is far longer is something else."""

_SCENE_HAS = "A scene has [bearing], [operation] and [effects]"
BALL_EFFECTS = (CentrifugalForce.name, GyroscopicMoment.name)


class _Table(BaseModel):
    # Strict: true is no number, and neither is "22.225". A word of a choice becomes the choice.
    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)


class _Material(_Table):
    elastic_modulus_GPa: float | None = None
    poisson_ratio: float | None = None
    density_kg_m3: float | None = None
    thermal_expansion_per_K: float | None = None


_NamedOrTable = Annotated[
    Annotated[str, Tag("name")] | Annotated[_Material, Tag("table")],
    Discriminator(lambda value: "table" if isinstance(value, dict | _Material) else "name"),
]


class _Bearing(_Table):
    name: str | None = None
    kind: BearingKind = Field(BearingKind.ANGULAR_CONTACT, strict=False)
    ball_count: float | None = None
    ball_diameter_mm: float | None = None
    pitch_diameter_mm: float | None = None
    inner_groove_radius_mm: float | None = None
    outer_groove_radius_mm: float | None = None
    free_contact_angle_deg: float | None = None
    diametral_clearance_mm: float | None = None
    ball_material: _NamedOrTable | None = None
    ring_material: _NamedOrTable | None = None


class _Operation(_Table):
    speed_rpm: float | None = None
    outer_speed_rpm: float | None = None
    axial_load_N: float | None = None
    axial_displacement_um: float | None = None
    radial_load_y_N: float | None = None
    radial_displacement_y_um: float | None = None
    radial_load_z_N: float | None = None
    radial_displacement_z_um: float | None = None
    moment_y_Nm: float | None = None
    tilt_y_mrad: float | None = None
    moment_z_Nm: float | None = None
    tilt_z_mrad: float | None = None
    first_ball_azimuth_deg: float | None = None


class _Effects(_Table):
    ball: list[str] = Field(default_factory=list)
    raceway_control: RacewayControl | None = Field(None, strict=False)
    moment_shares: MomentShares | None = Field(None, strict=False)
    hertz_angle: HertzAngle = Field(HertzAngle.FREE, strict=False)
    hertz_form: HertzForm = Field(HertzForm.EXACT, strict=False)
    tilt_lever: TiltLever = Field(TiltLever.GROOVE_CENTRE, strict=False)


_CHOICES: dict[str, list[str]] = {
    "kind": list(BearingKind),
    "raceway_control": list(RacewayControl),
    "moment_shares": list(MomentShares),
    "hertz_angle": list(HertzAngle),
    "hertz_form": list(HertzForm),
    "tilt_lever": list(TiltLever),
}


class _Written(float):
    """A number together with the digits that the file spends on it."""

    text: str

    def __new__(cls, text: str) -> _Written:
        number = super().__new__(cls, text)
        number.text = text
        return number


class _Checked(NamedTuple):
    """One table after the structural check."""

    good: dict[str, Any]
    """Keys with a usable value, and the keys' defaults."""
    bad: set[str]
    """Keys that are there with a value of the wrong kind; a material's as `ball_material.density_kg_m3`."""


def load_scene(source: str | os.PathLike[str]) -> Scene:
    """The scene of a TOML file, or a built-in example by its name.

    Args:
        source: a path, or the name of a catalogue entry, such as "b218". A file of that very name goes first.

    Raises:
        SceneFileError: everything that is wrong with the file, at once.
    """
    path = Path(source)
    if isinstance(source, str) and path.suffix == "" and source in (path.name, "") and not _is_file(path):
        try:
            entry = catalogue.find(str(source))
        except KeyError:
            cause = f"{catalogue.nearest(str(source))} A scene of your own is a file, such as {source or 'my'}.toml"
            problem = "neither a file nor a bearing of the catalogue"
            raise SceneFileError(repr(source), [FileFault("", problem, cause=cause)]) from None
        return scene_of({"bearing": {"name": entry.name}, **entry.example}, entry.name)
    return scene_of(_read(path), str(source), path.stem)


def scene_of(document: dict[str, Any], file: str, label: str = "") -> Scene:
    """The scene of a parsed file.

    Args:
        file: what to call the file in faults.
        label: name of the bearing where the catalogue gives none.

    Raises:
        SceneFileError: everything that is wrong with it.
    """
    faults = _unknown_tables(document)
    bearing = _bearing(document, label, faults)
    operation = _operation(document, faults)
    effects = _effects(document, faults)
    if faults or bearing is None or operation is None or effects is None:
        raise SceneFileError(file, faults)
    try:
        return Scene(bearing, operation, **effects)
    except SceneError as error:
        raise SceneFileError(file, map(translate, error.faults)) from None


# Reading ------------------------------------------------------------------------------------------------------------


def _read(path: Path) -> dict[str, Any]:
    def refuse(problem: str, cause: str = "") -> SceneFileError:
        return SceneFileError(str(path), [FileFault("", problem, cause=cause)])

    try:
        with path.open("rb") as file:
            data = file.read(LARGEST_FILE + 1)
    except FileNotFoundError:
        cause = f"The catalogue's {path.stem} is run by name, without .toml" if _is_entry(path.stem) else ""
        raise refuse("no such file", cause) from None
    except IsADirectoryError:
        raise refuse("is a folder, not a scene file") from None
    except (OSError, ValueError) as error:  # ValueError: a null character in the name
        raise refuse(f"cannot be read: {getattr(error, 'strerror', None) or error}") from None
    if len(data) > LARGEST_FILE:
        raise refuse("is longer than a megabyte: this is no scene file")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        cause = "Saved as UTF-16? Save it again as UTF-8" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else ""
        line = data[: error.start].count(b"\n") + 1
        raise refuse(f"is not UTF-8 text (byte {error.start + 1}, line {line})", cause) from None
    if not text.strip():
        raise refuse("is empty", "`qsbearing init` prints a scene to start from")
    try:
        return tomllib.loads(text, parse_float=_Written)
    except (ValueError, RecursionError) as error:
        # Beside syntax, numbers of thousands of digits and endless nesting end here.
        raise refuse(f"is not TOML: {str(error) or 'nested too deeply'}", _line_of(text, str(error))) from None


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # a name too long, or with a null character
        return False


def _is_entry(name: str) -> bool:
    try:
        catalogue.find(name)
    except KeyError:
        return False
    return True


def _line_of(text: str, message: str) -> str:
    """The line that a TOML message points at."""
    _, found, rest = message.partition("(at line ")
    number = rest.partition(",")[0]
    lines = text.splitlines()
    if not found or not number.isdecimal() or int(number) > len(lines):
        return ""
    return f"line {number}: {lines[int(number) - 1].strip()[:80]}"


# Structure ----------------------------------------------------------------------------------------------------------


def _unknown_tables(document: dict[str, Any]) -> list[FileFault]:
    faults = []
    for name, value in document.items():
        if name in SECTIONS:
            continue
        if isinstance(value, dict):
            shown = f"[{name}]"
            near = difflib.get_close_matches(name.lower(), SECTIONS, n=1, cutoff=0.5)
            cause = f"Did you mean [{near[0]}]?" if near else _SCENE_HAS
        else:
            homes = [section for section, keys in SECTIONS.items() if name in keys]
            shown = name
            cause = f"It belongs under [{homes[0]}]" if homes else _nearest_key(name, "")
        faults.append(FileFault(shown, "unknown", cause=cause))
    return faults


def _checked(model: type[BaseModel], section: str, table: Any, faults: list[FileFault]) -> _Checked:
    """The table's usable values; what is wrong with its structure is added to the faults."""
    if not isinstance(table, dict):
        faults.append(FileFault(section, "is not a table", table, cause=f"Write it as [{section}], keys below it"))
        return _Checked({}, set())
    bad: set[str] = set()
    rest = {key: dict(value) if isinstance(value, dict) else value for key, value in table.items()}
    try:
        return _Checked(dict(model.model_validate(table)), bad)
    except ValidationError as error:
        for detail in error.errors(include_url=False):
            where = [str(part) for part in detail["loc"]]
            if where[0].endswith("_material"):
                del where[1:2]  # which of the two forms pydantic took it for
            faults.append(_structural(section, where, detail["type"], detail.get("input")))
            if len(where) == 2 and where[0].endswith("_material"):
                rest[where[0]].pop(where[1], None)
            else:
                rest.pop(where[0], None)
            if detail["type"] != "extra_forbidden":
                bad.add(".".join(where) if where[0].endswith("_material") else where[0])
    return _Checked(dict(model.model_validate(rest)), bad)


def _structural(section: str, where: list[str], kind: str, value: Any) -> FileFault:
    path, name = ".".join([section, *where]), where[-1]
    in_material = len(where) == 2 and where[0].endswith("_material")
    if kind == "extra_forbidden":
        return FileFault(path, "unknown key", cause=_nearest_key(name, "material" if in_material else section))
    if name in _CHOICES:
        cause = _did_you_mean(value, _CHOICES[name]) or f"One of {', '.join(_CHOICES[name])}"
        return FileFault(path, "is none of the choices", value, cause=cause)
    if where[0] == "ball":
        cause = 'Write ball = ["centrifugal_force", "gyroscopic_moment"], or one of the two'
        return FileFault(f"{section}.ball", "is not a list of ball effects", value, cause=cause)
    key = find_key(_python_path(path))
    unit = key.unit if key else ""
    if kind == "finite_number":
        return FileFault(path, "is not a finite number", value, unit)
    if kind.startswith("float"):
        cause = f"A number in {unit}, without quotation marks" if unit else "A number, without quotation marks"
        return FileFault(path, "is not a number", value, unit, cause=cause)
    return FileFault(path, "is not a word in quotation marks", value)


def _python_path(path: str) -> str:
    section, _, name = path.rpartition(".")
    keys = MATERIAL if section.endswith("_material") else {"bearing": BEARING, "operation": OPERATION}.get(section, ())
    return f"{section}.{next((key.field for key in keys if key.name == name), name)}"


def _did_you_mean(value: Any, known: list[str]) -> str:
    if not isinstance(value, str):
        return ""
    similar = difflib.get_close_matches(value.lower().replace(" ", "_").replace("-", "_"), known, n=1, cutoff=0.5)
    return f"Did you mean {similar[0]}?" if similar else ""


def _nearest_key(name: str, section: str) -> str:
    """Where an unknown key belongs, or which known key it resembles, in its own table first."""
    tables = {**SECTIONS, "material": MATERIAL_KEYS}
    for other, keys in tables.items():
        if other != section and name in keys:
            home = "a material's table" if other == "material" else f"[{other}]"
            return f"It belongs under {home}"
    near = difflib.get_close_matches(name, tables.get(section, ()), n=1, cutoff=0.6)
    if near:
        return f"Did you mean {near[0]}?"
    # Without its unit a name resembles its key less than it should.
    stems = {key.field: key.name for key in (*BEARING, *OPERATION, *MATERIAL) if key.name in tables.get(section, ())}
    near = difflib.get_close_matches(name, stems, n=1, cutoff=0.6)
    if near:
        return f"Did you mean {stems[near[0]]}?"
    everywhere = {key: other for other, keys in tables.items() for key in keys}
    near = difflib.get_close_matches(name, everywhere, n=1, cutoff=0.7)
    if near:
        home = "a material's table" if everywhere[near[0]] == "material" else f"[{everywhere[near[0]]}]"
        return f"Did you mean {near[0]}, under {home}?"
    return (
        f"Known here: {', '.join(tables[section])}" if section else "A scene has [bearing], [operation] and [effects]"
    )


# Bearing ------------------------------------------------------------------------------------------------------------


def _bearing(document: dict[str, Any], label: str, faults: list[FileFault]) -> BallBearing | None:
    if "bearing" not in document:
        faults.append(FileFault("[bearing]", "missing", cause=f'At the least name = "{catalogue.entries()[0].name}"'))
        return None
    before = len(faults)
    good, bad = _checked(_Bearing, "bearing", document["bearing"], faults)
    written = document["bearing"] if isinstance(document["bearing"], dict) else {}
    entry = _entry(good.get("name"), faults)
    from_entry: set[str] = set()
    if entry is not None:
        own = {key: value for key, value in good.items() if key in written}
        theirs = {key: value for key, value in entry.bearing.items() if key not in own and key not in bad}
        if {"free_contact_angle_deg", "diametral_clearance_mm"} & set(written):
            theirs.pop("free_contact_angle_deg", None)
            theirs.pop("diametral_clearance_mm", None)
        from_entry = set(theirs)
        good = {**dict(_Bearing.model_validate(theirs)), **own}
        label = f"{entry.name}, modified" if set(own) - {"name"} else entry.name
    if isinstance(document["bearing"], dict) and (entry is not None or "name" not in written):
        _missing(good, bad, faults)
    values = {key.name: good.get(key.name) for key in BEARING}
    materials = {side: _material(side, good.get(side), bad, faults) for side in ("ball_material", "ring_material")}
    found = _physical(values, bad, materials, good, written, label)
    reported = {fault.key for fault in faults}
    for fault in found if isinstance(found, list) else []:
        if fault.key in reported:
            continue
        key = fault.key.partition(".")[2]
        note = f"from the catalogue, {entry.name}" if entry is not None and key in from_entry else ""
        faults.append(FileFault(**{**vars(fault), "note": note}))
    return found if isinstance(found, BallBearing) and len(faults) == before else None


def _entry(name: Any, faults: list[FileFault]) -> catalogue.Entry | None:
    if name is None:
        return None
    try:
        return catalogue.find(name)
    except KeyError:
        cause = f"{catalogue.nearest(name)} For a bearing of your own leave the name out and give every other key"
        faults.append(FileFault("bearing.name", "is not in the catalogue", name, cause=cause))
        return None


def _missing(good: dict[str, Any], bad: set[str], faults: list[FileFault]) -> None:
    """Keys that a bearing needs, from the file or its catalogue entry."""
    present = {key for key, value in good.items() if value is not None} | bad
    needed = [key.name for key in BEARING[:5]] + ["ball_material", "ring_material"]
    for key in needed:
        if key not in present:
            cause = "'steel', 'silicon nitride', or a table" if key.endswith("material") else ""
            faults.append(FileFault(f"bearing.{key}", "missing", cause=cause))
    if not present & {"free_contact_angle_deg", "diametral_clearance_mm"}:
        faults.append(FileFault("bearing.free_contact_angle_deg", "missing", cause="Or give diametral_clearance_mm"))


def _material(side: str, value: Any, bad: set[str], faults: list[FileFault]) -> Material:
    if isinstance(value, _Material):
        numbers: dict[str, Any] = {key.field: nan for key in MATERIAL[:3]}
        for key in MATERIAL[:3]:
            given = getattr(value, key.name)
            if given is not None:
                numbers[key.field] = given * key.size
            elif f"{side}.{key.name}" not in bad:
                faults.append(FileFault(f"bearing.{side}.{key.name}", "missing"))
        return Material(**numbers, thermal_expansion=value.thermal_expansion_per_K)
    if value is None:
        return Material(nan, nan, nan)
    if value.lower() in BY_NAME:
        return BY_NAME[value.lower()]
    cause = _did_you_mean(value, [name.replace(" ", "_") for name in BY_NAME]).replace("_", " ")
    cause = cause or f"One of {', '.join(BY_NAME)}, or a table with elastic_modulus_GPa, poisson_ratio, density_kg_m3"
    faults.append(FileFault(f"bearing.{side}", "is not a known material", value, cause=cause))
    return Material(nan, nan, nan)


def _physical(
    values: dict[str, float | None],
    bad: set[str],
    materials: dict[str, Material],
    good: dict[str, Any],
    written: dict[str, Any],
    label: str,
) -> BallBearing | list[FileFault]:
    """The bearing, or what is wrong with its numbers; a number that is not there is NaN and judged by nobody."""
    known = {key.name for key in BEARING if values[key.name] is not None}
    numbers = {
        key.field: nan if value is None else float(value) * key.size
        for key, value in ((key, values[key.name]) for key in BEARING)
    }
    angle, clearance = numbers.pop("free_contact_angle"), numbers.pop("diametral_clearance")
    fields: dict[str, Any] = {
        **numbers,
        **materials,
        "kind": good.get("kind", BearingKind.ANGULAR_CONTACT),
        "name": label,
    }
    faults: list[FileFault] = []
    bearing = None
    try:
        if "free_contact_angle_deg" in known or "diametral_clearance_mm" not in known:
            bearing = BallBearing(free_contact_angle=angle, **fields)
        else:
            bearing = BallBearing.from_diametral_clearance(diametral_clearance=clearance, **fields)
    except SceneError as error:
        faults += [translate(fault) for fault in error.faults if not _is_unknown(fault.field, known, materials)]
    if "free_contact_angle_deg" in known:
        faults += _angle_in_radians(values["free_contact_angle_deg"], fields["kind"])
        if "diametral_clearance_mm" in known and bearing is not None:
            faults += _disagreement(values, written)
    return bearing if bearing is not None and not faults else faults


def _is_unknown(field: str, known: set[str], materials: dict[str, Material]) -> bool:
    """Whether a fault is about a number that is missing or already known to be no number."""
    side, _, number = field.partition(".")[2].partition(".")
    if side in materials:
        return bool(isnan(getattr(materials[side], number)))
    return not any(key.field == side and key.name in known for key in BEARING)


def _angle_in_radians(angle_deg: float | None, kind: BearingKind) -> list[FileFault]:
    if angle_deg is None or kind is not BearingKind.ANGULAR_CONTACT or not 0.0 < angle_deg <= FREE_ANGLE_MAX:
        return []
    cause = (
        f"Given in radians? {angle_deg:.6g} rad = {angle_deg / deg:.5g} deg. "
        "If so small an angle is meant, give diametral_clearance_mm instead"
    )
    problem = "is no angle of an angular-contact bearing"
    return [FileFault("bearing.free_contact_angle_deg", problem, float(angle_deg), "deg", cause=cause)]


def _disagreement(values: dict[str, float | None], written: dict[str, Any]) -> list[FileFault]:
    """Whether free contact angle and diametral clearance, both given, say the same within their digits.

    Pd = 4 BD sin^2(alpha0/2) grows with BD and alpha0, so the ends of their ranges give the ends of its range.
    """
    names = ("inner_groove_radius_mm", "outer_groove_radius_mm", "ball_diameter_mm")
    inner, outer, ball, angle, clearance = (
        float(values[name] or 0.0) for name in (*names, "free_contact_angle_deg", "diametral_clearance_mm")
    )
    distance = inner + outer - ball
    distance_doubt = sum(_doubt(written.get(name)) for name in names)
    # A whole number of degrees is a nominal angle; a whole number of millimetres is as good as any other.
    angle_doubt = _doubt(written.get("free_contact_angle_deg"), whole=0.5)
    clearance_doubt = _doubt(written.get("diametral_clearance_mm"))
    low, middle, high = (
        4.0 * (distance + sign * distance_doubt) * sin(radians(max(angle + sign * angle_doubt, 0.0)) / 2.0) ** 2
        for sign in (-1.0, 0.0, 1.0)
    )
    rounding = 1e-12 * distance
    if low - clearance_doubt - rounding <= clearance <= high + clearance_doubt + rounding:
        return []
    implied = float(free_angle_from_clearance(clearance * mm, distance * mm)) / deg
    meant = f"this clearance makes {implied:.6g} deg" if implied == implied else "no angle has this clearance"
    problem = f"does not agree with free_contact_angle_deg = {angle:.6g}: that angle makes {middle:.6g} mm, {meant}"
    cause = "Either defines the other: keep one, or correct one"
    return [FileFault("bearing.diametral_clearance_mm", problem, clearance, "mm", cause=cause)]


def _doubt(number: Any, whole: float = 0.0) -> float:
    """Half of the last digit that the file gives; `whole` for an integer; none for a number not from the file."""
    if isinstance(number, _Written):
        exponent = Decimal(number.text.replace("_", "")).as_tuple().exponent
        return 0.5 * 10.0**exponent if isinstance(exponent, int) else 0.0
    return whole if isinstance(number, int) else 0.0


# Operation and effects ----------------------------------------------------------------------------------------------


def _operation(document: dict[str, Any], faults: list[FileFault]) -> Operation | None:
    if "operation" not in document:
        needed = "At the least one load or displacement, such as axial_load_N = 1000; speed_rpm if it turns"
        faults.append(FileFault("[operation]", "missing", cause=needed))
        return None
    before = len(faults)
    good, bad = _checked(_Operation, "operation", document["operation"], faults)
    # A number of the wrong kind still says that its channel is given: NaN keeps its place.
    present = {key.name: float(good[key.name]) for key in OPERATION if good.get(key.name) is not None}
    present |= dict.fromkeys(bad, nan)
    fields: dict[str, Any] = {key.field: present[key.name] * key.size for key in OPERATION if key.name in present}
    channels = {name for channel in CHANNELS for name in (channel.load, channel.displacement)}
    if isinstance(document["operation"], dict) and not channels & set(fields):
        cause = "Give a load or a displacement, such as axial_load_N = 1000; if none is meant, axial_load_N = 0"
        faults.append(FileFault("operation", "neither a load nor a displacement is given", cause=cause))
    try:
        operation = Operation(**fields)
    except SceneError as error:
        # What stood in for a bad value is reported already; what its channel does wrong beside it is not.
        stand_ins = {f"operation.{key}" for key in bad}
        translated = [translate(fault) for fault in error.faults]
        faults += [fault for fault in translated if fault.key not in stand_ins or fault.value is None]
        return None
    return operation if len(faults) == before else None


def _effects(document: dict[str, Any], faults: list[FileFault]) -> dict[str, Any] | None:
    """The fields of `Scene` that say what is asked for."""
    before = len(faults)
    good, bad = _checked(_Effects, "effects", document.get("effects", {}), faults)
    shares = good.get("moment_shares")
    names = list(good.get("ball", []))
    effects: list[BallEffect] = []
    for name in names:
        if name == CentrifugalForce.name:
            effects.append(CentrifugalForce())
        elif name == GyroscopicMoment.name:
            effects.append(GyroscopicMoment(shares or MomentShares.CONTROLLING))
        else:
            cause = _did_you_mean(name, list(BALL_EFFECTS)) or f"One of {', '.join(BALL_EFFECTS)}"
            faults.append(FileFault("effects.ball", "is not a ball effect", name, cause=cause))
    known = {fault.key for fault in faults[before:]}
    if not known & {"effects.ball", "effects.raceway_control"}:
        faults += [translate(fault) for fault in effect_faults(tuple(effects), good.get("raceway_control"))]
    if shares is not None and "ball" not in bad and GyroscopicMoment.name not in names:
        cause = "Leave it out, or ask for gyroscopic_moment in ball"
        problem = "is given, but no gyroscopic moment is there to share"
        faults.append(FileFault("effects.moment_shares", problem, str(shares), cause=cause))
    if len(faults) > before:
        return None
    choices = {name: good[name] for name in ("raceway_control", "hertz_angle", "hertz_form", "tilt_lever")}
    return {"ball_effects": tuple(effects), **choices}
