"""A REXS model becomes scene files: one for each bearing, one for each shaft that bearings carry."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.files import paths
from qsbearing.files.file_errors import FileErrorDetail, SceneFileError, refused
from qsbearing.files.file_keys import ORIGIN
from qsbearing.files.keys import OF_OPERATION, PRELOAD
from qsbearing.files.limits import MOST_MODEL_FILES, MOST_OF_SHAFT
from qsbearing.files.rexs import shaft_mapping
from qsbearing.files.rexs.bearing_mapping import ASSUMED, ROLLING, BearingRow, is_ours, readings, rows_of
from qsbearing.files.rexs.model import Component, LoadCase, Model
from qsbearing.files.rexs.names import NEWEST
from qsbearing.files.rexs.reader import AttributeReader
from qsbearing.files.rexs.scene_text import NotedTable, text_of
from qsbearing.files.rexs.shaft_parts import gravity_of
from qsbearing.files.rexs.source import model_in, opened
from qsbearing.files.rexs.unread import unread
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.files.set_keys import OF_SET, SET_NUMBERS
from qsbearing.files.spectrum_table import WHOLE
from qsbearing.files.table_checks import Errors
from qsbearing.files.toml import read_back
from qsbearing.model.validation import printable
from qsbearing.systems.sets.row import OUT_OF_LINE

_PRELOAD, _ROW = ({key.field: key for key in keys} for keys in (PRELOAD, SET_NUMBERS["rows"]))
_OUT_OF_LINE = tuple(name for name, *_ in OUT_OF_LINE)
_LOADS = ("axial_load", "radial_load_y", "radial_load_z", "moment_y", "moment_z")
_ALONE = {
    *("concept_bearing", "slide_bearing", "hydrodynamic_radial_plain_bearing", "bevel_gear", "cylindrical_gear"),
    *("ring_gear", "worm_gear", "worm_wheel", "general_gear", "coupling", "fixed_coupling", "switchable_coupling"),
    *ROLLING,
}
"""Components that bear on shafts, each of which is named where it is not ours."""


@dataclass
class SceneText:
    """A file that was made of a part of a model."""

    name: str
    title: str
    text: str
    lacks: list[str]
    """What must be given before it can be solved, one sentence each."""
    document: NotedTable


@dataclass
class Imported:
    """What became of a model."""

    files: list[SceneText]
    not_ours: list[str]
    remarks: list[str]
    unread: list[str]
    """Attributes that state something and that nobody read, by kinds of components."""


def import_model(path: Path, shaft: str | None = None) -> Imported:
    """The scene files of a model.

    Args:
        shaft: name or id of the one shaft that is meant; None: all.

    Raises:
        SceneFileError: everything that is wrong with the model, at once.
    """
    model = model_in(opened(path))
    _refuse_too_many(model, path, shaft)
    errors: Errors = []
    cases: list[LoadCase | None] = [*model.load_cases] or [None]
    files: list[SceneText] = []
    plain = AttributeReader(model, None, errors)
    ours = [each for each in model.components.values() if is_ours(plain, each)]
    if len(cases) * len(ours) > MOST_MODEL_FILES:
        cause = "Take the load cases out that do not matter, or name one shaft"
        raise refused(path, f"would make more than {MOST_MODEL_FILES:,} files", cause)
    acting: set[int] = set()
    for case in cases:
        reader = AttributeReader(model, case, errors)
        chosen = _chosen(reader, shaft)
        for each in ours:
            if shaft is None or shaft_mapping.sides(reader, each).get("inner_part") in chosen:
                files.append(_of_bearing(reader, path, each))
        files += [_of_shaft(reader, path, each) for each in chosen if shaft_mapping.bearings_on(reader, each)]
        acting |= {load.component.number for each in chosen for load in shaft_mapping.loads(reader, each)}
    remarks = _remarks(model)
    files += list(_with_spectra(model, path, files, errors, remarks))
    if errors:
        raise SceneFileError(str(path), errors)
    others = [
        each for each in model.components.values()
        if each.kind in _ALONE and not is_ours(plain, each) and each.number not in acting
    ]  # fmt: skip
    named = [str(each) + f": {plain.word(each, 'bearing_type')}" * (each.kind in ROLLING) for each in others]
    return Imported(files, named, remarks, unread(model, {each.number for each in others}))


def _refuse_too_many(model: Model, path: Path, shaft: str | None) -> None:
    """Before work begins.

    Raises:
        SceneFileError: a model with more of something than is read.
    """
    reader = AttributeReader(model, None, [])
    counts = [(len(model.load_cases), "load cases", "Take the load cases out that do not matter")]
    for each in _chosen(reader, shaft):
        relations = model.relations_of(each.number)
        bearings = {one.of("assembly") for one in model.related("side", "inner_part", each.number)}
        rows = sum(max(len(model.parts(one, "rolling_bearing_row")), 1) for one in bearings if one is not None)
        cause = "Is it one shaft? Split the model, or name another one with --shaft"
        counts += [(rows, f"rows of bearings on {each}", cause), (len(relations), f"relations of {each}", cause)]
    for count, what, cause in counts:
        if count > MOST_OF_SHAFT:
            raise refused(path, f"has {count:,} {what}; at most {MOST_OF_SHAFT:,} are read", cause)


def _chosen(reader: AttributeReader, shaft: str | None) -> list[Component]:
    known = shaft_mapping.shafts(reader)
    chosen = [each for each in known if shaft in (None, each.name, str(each.number))]
    if shaft is not None and not chosen:
        cause = f"Shafts of this model: {', '.join(f'{each.number} ({each.name})' for each in known) or 'none'}"
        raise SceneFileError(
            "--shaft", [FileErrorDetail("--shaft", "no shaft has this name or id", shaft, cause=cause)]
        )
    return chosen


def _remarks(model: Model) -> list[str]:
    own = sum(name.startswith("custom") for each in model.components.values() for name in each.attributes)
    remarks = [f"{own} attributes of the other program's own are not read"] if own else []
    if model.version > NEWEST:
        remarks.append(f"version {model.version_text} is newer than 2.0.0, as which it is read")
    return remarks


def _suffix(case: LoadCase | None, model: Model) -> str:
    return f"_case_{case.number}" if case is not None and len(model.load_cases) > 1 else ""


def _share(reader: AttributeReader) -> float | None:
    """The load case's part of the time."""
    units = (each for each in reader.model.components.values() if each.kind == "gear_unit")
    return next(
        (share for each in units if (share := reader.number(each, "operating_time_fraction")) is not None), None
    )


def _origin(reader: AttributeReader, bearings: list[int], **others: object) -> NotedTable:
    table = NotedTable(bearings=bearings, **others)
    if reader.case is not None:
        share = _share(reader)
        table.set("load_case", reader.case.number, "" if share is None else f"share of the time: {share:g}")
    table.note("", "where `qsbearing run FILE --into MODEL` writes the results")
    return table


def _speeds(reader: AttributeReader, bearing: Component, table: NotedTable) -> bool:
    """Put the speeds into [operation]; whether anything turns."""
    parts = shaft_mapping.sides(reader, bearing)
    for side, field in (("inner", "speed"), ("outer", "outer_speed")):
        part = parts.get(f"{side}_part")
        value = reader.number(bearing, f"speed_{side}_ring")
        of_shaft = reader.number(part, "rotational_speed") if part is not None and part.kind == "shaft" else None
        value = of_shaft if value is None else value
        if field == "speed" or value:
            table.put(OF_OPERATION[field], value or 0.0, "" if value is not None else ASSUMED)
    return any(table.get(OF_OPERATION[field].name) for field in ("speed", "outer_speed"))


def _effects(turns: bool, own: NotedTable) -> NotedTable:
    table = NotedTable()
    if turns:
        table.set("ball", ["centrifugal_force", "gyroscopic_moment"])
        table.set("raceway_control", "outer", "assumed: no attribute of REXS tells it")
    table.update(own)
    table.notes |= own.notes
    return table


def _of_bearing(reader: AttributeReader, path: Path, bearing: Component) -> SceneText:
    parts = shaft_mapping.sides(reader, bearing)
    rows = rows_of(reader, bearing, parts.get("inner_part"))
    row, is_single = rows[0], len(rows) == 1
    sign = row.direction or 1.0 if is_single else 1.0
    row.table.note("", str(bearing))
    document = NotedTable(bearing=row.table) if is_single else NotedTable(rows=[_row(each) for each in rows])
    operation = document["operation"] = NotedTable()
    turns = _speeds(reader, bearing, operation)
    lacks = _load(reader, bearing, row, sign, document)
    if row.first_azimuth:
        operation.put(OF_OPERATION["first_ball_azimuth"], row.first_azimuth)
    if effects := _effects(turns, row.effects if is_single else NotedTable()):
        document["effects"] = effects
    document["readings"] = readings(reader, bearing, parts.get("outer_part"))
    origin = document[ORIGIN] = _origin(reader, [bearing.number] * len(rows))
    if is_single:
        said = f"{ASSUMED} which way it carries axial load" if row.direction is None else ""
        origin.set("x_along", "+u" if sign > 0.0 else "-u", said)
    if lacks:
        origin["missing"] = lacks
    name = f"bearing_{bearing.number}{_suffix(reader.case, reader.model)}.toml"
    return _finished(document, name, str(bearing), path)


def _with_spectra(
    model: Model, path: Path, files: list[SceneText], errors: Errors, remarks: list[str]
) -> Iterator[SceneText]:
    """Of each bearing with a load in all load cases, and of each shaft, if their shares make up the time: one file of
    all of them; a remark where they differ in what the points of one file cannot."""
    shares = [_share(AttributeReader(model, case, errors)) for case in model.load_cases]
    if len(shares) < 2 or None in shares or abs(sum(each or 0.0 for each in shares) - 1.0) > WHOLE:
        return
    cases: dict[str, list[SceneText]] = {}
    for file in files:
        cases.setdefault(file.title, []).append(file)
    for title, own in cases.items():
        if any(each.lacks for each in own):
            continue
        points, differs = _points([each.document for each in own])
        if differs:
            remarks.append(f"{title}: no load spectrum, since its load cases differ in {differs}")
            continue
        document = NotedTable(own[0].document | {"spectrum": []})
        document["spectrum"] = [NotedTable(share=share, **each) for share, each in zip(shares, points, strict=True)]
        del document["operation"]
        document[ORIGIN] = NotedTable({key: each for key, each in document[ORIGIN].items() if key != "load_case"})
        yield _finished(document, f"{own[0].name.partition('_case_')[0]}_spectrum.toml", title, path)


def _points(documents: list[NotedTable]) -> tuple[list[dict[str, float]], str]:
    """The numbers in which files differ, and their operations, as points of a spectrum; or what no point can have."""
    plain = [{name: each for name, each in _plain(one).items() if name != ORIGIN} for one in documents]
    numbers = [{at: paths.value_at(one, at) for at in paths.numbers_of(one)} for one in plain]
    every = dict.fromkeys(at for each in numbers for at in each)
    varied = [at for at in every if at[0] == "operation" or len({each.get(at) for each in numbers}) > 1]
    for at in varied:
        if any(at not in each for each in numbers) or not paths.spans_cases(at, plain[0]):
            return [], ".".join(at)
        for one in plain:
            paths.take_out(one, at)
    if any(one != plain[0] for one in plain):
        return [], next(name for name in plain[0] if any(one.get(name) != plain[0][name] for one in plain))
    return [{at[1] if at[0] == "operation" else ".".join(at): each[at] for at in varied} for each in numbers], ""


def _preload(document: NotedTable, forces: list[float]) -> None:
    """[preload] of the forces that bearings state, if any does."""
    if forces:
        table = document["preload"] = NotedTable()
        table.put(_PRELOAD["rigid"], max(forces), "assumed: held rigidly, before fitting; programs differ")
        if len(set(forces)) > 1:
            table.note("", "the bearings have different preload forces: the largest is written")


def _load(reader: AttributeReader, bearing: Component, row: BearingRow, sign: float, document: NotedTable) -> list[str]:
    """Loads of a shaft that this bearing alone carries, else by the results in the model; what else bears on the shaft
    shares its loads and presses the bearing, so that the load is missing. Without a shaft a preload is all there is."""
    shaft, operation = shaft_mapping.sides(reader, bearing).get("inner_part"), document["operation"]
    forces, note, is_alone, weighs = None, "the sum of the forces on the shaft", True, False
    carried: list[Any] = []
    tilts, of_tilts = np.zeros(2), "assumed: shaft and housing hold it"
    if shaft is not None and shaft.kind == "shaft":
        carried = [each for each in reader.model.relations_of(shaft.number) if each.of("inner_part") == shaft.number]
        given = shaft_mapping.loads(reader, shaft)
        # What weighs on a shaft, its own file adds up.
        weighs = any(gravity_of(reader, shaft))
        is_alone = len(carried) == 1 and not weighs and not shaft_mapping.lacking(reader, shaft)
        if given and is_alone:
            forces = np.sum([load.values[:3] for load in given], axis=0)
    if forces is None and (forces := _results(reader, bearing, row.turn)) is not None:
        note = "by the results that stand in the model"
        angles = [reader.number(bearing, f"angular_deflection_in_{axis}") for axis in "vw"]
        if None not in angles:
            tilts, of_tilts = row.turn[3:, 3:].T @ np.array(angles, float) * sign, note
    if forces is None and not is_alone and shaft is not None:
        solved = f"`qsbearing run shaft_{shaft.number}{_suffix(reader.case, reader.model)}.toml` prints it of its row"
        share = f"carries the weight of {shaft}" if len(carried) == 1 and weighs else f"shares {shaft} with others"
        return [f"the load of {bearing}, which {share}: {solved}, preload included"]
    if forces is None:
        force = reader.positive(bearing, "preload_force")
        _preload(document, [] if force is None else [force])
        if force is None and row.offset is not None and row.offset > 0.0:
            table = document["preload"] = NotedTable()
            table.put(_PRELOAD["axial_displacement"], row.offset, "assumed: held rigidly; programs differ")
        return []
    for field, value in zip(_LOADS[:3], forces * (sign, 1.0, 1.0), strict=True):
        operation.put(OF_OPERATION[field], float(value) + 0.0, note)
    for field, value in zip(("tilt_y", "tilt_z"), tilts, strict=True):
        operation.put(OF_OPERATION[field], float(value) + 0.0, of_tilts)
    return []


def _results(reader: AttributeReader, bearing: Component, turn: NDArray) -> NDArray | None:
    """The load on the inner ring in the shaft's axes: minus what the bearing does to it."""
    forces = [reader.number(bearing, f"force_acting_on_inner_component_{axis}") for axis in "uvw"]
    return None if None in forces else -turn[:3, :3].T @ np.array(forces, float)


def _row(row: BearingRow) -> NotedTable:
    table = NotedTable()
    table.note("", str(row.bearing))
    table.put(_ROW["position"], row.position, "the middle of the bearing: assumed that its balls are there")
    if row.table["kind"] == "deep_groove":
        said = "" if row.located else f"{ASSUMED} how its outer ring is held"
        table.set("carries", row.located or "both", said)
    elif row.direction is not None:
        said = "assumed: the direction of the shaft's force that it carries"
        table.set("carries", "+x" if row.direction > 0.0 else "-x", said)
    table.put(_ROW["offset"], row.offset, "the preload distance: assumed before fitting; programs differ")
    for name, value in zip(_OUT_OF_LINE, row.out_of_line, strict=True):
        table.put(_ROW[name], value)
    table["bearing"] = row.table
    table.update(row.effects)
    table.notes |= row.effects.notes
    return table


def _of_shaft(reader: AttributeReader, path: Path, shaft: Component) -> SceneText:
    document = NotedTable()
    bearings = shaft_mapping.bearings_on(reader, shaft)
    rows = [row for each in bearings for row in rows_of(reader, each, shaft)]
    document["rows"] = [_row(each) for each in rows]
    given = shaft_mapping.loads(reader, shaft)
    is_warm = any(name.endswith("ring_temperature_C") for row in rows for name in row.effects.get("ring_expansion", ()))
    table, of_weight = shaft_mapping.shaft_table(reader, shaft, given, is_warm)
    document["shaft"] = table
    reference = rows[0].position or 0.0
    (key,) = OF_SET
    table.put(key, reference)
    operation = document["operation"] = NotedTable()
    turns = _speeds(reader, bearings[0], operation)
    for field in _LOADS:
        operation.put(OF_OPERATION[field], 0.0)
    if len({each for row in rows if (each := row.first_azimuth) is not None}) == 1:
        operation.put(OF_OPERATION["first_ball_azimuth"], rows[0].first_azimuth)
    _preload(document, [force for each in bearings if (force := reader.positive(each, "preload_force")) is not None])
    floating = [number for number, row in enumerate(rows, 1) if row.floats and row.table["kind"] != "deep_groove"]
    document |= {"floating": [NotedTable(rows=[number]) for number in floating]} if floating else {}
    document["effects"] = _effects(turns, NotedTable())
    casing = shaft_mapping.sides(reader, bearings[0]).get("outer_part")
    document["readings"] = readings(reader, bearings[0], casing)
    lacks = [*shaft_mapping.lacking(reader, shaft), *of_weight]
    if note := table.notes.get("sections"):
        lacks.append(f"sections that follow one another: {note}")
    document[ORIGIN] = _origin(reader, [row.bearing.number for row in rows], shaft=shaft.number)
    table.note("", f"{shaft}; its housing is assumed to be rigid")
    name = f"shaft_{shaft.number}{_suffix(reader.case, reader.model)}.toml"
    if lacks:
        document[ORIGIN]["missing"] = lacks
    return _finished(document, name, str(shaft), path)


def _finished(document: NotedTable, name: str, title: str, path: Path) -> SceneText:
    """The text of the tables, and what reading it finds missing.

    Raises:
        SceneFileError: it is not read as what was written.
    """
    missing: list[str] = []
    heading = f"# {title}\n# of {printable(path.name)}. Run it with: qsbearing run {name}\n\n"
    text = heading + text_of(document)
    tables = read_back(text, _plain(document), Path(name))
    try:
        scene_or_set_of(tables, name, may_infer=True)
    except SceneFileError as error:
        listed: Any = error.errors
        lacks = "missing" in document[ORIGIN]
        told = [each for each in listed if not (lacks and each.key == "operation")]  # the load, told better there
        missing = [each.problem if each.key == f"{ORIGIN}.missing" else each.line for each in told]
    return SceneText(name, title, text, missing, document)


def _plain(value: Any) -> Any:
    """The tables without their notes."""
    if isinstance(value, dict):
        return {key: _plain(each) for key, each in value.items()}
    return [_plain(each) for each in value] if isinstance(value, list) else value
