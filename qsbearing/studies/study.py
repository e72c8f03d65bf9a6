"""A study: a scene, the keys that vary, and how those that vary at random are sampled."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

from qsbearing.files import catalogue
from qsbearing.files.file_errors import FileErrorDetail, SceneFileError
from qsbearing.files.result_names import reading_of
from qsbearing.files.scene_file import document_of
from qsbearing.files.toml import check_tables
from qsbearing.model.above import Plotted
from qsbearing.model.bearing_errors import BALL_COUNT_RANGE
from qsbearing.model.validation import alike, question
from qsbearing.model.version import __version__
from qsbearing.studies import keys
from qsbearing.studies.variables import (
    DISTRIBUTIONS,
    RANGE_KEYS,
    Axis,
    Distribution,
    Variable,
    VariableError,
    error_of,
    variable_of,
)

MOST_SAMPLES = 1_000_000_000


class Read(NamedTuple):
    """The tables of a scene or study that is read already."""

    document: dict[str, Any]
    file: str
    """What to call it in errors."""
    label: str


Source = str | os.PathLike[str] | dict[str, Any] | Read


def read(source: Source) -> Read:
    """A scene file, a study file, a catalogue bearing by its name, or the tables of such a file.

    Raises:
        SceneFileError: it cannot be read.
    """
    if isinstance(source, Read):
        return source
    if not isinstance(source, dict):
        return Read(*document_of(source, True))
    check_tables(source, Path("study"))
    return Read(source, "study", "")


class Sampling(StrEnum):
    """How random keys are sampled together."""

    RANDOM = "random"
    """Independent points."""
    LATIN_HYPERCUBE = "latin_hypercube"
    """Each key's values spread evenly over its distribution; in blocks of at most 65,536 points."""
    SOBOL = "sobol"
    """Scrambled Sobol points: the most even; best for a power of two."""


@dataclass(frozen=True)
class Study(Plotted):
    """What a sweep solves: every combination of the axes' values, each with all the samples.

    Make one with `Study.of`; a study file is a scene file with the tables [vary] and, if wanted, [study].
    """

    document: dict[str, Any]
    """The tables of the scene file."""
    variables: tuple[Variable, ...]
    """What varies, each with its values or its distribution."""
    label: str = ""
    """Name of the bearing where the catalogue gives none."""
    file: str = "study"
    """What to call it in errors."""
    samples: int = 0
    """Of distributions: how many points are drawn."""
    sampling: Sampling = Sampling.SOBOL
    """How they are drawn."""
    seed: int = 0
    """Of the random numbers; the same seed draws the same points."""
    quantities: tuple[str, ...] = ()
    """Names of the results to keep; none: all, or the main ones of many points."""

    @classmethod
    def of(
        cls,
        source: Source,
        vary: dict[str, Any] | None = None,
        *,
        samples: int | None = None,
        sampling: str | None = None,
        seed: int | None = None,
        quantities: Iterable[str] | None = None,
    ) -> Study:
        """A study of a scene file, a study file, a catalogue bearing's name, or the tables of such a file.

        Args:
            vary: for each key what it takes: a list, "START:STOP:COUNT", "normal(MEAN,SD)", ...; beside what the
                file's [vary] says, or in its place.
            samples: points of the random keys; 1024 if not given.
            sampling: random, latin_hypercube or sobol.
            quantities: names of the results to keep.

        Raises:
            SceneFileError: everything that is wrong with the study, at once; what its points find is found by `sweep`.
        """
        contents = read(source)
        document, file, label = dict(contents.document), contents.file, contents.label
        errors: list[FileErrorDetail] = []
        if document.pop("spectrum", None) is not None:
            cause = "Leave it out: `qsbearing run` solves it, one point after the other at the scene's own numbers"
            errors.append(FileErrorDetail("[[spectrum]]", "is not part of a study", cause=cause))
        bearing = document.get("bearing")
        if isinstance(bearing, dict) and "preload" in bearing and "preload" not in document:
            # A class, at the top as well, where a force that varies takes its place.
            bearing = dict(bearing)
            document |= {"preload": bearing.pop("preload"), "bearing": bearing}
        varied = _table(document, "vary", errors) | (vary or {})
        options = _table(document, "study", errors)
        given = {"samples": samples, "sampling": sampling, "seed": seed, "quantities": quantities}
        options |= {name: value for name, value in given.items() if value is not None}
        variables = _variables(varied, document, errors)
        chosen = _options(options, errors)
        _ask_for_readings(document, chosen.get("quantities", ()))
        if not variables and not errors:
            cause = "Such as speed_rpm = {start = 0, stop = 15000, count = 61}; --vary speed_rpm=0:15000:61"
            errors.append(FileErrorDetail("vary", "nothing varies", cause=cause))
        if errors:
            raise SceneFileError(file, errors)
        random = any(isinstance(variable, Distribution) for variable in variables)
        chosen["samples"] = chosen.get("samples", 1024) if random else 0
        return cls(document, variables, label, file, **chosen)

    @property
    def axes(self) -> tuple[Axis, ...]:
        """Keys over given values, in their order; those of a single value are no axis."""
        return tuple(each for each in self.variables if isinstance(each, Axis) and len(each.values) > 1)

    @property
    def distributions(self) -> tuple[Distribution, ...]:
        """Keys that vary at random."""
        return tuple(each for each in self.variables if isinstance(each, Distribution))

    def replaced(self, **changes: Any) -> Study:
        """A study that differs in these fields."""
        return replace(self, **changes)

    def as_data(self) -> dict[str, Any]:
        """All of it as plain data."""
        random = {"samples": self.samples} if self.samples else {}
        return {
            "label": self.label,
            "scene": self.document,
            "vary": {
                each.key: list(each.values) if isinstance(each, Axis) else {each.kind: list(each.parameters)}
                for each in self.variables
            },
            "study": {
                **random,
                "sampling": str(self.sampling),
                "seed": self.seed,
                "quantities": list(self.quantities),
            },
        }

    @cached_property
    def fingerprint(self) -> str:
        """Tells this study, under this version of the package, from every other."""
        text = json.dumps([__version__, self.as_data()], sort_keys=True, default=str)
        return hashlib.sha256(text.encode()).hexdigest()


def _ask_for_readings(document: dict[str, Any], names: Iterable[str]) -> None:
    """Ask the scene for each reading of which a number is named; what else it needs stays for the scene to say."""
    requested = document.get("readings", {})
    if not isinstance(requested, dict):
        return
    for name in names:
        reading = reading_of(name)
        if reading and reading not in requested:
            requested = requested | {reading: {}}
            document["readings"] = requested


def _table(document: dict[str, Any], name: str, errors: list[FileErrorDetail]) -> dict[str, Any]:
    table = document.pop(name, {})
    if isinstance(table, dict):
        return table
    errors.append(FileErrorDetail(name, "is not a table", table, cause=f"Write it as [{name}], keys below it"))
    return {}


def ball_count_of(document: dict[str, Any]) -> int:
    """That a document or its catalogue entry gives; 0 where neither gives one."""
    bearing = document.get("bearing")
    if not isinstance(bearing, dict):
        return 0
    name = bearing.get("name")
    entry = catalogue.find(name) if isinstance(name, str) else None
    count = bearing.get("ball_count", entry.bearing.get("ball_count") if entry else None)
    if not isinstance(count, int) or isinstance(count, bool):
        return 0
    return count if BALL_COUNT_RANGE[0] <= count <= BALL_COUNT_RANGE[1] else 0


def _of_each_ball(variable: Variable, count: int) -> list[Variable]:
    """The variable of every ball: as many independent ones as there are balls.

    Raises:
        VariableError: it is no distribution.
    """
    if isinstance(variable, Axis):
        problem = "applies to every ball, and each ball draws its own value: give a distribution"
        raise VariableError(f"{problem}. For one ball only: {keys.of_ball(0)}")
    if not count:
        raise VariableError("needs the bearing's ball_count, a whole number")
    return [replace(variable, key=keys.of_ball(ball)) for ball in range(count)]


def _variables(varied: dict[str, Any], document: dict[str, Any], errors: list[FileErrorDetail]) -> tuple[Variable, ...]:
    by_key: dict[str, Variable] = {}
    ball_count = ball_count_of(document)
    for name, given in _flattened(varied):
        try:
            variable = variable_of(name, given, document)
            each = _of_each_ball(variable, ball_count) if variable.key == keys.EACH_BALL else [variable]
            if any(one.key in by_key for one in each):
                raise VariableError("is varied twice")
            by_key |= {one.key: one for one in each}
        except VariableError as error:
            errors.append(error_of(name, given, error))
    if "ball_count" in by_key and any(keys.known(key).ball is not None for key in by_key):
        problem = "cannot vary together with deviations of single balls, which belong to a fixed number of balls"
        errors.append(FileErrorDetail("vary.ball_count", problem))
    return tuple(by_key.values())


def _flattened(table: dict[str, Any], prefix: str = "") -> Iterable[tuple[str, Any]]:
    """Names as paths: TOML reads `ball_material.density_kg_m3` as a table within."""
    for name, given in table.items():
        is_table = isinstance(given, dict) and given and not {*RANGE_KEYS, *DISTRIBUTIONS} & {*given}
        if is_table and not keys.find(prefix + name):
            yield from _flattened(given, f"{prefix}{name}.")
        else:
            yield prefix + name, given


def _options(table: dict[str, Any], errors: list[FileErrorDetail]) -> dict[str, Any]:
    chosen: dict[str, Any] = {}
    known = ("samples", "sampling", "seed", "quantities")
    for name, given in table.items():
        whole = isinstance(given, int) and not isinstance(given, bool)
        if name not in known:
            cause = question(alike(name, known)) or f"One of {', '.join(known)}"
            errors.append(FileErrorDetail(f"study.{name}", "unknown key", cause=cause))
        elif name == "sampling":
            if given not in list(Sampling):
                cause = f"One of {', '.join(Sampling)}"
                errors.append(FileErrorDetail("study.sampling", "is none of the choices", given, cause=cause))
            else:
                chosen[name] = Sampling(given)
        elif name == "quantities":
            words = [given] if isinstance(given, str) else list(given) if isinstance(given, list | tuple) else [None]
            if not all(isinstance(word, str) for word in words):
                errors.append(FileErrorDetail("study.quantities", "is not a list of names", given))
            else:
                chosen[name] = tuple(words)
        elif not whole or not (1 if name == "samples" else 0) <= given <= MOST_SAMPLES:
            allowed = (1.0 if name == "samples" else 0.0, float(MOST_SAMPLES))
            errors.append(FileErrorDetail(f"study.{name}", "is not a whole number in its range", given, "", allowed))
        else:
            chosen[name] = given
    return chosen
