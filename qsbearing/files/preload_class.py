"""A preload by its class: light, medium or heavy, as the catalogue's source prints them of a bearing."""

from __future__ import annotations

from typing import Any

from qsbearing.files import catalogue
from qsbearing.files.file_errors import FileErrorDetail
from qsbearing.files.table_checks import Errors, did_you_mean

CLASSES = ("light", "medium", "heavy")


def with_preload_class(document: dict[str, Any], errors: Errors) -> dict[str, Any]:
    """The tables of a file with the force of a preload class in place of its word, as a rigid preload.

    The word stands at the top of the file or in [bearing].
    """
    bearing, preload = document.get("bearing"), document.get("preload")
    if isinstance(bearing, dict) and "preload" in bearing:
        path, word = "bearing.preload", bearing["preload"]
        without = {key: value for key, value in bearing.items() if key != "preload"}
        document = {**document, "bearing": without, "preload": preload}
    elif isinstance(preload, str):
        path, word = "preload", preload
        document = {**document, "preload": None}
    else:
        return document
    if path != "preload" and preload is not None:
        cause = "Keep one of the two: each sets the force that presses the bearing"
        errors.append(FileErrorDetail(path, "is given together with [preload]", word, cause=cause))
    elif word not in CLASSES:
        cause = did_you_mean(word, CLASSES) or f"One of {', '.join(CLASSES)}; a force in N is given in [preload]"
        errors.append(FileErrorDetail(path, "is no preload class", word, cause=cause))
    else:
        document["preload"] = _force(document, path, word, errors)
    return document


def _force(document: dict[str, Any], path: str, word: str, errors: Errors) -> dict[str, float] | None:
    rows = document.get("rows")
    holders = [document, *(row for row in rows if isinstance(row, dict))] if isinstance(rows, list) else [document]
    tables = [each["bearing"] for each in holders if isinstance(each.get("bearing"), dict)]
    names = {str(each.get("name", "")) for each in tables}
    entries = [catalogue.find(name) for name in names]
    forces = {None if entry is None else entry.dimensions.get(f"preload_{word}_N") for entry in entries}
    if len(forces) == 1 and (force := forces.pop()) is not None:
        return {"rigid_N": force}
    which = "the rows' bearings differ" if len(names) > 1 else f"none are known of {names.pop() if names else ''!r}"
    cause = (
        f"The catalogue's spindle bearings have classes; {which}. Give the force in [preload], such as rigid_N = 300"
    )
    errors.append(FileErrorDetail(path, "is a class without a force", word, cause=cause))
    return None
