"""From the values of a chunk's points to one scene that holds the possible ones, and why the others are none."""

from __future__ import annotations

import copy
from contextlib import suppress
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.files import catalogue
from qsbearing.files.file_errors import FileErrorDetail, SceneFileError
from qsbearing.files.scene_file import scene_of
from qsbearing.files.scene_or_set import is_set
from qsbearing.files.set_file import set_of
from qsbearing.model.material import material_named
from qsbearing.model.scene.keys import BALL_DEVIATIONS, COEFFICIENTS, MATERIAL, MATERIALS
from qsbearing.model.scene.scene import Scene
from qsbearing.studies import keys
from qsbearing.studies.points import Points
from qsbearing.studies.study import Study, ball_count_of
from qsbearing.studies.variables import Axis
from qsbearing.systems.sets.bearing_set import BearingSet

TAIL = 0.01
"""A distribution must leave possible what lies between its quantiles of 1 % and 99 % (chosen: beyond these a normal
distribution without limits goes where it means nothing)."""


OWN_VALUE = "the file's own value, though the key varies"


class PossibleScene(NamedTuple):
    """The scene of those points of a chunk that describe a bearing."""

    scene: Scene | BearingSet | None
    """Over the possible points, one case axis; None where no point is possible."""
    possible: NDArray
    """Which they are; shape (point,)."""
    reason: NDArray
    """Why a point is impossible, as an index of `reasons`, from 1; 0 where it is possible; shape (point,)."""
    reasons: tuple[str, ...]
    """`key: what is wrong with it`."""


def scene_of_points(study: Study, values: dict[str, NDArray], count: int) -> PossibleScene:
    """The scene of these points.

    Raises:
        SceneFileError: what is wrong with the study whatever the point.
    """
    possible = np.ones(count, bool)
    reason = np.zeros(count, np.int16)
    reasons: list[str] = []
    while possible.any():
        kept = {key: array[possible] if array.ndim else array for key, array in values.items()}
        try:
            scene = _over_one_axis(_scene(study, kept), int(possible.sum()))
            return PossibleScene(scene, possible, reason, tuple(reasons))
        except SceneFileError as error:
            wrong = [each for each in error.errors if isinstance(each, FileErrorDetail)]
            # What no varied array has a part in is wrong at the other points too.
            whatever_the_point = [each for each in wrong if each.where is None or np.ndim(each.where) == 0]
            if whatever_the_point:
                raise SceneFileError(study.file, whatever_the_point) from None
            numbers = np.flatnonzero(possible)
            for each in wrong:
                concerned = numbers[np.broadcast_to(np.asarray(each.where), numbers.shape)]
                text = f"{each.key}: {each.problem}"
                if text not in reasons:
                    reasons.append(text)
                fresh = concerned[possible[concerned]]
                reason[fresh] = reasons.index(text) + 1
                possible[fresh] = False
    return PossibleScene(None, possible, reason, tuple(reasons))


def _over_one_axis(scene: Scene | BearingSet, count: int) -> Scene | BearingSet:
    """The scene of so many points, even where nothing varies but what its readings take."""
    azimuth = np.broadcast_to(scene.operation.first_ball_azimuth, count)
    return replace(scene, operation=replace(scene.operation, first_ball_azimuth=azimuth))


def possible_point(study: Study, random: dict[str, NDArray]) -> dict[str, NDArray] | None:
    """What each key takes at the first possible point of the axes, with these of the random keys; None: none is.

    Raises:
        SceneFileError: what is wrong with the study whatever the point.
    """
    given = tuple(Axis(key, (float(value),)) for key, value in random.items())
    axes = tuple(each for each in study.variables if isinstance(each, Axis))
    points = Points(study.replaced(variables=axes + given, samples=0))
    for number in range(points.chunk_count):
        values = points.values(points.chunk(number))
        possible = scene_of_points(study, values, points.size(number)).possible
        if possible.any():
            first = np.flatnonzero(possible)[:1]
            return {key: array[first] if array.ndim else array for key, array in values.items()}
    return None


def base_scene(study: Study) -> Scene | BearingSet | None:
    """The study's scene at the first possible point of the axes, random keys at their medians; None: none is possible.

    Raises:
        SceneFileError: what is wrong with the study whatever the point.
    """
    base = possible_point(study, {each.key: each.at(np.asarray(0.5)) for each in study.distributions})
    return None if base is None else _scene(study, {key: array.ravel()[0] for key, array in base.items()})


def check(study: Study) -> Scene | BearingSet | None:
    """The study's scene at one possible point, after a look at all that can be wrong with the study as a whole.

    Returns:
        None: no combination of the axes' values describes a bearing.

    Raises:
        SceneFileError: everything that is wrong whatever the point; every distribution that at no point of the axes
            stays, but for its tails, within what is possible.
    """
    check_base(study)
    middle = {each.key: each.at(np.asarray(0.5)) for each in study.distributions}
    base = possible_point(study, middle)
    if base is None and study.distributions:
        first = {each.key: np.asarray(each.values[0]) for each in study.variables if isinstance(each, Axis)}
        return _scene(study, first | middle)  # which says what is wrong with it
    if base is None:
        return None
    errors: list[FileErrorDetail] = []
    of_balls: set[tuple[Any, ...]] = set()
    for each in study.distributions:
        if keys.known(each.key).ball is not None:
            if (each.kind, each.parameters) in of_balls:
                continue  # as another ball's, which tells
            of_balls.add((each.kind, each.parameters))
        for end, name in ((TAIL, "1 %"), (1.0 - TAIL, "99 %")):
            value = each.at(np.asarray(end))
            try:
                _scene(study, base | {each.key: value})
            except SceneFileError as error:
                with suppress(SceneFileError):  # wrong at every point of the axes
                    if possible_point(study, middle | {each.key: value}):
                        continue
                problem = f"the distribution leaves the possible: at its {name} quantile, {float(value):.6g}"
                errors.append(FileErrorDetail(f"vary.{each.key}", problem, cause=_in_short(error)))
    if errors:
        raise SceneFileError(study.file, errors)
    return scene_of_points(study, base, 1).scene


def _in_short(error: SceneFileError) -> str:
    first = error.errors[0]
    if not isinstance(first, FileErrorDetail):
        return str(first)
    return ": ".join(filter(None, (first.key, first.problem, first.detail)))


def check_base(study: Study) -> None:
    """See that what the document gives for the keys that vary could be, though no point may have it.

    Raises:
        SceneFileError: what could not be at the document's other values, nor at those of the first possible point.
    """
    try:
        _scene(study, {})
        return
    except SceneFileError as error:
        own = {each.key: each for each in error.errors if isinstance(each, FileErrorDetail)}
    given = [each.key for each in study.variables if own and _is_given(study.document, keys.known(each.key).path)]
    base = possible_point(study, {each.key: each.at(np.asarray(0.5)) for each in study.distributions}) if given else {}
    wrong = []
    for name in given:
        try:
            _scene(study, {key: array.ravel()[0] for key, array in (base or {}).items() if key != name})
        except SceneFileError as error:
            at = ".".join(keys.known(name).path)
            found: list[Any] = [each for each in error.errors if getattr(each, "key", "") == at]
            wrong += [replace(each, note=OWN_VALUE) for each in found]
    if wrong:
        raise SceneFileError(study.file, wrong)


def _is_given(document: dict[str, Any], path: tuple[str, ...]) -> bool:
    table: Any = document
    for step in path:
        if not isinstance(table, dict) or step not in table:
            return False
        table = table[step]
    return True


def label_of(scene: Scene | BearingSet | None) -> str:
    """What a study is of."""
    if isinstance(scene, BearingSet):
        return scene.name or "a set"
    return (scene and scene.bearing.name) or "a bearing"


def _scene(study: Study, values: dict[str, NDArray]) -> Scene | BearingSet:
    document = copy.deepcopy(study.document)
    deviations: dict[int, NDArray] = {}
    for name in sorted(values, key=lambda each: len(COEFFICIENTS.get(each, ())), reverse=True):  # of both grooves first
        key = keys.known(name)
        if key.ball is None:
            _put(document, study, key, values[name])
        else:
            deviations[key.ball] = values[name]
    if deviations:
        _put_deviations(document, deviations)
    made = set_of if is_set(document) else scene_of
    return made(document, study.file, study.label)


def _from_catalogue(study: Study, key: str) -> Any:
    bearing = study.document.get("bearing", {})
    name = bearing.get("name") if isinstance(bearing, dict) else None
    entry = catalogue.find(name) if isinstance(name, str) else None
    return entry.bearing.get(key) if entry else None


def _put(document: dict[str, Any], study: Study, key: keys.StudyKey, value: NDArray) -> None:
    table = document
    for step in key.path[:-1]:
        inner = table.get(step)
        if step in MATERIALS and not isinstance(inner, dict):
            inner = _material_table(study, step)
        table[step] = table = inner if isinstance(inner, dict) else {}
    table[key.path[-1]] = _plain(value)
    for path in key.replaces:
        name, _, replaced = path.partition(".")
        if is_set(document) and name != key.path[0]:
            continue  # a set's preload leaves the shaft its axial channel
        other = document.get(name)
        if isinstance(other, dict) and other.pop(replaced, None) is not None and not other:
            del document[name]


def _put_deviations(document: dict[str, Any], deviations: dict[int, NDArray]) -> None:
    """Deviations of some balls' diameters, in addition to those that the document gives; else none."""
    effects = document.get("effects")
    table = document["effects"] = effects if isinstance(effects, dict) else {}
    given = table.get(BALL_DEVIATIONS.name)
    of_document = given if isinstance(given, list) else []
    count = max(ball_count_of(document), len(of_document), max(deviations) + 1)
    columns = [deviations.get(ball, [*of_document, *[0.0] * count][ball]) for ball in range(count)]
    table[BALL_DEVIATIONS.name] = np.stack(np.broadcast_arrays(*columns), axis=-1).astype(float)


def _plain(value: ArrayLike) -> Any:
    array = np.asarray(value)
    return array if array.ndim else float(array)


def _material_table(study: Study, side: str) -> dict[str, Any]:
    """The numbers of a material that the file, or the catalogue, calls by name."""
    name = study.document.get("bearing", {}).get(side, _from_catalogue(study, side))
    material = material_named(name) if isinstance(name, str) else None
    if material is None:
        return {}
    found = {key: getattr(material, key.field) for key in MATERIAL}
    return {key.name: key.in_file(value) for key, value in found.items() if value is not None}
