"""A result as the input that it was made from: what `run --json` printed, and a sweep's netCDF file."""

from __future__ import annotations

import json
import warnings
from pathlib import Path
from typing import Any

from qsbearing import __version__
from qsbearing.io.file_errors import SceneFileError, refused
from qsbearing.io.read_toml import read_text
from qsbearing.validation import printable

ENDINGS = (".json", ".nc")
LARGEST_RESULT = 50_000_000
"""Bytes; a row of a thousand balls takes one million."""


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
    if version != __version__:
        said = f"{path}: made by qsbearing {version}; this is {__version__}, whose numbers may differ"
        warnings.warn(printable(said), OtherVersionWarning, stacklevel=2)
    return document, printable(str(label or ""))


def _of_json(path: Path) -> tuple[Any, Any, Any]:
    """Version, input and label."""
    try:
        found = json.loads(read_text(path, LARGEST_RESULT))
    except (ValueError, RecursionError) as error:
        if isinstance(error, SceneFileError):
            raise
        raise refused(path, f"is not JSON: {str(error) or 'nested too deeply'}") from None
    found = found if isinstance(found, dict) else {}
    return found.get("version"), found.get("input"), found.get("set") or found.get("bearing")


def _of_netcdf(path: Path, of_study: bool) -> tuple[Any, Any, Any]:
    """Likewise."""
    try:
        import h5netcdf
    except ImportError:
        raise refused(path, "cannot be read", "It needs h5netcdf: pip install 'qsbearing[studies]'") from None
    try:
        with h5netcdf.File(path, "r") as file:
            kept = {name: json.loads(file.attrs.get(name, "null")) for name in ("study", "input")}
            version = file.attrs.get("qsbearing_version")
    except (OSError, ValueError, TypeError, KeyError) as error:
        problem = "no such file" if isinstance(error, FileNotFoundError) else "is not a netCDF file, or is damaged"
        raise refused(path, problem) from None
    study = kept["study"] if isinstance(kept["study"], dict) else {}
    whole = study.get("scene")
    if of_study and isinstance(whole, dict):
        return version, {**whole, "vary": study.get("vary"), "study": study.get("study")}, study.get("label")
    return version, None if of_study else kept["input"], study.get("label")
