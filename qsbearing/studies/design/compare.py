"""Several bearings at the same job: what they are, and what each makes of it, side by side."""

from __future__ import annotations

import copy
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from qsbearing.files import catalogue, paths
from qsbearing.files.file_errors import FileErrorDetail, SceneFileError, refused
from qsbearing.files.file_keys import OTHER_TABLES, REQUIRE
from qsbearing.files.keys import BEARING, MATERIALS, OPERATION, PRELOAD, Key, keys_of, required_of
from qsbearing.files.result_names import find as find_result
from qsbearing.files.scene_file import document_of
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.model.bearing import BallBearing
from qsbearing.model.material import Material
from qsbearing.model.scene.arched_rings import IN_RUN, refuse_arched
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.limit import Answer
from qsbearing.model.solution.result_keys import Place
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks.kinds import NOTE, Kind
from qsbearing.remarks.remark import Remark, remark
from qsbearing.remarks.wording import listed
from qsbearing.results.readings_record import all_taken
from qsbearing.results.remarks import every_remark
from qsbearing.results.requirements import required_answers
from qsbearing.studies.changed_keys import AS_SET, ChangedKey, changed, path_of
from qsbearing.studies.chooser.choose import solve as choose
from qsbearing.studies.chooser.choose_set import solve_set
from qsbearing.studies.chunk import MAIN
from qsbearing.studies.results import known_results, read
from qsbearing.studies.study import Read
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution

MOST = 20
"""Bearings: of more no table is read."""
OF_JOB = ("operation", "effects", "tolerance", "readings", REQUIRE)
"""What a set takes from the job; its shaft, the loads on it and its preload are its own."""
NOT_SOLVED = ("vary", "study", *OTHER_TABLES)
"""Tables that say nothing of a bearing or its job."""
SHOWN = (
    *MAIN, "ring_effective_stiffness_tilt_z", "outer_required_friction_max", "centrifugal_force_max", "balls_off_inner",
    "inner_film_film_parameter_min", "outer_film_film_parameter_min",
)  # fmt: skip
"""Of one bearing; with them every number of its readings that is not of single balls."""

JOB_OF_ANOTHER = Kind(
    "job_of_another", NOTE, "how_to#five-bearings-or-two-machines-compared",
    "{tables} of its file {verb} not used: all are solved with operating point, effects and readings of {job}",
)  # fmt: skip


@dataclass(frozen=True)
class Compared:
    """One number of each bearing."""

    name: str
    """Of the result; of an input its path in a file."""
    unit: str
    values: tuple[float, ...]
    """NaN where there is none."""

    def difference(self, number: int) -> float:
        """Of a bearing from the first, as a part of the first; 0 where either has none, or they have not one sign."""
        first, own = self.values[0], self.values[number]
        return own / first - 1.0 if first * own > 0.0 and np.isfinite(first * own) else 0.0


@dataclass(frozen=True)
class Comparison:
    """Bearings at the same job, in the order given."""

    labels: tuple[str, ...]
    statuses: tuple[str, ...]
    inputs: tuple[Compared, ...]
    """Numbers of the bearings in which they differ."""
    results: tuple[Compared, ...]
    job: str
    """Where the job stands."""
    conditions: tuple[tuple[str, float, str], ...]
    """Of all bearings: the keys of the operation, preload and loads on the shaft, with their values and units."""
    solutions: tuple[Solution | SetSolution, ...] = field(repr=False, compare=False)
    unused: tuple[tuple[str, ...], ...] = ()
    """Tables of each bearing's file that say otherwise than the job."""

    @cached_property
    def required(self) -> list[tuple[Answer, ...]]:
        """Each requirement of the job, as every bearing answers it.

        Raises:
            SceneError: a name that no result of a bearing has.
        """
        of_each = [required_answers(solution, all_taken(solution)) for solution in self.solutions]
        return list(zip(*of_each, strict=True))

    @cached_property
    def remarks(self) -> list[Remark]:
        """What there is to beware of in the results of each bearing."""
        of_solutions = [every_remark(solution) for solution in self.solutions]
        of_files = [_of_another(tables, self.job) for tables in self.unused or [()] * len(self.labels)]
        return [
            replace(each, of=replace(each.of, bearings=(label,)))
            for label, *both in zip(self.labels, of_solutions, of_files, strict=True)
            for each in chain(*both)
        ]

    @property
    def all_solved(self) -> bool:
        """Whether each bearing has an equilibrium."""
        return all(status == "converged" for status in self.statuses)


Source = str | os.PathLike[str] | dict[str, Any]


def compare(sources: Sequence[Source], at: Source | None = None) -> Comparison:
    """Solve several bearings under the same operating conditions.

    Args:
        sources: scenes by file, catalogue name, or tables; only the bearing of each is used, of a set all but its
            operation, effects and readings.
        at: a scene file, or tables, whose operation, preload, effects, readings and requirements are used for all
            bearings, its own bearing left out; None: the first source. If it is a set, each bearing in turn is that of
            its rows.

    Returns:
        Comparison: the results of each, side by side.

    Raises:
        SceneFileError: everything that is wrong with any of them, at once.

    Examples:
        >>> found = qs.compare(["7210C", "71914C"], at="b218")
        >>> print(found.labels)
        ('7210C', '71914C')
    """
    return solved(job_of(sources, at))


def _is_no_source(given: object) -> bool:
    return not isinstance(given, str | os.PathLike | dict)


class OtherValue(NamedTuple):
    """A key that has another value than the files say."""

    number: int | None
    """Of the scene that it is meant for, from 1; None: of all, or of the job that all share."""
    key: str
    value: Any


class Job(NamedTuple):
    """Bearings at one job, as they can be solved."""

    made: list[Scene | BearingSet]
    files: list[str]
    where: str
    """Where the job stands."""
    unused: list[tuple[str, ...]]
    """Tables of each file that say otherwise than the job."""
    changes: list[tuple[str, ChangedKey]]
    """What was set, and in which file."""


def job_of(sources: Sequence[Source], at: Source | None = None, settings: Sequence[OtherValue] = ()) -> Job:
    """What is to be compared, read and checked; arguments and errors are those of `compare`."""
    if not isinstance(sources, Sequence) or isinstance(sources, str) or any(map(_is_no_source, sources)):
        raise TypeError("compare takes a list of scenes, each by its file, its name in the catalogue, or its tables")
    count = len(sources)
    if not 2 <= count <= MOST:
        given = f"{count} scene{'' if count == 1 else 's'} given"
        raise refused("compare", f"{given}: a comparison takes 2 to {MOST}")
    errors: list[FileErrorDetail] = []
    documents = [_read(source, errors) for source in sources]
    if at is not None:
        documents.append(_read(at, errors))
    of_job = 0 if at is None else count
    changes = _put(documents, of_job, settings, count, errors) if not errors else []
    job, documents = documents[of_job][0], documents[:count]
    if "spectrum" in job:
        errors.append(FileErrorDetail("[[spectrum]]", "has several operating points: a comparison takes one"))
    made: list[Scene | BearingSet] = []
    for document, file, label in documents if not errors else ():
        try:
            made.append(_with_bearing(job, document, file, label))
        except SceneFileError as error:
            for each in error.errors:
                detail = each if isinstance(each, FileErrorDetail) else FileErrorDetail("", str(each))
                errors.append(FileErrorDetail(**{**vars(detail), "key": f"{file}: {detail.key}"}))
    if errors:
        raise SceneFileError("compare", errors)
    where = "the first scene" if at is None else ("tables" if isinstance(at, dict) else str(at))
    unused = [_unused(document, job, file) for document, file, _ in documents]
    return Job(made, [file for _, file, _ in documents], where, unused, changes)


def _put(
    documents: list[tuple[dict[str, Any], str, str]],
    of_job: int,
    settings: Sequence[OtherValue],
    count: int,
    errors: list[FileErrorDetail],
) -> list[tuple[str, ChangedKey]]:
    """Give keys other values: those of the job in the file that it is taken from, others in each scene or in the one
    that is meant; documents change."""
    of_scenes: dict[int, list[tuple[str, Any]]] = {}
    for number, key, value in settings:
        head, is_set = path_of(key, documents[of_job][0])[0], "rows" in documents[0][0]
        is_shared = head in OF_JOB if is_set else head != "bearing"
        if number is not None and (is_shared or not 1 <= number <= count):
            shared = f"{head} is of the job, which all share: leave the number out"
            cause = shared if is_shared else f"is of no scene: there are 1 to {count}"
            errors.append(FileErrorDetail(f"{number}:{key}", cause, value, note=AS_SET))
            continue
        meant = [of_job] if is_shared else range(count) if number is None else [number - 1]
        for each in meant:
            of_scenes.setdefault(each, []).append((key, value))
    changes: list[tuple[str, ChangedKey]] = []
    for each, values in of_scenes.items():
        try:
            read, _, own = changed(Read(*documents[each]), values, lambda of: of)
            documents[each] = (read.document, read.file, read.label)
            changes += [(read.file, change) for change in own]
        except SceneFileError as error:
            errors += _of_file(error)
    return changes


def solved(job: Job) -> Comparison:
    """All of them solved."""
    for each in job.made:
        refuse_arched(getattr(each, "bearing", None), "`compare`", IN_RUN)
    solutions = [solve_set(each) if isinstance(each, BearingSet) else choose(each) for each in job.made]
    bearings = [each.rows[0].bearing if isinstance(each, BearingSet) else each.bearing for each in job.made]
    sets = [each for each in job.made if isinstance(each, BearingSet)]
    of_sets = _inputs_of_sets(sets) if len(sets) == len(job.made) else ()
    are_sets_alike = not any(line.name.startswith(("rows.", "shaft.", "spacers.")) for line in of_sets)
    labels = _labels([bearing.name if are_sets_alike else "" for bearing in bearings], job.files)
    statuses = tuple(str(np.asarray(solution.status)) for solution in solutions)
    conditions = _conditions(job.made[0])
    lines = _inputs(bearings) if are_sets_alike else of_sets, _results(solutions)
    return Comparison(labels, statuses, *lines, job.where, conditions, tuple(solutions), tuple(job.unused))


def _unused(document: dict[str, Any], job: dict[str, Any], file: str) -> tuple[str, ...]:
    """Tables of a file that a comparison leaves out and that say otherwise than the job; an example of the catalogue
    has none of its own."""
    if catalogue.named(file) is not None:
        return ()
    own = ("bearing", *NOT_SOLVED) if "rows" not in document else (*document.keys() - OF_JOB,)
    return tuple(f"[{name}]" for name, table in document.items() if name not in own and table != job.get(name))


def _of_another(tables: tuple[str, ...], job: str) -> list[Remark]:
    verb = "is" if len(tables) == 1 else "are"
    return [remark(JOB_OF_ANOTHER, tables=listed(tables), verb=verb, job=job)] if tables else []


def _conditions(of: Scene | BearingSet) -> tuple[tuple[str, float, str], ...]:
    holders: list[tuple[str, tuple[Key, ...], Any]] = [("", OPERATION, of.operation), ("preload.", PRELOAD, of.preload)]
    shaft = of.shaft if isinstance(of, BearingSet) else None
    for kind in ("load", "gear", "belt") if shaft is not None else ():
        for number, each in enumerate(shaft.standing[kind], 1):  # type: ignore[union-attr]
            holders.append((f"shaft.{kind}s.{number}.", keys_of(type(each)), each))
    return tuple(
        (f"{before}{key.name}", key.in_file(float(np.asarray(value))), key.unit)
        for before, keys, holder in holders
        for key in keys
        if (value := getattr(holder, key.field, None)) is not None and (value or key.field != "first_ball_azimuth")
    )


def _read(source: Source, errors: list[FileErrorDetail]) -> tuple[dict[str, Any], str, str]:
    if isinstance(source, dict):
        return source, "tables", ""
    try:
        return document_of(source)
    except SceneFileError as error:
        errors += _of_file(error)
        return {}, str(source), ""


def _of_file(error: SceneFileError) -> Iterator[FileErrorDetail]:
    """Errors of one of several files, with its name."""
    for each in error.errors:
        assert isinstance(each, FileErrorDetail)
        yield FileErrorDetail(**{**vars(each), "key": f"{error.file}: {each.key}".removesuffix(": ")})


def _with_bearing(job: dict[str, Any], document: dict[str, Any], file: str, label: str) -> Scene | BearingSet:
    if "rows" in document:
        own = {name: table for name, table in document.items() if name not in (*OF_JOB, "vary", "study")}
        return scene_or_set_of(copy.deepcopy(own | {name: job[name] for name in OF_JOB if name in job}), file, label)
    merged = copy.deepcopy({name: table for name, table in job.items() if name not in ("bearing", "vary", "study")})
    if "bearing" in document:
        merged["bearing"] = copy.deepcopy(document["bearing"])
    return scene_or_set_of(merged, file, label)


def _labels(names: list[str], files: list[str]) -> tuple[str, ...]:
    """Names of the bearings; with their files where two have the same."""
    names = [name or Path(file).stem for name, file in zip(names, files, strict=True)]
    if len(set(names)) < len(names):
        names = [f"{name} ({Path(file).stem})" for name, file in zip(names, files, strict=True)]
    return tuple(f"{name} #{i + 1}" if names.count(name) > 1 else name for i, name in enumerate(names))


def _inputs(bearings: list[BallBearing]) -> tuple[Compared, ...]:
    lines = [
        Compared(key.name, key.unit, tuple(key.in_file(float(getattr(bearing, key.field))) for bearing in bearings))
        for key in BEARING
        if getattr(bearings[0], key.field) is not None  # shims, of four-point bearings
    ]
    for side in MATERIALS:
        for key in required_of(Material):
            values = tuple(key.in_file(float(getattr(getattr(each, side), key.field))) for each in bearings)
            lines.append(Compared(f"{side}.{key.name}", key.unit, values))
    return tuple(line for line in lines if len(set(line.values)) > 1)


def _inputs_of_sets(sets: Sequence[BearingSet]) -> tuple[Compared, ...]:
    """The numbers of sets in which these differ, by their paths in a file."""
    tables = [input_tables(each) for each in sets]
    names = dict.fromkeys(path for table in tables for path in paths.numbers_of(table))
    lines = []
    for path in names:
        values = [paths.value_at(table, path) for table in tables]
        if any(value != values[0] for value in values) and path[0] not in OF_JOB:
            key = paths.key_at(path)
            numbers = tuple(np.nan if value is None else float(value) for value in values)
            lines.append(Compared(".".join(path), key.unit if key else "", numbers))
    return tuple(lines)


def main_results(solution: Solution | SetSolution) -> dict[str, Place]:
    """Those that are shown of one bearing, and every number of its readings; of a set all that a study keeps."""
    known = {name: each for name, each in known_results(solution).items() if each.is_usual}
    if isinstance(solution, SetSolution):
        return known
    of_readings = [name for name, each in known.items() if each.group.reading and not each.is_per_ball]
    return {each.name: each for name in (*SHOWN, *of_readings) if (each := find_result(name, known)) is not None}


def _results(solutions: list[Solution | SetSolution]) -> tuple[Compared, ...]:
    every: dict[str, Place] = {}
    values: list[dict[str, float]] = []
    for solution in solutions:
        kept = main_results(solution)
        every |= {name: each for name, each in kept.items() if name not in every}
        own = read(solution, kept.values())
        values.append({name: float(np.asarray(each)) for name, each in own.items()})
    lines = (Compared(name, each.unit, tuple(own.get(name, np.nan) for own in values)) for name, each in every.items())
    return tuple(line for line in lines if any(np.isfinite(each) and each != 0.0 for each in line.values))
