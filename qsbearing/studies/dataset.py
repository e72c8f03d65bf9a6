"""The results of a study as one xarray Dataset: units, coordinates, and what it was made from."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.scene_tables import input_tables
from qsbearing.model.solution.status import Reason
from qsbearing.model.version import __version__
from qsbearing.results.provenance import commit
from qsbearing.studies import keys
from qsbearing.studies.chunk import STATUSES, Chunk, Plan
from qsbearing.studies.points import Points
from qsbearing.studies.remarked import attributes as of_remarks
from qsbearing.studies.remarked import together
from qsbearing.studies.scenes import base_scene, label_of

if TYPE_CHECKING:
    import xarray

BALL = "ball"

FORMAT = 1
"""Of a results file; another number is refused by what reads it."""


def variables_of(plan: Plan, points: Points) -> dict[str, tuple[tuple[str, ...], Any, dict[str, Any]]]:
    """For each variable of the results its dimensions, type and attributes."""
    dims = points.dims
    variables: dict[str, tuple[tuple[str, ...], Any, dict[str, Any]]] = {
        "status": (dims, np.int8, _flags(STATUSES)),
        "reason": (dims, np.int16, {"long_name": "why there is no equilibrium, or no bearing"}),
        "iterations": (dims, np.int32, {"units": "1"}),
        "residual": (dims, np.float64, {"units": "1", "long_name": "largest imbalance over the largest force"}),
    }
    for result in plan.results:
        own = (*dims, BALL) if result.is_per_ball else dims
        variables[result.name] = (own, np.float64, result.attributes | {"column": result.column})
    return variables


def arrays_of(chunk: Chunk, reasons: tuple[str, ...]) -> dict[str, NDArray]:
    """A chunk's arrays under the variables' names; reasons counted along those of the whole study."""
    number = np.array([reasons.index(reason) for reason in chunk.reasons], np.int16)
    return {
        "status": chunk.status,
        "reason": number[chunk.reason],
        "iterations": chunk.iterations,
        "residual": chunk.residual,
        **chunk.results,
    }


def all_reasons(chunks: Iterable[tuple[str, ...]]) -> tuple[str, ...]:
    """The reasons of all chunks in one order, whatever the order of the chunks."""
    known = ("", *map(str, Reason))
    return (*known, *sorted({reason for reasons in chunks for reason in reasons} - set(known)))


def attributes(plan: Plan) -> dict[str, Any]:
    """What the results were made from: the study, and all of its scene at one point."""
    scene = base_scene(plan.study)
    attrs = {
        "Conventions": "CF-1.11",
        "title": f"Study of {label_of(scene)}",
        "source": f"qsbearing {__version__}",
        "qsbearing_format": FORMAT,
        "qsbearing_version": __version__,
        "study": json.dumps(plan.study.as_data()),
    }
    if scene is not None:
        attrs["input"] = json.dumps(input_tables(scene))
    if plan.chosen is not None:
        attrs["chosen_effects"] = str(plan.chosen)
    revision = commit()
    return attrs | ({"commit": revision} if revision else {})


def reason_attributes(reasons: tuple[str, ...]) -> dict[str, Any]:
    """Flags of the reasons, a word each as the convention has it; `summary.words` makes sentences of them again."""
    return _flags([reason.replace(" ", "_") or "none" for reason in reasons])


def coordinates(
    points: Points, samples: slice = slice(0, 0)
) -> dict[str, tuple[tuple[str, ...], NDArray, dict[str, Any]]]:
    """Every varied key: dimensions, values (of the random ones, at these samples), attributes."""
    coords = {}
    for name, (dims, values) in points.coordinates(samples).items():
        coords[name] = (dims, values, {"units": keys.known(name).unit or "1"})
    return coords


def dataset_of(plan: Plan, points: Points, chunks: dict[int, Chunk]) -> xarray.Dataset:
    """All chunks, in memory; they are taken out of `chunks` one by one, so that nothing is there twice."""
    import xarray

    reasons = all_reasons(chunk.reasons for chunk in chunks.values())
    seen = together(chunks[number].remarks for number in sorted(chunks))
    made = {}
    for name, (dims, kind, attrs) in variables_of(plan, points).items():
        shape = (*points.shape, plan.ball_axis) if dims[-1:] == (BALL,) else points.shape
        made[name] = (dims, np.empty(shape, kind), attrs | (reason_attributes(reasons) if name == "reason" else {}))
    for number in list(chunks):
        chunk = chunks.pop(number)
        for name, values in arrays_of(chunk, reasons).items():
            whole: Any = (*points.chunk(number), ...)  # a view, of a grid without axes too
            block = made[name][1][whole]
            block[...] = values.reshape(block.shape)
    return xarray.Dataset(
        made, coordinates(points, slice(0, points.study.samples)), attributes(plan) | of_remarks(seen, points.count)
    )


def _flags(meanings: Iterable[str]) -> dict[str, Any]:
    words = list(meanings)
    return {"flag_values": np.arange(len(words), dtype=np.int16), "flag_meanings": " ".join(words)}
