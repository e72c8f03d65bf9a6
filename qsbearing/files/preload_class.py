"""A preload by its class: light, medium or heavy, as the catalogue's source prints them of a bearing."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from qsbearing.files.bearing_table import ReadBearing
from qsbearing.files.file_errors import FileErrorDetail
from qsbearing.files.table_checks import Errors, did_you_mean

CLASSES = ("light", "medium", "heavy")


def preload_table(document: dict[str, Any], common: ReadBearing, of_rows: Iterable[ReadBearing], errors: Errors) -> Any:
    """The table [preload] of a file, or what its class stands for, a word at the top of the file or in [bearing]; None
    where there is none, or the class has no force."""
    table, path, word = document.get("preload"), "bearing.preload", common.preload_class
    if word is None and isinstance(table, str):
        table, path, word = None, "preload", table
    if word is None:
        return table
    if table is not None:
        cause = "Keep one of the two: each sets the force that presses the bearing"
        errors.append(FileErrorDetail(path, "is given together with [preload]", word, cause=cause))
        return None
    if word not in CLASSES:
        cause = did_you_mean(word, CLASSES) or f"One of {', '.join(CLASSES)}; a force in N is given in [preload]"
        errors.append(FileErrorDetail(path, "is no preload class", word, cause=cause))
        return None
    bearings = [each for each in (common, *of_rows) if each.is_table]
    if any("name" in each.unusable for each in bearings):
        return None  # one mistake
    entries = {each.name: each.entry for each in bearings}
    forces = {None if each is None else each.dimensions.get(f"preload_{word}_N") for each in entries.values()}
    if len(forces) == 1 and (force := forces.pop()) is not None:
        return {"rigid_N": force}
    which = "the rows' bearings differ" if len(entries) > 1 else f"none are known of {next(iter(entries), '')!r}"
    cause = (
        f"The catalogue's spindle bearings have classes; {which}. Give the force in [preload], such as rigid_N = 300"
    )
    errors.append(FileErrorDetail(path, "is a class without a force", word, cause=cause))
    return None
