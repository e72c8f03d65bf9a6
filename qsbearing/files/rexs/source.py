"""A file of REXS: XML, JSON, or a ZIP with one of them, told by what it holds; bounded, for it comes from strangers."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from qsbearing.files.file_errors import SceneFileError, refused
from qsbearing.files.limits import LARGEST_MODEL
from qsbearing.files.raw import decoded, read_bytes
from qsbearing.files.rexs import json_form, xml_form
from qsbearing.files.rexs.model import Model, Span, model_of
from qsbearing.files.zip_file import pieces, rezipped, unzipped

ENDINGS = (".rexs", ".rexsj", ".xml", ".json")
MOST_PARTS = 1000
LARGEST_FOLDER = 10 * LARGEST_MODEL
"""Bytes of all files of a ZIP together, unpacked."""
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
        return data if not self.part else rezipped(self.packed, self.path, self.part, data)


def opened(path: Path) -> Source:
    """The text of a file.

    Raises:
        SceneFileError: it cannot be read, is too large, not UTF-8, or a ZIP without one model.
    """
    data = read_bytes(path, LARGEST_MODEL, "a REXS model")
    if data.startswith(b"PK\x03\x04"):
        part, text = _unpacked(data, path)
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
    """Name and text of the one model; the other files are tested, since results are put back beside them."""
    with unzipped(data, path) as folder:
        parts = folder.infolist()
        models = [each for each in parts if Path(each.filename).suffix.lower() in ENDINGS]
        if len(parts) > MOST_PARTS or len(models) != 1:
            raise refused(path, f"is a ZIP with {len(models)} models in {len(parts)} files; one is read")
        text = b"".join(pieces(folder, models, path, LARGEST_MODEL))
        others = (each for each in parts if each is not models[0])
        for _ in pieces(folder, others, path, LARGEST_FOLDER):
            pass
        return models[0].filename, text
