"""What of a study's results goes on a picture, and how it is arranged; good defaults, any of which may be chosen."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from qsbearing.files.block_statistics import blocks, varies_from_zero
from qsbearing.model.solution.groups import CONTACT_LOAD, CONTACTS
from qsbearing.model.solution.result_keys import SIZE, Group, Place, place_of
from qsbearing.model.validation import alike, question
from qsbearing.pictures.study.labels import label_in, place_named
from qsbearing.systems.sets.set_groups import AXIAL_LOAD

if TYPE_CHECKING:
    from xarray import Dataset

SAMPLE, BALL = "sample", "ball"
MOST_CURVES = 8
"""More values than this along a second axis make a map, not curves."""


class PictureKind(StrEnum):
    """Of a picture."""

    LINES = "lines"
    """Results against one key, a curve for each value of another."""
    MAP = "map"
    """Contours over two keys."""
    ROSE = "rose"
    """Contact loads around the bearing."""
    AZIMUTH = "azimuth"
    """Results of each ball by its azimuth."""
    DISTRIBUTION = "distribution"
    """Histograms over the samples."""
    SENSITIVITY = "sensitivity"
    """Which random key each result follows."""


class PictureError(ValueError):
    """What was asked for cannot be drawn; a sentence."""


@dataclass(frozen=True)
class Selection:
    """Results with all axes chosen: x, the curves' or the map's other axis, samples and balls."""

    results: Dataset
    kind: PictureKind
    x: str
    other: str
    """The second axis; empty where there is none."""
    panels: tuple[tuple[str, ...], ...]
    """Names of the results on each panel."""
    fixed: dict[str, float]
    """Keys of further axes, and the value that is shown."""


def select(
    results: Dataset,
    x: str | None = None,
    y: Sequence[str] = (),
    kind: str | None = None,
    at: dict[str, float] | None = None,
) -> Selection:
    """Arrange results for a picture.

    Args:
        x: key along the horizontal axis; the longest axis if not given.
        y: results to show; if not given, those that the study names, else angles, loads and stiffness, or what tells
            most on a map.
        kind: of the picture, if not the one that suits the axes.
        at: for keys of further axes, the value to show; their first if not given.

    Raises:
        PictureError: a name that is not there, or a kind that these axes do not allow.
    """
    axes = [str(dim) for dim in results["status"].dims if dim != SAMPLE]
    for name in (*(at or {}), *([x] if x else [])):
        if name not in axes:
            meant = question(alike(name, axes))
            raise PictureError(f"{name} is not an axis of these results: {', '.join(axes) or 'none'}. {meant}".rstrip())
    fixed = {}
    for name, value in (at or {}).items():
        along = results[name].values
        number = int(np.abs(along - value).argmin())
        if not np.isclose(along[number], value):
            raise PictureError(f"{name} = {value:g} is not among its values; the nearest is {along[number]:g}")
        fixed[name] = float(along[number])
    free = [name for name in axes if name not in fixed]
    across = x or max(free, key=lambda name: results.sizes[name], default="")
    others = sorted((name for name in free if name != across), key=lambda name: -results.sizes[name])
    other = others[0] if others else ""
    chosen = _kind(results, kind, across, other)
    if chosen in (PictureKind.DISTRIBUTION, PictureKind.SENSITIVITY):
        across = other = ""  # over the samples alone, at one value of every axis
    fixed |= {name: float(results[name].values[0]) for name in free if name not in (across, other)}
    results = results.sel(fixed)
    return Selection(results, chosen, across, other, _panels(results, chosen, y), fixed)


def _kind(results: Dataset, kind: str | None, x: str, other: str) -> PictureKind:
    has_samples = SAMPLE in results["status"].dims
    if kind is None:
        if not x:
            return PictureKind.DISTRIBUTION
        is_map = other and results.sizes[other] > MOST_CURVES and not has_samples
        return PictureKind.MAP if is_map else PictureKind.LINES
    if kind not in list(PictureKind):
        raise PictureError(f"{kind} is not a kind of picture: {', '.join(PictureKind)}")
    if kind == PictureKind.MAP and not other:
        raise PictureError("a map needs two axes")
    if kind in (PictureKind.DISTRIBUTION, PictureKind.SENSITIVITY) and not has_samples:
        raise PictureError(f"a picture of the kind {kind} needs keys that vary at random")
    if kind == PictureKind.LINES and not x:
        raise PictureError("lines need an axis: a key that takes listed values or a range")
    if kind == PictureKind.AZIMUTH and ("azimuth" not in results or not x):
        raise PictureError("a picture by azimuth needs an axis, and the result azimuth of every ball")
    if kind == PictureKind.ROSE and "inner_load" not in results:
        raise PictureError("a rose needs the results inner_load and outer_load of every ball")
    return PictureKind(kind)


def _panels(results: Dataset, kind: PictureKind, y: Sequence[str]) -> tuple[tuple[str, ...], ...]:
    known = [str(name) for name in results.data_vars if name not in ("status", "reason")]
    names = list(y) or _default(results, kind)
    if not set(names) <= set(known):
        full = {str(results[name].attrs.get("column", name)): name for name in known} | {name: name for name in known}
        names = [full.get(each) or full.get(_in_full(each, full), each) for each in names]
    for name in names:
        if name not in known:
            raise PictureError(
                f"{name} is not a result in this file. {question(alike(name, known)) or ', '.join(known)}"
            )
    if not names:
        raise PictureError("no point of these results is solved: status and reason say why")
    panels: dict[str, list[str]] = {}
    for name in names:
        key = (
            f"{label_in(results, name).shared} {results[name].attrs.get('units', '')}"
            if kind in (PictureKind.LINES, PictureKind.AZIMUTH)
            else name
        )
        panels.setdefault(key, []).append(name)
    return tuple(map(tuple, panels.values()))


def _default(results: Dataset, kind: PictureKind) -> list[str]:
    """What the study names; else what most readers want, and of it what is there and not zero everywhere."""
    if requested := [name for name in _named(results) if kind is not PictureKind.AZIMUTH or BALL in results[name].dims]:
        return requested
    if kind is PictureKind.MAP:
        names = ["inner_max_pressure", "outer_max_pressure", "outer_required_friction", "balls_off_inner"]
        names += ["ring_effective_stiffness_axial"]
    elif kind is PictureKind.AZIMUTH:
        names = ["inner_angle", "outer_angle", "inner_load", "outer_load"]
    elif loads := [place for name in results if (place := place_named(str(name))) and place.group is AXIAL_LOAD]:
        largest = [Place(group, CONTACT_LOAD, each.row, "max").name for group in CONTACTS for each in loads]
        names = [*_of_tool(results), *(each.name for each in loads), *largest, "shaft_effective_stiffness_axial"]
    else:
        names = ["inner_angle", "outer_angle", "inner_load", "outer_load", "ring_effective_stiffness_axial"]
        if _varies(results, "ring_load_radial_y"):
            names.append("ring_effective_stiffness_radial_y")
    every = [each for name in names for each in (name, *_over_balls(name))]
    varying = [each for each in every if _varies(results, each)]
    if kind in (PictureKind.DISTRIBUTION, PictureKind.SENSITIVITY) or not varying:
        varying += [str(name) for name in results.data_vars if name not in (*varying, *_NOT_RESULTS)]
        varying = [name for name in varying if _varies(results, name)][:6]
    return varying


def _of_tool(results: Dataset) -> list[str]:
    """Stiffness and deflection across the shaft at its first named point, such as the tool; none without one."""
    scene = json.loads(results.attrs.get("study", "{}")).get("scene", {})
    shaft = scene.get("shaft", {}) if isinstance(scene, dict) else {}
    point = next(iter(shaft.get("points", {})), "").removesuffix("_mm")
    kinds = ("effective_stiffness", "displacement") if point else ()
    return [f"{point}_{kind}_{name}" for kind in kinds for name in ("radial_y", "radial_z")]


def _in_full(name: str, full: Iterable[str]) -> str:
    """The result that a name means, as people write it."""
    dotless = name.replace(".", "_")
    places = (place for each in full if (place := place_named(each)) is not None)
    meant = place_of(name, *_groups(places))
    return dotless if meant is None else meant.name


def _groups(places: Iterable[Place]) -> tuple[list[Group], list[Group]]:
    """Of the whole, and of rows."""
    several = [*places]
    return [each.group for each in several if not each.row], [each.group for each in several if each.row]


def _over_balls(name: str) -> list[str]:
    """Of a result that each ball may have, the maximum and the minimum."""
    place = place_named(name)
    return [] if place is None else [each.name for each in place.overs if each.over != SIZE]


def _named(results: Dataset) -> list[str]:
    """The results that the study asks for by name; none where it keeps all."""
    named = json.loads(results.attrs.get("study", "{}")).get("study", {}).get("quantities", [])
    return [str(name) for name in results.data_vars if named and (name in named or name not in _NOT_RESULTS)]


_NOT_RESULTS = ("status", "reason", "iterations", "residual", "azimuth", "inner_raceway_controls")


def _varies(results: Dataset, name: str) -> bool:
    if name not in results:
        return False
    return varies_from_zero(partial(blocks, results[name]))
