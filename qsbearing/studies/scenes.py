"""From the values of a chunk's points to one scene that holds the possible ones, and why the others are none."""

from __future__ import annotations

import copy
from contextlib import suppress
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.files import paths
from qsbearing.files.file_errors import FileErrorDetail, SceneFileError
from qsbearing.files.keys import BALL_DEVIATIONS, COEFFICIENTS
from qsbearing.files.scene_file import scene_of
from qsbearing.files.scene_or_set import is_set
from qsbearing.files.set_file import set_of
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


class ScenePoints(NamedTuple):
    """Points that are the cases of one scene or set."""

    scene: Scene | BearingSet
    """Over these points, one case axis."""
    points: NDArray
    """Their numbers."""
    is_looked_at: bool = True
    """Whether remarks are looked for at them."""


class PossibleScenes(NamedTuple):
    """The scenes of those points of a chunk that describe a bearing: one, unless numbers vary that make another set."""

    parts: tuple[ScenePoints, ...]
    possible: NDArray
    """Which they are; shape (point,)."""
    reason: NDArray
    """Why a point is impossible, as an index of `reasons`, from 1; 0 where it is possible; shape (point,)."""
    reasons: tuple[str, ...]
    """`key: what is wrong with it`."""


def scenes_of_points(
    study: Study, values: dict[str, NDArray], count: int, looked: NDArray | None = None
) -> PossibleScenes:
    """The scenes of these points.

    Args:
        looked: numbers of points that make scenes of their own.

    Raises:
        SceneFileError: what is wrong with the study whatever the point.
    """
    scenes = PossibleScenes((), np.ones(count, bool), np.zeros(count, np.int16), ())
    apart = _apart(study)
    varied = [values[key] for key in apart if values[key].ndim]
    groups = [np.arange(count)]
    if varied:
        number = np.unique(np.stack(varied), axis=1, return_inverse=True)[1].ravel()
        groups = np.split(np.argsort(number, kind="stable"), np.cumsum(np.bincount(number))[:-1])
    is_looked = np.ones(count, bool) if looked is None else np.isin(np.arange(count), looked)
    groups = [some for group in groups for some in (group[is_looked[group]], group[~is_looked[group]]) if some.size]
    for points in groups:
        own = {key: array[points] if array.ndim else array for key, array in values.items()}
        own |= {key: own[key].ravel()[0] for key in apart}
        scenes = _with_scene(study, own, points, scenes, bool(apart), bool(is_looked[points[0]]))
    return scenes


def _apart(study: Study) -> list[str]:
    """Keys that vary and of which no scene can have many values."""
    named = (each.key for each in study.variables)
    return [key for key in named if not paths.spans_cases(keys.known(key).path, study.document)]


def _with_scene(
    study: Study,
    values: dict[str, NDArray],
    points: NDArray,
    scenes: PossibleScenes,
    by_value: bool,
    is_looked: bool,
) -> PossibleScenes:
    """With the scene of some points that one scene can hold, or why there is none.

    Args:
        by_value: whether what is wrong with all of these points may be right at others.
    """
    possible, reasons = np.ones(points.size, bool), list(scenes.reasons)
    parts = scenes.parts
    while possible.any():
        kept = {key: array[possible] if array.ndim else array for key, array in values.items()}
        try:
            scene = _over_one_axis(_scene(study, kept), int(possible.sum()))
            parts = (*parts, ScenePoints(scene, points[possible], is_looked))
            break
        except SceneFileError as error:
            wrong = [each for each in error.errors if isinstance(each, FileErrorDetail)]
            # What no varied array has a part in is wrong at the other points too.
            whatever_the_point = [each for each in wrong if each.where is None or np.ndim(each.where) == 0]
            if whatever_the_point and not by_value:
                raise SceneFileError(study.file, whatever_the_point) from None
            numbers = np.flatnonzero(possible)
            for each in whatever_the_point or wrong:
                is_of_all = each.where is None or np.ndim(each.where) == 0
                concerned = numbers if is_of_all else numbers[np.broadcast_to(np.asarray(each.where), numbers.shape)]
                text = f"{each.key}: {each.problem}"
                if text not in reasons:
                    reasons.append(text)
                fresh = concerned[possible[concerned]]
                scenes.reason[points[fresh]] = reasons.index(text) + 1
                possible[fresh] = False
    scenes.possible[points] = possible
    return scenes._replace(parts=parts, reasons=tuple(reasons))


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
        possible = scenes_of_points(study, values, points.size(number)).possible
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
        _raise_common(study)
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
    return scenes_of_points(study, base, 1).parts[0].scene


def _raise_common(study: Study) -> None:
    """See that where other values make other sets and none is possible, they have not all the same fault."""
    axes = [each for each in study.variables if isinstance(each, Axis)]
    common: dict[str, Any] = {}
    for end in (0, -1) if _apart(study) else ():
        try:
            _scene(study, {each.key: np.asarray(each.values[end]) for each in axes})
        except SceneFileError as error:
            own = {str(each): each for each in error.errors}
            common = own if end == 0 else {text: each for text, each in common.items() if text in own}
    if common:
        raise SceneFileError(study.file, common.values())


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
    given = [
        each.key
        for each in study.variables
        if own and paths.value_at(study.document, keys.known(each.key).path) is not None
    ]
    base = possible_point(study, {each.key: each.at(np.asarray(0.5)) for each in study.distributions}) if given else {}
    wrong = []
    for name in given:
        try:
            _scene(study, {key: array.ravel()[0] for key, array in (base or {}).items() if key != name})
        except SceneFileError as error:
            at = ".".join(keys.known(name).path)
            errors: list[Any] = [each for each in error.errors if getattr(each, "key", "") == at]
            wrong += [replace(each, note=OWN_VALUE) for each in errors]
    if wrong:
        raise SceneFileError(study.file, wrong)


def label_of(scene: Scene | BearingSet | None) -> str:
    """What a study is of."""
    if isinstance(scene, BearingSet):
        return scene.name or "a set"
    return (scene and scene.bearing.name) or "a bearing"


def _scene(study: Study, values: dict[str, NDArray]) -> Scene | BearingSet:
    document = copy.deepcopy(study.document)
    deviations: dict[int, NDArray] = {}
    varied = sorted(map(keys.known, values), key=lambda each: len(COEFFICIENTS.get(each.path[-1], ())), reverse=True)
    for key in varied:  # of both grooves first
        if key.ball is None:
            _put(document, key, values[key.name])
        else:
            deviations[key.ball] = values[key.name]
    if deviations:
        _put_deviations(document, deviations)
    made = set_of if is_set(document) else scene_of
    return made(document, study.file, study.label)


def _put(document: dict[str, Any], key: keys.StudyKey, value: NDArray) -> None:
    paths.put(document, key.path, _plain(value))
    for other in keys.replaced(key, document):
        paths.take_out(document, other)


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
