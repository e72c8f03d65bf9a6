"""The folder within a ZIP. Of damaged bytes zipfile and what unpacks for it raise almost anything: a sentence here."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from io import BytesIO
from math import inf
from pathlib import Path
from zipfile import ZipFile, ZipInfo

from qsbearing.files.file_errors import SceneFileError, refused

PIECE = 1 << 20
"""Bytes that are unpacked at once."""


@contextmanager
def unzipped(data: bytes, path: Path) -> Iterator[ZipFile]:
    """The folder, while it is read.

    Args:
        path: what to call it in errors.

    Raises:
        SceneFileError: it is no ZIP, or what is read of it is damaged, encrypted, or packed in an unknown way.
    """
    try:
        with ZipFile(BytesIO(data)) as folder:
            yield folder
    except SceneFileError:
        raise
    except Exception as error:  # MemoryError too: damaged bytes ask for any amount
        told = str(error).partition("\n")[0][:200] or type(error).__name__
        raise refused(path, f"cannot be unpacked: {told}", "Is it a damaged file?") from None


def pieces(folder: ZipFile, parts: Iterable[ZipInfo], path: Path, most: float = inf) -> Iterator[bytes]:
    """The bytes of files within the folder, each to its end, at which its checksum is looked at.

    Args:
        most: bytes of them together; the size that a ZIP states of a file may be wrong.

    Raises:
        SceneFileError: there are more.
    """
    size = 0
    for part in parts:
        with folder.open(part) as file:
            while piece := file.read(PIECE):
                size += len(piece)
                if size > most:
                    raise refused(path, f"unpacks to more than {most / 1e6:g} MB")
                yield piece


def rezipped(data: bytes, path: Path, name: str, text: bytes) -> bytes:
    """The ZIP with one of its files replaced; the others, and all dates, as they were.

    Raises:
        SceneFileError: one of the others cannot be unpacked.
    """
    made = BytesIO()
    with unzipped(data, path) as old, ZipFile(made, "w") as new:
        for each in old.infolist():
            same = ZipInfo(each.filename, each.date_time)
            same.compress_type, same.external_attr = each.compress_type, each.external_attr
            new.writestr(same, text if each.filename == name else b"".join(pieces(old, [each], path)))
    return made.getvalue()
