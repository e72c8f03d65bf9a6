"""Pictures of a study's results: lines, maps, roses, distributions, sensitivities and Sobol indices."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING

from qsbearing.pictures.study.azimuth import draw_by_azimuth, draw_roses
from qsbearing.pictures.study.indices import draw_indices
from qsbearing.pictures.study.labels import head, key_words, value_label, without_unit
from qsbearing.pictures.study.lines import curves_of, draw_lines
from qsbearing.pictures.study.maps import draw_maps
from qsbearing.pictures.study.selection import PictureError, PictureKind, Selection, select
from qsbearing.pictures.study.spread import draw_distributions, draw_sensitivities

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from xarray import Dataset

__all__ = ["PictureError", "PictureKind", "picture", "select"]


def picture(
    results: Dataset,
    x: str | None = None,
    y: Sequence[str] = (),
    kind: str | None = None,
    at: dict[str, float] | None = None,
) -> Figure:
    """Draw results, or Sobol indices; what is not chosen is what suits them. The arguments are those of `select`.

    Raises:
        PictureError: a name that is not there, or a kind that these results do not allow.
    """
    if "first_order" in results:
        if x or kind or at:
            raise PictureError("Sobol indices are one kind of picture, without axes; -y alone chooses what is shown")
        figure = draw_indices(results, y)
        head(figure, str(results.attrs["title"]).removeprefix("Study of "))
        return figure
    chosen = select(results, x, y, kind, at)
    if chosen.kind is PictureKind.LINES:
        figure = draw_lines(chosen)
    elif chosen.kind is PictureKind.MAP:
        figure = draw_maps(chosen)
    elif chosen.kind is PictureKind.ROSE:
        figure = draw_roses(chosen)
    elif chosen.kind is PictureKind.AZIMUTH:
        figure = draw_by_azimuth(chosen)
    elif chosen.kind is PictureKind.DISTRIBUTION:
        figure = draw_distributions(chosen)
    else:
        figure = draw_sensitivities(chosen)
    head(figure, _title(chosen))
    return figure


def _title(chosen: Selection) -> str:
    """What was studied: the bearing, what is fixed, what the curves are."""
    scene = json.loads(chosen.results.attrs.get("study", "{}")).get("scene", {})
    label = str(chosen.results.attrs.get("title", "")).removeprefix("Study of ")
    if set(scene.get("bearing", {})) == {"name"}:
        label = label.removesuffix(", modified")  # what is modified is what varies
    if rows := scene.get("rows"):
        common = scene.get("bearing", {}).get("name", "")
        bearings = dict.fromkeys(str(row.get("bearing", {}).get("name", common)) for row in rows)
        label = f"{label}: {len(rows)} rows {' and '.join(filter(None, bearings))}".rstrip()
    parts = [label]
    for name, value in {**scene.get("operation", {}), **scene.get("preload", {})}.items():
        if name not in chosen.results.coords and value and isinstance(value, int | float):
            unit = name.rpartition("_")[2]
            parts.append(f"{without_unit(name, unit)} {value:.6g} {unit}")
    for values in chosen.results.coords.values():
        if values.ndim == 0 and float(values) != 0.0:
            parts.append(f"{key_words(values)} {value_label(values, float(values))}")
    if chosen.kind in (PictureKind.ROSE, PictureKind.AZIMUTH):
        parts.append(f"by {key_words(chosen.results[chosen.x])}")
    if chosen.kind is PictureKind.LINES:
        parts.append(curves_of(chosen))
    return ", ".join(filter(None, parts))
