"""A file of REXS: XML, JSON, or a ZIP with one of them, told by what it holds; bounded, for it comes from strangers."""

from __future__ import annotations

from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path
from typing import Any
from zipfile import BadZipFile, ZipFile, ZipInfo
from zlib import error as ZlibError  # noqa: N812 - as it is used

from qsbearing.files.file_errors import SceneFileError, refused
from qsbearing.files.limits import LARGEST_MODEL
from qsbearing.files.raw import decoded, read_bytes
from qsbearing.files.rexs import json_form, xml_form
from qsbearing.files.rexs.model import Model, Span, model_of

ENDINGS = (".rexs", ".rexsj", ".xml", ".json")
MOST_PARTS = 1000
_MARK = b"\xef\xbb\xbf"


@dataclass(frozen=True)
class Source:
    """The text of a model, and what it was taken from."""

    path: Path
    text: bytes
    """UTF-8, without a byte-order mark."""
    mark: bytes
    """The byte-order mark, where there is one."""
    part: str = ""
    """The name of the text within the ZIP `packed`."""
    packed: bytes = b""

    @property
    def is_json(self) -> bool:
        return self.text.lstrip()[:1] in (b"{", b"[")

    @property
    def form(self) -> Any:
        """The module that writes such text."""
        return json_form if self.is_json else xml_form

    def edited(self, edits: list[tuple[Span, Any]]) -> bytes:
        """The file with parts of its text replaced, all else as it was.

        Args:
            edits: extents, counted as the form counts them, and their new text.
        """
        text: Any = self.text.decode("utf-8") if self.is_json else self.text
        for (start, end), new in sorted(edits, key=lambda each: each[0], reverse=True):
            text = text[:start] + new + text[end:]
        data = self.mark + (text.encode("utf-8") if self.is_json else text)
        return data if not self.part else _packed(self.packed, self.part, data)


def opened(path: Path) -> Source:
    """The text of a file.

    Raises:
        SceneFileError: it cannot be read, is too large, not UTF-8, or a ZIP without one model.
    """
    data = read_bytes(path, LARGEST_MODEL, "a REXS model")
    if data.startswith(b"PK\x03\x04"):
        try:
            part, text = _unpacked(data, path)
        except (BadZipFile, NotImplementedError, RuntimeError, ZlibError, EOFError) as error:
            raise refused(path, f"cannot be unpacked: {error}") from None
        return replace(_plain(path, text), part=part, packed=data)
    return _plain(path, data)


def model_in(source: Source, with_places: bool = False) -> Model:
    """The model of a text.

    Args:
        with_places: whether the text is to be edited.

    Raises:
        SceneFileError: everything that is wrong with its structure, at once.
    """
    if source.is_json:
        root, spans = json_form.read(source.text, source.path, with_places)
    else:
        root, spans = xml_form.read(source.text, source.path)
    model, errors = model_of(root, spans)
    if errors:
        raise SceneFileError(str(source.path), errors)
    return model


def _plain(path: Path, data: bytes) -> Source:
    decoded(data, path)  # which refuses what is not UTF-8
    if not data.strip():
        raise refused(path, "is empty")
    mark = _MARK if data.startswith(_MARK) else b""
    return Source(path, data[len(mark) :], mark)


def _unpacked(data: bytes, path: Path) -> tuple[str, bytes]:
    with ZipFile(BytesIO(data)) as folder:
        parts = folder.infolist()
        models = [each for each in parts if Path(each.filename).suffix.lower() in ENDINGS]
        if len(parts) > MOST_PARTS or len(models) != 1:
            raise refused(path, f"is a ZIP with {len(models)} models in {len(parts)} files; one is read")
        return models[0].filename, _bounded(folder, models[0], path)


def _packed(data: bytes, part: str, text: bytes) -> bytes:
    """The ZIP with one of its files replaced; the others, and all dates, as they were."""
    made = BytesIO()
    with ZipFile(BytesIO(data)) as old, ZipFile(made, "w") as new:
        for each in old.infolist():
            same = ZipInfo(each.filename, each.date_time)
            same.compress_type, same.external_attr = each.compress_type, each.external_attr
            new.writestr(same, text if each.filename == part else _bounded(old, each, Path(part)))
    return made.getvalue()


def _bounded(folder: ZipFile, part: ZipInfo, path: Path) -> bytes:
    with folder.open(part) as file:
        found = file.read(LARGEST_MODEL + 1)  # the size that it states may be wrong
    if len(found) > LARGEST_MODEL:
        raise refused(path, f"unpacks to more than {LARGEST_MODEL / 1e6:g} MB")
    return found
