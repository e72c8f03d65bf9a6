"""A result as the input that it was made from: what `run --json` printed, and a sweep's netCDF file."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

from qsbearing.files.file_errors import refused
from qsbearing.files.json_text import parsed
from qsbearing.files.limits import LARGEST_RESULT
from qsbearing.files.netcdf import attributes_of, json_of
from qsbearing.files.raw import read_bytes
from qsbearing.files.toml import check_tables
from qsbearing.model.validation import printable
from qsbearing.model.version import __version__

ENDINGS = (".json", ".nc")


class OtherVersionWarning(UserWarning):
    """A result was made by another version than the one that reproduces it."""


def input_of(path: Path, of_study: bool) -> tuple[dict[str, Any], str]:
    """The tables of the file that a result was made from, and the label of its bearing.

    Args:
        of_study: of a sweep the tables of its study; else those of its first possible point.

    Raises:
        SceneFileError: it is no result, or of a version that did not keep its input.
    """
    is_sweep = path.suffix.lower() == ".nc"
    version, document, label = _of_netcdf(path, of_study) if is_sweep else _of_json(path)
    if not isinstance(document, dict):
        cause = "`qsbearing run --json` and `sweep --out FILE.nc` write one; results of older versions have none"
        raise refused(path, "holds no input that it could be reproduced from", cause)
    check_tables(document, path)
    if version != __version__:
        said = f"{path}: made by qsbearing {version}; this is {__version__}, whose numbers may differ"
        warnings.warn(printable(said), OtherVersionWarning, stacklevel=2)
    return document, printable(str(label or ""))


def _of_json(path: Path) -> tuple[Any, Any, Any]:
    """Version, input and label."""
    result = parsed(read_bytes(path, LARGEST_RESULT, "a result"), path)
    result = result if isinstance(result, dict) else {}
    return result.get("version"), result.get("input"), result.get("set") or result.get("bearing")


def _of_netcdf(path: Path, of_study: bool) -> tuple[Any, Any, Any]:
    """Likewise."""
    attributes = attributes_of(path, ("study", "input", "qsbearing_version"))
    kept = {name: json_of(attributes.get(name), path) for name in ("study", "input")}
    version = attributes.get("qsbearing_version")
    study = kept["study"] if isinstance(kept["study"], dict) else {}
    whole = study.get("scene")
    if of_study and isinstance(whole, dict):
        own = {name: study[name] for name in ("vary", "study") if study.get(name) is not None}
        return version, whole | own, study.get("label")
    return version, None if of_study else kept["input"], study.get("label")
