"""What a netCDF file says of itself; of damaged bytes HDF5 and the packages on it raise almost anything."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from qsbearing.documents.installation import pip_install
from qsbearing.files.file_errors import SceneFileError, refused
from qsbearing.files.json_text import parsed
from qsbearing.files.raw import check_regular

WHAT = "a netCDF file"


def attributes_of(path: Path, names: tuple[str, ...]) -> dict[str, Any]:
    """Those of these attributes that the file has.

    Raises:
        SceneFileError: it cannot be read.
    """
    check_regular(path, WHAT)
    try:
        import h5netcdf
    except ImportError:
        raise refused(path, "cannot be read", f"It needs h5netcdf: {pip_install('studies')}") from None
    with damage_told(path), h5netcdf.File(path, "r") as file:
        return {name: file.attrs[name] for name in names if name in file.attrs}


def json_of(attribute: Any, path: Path) -> Any:
    """What an attribute holds as JSON; None where there is none.

    Raises:
        SceneFileError: it is not JSON.
    """
    if attribute is None:
        return None
    if not isinstance(attribute, str):
        raise refused(path, "is damaged: an attribute that must be a text is none")
    return parsed(attribute.encode("utf-8", "replace"), path)


@contextmanager
def damage_told(path: Path) -> Iterator[None]:
    """Whatever reading raises, as the sentence that the file is damaged."""
    try:
        yield
    except (SceneFileError, MemoryError):
        raise
    except Exception as error:
        told = str(error).partition("\n")[0][:200] or type(error).__name__
        _let_go(error)
        raise refused(path, "is not a netCDF file, or is damaged", told) from None


def _let_go(error: BaseException | None) -> None:
    """Drop a file that was half opened now, in silence: h5netcdf cannot close it, and Python would show that later."""
    hook, sys.unraisablehook = sys.unraisablehook, lambda *_: None
    try:
        while error is not None:
            traceback.clear_frames(error.__traceback__)
            error = error.__context__
    finally:
        sys.unraisablehook = hook
